"""All tests, two groups at a time; called by `./motus test`, which has built and packaged everything before.

test.py [--blenders 3.4,4.3,5.2] [--only NAME,...] [PATTERN...]
Prints one line a group, the output of those that failed, and last `N passed, N failed[, N skipped]`.
"""

import argparse
import concurrent.futures
import contextlib
import os
import re
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

CLONE = Path(__file__).resolve().parents[1]
MOTUS = str(CLONE / "motus")
BUILD = Path(os.environ["MOTUS_BUILD"])
CI = CLONE / ".ci"
PYTHON = sys.executable
TIMEOUT = 1200  # seconds for one group
SKIPPED = 77  # exit status: this machine cannot run the group


@dataclass(frozen=True)
class Group:
    name: str
    command: list
    profile: bool = False  # in a temporary Blender profile


@dataclass
class Outcome:
    passed: int = 0
    failed: int = 0
    skipped: int = 0
    output: str = ""
    seconds: float = 0.0
    counts: str = field(init=False, default="")

    def __post_init__(self):
        self.counts = f"{self.passed} passed, {self.failed} failed"
        if self.skipped:
            self.counts += f", {self.skipped} skipped"


def shell(script):
    return ["bash", "-euo", "pipefail", "-c", script]


def catch(program, patterns):
    return [str(program), "--order", "rand", "--rng-seed", "1", ",".join(f'"*{pattern}*"' for pattern in patterns)]


def sources(*folders):
    return [str(path) for folder in folders for path in sorted((CLONE / folder).rglob("*.[ch]pp"))]


def blender_groups(version, patterns):
    window = [PYTHON, str(CLONE / "blend_tests" / "window" / "run.py"), version, *patterns]
    inside = [MOTUS, "blender", "--version", version, "--background", "--factory-startup", "--python-exit-code", "1",
              "--python", str(CLONE / "blend_tests" / "run.py"), "--", *patterns]
    yield Group(f"blender {version}", inside, profile=True)
    yield Group(f"window {version}", window, profile=True)
    if tuple(map(int, version.split("."))) >= (4, 2):
        yield Group(f"validate {version}", [MOTUS, "validate", version])


def all_groups(blenders, patterns):
    """Long ones first, so that the two workers end together. With patterns, only the groups that have named tests."""
    abis = subprocess.run([MOTUS, "abis"], text=True, check=True, capture_output=True).stdout.split()
    for version in blenders:
        yield from (group for group in blender_groups(version, patterns) if not (patterns and "validate" in group.name))
    sanitized = BUILD / "sanitize" / "native" / "motus_tests"
    yield Group("library, sanitized", shell(f"{MOTUS} build sanitize && " + quoted(catch(sanitized, patterns))))
    yield Group("library", shell(f"{MOTUS} build release motus_tests motus_bench_objects && " + quoted(catch(BUILD / "release/native/motus_tests", patterns))))
    yield Group("binding", [MOTUS, "python", str(CLONE / "native" / "tests" / "python" / "run.py"), *patterns])
    yield Group("command", [PYTHON, str(CI / "tests" / "run.py"), *patterns])
    if not patterns:
        yield Group("clang-tidy", [PYTHON, str(CI / "tidy.py"), str(BUILD)])
        yield Group("clang-format", ["clang-format", "--dry-run", "-Werror", *sources("native")])
        yield Group("shellcheck", ["shellcheck", MOTUS, str(CI / "run"), *map(str, sorted(CI.glob("*.sh")))])
        yield Group("native modules", [PYTHON, str(CI / "check_modules.py"), str(BUILD / "release" / "python"), *abis])


def quoted(command):
    return " ".join("'" + part.replace("'", "'\\''") + "'" for part in command if part)


def count(output, status):
    """What a group's output says: the summary lines of suite.py, or Catch2's; one test where it has neither."""
    found = [tuple(map(int, match)) for match in
             re.findall(r"^summary: (\d+) passed, (\d+) failed, (\d+) skipped", output, re.MULTILINE)]
    if match := re.search(r"^All tests passed \(.* in (\d+) test case", output, re.MULTILINE):
        found.append((int(match[1]), 0, 0))
    if match := re.search(r"^test cases: +(\d+) \|(?: +(\d+) passed \|)? +(\d+) failed", output, re.MULTILINE):
        found.append((int(match[2] or 0), int(match[3]), 0))
    if not found:
        found.append((1, 0, 0) if status == 0 else (0, 1, 0))
    passed, failed, skipped = map(sum, zip(*found))
    if status != 0 and not failed:  # it said that all is well, and broke nevertheless
        failed = 1
    return passed, failed, skipped


def run(group):
    started = time.monotonic()
    with contextlib.ExitStack() as stack:
        environment = dict(os.environ)
        if group.profile:
            environment["MOTUS_PROFILE"] = stack.enter_context(tempfile.TemporaryDirectory(prefix="motus-profile-"))
        try:
            done = subprocess.run(group.command, env=environment, cwd=CLONE, timeout=TIMEOUT, check=False, text=True,
                                  errors="replace", stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            output, status = done.stdout, done.returncode
        except subprocess.TimeoutExpired as expired:
            output = (expired.stdout or b"").decode(errors="replace") + f"\nended after {TIMEOUT} s"
            status = 1
    counts = (0, 0, 1) if status == SKIPPED else count(output, status)
    return Outcome(*counts, output=output, seconds=time.monotonic() - started)


def report(group, outcome):
    print(f"{group.name:20} {outcome.counts:38} {outcome.seconds:6.1f} s", flush=True)
    if outcome.failed:
        print(f"--- output of {group.name} ---\n{outcome.output.rstrip()}\n--- end of {group.name} ---", flush=True)
    elif outcome.skipped:
        reasons = [line for line in outcome.output.splitlines() if "skipped" in line.lower() and "summary" not in line]
        print("\n".join(f"    {line}" for line in reasons), flush=True)


def main():
    parser = argparse.ArgumentParser(prog="motus test")
    parser.add_argument("--blenders", default="3.4,4.3,5.2", help="which Blenders to run in")
    parser.add_argument("--only", default="", help="only the groups whose name contains one of these")
    parser.add_argument("patterns", nargs="*", help="only the tests whose name contains one of these")
    options = parser.parse_args()

    names = options.only.split(",")
    groups = [group for group in all_groups([version for version in options.blenders.split(",") if version], options.patterns)
              if any(name in group.name for name in names)]
    if not groups:
        parser.error(f"no group's name contains {options.only}")
    total = [0, 0, 0]
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        running = {pool.submit(run, group): group for group in groups}
        for future in concurrent.futures.as_completed(running):
            outcome = future.result()
            report(running[future], outcome)
            total = [total[0] + outcome.passed, total[1] + outcome.failed, total[2] + outcome.skipped]
    passed, failed, skipped = total
    print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""), flush=True)
    sys.exit(1 if failed else 0)


main()
