"""Appends functions to Blender's lists of handlers, and takes them out again whatever other scripts have done to the lists."""

import bpy
from bpy.app.handlers import persistent


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
