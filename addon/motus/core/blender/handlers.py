"""Registers handlers and takes back whatever was registered, whatever other scripts have done to it meanwhile."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import bpy
from bpy.app.handlers import persistent

Pair = tuple[Any, Callable[..., Any]]
"""A list of handlers, and a function for it."""

log = logging.getLogger(__name__)


def add(pairs: Iterable[Pair]) -> None:
    """pairs: (list of handlers, function)."""
    for functions, function in pairs:
        functions.append(function)


def remove(pairs: Sequence[Pair]) -> None:
    """Take back what add() did, last first. A script may have cleared the list."""
    for functions, function in reversed(pairs):
        if function in functions:
            functions.remove(function)


class Forgetting:
    """Has what belongs to the file forgotten when another one is opened, and all when the add-on is disabled."""

    def __init__(self, forget: Callable[[], None], forget_all: Callable[[], None]) -> None:
        @persistent
        def loaded(*_: Any) -> None:
            forget()

        self._forget_all, self._pairs = forget_all, ((bpy.app.handlers.load_post, loaded),)

    def register(self) -> None:
        """Forget with each file from now on."""
        add(self._pairs)

    def unregister(self) -> None:
        """Forget for the last time."""
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
            # Blender says that something is gone by errors of every kind, plain Exception among them.
            log.warning("Motus: something was gone already when the add-on was disabled: %s", error)
