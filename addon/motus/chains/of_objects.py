"""Chains of objects in a row: each is a particle, and turns with the link to it from the one before."""

import functools
import itertools
from typing import Any, NamedTuple

import bpy
from mathutils import Matrix, Vector

from ..core.animation import strips
from ..core.blender import helpers
from ..core.declare import CopyOf, Member, Transform
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.tracks import in_world, own_track, rotations, world_track
from ..core.tracks.inputs import Input, stamp_of_known
from ..core.tracks.track import kept_by
from . import curves

MOVE = frozenset({"location", "rotation"})
_LEAST = 1e-12  # part of a length, below which the sum of two opposite directions counts as none


class Row(NamedTuple):
    """A chain of objects. entry: its settings. root: Object that stays on the animation. things: Objects that hang on it, one on the other.

    Has the attributes of of_bones.Bones.
    """

    entry: Any
    root: Any
    things: tuple

    @property
    def _is_spline(self):
        """Whether the objects are anchors of a spline's points, children of the curve."""
        return self.entry.spline >= 0

    @property
    def names(self):
        """Names of the objects, as a tuple."""
        return tuple(obj.name for obj in self.things)

    @property
    def drives(self):
        """The objects."""
        return self.things

    @property
    def reads(self):
        """((object, name of a bone or ""), ...) of each transform that the chain needs: of the root, and of what the objects hang on."""
        parents = [(obj.parent, obj.parent_bone if obj.parent_type == 'BONE' else "") for obj in self.things if obj.parent]
        return tuple(dict.fromkeys([(self.root.parent if self._is_spline else self.root, ""), *parents]))

    @property
    def inputs(self):
        """Inputs of the Group for which the solver waits."""
        read = [self.root, self.root.parent.data] if self._is_spline else []
        return (*(Transform(*pair) for pair in self.reads), *map(CopyOf, (*self.things, *read)))

    @property
    def members(self):
        """Members of the Group: the objects, which move and turn on top of their own transforms."""
        return tuple(Member(obj, MOVE, 'LOCAL', is_relative=True) for obj in self.things)

    @property
    def parents(self):
        """Index of the parent of each particle, -1 first: the root, then each object."""
        return range(-1, len(self.things))

    def is_as_wired(self, names):
        """Whether the chain has as many objects as when the owner was wired, which had these names; objects may be renamed."""
        return len(self.things) == len(names)

    @property
    def kept(self):
        """The Kept."""
        return Kept(self.root, self.things, self.entry.spline)

    @property
    def ends(self):
        """Both ends of each link, as they stand now, in the world. For evaluated objects."""
        start = self.root.parent.matrix_world @ self.root.location if self._is_spline else self.root.matrix_world.translation
        places = [start, *(obj.matrix_world.translation for obj in self.things)]
        return [end for link in itertools.pairwise(places) for end in link]

    def read_by(self, _source):
        """List what the input reads that may change although the owner is not edited: hashable, with stamp(owner, scene)."""
        return [self.kept]

    def source(self, scene):
        """Make the input (core/tracks/inputs.py) with the places of the particles in the animation."""
        return Origins(self.root, self.things, scene)


class Moved(NamedTuple):
    """Objects of a row at n times, taken along by its particles.

    moves, turns: (n, k, 3) and (n, k, 4), in the world, from where the animation has them. axes: (n, k, 4), own rotations of the objects in
    the world, beneath their own scale, as Blender takes their matrices apart.
    """

    moves: Any
    turns: Any
    axes: Any


