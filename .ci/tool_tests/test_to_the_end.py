"""A test that ends the process has failed, and all others run nevertheless."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CI = Path(__file__).resolve().parents[1]
TESTS = """
import os, signal, unittest

class Few(unittest.TestCase):
    def test_a_passes(self):
        print("RAN a", flush=True)

    def test_b_ends_the_process(self):
        print("RAN b", flush=True)
        {end}

    def test_c_is_skipped(self):
        print("RAN c")
        self.skipTest("for a reason")

    def test_d_fails_twice(self):
        for number in range(2):
            with self.subTest(number):
                self.fail()

    def test_e_passes(self):
        print("RAN e")
"""
LAST = """
import atexit, os, unittest

class Last(unittest.TestCase):
    def test_ends_when_all_is_done(self):
        atexit.register(os._exit, 9)
"""


class ToTheEnd(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def run_tests(self, text, *patterns):
        """(exit status, output, sums of the counts that passed, failed and were skipped)."""
        self.folder.joinpath("test_few.py").write_text(text, encoding="utf-8")
        command = [sys.executable, CI / "to_the_end.py", sys.executable, CI / "suite.py", self.folder, *patterns]
        done = subprocess.run(command, text=True, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        counts = re.findall(r"^summary: (\d+) passed, (\d+) failed, (\d+) skipped$", done.stdout, re.MULTILINE)
        return done.returncode, done.stdout, [sum(map(int, column)) for column in zip(*counts)]

    def test_the_rest_runs_after_a_test_that_ends_the_process(self):
        for end, status in (("os._exit(0)", 0), ("os.kill(os.getpid(), signal.SIGSEGV)", -11)):
            with self.subTest(end):
                returned, said, counts = self.run_tests(TESTS.format(end=end))
                self.assertEqual((returned, counts), (1, [2, 2, 1]), said)
                self.assertEqual(re.findall("^RAN .", said, re.MULTILINE), ["RAN a", "RAN b", "RAN c", "RAN e"])
                self.assertIn(f"FAILED test_few.Few.test_b_ends_the_process: the process ended in it, with status {status}\n", said)

    def test_what_needs_no_further_process(self):
        whole = self.run_tests(TESTS.format(end="pass"))
        self.assertEqual((whole[0], whole[2]), (1, [3, 1, 1]), whole[1])
        self.assertEqual(whole[1].count("summary:"), 1)
        few = self.run_tests(TESTS.format(end="pass"), "passes")
        self.assertEqual((few[0], few[2]), (0, [2, 0, 0]), few[1])

    def test_a_process_that_breaks_at_its_end(self):
        """No test is to blame, and the exit status is not forgotten."""
        status, said, counts = self.run_tests(LAST)
        self.assertEqual((status, counts), (9, [1, 0, 0]), said)
