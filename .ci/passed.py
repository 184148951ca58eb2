"""What has passed before, just as it is, passes again without being run.

passed.py CACHE_FOLDER FILE_OR_FOLDER... -- COMMAND...
Runs a command, or prints what it printed when it passed with the same arguments and the same bytes in those files and in the libraries that
the program loads, with the same options of sanitizers, on such a processor.
The output of tests that passed is a file in CACHE_FOLDER, named by a number for all that.
"""

import hashlib
import os
import re
import subprocess
import sys
import time
from pathlib import Path

UNUSED = 60 * 24 * 3600  # seconds after which a state that nobody has come to is forgotten


class States:
    """A folder with a file for each state of something that has passed, with what was said of it."""

    def __init__(self, folder):
        self._folder = Path(folder)
        self._folder.mkdir(parents=True, exist_ok=True)

    def said(self, state):
        """What was said when a state passed; None if it has not."""
        file = self._folder / state
        if not file.exists():
            return None
        file.touch()
        return file.read_text(encoding="utf-8")

    def note(self, state, said=""):
        """Keep that a state has passed."""
        file = self._folder / state
        being_written = file.with_suffix(".new")
        being_written.write_text(said, encoding="utf-8")
        being_written.replace(file)

    def forget_unused(self):
        """Remove the states that have not been met for a long time."""
        for file in self._folder.iterdir():
            if time.time() - file.stat().st_mtime > UNUSED:
                file.unlink(missing_ok=True)


def number_of(parts):
    """One number for texts."""
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def contents(path):
    """A line for a file, or for each in a folder: its name there, and a number for its bytes."""
    files = sorted(found for found in path.rglob("*") if found.is_file()) if path.is_dir() else [path]
    return [f"{file.relative_to(path.parent)} {hashlib.sha256(file.read_bytes()).hexdigest()}" for file in files]


def processor():
    """What a processor is able to do: libraries choose their code by that."""
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    return next((line for line in lines if line.startswith(("flags", "Features"))), "")


def libraries(program):
    """Paths of the shared libraries that a program loads; none of what is no such program."""
    done = subprocess.run(["ldd", program], check=False, text=True, capture_output=True)
    return [Path(found) for found in re.findall(r"(/\S+) \(0x", done.stdout)]


def options():
    """The environment variables that change how sanitizers and the C library work."""
    return [f"{name}={value}" for name, value in sorted(os.environ.items()) if re.search(r"SAN_OPTIONS$|^GLIBC_|^MALLOC_|^LD_", name)]


def main(cache, *arguments):
    """Returns the exit status of the command, or of what it was before."""
    middle = arguments.index("--")
    paths, command = map(Path, arguments[:middle]), arguments[middle + 1 :]
    states = States(cache)
    files = [*paths, *libraries(command[0])]
    state = number_of([processor(), *options(), *command[1:], *(line for path in files for line in contents(path))])
    said = states.said(state)
    if said is not None:
        print(f"{said}This has passed before, just as it is.")
        return 0
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, encoding="utf-8", errors="replace") as running:
        lines = []
        for line in running.stdout:
            print(line, end="", flush=True)
            lines.append(line)
    if running.returncode == 0:
        states.note(state, "".join(lines))
        states.forget_unused()
    return running.returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
