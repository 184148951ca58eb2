"""Own transforms over time of pose bones that systems pose as keys do, such as layers (System.lays_pose).

An own transform is PoseBone.matrix_basis: it lies below the bone's parents and constraints. To lay a pose over a bone means to change
the bone's own transform; all constraints and solvers of different systems start from the changed transform.
"""

import functools

import bpy
from mathutils import Matrix

from .. import rigs, wiring
from ..animation import keys
from ..animation.strips import together
from ..declare import laying_systems
from ..evaluated.question import answered
from ..lazy import numpy as np
from . import solved


def over(own, thing):
    """Own transform over time of an Object or PoseBone, after the systems that lay poses over it.

    own: transforms.Own of `thing`, which is returned unchanged if no system lays poses over `thing`; otherwise the result is a Laid.
    """
    if not isinstance(thing, bpy.types.PoseBone) or not len(thing.constraints):
        return own
    sources = [source for system in _laying() if (source := solved.of_bone_by(system, thing, None))]
    return Laid(own, thing, sources) if sources else own


def is_laid(bone):
    """Whether a PoseBone has a constraint by which a system lays poses (System.lays_pose) over the bone."""
    return any(wiring.is_sink(system, one) for system in _laying() for one in bone.constraints)


def _laying():
    return answered("laying systems", laying_systems)


class Laid:
    """Own transform of a pose bone over time, after the systems that lay poses over the bone.

    own: transforms.Own of the bone. laying: a solved.Solved of the bone for each of these systems, the lowest first; it becomes the
    attribute `solved`.
    """

    def __init__(self, own, bone, laying):
        self._own, self._bone, self.solved = own, bone, laying

    @property
    def _parts(self):
        return [self._own, *self.solved]

    @functools.cached_property
    def reason(self):
        """Reason why the bone's own transform is unknown at frames other than the present one; None if it is known."""
        return next((part.reason for part in self._parts if part.reason), None)

    @property
    def solvers(self):
        """Labels of the systems that lay poses over the bone, the lowest first."""
        return [one.label for one in self.solved]

    @property
    def stamp(self):
        """Hashable value that changes whenever the bone's own transform may change at any time; None if changes cannot be detected."""
        return together([part.stamp for part in self._parts])

    @property
    def price(self):
        """Cost of computing the bone's own transform at one time, in units of core/measures/bounds.py (about a microsecond)."""
        return sum(part.price for part in self._parts)

    def values(self, times):
        """Own transforms of the bone at times, (n,) frames of the scene, as transforms.Transforms."""
        found = self._own.values(times)
        for one in self.solved:
            found = one.applied(times, found)
        return found

    def bounds(self, first, last):
        """Ascending frames from first to last; between two neighbouring frames the bone's own transform changes smoothly."""
        return keys.union([part.bounds(first, last) for part in self._parts])

    @property
    def extent(self):
        """(first, last) frame between which the bone's own transform changes, infinite if it goes on changing; None if it is constant."""
        return keys.united(part.extent for part in self._parts)

    @property
    def present(self):
        """Sample for a recording, (10,): location, rotation (w, x, y, z) and scale of the bone's own transform in the evaluated rig."""
        rig = self._bone.id_data
        known = rigs.still(rig, rigs.names_of(rig))
        matrix = rigs.basis(rig, known)[known.names.index(self._bone.name)].reshape(4, 4).T
        return np.concatenate([np.array(part) for part in Matrix(matrix.tolist()).decompose()])
