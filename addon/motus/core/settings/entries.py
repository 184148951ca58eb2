"""Lists in an owner's settings, such as chains, heads and pins: wired once after several changes, and taken back whole."""

from contextlib import contextmanager

from .. import wiring
from ..blender import actions
from ..declare import of_owner
from ..declare.forgetting import forget
from . import entry_keys


def wire(system, owner, name="entries"):
    """Create, update or remove the drivers and constraints of a system on an owner, as the list in its settings requires.

    If the list is empty, the system's settings are removed as well. name: of the list's property.
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
    """The selected entry of a system's list on an object; None without an object, a set-up or entries. name: of the system."""
    settings = obj and getattr(obj.motus, name)
    if not settings or not settings.is_active or not 0 <= settings.active_entry < len(settings.entries):
        return None
    return settings.entries[settings.active_entry]


@contextmanager
def unwired(settings):
    """Context manager in which changes of a system's settings do not wire the owner: the settings count as inactive inside."""
    was_active, settings.is_active = settings.is_active, False
    try:
        yield settings
    finally:
        settings.is_active = was_active


@contextmanager
def at_once(system, owner):
    """Context manager for several changes of an owner's settings: the owner is wired once at the end, not at every change."""
    with unwired(of_owner(system, owner)) as settings:
        yield settings
    wire(system, owner)


def remove(system, owner, indices, active):
    """Remove entries from a system's list on an owner, with keys and drivers of their settings, and wire the owner again.

    With the last entry the system's settings are removed too. active: name of the property that holds the index of the
    selected entry.
    """
    prefix = f"motus.{system.name}."
    with at_once(system, owner) as settings:
        for index in sorted(indices, reverse=True):
            entry_keys.forget(owner, prefix + "entries", settings.entries, index)
            settings.entries.remove(index)
        setattr(settings, active, max(0, min(getattr(settings, active), len(settings.entries) - 1)))
        if not settings.entries:
            actions.remove(owner, (prefix,))
