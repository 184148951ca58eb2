"""Benchmarks: their rows are kept by commit, and compared by turns with those of another commit."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import bench_rows

CI = Path(__file__).resolve().parents[1]
FAKE_MOTUS = """#!/usr/bin/env python3
# Stands for ./motus: "Blender" takes as many ms as the file `speed` beside it says, and a turn later a tenth more.
import json, os, sys
from pathlib import Path

here = Path(__file__).resolve().parent
with open(here.parent / "calls", "a") as file:
    file.write(f"{(here / 'speed').read_text().strip()} {' '.join(sys.argv[1:])}\\n")
if sys.argv[1] == "build":
    for name in sys.argv[3:]:
        program = here / "build" / "release" / "bench" / name
        program.parent.mkdir(parents=True, exist_ok=True)
        program.write_text(f"#!{sys.executable}\\n" + (here / "native/bench" / (name + ".cpp")).read_text().split("// program\\n")[1])
        program.chmod(0o755)
if sys.argv[1] == "blender":
    turns = here / "turns"
    turn = len(turns.read_text()) if turns.exists() else 0
    turns.write_text("." * (turn + 1))
    value = float((here / "speed").read_text()) * (1.0 + 0.1 * turn)
    print("Blender says something\\n| one row\\n| another row", flush=True)
    with open(os.environ["MOTUS_BENCH_ROWS"], "a") as file:
        for line in (
            {"facts": {"blender": "5.2.0", "instruction_set": "AVX2"}},
            {"table": "T", "row": "one", "measures": [{"name": "Motus", "unit": "ms", "value": value}, {"name": "off", "unit": "", "value": 7}]},
            {"table": "T", "row": "new", "measures": [{"name": "Motus", "unit": "ms", "value": 1.0}]},
        ):
            if line.get("row") != "new" or (here / "has_new").exists():
                print(json.dumps(line), file=file)
            else:
                print(json.dumps({"table": "T", "row": "new", "broken": "AttributeError: new"}), file=file)
"""
PROGRAM = """#include "table.hpp"
/* // program
import json, os
print("a line for readers")
with open(os.environ["MOTUS_BENCH_ROWS"], "a") as file:
    print(json.dumps({"table": "T", "row": "work", "measures": [{"name": "each", "unit": "ns", "value": 3.0}]}), file=file)
# */
"""

TABLE = r"""
#include <limits>

#include "table.hpp"

