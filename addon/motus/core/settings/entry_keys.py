"""Keep keys and drivers of list entries in step with the list: remove them with their entry, and move them with their entry."""

import itertools

import bpy

from ..blender import actions
from ..evaluated import copies


def prefixes(path, entries, index):
    """The two prefixes that data paths of an entry's settings may have: with the entry's index, or with the entry's name.

    Blender itself writes data paths with the index; scripts may use the name. path: data path of the list `entries`.
    """
    return f"{path}[{index}].", _named(path, entries[index].name)


def animated_prefix(owner, path, entries, index):
    """Prefix of the data paths by which an entry of the list at `path` is animated: with its index, or with its name.

    The prefix has the name only if an F-curve or driver of the owner uses the name.
    """
    by_index, by_name = prefixes(path, entries, index)
    copy = copies.of(owner) if owner.is_evaluated else None
    if entries.find(entries[index].name) != index or (copy and not copy.has_animated_settings):
        return by_index
    animation = owner.animation_data
    curves = itertools.chain(animation.drivers if animation else (), *map(actions.curves_of, actions.players(owner)))
    return by_name if any(curve.data_path.startswith(by_name) for curve in curves) else by_index


def forget(owner, path, entries, index):
    """Remove keys and drivers of an entry that is about to be removed from the list at `path` of the owner.

    Keys and drivers of later entries follow their entries to the next lower index.
    """
    actions.remove(owner, prefixes(path, entries, index))
    later = {f"{path}[{place}].": f"{path}[{place - 1}]." for place in range(index + 1, len(entries))}
    _move_all(owner, later)


def exchange(owner, path, first, second):
    """Exchange the data paths of the keys and drivers of two list entries that are about to swap places.

    path: data path of the list. first, second: indices of the entries.
    """
    _move_all(owner, {f"{path}[{one}].": f"{path}[{other}]." for one, other in ((first, second), (second, first))})


def rename(owner, path, old, new):
    """Let keys and drivers whose data paths have the name of a list entry follow the entry to its new name. path: data path of the list."""
    _move_all(owner, {_named(path, old): _named(path, new)})


def _named(path, name):
    """The prefix of data paths that have the name of an entry."""
    return f'{path}["{bpy.utils.escape_identifier(name)}"].'


def _move_all(owner, places):
    animation, beginnings = owner.animation_data, tuple(places)
    moving = actions.own_curves(owner, lambda path: path.startswith(beginnings))
    for curves in (*moving, animation.drivers if animation else ()):
        for curve in curves:
            _move(curve, places)


def _move(curve, places):
    """Replace the beginning of an F-curve's data path, if it is among `places`. places: {old beginning: new beginning}."""
    for old, new in places.items():
        if curve.data_path.startswith(old):
            curve.data_path = new + curve.data_path[len(old) :]
            return