class Origins(Input):
    """Input that is the motion of the origins of objects in world space, by their own animation and that of their parents.

    root: the Object that stays on its animation, all of it. things: the Objects that hang, without what the chain does to them. Those
    without a parent, keys and drivers are taken along by the root from the scene's first frame on, as its children would be. All are
    original, or all evaluated.
    """

    def __init__(self, root, things, scene):
        super().__init__(things, scene)
        self._root = root

    @functools.cached_property
    def _rooted(self):
        return world_track(self._root, self._scene)

    @functools.cached_property
    def _carried(self):
        """{parent of any of the objects, an Object or PoseBone: track of its world matrix}."""
        parents = dict.fromkeys(filter(None, map(in_world.parent_of, self._thing)))
        return {parent: world_track(parent, self._scene) for parent in parents}

    @functools.cached_property
    def _own(self):
        return [own_track(obj) for obj in self._thing]

    @functools.cached_property
    def listed(self):
        """[(track, keywords of the operator motus.track_record)] of the root, of what the objects hang on, and of their own transforms."""
        found = [] if helpers.is_helper(self._root) else [(self._rooted, {"datablock": self._root.name, "transform": 'WORLD'})]
        for parent, track in self._carried.items():
            names = {"bone": parent.name} if isinstance(parent, bpy.types.PoseBone) else {}
            found.append((track, {"datablock": parent.id_data.name, "transform": 'WORLD', **names}))
        own = zip(self._thing, self._own)
        return [*found, *((track, {"datablock": obj.name, "transform": 'OWN'}) for obj, track in own)]

    @property
    def reason(self):
        return next(filter(None, map(in_world.of_parent, self._thing)), None)

    @property
    def stamp(self):
        """Hashable value that changes whenever the input may at any time; None if changes cannot be detected."""
        hung = [(obj.parent_type, tuple(map(tuple, obj.matrix_parent_inverse))) for obj in self._thing]
        return strips.together((*map(stamp_of_known, (self._rooted, *self.tracks)), scene_time.first(self._scene), *hung))

    def kept(self, name, make):
        """Return make(), kept until the animation changes, so that an edit of the settings does not compute it again."""
        return kept_by(self.stamp, (name, len(self._thing)), make)

    @functools.cached_property
    def _taken(self):
        """For each object whether the root takes it along as if it were its child: nothing else moves it."""
        pairs = zip(self._thing, self._own)
        return [in_world.parent_of(obj) is None and track.is_known and track.extent is None for obj, track in pairs]

    def places(self, frames):
        """Return world positions (n, 3) at frames (n,): of the root's origin, then of the origin of each object."""
        rooted = self._rooted.values(frames)
        way = self._way(frames, rooted)
        rests = [rotations.chained(way, world) if taken else world for (_, world, _), taken in zip(self._worlds(frames), self._taken)]
        return tuple(np.broadcast_to(matrices[:, :3, 3], (len(frames), 3)) for matrices in (rooted, *rests))

    def _way(self, frames, rooted):
        """Matrices (n or 1, 4, 4) by which the root has moved since the scene's first frame. rooted: its world matrices at the frames."""
        if not any(self._taken):
            return np.eye(4)[None]
        first = self._rooted.values(np.array([scene_time.first(self._scene)], float))[0]
        return rotations.chained(rooted, np.array(Matrix(first).inverted_safe())[None])

    def _worlds(self, frames):
        """List (own Transforms, world matrices, matrices of the space of its channels or None) at frames (n,) for each object."""
        found = []
        for obj, own in zip(self._thing, self._own):
            transforms, space, parent = own.values(frames), None, in_world.parent_of(obj)
            matrices = transforms.matrices
            if parent is not None:
                space = rotations.chained(self._carried[parent].values(frames), in_world.parent_offset(obj))
                matrices = rotations.chained(space, matrices)
            found.append((transforms, matrices, space))
        return found

    def moved(self, frames, particles, weight):
        """Return the Moved at frames (n,). particles: (n, k + 1, 3), world space, the root's first. weight: 0 to 1."""
        count = len(frames)
        rests = self.places(frames)
        way = rotations.of_axes(self._way(frames, self._rooted.values(frames))[:, :3, :3])
        link, still = (np.broadcast_to((1.0, 0.0, 0.0, 0.0), (count, 4)) for _ in range(2))
        moves, turns, axes = [], [], []
        for index, (transforms, world, space) in enumerate(self._worlds(frames), 1):
            before, after = rests[index] - rests[index - 1], particles[:, index] - particles[:, index - 1]
            link = rotations.product(_arc(_rotated(link, before), after), link)
            turned = rotations.product(link, way) if self._taken[index - 1] else link
            own = rotations.product(transforms.rotations, rotations.mirrored(transforms.scales))
            turns.append(rotations.mixed(still, turned, np.full(count, weight)))
            moves.append(weight * (particles[:, index] - world[:, :3, 3]))
            axes.append(own if space is None else rotations.product(rotations.of_axes(space[:, :3, :3]), own))
        return Moved(*(np.stack([np.broadcast_to(one, (count, one.shape[1])) for one in part], axis=1) for part in (moves, turns, axes)))


class Kept(NamedTuple):
    """What is kept of a row between evaluations: its evaluated root and objects, and the index of the spline that they anchor, or -1."""

    root: Any
    things: tuple
    spline: int

    def stamp(self, owner, scene):
        """Hashable value that changes whenever the animation of the row may; None if changes cannot be detected."""
        return strips.together((len(curves.points(owner, self.spline)), Origins(self.root, self.things, scene).stamp))

    @staticmethod
    def fill(context, _text, parts):
        """Move and turn the objects of rows to their particles.

        parts: [(Kept, rows of its objects in the group, places (k + 1, 3) of its particles, weight)].
        """
        now = np.array([context.frame], float)
        for row, places, particles, weight in parts:
            moved = Origins(row.root, row.things, context.depsgraph.scene).moved(now, particles[None], weight)
            conjugated = moved.axes * (1.0, -1.0, -1.0, -1.0)
            for index, (place, obj) in enumerate(zip(places, row.things)):
                turned = rotations.product(moved.turns[:, index], moved.axes[:, index])
                context.locations[place] = _along_channels(obj, moved.moves[0, index])
                context.rotations[place] = rotations.product(conjugated[:, index], turned)[0]


def _along_channels(obj, move):
    """A move in the world along the axes in which a constraint adds it to an object's location: even below a bone those of its parent object."""
    if obj.parent is None:
        return move
    axes: Matrix = (obj.parent.matrix_world @ obj.matrix_parent_inverse).to_3x3()
    return axes.inverted_safe() @ Vector(move)


def _rotated(turns, vectors):
    """Vectors (n, 3) rotated by unit quaternions (n, 4)."""
    return rotations.chained(rotations.matrices(turns), vectors[:, :, None])[:, :, 0]


def _arc(before, after):
    """Unit quaternions (n, 4) of the shortest rotations that take directions (n, 3) to others; none if a vector has no length."""
    a, b = before.T, after.T
    sizes = np.sqrt((a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]))
    real = sizes + (a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
    axis = np.stack((a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]), axis=1)
    # Half a turn is about any axis across.
    none = np.zeros_like(a[0])
    is_along_z = (np.abs(a[0]) < np.abs(a[2]))[:, None]
    across = np.where(is_along_z, np.stack((none, -a[2], a[1]), axis=1), np.stack((-a[1], a[0], none), axis=1))
    is_half = real <= _LEAST * sizes
    found = np.concatenate([np.where(is_half, 0.0, real)[:, None], np.where(is_half[:, None], across, axis)], axis=1)
    w, x, y, z = found.T
    lengths = np.sqrt(w * w + x * x + y * y + z * z)
    is_none = (lengths == 0.0) | (sizes == 0.0)
    found = found / np.where(is_none, 1.0, lengths)[:, None]
    return np.where(is_none[:, None], (1.0, 0.0, 0.0, 0.0), found)
