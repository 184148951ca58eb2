"""Add, change, order and remove layers: the functions that the operators call."""

import re

import bpy

from ..core.blender import actions, capabilities
from ..core.declare import registered
from ..core.settings import entries, entry_keys, lists
from .properties import KEYWORDS
from .targets import LIST

_OF_MASK = ("name", "kind", "with_children", "weight")


def system():
    """Return the System of the layers from the registry, because this module cannot import the package that imports it."""
    return registered["layers"]


def add(rig, name, changes, items):
    """Add a layer on top of all layers of a rig; returns its settings.

    changes: {setting: value}. items: [(name, 'BONE' or 'COLLECTION', with children)] of its mask.
    """
    with entries.at_once(system(), rig) as settings:
        entry = lists.add(settings.entries, free_name(settings.entries, name))
        for setting, value in changes.items():
            setattr(entry, setting, value)
        _add_items(entry, items)
        settings.active_entry = len(settings.entries) - 1
    return rig.motus.layers.entries[-1]


def add_empty(rig, name, mode, frames, items):
    """Add a layer with a new action without keys, whose frames are those of the scene; returns its settings.

    frames: (first, last) of the scene. items: as of add().
    """
    action = bpy.data.actions.new(f"{rig.name} {name}")
    action.use_fake_user = True  # Blender does not save an action without a user, which it is once its layer is removed
    bag = actions.bag_for_object(action, "", (), rig.name)
    first, last = frames
    changes = {
        "action": action,
        "slot": bag.slot.identifier if capabilities.has_slotted_actions() else "",
        "mode": mode,
        "reference": 'REST',
        "start": first,
        "use_range": True,
        "first_frame": first,
        "last_frame": last,
        "after": 'HOLD',
    }
    return add(rig, name, changes, items)


def change(rig, index, changes, items=None):
    """Change the settings of an existing layer.

    changes: {setting: value}. items: [(name, 'BONE' or 'COLLECTION', with children)] for its mask; None keeps the mask.
    """
    with entries.at_once(system(), rig) as settings:
        entry = settings.entries[index]
        if items is not None:
            rows = [dict(zip(_OF_MASK, item)) for item in dict.fromkeys(items)]
            lists.replace(entry.mask, lists.library_first(entry.mask, rows, _is_same_item), is_same=_is_same_item)
            entry.active_mask = max(0, len(entry.mask) - 1)
        for setting, value in changes.items():
            setattr(entry, setting, value)
        settings.active_entry = index


def free_name(layers, wanted):
    """Return the wanted name, with a number such as .001 at its end if one of the layers has that name."""
    taken, name, number = set(layers.keys()), wanted, 0
    stem = re.sub(r"\.\d{3,}$", "", wanted)
    while name in taken:
        number += 1
        name = f"{stem}.{number:03d}"
    return name


def duplicate(rig, index):
    """Add a copy of a layer right above the layer. Keys of the layer's settings are not copied."""
    source = rig.motus.layers.entries[index]
    changes = {name: getattr(source, name) for name in (*KEYWORDS, "action", "slot", "reference_action", "is_muted")}
    with entries.at_once(system(), rig) as settings:
        entry = lists.add(settings.entries, free_name(settings.entries, source.name))
        source = settings.entries[index]
        for setting, value in changes.items():
            setattr(entry, setting, value)
        for item in source.mask:
            made = lists.add(entry.mask, item.name)
            for setting in _OF_MASK:
                setattr(made, setting, getattr(item, setting))
        for place in range(len(settings.entries) - 1, index + 1, -1):
            exchange(rig, place, place - 1)
        settings.active_entry = index + 1


def exchange(rig, first, second):
    """Exchange two layers in the list, together with the keys of their settings."""
    entry_keys.exchange(rig, LIST, first, second)
    lists.move(rig.motus.layers.entries, first, second)


def move(rig, index, place):
    """Exchange a layer with its neighbour at the index `place`, and make the layer active there."""
    with entries.at_once(system(), rig) as settings:
        exchange(rig, index, place)
        settings.active_entry = place


def remove(rig, index):
    """Remove a layer from a rig, together with the keys of the layer's settings."""
    entries.remove(system(), rig, [index], "active_entry")


def add_to_mask(rig, index, items):
    """Add items to the mask of a layer. items: [(name, 'BONE' or 'COLLECTION', with children)]."""
    with entries.at_once(system(), rig) as settings:
        _add_items(settings.entries[index], items)


def remove_from_mask(rig, index, place):
    """Remove the item with index `place` from the mask of a layer."""
    with entries.at_once(system(), rig) as settings:
        entry = settings.entries[index]
        lists.remove(entry.mask, place)
        entry.active_mask = max(0, min(entry.active_mask, len(entry.mask) - 1))


def slot_of(rig, action):
    """Return the identifier of the action slot that a layer plays.

    The slot is the one that the rig uses, or else a slot with the rig's name, if it animates bones of the rig; "" if there is none.
    """
    if action is None or not capabilities.has_slotted_actions():
        return ""
    own, bones = actions.slot_identifier(rig), rig.data.bones.keys()
    found = [slot.identifier for slot in actions.slots_for_objects(action) if rig.name == slot.name_display or own == slot.identifier]
    found.sort(key=lambda identifier: identifier != own)
    return next((one for one in found if actions.animates(actions.curves_for_object(action, one), bones)), "")


def _add_items(entry, items):
    for name, kind, with_children in items:
        found = next((item for item in entry.mask if (item.name, item.kind) == (name, kind)), None) or lists.add(entry.mask, name)
        found.kind, found.with_children = kind, with_children
        entry.active_mask = len(entry.mask) - 1


def _is_same_item(item, row):
    return (item.name, item.kind) == (row["name"], row["kind"])