int main() {
    using motus::bench::Table;
    const Table table("T of \\ and \"", {{"each", "ns", 1}, {"error", "", 1, true}, {"faster by", "x", 1}}, 8);
    table.row("one", {2.5, 1e-9, 3.0});
    table.row("two", {0.001, std::numeric_limits<double>::quiet_NaN()});
    table.row("three", {1e300, {}, 4.0});
}
"""


def rows(**values):
    """One turn: rows of one table, with one measure of time each."""
    return [{"table": "T", "row": name, "measures": [{"name": "Motus", "unit": "ms", "value": value}]} for name, value in values.items()]


class Rows(unittest.TestCase):
    def written(self, *lines):
        folder = tempfile.TemporaryDirectory(prefix="motus-test-")
        self.addCleanup(folder.cleanup)
        path = Path(folder.name, "rows.json")
        path.write_text("".join(json.dumps(line) + "\n" for line in lines), encoding="utf-8")
        return path

    def test_rows_faults_and_facts_are_told_apart(self):
        broken = {"table": "T", "row": "three", "broken": "RuntimeError: no"}
        found = bench_rows.read(self.written({"facts": {"blender": "5.2.0"}}, *rows(one=1.0, two=2.0), broken))
        self.assertEqual(found, (rows(one=1.0, two=2.0), [broken], {"blender": "5.2.0"}))
        self.assertEqual(bench_rows.read(Path("/no/such/file")), ([], [], {}))

    def test_programs_of_the_library_state_rows_of_the_same_form(self):
        path = self.written()
        (path.parent / "table.cpp").write_text(TABLE, encoding="utf-8")
        native = CI.parent / "native"
        headers = [f"-I{native / folder}" for folder in ("bench", "include", "internal")]
        command = ["g++", "-std=c++20", *headers, "table.cpp", "-o", "table"]
        subprocess.run(command, cwd=path.parent, check=True)
        environment = dict(os.environ, MOTUS_BENCH_ROWS=str(path))
        shown = subprocess.run([path.parent / "table"], env=environment, check=True, capture_output=True, text=True).stdout
        found = bench_rows.read(path)
        self.assertIn(found.facts.pop("instruction_set"), ("SSE2", "SSE4", "AVX2", "AVX-512", "NEON"))
        self.assertEqual((found.facts, found.broken), ({}, []))
        table, units = 'T of \\ and "', {"each": "ns", "error": "", "faster by": "x"}
        wanted = {
            "one": {"each": 2.5, "error": 1e-9, "faster by": 3.0},
            "two": {"each": 0.001, "error": None},
            "three": {"each": 1e300, "faster by": 4.0},
        }
        for row, (name, values) in zip(found.rows, wanted.items(), strict=True):
            measures = [{"name": measure, "unit": units[measure], "value": value} for measure, value in values.items()]
            self.assertEqual(row, {"table": table, "row": name, "measures": measures})
        self.assertEqual(shown.splitlines()[3].split(), ["one", "2.5", "1.0e-09", "3.0", "x"])

    def test_two_rows_of_one_name_are_refused(self):
        with self.assertRaisesRegex(ValueError, "T / one"):
            bench_rows.read(self.written(*rows(one=1.0), *rows(one=2.0)))

    def test_ratios_are_those_of_turns(self):
        """Ours takes 2, 1.5 and 3 times as long: the ratio of the medians, 4 / 2, is not the judge."""
        ours, theirs = [rows(one=2.0), rows(one=6.0), rows(one=6.0)], [rows(one=1.0), rows(one=4.0), rows(one=2.0)]
        (found,), only_one = bench_rows.ratios(ours, theirs)
        self.assertEqual((found.row, found.measure, found.unit), ("one", "Motus", "ms"))
        self.assertEqual((found.ours, found.theirs), (6.0, 2.0))
        self.assertEqual((found.ratio, found.least, found.largest), (2.0, 1.5, 3.0))
        self.assertTrue(found.is_slower)
        self.assertEqual(only_one, [])

    def test_a_measure_is_marked_only_if_no_turn_leaves_a_doubt(self):
        (found,), _ = bench_rows.ratios([rows(one=2.0), rows(one=1.1)], [rows(one=1.0), rows(one=1.0)])
        self.assertFalse(found.is_slower)

    def test_what_is_no_time_or_lost_in_noise_has_no_ratio(self):
        error = [{"table": "T", "row": "error", "measures": [{"name": "off", "unit": "", "value": 1.0}]}]
        for value in (-0.1, 0.0, None):
            found, only_one = bench_rows.ratios([rows(one=1.0) + error, rows(one=value) + error], [rows(one=1.0) + error] * 2)
            self.assertEqual((found, only_one), ([], []))

    def test_rows_of_one_side_alone_are_named(self):
        found, only_one = bench_rows.ratios([rows(one=1.0, ours=1.0)], [rows(one=1.0, theirs=1.0)])
        self.assertEqual([one.row for one in found], ["one"])
        self.assertEqual(only_one, ["T / ours", "T / theirs"])


class Runs(unittest.TestCase):
    """With a made-up clone of two commits: at the first Blender takes 2 ms, at the second 4 ms."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.clone, self.cache = self.folder / "clone", self.folder / "cache"
        (self.clone / ".ci").mkdir(parents=True)
        for name in ("bench.py", "bench_rows.py", "blenders.py"):
            shutil.copy(CI / name, self.clone / ".ci" / name)
        self.write(".gitignore", "build/\nturns\n__pycache__/\n")
        self.write("motus", FAKE_MOTUS).chmod(0o755)
        self.write("blend_tests/bench/typical_bench.py", "")
        self.write("native/bench/old_bench.cpp", PROGRAM.replace("table.hpp", "stopwatch.hpp"))
        self.write("speed", "2")
        self.git("init", "--quiet")
        self.first = self.commit()
        self.write("native/bench/old_bench.cpp", PROGRAM)
        self.write("speed", "4")
        self.write("has_new", "")
        self.second = self.commit()

    def write(self, name, text):
        path = self.clone / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def git(self, *arguments):
        who = ("-c", "user.name=Test", "-c", "user.email=test@example.invalid")
        return subprocess.run(["git", "-C", self.clone, *who, *arguments], check=True, text=True, capture_output=True).stdout.strip()

    def commit(self):
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", "A state")
        return self.git("rev-parse", "HEAD")

    def bench(self, *arguments):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("MOTUS_")}
        command = [sys.executable, self.clone / ".ci" / "bench.py", "--cache", self.cache, "--blenders", "5.2", *arguments]
        return subprocess.run(
            command, check=False, text=True, env=environment, timeout=300, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        )

    def test_numbers_are_kept_with_commit_and_machine(self):
        for is_dirty in (False, True):
            if is_dirty:
                self.write("speed", "5")
            done = self.bench()
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertIn("| one row\n", done.stdout)
            self.assertIn("a line for readers\n", done.stdout)
            self.assertNotIn("Blender says", done.stdout)
            numbers = json.loads((self.clone / "build" / "bench" / f"{self.second}.json").read_text(encoding="utf-8"))
            self.assertEqual((numbers["commit"], numbers["is_dirty"]), (self.second, is_dirty))
            self.assertEqual(numbers["blenders"], {"5.2": "5.2.0"})
            self.assertEqual((numbers["machine"]["cores"], numbers["machine"]["instruction_set"]), (os.cpu_count(), "AVX2"))
            self.assertEqual((len(numbers["load_before"]), len(numbers["load_after"])), (3, 3))
            found = {(row["bench"], row["row"]): row["measures"][0]["value"] for row in numbers["rows"]}
            speed = 5.0 * 1.1 if is_dirty else 4.0
            wanted = {
                ("old_bench", "work"): 3.0,
                ("typical_bench in Blender 5.2", "one"): speed,
                ("typical_bench in Blender 5.2", "new"): 1.0,
            }
            self.assertEqual(found, wanted)
            (kept,) = (self.cache / "bench" / self.second).glob(f"{numbers['date'].replace(':', '-')}*.json")
            self.assertEqual(json.loads(kept.read_text(encoding="utf-8")), numbers)

    def test_a_commit_is_compared_by_turns(self):
        """What the older add-on has not is said, and so are programs that state no rows."""
        done = self.bench("--against", self.first, "--turns", "3")
        self.assertEqual(done.returncode, 0, done.stdout)
        calls = (self.folder / "calls").read_text(encoding="utf-8").splitlines()
        theirs = (self.cache / "bench" / self.first / "calls").read_text(encoding="utf-8").splitlines()
        self.assertEqual(sum("bench/typical_bench.py" in call for call in calls), 3)
        self.assertEqual(sum(str(self.clone / "blend_tests" / "bench" / "typical_bench.py") in call for call in theirs), 3)
        order = [line.rpartition(" ")[2] for line in done.stdout.splitlines() if line.startswith("motus: turn")]
        self.assertEqual(order, ["ours", "theirs", "theirs", "ours", "ours", "theirs"])
        (line,) = [line for line in done.stdout.splitlines() if line.startswith("| one  ")]
        self.assertEqual(line.split()[-4:], ["2.000", "2.000", "2.000", "SLOWER"])
        self.assertIn("| only one of the two has T / new\n", done.stdout)
        self.assertIn("SKIPPED old_bench", done.stdout)
        self.assertIn("1 compared, 1 slower, 2 skipped\n", done.stdout)
        for commit in (self.first, self.second):
            numbers = json.loads((self.clone / "build" / "bench" / f"{commit}.json").read_text(encoding="utf-8"))
            self.assertEqual([row["turn"] for row in numbers["rows"] if row["row"] == "one"], [1, 2, 3])

    def test_a_benchmark_that_breaks_is_told(self):
        (self.clone / "has_new").unlink()
        self.write("native/bench/old_bench.cpp", PROGRAM.replace("import json, os", "raise SystemExit(3)"))
        done = self.bench()
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("motus: old_bench: it ended with status 3\n", done.stdout)
        self.assertIn("motus: typical_bench in Blender 5.2: new: AttributeError: new\n", done.stdout)
        self.assertTrue(done.stdout.endswith("broke, see above: old_bench; typical_bench in Blender 5.2;\n"), done.stdout)

    def test_a_commit_that_is_not_there_is_said(self):
        done = self.bench("--against", "no-such-commit")
        self.assertEqual(
            (done.returncode, done.stdout), (1, "motus: bench: --against wants a commit of this clone, and no-such-commit is none\n")
        )
