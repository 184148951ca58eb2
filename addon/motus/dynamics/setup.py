"""Add and remove dynamics, and find their entries: the functions that the operators call."""

from ..core.blender import datablocks
from ..core.declare import registered
from ..core.settings import entries, lists
from . import inputs


def system():
    """Return the System of dynamics from the registry, because this module cannot import the package that imports it."""
    return registered["dynamics"]


def add(owner, wanted):
    """Add entries to an owner, or change those that exist. wanted: {key: {setting: value}}, with keys as followed() returns them."""
    with entries.at_once(system(), owner) as settings:
        for name, changes in wanted.items():
            index = find(settings, name)
            entry = _new(settings.entries, name) if index < 0 else settings.entries[index]
            for key, value in changes.items():
                setattr(entry, key, value)
            settings.chosen_entry = find(settings, name)


def _new(listed, name):
    if isinstance(name, str):
        return lists.add(listed, name)
    entry = lists.add_numbered(listed, name[0])
    entry.data_path, entry.index = name
    return entry


def remove(owner, indices):
    """Remove entries of an owner by their indices."""
    entries.remove(system(), owner, indices, "active_entry")


def find(settings, name):
    """Return the index of an entry; -1 if there is none. name: of a bone, "" for the object, or (path, index) of a property."""
    return next((index for index, entry in enumerate(settings.entries) if followed(entry) == name), -1)


def followed(entry):
    """Return the key of an entry: (data path, index) of its property, the name of its bone, or "" for the object itself."""
    return (entry.data_path, entry.index) if entry.data_path else entry.name


def label(entry):
    """Return the label of an entry in lists and reports: the name of the bone or object, or the property's label in the interface."""
    owner = entry.id_data
    if not entry.data_path:
        return entry.name or owner.name
    places = inputs.numbers_of(owner, entry)
    if not places:
        return entry.data_path
    return datablocks.label_of(places[0].id_data, places[0].data_path, places[0].number.index if len(places) == 1 else -1)


def active_entry(obj):
    """Return the entry that is active in the object's list of dynamics; None if there is none."""
    settings = obj.motus.dynamics
    return settings.entries[settings.active_entry] if 0 <= settings.active_entry < len(settings.entries) else None
