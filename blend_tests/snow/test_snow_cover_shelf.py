"""Covers that several processes share by files: found again, never trusted, and left alone without the environment variable."""

import os
from pathlib import Path
from unittest import mock

import support
from snow.cover_cases import FALLING, CoverTestCase, forget_work, layer, state
from support import go_to


class Shelf(CoverTestCase):
    def setUp(self):
        super().setUp()
        self.plans = Path(self.folder) / "plans"
        self.enterContext(mock.patch.dict(os.environ, {"MOTUS_PLANS": str(self.plans)}))
        work = support.addon("snow.cover.work")
        self.computed = self.enterContext(mock.patch.object(work, "_covered", side_effect=work._covered))
        self.emitter = self.add(**FALLING)
        self.square()
        self.snow_cover = self.cover()
        go_to(60)
        self.first = state(self.snow_cover)

    def files(self):
        return sorted(self.plans.glob("*"))

    def anew(self):
        """The layer as a new process computes it, and how many covers it has computed for that."""
        forget_work()
        self.computed.reset_mock()
        self.snow_cover.motus.snow_cover.thinnest += 1e-3  # an edit, so that it is evaluated
        self.snow_cover.motus.snow_cover.thinnest -= 1e-3
        go_to(61)
        go_to(60)
        return state(self.snow_cover), self.computed.call_count

    def test_a_cover_is_found_again(self):
        self.assertGreater(len(layer(self.snow_cover)[0]), 0)
        self.assertEqual((len(self.files()), self.computed.call_count), (1, 1))
        self.assertEqual(self.anew(), (self.first, 0))

    def test_other_snow_has_another_file(self):
        for name, value in (("seed", 4), ("rate", 200.0), ("gusts", 0.5)):
            setattr(self.emitter.motus.snow, name, value)
            with self.subTest(name=name):
                before = len(self.files())
                found, computed = self.anew()
                self.assertEqual((computed, len(self.files())), (1, before + 1))
                self.assertNotEqual(found, self.first)

    def test_files_of_others_are_not_trusted(self):
        (file,) = self.files()
        whole = file.read_bytes()
        middle = len(whole) // 2
        for content in (
            b"",
            b"no cover",
            whole[:-1],
            whole + b"\0",
            b"\xff" * len(whole),
            whole[:middle] + b"\xff" * 64 + whole[middle + 64 :],
        ):
            file.write_bytes(content)
            found, computed = self.anew()
            with self.subTest(size=len(content)):
                self.assertEqual((found, computed), (self.first, 1))
                self.assertEqual(file.read_bytes(), whole, "it is written again")

    def test_a_folder_that_cannot_be_written(self):
        (file,) = self.files()
        file.unlink()
        self.plans.rmdir()
        self.plans.write_text("no folder")
        with self.assertLogs(support.addon("snow.cover.shelf").log, "WARNING"):
            found = self.anew()
        self.assertEqual(found, (self.first, 1))

    def test_nothing_without_the_variable(self):
        (file,) = self.files()
        file.unlink()
        del os.environ["MOTUS_PLANS"]
        self.assertEqual(self.anew(), (self.first, 1))
        self.assertEqual(self.files(), [])
