"""Helpers: objects that work for others behind the scenes, such as hubs, proxies and the shapes of flakes.

A helper stands in no collection: neither the viewport nor the outliner shows it or counts it. Its name begins with a dot: Blender's
pickers leave such names out unless somebody types the dot.
"""

from __future__ import annotations

from typing import Any

import bpy

KEY = "motus_helper"
"""Custom property of a helper: whether it is hidden, or shown by instances, as the shapes of flakes are."""
PREFIX = "motus_"
"""How the names of all custom properties of helpers begin."""


def make(name: str, data: Any = None, is_hidden: bool = True) -> Any:
    """A new helper. data: its datablock, which is named along with it."""
    if data is not None:
        data.name = f".{name}"
    helper = bpy.data.objects.new(f".{name}", data)
    _mark(helper, is_hidden)
    return helper


def _mark(helper: Any, is_hidden: bool) -> None:
    helper[KEY] = int(is_hidden)
    helper.hide_viewport = helper.hide_render = is_hidden


def is_helper(obj: Any) -> bool:
    """Whether an object is a helper."""
    return KEY in obj


def put_away() -> None:
    """Take helpers out of the collections into which Blender puts what it appends or pastes along with what needs it.

    A hidden helper that nothing needs is removed. A shape that nothing needs is a copy that *Make Instances Real* has made: it
    becomes an object of the artist's.
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


def _give_away(shape: Any) -> None:
    for key in [key for key in shape.keys() if key.startswith(PREFIX)]:
        del shape[key]
    shape.name = shape.name.lstrip(".")
