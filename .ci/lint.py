"""Runs the linters and formatters: lint.py --programs FOLDER [--fix] [TOOL...]; called by `./motus lint`.

The tools' settings, and the versions of those that are fetched, stand in pyproject.toml. A tool that cannot be had is skipped, which is
said and counted. With --fix the tools that can mend what they find do so, one after the other; the others check as without.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import pinned

CI = Path(__file__).resolve().parent


class Places(NamedTuple):
    """The folders that the tools work in."""

    clone: Path  # whose files are checked
    programs: Path  # pip installs into it; clones share it


class Tool(NamedTuple):
    """A linter or formatter: how it is called to check the files of a clone, and to mend them."""

    name: str
    program: str
    source: str  # "pip" or "go", by which it is fetched as pyproject.toml pins it; "system", which has it or not
    check: Callable  # arguments, of (places, files); None means that there is nothing to check
    fix: Callable | None = None


class Outcome(NamedTuple):
    """What a tool has found."""

    name: str
    verdict: str  # passed, FAILED or SKIPPED
    output: str
    seconds: float


def named(files, *endings):
    """Those of `files` whose name ends in one of `endings`."""
    return [path for path in files if path.endswith(endings)]


def shell_scripts(places, files):
    """Those of `files` that a shell runs, by their first line."""
    found = []
    for path in files:
        with open(places.clone / path, "rb") as file:
            if re.match(rb"#!.*\b(ba|da|)sh\b", file.readline(80)):
                found.append(path)
    return found


def with_files(*options, choose):
    """Arguments for a tool that is given the names of the files: `options`, then the files that `choose(places, files)` returns."""

    def arguments(places, files):
        chosen = choose(places, files)
        return [*options, *chosen] if chosen else None

    return arguments


def _cpp(_, files):
    return named(files, ".cpp", ".hpp")


def _workflows(_, files):
    return [path for path in named(files, ".yml", ".yaml") if path.startswith(".github/workflows/")]


def _all(_, files):
    return files


TOOLS = (
    Tool("ruff", "ruff", "pip", lambda *_: ["check", "--quiet"], lambda *_: ["check", "--quiet", "--fix"]),
    Tool("ruff-format", "ruff", "pip", lambda *_: ["format", "--quiet", "--diff"], lambda *_: ["format", "--quiet"]),
    Tool("mypy", "mypy", "pip", lambda *_: []),
    Tool("codespell", "codespell", "pip", with_files(choose=_all), with_files("--write-changes", choose=_all)),
    Tool("shellcheck", "shellcheck", "system", with_files("--external-sources", "--check-sourced", choose=shell_scripts)),
    Tool("actionlint", "actionlint", "go", with_files(choose=_workflows)),
    Tool("clang-format", "clang-format", "system", with_files("--dry-run", "-Werror", choose=_cpp), with_files("-i", choose=_cpp)),
    Tool("clang-tidy", str(CI.parent / "motus"), "system", lambda *_: ["tidy"]),
)


def files_of(clone):
    """Names of the files that belong to a clone: those that Git knows, and new ones that it does not ignore."""
    command = ("git", "-C", str(clone), "ls-files", "-z", "--cached", "--others", "--exclude-standard")
    names = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split("\0")
    return [name for name in dict.fromkeys(names) if name and (clone / name).is_file()]


def run(tool, places, files, fetched, fix):
    """The Outcome of one tool. fetched: {source: (the folder with its programs, "")}, or (None, why they cannot be had)."""
    began = time.monotonic()
    programs, why_not = fetched.get(tool.source, (None, ""))
    if why_not:
        return Outcome(tool.name, "SKIPPED", f"it could not be installed by {tool.source}: {why_not}", 0.0)
    program = str(programs / tool.program) if programs else shutil.which(tool.program)
    if not program or (tool.name.startswith("clang") and not shutil.which(tool.name)):
        return Outcome(tool.name, "SKIPPED", "it is not on this machine", 0.0)
    arguments = (tool.fix if fix and tool.fix else tool.check)(places, files)
    if arguments is None:
        return Outcome(tool.name, "passed", "", 0.0)
    done = subprocess.run(
        [program, *arguments],
        cwd=places.clone,
        check=False,
        text=True,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    return Outcome(tool.name, "FAILED" if done.returncode else "passed", done.stdout, time.monotonic() - began)


def lint(places, names=(), fix=False):
    """Runs the tools of these names, or all, two at a time; prints what they find, and returns the exit status."""
    tools = [tool for tool in TOOLS if not names or tool.name in names]
    files = files_of(places.clone)
    sources = {tool.source for tool in tools}
    fetched = {}
    if "pip" in sources:
        fetched["pip"] = pinned.installed("lint", places.programs, places.clone)
    if "go" in sources:
        fetched["go"] = pinned.built("actionlint", places.programs, places.clone)
    counts = dict.fromkeys(("passed", "FAILED", "SKIPPED"), 0)
    with ThreadPoolExecutor(1 if fix else os.cpu_count()) as pool:
        for outcome in pool.map(lambda tool: run(tool, places, files, fetched, fix), tools):
            counts[outcome.verdict] += 1
            if outcome.verdict != "passed":
                print(outcome.output.rstrip() if outcome.verdict == "FAILED" else f"SKIPPED {outcome.name}: {outcome.output}")
            print(f"{outcome.verdict:8}{outcome.name:14}{outcome.seconds:6.1f} s", flush=True)
    print(f"summary: {counts['passed']} passed, {counts['FAILED']} failed, {counts['SKIPPED']} skipped")
    return 1 if counts["FAILED"] else 0


def main():
    """Reads the command line."""
    parser = argparse.ArgumentParser(prog="motus lint")
    parser.add_argument("--programs", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--fix", action="store_true", help="mend what the tools can mend")
    parser.add_argument("tools", nargs="*", metavar="TOOL", help=f"which of {', '.join(tool.name for tool in TOOLS)}; all without any")
    options = parser.parse_args()
    if unknown := set(options.tools) - {tool.name for tool in TOOLS}:
        parser.error(f"there is no such tool: {', '.join(sorted(unknown))}")
    return lint(Places(CI.parent, options.programs.resolve()), options.tools, options.fix)


if __name__ == "__main__":
    sys.exit(main())
