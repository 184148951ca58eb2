"""Helpers: objects that Motus creates for its own use, such as hubs (they carry a solver's driver), proxies and shapes of flakes.

A helper is in no collection: neither the viewport nor the outliner shows or counts it. Its name begins with a dot, because Blender's
pickers leave out such names unless the user types the dot.
"""

from __future__ import annotations

from typing import Any

import bpy

KEY = "motus_helper"
"""Custom property of a helper: 1 for a hidden helper; 0 for a helper that is shown by instances, such as the shapes of flakes."""
PREFIX = "motus_"
"""Prefix of the names of all custom properties that helpers have."""


def make(name: str, data: Any = None, is_hidden: bool = True) -> Any:
    """Create a helper: an object in no collection. data: the object's data, which gets the helper's name; None for an empty."""
    if data is not None:
        data.name = f".{name}"
    helper = bpy.data.objects.new(f".{name}", data)
    _mark(helper, is_hidden)
    return helper


def _mark(helper: Any, is_hidden: bool) -> None:
    helper[KEY] = int(is_hidden)
    helper.hide_viewport = helper.hide_render = is_hidden


def is_helper(obj: Any) -> bool:
    """Whether an object is a helper, an object that Motus has created for its own use."""
    return KEY in obj


def put_away() -> None:
    """Unlink helpers from collections, into which Blender puts them when it appends or pastes something that needs them.

    A hidden helper that nothing needs is removed. A shape of flakes that nothing needs is a copy that *Make Instances Real* has made: it
    becomes an ordinary object of the user.
    """
    standing: dict[Any, list[Any]] = {}
    objects: Any = bpy.data.objects
    helpers = {obj for obj in objects if KEY in obj and not obj.library}
    for collection in (*bpy.data.collections, *(scene.collection for scene in bpy.data.scenes)) if helpers else ():
        if not collection.library:
            for helper in helpers.intersection(collection.objects.values()):
                standing.setdefault(helper, []).append(collection)
    for helper, collections in standing.items():
        if helper.users > len(collections):
            for collection in collections:
                collection.objects.unlink(helper)
            _mark(helper, bool(helper[KEY]))
        elif helper[KEY]:
            bpy.data.objects.remove(helper)
        else:
            _give_away(helper)


def remove_overridden() -> None:
    """Remove library overrides of helpers that nothing uses.

    Blender makes them along with the override of a helper's owner, which is given a helper of its own. In a file that kept one, Blender 4.5
    would find a part of the owner's hierarchy that is not in its place, and override the owner once more each time that the file is opened.
    """
    objects: Any = bpy.data.objects
    for obj in [obj for obj in objects if KEY in obj and obj.override_library and not obj.library and not obj.users]:
        objects.remove(obj)


def _give_away(shape: Any) -> None:
    for key in [key for key in shape.keys() if key.startswith(PREFIX)]:
        del shape[key]
    shape.name = shape.name.lstrip(".")
