"""Declarations of all values that Motus keeps in memory to use them again: caches with one of five lifetimes.

    OfEvaluation    what was read of an evaluated copy, until Blender makes a new copy of the datablock or frees the copy
    OfThread        what one thread of Blender uses again from call to call
    OfFile          until a different file is opened
    OfProcess       until the add-on is disabled
    OfLibrary       what the native library keeps by itself, until the add-on is disabled

A declaration is made once, when its module is imported. It says what is kept and by which key. The key holds all that the value is made
from: for animated input it holds the keys (a stamp, all samples), not the value at the present frame. docs/kept.md lists the declarations.
.ci/tests/test_kept.py finds values that are kept without a declaration. Results do not depend on kept values.
"""

from __future__ import annotations

import math
import sys
import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from typing import Any

MOST_THREADS = 64
_PACKAGE = __name__.rpartition(".core.")[0]
_NOTHING = object()

declared: list[_Declaration] = []
"""All declarations of kept values, in the order in which their modules were imported."""


class _Declaration:
    """Base of the declarations of kept values, which docs/kept.md lists.

    what: what is kept. key: by which key a value is found. bound: how much is kept at most. until: when values are removed. All four are
    phrases for docs/kept.md.
    """

    lifetime = until = ""

    def __init__(self, what: str, key: str, bound: str, until: str) -> None:
        self.what, self.key, self.bound = what, key, bound
        self.until = until or type(self).until
        self.module = _importing().removeprefix(f"{_PACKAGE}.")
        declared.append(self)

    @classmethod
    def declarations(cls) -> list[Any]:
        """List of all declarations of this class, such as OfFile: all whose values are removed by the same event."""
        return [one for one in declared if one.lifetime == cls.lifetime]

    def clear(self) -> None:
        """Remove all values that are kept under this declaration."""


def _importing() -> str:
    """Name of the module that is being imported at the moment, read from the call stack."""
    frame: Any = sys._getframe()
    while frame.f_code.co_name != "<module>":
        frame = frame.f_back
    return str(frame.f_globals["__name__"])


class Latest:
    """A cache of values by key, from which the least recently used values are removed (LRU).

    most: how many values may stay. most_size: how large all values together may be, measured by size(key, value). The value that was added
    last stays in any case. get(key): like dict.get; does not mark the value as used. Threads share the cache, so values must not be
    changed.
    """

    def __init__(self, most: float = math.inf, most_size: float = math.inf, size: Callable[[Any, Any], float] | None = None) -> None:
        self._most, self._most_size, self._size_of = most, most_size, size
        self._values: OrderedDict[Hashable, Any] = OrderedDict()
        self._size = 0.0
        self._is_filling = False  # more than half full: only then the order of use matters, and to mark a key takes as long as to find it
        self._changing = threading.RLock()
        self.get = self._values.get

    def __len__(self) -> int:
        return len(self._values)

    def items(self) -> list[tuple[Any, Any]]:
        """List of the (key, value) pairs of the cache, least recently used first."""
        with self._changing:
            return list(self._values.items())

    def find(self, key: Hashable, default: Any = None) -> Any:
        """Return the value of a key, or `default` if the key has no value.

        The key is marked as the most recently used one if the cache is more than half full.
        """
        found = self.get(key, default)
        if self._is_filling:
            self._use(key)
        return found

    def made(self, key: Hashable, make: Callable[[], Any]) -> Any:
        """Return the value of a key; if the key has no value, store and return what make() returns.

        The key is marked as the most recently used one if the cache is more than half full.
        """
        found = self.get(key, _NOTHING)
        if found is _NOTHING:
            return self.add(key, make())
        if self._is_filling:
            self._use(key)
        return found

    def _use(self, key: Hashable) -> None:
        with self._changing:
            if key in self._values:
                self._values.move_to_end(key)

    def add(self, key: Hashable, value: Any) -> Any:
        """Store a value under a key as the most recently used one; returns the value.

        Least recently used values are removed if the cache exceeds its limits.
        """
        with self._changing:
            self.drop(key)  # a different thread may have added the key meanwhile
            self._values[key] = value
            self._size += self._size_of(key, value) if self._size_of else 0
            self.trim(self._most)
            self._measure()
        return value

    def _measure(self) -> None:
        self._is_filling = 2 * len(self._values) > self._most or 2 * self._size > self._most_size

    def drop(self, key: Hashable) -> None:
        """Remove the value of a key from the cache, if there is one."""
        with self._changing:
            value = self._values.pop(key, _NOTHING)
            if value is not _NOTHING and self._size_of:
                self._size -= self._size_of(key, value)
            self._measure()

    def trim(self, most: float) -> None:
        """Remove least recently used values until at most `most` values remain and their total size is within the cache's limit.

        The value that was added last stays in any case.
        """
        with self._changing:
            while len(self._values) > 1 and (len(self._values) > most or self._size > self._most_size):
                self.drop(next(iter(self._values)))

    def clear(self) -> None:
        """Remove all values from the cache."""
        with self._changing:
            self._values.clear()
            self._size = 0.0
            self._measure()


