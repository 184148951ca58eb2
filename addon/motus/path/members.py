"""Find the objects that one set of path settings moves: the owner of the settings, and the wagons of its train."""

from ..core.file import libraries
from ..core.file.choices import chosen
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np


def channels(settings):
    """Return the transform channels that the path drives. Without an orientation these exclude the rotation, which the object keeps."""
    return frozenset({"location"} if chosen(settings, "orientation") == 'NONE' else {"location", "rotation"})


def members(owner):
    """Return the objects that the path settings of an owner move: the owner first, then its wagons.

    A wagon whose leader is a different object is left out: a copied leader still lists the wagons of the original leader.
    """
    return [owner] + [pointed(wagon, "object") for wagon in _wagons(owner)]


def offsets(owner):
    """Return the distance along the path from the owner to each member, (n,). Each wagon lies one gap behind the member in front."""
    gaps = [wagon.gap for wagon in _wagons(owner)]
    return -np.cumsum([0.0, *gaps])


def _wagons(owner):
    return [entry for entry in owner.motus.path.wagons if _is_own(pointed(entry, "object"), owner)]


def _is_own(wagon, owner):
    return wagon is not None and libraries.is_free_or_of(wagon, pointed(wagon.motus.path, "leader"), owner)


def index_of(leader, wagon):
    """Index of an object in its leader's list of wagons; -1 if the list does not contain the object."""
    return next((i for i, entry in enumerate(leader.motus.path.wagons) if pointed(entry, "object") == wagon), -1)


def is_wagon(obj):
    """Whether an object is a wagon of a train. A copied wagon is none: it names a leader, but the leader does not list it."""
    leader = pointed(obj.motus.path, "leader")
    return leader is not None and index_of(leader, obj) >= 0


def take_out(leader, index):
    """Remove a wagon from its leader's list; the gap of the next wagon grows, so that the wagons behind keep their places."""
    wagons = leader.motus.path.wagons
    if index + 1 < len(wagons):
        wagons[index + 1].gap += wagons[index].gap
    wagons.remove(index)
