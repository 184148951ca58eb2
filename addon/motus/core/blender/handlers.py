"""Registers handlers and takes back whatever was registered, whatever other scripts have done to it meanwhile."""

import logging

import bpy
from bpy.app.handlers import persistent

log = logging.getLogger(__name__)


def add(pairs):
    """pairs: (list of handlers, function)."""
    for functions, function in pairs:
        functions.append(function)


def remove(pairs):
    """Take back what add() did, last first. A script may have cleared the list."""
    for functions, function in reversed(pairs):
        if function in functions:
            functions.remove(function)


class Forgetting:
    """Has something forgotten that belongs to the file: when another one is opened, and when the add-on goes. One of a system's `extras`."""

    def __init__(self, forget):
        @persistent
        def loaded(*_):
            forget()

        self._forget, self._pairs = forget, ((bpy.app.handlers.load_post, loaded),)

    def register(self):
        """Forget with each file from now on."""
        add(self._pairs)

    def unregister(self):
        """Forget for the last time."""
        remove(self._pairs)
        self._forget()


def take_back(*steps):
    """Call each step. One that fails because its thing is gone already does not keep the others from being called."""
    for step in steps:
        try:
            step()
        except Exception as error:
            # Blender says that something is gone by errors of every kind, plain Exception among them.
            log.warning("Motus: something was gone already when the add-on was disabled: %s", error)
