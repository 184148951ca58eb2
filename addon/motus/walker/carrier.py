"""Carrier of a walker's ground, such as a ship or a lift: the steps are planned in its space, and its motion is added to them.

The space of a carrier goes and turns with it, and is not scaled.
"""

from mathutils import Matrix

from ..core import tracks
from ..core.animation.keys import union, united
from ..core.animation.strips import together
from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.scenery import meshes, stillness
from ..core.tracks import rotations

DEEPEST = 64
"""Most parents, one above the other, between a mesh of the ground and the carrier."""


def of(settings):
    """Return the object that carries the ground of a walker; None if there is none. settings: of the walker."""
    carrier = pointed(settings, "carrier")
    return None if carrier is None or deleted.is_deleted(carrier) else carrier


def is_gone(settings):
    """Whether the settings of a walker name a carrier that was deleted."""
    return pointed(settings, "carrier") is not None and of(settings) is None


def track_of(owner, scene):
    """Return the Track of the world matrix of a walker's carrier; None if there is none. owner: object that walks."""
    carrier = of(owner.motus.walker)
    return None if carrier is None else tracks.world_track(carrier, scene)


def placed(obj, carrier, track, scene):
    """Return the triangles of an evaluated mesh in the carrier's space, as a meshes.Placed; None if they may move in this space.

    track: of the carrier.
    """
    below = _below(obj, carrier.original)
    if below is None or not track.is_known or stillness.deforms(obj, scene):
        return None
    world = track.values(np.zeros(1))
    return meshes.placed(obj, Matrix(in_space(world, world)[0].tolist()) @ below)


def _below(obj, carrier):
    """Matrix of an object in the space of the original object `carrier`, one of its parents; None if it may move in it."""
    found = Matrix.Identity(4)
    for _ in range(DEEPEST):
        if obj.original == carrier:
            return found
        if obj.parent is None or obj.parent_type != 'OBJECT':
            return None
        if obj.animation_data is not None or obj.constraints or obj.rigid_body is not None:
            return None
        found = obj.matrix_parent_inverse @ obj.matrix_basis @ found
        obj = obj.parent
    return None


class InSpace:
    """Motion of a body in the space of a carrier, in the form of a Track. body, carrier: Tracks of their world matrices."""

    def __init__(self, body, carrier):
        self._body, self._carrier = self._both = body, carrier
        self.is_known = body.is_known and carrier.is_known
        self.rests_on_keys = body.rests_on_keys and carrier.rests_on_keys

    @property
    def stamp(self):
        """Hashable value that changes whenever the motion may change at any time; None if changes cannot be detected."""
        return together(("in space", *(track.stamp for track in self._both)))

    @property
    def extent(self):
        """(first, last) frame between which the motion changes; None if it never changes."""
        return united([track.extent for track in self._both])

    def bounds(self, first, last):
        """Rising frames from `first` to `last` between which the motion is smooth."""
        return union([track.bounds(first, last) for track in self._both])

    def values(self, times):
        """Matrices (n, 4, 4) of the body in the carrier's space at frames (n,)."""
        return in_space(self._carrier.values(times), self._body.values(times))


def in_space(carrier, body):
    """Matrices (n, 4, 4) of a body in the carrier's space, from world matrices (n, 4, 4) of both."""
    found, back = np.array(body), np.array(rotations.rigid(carrier))
    back[:, :3, :3] = back[:, :3, :3].transpose(0, 2, 1)
    found[:, :3, :3] = rotations.chained(back[:, :3, :3], body[:, :3, :3])
    found[:, :3, 3] = _turned(back, (body[:, :3, 3] - carrier[:, :3, 3])[:, None])[:, 0]
    return found


def space_of(world):
    """Matrix (4, 4) of a carrier's space, from its world matrix."""
    return rotations.rigid(np.array(world, float)[None])[0]


class Carried:
    """A native Walker that was planned in a carrier's space, as it walks in the world; it is asked as the native one is.

    worlds: function that returns the world matrices (n, 4, 4) of the carrier at times (n,), s.
    """

    def __init__(self, walker, worlds):
        self._walker, self._worlds = walker, worlds
        self.swing, self.phase = walker.swing, walker.phase
        self.problems, self.settled, self.leg_count = walker.problems, walker.settled, walker.leg_count

    def _spaces(self, times):
        return rotations.rigid(self._worlds(np.atleast_1d(np.asarray(times, float))))

    def _in_world(self, times, make, convert):
        """Convert what the native Walker has at times, a number or (n,), by the carrier's spaces at these times."""
        found = convert(self._spaces(times), make(np.atleast_1d(np.asarray(times, float))))
        return found if np.ndim(times) else found[0]

    def feet(self, times):
        """Places of the feet, as of the native Walker."""
        return self._in_world(times, self._walker.feet, lambda spaces, feet: _turned(spaces, feet) + spaces[:, None, :3, 3])

    def normals(self, times):
        """Normals of the ground under the feet, as of the native Walker."""
        return self._in_world(times, self._walker.normals, _turned)

    def turns(self, times):
        """Rotations of the soles, as of the native Walker."""
        return self._in_world(times, self._walker.turns, _after)

    def body(self, times):
        """How the body follows its feet, as of the native Walker."""
        offsets, turns = self._walker.body(np.atleast_1d(np.asarray(times, float)))
        spaces = self._spaces(times)
        own = rotations.of_rigid(spaces)
        offsets = _turned(spaces, offsets[:, None])[:, 0]
        turns = rotations.product(rotations.product(own, turns), own * (1.0, -1.0, -1.0, -1.0))
        return (offsets, turns) if np.ndim(times) else (offsets[0], turns[0])

    def steps_at(self, time):
        """The steps of the native Walker, where the carrier has their places at a time, s."""
        space, steps = self._spaces(time), self._walker.steps
        return steps | {name: _turned(space, steps[name][None])[0] + space[0, :3, 3] for name in ("start", "end", "apex")}

    @property
    def steps(self):
        """The steps of the native Walker, in the carrier's space."""
        return self._walker.steps


def _turned(spaces, vectors):
    """Vectors (n, m, 3) of spaces (n, 4, 4), in the world."""
    # Summed by hand: what NumPy sums may have other last digits from call to call.
    x, y, z = (spaces[:, None, :3, axis] * vectors[:, :, axis, None] for axis in range(3))
    return x + y + z


def _after(spaces, turns):
    """Rotations (n, m, 4) of spaces (n, 4, 4), in the world."""
    count = turns.shape[1]
    own = np.repeat(rotations.of_rigid(spaces), count, axis=0)
    return rotations.product(own, turns.reshape(-1, 4)).reshape(turns.shape)
