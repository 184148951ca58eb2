"""The stub in the clone is what pybind11-stubgen makes of the built module."""

import difflib
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import motus_native

STUB = Path(__file__).resolve().parents[2] / "bindings" / "motus_native.pyi"


class StubTest(unittest.TestCase):
    @unittest.skipIf(sys.platform == "win32", "pybind11-stubgen is installed for the Pythons of Linux")
    @unittest.skipUnless(sys.version_info[:2] == (3, 11), "the stub has what Python 3.11 says of enums, and others say more")
    def test_the_stub_is_up_to_date(self):
        with tempfile.TemporaryDirectory() as folder:
            command = (Path(sys.executable).with_name("pybind11-stubgen"), "motus_native", "--exit-code", "--output-dir", folder)
            done = subprocess.run(command, check=False, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            made = Path(folder, STUB.name).read_text(encoding="utf-8")
        there = STUB.read_text(encoding="utf-8")
        difference = "\n".join(difflib.unified_diff(there.splitlines(), made.splitlines(), "in the clone", "made", lineterm="", n=1))
        self.assertFalse(difference, f"./motus docs stub makes the stub again\n{difference}")

    def test_every_public_name_has_a_manual(self):
        for name in dir(motus_native):
            if not name.startswith("_"):
                self.assertTrue(getattr(motus_native, name).__doc__, name)

    def test_signatures_name_the_types_of_their_arguments(self):
        """An argument or result without a type shows as Any: only a number or an array, by what is given, is one."""
        for line in STUB.read_text(encoding="utf-8").splitlines():
            if line.lstrip().startswith("def "):
                self.assertNotRegex(line, r": typing\.Any\b", "an argument has no type")
                self.assertNotRegex(line, r"(dict|list|tuple):$", "a result does not say what is in it")
