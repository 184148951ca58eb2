"""What has passed, just as it is, is not run again."""

import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

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

    def check(self, runs, *arguments, status=0):
        """How often the program has run by now, and what it said."""
        command = [sys.executable, "program.py", *arguments]
        done = subprocess.run(
            [sys.executable, PASSED, "kept", "program.py", "data", "--", *command],
            cwd=self.folder,
            check=False,
            text=True,
            capture_output=True,
        )
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertIn(" ".join(("said", *arguments)), done.stdout.splitlines())
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
