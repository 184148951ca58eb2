"""Arrays that a thread uses again for every solve: fresh ones would have their memory mapped anew on each frame."""

from ..lazy import numpy as np
from .per_thread import kept


def scratch(name, shape, dtype):
    """An array of this shape whose content is undefined; valid until the thread asks for the same name again."""
    arrays = kept("scratch", dict)
    array = arrays.get(name)
    if array is None or array.shape != shape:
        array = arrays[name] = np.empty(shape, dtype)
    return array
