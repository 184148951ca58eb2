"""Runs benchmarks, keeps their numbers by commit, and compares them with those of another commit; called by `./motus bench`.

bench.py --cache FOLDER [--blenders NAME,...] [--against COMMIT [--turns N]] [PATTERN...]
Benchmarks are programs of the library (native/bench) and scripts that run inside Blender (blend_tests/bench).
"""

import argparse
import datetime
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

import bench_rows
import blenders

CLONE = Path(__file__).resolve().parents[1]
LOG_LINES = 30


class Bench(NamedTuple):
    """A program of the library (no version), or a script and the version of Blender that runs it."""

    name: str
    source: Path
    version: str


class Side(NamedTuple):
    """A state of Motus that benchmarks are run with."""

    clone: Path
    build: Path
    environment: dict

    def motus(self, *arguments, **keywords):
        """Runs this state's own ./motus."""
        return subprocess.run([self.clone / "motus", *arguments], check=False, env=self.environment, stdin=subprocess.DEVNULL, **keywords)


class Done(NamedTuple):
    """How a benchmark ended."""

    output: bench_rows.Output
    fault: str  # why it is broken, or nothing


def say(text):
    """A line about what is done, beside the benchmarks' own."""
    print(f"motus: {text}", file=sys.stderr, flush=True)


# --- What there is ------------------------------------------------------------------------------------------------------


def benches(versions, patterns):
    """The benchmarks whose name contains one of the patterns; all, if there is none."""
    found = [Bench(path.stem, path, "") for path in sorted((CLONE / "native" / "bench").rglob("*_bench.cpp"))]
    for version in versions:
        scripts = sorted((CLONE / "blend_tests" / "bench").glob("*_bench.py"))
        found += [Bench(f"{path.stem} in Blender {version}", path, version) for path in scripts]
    return [bench for bench in found if not patterns or any(pattern in bench.name for pattern in patterns)]


def own_side():
    """The clone that this file is in."""
    return Side(CLONE, Path(os.environ.get("MOTUS_BUILD", CLONE / "build")), dict(os.environ))


def git(*arguments):
    """What git says of the clone; nothing if that is no repository of its own."""
    done = subprocess.run(["git", "-C", CLONE, *arguments], check=False, capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 and (CLONE / ".git").exists() else ""


def other_side(commit, cache):
    """Another commit, in a folder of the cache with a build of its own."""
    folder = cache / "bench" / commit / "checkout"
    if not folder.exists():
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder.parent) as temporary:
            archive = Path(temporary, "archive.tar")
            subprocess.run(["git", "-C", CLONE, "archive", "--output", archive, commit], check=True)
            shutil.unpack_archive(archive, Path(temporary, "whole"))
            Path(temporary, "whole").rename(folder)
    own = ("MOTUS_BUILD", "MOTUS_DIST", "MOTUS_PROFILE", "MOTUS_PREPARED")
    return Side(folder, folder / "build", {name: value for name, value in os.environ.items() if name not in own})


# --- Running ------------------------------------------------------------------------------------------------------------


def build(side, chosen):
    """Builds the programs among the chosen benchmarks."""
    programs = [bench.name for bench in chosen if not bench.version]
    if programs and side.motus("build", "release", *programs).returncode:
        sys.exit(f"motus: the benchmarks of {side.clone} could not be built, see above")


def states_rows(side, bench):
    """Whether there is such a benchmark on a side, and states its rows; scripts are always this clone's, whatever add-on they run with."""
    source = side.clone / bench.source.relative_to(CLONE)
    return bool(bench.version) or (source.exists() and '#include "table.hpp"' in source.read_text(encoding="utf-8"))


