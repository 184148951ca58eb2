"""Functions that set followers up and remove them, used by the operators."""

from ..core import wiring
from ..core.blender import actions
from ..core.declare import registered
from ..core.declare.forgetting import forget
from ..core.file.pointers import pointed
from . import members

PREFIX = "motus.path."


def system():
    """The registered System of Follow Path. It cannot be imported at the top, since the package's __init__ imports this module."""
    return registered["path"]


def attach(owner, curve, keywords, wagons=None):
    """Let `owner` follow `curve`. keywords: settings. wagons: list of (object, gap); None keeps the present wagons."""
    settings = owner.motus.path
    if settings.is_active:
        # Wire once at the end, instead of after every change of a setting.
        wiring.detach(system(), owner)
    settings.curve = curve
    for name, value in keywords.items():
        setattr(settings, name, value)
    for obj in (owner, *(wagon for wagon, _ in wagons or ())):
        if is_stray(obj):
            wiring.release(system(), obj)
    if wagons is not None:
        _replace_wagons(owner, wagons)
    wiring.attach(system(), owner)


def clear(owner):
    """Remove a follower: its wiring, the keys and drivers of its settings, and the settings."""
    driven = members.members(owner)
    wiring.detach(system(), owner)
    actions.remove(owner, (PREFIX,))
    for member in driven:
        reset(member)


def is_stray(obj):
    """Whether a train drives the object without listing it: the object is the copy of a wagon, or its leader was deleted."""
    settings = obj.motus.path
    if settings.is_active or members.is_wagon(obj):
        return False
    return pointed(settings, "leader") is not None or wiring.has_sinks(system(), obj)


def free(obj):
    """Free a stray wagon, so that it stands at its own transform again."""
    wiring.release(system(), obj)
    reset(obj)


def reset(obj):
    """Reset an object's path settings to their defaults."""
    forget(system(), obj)


def uncouple(leader, index):
    """Remove a wagon from its train; the wagons behind it keep their places."""
    wagon = pointed(leader.motus.path.wagons[index], "object")
    members.take_out(leader, index)
    wiring.refresh(system(), leader)
    if wagon:
        reset(wagon)


def _replace_wagons(owner, wagons):
    entries = owner.motus.path.wagons
    kept = {wagon for wagon, _ in wagons}
    for entry in entries:
        wagon = pointed(entry, "object")
        if wagon and wagon not in kept:
            reset(wagon)
    entries.clear()
    for wagon, gap in wagons:
        entry = entries.add()
        entry.name = wagon.name
        entry.object = wagon
        entry.gap = gap
