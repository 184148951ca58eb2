"""What a thread keeps from one call to the next.

Not threading.local: Blender's evaluation threads have a Python state only while they run Python, unless keep_state() has
been called, and what is local to it goes with it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

from .. import native
from ..lazy import numpy as np

T = TypeVar("T")
LARGEST = 64  # threads

_kept: dict[int, dict[str, Any]] = {}


def keep_state() -> bool:
    """Let this thread keep its Python state; to make one anew takes longer than most solves do.

    The native module does it once a thread, and for a bounded number of threads. Returns whether it is kept.
    """
    return native.module is not None and native.module.keep_thread_state()


def kept(name: str, make: Callable[[], T]) -> T:
    """What `make()` gave when this thread first asked for the name."""
    thread = threading.get_ident()
    mine = _kept.get(thread)
    if mine is None:
        if len(_kept) >= LARGEST:
            _kept.clear()  # of threads that are gone, mostly; the others make theirs again
        mine = _kept[thread] = {}
    found = mine.get(name)
    if found is None:
        found = mine[name] = make()
    return found


@contextmanager
def aside() -> Iterator[None]:
    """What the thread keeps is left alone meanwhile, by whoever asks for it.

    While Blender waits for a computation that it has spread over threads, it may evaluate another driver within this one.
    """
    thread = threading.get_ident()
    mine = _kept.pop(thread, None)
    try:
        yield
    finally:
        _kept.pop(thread, None)
        if mine is not None:
            _kept[thread] = mine


def scratch(name: str, shape: tuple[int, ...], dtype: Any) -> Any:
    """An array of this shape whose content is undefined; valid until the thread asks for the same name again.

    For arrays of every solve: the memory of fresh ones would be mapped anew on each frame.
    """
    arrays: dict[str, Any] = kept("scratch", dict)
    array = arrays.get(name)
    if array is None or array.shape != shape:
        array = arrays[name] = np.empty(shape, dtype)
    return array
