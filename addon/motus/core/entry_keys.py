"""Keys and drivers of settings that stand in a list: they go when an entry goes, and move up with those behind it."""

import bpy

from . import actions


def prefixes(path, entries, index):
    """How data paths of an entry's settings begin: Blender's own have the index, scripts may use the name."""
    name = bpy.utils.escape_identifier(entries[index].name)
    return f"{path}[{index}].", f'{path}["{name}"].'


def forget(owner, path, entries, index):
    """Remove keys and drivers of an entry that is about to be removed from the list at `path` of the owner."""
    actions.remove(owner, prefixes(path, entries, index))
    later = {f"{path}[{place}].": f"{path}[{place - 1}]." for place in range(index + 1, len(entries))}
    animation, beginnings = owner.animation_data, tuple(later)
    moving = actions.own_curves(owner, lambda path: path.startswith(beginnings))
    for curves in (*moving, animation.drivers if animation else ()):
        for curve in curves:
            _move(curve, later)


def _move(curve, places):
    """places: beginning of a data path -> what it is to be."""
    for old, new in places.items():
        if curve.data_path.startswith(old):
            curve.data_path = new + curve.data_path[len(old):]
            return
