"""What a thread keeps from one call to the next.

Not threading.local: Blender's evaluation threads have a Python state only while they run Python, and what is local to it
goes with it.
"""

import threading

LARGEST = 64  # threads

_kept = {}


def kept(name, make):
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
