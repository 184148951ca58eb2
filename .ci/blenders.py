"""The Blenders that Motus is tested in: `blenders.py` prints a line for ./motus each, `blenders.py NAME` the line of one.

A line is: name, kind, version, Debian system, Python; a dash stands for what a Blender has not.
"""

import re
import sys
from pathlib import Path
from typing import NamedTuple

REQUIREMENTS = Path(__file__).resolve().parent / "official"
"""What pip installs for each official Blender: NAME.txt, with exact versions and checksums."""


KINDS = {
    "program": "of this machine, or of the Debian in a folder that `root` names",
    "module": "official, a module of Python that pip installs",
    "windows": "the same for Windows, run by wine",
}
TESTS = {
    "whole": "the suite without a window",
    "window": "the tests in a window",
    "smoke": "a minute of every system",
    "packages": "what is released, for its system",
}


class Blender(NamedTuple):
    """A Blender, and what `./motus test` runs in it unless other is asked for."""

    name: str
    kind: str  # one of the keys of KINDS
    tests: frozenset  # kinds of tests, keys of TESTS
    root: str = ""  # Debian's suite: which system in a folder it runs in; empty: in this machine's own
    python: str = ""  # of a module: the one Python that can load it
    stands_in_for: str = ""  # the Blender in whose stead it runs the whole suite where that cannot be had

    @property
    def requirements(self):
        """The file that says what pip installs for a module."""
        return REQUIREMENTS / f"{self.name}.txt"

    @property
    def version(self):
        """Numbers of the version: the two of a program, the three of an official Blender."""
        if self.kind == "program":
            return self.name
        return re.search(r"^bpy==([0-9.]+)", self.requirements.read_text(encoding="utf-8"), re.MULTILINE)[1]

    @property
    def age(self):
        """What Blenders are sorted by."""
        return [*map(int, self.version.split("."))]


BLENDERS = (
    Blender("3.4", "program", frozenset({"whole", "window"})),
    Blender("4.2-lts", "module", frozenset({"smoke"}), python="3.11"),
    Blender("4.3", "program", frozenset({"smoke"}), root="trixie", stands_in_for="4.5-lts"),
    Blender("4.5-lts", "module", frozenset({"whole", "packages"}), python="3.11"),
    Blender("4.5-windows", "windows", frozenset({"packages"}), python="3.11"),
    Blender("5.2", "program", frozenset({"window", "smoke"}), root="sid", stands_in_for="5.2-lts"),
    Blender("5.2-lts", "module", frozenset({"whole", "packages"}), root="trixie", python="3.13"),
)
NAMES = tuple(one.name for one in BLENDERS if one.kind != "windows")
"""Those that run the add-on as it is built for this machine."""
PROGRAMS = tuple(one.name for one in BLENDERS if one.kind == "program")


def named(name):
    """The Blender of a name; one that the table does not know is a program of this machine, as BLENDER may name one."""
    return next((one for one in BLENDERS if one.name == name), Blender(name, "program", frozenset({"whole", "window"})))


def main(*names):
    """Prints the lines; returns the exit status: 1 where one of the names is unknown."""
    chosen = [one for one in BLENDERS if not names or one.name in names]
    for one in chosen:
        print(one.name, one.kind, one.version, one.root or "-", one.python or "-")
    return 0 if len(chosen) == len(names or BLENDERS) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
