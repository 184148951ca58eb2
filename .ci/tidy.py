"""clang-tidy over the library and the bindings.

tidy.py BUILD_FOLDER CACHE_FOLDER
A source that has passed passes again without clang-tidy, as long as nothing has changed that its findings depend on: its own text and that of
all it includes, how it is compiled, .clang-tidy, and clang-tidy itself (passed.py).
The bindings are compiled once for each Python; they are checked with this machine's alone, whose headers clang can read.
"""

import concurrent.futures
import functools
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import passed
import tidy_groups

FOLDERS = ("native/src", "native/bindings")
CLONE = Path(__file__).resolve().parents[1]


def output_of(*command):
    """What a command prints."""
    return subprocess.run(command, text=True, check=True, capture_output=True).stdout


@functools.cache
def text_digest(path):
    """A number for the text of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def included(build):
    """{object file: paths of all that it was compiled from}, as Ninja knows them; without those that are to be compiled anew."""
    found = {}
    for block in output_of("ninja", "-C", str(build), "-t", "deps").split("\n\n"):
        head, *lines = block.splitlines() or [""]
        if head.endswith("(VALID)"):
            found[head.split(":")[0]] = [(build / line.strip()).resolve() for line in lines]
    return found


def name_of(path):
    """Of the clone's files without the clone's own place: what has passed in one clone has in the next."""
    return str(path.relative_to(CLONE) if path.is_relative_to(CLONE) else path)


def state(entry, sources, tool):
    """One number for all that the findings in a source depend on."""
    command = re.sub(r" -o \S+", "", entry["command"].replace(str(CLONE), ""))
    parts = [tool, (CLONE / ".clang-tidy").read_text(encoding="utf-8"), command]
    parts += sorted(f"{name_of(path)} {text_digest(path)}" for path in sources)
    return passed.number_of(parts)


def main(build_folder, cache_folder):
    """Checks the sources whose states have not passed before; returns the exit status."""
    build, kept = Path(build_folder, "release"), passed.States(cache_folder)
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    entries = [
        entry
        for entry in entries
        if "motus_native_cp" not in entry["command"] and any(Path(entry["file"]).is_relative_to(CLONE / folder) for folder in FOLDERS)
    ]
    tool, compiled_from = output_of("clang-tidy", "--version"), included(build)
    states = {}
    for entry in entries:
        sources = compiled_from.get(re.search(r" -o (\S+)", entry["command"])[1])
        states[entry["file"]] = state(entry, sources, tool) if sources else ""
    is_new = [not states[entry["file"]] or kept.said(states[entry["file"]]) is None for entry in entries]
    waiting, failed = [tidy_groups.Source(entry) for entry, new in zip(entries, is_new) if new], 0
    # The bindings take longest by far.
    waiting.sort(key=lambda source: "bindings" not in str(source.path))
    with tempfile.TemporaryDirectory(prefix="motus-tidy-") as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for source, is_clean, output in tidy_groups.check_all(waiting, folder, pool):
            if not is_clean:
                failed += 1
                print(f"FAILED {name_of(source.path)}\n{output}", flush=True)
            elif states[str(source.path)]:
                kept.note(states[str(source.path)])
    kept.forget_unused()
    print(f"{len(entries) - len(waiting)} of {len(entries)} sources have passed before, just as they are")
    print(f"summary: {len(entries) - failed} passed, {failed} failed, 0 skipped")
    return 1 if failed or not entries else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
