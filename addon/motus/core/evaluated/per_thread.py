"""Arrays that a thread reuses from frame to frame, and the thread's Python state."""

from __future__ import annotations

from typing import Any

from .. import keeping, native
from ..lazy import numpy as np

_ARRAYS = keeping.OfThread(
    "scratch arrays, whose content is undefined", "name of the array; an array of a different shape replaces it", most=64
)


def keep_state() -> bool:
    """Keep the Python thread state of the current thread: to create a new one takes longer than most solver calls.

    The native module does it once for each thread, and for a limited number of threads. Returns whether the state is kept.
    """
    return native.module is not None and native.module.keep_thread_state()


def scratch(name: str, shape: tuple[int, ...], dtype: Any) -> Any:
    """An array with undefined content for reuse on every frame; valid until the same thread asks for the same name again.

    Reuse saves time: the operating system would map the memory of a new large array on each frame.
    """
    arrays = _ARRAYS.here()
    array = arrays.get(name)
    if array is None or array.shape != shape:
        array = arrays.add(name, np.empty(shape, dtype))
    return array
