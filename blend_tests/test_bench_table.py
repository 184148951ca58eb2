"""The tables of benchmarks: what readers see, and the lines of JSON."""

import contextlib
import io
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import support

BENCH = Path(__file__).resolve().parent / "bench"


@support.in_one_blender
class TableTest(unittest.TestCase):
    def setUp(self):
        path = mock.patch.object(sys, "path", [str(BENCH), *sys.path])
        path.start()
        self.addCleanup(path.stop)
        folder = tempfile.TemporaryDirectory(prefix="motus-test-")
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name, "rows.json")
        rows = mock.patch.dict(os.environ, MOTUS_BENCH_ROWS=str(self.file))
        rows.start()
        self.addCleanup(rows.stop)

    def test_rows_are_shown_and_written(self):
        """A cell of several rounds is their median, with the least and the quartiles; NaN and what is left out are no numbers."""
        from table import Column, Table

        shown, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(shown), contextlib.redirect_stderr(errors):
            table = Table("T", Column("added", "ms", "9.1f", True), Column("off", "", "9.1e"), Column("of Blender", "x"))
            table.row("one", np.array([4.0, 1.0, 3.0, 2.0, 10.0]), None, 2.0)
            with table.guarded("two"):
                table.row("two", [1.0], float("nan"), None)
            with table.guarded("three"):
                raise RuntimeError("no such operator")
            table.row("four", [1.0], None, None)
        facts, one, two, three, four = map(json.loads, self.file.read_text(encoding="utf-8").splitlines())
        instruction_set = support.addon("core.native").module.instruction_set()
        self.assertEqual(facts["facts"]["instruction_set"], instruction_set)
        self.assertIn(instruction_set, ("SSE2", "SSE4", "AVX2", "AVX-512", "NEON"))
        rounds = {"name": "added", "unit": "ms", "value": 3.0, "least": 1.0, "lower": 2.0, "upper": 4.0, "rounds": 5}
        self.assertEqual(one, {"table": "T", "row": "one", "measures": [rounds, {"name": "of Blender", "unit": "x", "value": 2.0}]})
        self.assertIsNone(two["measures"][1]["value"])
        self.assertEqual(three, {"table": "T", "row": "three", "broken": "RuntimeError: no such operator"})
        self.assertEqual(four["row"], "four")
        self.assertIn("RuntimeError: no such operator", errors.getvalue())
        lines = shown.getvalue().splitlines()
        self.assertTrue(all(line.startswith("| ") for line in lines), lines)
        self.assertEqual(lines[2].split(), ["|", "one", "3.0", "1.0", "4.0", "-", "2.000x"])
