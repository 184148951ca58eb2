"""Add and remove chains: the functions that the operators call."""

from ..core.declare import registered
from ..core.settings import entries
from . import curves


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
            entry = settings.entries.get(name)
            if entry is None:
                entry = settings.entries.add()
                entry.name = name
            for key, value in changes.items():
                setattr(entry, key, value)
            if name in splines:
                entry.spline = splines[name]
            elif name in rows:
                _link(entry, rows[name])
            settings.chosen_entry = settings.entries.find(name)


def _link(entry, objects):
    entry.links.clear()
    for obj in objects:
        link = entry.links.add()
        link.name, link.object = obj.name, obj


def remove(owner, indices):
    """Remove entries of an owner by their indices."""
    entries.remove(system(), owner, indices, "chosen_entry")
    if owner.type == 'CURVE':
        curves.tidy(owner)
