"""Edit lists in an owner's settings, such as chains, heads and pins, and wire the owner once after several changes.

An owner is an object whose settings a system solves. To wire it means to create the drivers and constraints that the system needs.
"""

from contextlib import contextmanager

from .. import wiring
from ..blender import actions
from ..declare import of_owner
from ..declare.forgetting import forget
from ..lazy import numpy as np
from . import entry_keys, lists


def wire(system, owner, name="entries"):
    """Create, update or remove the drivers and constraints of a system on an owner, as the list in the owner's settings requires.

    owner: object whose settings the system solves. name: of the list's property. If the list is empty, the system's settings are removed
    from the owner as well.
    """
    settings = of_owner(system, owner)
    if not getattr(settings, name):
        if settings.is_active:
            wiring.detach(system, owner)
        forget(system, owner)
    elif settings.is_active:
        wiring.refresh(system, owner)
    else:
        wiring.attach(system, owner)


def active(obj, name):
    """The selected entry of a system's list on an object. name: of the system.

    None if the object is None, if the system is not set up on the object, or if no entry is selected.
    """
    settings = obj and getattr(obj.motus, name)
    if not settings or not settings.is_active or not 0 <= settings.active_entry < len(settings.entries):
        return None
    return settings.entries[settings.active_entry]


def weights(settings):
    """Weights of all entries; 0.0 for a muted entry, and for a weight that is not a positive number."""
    count = len(settings.entries)
    found, muted = np.empty(count, np.float32), np.empty(count, bool)
    settings.entries.foreach_get("weight", found)
    settings.entries.foreach_get("is_muted", muted)
    return [0.0 if is_muted or not weight > 0.0 else weight for weight, is_muted in zip(found.tolist(), muted.tolist())]


@contextmanager
def unwired(settings):
    """Context manager in which changes of settings do not wire their owner, that is, do not rebuild its drivers and constraints.

    `is_active` of the settings is False inside, and is restored on exit.
    """
    was_active, settings.is_active = settings.is_active, False
    try:
        yield settings
    finally:
        settings.is_active = was_active


@contextmanager
def at_once(system, owner):
    """Context manager for several changes of an owner's settings: the owner is wired once at the end, not at every change.

    To wire an owner means to create or update the drivers and constraints that the system needs. Yields the settings.
    """
    with unwired(of_owner(system, owner)) as settings:
        yield settings
    wire(system, owner)


def remove(system, owner, indices, active):
    """Remove entries from a system's list on an owner, with keys and drivers of the entries' settings, and wire the owner again.

    To wire an owner means to update the drivers and constraints that the system needs. With the last entry the system's settings are
    removed too. indices: of the entries. active: name of the property that holds the index of the selected entry. Raises Refused if an
    override has one of the entries from its library.
    """
    prefix = f"motus.{system.name}."
    lists.check_own(of_owner(system, owner).entries, indices)
    with at_once(system, owner) as settings:
        for index in sorted(indices, reverse=True):
            entry_keys.forget(owner, prefix + "entries", settings.entries, index)
            lists.remove(settings.entries, index)
        setattr(settings, active, max(0, min(getattr(settings, active), len(settings.entries) - 1)))
        if not settings.entries:
            actions.remove(owner, (prefix,))
