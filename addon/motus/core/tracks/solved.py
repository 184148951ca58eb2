"""Objects that a system of Motus's drives: the system itself is asked where they are at any times.

What System.over_time gives is None, or has

    reason                     as Channel.reason
    applied(times, matrices)   world matrices (n, 4, 4) of the object, from those that its own channels and parents make
    bounds, extent, stamp      as those of Channel
"""

import threading

from .. import wiring
from ..lazy import numpy as np
from ..system import systems
from . import rotations
from .reason import Reason

_asked = set()
"""(thread, object) of all that is being asked for its reason."""


class Solved:
    """What a system makes of an object, as a part of a chain of parents. label: of the system."""

    def __init__(self, system, obj, source):
        self.label, self._object, self._source = system.label, obj, source
        self.bounds, self.applied = source.bounds, source.applied

    @property
    def reason(self):
        """As Channel.reason."""
        place = threading.get_ident(), hash(self._object)
        if place in _asked:  # such as a curve that hangs on what follows it
            return Reason(Reason.LOOP, thing=self._object.name)
        _asked.add(place)
        try:
            return self._source.reason
        finally:
            _asked.discard(place)

    @property
    def stamp(self):
        """As Channel.stamp."""
        return self._source.stamp

    @property
    def extent(self):
        """As Channel.extent."""
        return self._source.extent


def placed(matrices, locations, turns, acts):
    """World matrices with places, and turns (n, 4) or None, of their own where `acts` (n,); the scale stays."""
    found = matrices.copy()
    if turns is not None:
        sizes = np.sqrt((found[:, :3, :3] ** 2).sum(axis=1, keepdims=True))
        found[acts, :3, :3] = (rotations.matrices(turns) * sizes)[acts]
    found[acts, :3, 3] = locations[acts]
    return found


def turned(matrices, turns, scales):
    """World matrices with turns (n, 4) after the objects' own rotation, below their own scales (n, 3)."""
    found = matrices.copy()
    safe = np.where(scales != 0.0, scales, 1.0)
    below = rotations.matrices(turns) * scales[:, None, :] / safe[:, :, None]
    found[:, :3, :3] = rotations.chained(matrices[:, :3, :3], below)
    return found


def of(obj, scene):
    """The Solved of an object, original or evaluated; None where no system drives it that can be asked, or not it alone."""
    acting = [constraint for constraint in obj.constraints if not constraint.mute]
    if not acting or not obj.is_property_set("motus"):
        return None
    for system in systems():
        if system.over_time is None:
            continue
        settings = getattr(obj.motus, system.name)
        owner = obj if settings.is_active else settings.leader
        sinks = {constraint for _, constraint, *_ in wiring.on_object(system, obj)} if owner else ()
        source = system.over_time(owner, obj, scene) if sinks and all(one in sinks for one in acting) else None
        if source is not None:
            return Solved(system, obj, source)
    return None
