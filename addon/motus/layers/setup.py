"""Setting layers up and taking them back: plain functions behind the operators."""

import re

from ..core.blender import actions, capabilities
from ..core.declare import registered
from ..core.settings import entries, entry_keys
from .properties import KEYWORDS
from .targets import LIST

_OF_MASK = ("name", "kind", "with_children", "weight")


def system():
    """The registered System: the package's __init__ imports this module, not the other way round."""
    return registered["layers"]


def add(rig, name, changes, items):
    """A new layer on top of all others. changes: settings by name; items: (name, kind, with children) of its mask."""
    with entries.at_once(system(), rig) as settings:
        entry = settings.entries.add()
        entry.name = free_name(settings.entries, name)
        for setting, value in changes.items():
            setattr(entry, setting, value)
        _add_items(entry, items)
        settings.active_entry = len(settings.entries) - 1
    return rig.motus.layers.entries[-1]


def change(rig, index, changes, items=None):
    """Give a layer that is there other settings; items: of its mask, None keeps those it has."""
    with entries.at_once(system(), rig) as settings:
        entry = settings.entries[index]
        for setting, value in changes.items():
            setattr(entry, setting, value)
        if items is not None:
            entry.mask.clear()
            _add_items(entry, items)
        settings.active_entry = index


def free_name(layers, wanted):
    """A name that no layer has yet."""
    taken, name, number = set(layers.keys()), wanted, 0
    stem = re.sub(r"\.\d{3,}$", "", wanted)
    while name in taken:
        number += 1
        name = f"{stem}.{number:03d}"
    return name


def duplicate(rig, index):
    """A copy of a layer, right above it. Keys of its weight stay with the first one."""
    source = rig.motus.layers.entries[index]
    changes = {name: getattr(source, name) for name in (*KEYWORDS, "action", "slot", "is_muted")}
    with entries.at_once(system(), rig) as settings:
        entry = settings.entries.add()
        source = settings.entries[index]
        entry.name = free_name(settings.entries, source.name)
        for setting, value in changes.items():
            setattr(entry, setting, value)
        for item in source.mask:
            made = entry.mask.add()
            for setting in _OF_MASK:
                setattr(made, setting, getattr(item, setting))
        for place in range(len(settings.entries) - 1, index + 1, -1):
            exchange(rig, place, place - 1)
        settings.active_entry = index + 1


def exchange(rig, first, second):
    """Let two layers change places."""
    entry_keys.exchange(rig, LIST, first, second)
    rig.motus.layers.entries.move(first, second)


def move(rig, index, place):
    """Let a layer change places with its neighbour."""
    with entries.at_once(system(), rig) as settings:
        exchange(rig, index, place)
        settings.active_entry = place


def remove(rig, index):
    """Take one layer back, with the keys of its settings."""
    entries.remove(system(), rig, [index], "active_entry")


def add_to_mask(rig, index, items):
    """Let the mask of a layer have more: (name, kind, with children)."""
    with entries.at_once(system(), rig) as settings:
        _add_items(settings.entries[index], items)


def remove_from_mask(rig, index, place):
    """Take an item out of the mask of a layer."""
    with entries.at_once(system(), rig) as settings:
        entry = settings.entries[index]
        entry.mask.remove(place)
        entry.active_mask = max(0, min(entry.active_mask, len(entry.mask) - 1))


def slot_of(rig, action):
    """Identifier of the slot by which a layer plays an action.

    The rig's own one, or one of its name, that animates its bones; else "".
    """
    if action is None or not capabilities.has_slotted_actions():
        return ""
    own, bones = actions.slot_identifier(rig), rig.data.bones.keys()
    found = [slot.identifier for slot in actions.slots_for_objects(action) if rig.name == slot.name_display or own == slot.identifier]
    found.sort(key=lambda identifier: identifier != own)
    return next((one for one in found if actions.animates(actions.curves_for_object(action, one), bones)), "")


def _add_items(entry, items):
    for name, kind, with_children in items:
        found = next((item for item in entry.mask if (item.name, item.kind) == (name, kind)), None) or entry.mask.add()
        found.name, found.kind, found.with_children = name, kind, with_children
        entry.active_mask = len(entry.mask) - 1
