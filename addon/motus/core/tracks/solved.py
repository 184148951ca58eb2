"""Objects and bones that a system of Motus's drives: the system itself is asked where they are at any times.

What System.over_time gives is None, or has

    reason                     as Channel.reason
    applied(times, matrices)   world matrices (n, 4, 4) of the object, from those that its own channels and parents make;
                               of a bone its own Transforms, from those of its channels
    bounds, extent, stamp      as those of Channel
    price                      as Track.price, if it is another than PRICE
"""

import threading

from .. import wiring
from ..animation.reason import Reason
from ..declare import laying, systems
from ..file.pointers import pointed
from ..lazy import numpy as np
from . import rotations

PRICE = 30
"""As Track.price: about what a transform of a system's takes, beside what it reads."""

_asked = set()
"""(thread, object or bone, label of the system) of all that is being asked for its reason."""


class Solved:
    """The result of a system on an Object or PoseBone, as a part of a chain of parents. label: the system's."""

    def __init__(self, system, thing, source):
        self.label, self._thing, self._source = system.label, thing, source
        self.bounds, self.applied = source.bounds, source.applied
        self.price = getattr(source, "price", PRICE)

    @property
    def reason(self):
        """The Reason for which the values are not known at other frames; None if they are known."""
        place = threading.get_ident(), hash(self._thing), self.label
        if place in _asked:  # such as a curve that hangs on what follows it
            return Reason(Reason.LOOP, thing=self._thing.name)
        _asked.add(place)
        try:
            return self._source.reason
        finally:
            _asked.discard(place)

    @property
    def stamp(self):
        """Hashable value that changes whenever the system's result may change at any time; None if changes cannot be detected."""
        return self._source.stamp

    @property
    def extent(self):
        """First and last frame between which the values change; None if they do not."""
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
    owners = [
        (system, obj if settings.is_active else pointed(settings, "leader"))
        for system in systems()
        if system.over_time
        for settings in [getattr(obj.motus, system.name)]
    ]
    for are_sinks in _have_marks, _are_known:
        for system, owner in owners:
            source = system.over_time(owner, obj, scene) if owner and are_sinks(system, obj, acting) else None  # type: ignore[misc]
            if source is not None:
                return Solved(system, obj, source)
    return None


def _have_marks(system, _obj, constraints):
    return all(wiring.is_sink(system, one) for one in constraints)


def _are_known(system, obj, constraints):
    """Whether all constraints are sinks of the system, those that have lost their hub among them: slower than _have_marks()."""
    sinks = {constraint for _, constraint, *_ in wiring.on_object(system, obj, has_bones=False)}
    return all(one in sinks for one in constraints)


def of_bone(bone, scene, beneath=None):
    """The Solved of a PoseBone, on top of poses laid over the bone; its owner is the rig. beneath: a System whose sinks do not count."""
    acting = acting_on(bone, beneath)
    found = acting and next((system for system in systems() if all(wiring.is_sink(system, one) for one in acting)), None)
    return of_bone_by(found, bone, scene) if found else None


def of_bone_by(system, bone, scene):
    """The result of one system on a PoseBone; None if the system does not drive the bone, or cannot be asked."""
    rig = bone.id_data
    if not system.over_time or not rig.is_property_set("motus") or not getattr(rig.motus, system.name).is_active:
        return None
    if not any(not one.mute and wiring.is_sink(system, one) for one in bone.constraints):
        return None
    source = system.over_time(rig, bone, scene)
    return Solved(system, bone, source) if source else None


def acting_on(thing, beneath=None):
    """The constraints that act on top of the own transform of an Object or PoseBone: none that lays a pose. beneath: as of of_bone()."""
    skipped = [system for system in (*laying(), beneath) if system]
    return [one for one in thing.constraints if not one.mute and not any(wiring.is_sink(system, one) for system in skipped)]
