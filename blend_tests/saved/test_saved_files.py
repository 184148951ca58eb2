"""Files that an older state of Motus has saved: opened, they give the same numbers, and nothing in them has changed or is missing."""

import contextlib
import io
import json
import logging
import re
import tarfile
import tempfile
from pathlib import Path

import bpy
import numpy as np

import support
from saved import saved_cases as cases

SAME, OTHER = 1e-6, 1e-5
"""Of numbers up to 1, and else of the number: in the Blender that has saved a file, and in others, whose constraints round otherwise."""


def version(text):
    return tuple(map(int, text.split(".")))


def folders():
    """Those with files that this Blender can read."""
    own = version(cases.own_version())
    return [
        archive.parent
        for archive in sorted(cases.HERE.glob(f"*/{cases.ARCHIVE}"))
        if version(archive.parent.name.rpartition("-")[2]) <= own
    ]


def of_known_inputs(contents):
    """Contents whose drivers of solvers end with the last input that has a variable: settings that a system has got since add zeros behind."""
    return json.loads(re.sub(r"(,0)+\)", ")", json.dumps(contents)))


class Records(logging.Handler):
    """What is logged as an error."""

    def __init__(self):
        super().__init__(logging.ERROR)
        self.found = []

    def emit(self, record):
        self.found.append(record.getMessage())


def _unpacked(folder, place):
    """(path of a file, what it gave when it was saved) of those in a folder's archive, which are written to a place."""
    place.mkdir()
    with tarfile.open(folder / cases.ARCHIVE) as archive:
        for member in archive.getmembers():
            path = place / member.name
            path.write_bytes(archive.extractfile(member).read())
            yield path, json.loads((folder / f"{path.stem}.json").read_text(encoding="utf-8"))


class SavedFiles(support.SceneTestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        place = tempfile.TemporaryDirectory(prefix="motus-test-")
        cls.addClassCleanup(place.cleanup)
        cls.unpacked = [one for folder in folders() for one in _unpacked(folder, Path(place.name, folder.name))]

    def files(self):
        """(sub-test, path of the file, what it gave when it was saved) of all."""
        for path, kept in self.unpacked:
            yield self.subTest(f"{path.parent.name} {path.stem}"), path, kept

    def is_own(self, kept):
        """Whether this Blender has saved the file."""
        return kept["made by"] == f"Blender {bpy.app.version_string}"

    @contextlib.contextmanager
    def quiet(self):
        """Nothing is logged as an error, and nothing raises, in handlers and drivers either."""
        records, printed = Records(), io.StringIO()
        logging.getLogger().addHandler(records)
        try:
            with contextlib.redirect_stderr(printed):
                yield
        finally:
            logging.getLogger().removeHandler(records)
        self.assertEqual((records.found, printed.getvalue()), ([], ""))

    def assert_numbers(self, kept, found, wanted):
        self.assertEqual(sorted(found), sorted(wanted))
        for what, numbers in wanted.items():
            self.assertEqual(len(found[what]), len(numbers), what)
            off = np.abs(np.subtract(found[what], numbers)) / np.maximum(np.abs(numbers), 1.0)
            self.assertLessEqual(float(off.max()), SAME if self.is_own(kept) else OTHER, what)

    def test_numbers_and_removal(self):
        for subtest, path, kept in self.files():
            with subtest, self.quiet():
                cases.open_file(path)
                for frame in cases.FRAMES:
                    self.assert_numbers(kept, cases.numbers(frame), kept["frames"][f"{frame:g}"])
                cases.remove(path.stem)
                self.assert_contents(kept, kept["removed"]["contents"])
                self.assert_numbers(kept, cases.numbers(cases.AFTER_REMOVAL), kept["removed"]["numbers"])

    def test_nothing_in_the_file_is_changed(self):
        for subtest, path, kept in self.files():
            with subtest, self.quiet():
                cases.open_file(path)
                bpy.context.view_layer.update()
                self.assert_contents(kept, kept["contents"])
                for name, settings in kept["settings"].items():
                    owner = bpy.data.objects.get(name) or bpy.data.scenes[name]
                    self.assert_settings(owner.motus, settings, name)
                bpy.context.scene.frame_set(5)
                self.assert_no_problem()
                after = cases.contents()
                if self.is_own(kept):
                    self.assertFalse(bpy.data.is_dirty)
                    self.assertEqual(of_known_inputs(after), of_known_inputs(kept["contents"]))
                # Where Blender has a better kind of constraint, owners are wired anew with it: with as many helpers, or fewer.
                for kind in ("objects", "meshes"):
                    self.assertLessEqual(len(after[kind]), len(kept["contents"][kind]), kind)
                bpy.ops.wm.save_as_mainfile(filepath=str(path.with_suffix(".again.blend")), copy=True)
                bpy.context.scene.frame_set(7)
                self.assertEqual(cases.contents(), after)

    def assert_contents(self, kept, wanted):
        """What is in the file is what was, as far as it does not depend on the Blender."""
        found = cases.contents()
        if self.is_own(kept):
            self.assertEqual(found, wanted)
        self.assertEqual(found["objects"], wanted["objects"])

    def assert_settings(self, group, wanted, where):
        """All that was set is as it was; a later version may have more settings."""
        for name, value in wanted.items():
            found = getattr(group, name)
            if isinstance(value, dict):
                self.assert_settings(found, value, f"{where}.{name}")
            elif isinstance(value, list) and value and isinstance(value[0], dict):
                self.assertEqual(len(found), len(value), f"{where}.{name}")
                for index, (item, one) in enumerate(zip(found, value)):
                    self.assert_settings(item, one, f"{where}.{name}[{index}]")
            else:
                self.assertEqual(cases.value_of(group, name), value, f"{where}.{name}")

    def assert_no_problem(self):
        """No panel tells of one."""
        wiring, depsgraph = support.addon("core.wiring"), bpy.context.evaluated_depsgraph_get()
        for system in (one for one in support.addon("systems").SYSTEMS if hasattr(one, "solve")):
            for owner in bpy.context.view_layer.objects:
                if wiring.is_attached(system, owner):
                    self.assertIsNone(wiring.problem(system, owner, depsgraph), (system.name, owner.name))
