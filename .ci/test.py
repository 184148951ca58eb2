"""Runs the groups of tests (CMakeLists.txt) by CTest; called by `./motus test`, which has built and packaged the add-on before.

test.py [--all | --blenders NAME,...] [--only NAME,...] [--again] [PATTERN...]
CTest tells how each group ends, and shows the output of those that fail. Then follow a line a group with counts and seconds, and last
`N passed, N failed[, N skipped] in N min N s`.
"""

import argparse
import contextlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import blenders
import bytecode
import inside
import released
from broken import what_broke

CI = Path(__file__).resolve().parent
MOTUS = CI.parent / "motus"
BUILD = Path(os.environ["MOTUS_BUILD"])
FOLDER = BUILD / "tests"
RESULTS = FOLDER / "results.xml"
WHOLE_OUTPUT = str(10**8)
ELSEWHERE = ("libcxx", "threads", "aarch64-linux", "windows-x64", "x86-64-v3", "x86-64-v4")
"""CMake's presets of other compilers, systems and processors, for which the library is tested if all is asked for, or its group by name."""

FUZZED = ("curve", "clip", "mesh", "snow")
"""Topics that fuzzers look through, in the same cases."""


def has_blender(name):
    """Whether this machine has a Blender of this name, or can get it; ./motus says why not."""
    return subprocess.run([MOTUS, "has_blender", name], check=False).returncode == 0


def configure(groups, **lists):
    """Tells CMake which groups there are: inside Blenders, and by `lists` ELSEWHERE, PLATFORMS, RELEASED, FARM, FUZZED and PATTERNS."""
    options = (
        {"BUILD": BUILD, "PYTHON": sys.executable, "PASSED": os.environ["MOTUS_PASSED"]}
        | {name.upper(): ";".join(values) for name, values in lists.items()}
        | groups.lists()
    )
    subprocess.run(
        ["cmake", "-S", CI, "-B", FOLDER, *(f"-DMOTUS_{name}={value}" for name, value in options.items())],
        check=True,
        stdout=subprocess.DEVNULL,
    )


@contextlib.contextmanager
def passed_before(again):
    """While tests run: has them find what has passed before, or nothing if all is to run again."""
    if not again:
        yield
        return
    kept = Path(os.environ["MOTUS_PASSED"])
    kept.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=kept.parent, prefix="again-") as folder:
        os.environ["MOTUS_PASSED"] = folder
        yield


def run_groups(names):
    """Runs the groups whose name contains one of `names`, and what these need; returns CTest's exit status."""
    shutil.rmtree(BUILD / "profiles" / "tests", ignore_errors=True)
    RESULTS.unlink(missing_ok=True)
    chosen = (
        "|".join(re.sub(r"([][.*+?^$()\\|])", r"\\\1", name) for name in names) or "."
    )  # CTest takes an empty pattern for one that matches nothing
    command = [
        "ctest",
        "--test-dir",
        FOLDER,
        "--parallel",
        str(max(2, os.cpu_count())),
        "-R",
        chosen,
        "--no-tests=error",
        "--output-on-failure",
        "--output-junit",
        RESULTS,
        "--test-output-size-passed",
        WHOLE_OUTPUT,
        "--test-output-size-failed",
        WHOLE_OUTPUT,
    ]
    return subprocess.run(command, check=False, stdin=subprocess.DEVNULL).returncode


def count(output, is_well):
    """(passed, failed, skipped) by a group's output: the summary lines of suite.py, or Catch2's; one test where it has neither."""
    found = [tuple(map(int, match)) for match in re.findall(r"^summary: (\d+) passed, (\d+) failed, (\d+) skipped", output, re.MULTILINE)]
    if match := re.search(r"^All tests passed \(.* in (\d+) test case", output, re.MULTILINE):
        found.append((int(match[1]), 0, 0))
    if match := re.search(r"^test cases: +(\d+) \|(?: +(\d+) passed \|)? +(\d+) failed", output, re.MULTILINE):
        found.append((int(match[2] or 0), int(match[3]), 0))
    if not found:
        found.append((1, 0, 0) if is_well else (0, 1, 0))
    passed, failed, skipped = map(sum, zip(*found))
    if not is_well and not failed:  # it said that all is well, and broke nevertheless
        failed = 1
    return passed, failed, skipped


