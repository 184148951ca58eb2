"""Add functions to Blender's handler lists and remove them, even if different scripts have changed the lists meanwhile."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import bpy
from bpy.app.handlers import persistent

Pair = tuple[Any, Callable[..., Any]]
"""Type of a pair: a handler list of bpy.app.handlers, and a function to be added to the list."""

log = logging.getLogger(__name__)


def add(pairs: Iterable[Pair]) -> None:
    """Append functions to Blender's handler lists. pairs: (list of bpy.app.handlers, function) each."""
    for functions, function in pairs:
        functions.append(function)


def remove(pairs: Sequence[Pair]) -> None:
    """Remove functions from handler lists, last first; functions that are in their list no more are skipped.

    pairs: (list of bpy.app.handlers, function) each. A script may have cleared a list.
    """
    for functions, function in reversed(pairs):
        if function in functions:
            functions.remove(function)


class Forgetting:
    """Removes kept values: those of the file when a different file was opened, all of them when the add-on is disabled.

    forget: called when a file was opened. forget_all: called by unregister().
    """

    def __init__(self, forget: Callable[[], None], forget_all: Callable[[], None]) -> None:
        @persistent
        def loaded(*_: Any) -> None:
            forget()

        self._forget_all, self._pairs = forget_all, ((bpy.app.handlers.load_post, loaded),)

    def register(self) -> None:
        """Add the handler that calls `forget` when a file was opened."""
        add(self._pairs)

    def unregister(self) -> None:
        """Remove the handler, and call `forget_all`."""
        remove(self._pairs)
        self._forget_all()


def take_back(*steps: Callable[[], Any]) -> None:
    """Call each function of `steps`; log an exception of one step and go on with the next.

    A step fails if what it removes from Blender no longer exists.
    """
    for step in steps:
        try:
            step()
        except Exception as error:
            # If something no longer exists, Blender raises exceptions of many types, plain Exception among them.
            log.warning("Motus: something was gone already when the add-on was disabled: %s", error)