class Room(dict[Any, Any]):
    """Dictionary of the values that a declaration keeps with one evaluated copy of a datablock. declaration: the OfEvaluation."""

    __slots__ = ("declaration",)
    declaration: OfEvaluation


class OfEvaluation(_Declaration):
    """Declaration of values that are kept with an evaluated copy of a datablock (core/evaluated/copies.py) and removed with it.

    Nothing else refers to the values, so a value may refer to data of the copy.
    """

    lifetime = "an evaluation"
    until = "Blender makes a new evaluated copy of the datablock, or frees the copy"

    def __init__(self, what: str, key: str, bound: str, until: str = "") -> None:
        super().__init__(what, key, bound, until)

    def on(self, copy: Any) -> dict[Any, Any]:
        """Dictionary of the values that this declaration keeps with an evaluated copy of a datablock.

        copy: Copy (core/evaluated/copies.py) of the datablock. None stands for a datablock that is not evaluated: the dictionary is new
        then, and nothing keeps it.
        """
        if copy is None:
            return {}
        found: dict[Any, Any] = copy.found
        return found[self] if self in found else self.within(found)

    def within(self, found: dict[Any, Any]) -> Room:
        """Return this declaration's dictionary in `found`; created if missing.

        found: {declaration: dictionary} of one evaluated copy, with which all the values are removed.
        """
        if self not in found:
            mine = Room()
            mine.declaration = self
            found.setdefault(self, mine)
        present: Room = found[self]
        return present


class WhileAnswering(OfEvaluation):
    """Declaration of values that are kept while a thread answers one question, such as where an object is over time.

    Answering leads to further questions on the same thread, which share the values; these are removed with the outermost answer.
    """

    def __init__(self, what: str, key: str) -> None:
        super().__init__(what, key, "the answers that one question needs, in each thread", "the thread has answered its outermost question")
        self._threads: dict[int, dict[Hashable, Any]] = {}

    def answered(self, place: Hashable, make: Callable[[], Any]) -> Any:
        """Return the value kept under the key `place`; if there is none, return make() and keep it.

        The value is kept until the thread's outermost question is answered, see the class. It must not be changed.
        """
        thread = threading.get_ident()
        found = self._threads.get(thread)
        if found is None:
            found = self._threads[thread] = {}
            try:
                return make()
            finally:
                self._threads.pop(thread, None)
        if place not in found:
            found[place] = make()
        return found[place]

    def clear(self) -> None:
        """Remove the answers that are kept for the questions of all threads."""
        self._threads.clear()


