"""Tests that need no Blender are chosen by name and counted as those inside Blender are."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

RUNNER = Path(__file__).resolve().parents[1] / "outside_blender.py"
SAMPLE = """
import unittest

class Sample(unittest.TestCase):
    def test_good(self):
        pass

    def test_bad(self):
        self.fail("wrong")

    def test_some_subtests_are_bad(self):
        for number in range(3):
            with self.subTest(number=number):
                self.assertNotEqual(number, 1)

    @unittest.skip("not here")
    def test_skipped(self):
        pass

class Unprepared(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        raise OSError("nothing is prepared")

    def test_any(self):
        pass
"""


class OutsideBlender(unittest.TestCase):
    def run_sample(self, *patterns, runner=(RUNNER,)):
        """(exit status, output)."""
        with tempfile.TemporaryDirectory(prefix="motus test ") as folder:
            Path(folder, "test_sample.py").write_text(SAMPLE, encoding="utf-8")
            done = subprocess.run(
                [sys.executable, *runner, folder, *patterns],
                check=False,
                cwd=folder,
                text=True,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
            )
        return done.returncode, done.stdout

    def test_each_test_counts_once(self):
        status, output = self.run_sample()
        self.assertEqual(status, 1, output)
        self.assertTrue(output.endswith("summary: 1 passed, 3 failed, 1 skipped\n"), output)
        for name in ("test_bad", "test_some_subtests_are_bad", "Unprepared::test_any"):
            self.assertRegex(output, rf"(?m)^(SUBFAILED.*|FAILED|ERROR) \S*{name}")
        self.assertIn("not here", output)

    def test_patterns_choose_by_parts_of_a_test_s_id(self):
        for pattern, counts in (
            ("Sample.test_good", "1 passed, 0 failed, 0 skipped"),
            ("test_sample.Sample.test_skip", "0 passed, 0 failed, 1 skipped"),
        ):
            status, output = self.run_sample(pattern, "of another name")
            self.assertEqual(status, 0, output)
            self.assertTrue(output.endswith(f"summary: {counts}\n"), output)

    def test_a_pattern_of_no_test_is_no_failure(self):
        status, output = self.run_sample("a case of Catch2, for instance")
        self.assertEqual(status, 0, output)
        self.assertTrue(output.endswith("summary: 0 passed, 0 failed, 0 skipped\n"), output)

    def test_what_is_slow_is_listed(self):
        """By what it takes of the processor; here everything counts as slow."""
        all_are_slow = "import sys, outside_blender; outside_blender.SLOW = -1.0; sys.exit(outside_blender.main(*sys.argv[1:]))"
        with mock.patch.dict("os.environ", PYTHONPATH=str(RUNNER.parent)):
            status, output = self.run_sample("Sample.test_good", runner=("-c", all_are_slow))
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r"(?m)^slow: test_sample\.py::Sample::test_good \d+\.\d s$")