def run(bench, side, is_shown):
    """Runs a benchmark and returns how that ended; the lines for readers are printed as they come, if `is_shown`."""
    with tempfile.TemporaryDirectory(prefix="motus-bench-") as folder:
        rows, log = Path(folder, "rows.json"), []
        if bench.version:
            options = ("--background", "--factory-startup", "--python-exit-code", "1", "--python")
            command = [side.clone / "motus", "blender", "--version", bench.version, *options, bench.source]
        else:
            command = [side.build / "release" / "bench" / bench.name]
        environment = side.environment | {"MOTUS_BENCH_ROWS": str(rows)}
        keywords = {"env": environment, "stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "cwd": CLONE}
        with subprocess.Popen(command, text=True, errors="replace", **keywords) as process:
            for line in process.stdout:
                log.append(line)
                # Inside Blender, lines for readers begin with a bar; all others are Blender's, or reported by operators.
                if is_shown and (not bench.version or line.startswith("|")):
                    print(line, end="", flush=True)
        output, fault = _read(rows)
    fault = fault or _fault(process.returncode, output)
    if fault:
        print("".join(log[-LOG_LINES:]), end="", flush=True)
        say(f"{bench.name}: {fault}")
    return Done(output, fault)


def _read(rows):
    try:
        return bench_rows.read(rows), ""
    except ValueError as error:
        return bench_rows.Output([], [], {}), str(error)


def _fault(status, output):
    if output.broken:
        return "; ".join(f"{row['row']}: {row['broken']}" for row in output.broken)
    if status:
        return f"it ended with status {status}"
    return "" if output.rows else "it states no row"


# --- Keeping ------------------------------------------------------------------------------------------------------------


def processor():
    """The name of the processor, as the system tells it."""
    try:
        found = re.search(r"^model name\s*: (.*)", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE)
    except OSError:
        found = None
    return found[1] if found else platform.processor() or platform.machine()


class Record:
    """The numbers of one run, and what they were measured on."""

    def __init__(self, commit, is_dirty):
        self.numbers = {
            "commit": commit,
            "is_dirty": is_dirty,
            "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
            "machine": {"processor": processor(), "cores": os.cpu_count(), "instruction_set": None},
            "load_before": os.getloadavg(),
            "blenders": {},
            "rows": [],
        }

    def add(self, bench, output, turn=1):
        """Adds what a benchmark told in one of the turns."""
        self.numbers["machine"]["instruction_set"] = output.facts.get("instruction_set") or self.numbers["machine"]["instruction_set"]
        if "blender" in output.facts:
            self.numbers["blenders"][bench.version] = output.facts["blender"]
        self.numbers["rows"] += [{"bench": bench.name, "turn": turn, **row} for row in output.rows]

    def keep(self, folder, cache):
        """Writes FOLDER/COMMIT.json, the last run of a commit, and a file for each run into the cache."""
        self.numbers["load_after"] = os.getloadavg()
        text = json.dumps(self.numbers, indent=1) + "\n"
        commit = self.numbers["commit"]
        path = folder / f"{commit}.json"
        kept = cache / "bench" / commit / f"{self.numbers['date'].replace(':', '-')}.json"
        for one in (path, kept):
            one.parent.mkdir(parents=True, exist_ok=True)
            one.write_text(text, encoding="utf-8")
        machine = self.numbers["machine"]
        instructions = machine["instruction_set"] or "unknown"
        loads = " and ".join(f"{self.numbers[name][0]:.1f}" for name in ("load_before", "load_after"))
        say(f"{machine['processor']}, {machine['cores']} cores, instruction set {instructions}, load {loads} before and after")
        say(f"the numbers of {commit} are kept in {path} and {kept}")


# --- Commands -----------------------------------------------------------------------------------------------------------


def run_all(chosen, cache):
    """Runs benchmarks one after the other; returns the names of those that broke."""
    side, broken = own_side(), []
    record = Record(git("rev-parse", "HEAD") or "no-commit", bool(git("status", "--porcelain")))
    build(side, chosen)
    for bench in chosen:
        print(f"== {bench.name}", flush=True)
        done = run(bench, side, is_shown=True)
        record.add(bench, done.output)
        if done.fault:
            broken.append(bench.name)
    record.keep(side.build / "bench", cache)
    return broken


def compare(chosen, commit, turns, cache):
    """Runs benchmarks of this clone and of another commit by turns; returns the names of those that broke here."""
    ours, theirs = own_side(), other_side(commit, cache)
    records = Record(git("rev-parse", "HEAD"), bool(git("status", "--porcelain"))), Record(commit, False)
    broken, counts = [], dict.fromkeys(("compared", "slower", "skipped"), 0)
    both = [bench for bench in chosen if states_rows(theirs, bench)]
    for bench in chosen:
        if bench not in both:
            say(f"SKIPPED {bench.name}: at {commit[:12]} there is none, or it states no rows")
            counts["skipped"] += 1
    for side in ours, theirs:
        build(side, both)
    for bench in both:
        print(f"== {bench.name}, beside {commit[:12]}", flush=True)
        taken = [[], []]
        for turn in range(1, turns + 1):
            # Which goes first alternates: what a machine does slowly, such as growing warm, is the same for both.
            for which in (0, 1) if turn % 2 else (1, 0):
                say(f"turn {turn} of {turns}: {('ours', 'theirs')[which]}")
                done = run(bench, (ours, theirs)[which], is_shown=False)
                records[which].add(bench, done.output, turn)
                taken[which].append(done.output.rows)
                if done.fault and not which and bench.name not in broken:
                    broken.append(bench.name)
        report(*bench_rows.ratios(*taken), counts)
    records[0].keep(ours.build / "bench", cache)
    records[1].keep(ours.build / "bench", cache)
    print(", ".join(f"{count} {name}" for name, count in counts.items()), flush=True)
    return broken


def report(ratios, only_one, counts):
    """Prints ratios, and the rows that cannot be compared."""
    print(f"| {'row':44} {'measure':>14} {'unit':>4} {'ours':>11} {'theirs':>11} {'ratio':>7} {'least':>7} {'largest':>7}")
    for one in ratios:
        numbers = f"{one.ours:11.4f} {one.theirs:11.4f} {one.ratio:7.3f} {one.least:7.3f} {one.largest:7.3f}"
        print(f"| {one.row:44} {one.measure:>14} {one.unit:>4} {numbers}{'  SLOWER' if one.is_slower else ''}")
    for name in only_one:
        print(f"| only one of the two has {name}")
    counts["compared"] += len(ratios)
    counts["slower"] += sum(one.is_slower for one in ratios)
    counts["skipped"] += len(only_one)


class Parser(argparse.ArgumentParser):
    """Tells what is wrong in one line, as ./motus does."""

    def error(self, message):
        sys.exit(f"motus: bench: {message}")


def main():
    """Reads the command line."""
    parser = Parser(prog="motus bench")
    parser.add_argument("--cache", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--blenders", default=",".join(blenders.PROGRAMS), help="which Blenders to run in")
    parser.add_argument("--against", metavar="COMMIT", help="compare with this commit")
    parser.add_argument("--turns", type=int, default=3, help="how often each benchmark of both is run")
    parser.add_argument("patterns", nargs="*", help="only the benchmarks whose name contains one of these")
    options = parser.parse_args()
    if options.turns < 1:
        parser.error("--turns wants a number of at least 1")
    commit = git("rev-parse", "--verify", "--quiet", f"{options.against}^{{commit}}") if options.against else ""
    if options.against and not commit:
        parser.error(f"--against wants a commit of this clone, and {options.against} is none")

    chosen = benches([version for version in options.blenders.split(",") if version], options.patterns)
    here = {version: own_side().motus("has_blender", version).returncode == 0 for version in {bench.version for bench in chosen} - {""}}
    chosen = [bench for bench in chosen if here.get(bench.version, True)]
    if not chosen:
        parser.error(f"no benchmark was run: there is none that is named so, or no such Blender ({options.blenders})")
    broken = compare(chosen, commit, options.turns, options.cache) if commit else run_all(chosen, options.cache)
    if broken:
        sys.exit(f"motus: these benchmarks broke, see above:{''.join(f' {name};' for name in broken)}")


main()
