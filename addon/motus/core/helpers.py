"""Helpers: objects that work for others behind the scenes, such as hubs, proxies and the shapes of flakes.

A helper stands in no collection, so that neither the viewport nor the outliner shows it, nor counts it. Its name begins with a
dot, by which Blender's own pickers and the dialogs that append leave it out.
"""

import bpy

from . import deleted

KEY = "motus_helper"
"""Custom property of a helper. Those that older versions have made are without it."""


def make(name, data=None):
    """A new helper."""
    helper = bpy.data.objects.new(f".{name}", data)
    helper[KEY] = True
    return helper


def put_away():
    """Take helpers out of the collections into which Blender puts what it appends or pastes along with what needs it."""
    for helper in [obj for obj in bpy.data.objects if KEY in obj and not obj.library]:
        for collection in helper.users_collection:
            if not collection.library:
                collection.objects.unlink(helper)
                deleted.forget(helper)
