"""Giving dynamics and taking them back: plain functions behind the operators."""

from ..core.blender import datablocks
from ..core.declare import registered
from ..core.settings import entries
from . import inputs


def system():
    """The registered System: the package's __init__ imports this module, not the other way round."""
    return registered["dynamics"]


def add(owner, wanted):
    """Let things follow. wanted: settings of their entries by name, by what find() takes."""
    with entries.at_once(system(), owner) as settings:
        for name, changes in wanted.items():
            index = find(settings, name)
            entry = settings.entries.add() if index < 0 else settings.entries[index]
            if isinstance(name, str):
                entry.name = name
            else:
                entry.data_path, entry.index = name
            for key, value in changes.items():
                setattr(entry, key, value)
            settings.chosen_entry = find(settings, name)


def remove(owner, indices):
    """Take entries back."""
    entries.remove(system(), owner, indices, "active_entry")


def find(settings, name):
    """Index of the entry of a bone, of the object, which is called "", or of a property, (path, index); -1 without."""
    return next((index for index, entry in enumerate(settings.entries) if followed(entry) == name), -1)


def followed(entry):
    """Key of what an entry lets follow: (data path, index) of a property, the name of a bone, or "" for the object."""
    return (entry.data_path, entry.index) if entry.data_path else entry.name


def label(entry):
    """What an entry is called in lists and reports: the bone, the object, or what the interface calls the property."""
    owner = entry.id_data
    if not entry.data_path:
        return entry.name or owner.name
    places = inputs.numbers_of(owner, entry)
    if not places:
        return entry.data_path
    return datablocks.label_of(places[0].id_data, places[0].data_path, places[0].number.index if len(places) == 1 else -1)


def active_entry(obj):
    """The entry that the list has marked; None where there is none."""
    settings = obj.motus.dynamics
    return settings.entries[settings.active_entry] if 0 <= settings.active_entry < len(settings.entries) else None