class OfThread(_Declaration):
    """Declaration of caches (Latest), one for each thread.

    threading.local cannot be used: Blender's evaluation threads drop their Python thread state, and thread-local values with it,
    after each call into Python, unless per_thread.keep_state() was called.
    """

    lifetime = "a thread"
    until = f"there are more than {MOST_THREADS} threads, or the add-on is disabled"

    def __init__(self, what: str, key: str, most: int) -> None:
        super().__init__(what, key, f"{most:,} in each thread", "")
        self._most = most

    def here(self) -> Latest:
        """The cache (Latest) that this declaration has for the current thread; created if missing."""
        thread = threading.get_ident()
        try:
            return _threads[thread][self]
        except KeyError:
            mine = _threads.get(thread)
        if mine is None:
            if len(_threads) >= MOST_THREADS:
                _threads.clear()  # most caches are of ended threads; running threads create theirs again
            mine = _threads[thread] = {}
        return mine.setdefault(self, Latest(self._most))

    def clear(self) -> None:
        """Remove the values of this declaration from the caches of all threads."""
        for mine in list(_threads.values()):
            mine.pop(self, None)


_threads: dict[int, dict[OfThread, Latest]] = {}
"""{identifier of a thread: {OfThread declaration: its cache for the thread}}."""


@contextmanager
def aside() -> Iterator[None]:
    """Context manager that gives the current thread empty OfThread caches, and restores the previous caches on exit.

    While a thread waits for a parallel computation, Blender may evaluate a different driver on this thread. That driver must not change the
    caches that the waiting driver uses.
    """
    thread = threading.get_ident()
    mine = _threads.pop(thread, None)
    try:
        yield
    finally:
        _threads.pop(thread, None)
        if mine is not None:
            _threads[thread] = mine


class OfFile(_Declaration, Latest):
    """Declaration of a cache (Latest) that is emptied when a different file is opened or the add-on is disabled.

    most, most_size, size: limits of the cache, as in Latest. unit: unit of the sizes, such as bytes, for docs/kept.md.
    """

    lifetime = "a file"
    until = "a different file is opened, or the add-on is disabled"

    def __init__(
        self,
        what: str,
        key: str,
        most: float = math.inf,
        most_size: float = math.inf,
        size: Callable[[Any, Any], float] | None = None,
        unit: str = "",
        until: str = "",
    ) -> None:
        Latest.__init__(self, most, most_size, size)
        size_bound = "" if most_size == math.inf else f"{int(most_size) >> 20:,} MiB" if unit == "bytes" else f"{most_size:,} {unit}"
        bounds = [one for one in ("" if most == math.inf else f"{most:,}", size_bound) if one]
        _Declaration.__init__(self, what, key, "; ".join(bounds), until)

    clear = Latest.clear


class OfProcess(OfFile):
    """Declaration of a cache (Latest) that is emptied only when the add-on is disabled.

    The key is the content that a value is made from, so that values stay valid when a different file is opened.
    """

    lifetime = "the process"
    until = "the add-on is disabled"


class OfLibrary(_Declaration):
    """Declaration of values that the native library keeps by itself. let_go: function without arguments that removes them, or None.

    The add-on works without a native library as far as to say that there is none; then let_go is None.
    """

    lifetime = "the native library"
    until = "the add-on is disabled"

    def __init__(self, what: str, key: str, bound: str, let_go: Callable[[], None] | None) -> None:
        super().__init__(what, key, bound, "")
        self._let_go = let_go

    def clear(self) -> None:
        """Remove the values of all scenes and threads."""
        if self._let_go is not None:
            self._let_go()


LIFETIMES = OfEvaluation, OfThread, OfFile, OfProcess, OfLibrary


def forget_file() -> None:
    """Remove the values that all OfFile declarations keep for the open file."""
    for one in OfFile.declarations():
        one.clear()


def forget_all() -> None:
    """Remove the kept values of all declarations, when the add-on is disabled and in tests.

    Results of Motus do not depend on kept values.
    """
    for one in declared:
        one.clear()
