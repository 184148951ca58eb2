"""Lists in an owner's settings, such as chains, heads and pins: wired once after several changes, and taken back whole."""

from contextlib import contextmanager

from .. import wiring
from ..blender import actions
from ..declare import of_owner
from ..declare.forgetting import forget
from . import entry_keys


def wire(system, owner, name="entries"):
    """Wire an owner as its list of this name is now; without anything in it as if there had never been any."""
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
    """The chosen entry of a system's list on an object, or None. name: of the system."""
    settings = obj and getattr(obj.motus, name)
    if not settings or not settings.is_active or not 0 <= settings.active_entry < len(settings.entries):
        return None
    return settings.entries[settings.active_entry]


@contextmanager
def unwired(settings):
    """Changes within do not wire the owner again, each by itself."""
    was_active, settings.is_active = settings.is_active, False
    try:
        yield settings
    finally:
        settings.is_active = was_active


@contextmanager
def at_once(system, owner):
    """Wire once at the end, instead of at every change of a setting within."""
    with unwired(of_owner(system, owner)) as settings:
        yield settings
    wire(system, owner)


def remove(system, owner, indices, active):
    """Take entries back: wiring, keys and drivers of their settings; with the last one the settings themselves.

    active: name of the settings' property that tells which entry is chosen.
    """
    prefix = f"motus.{system.name}."
    with at_once(system, owner) as settings:
        for index in sorted(indices, reverse=True):
            entry_keys.forget(owner, prefix + "entries", settings.entries, index)
            settings.entries.remove(index)
        setattr(settings, active, max(0, min(getattr(settings, active), len(settings.entries) - 1)))
        if not settings.entries:
            actions.remove(owner, (prefix,))
