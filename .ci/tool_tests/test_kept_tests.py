"""Files of tests that passed before, just as they are with all that they depend on, are not run again."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import passed

CI = Path(__file__).resolve().parents[1]
RUN = """
import sys
sys.path.insert(0, sys.argv[1])
import kept_tests, suite
from pathlib import Path
kept_tests.KeptTests.__init__.__defaults__ = (Path(sys.argv[2]).parent,)
sys.exit(suite.run_folder(Path(sys.argv[2]), sys.argv[4:], sys.argv[3].split()))
"""
TESTS = """
import unittest
from pathlib import Path
{imports}

class Few(unittest.TestCase):
    def test_one(self):
        with open("{runs}", "a") as file:
            file.write("{name} ")
        {body}

    def test_two(self):
        pass
"""


class Kept(unittest.TestCase):
    def setUp(self):
        if not passed.PACKAGES.exists():
            self.skipTest("this system has no list of its packages")
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.place = Path(temporary.name)
        self.clone = self.place / "clone"
        self.write("docs/page.md", "text\n")
        self.write("tests/deep/__init__.py", "")
        self.write("tests/deep/cases.py", "import common\n")
        self.write("tests/common.py", "NUMBER = 1\n")
        self.write("tests/data.bin", "0")
        self.write_tests("alone")
        self.write_tests("importing", imports="from deep import (\n    cases as others,\n)")
        self.write_tests("reading", body=f"Path({str(self.clone / 'docs' / 'page.md')!r}).read_text()")
        self.write_tests("listing", body=f"list(Path({str(self.clone / 'docs')!r}).iterdir())")
        self.write_tests(
            "handing_over", body=f"__import__('subprocess').run(['cat', {str(self.clone / 'docs' / 'page.md')!r}], check=True)"
        )

    def write(self, name, text):
        path = self.clone / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def write_tests(self, name, imports="", body="pass"):
        text = TESTS.format(name=name, imports=imports, body=body, runs=self.place / "runs")
        self.write(f"tests/test_{name}.py", text)

    def run_tests(self, *patterns, about="add-on", **environment):
        """(names of the files whose tests ran, counts of the tests that passed, failed and were skipped)."""
        (self.place / "runs").write_text("", encoding="utf-8")
        command = [sys.executable, "-c", RUN, CI, self.clone / "tests", about, *patterns]
        states = {"MOTUS_PASSED": str(self.place / "passed")}
        done = subprocess.run(command, env=os.environ | states | environment, check=False, text=True, capture_output=True)
        counts = re.search(r"^summary: (\d+) passed, (\d+) failed, (\d+) skipped$", done.stdout, re.MULTILINE)
        self.assertTrue(counts, done.stdout + done.stderr)
        return sorted((self.place / "runs").read_text(encoding="utf-8").split()), tuple(map(int, counts.groups()))

    ALL = ["alone", "handing_over", "importing", "listing", "reading"]

    def check(self, *names, **keywords):
        """All ten tests pass, and those of these files were run."""
        self.assertEqual(self.run_tests(**keywords), (sorted(names), (10, 0, 0)))

    def test_nothing_has_changed(self):
        self.check(*self.ALL)
        self.check()
        self.check()

    def test_what_a_file_depends_on_has_changed(self):
        self.check(*self.ALL)
        for name, text, *changed in (
            ("tests/common.py", "NUMBER = 2\n", "importing"),
            ("tests/deep/__init__.py", "# A package.\n", "importing"),
            ("docs/page.md", "other text\n", "handing_over", "reading"),
            ("docs/page.md", "text\n", "handing_over", "reading"),
            ("docs/new.md", "text", "listing"),
            ("tests/data.bin", "1", *self.ALL),
        ):
            with self.subTest(name):
                self.write(name, text)
                self.check(*changed)
                self.check()
        self.write_tests("alone", body="self.assertTrue(True)")
        self.check("alone")

    def test_a_file_that_is_edited_while_tests_run(self):
        """What has passed is the file as it was imported."""
        edited = self.clone / "tests" / "test_reading.py"
        self.write_tests("alone", body=f"Path({str(edited)!r}).open('a').write('# edited\\n')")
        self.check(*self.ALL)
        self.write_tests("alone")
        self.check("alone", "reading")
        self.check()

    def test_other_things_are_tested(self):
        self.check(*self.ALL)
        self.check(*self.ALL, about="other add-on")
        self.check(*self.ALL, MOTUS_LEAVE_OUT="mark")
        self.check(about="other add-on")

    def test_what_failed_or_was_skipped_is_run_again(self):
        self.write_tests("alone", body="self.fail()")
        self.write_tests("reading", body="self.skipTest('for a reason')")
        self.assertEqual(self.run_tests(), (self.ALL, (8, 1, 1)))
        for _ in range(2):
            self.assertEqual(self.run_tests(), (["alone", "reading"], (8, 1, 1)))

    def test_tests_that_are_named_are_run(self):
        self.check(*self.ALL)
        self.assertEqual(self.run_tests("test_one"), (self.ALL, (5, 0, 0)))

    def test_nothing_is_kept_without_a_folder_for_it(self):
        for _ in range(2):
            self.check(*self.ALL, MOTUS_PASSED="")

    def test_after_a_test_that_ended_the_process(self):
        """What had passed in the process that ended is counted there, and its file is not taken for one of which all was run."""
        journal = self.place / "journal"
        journal.write_text("passed test_alone.Few.test_one\n", encoding="utf-8")
        ran, counts = self.run_tests(MOTUS_JOURNAL=str(journal))
        self.assertEqual((ran, counts), (self.ALL[1:], (9, 0, 0)))
        self.check("alone")
