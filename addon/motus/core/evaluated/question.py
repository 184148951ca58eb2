"""What is found while one question about tracks is answered, such as for the values of one.

Things that hang on each other, each moved by a system that is asked where it is, lead to the same ones again and again: without
this each level would take several times as long as the one above it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Hashable
from typing import Any

_found: dict[int, dict[Hashable, Any]] = {}
"""Thread -> {place: answer} of the question that it answers."""


def answered(place: Hashable, make: Callable[[], Any]) -> Any:
    """What make() gives, the same for the same place until the outermost question is answered. It must not be changed."""
    thread = threading.get_ident()
    found = _found.get(thread)
    if found is None:
        found = _found[thread] = {}
        try:
            return make()
        finally:
            del _found[thread]
    if place not in found:
        found[place] = make()
    return found[place]
