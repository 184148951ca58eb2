"""The own transforms of bones under systems that lay poses, such as layers: what the bones' own keys would be."""

import functools

import bpy
from mathutils import Matrix

from .. import rigs, wiring
from ..animation import keys
from ..animation.strips import together
from ..declare import laying
from ..lazy import numpy as np
from . import solved


def over(own, thing):
    """The transforms.Own of an Object or PoseBone, with what is laid over it."""
    if not isinstance(thing, bpy.types.PoseBone) or not len(thing.constraints):
        return own
    sources = [source for system in laying() if (source := solved.of_bone_by(system, thing, None))]
    return Laid(own, thing, sources) if sources else own


def is_laid(bone):
    """Whether a system lays poses over a PoseBone."""
    return any(wiring.is_sink(system, one) for system in laying() for one in bone.constraints)


class Laid:
    """A bone's own transform over time, after systems that lay poses over it. solved: these systems' parts, the lowest first."""

    def __init__(self, own, bone, laying):
        self._own, self._bone, self.solved = own, bone, laying

    @property
    def _parts(self):
        return [self._own, *self.solved]

    @functools.cached_property
    def reason(self):
        """The Reason for which the values are not known at other frames; None if they are known."""
        return next((part.reason for part in self._parts if part.reason), None)

    @property
    def solvers(self):
        """Labels of the systems that are asked for the values."""
        return [one.label for one in self.solved]

    @property
    def stamp(self):
        """Hashable value that changes whenever the bone's transform may change at any time; None if changes cannot be detected."""
        return together([part.stamp for part in self._parts])

    @property
    def price(self):
        """Price of the values for each time (see core/measures/bounds.py)."""
        return sum(part.price for part in self._parts)

    def values(self, times):
        """Transforms at times (n,)."""
        found = self._own.values(times)
        for one in self.solved:
            found = one.applied(times, found)
        return found

    def bounds(self, first, last):
        """Ascending frames from first to last; between two neighbouring frames the bone's transform changes smoothly."""
        return keys.union([part.bounds(first, last) for part in self._parts])

    @property
    def extent(self):
        """First and last frame between which the values change; None if they do not."""
        return keys.united(part.extent for part in self._parts)

    @property
    def present(self):
        """A row of location, rotation and scale, as the evaluated rig has them."""
        rig = self._bone.id_data
        known = rigs.still(rig, rigs.names_of(rig))
        matrix = rigs.basis(rig, known)[known.names.index(self._bone.name)].reshape(4, 4).T
        return np.concatenate([np.array(part) for part in Matrix(matrix.tolist()).decompose()])
