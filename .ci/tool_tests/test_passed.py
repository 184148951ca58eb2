"""What has passed, just as it is, is not run again."""

import os
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import passed
import pinned

PASSED = Path(__file__).resolve().parents[1] / "passed.py"
PROGRAM = (
    "import pathlib, sys; runs = pathlib.Path('runs'); runs.write_text(runs.read_text() + 'x'); print('said', *sys.argv[1:]); sys.exit({})"
)


class Passed(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "data" / "deep").mkdir(parents=True)
        (self.folder / "data" / "deep" / "one").write_text("1", encoding="utf-8")
        (self.folder / "runs").write_text("", encoding="utf-8")
        self.write(0)

    def write(self, status):
        (self.folder / "program.py").write_text(PROGRAM.format(status), encoding="utf-8")

    def check(self, runs, *arguments, status=0, options=()):
        """How often the program has run by now, and what it said."""
        command = [sys.executable, "program.py", *arguments]
        done = subprocess.run(
            [sys.executable, PASSED, *options, "kept", "program.py", "data", "--", *command],
            cwd=self.folder,
            check=False,
            text=True,
            capture_output=True,
        )
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertIn(" ".join(("said", *arguments)) + "\n", done.stdout)
        self.assertEqual((self.folder / "runs").read_text(encoding="utf-8"), "x" * runs)

    def test_once(self):
        self.check(1)
        self.check(1)

    def test_again_with_other_arguments(self):
        self.check(1)
        self.check(2, "a")
        self.check(2)

    def test_again_with_other_options_of_sanitizers(self):
        self.check(1)
        with unittest.mock.patch.dict("os.environ", ASAN_OPTIONS="detect_leaks=0"):
            self.check(2)
        self.check(2)

    def test_again_with_another_file(self):
        self.check(1)
        (self.folder / "data" / "deep" / "one").write_text("2", encoding="utf-8")
        self.check(2)
        (self.folder / "data" / "two").write_text("2", encoding="utf-8")
        self.check(3)
        (self.folder / "data" / "two").rename(self.folder / "data" / "three")
        self.check(4)
        self.check(4)

    def test_again_until_it_passes(self):
        self.write(3)
        self.check(1, status=3)
        self.check(2, status=3)
        self.write(0)
        self.check(3)
        self.check(3)

    def test_again_until_nothing_is_skipped(self):
        """What a skipped test lacked may be there the next time."""
        self.check(1, "\nsummary: 2 passed, 0 failed, 10 skipped")
        self.check(2, "\nsummary: 2 passed, 0 failed, 10 skipped")
        self.check(3, "\nsummary: 20 passed, 0 failed, 0 skipped")
        self.check(3, "\nsummary: 20 passed, 0 failed, 0 skipped")

    def test_again_with_another_program(self):
        """On the PATH, or installed by pip beside the states that are kept, if this clone pins it."""
        if not passed.PACKAGES.exists():
            self.skipTest("this system has no list of its packages")
        programs = self.folder / "bin"
        programs.mkdir()
        with unittest.mock.patch.dict("os.environ", PATH=f"{programs}:{os.environ['PATH']}"):
            self.check(1, options=["--system"])
            self.check(1, options=["--system"])
            (programs / "compiler").touch()
            self.check(2, options=["--system"])
            self.check(2, options=["--system"])
            below = Path("lib", "python3.11", "site-packages", "linter-2.dist-info")
            (self.folder / "programs" / "of_another_clone" / below).mkdir(parents=True)
            self.check(2, options=["--system"])
            own, _ = pinned.groups(self.folder / "programs")["lint"]
            (own / below).mkdir(parents=True)
            self.check(3, options=["--system"])
            self.check(3, options=["--system"])

    def test_again_with_another_package(self):
        packages = self.folder / "status"
        without = [passed.installed(self.folder, packages) for _ in range(2)]
        self.assertNotEqual(*without)
        packages.write_text("Package: g++\nVersion: 1\n", encoding="utf-8")
        before, same = (passed.installed(self.folder, packages) for _ in range(2))
        self.assertEqual(before, same)
        packages.write_text("Package: g++\nVersion: 2\n", encoding="utf-8")
        self.assertNotEqual(passed.installed(self.folder, packages), before)

    def test_what_python_compiles_is_no_other_file(self):
        self.check(1)
        (self.folder / "data" / "__pycache__").mkdir()
        (self.folder / "data" / "__pycache__" / "one.pyc").touch()
        self.check(1)
