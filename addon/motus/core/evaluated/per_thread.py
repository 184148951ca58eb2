"""Arrays that a thread uses again, and its Python state."""

from __future__ import annotations

from typing import Any

from .. import keeping, native
from ..lazy import numpy as np

_ARRAYS = keeping.OfThread("arrays whose content is undefined, to be filled", "a name; another shape replaces the array", most=64)


def keep_state() -> bool:
    """Let this thread keep its Python state; to make one anew takes longer than most solves do.

    The native module does it once a thread, and for a bounded number of threads. Returns whether it is kept.
    """
    return native.module is not None and native.module.keep_thread_state()


def scratch(name: str, shape: tuple[int, ...], dtype: Any) -> Any:
    """An array with undefined content for reuse on every frame; valid until the same thread asks for the same name again.

    Reuse saves time: the system would map the memory of a fresh large array anew on each frame.
    """
    arrays = _ARRAYS.here()
    array = arrays.get(name)
    if array is None or array.shape != shape:
        array = arrays.add(name, np.empty(shape, dtype))
    return array
