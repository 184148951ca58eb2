"""The own transforms of bones under systems that lay poses, such as layers: what the bones' own keys would be."""

import functools

from mathutils import Matrix

from .. import rigs, wiring
from ..lazy import numpy as np
from ..system import systems
from . import keys, solved
from .strips import together


def over(own, thing, scene):
    """The transforms.Own of an Object or PoseBone, with what is laid over it. scene: whose frame rate counts for systems."""
    if thing == thing.id_data or not len(thing.constraints):
        return own
    laying = [source for system in _laying() if (source := solved.of_bone_by(system, thing, scene))]
    return Laid(own, thing, laying) if laying else own


def is_laid(bone):
    """Whether a system lays poses over a PoseBone."""
    return any(wiring.is_sink(system, one) for one in bone.constraints for system in _laying())


def above(thing):
    """The constraints of an Object or PoseBone that act on top of its own transform: none that are muted or lay a pose."""
    return [one for one in thing.constraints if not one.mute and not any(wiring.is_sink(system, one) for system in _laying())]


class Laid:
    """As transforms.Own. solved: what lays poses over it, the lowest first."""

    def __init__(self, own, bone, laying):
        self._own, self._bone, self.solved = own, bone, laying

    @property
    def _parts(self):
        return [self._own, *self.solved]

    @functools.cached_property
    def reason(self):
        """As Channel.reason."""
        return next((part.reason for part in self._parts if part.reason), None)

    @property
    def solvers(self):
        """As World.solvers."""
        return [one.label for one in self.solved]

    @property
    def stamp(self):
        """As Channel.stamp."""
        return together([part.stamp for part in self._parts])

    def values(self, times):
        """Transforms at times (n,)."""
        found = self._own.values(times)
        for one in self.solved:
            found = one.applied(times, found)
        return found

    def bounds(self, first, last):
        """As Channel.bounds()."""
        return keys.union([part.bounds(first, last) for part in self._parts])

    @property
    def extent(self):
        """As Channel.extent."""
        return keys.united(part.extent for part in self._parts)

    @property
    def present(self):
        """A row of location, rotation and scale as the layers of an evaluated rig have laid them last."""
        rig = self._bone.id_data
        known = rigs.still(rig, rigs.names_of(rig))
        row = known.names.index(self._bone.name)
        return np.concatenate([np.array(part) for part in Matrix(rigs.basis(rig, known)[row].reshape(4, 4).T.tolist()).decompose()])


def _laying():
    return [system for system in systems() if system.lays_pose]