def outcome(group):
    """(passed, failed, skipped) of a group in CTest's results."""
    reason = group.find("skipped")
    if reason is not None and "SKIP_RETURN_CODE" in reason.get("message"):
        return 0, 0, 1
    return count(group.findtext("system-out", ""), group.get("status") == "run")


def wording(passed, failed, skipped):
    """Counts in words."""
    return f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else "")


def report(results):
    """Prints the lines of all groups, and what broke in them; returns the sums of their counts."""
    total, broken = [0, 0, 0], []
    for group in results.iter("testcase"):
        name, counts = group.get("name"), outcome(group)
        if name.startswith("build ") and not counts[1]:
            counts = (0, 0, 0)  # what was built is no test
        output = group.findtext("system-out", "")
        kept = sum(map(int, re.findall(r"^kept: (\d+) tests", output, re.MULTILINE)))
        print(f"{name:26} {wording(*counts):38} {float(group.get('time')):6.1f} s" + (f", {kept} of them passed before" if kept else ""))
        if counts[2]:
            print("\n".join(f"    {line}" for line in output.splitlines() if "skipped" in line.lower() and "summary" not in line))
        if counts[1]:
            broken += [f"{name}: {line}" for line in what_broke(output)]
        total = [one + other for one, other in zip(total, counts)]
    print("".join(f"{line[:600]}\n" for line in broken), end="")  # last, where whoever keeps but the end finds it
    return total


def main():
    """Reads the command line, runs the groups and reports."""
    parser = argparse.ArgumentParser(prog="motus test")
    parser.add_argument("--blenders", default="", help="which Blenders to run in, everything that they can")
    parser.add_argument(
        "--all",
        action="store_true",
        help="run in each Blender everything that it can, and test the library by other compilers and for other systems and processors",
    )
    parser.add_argument("--only", default="", help="only the groups whose name contains one of these")
    parser.add_argument("--again", action="store_true", help="run again what has passed before, just as it is")
    parser.add_argument("patterns", nargs="*", help="only the tests whose name contains one of these")
    options = parser.parse_args()

    only = re.split(r",(?! )", options.only)  # a group's name may have a comma, with a space behind it
    names = blenders.NAMES if options.all else [name for name in options.blenders.split(",") if name]
    groups = inside.planned(names, only, has_blender)
    os.environ["MOTUS_WITHOUT"] = " ".join(groups.missing)  # its absence is said once, and not looked for again
    # A part of a name that means every group of the library, such as "lib", does not mean these.
    elsewhere = [
        preset for preset in ELSEWHERE if options.all or any(part in f"library, {preset}" and part not in "library, " for part in only)
    ]
    fuzzed = [topic for topic in FUZZED if not options.patterns and (options.all or any(part and part in f"fuzz {topic}" for part in only))]
    farm = ["farm"] if options.all or any(part and part in "farm" for part in only) else []
    with passed_before(options.again), bytecode.kept_for_children():
        configure(groups, farm=farm, elsewhere=elsewhere, fuzzed=fuzzed, patterns=options.patterns, **released.planned(only, options.all))
        status = run_groups(only)
    results = ElementTree.parse(RESULTS) if RESULTS.exists() else None  # none where CTest itself was ended
    if results is None or results.find("testcase") is None:
        sys.exit(f"motus: CTest has run no group (--only {options.only})")
    total = report(results)
    seconds = round(time.time() - int(os.environ["MOTUS_STARTED"]))
    print(f"{wording(*total)} in {seconds // 60} min {seconds % 60} s", flush=True)
    sys.exit(1 if total[1] or status else 0)


main()
