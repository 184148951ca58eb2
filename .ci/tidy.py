"""clang-tidy over the library and the bindings: tidy.py BUILD_FOLDER CACHE_FOLDER

A source that has passed passes again without clang-tidy, as long as nothing has changed that its findings depend on: its own text and that of
all it includes, how it is compiled, .clang-tidy, and clang-tidy itself. CACHE_FOLDER has an empty file for each such state that has passed.
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
import time
from pathlib import Path

FOLDERS = ("native/src", "native/bindings")
CLONE = Path(__file__).resolve().parents[1]
UNUSED = 60 * 24 * 3600  # seconds after which a state that nobody has come to is forgotten


def output_of(*command):
    return subprocess.run(command, text=True, check=True, capture_output=True).stdout


@functools.cache
def text_digest(path):
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
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def check(entry, database):
    """(whether clang-tidy finds nothing, its output)."""
    done = subprocess.run(["clang-tidy", "-quiet", "-p", str(database.parent), entry["file"]], check=False, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode == 0, done.stdout


def forget_unused(cache):
    for stamp in cache.iterdir():
        if time.time() - stamp.stat().st_mtime > UNUSED:
            stamp.unlink(missing_ok=True)


def main(build_folder, cache_folder):
    build, cache = Path(build_folder, "release"), Path(cache_folder)
    cache.mkdir(parents=True, exist_ok=True)
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    entries = [entry for entry in entries if "motus_native_cp" not in entry["command"] and
               any(Path(entry["file"]).is_relative_to(CLONE / folder) for folder in FOLDERS)]
    database = Path(build_folder, "tidy", "compile_commands.json")
    database.parent.mkdir(exist_ok=True)
    database.write_text(json.dumps(entries), encoding="utf-8")

    tool, sources = output_of("clang-tidy", "--version"), included(build)
    waiting, failed = [], 0
    for entry in entries:
        compiled_from = sources.get(re.search(r" -o (\S+)", entry["command"])[1])
        stamp = cache / state(entry, compiled_from, tool) if compiled_from else None
        if stamp and stamp.exists():
            stamp.touch()
        else:
            waiting.append((entry, stamp))
    # The bindings take longest by far.
    waiting.sort(key=lambda one: "bindings" not in one[0]["file"])
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for (entry, stamp), (is_clean, output) in zip(waiting, pool.map(lambda one: check(one[0], database), waiting)):
            if not is_clean:
                failed += 1
                print(f"FAILED {name_of(Path(entry['file']))}\n{output}", flush=True)
            elif stamp:
                stamp.touch()
    forget_unused(cache)
    print(f"{len(entries) - len(waiting)} of {len(entries)} sources have passed before, just as they are")
    print(f"summary: {len(entries) - failed} passed, {failed} failed, 0 skipped")
    return 1 if failed or not entries else 0


sys.exit(main(*sys.argv[1:]))
