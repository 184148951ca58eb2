"""Own transforms over time: location, rotation and scale of objects and bones below their parents, as Blender computes them."""

import functools
from typing import Any, NamedTuple

from .. import keeping
from ..animation import keys, strips
from ..animation.channel import Channel, is_driven
from ..animation.reason import Reason
from ..blender import actions
from ..evaluated import copies
from ..lazy import numpy as np
from . import rotations

ROTATIONS = {'QUATERNION': ("rotation_quaternion", 4), 'AXIS_ANGLE': ("rotation_axis_angle", 4)}
DELTA_ROTATIONS = {'QUATERNION': ("delta_rotation_quaternion", 4), 'AXIS_ANGLE': None}
"""Delta rotation property of each rotation mode, and its size; None for axis and angle, for which Blender has no delta rotation."""
LARGEST_CACHE = 1024  # objects and bones: those of some rigs, in a viewport and a render

_keys = keeping.OfFile(
    "channels of an object or bone that have keys", "stamp of the action, beginning of the data paths, rotation mode", LARGEST_CACHE
)
_DRIVEN = keeping.OfEvaluation(
    "whether a driver sets any channel of an object or bone", "beginning of the data paths, rotation mode", "one for each object or bone"
)


class Transforms(NamedTuple):
    """Transforms at n times: locations (n, 3), rotations (n, 4; w, x, y, z) as unit quaternions, scales (n, 3), all float64."""

    locations: Any
    rotations: Any
    scales: Any

    @property
    def matrices(self):
        """The transforms as matrices (n, 4, 4) for column vectors: translation @ rotation @ scale."""
        return _matrices(*self)


@rotations.by_rows
def _matrices(locations, turns, scales):
    found = np.zeros((len(locations), 4, 4))
    found[:, :3, :3] = rotations.matrices(turns) * scales[:, None, :]
    found[:, :3, 3] = locations
    found[:, 3, 3] = 1.0
    return found


@rotations.by_rows
def _sum(left, right):
    return left + right


@rotations.by_rows
def _product(left, right):
    return left * right


PARTS = "location", "rotation", "scale"


