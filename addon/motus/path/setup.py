"""Functions that set up followers and remove them; the operators call them."""

from ..core import wiring
from ..core.blender import actions
from ..core.declare import registered
from ..core.declare.forgetting import forget
from ..core.file.pointers import pointed
from ..core.settings import lists
from . import members

PREFIX = "motus.path."


def system():
    """The registered System of Follow Path. A top-level import is impossible, since the package's __init__ imports this module."""
    return registered["path"]


def attach(owner, curve, keywords, wagons=None):
    """Let `owner` follow `curve`.

    keywords: {name: value} of path settings. wagons: list of members.Wagon; None keeps the present wagons. Raises Refused if an override
    would lose a wagon that it has from its library.
    """
    settings = owner.motus.path
    if wagons is not None:
        lists.check_replaceable(settings.wagons, _rows(wagons), _is_same_wagon)
    if settings.is_active:
        # attach() below adds the constraints and drivers once, instead of after every change of a setting.
        wiring.detach(system(), owner)
    settings.curve = curve
    for name, value in keywords.items():
        setattr(settings, name, value)
    for obj in (owner, *(wagon.object for wagon in wagons or ())):
        if is_stray(obj):
            wiring.release(system(), obj)
    if wagons is not None:
        _replace_wagons(owner, wagons)
    wiring.attach(system(), owner)


def clear(owner):
    """Remove the follower set-up of an owner and its wagons: constraints and drivers, the settings' keys and drivers, and the settings."""
    driven = members.members(owner)
    wiring.detach(system(), owner)
    actions.remove(owner, (PREFIX,))
    for member in driven:
        reset(member)


def is_stray(obj):
    """Whether a train drives an object that no train lists: a copied wagon, or a wagon whose leader was deleted."""
    settings = obj.motus.path
    if settings.is_active or members.is_wagon(obj):
        return False
    return pointed(settings, "leader") is not None or wiring.has_sinks(system(), obj)


def free(obj):
    """Remove what drives a stray wagon (a wagon that no train lists), so that the object returns to its own transform."""
    wiring.release(system(), obj)
    reset(obj)


def reset(obj):
    """Reset the path settings of an object to their defaults."""
    forget(system(), obj)


def uncouple(leader, index):
    """Remove the wagon at `index` from the train of its leader; the wagons behind it keep their places."""
    wagon = pointed(leader.motus.path.wagons[index], "object")
    members.take_out(leader, index)
    wiring.refresh(system(), leader)
    if wagon:
        reset(wagon)


def _replace_wagons(owner, wagons):
    entries = owner.motus.path.wagons
    kept = {wagon.object for wagon in wagons}
    for entry in entries:
        wagon = pointed(entry, "object")
        if wagon and wagon not in kept:
            reset(wagon)
    lists.replace(entries, _rows(wagons), is_same=_is_same_wagon)


def _rows(wagons):
    return [{"name": wagon.object.name} | wagon._asdict() for wagon in wagons]


def _is_same_wagon(entry, row):
    return pointed(entry, "object") == row["object"]
