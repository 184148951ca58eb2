"""Add and remove chains: the functions that the operators call."""

from ..core.declare import registered
from ..core.settings import entries


def system():
    """Return the System of chains from the registry, because this module cannot import the package that imports it."""
    return registered["chains"]


def add(owner, names, changes, rows=None):
    """Add entries for chains, or change those that exist. names: of the entries: for bones the topmost ones. changes: {setting: value}.

    rows: {name of an entry: its objects, in the order in which they hang}, for objects.
    """
    with entries.at_once(system(), owner) as settings:
        for name in names:
            entry = settings.entries.get(name)
            if entry is None:
                entry = settings.entries.add()
                entry.name = name
            for key, value in changes.items():
                setattr(entry, key, value)
            _link(entry, (rows or {}).get(name, ()))
            settings.chosen_entry = settings.entries.find(name)


def _link(entry, objects):
    entry.links.clear()
    for obj in objects:
        link = entry.links.add()
        link.name, link.object = obj.name, obj


def remove(owner, indices):
    """Remove entries of an owner by their indices."""
    entries.remove(system(), owner, indices, "chosen_entry")