class Own:
    """Own transform over time of an Object or PoseBone: what its channels give, delta transforms included, below parents and constraints.

    parts: those of "location", "rotation" and "scale" that are needed; for the rest the present value may stand at all times.
    """

    def __init__(self, thing, parts=PARTS):
        self._thing, self._counting = thing, frozenset(parts)
        self._id = thing.id_data
        self._prefix = "" if thing == self._id else f"{thing.path_from_id()}."
        self._mode = thing.rotation_mode

    price = 10
    """Cost of location, rotation and scale at one time, in units of core/measures/bounds.py (about a microsecond)."""

    @functools.cached_property
    def channels(self):
        """Channels {property: [Channel of each element]} of the properties that have an effect in the present rotation mode."""
        return {name: [Channel(self._id, self._prefix + name, index) for index in range(size)] for name, size in self._names().items()}

    @functools.cached_property
    def reason(self):
        """Reason why the own transform is unknown at frames other than the present one; None if it is known.

        It is the Reason of the first needed channel that has one. Keys or drivers that change the rotation mode are a Reason too.
        """
        if self._is_simple:
            changes_mode = self._keys_at[1]
        else:
            changes_mode = not Channel(self._id, f"{self._prefix}rotation_mode", -1).is_constant
        if changes_mode:
            return Reason(Reason.MODE, thing=self._thing.name)
        if self._is_simple:
            return None
        return next((one.reason for one in self._counted if one.reason), None)

    @property
    def _counted(self):
        """Channels of the needed parts of the transform."""
        return [one for name, group in self.channels.items() if any(part in name for part in self._counting) for one in group]

    @property
    def stamp(self):
        """Hashable value that changes whenever the own transform may change at any time; None if changes cannot be detected."""
        if not self._id.is_evaluated:
            return None
        if not self._is_simple:
            return strips.together((self._mode, *(one.stamp for one in self._counted)))
        return strips.together((self._mode, self._prefix, self._action, *self._still_values()))

    @property
    def rests_on_keys(self):
        """Whether nothing but keys of the active action can change the own transform over time while the evaluated copy stays."""
        return self._is_simple and not self._keys_at[1]

    def values(self, times):
        """Own transforms at times, (n,) frames of the scene, as Transforms."""
        if self._is_simple:
            return self._combined({name: self._keyed(name, size, times) for name, size in self._names().items()})
        return self._combined({name: np.stack([one.values(times) for one in group], axis=1) for name, group in self.channels.items()})

    def _keyed(self, name, size, times):
        """Values (n, size) at times (n,) of a property that nothing animates but keys of the active action. Transforms have no limits."""
        curves = self._curves(name, size)
        found = np.broadcast_to(np.array(getattr(self._thing, name), float), (len(times), size))
        if any(curve is not None for curve in curves):
            found = found.copy()
        for index, curve in enumerate(curves):
            if curve is not None:
                found[:, index] = keys.values(curve, times)
        return found

    def _curves(self, name, size):
        curves = actions.curves_of(self._id.animation_data)
        return [strips.acting(curves, self._prefix + name, index) for index in range(size)]

    def _combined(self, found):
        locations, scales = found["location"], found["scale"]
        if self._prefix == "":
            locations = _sum(locations, found["delta_location"])
            scales = _product(scales, found["delta_scale"])
        return Transforms(locations, self._quaternions(found), scales)

    def bounds(self, first, last):
        """Rising frames from first to last, between which the own transform changes smoothly."""
        if self._is_simple:
            found = [curve for name, size in self._names().items() for curve in self._curves(name, size) if curve]
            return keys.union([[first, last], *(keys.bounds(curve, first, last) for curve in found)])
        return keys.union([[first, last], *(one.bounds(first, last) for one in self._counted)])

    @property
    def extent(self):
        """(first, last) frame between which the own transform changes, infinite if it goes on changing; None if it is constant."""
        if self._is_simple:
            found = [curve for name, size in self._names().items() for curve in self._curves(name, size) if curve]
            return keys.united(map(keys.extent, found))
        return keys.united(one.extent for one in self._counted)

    @property
    def present(self):
        """Sample for a recording, (10,): present location, rotation (w, x, y, z) and scale that the channels give."""
        found = {name: np.array([[one.number.present for one in group]]) for name, group in self.channels.items()}
        return np.concatenate([part[0] for part in self._combined(found)])

    @functools.cached_property
    def _is_simple(self):
        """Whether nothing but keys of the active action animates the own transform: neither NLA strips nor drivers."""
        animation = self._id.animation_data
        if animation is None:
            return True
        if animation.use_nla and len(animation.nla_tracks):
            return False
        return not len(animation.drivers) or not self._has_drivers()

    def _has_drivers(self):
        """Whether a driver sets a channel of the transform or the rotation mode.

        The answer is kept for as long as Blender keeps the evaluated copy, if the copy can be told apart from later ones.
        """
        known = _DRIVEN.on(copies.of(self._id) if self._id.is_evaluated else None)
        place = self._prefix, self._mode
        if place not in known:
            known[place] = any(
                is_driven(self._id, self._prefix + name, index)
                for name, size in (*self._names().items(), ("rotation_mode", 1))
                for index in range(size)
            )
        return known[place]

    @functools.cached_property
    def _action(self):
        """Stamp of the active action (strips.stamp_of_action); None if edits cannot be detected, () if there is no action."""
        animation = self._id.animation_data
        return strips.stamp_of_action(animation) if animation and animation.action else ()

    @functools.cached_property
    def _keys_at(self):
        """({property: indices of its components without keys}, whether the rotation mode has keys).

        The properties are location, rotation and scale of the object or bone, and the delta transforms of an object.
        """
        if self._id.animation_data is None:
            return {name: range(size) for name, size in self._names().items()}, False
        place = (self._action, self._prefix, self._mode) if self._id.is_evaluated and self._action else None
        return _keys.made(place, self._find_keys) if place else self._find_keys()

    def _find_keys(self):
        still = {
            name: [index for index, curve in enumerate(self._curves(name, size)) if curve is None] for name, size in self._names().items()
        }
        return still, any(self._curves("rotation_mode", 1))

    def _still_values(self):
        """Values of the channels without keys, one tuple for each property."""
        for name, indices in self._keys_at[0].items():
            values = getattr(self._thing, name)
            yield tuple([values[index] for index in indices])

    def _names(self):
        mode = self._mode
        rotation, size = ROTATIONS.get(mode, ("rotation_euler", 3))
        names = {"location": 3, rotation: size, "scale": 3}
        if self._prefix == "":
            names |= {"delta_location": 3, "delta_scale": 3}
            delta = DELTA_ROTATIONS.get(mode, ("delta_rotation_euler", 3))
            names |= dict([delta] if delta else [])
        return names

    def _quaternions(self, found):
        """Unit quaternions (n, 4) of the own rotation with its delta rotation. found: {name of a property: its values}."""
        kind = ROTATIONS.get(self._mode, ("rotation_euler", 3))[0]
        parts = [rotations.of_mode(found[name], self._mode) for name in (kind, f"delta_{kind}") if name in found]
        return parts[0] if len(parts) == 1 else rotations.product(parts[1], parts[0])
