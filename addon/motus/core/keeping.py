"""Everything that Motus keeps to be found again is declared here, with one of four lifetimes and no others.

    OfEvaluation    what was read of an evaluated copy, until Blender makes another copy of the datablock or frees it
    OfThread        what one thread of Blender's uses again from call to call
    OfFile          until another file is opened
    OfProcess       until the add-on is disabled

A declaration is made once, when its module is imported, and says what is kept and by which key. The key holds all that the
value is made from: what is keyed over time is there as its keys (a stamp, all samples), not as the value of the present frame.
docs/kept.md lists the declarations; .ci/tests/test_kept.py finds what is kept without one. Results are the same with nothing kept.
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
"""All declarations."""


class _Declaration:
    """what: is kept, key: by what it is found, bound: how much is kept at most, until: when it is let go; phrases for docs/kept.md."""

    lifetime = until = ""

    def __init__(self, what: str, key: str, bound: str, until: str) -> None:
        self.what, self.key, self.bound = what, key, bound
        self.until = until or type(self).until
        self.module = _importing().removeprefix(f"{_PACKAGE}.")
        declared.append(self)

    @classmethod
    def declarations(cls) -> list[Any]:
        """List of the declarations whose lifetime is that of this class."""
        return [one for one in declared if one.lifetime == cls.lifetime]

    def clear(self) -> None:
        """Remove all values that are kept under this declaration."""


def _importing() -> str:
    """Name of the module that is being imported."""
    frame: Any = sys._getframe()
    while frame.f_code.co_name != "<module>":
        frame = frame.f_back
    return str(frame.f_globals["__name__"])


class Latest:
    """A cache of values by key, from which the least recently used ones are let go (LRU).

    most: how many values may stay. most_size: how large all of them together may be, by size(key, value). The value that was
    added last stays in any case. get(key): as of a dict, without noting that the value is in use. Threads share the cache, so that
    nobody may change a value.
    """

    def __init__(self, most: float = math.inf, most_size: float = math.inf, size: Callable[[Any, Any], float] | None = None) -> None:
        self._most, self._most_size, self._size_of = most, most_size, size
        self._values: OrderedDict[Hashable, Any] = OrderedDict()
        self._size = 0.0
        self._changing = threading.RLock()
        self.get = self._values.get

    def __len__(self) -> int:
        return len(self._values)

    def items(self) -> list[tuple[Any, Any]]:
        """List of the (key, value) pairs of the cache, least recently used first."""
        with self._changing:
            return list(self._values.items())

    def find(self, key: Hashable, default: Any = None) -> Any:
        """The value of a key, which is in use from now on."""
        found = self.get(key, _NOTHING)
        if found is _NOTHING:
            return default
        # As long as there is much room left nobody needs to know what is in use, and to note it takes as long as to find it.
        if 2 * len(self._values) > self._most or 2 * self._size > self._most_size:
            self._use(key)
        return found

    def made(self, key: Hashable, make: Callable[[], Any]) -> Any:
        """The value of a key; where there is none, what make() gives, kept from now on."""
        found = self.get(key, _NOTHING)
        if found is _NOTHING:
            return self.add(key, make())
        if 2 * len(self._values) > self._most or 2 * self._size > self._most_size:  # as in find(), without another call
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
            self.drop(key)  # another thread may have added it meanwhile
            self._values[key] = value
            self._size += self._size_of(key, value) if self._size_of else 0
            self.trim(self._most)
        return value

    def drop(self, key: Hashable) -> None:
        """Let go of the value of a key, if there is one."""
        with self._changing:
            value = self._values.pop(key, _NOTHING)
            if value is not _NOTHING and self._size_of:
                self._size -= self._size_of(key, value)

    def trim(self, most: float) -> None:
        """Remove least recently used values until at most `most` values remain and their total size is within the cache's limit.

        The last value stays in any case.
        """
        with self._changing:
            while len(self._values) > 1 and (len(self._values) > most or self._size > self._most_size):
                self.drop(next(iter(self._values)))

    def clear(self) -> None:
        """Remove all values from the cache."""
        with self._changing:
            self._values.clear()
            self._size = 0.0


class Room(dict[Any, Any]):
    """Dictionary of the values that one OfEvaluation declaration keeps with one evaluated copy. declaration: that declaration."""

    __slots__ = ("declaration",)
    declaration: OfEvaluation


class OfEvaluation(_Declaration):
    """Kept with an evaluated copy (core/evaluated/copies.py), and with nobody else: a reference to the copy's data is allowed."""

    lifetime = "an evaluation"
    until = "Blender copies the datablock anew, or frees it"

    def __init__(self, what: str, key: str, bound: str, until: str = "") -> None:
        super().__init__(what, key, bound, until)

    def on(self, copy: Any) -> dict[Any, Any]:
        """The dict of what is kept with a Copy. Without a Copy, as of what is no evaluated one: empty, and kept by nobody."""
        if copy is None:
            return {}
        mine: Room | None = copy.found.get(self)
        return self.within(copy.found) if mine is None else mine

    def within(self, found: dict[Any, Any]) -> Room:
        """The dict of what is kept among `found` of a copy."""
        mine: Room | None = found.get(self)
        if mine is None:
            mine = Room()
            mine.declaration = self
            return found.setdefault(self, mine)
        return mine


class WhileAnswering(OfEvaluation):
    """Kept while a thread answers one question, which leads to others."""

    def __init__(self, what: str, key: str) -> None:
        super().__init__(what, key, "those of one question in each thread", "the outermost question is answered")
        self._threads: dict[int, dict[Hashable, Any]] = {}

    def answered(self, place: Hashable, make: Callable[[], Any]) -> Any:
        """What make() gives, the same for the same place until the outermost question is answered. It must not be changed."""
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
        """Remove the answers that all threads keep."""
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
        """The Latest of the thread that asks."""
        thread = threading.get_ident()
        mine = _threads.get(thread)
        if mine is None:
            if len(_threads) >= MOST_THREADS:
                _threads.clear()  # of threads that are gone, mostly; the others make theirs again
            mine = _threads[thread] = {}
        found = mine.get(self)
        if found is None:
            found = mine[self] = Latest(self._most)
        return found

    def clear(self) -> None:
        """Remove the values of this declaration from the caches of all threads."""
        for mine in list(_threads.values()):
            mine.pop(self, None)


_threads: dict[int, dict[OfThread, Latest]] = {}
"""Thread -> {OfThread: its Latest}."""


@contextmanager
def aside() -> Iterator[None]:
    """Context manager that gives the current thread empty OfThread caches, and restores the previous ones on exit.

    While a thread waits for a parallel computation, Blender may evaluate another driver on the same thread. That driver must not
    change the caches that the waiting driver uses.
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
    """Declaration of a cache (Latest) that is emptied when another file is opened or the add-on is disabled.

    most, most_size, size: limits of the cache, as in Latest. unit: unit of the sizes, such as bytes, for docs/kept.md.
    """

    lifetime = "a file"
    until = "another file is opened, or the add-on is disabled"

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

    The key is the content that a value is made from, so that values stay valid when another file is opened.
    """

    lifetime = "the process"
    until = "the add-on is disabled"


LIFETIMES = OfEvaluation, OfThread, OfFile, OfProcess


def forget_file() -> None:
    """Let go of what is kept for the open file."""
    for one in OfFile.declarations():
        one.clear()


def forget_all() -> None:
    """Remove the kept values of all declarations, when the add-on is disabled and in tests.

    Results of Motus do not depend on kept values.
    """
    for one in declared:
        one.clear()
