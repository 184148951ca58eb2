"""Add and remove chains: the functions that the operators call."""

from ..core.declare import registered
from ..core.file import libraries
from ..core.file.pointers import pointed
from ..core.settings import entries, entry_keys, targets
from . import curves, groups, pins


def system():
    """Return the System of chains from the registry, because this module cannot import the package that imports it."""
    return registered["chains"]


def add(owner, names, changes, rows, splines):
    """Add entries for chains, or change those that exist. names: of the entries: for bones the topmost ones. changes: {setting: value}.

    rows: {name of an entry: its objects, in the order in which they hang}, for objects. splines: {name of an entry: index of its spline}, for
    points of a curve.
    """
    with entries.at_once(system(), owner) as settings:
        for name in names:
            entry = entry_of(settings, name, changes)
            if name in splines:
                entry.spline = splines[name]
            elif name in rows:
                _link(entry, rows[name])
            settings.chosen_entry = settings.entries.find(name)


def entry_of(settings, name, changes):
    """Return the entry of a name, added if there is none, with these settings changed, {setting: value}. Call this within entries.at_once()."""
    entry = settings.entries.get(name)
    if entry is None:
        entry = settings.entries.add()
        entry.name = name
    for key, value in changes.items():
        setattr(entry, key, value)
    return entry


def _link(entry, objects):
    entry.links.clear()
    for obj in objects:
        link = entry.links.add()
        link.name, link.object = obj.name, obj


def remove(owner, indices):
    """Remove entries of an owner by their indices, with the pins of their chains."""
    settings = owner.motus.chains
    gone = {settings.entries[index].name for index in indices}
    bones = {name for chain in groups.chains(owner) if chain.entry.name in gone for name in chain.names}
    is_last = len(gone) == len(settings.entries)
    kept = libraries.count_from_library(owner, pins.PATH)
    unpin(owner, [index for index, one in enumerate(settings.pins) if index >= kept and (is_last or one.name in bones)])
    entries.remove(system(), owner, indices, "chosen_entry")
    if owner.type == 'CURVE':
        curves.tidy(owner)


def pin(owner, bone, changes):
    """Add a pin of a bone, or change the one that it has. changes: {setting: value}. Call this within entries.at_once()."""
    settings = owner.motus.chains
    found = settings.pins.get(bone)
    if found is None:
        found = settings.pins.add()
        found.name = bone
    for name, value in changes.items():
        setattr(found, name, value)
    settings.active_pin = settings.pins.find(bone)


def unpin(owner, indices):
    """Remove pins of an owner by their indices, and delete the empties that Motus made for them if nothing else needs these."""
    if not indices:
        return
    with entries.at_once(system(), owner) as settings:
        held_to = {pointed(settings.pins[index], "target") for index in indices}
        for index in sorted(indices, reverse=True):
            entry_keys.forget(owner, pins.PATH, settings.pins, index)
            settings.pins.remove(index)
        settings.active_pin = max(0, min(settings.active_pin, len(settings.pins) - 1))
    for target in held_to:
        targets.remove_unneeded(target, pins.MADE_KEY)
