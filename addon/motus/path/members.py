"""Who follows: the owner of the settings and its wagons, and what of them is driven."""

from ..core.file import libraries
from ..core.file.choices import chosen
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np


def channels(settings):
    """What is driven; without an orientation the object keeps its own rotation."""
    return frozenset({"location"} if chosen(settings, "orientation") == 'NONE' else {"location", "rotation"})


def members(owner):
    """The owner, then the wagons that exist and have no other leader (the copy of a leader lists the first one's)."""
    return [owner] + [pointed(wagon, "object") for wagon in _wagons(owner)]


def offsets(owner):
    """Distance along the path of each member from the owner's: each is a gap behind the one before it."""
    gaps = [wagon.gap for wagon in _wagons(owner)]
    return -np.cumsum([0.0, *gaps])


def _wagons(owner):
    return [entry for entry in owner.motus.path.wagons if _is_own(pointed(entry, "object"), owner)]


def _is_own(wagon, owner):
    return wagon is not None and libraries.is_free_or_of(wagon, pointed(wagon.motus.path, "leader"), owner)


def index_of(leader, wagon):
    """Index of an object in its leader's list of wagons, or -1."""
    return next((i for i, entry in enumerate(leader.motus.path.wagons) if pointed(entry, "object") == wagon), -1)


def is_wagon(obj):
    """Whether a train has this object among its wagons. The copy of a wagon names the leader too, but is not."""
    leader = pointed(obj.motus.path, "leader")
    return leader is not None and index_of(leader, obj) >= 0


def take_out(leader, index):
    """Remove an entry from the list of wagons; those behind keep their places."""
    wagons = leader.motus.path.wagons
    if index + 1 < len(wagons):
        wagons[index + 1].gap += wagons[index].gap
    wagons.remove(index)
