"""Arrays that a thread uses again for every solve: fresh ones would have their memory mapped anew on each frame."""

import threading

from ..lazy import numpy as np

_kept = threading.local()


def scratch(name, shape, dtype):
    """An array of this shape whose content is undefined; valid until the thread asks for the same name again."""
    array = getattr(_kept, name, None)
    if array is None or array.shape != shape:
        array = np.empty(shape, dtype)
        setattr(_kept, name, array)
    return array
