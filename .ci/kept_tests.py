"""Files of tests that have passed before, just as they are, and so does all that they depend on: suite.py passes them without running them.

A file of tests depends on what it imports from the folder of the tests, on the data files there, and on the files of the clone that Python
opens, lists, imports or hands to another program while its tests run, which are noted. And it depends on what is tested, and on what runs
the tests.
"""

import contextlib
import functools
import hashlib
import json
import os
import re
import sys
from pathlib import Path

import passed

CI = Path(__file__).resolve().parent
VARIABLE = "MOTUS_PASSED"
"""The environment variable that names the folder of the states that have passed; without it nothing is kept."""
RUNNERS = [
    CI / name for name in ("bytecode.py", "journal.py", "kept_tests.py", "module_program.py", "passed.py", "suite.py", "to_the_end.py")
]
IMPORT = re.compile(r"^\s*(?:from +([\w.]+) +import +(?:\((.*?)\)|([^\n#]*))|import +([^\n#]+))", re.MULTILINE | re.DOTALL)
MADE = {"__pycache__", "build", "out", ".git"}
"""Names of folders whose files are made anew all the time, and are no part of the clone."""


class KeptTests:
    """What has passed of the tests in a folder.

    modules: names of the modules with tests, which are as their files are now. about: lines that say what is tested, and by what. states:
    folder in which is kept what has passed. clone: folder whose files are looked after.
    """

    def __init__(self, folder, modules, about, states, clone=CI.parent):
        self._folder, self._clone, self._states = folder, clone, passed.States(states)
        self._heard = Heard(clone)
        data = [
            file
            for file in sorted(folder.rglob("*"))
            if file.is_file() and file.suffix != ".py" and MADE.isdisjoint(file.relative_to(folder).parts)
        ]
        files = (line for path in (*RUNNERS, *data, passed.PACKAGES) for line in passed.contents(path))
        common = [sys.version, passed.processor(), *passed.options(), *about, *files]
        self._state = {module: passed.number_of([*common, module, *_lines(folder, module)]) for module in modules}

    @classmethod
    def named(cls, folder, modules, about):
        """Those in the folder that the environment names; None if it names none. Only Debian says what is installed: elsewhere it is None too."""
        states = os.environ.get(VARIABLE)
        return (
            cls(Path(folder).resolve(), modules, about, states) if states and sys.platform == "linux" and passed.PACKAGES.exists() else None
        )

    def count(self, module):
        """How many tests a module has, if they passed before, just as they are; else 0."""
        said = self._states.said(self._state[module])
        if said is None:
            return 0
        noted = json.loads(said)
        is_same = all(_now(self._clone / name) == number for name, number in noted["read"].items())
        return noted["tests"] if is_same else 0

    @contextlib.contextmanager
    def watched(self, module):
        """While a module's tests run; gives what notes, with their number, that all of them passed."""
        with self._heard.paths() as paths:
            yield lambda tests: self._states.note(self._state[module], json.dumps({"tests": tests, "read": self._numbers(paths)}))

    def _numbers(self, paths):
        imported = [Path(file) for file in [getattr(module, "__file__", None) for module in list(sys.modules.values())] if file]
        own = {*paths, *(file for file in imported if file.is_relative_to(self._clone) and not file.is_relative_to(self._folder))}
        return {name: _now(self._clone / name) for name in sorted(file.relative_to(self._clone).as_posix() for file in own)}


class Heard:
    """The files and folders below `clone` that this process opens, lists, or hands to another program."""

    def __init__(self, clone):
        self._clone, self._paths = f"{clone}{os.sep}", None
        sys.addaudithook(self._hear)

    @contextlib.contextmanager
    def paths(self):
        """Gives a set of paths, which grows until the block has ended."""
        self._paths = set()
        try:
            yield self._paths
        finally:
            self._paths = None

    def _hear(self, event, arguments):
        if self._paths is None or event not in {"open", "os.listdir", "os.scandir", "subprocess.Popen"}:
            return
        for word in arguments[1] if event == "subprocess.Popen" else arguments[:1]:
            if isinstance(word, str | bytes | os.PathLike):
                path = os.path.abspath(os.fsdecode(word))
                if path.startswith(self._clone) and MADE.isdisjoint(path[len(self._clone) :].split(os.sep)):
                    self._paths.add(Path(path))


def _now(path):
    """A number for a file's bytes, or for the names in a folder; "" if there is neither."""
    if path.is_dir():
        return passed.number_of(sorted(one.name for one in path.iterdir() if one.name not in MADE))
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""


def _lines(folder, module):
    """Lines with a number for each source that a module is made of: its own, and all that it imports, directly or not, from `folder`.

    folder: on Python's path.
    """
    found, waiting = set(), [module]
    while waiting:
        for file in _files(folder, waiting.pop()):
            if file not in found:
                found.add(file)
                waiting += _read(file)[1]
    return [line for file in sorted(found) for line in _read(file)[0]]


@functools.cache
def _read(file):
    """(lines with a number for a source, dotted names of what it may import)."""
    return passed.contents(file), list(_named(file.read_text(encoding="utf-8")))


def _files(folder, name):
    """The files that Python runs when it imports a module of this dotted name from a folder: packages around it too."""
    parts = name.split(".")
    around = [folder.joinpath(*parts[:count], "__init__.py") for count in range(1, len(parts) + 1)]
    return [file for file in (*around, folder.joinpath(*parts).with_suffix(".py")) if file.is_file()]


def _named(text):
    """Dotted names of what a source may import."""
    for package, in_brackets, names, modules in IMPORT.findall(text):
        words = re.findall(r"[\w.]+", re.sub(r"#.*| as +\w+", "", in_brackets or names or modules))
        yield from (f"{package}.{word}" for word in words) if package else words
        if package:
            yield package
