"""Transforms over time of objects and bones that a system of Motus drives: the system computes them at any times.

System.over_time returns None, or an object with these attributes:

    reason                     Reason why the result is unknown at frames other than the present one; None if it is known
    applied(times, matrices)   of an object: its world matrices (n, 4, 4) at times (n,), from those that its own channels and
                               parents give; of a bone: its own transforms.Transforms, from those that its channels give
    bounds(first, last)        rising frames, between which the result changes smoothly
    extent                     (first, last) frame between which the result changes; None if it is constant
    stamp                      hashable value that changes whenever the result may change; None if changes cannot be detected
    price                      optional: cost of one time, in units of core/measures/bounds.py; PRICE if it is missing
"""

import threading

from .. import wiring
from ..animation.reason import Reason
from ..declare import laying_systems, systems
from ..file.pointers import pointed
from ..lazy import numpy as np
from . import rotations

PRICE = 30
"""Usual cost of a system's transform at one time, its inputs not counted, in units of core/measures/bounds.py (about a microsecond)."""

_asked = set()
"""(thread, hash of an object or bone, label of the system) of all results whose `reason` is being determined, to detect loops."""


class Solved:
    """Result over time of one system on an Object or PoseBone, a link in its chain of parents.

    source: what System.over_time has returned. label: the system's label, for the panel.
    """

    def __init__(self, system, thing, source):
        self.label, self._thing, self._source = system.label, thing, source
        self.bounds, self.applied = source.bounds, source.applied
        self.price = getattr(source, "price", PRICE)

    @property
    def reason(self):
        """Reason why the system's result is unknown at frames other than the present one; None if it is known."""
        place = threading.get_ident(), hash(self._thing), self.label
        if place in _asked:  # a loop, such as a curve whose parent follows that curve
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
        """(first, last) frame between which the system's result changes, infinite if it goes on changing; None if it is constant."""
        return self._source.extent


def placed(matrices, locations, turns, acts):
    """World matrices (n, 4, 4) with new locations (n, 3) and rotations at the times for which `acts`, (n,) bool, is true; the scale stays.

    turns: quaternions (n, 4; w, x, y, z) of the new rotations; None leaves the rotations.
    """
    found = matrices.copy()
    if turns is not None:
        sizes = np.sqrt((found[:, :3, :3] ** 2).sum(axis=1, keepdims=True))
        found[acts, :3, :3] = (rotations.matrices(turns) * sizes)[acts]
    found[acts, :3, 3] = locations[acts]
    return found


def turned(matrices, turns, scales):
    """World matrices (n, 4, 4) with an additional rotation between the object's own rotation and the object's own scale.

    turns: unit quaternions (n, 4). scales: (n, 3) of the objects. A matrix M @ S, with the scale S, becomes M @ turn @ S.
    """
    found = matrices.copy()
    safe = np.where(scales != 0.0, scales, 1.0)
    below = rotations.matrices(turns) * scales[:, None, :] / safe[:, :, None]
    found[:, :3, :3] = rotations.chained(matrices[:, :3, :3], below)
    return found


def of(obj, scene):
    """Result over time of the system that drives an object, original or evaluated, as a Solved.

    None if no system drives the object alone, or if the system cannot compute the result over time.
    """
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
    """Whether all constraints of an object are sinks of the system: constraints that bring its results to what it drives.

    Sinks whose hub (the helper object that they read) is missing count too. Slower than _have_marks().
    """
    sinks = {constraint for _, constraint, *_ in wiring.on_object(system, obj, has_bones=False)}
    return all(one in sinks for one in constraints)


def of_bone(bone, scene, beneath=None):
    """Result over time of the system that alone drives a PoseBone, as a Solved; None if no system does. The system's owner is the rig.

    Systems that lay poses (System.lays_pose) are left out. beneath: a System whose constraints are left out too, or None.
    """
    acting = acting_on(bone, beneath)
    found = acting and next((system for system in systems() if all(wiring.is_sink(system, one) for one in acting)), None)
    return of_bone_by(found, bone, scene) if found else None


def of_bone_by(system, bone, scene):
    """Result over time of one system on a PoseBone, as a Solved; None if the system does not drive the bone or has no result over time."""
    rig = bone.id_data
    if not system.over_time or not rig.is_property_set("motus") or not getattr(rig.motus, system.name).is_active:
        return None
    if not any(not one.mute and wiring.is_sink(system, one) for one in bone.constraints):
        return None
    source = system.over_time(rig, bone, scene)
    return Solved(system, bone, source) if source else None


def acting_on(thing, beneath=None):
    """Unmuted constraints that act on top of the own transform of an Object or PoseBone.

    The constraints of systems that lay poses (System.lays_pose) belong to the own transform: they are left out.
    beneath: a System whose constraints are left out too, or None.
    """
    skipped = [system for system in (*laying_systems(), beneath) if system]
    return [one for one in thing.constraints if not one.mute and not any(wiring.is_sink(system, one) for system in skipped)]
