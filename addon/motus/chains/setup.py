"""Add and remove chains: the functions that the operators call."""

from ..core import wiring
from ..core.declare import registered
from ..core.declare.forgetting import forget
from ..core.file.pointers import pointed
from ..core.settings import drawn_curves, entries, entry_keys, lists, targets
from . import along, curves, groups, naming, pins, properties


def system():
    """Return the System of chains from the registry, because this module cannot import the package that imports it."""
    return registered["chains"]


def prepare(owner):
    """Make what only an owner of its own has: anchors of its splines' points, and curves that were drawn. This is the function System.prepare."""
    curves.prepare(owner)
    along.take_over(owner)


def add(owner, names, changes, rows, splines):
    """Add entries for chains, or change those that exist. names: of the entries: for bones the topmost ones. changes: {setting: value}.

    rows: {name of an entry: its objects, in the order in which they hang}, for objects. splines: {name of an entry: index of its spline}, for
    points of a curve.
    """
    for obj in [obj for row in rows.values() for obj in row]:
        if groups.is_left(obj):
            free(obj)
    with entries.at_once(system(), owner) as settings:
        for name in names:
            is_bone = name not in rows and name not in splines
            entry = (entry_of_bone if is_bone else entry_of)(settings, name, changes)
            if name in splines:
                entry.spline = splines[name]
            elif name in rows:
                _link(entry, rows[name])
            settings.chosen_entry = settings.entries.find(name)


def entry_of(settings, name, changes):
    """Return the entry of a name, added if there is none, with these settings changed, {setting: value}. Call this within entries.at_once()."""
    entry = settings.entries.get(name) or lists.add(settings.entries, name)
    for key, value in changes.items():
        setattr(entry, key, value)
    return entry


def entry_of_bone(settings, name, changes):
    """Return the entry of the chain of a bone, as entry_of() does: a row or spline that has the bone's name gives way."""
    naming.give_way(settings, name)
    return entry_of(settings, name, changes)


def _link(entry, objects):
    lists.replace(entry.links, [{"name": obj.name, "object": obj} for obj in objects], is_same=_is_same_link)


def _is_same_link(link, row):
    return pointed(link, "object") == row["object"]


def remove(owner, indices):
    """Remove entries of an owner by their indices, with the pins of their chains."""
    settings = owner.motus.chains
    gone = {settings.entries[index].name for index in indices}
    drawn = drawn_curves.trees(settings.entries[index] for index in indices)
    bones = {name for chain in groups.chains(owner) if chain.entry.name in gone for name in chain.pinnable}
    had_anchors = any(entry.spline >= 0 for entry in settings.entries)
    is_last = len(gone) == len(settings.entries)
    kept = lists.count_from_library(settings.pins)
    unpin(owner, [index for index, one in enumerate(settings.pins) if index >= kept and (is_last or one.name in bones)])
    entries.remove(system(), owner, indices, "chosen_entry")
    drawn_curves.remove_unused(drawn)
    if had_anchors:
        curves.tidy(owner)


def free(obj):
    """Free an object that a chain without an owner in a collection moves (groups.is_left), and all objects that the same chain moves."""
    if not groups.is_stray(obj):
        leader = pointed(obj.motus.chains, "leader")
        remove(leader, [properties.index_with(leader.motus.chains, obj)])
        return
    for one in wiring.abandoned(system(), obj) or [obj]:
        wiring.release(system(), one)
        if one.motus.chains.entries:
            wiring.refresh(system(), one)
        else:
            forget(system(), one)


def pin(owner, bone, changes):
    """Add a pin of a bone, or change the one that it has. changes: {setting: value}. Call this within entries.at_once()."""
    settings = owner.motus.chains
    found = settings.pins.get(bone) or lists.add(settings.pins, bone)
    for name, value in changes.items():
        setattr(found, name, value)
    settings.active_pin = settings.pins.find(bone)


def unpin(owner, indices):
    """Remove pins of an owner by their indices, and delete the empties that Motus made for them if nothing else needs these."""
    if not indices:
        return
    lists.check_own(owner.motus.chains.pins, indices)
    with entries.at_once(system(), owner) as settings:
        held_to = {pointed(settings.pins[index], "target") for index in indices}
        for index in sorted(indices, reverse=True):
            entry_keys.forget(owner, pins.PATH, settings.pins, index)
            lists.remove(settings.pins, index)
        settings.active_pin = max(0, min(settings.active_pin, len(settings.pins) - 1))
    for target in held_to:
        targets.remove_unneeded(target, pins.MADE_KEY)
