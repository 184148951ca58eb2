"""Setting followers up and taking them back: plain functions behind the operators."""

from ..core import wiring
from ..core.blender import actions
from ..core.declare import registered
from ..core.declare.forgetting import forget
from ..core.file.pointers import pointed
from . import members

PREFIX = "motus.path."


def system():
    """The registered System: the package's __init__ imports this module, not the other way round."""
    return registered["path"]


def attach(owner, curve, keywords, wagons=None):
    """Let `owner` follow `curve`; wagons: list of (object, gap), None keeps those it has."""
    settings = owner.motus.path
    if settings.is_active:
        # Once at the end, instead of at every change of a setting.
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
    """Take the follower back: wiring, keys and drivers of its settings, and the settings themselves."""
    driven = members.members(owner)
    wiring.detach(system(), owner)
    actions.remove(owner, (PREFIX,))
    for member in driven:
        reset(member)


def is_stray(obj):
    """Whether the object is driven by a train that does not list it: the copy of a wagon, or one whose leader is gone."""
    settings = obj.motus.path
    if settings.is_active or members.is_wagon(obj):
        return False
    return pointed(settings, "leader") is not None or wiring.has_sinks(system(), obj)


def free(obj):
    """Let a stray wagon stand at its own transform again."""
    wiring.release(system(), obj)
    reset(obj)


def reset(obj):
    """Forget the settings."""
    forget(system(), obj)


def uncouple(leader, index):
    """Take a wagon out of the train; those behind keep their places."""
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
