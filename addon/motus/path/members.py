"""Find the objects that one set of path settings moves: the owner of the settings, and the wagons of its train."""

from typing import Any, NamedTuple

from ..core.file import libraries
from ..core.file.choices import chosen
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.settings import lists


class Wagon(NamedTuple):
    """What a train's list says of one wagon: the object, and settings of its entry. gap, wheelbase: metres. delay: seconds."""

    object: Any
    gap: float
    delay: float
    wheelbase: float


def wagons(leader):
    """Return a list with the Wagon of each entry of a leader's list that has an object."""
    found = [(pointed(entry, "object"), entry) for entry in leader.motus.path.wagons]
    return [Wagon(obj, entry.gap, entry.delay, entry.wheelbase) for obj, entry in found if obj]


def channels(settings):
    """Return the transform channels that the path drives. Without an orientation these exclude the rotation, which the object keeps."""
    return frozenset({"location"} if chosen(settings, "orientation") == 'NONE' else {"location", "rotation"})


def members(owner):
    """Return the objects that the path settings of an owner move: the owner first, then its wagons.

    A wagon whose leader is a different object is left out: a copied leader still lists the wagons of the original leader.
    """
    return [owner] + [pointed(wagon, "object") for wagon in _wagons(owner)]


def offsets(owner):
    """Return what lies between the owner and each member, (n,): metres along the path, or, with Gaps By Time, seconds; negative is behind.

    Each wagon lies one gap behind the member in front.
    """
    by_time = chosen(owner.motus.path, "gaps_by") == 'TIME'
    gaps = [wagon.delay if by_time else wagon.gap for wagon in _wagons(owner)]
    return -np.cumsum([0.0, *gaps])


def wheelbases(owner):
    """Return the wheelbase of each member, a list: of the owner's settings first, then of the wagons' entries."""
    return [owner.motus.path.wheelbase, *(wagon.wheelbase for wagon in _wagons(owner))]


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
    entries = leader.motus.path.wagons
    if index + 1 < len(entries):
        entries[index + 1].gap += entries[index].gap
        entries[index + 1].delay += entries[index].delay
    lists.remove(entries, index)
