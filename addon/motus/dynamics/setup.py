"""Giving dynamics and taking them back: plain functions behind the operators."""

from ..core import entries
from ..core.system import registered


def system():
    """The registered System: the package's __init__ imports this module, not the other way round."""
    return registered["dynamics"]


def add(owner, wanted):
    """Let things follow. wanted: {bone's name, or "" for the object: settings of its entry by name}."""
    with entries.at_once(system(), owner) as settings:
        for name, changes in wanted.items():
            index = find(settings, name)
            entry = settings.entries.add() if index < 0 else settings.entries[index]
            entry.name = name
            for key, value in changes.items():
                setattr(entry, key, value)
            settings.active_entry = find(settings, name)


def remove(owner, indices):
    """Take entries back."""
    entries.remove(system(), owner, indices, "active_entry")


def find(settings, name):
    """Index of the entry of a bone, or of the object, which is called ""; -1 without."""
    return next((index for index, entry in enumerate(settings.entries) if entry.name == name), -1)


def active_entry(obj):
    """The entry that the list has marked; None where there is none."""
    settings = obj.motus.dynamics
    return settings.entries[settings.active_entry] if 0 <= settings.active_entry < len(settings.entries) else None
