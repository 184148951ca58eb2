"""Which packages are made for which groups of tests."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import blenders
import official
import platforms
import released

MOTUS = Path(__file__).resolve().parents[2] / "motus"
WINDOWS = ["4.5-windows"]


def planned(*only, **keywords):
    """(platforms, Blenders)."""
    found = released.planned(only, **keywords)
    return found["PLATFORMS"], found["RELEASED"]


class Planned(unittest.TestCase):
    def test_nothing_is_packaged_unless_it_is_asked_for(self):
        for only in ((), ("",), ("library", "blender"), ("5.2-lts",), ("official 4.5-lts", "smoke")):
            self.assertEqual(planned(*only), ([], []), only)

    def test_everything(self):
        everywhere = list(platforms.PLATFORMS), ["4.5-lts", "4.5-windows", "5.2-lts"]
        self.assertEqual(planned("", everything=True), everywhere)
        self.assertEqual(planned("packages"), everywhere)

    def test_what_a_group_needs(self):
        self.assertEqual(planned("packages in 5.2-lts"), (["linux-x64"], ["5.2-lts"]))
        self.assertEqual(planned("packages in 4.5-windows"), (["windows-x64"], WINDOWS))
        self.assertEqual(planned("packages by pip, linux-x64"), (["linux-x64"], []))
        self.assertEqual(planned("windows"), (["windows-x64"], WINDOWS))

    def test_a_blender_that_only_runs_packages_is_in_no_other_group(self):
        for one in blenders.BLENDERS:
            self.assertEqual(one.kind == "windows", one.name not in blenders.NAMES)
            self.assertIn(one.kind, blenders.KINDS)
            self.assertLessEqual(one.tests, set(blenders.TESTS))
            self.assertTrue(one.kind == "program" or official.pip_arguments(one))


class NotPackaged(unittest.TestCase):
    def test_it_is_said_what_makes_it(self):
        for command, part in (
            (("has_blender", "4.5-windows"), "Blender 4.5-windows takes what `./motus package --platforms windows-x64` makes"),
            (("test_package", "4.5-lts"), "there are no packages of linux-x64"),
        ):
            with tempfile.TemporaryDirectory() as folder:
                done = subprocess.run(
                    [MOTUS, *command],
                    env=os.environ | {"MOTUS_DIST": folder, "MOTUS_WITHOUT": ""},
                    check=False,
                    text=True,
                    capture_output=True,
                )
            self.assertEqual(done.returncode, 77, done.stderr)
            self.assertIn(f"SKIPPED: {part}", done.stderr)
