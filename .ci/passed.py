"""What has passed before, just as it is, passes again without being run.

passed.py [--system] CACHE_FOLDER FILE_OR_FOLDER... -- COMMAND...
Runs a command, or prints what it printed when it passed with the same arguments and the same bytes in those files and in the libraries that
the program loads, with the same options of sanitizers, on such a processor.
--system: and with the same programs of the system, and of those that pyproject.toml pins and CACHE_FOLDER/../programs has, which the command
starts. Only Debian says what is installed, so elsewhere such a command is always run.
The output of tests that passed is a file in CACHE_FOLDER, named by a number for all that. Tests of which some were skipped have not passed:
what they lacked may be there the next time.
"""

import contextlib
import hashlib
import os
import re
import subprocess
import sys
import time
from pathlib import Path

PACKAGES = Path("/var/lib/dpkg/status")
"""Debian's list of the installed packages, with their versions."""
SKIPPED = re.compile(r"^summary: .* [1-9]\d* skipped", re.MULTILINE)
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
        being_written = file.with_suffix(f".{os.getpid()}.new")  # of this process alone: two clones may come to one state at the same time
        being_written.write_text(said, encoding="utf-8")
        being_written.replace(file)

    def forget_unused(self):
        """Remove the states that have not been met for a long time."""
        for file in self._folder.iterdir():
            with contextlib.suppress(FileNotFoundError):  # another clone has forgotten it just now
                if time.time() - file.stat().st_mtime > UNUSED:
                    file.unlink()


def number_of(parts):
    """One number for texts."""
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def contents(path):
    """A line for a file, or for each in a folder: its name there, and a number for its bytes. What Python compiles is made of the others."""
    found = (file for file in path.rglob("*") if file.is_file() and "__pycache__" not in file.parts) if path.is_dir() else [path]
    return [f"{file.relative_to(path.parent)} {hashlib.sha256(file.read_bytes()).hexdigest()}" for file in sorted(found)]


def processor():
    """What a processor is able to do: libraries choose their code by that."""
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    return next((line for line in lines if line.startswith(("flags", "Features"))), "")


def libraries(program):
    """Paths of the shared libraries that a program loads; none of what is no such program."""
    done = subprocess.run(["ldd", program], check=False, text=True, capture_output=True)
    return [Path(found) for found in re.findall(r"(/\S+) \(0x", done.stdout)]


def installed(programs, packages=PACKAGES):
    """Lines that say which programs there are: the system's packages, what is on the PATH beside them, and what pip has installed of what is pinned.

    Below `programs` there may be more: what other clones pin.
    """
    if not packages.exists():
        return [f"unknown at {time.time_ns()}"]
    places = [Path(folder) for folder in os.get_exec_path() if Path(folder).is_dir()]
    on_path = [(file, file.stat()) for folder in places for file in sorted(folder.iterdir()) if file.is_file()]
    import pinned  # here, since it does not load in Blender for Windows, whose tests only ask which files have passed

    own = (place for place, _ in pinned.groups(programs).values())
    by_pip = sorted(file.relative_to(programs).as_posix() for place in own for file in place.glob("lib/python*/site-packages/*.dist-info"))
    return [*contents(packages), *(f"{file} {state.st_size} {state.st_mtime_ns}" for file, state in on_path), *by_pip]


def options():
    """The environment variables that change how sanitizers and the C library work."""
    return [f"{name}={value}" for name, value in sorted(os.environ.items()) if re.search(r"SAN_OPTIONS$|^GLIBC_|^MALLOC_|^LD_", name)]


def main(*arguments):
    """Returns the exit status of the command, or of what it was before."""
    has_system = arguments[0] == "--system"
    cache, *arguments = arguments[has_system:]
    middle = arguments.index("--")
    paths, command = map(Path, arguments[:middle]), arguments[middle + 1 :]
    states = States(cache)
    files = [*paths, *libraries(command[0])]
    system = installed(Path(cache).resolve().parent / "programs") if has_system else []
    state = number_of([processor(), *options(), *system, *command[1:], *(line for path in files for line in contents(path))])
    said = states.said(state)
    if said is not None:
        print(f"{said}This has passed before, just as it is.")
        return 0
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, encoding="utf-8", errors="replace") as running:
        lines = []
        for line in running.stdout:
            print(line, end="", flush=True)
            lines.append(line)
    if running.returncode == 0 and not SKIPPED.search("".join(lines)):
        states.note(state, "".join(lines))
        states.forget_unused()
    return running.returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
