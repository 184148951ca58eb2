"""Chains of objects in a row: each is a particle, and turns with the link to it from the one before."""

import functools
import itertools
from typing import Any, NamedTuple

import bpy
from mathutils import Matrix, Vector

from ..core import native
from ..core.animation import strips
from ..core.blender import helpers
from ..core.declare import CopyOf, Member, Transform
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.tracks import in_world, own_track, rotations, world_track
from ..core.tracks.inputs import Input, stamp_of_known
from ..core.tracks.track import kept_by
from ..core.tracks.transforms import Transforms
from . import curves

MOVE = frozenset({"location", "rotation"})
_STILL = 1.0, 0.0, 0.0, 0.0


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
    def pinnable(self):
        """Names of what pins may hold: these hold bones alone, of which one may have the name of an object."""
        return ()

    @property
    def drives(self):
        """The objects."""
        return self.things

    @property
    def yields(self):
        """What a different system may take over: nothing."""
        return ()

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

    def kept(self, source):
        """The Kept, whose input is `source`."""
        return Kept(self._read, source.still)

    @property
    def _read(self):
        return Read(self.root, self.things, self.entry.spline)

    @property
    def ends(self):
        """Both ends of each link, as they stand now, in the world. For evaluated objects."""
        start = self.root.parent.matrix_world @ self.root.location if self._is_spline else self.root.matrix_world.translation
        places = [start, *(obj.matrix_world.translation for obj in self.things)]
        return [end for link in itertools.pairwise(places) for end in link]

    def read_by(self, _source):
        """List what the input reads that may change although the owner is not edited: hashable, with stamp(owner, scene)."""
        return [self._read]

    def source(self, scene):
        """Make the input (core/tracks/inputs.py) with the places of the particles in the animation."""
        return Origins(self.root, self.things, scene)


class Moved(NamedTuple):
    """Objects of a row at n times, taken along by its particles.

    moves, turns: (k, n, 3) and (k, n, 4), in the world, from where the animation has them. axes: (k, n, 4), own rotations of the objects in
    the world, beneath their own scale, as Blender takes their matrices apart.
    """

    moves: Any
    turns: Any
    axes: Any


class Still(NamedTuple):
    """What of a row does not change over time.

    own: for each object its own Transforms, in one row, if nothing animates them, or else None. offsets: (k, 4, 4), from what each hangs on to
    the space of its channels. back: (4, 4), from the world to the root on the scene's first frame.
    """

    own: list
    offsets: Any
    back: Any


class Origins(Input):
    """Input that is the motion of the origins of objects in world space, by their own animation and that of their parents.

    root: the Object that stays on its animation, all of it. things: the Objects that hang, without what the chain does to them. Those
    without a parent, keys and drivers are taken along by the root from the scene's first frame on, as its children would be. All are
    original, or all evaluated. still: if it is known.
    """

    def __init__(self, root, things, scene, still=None):
        super().__init__(things, scene)
        self._root = root
        if still is not None:
            self.still = still

    @functools.cached_property
    def still(self):
        """The Still. The input has to be known."""
        own = [track.values(np.zeros(1)) if track.extent is None else None for track in self._own]
        offsets = [np.eye(4)[None] if parent is None else in_world.parent_offset(obj) for obj, parent in zip(self._thing, self._parents)]
        first = self._rooted.values(np.array([scene_time.first(self._scene)], float))[0]
        return Still(own, np.concatenate(offsets), np.array(Matrix(first).inverted_safe()))

    @functools.cached_property
    def _rooted(self):
        return world_track(self._root, self._scene)

    @functools.cached_property
    def _parents(self):
        return [in_world.parent_of(obj) for obj in self._thing]

    @functools.cached_property
    def _carried(self):
        """{parent of any of the objects, an Object or PoseBone: track of its world matrix}."""
        return {parent: world_track(parent, self._scene) for parent in dict.fromkeys(filter(None, self._parents))}

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

    def places(self, frames):
        """Return world positions (n, 3) at frames (n,): of the root's origin, then of the origin of each object."""
        rooted = self._rooted.values(frames)
        worlds = (self._rests(rooted, self._worlds(frames, [row])[1], [row])[0] for row in range(len(self._thing)))
        return (np.broadcast_to(rooted[:, :3, 3], (len(frames), 3)), *worlds)

    def _rests(self, rooted, worlds, rows):
        """Return where the particles of objects are at n times, (k, n, 3), taken along by the root if nothing else moves them.

        rooted: world matrices (n, 4, 4) of the root. worlds: (k, n, 4, 4), of the objects themselves. rows: k indices of the objects.
        """
        found = worlds[..., :3, 3]
        taken = self._taken(rows)
        if taken.any():
            way = rotations.chained(rooted, self.still.back[None])
            found = found.copy()
            found[taken] = [rotations.chained(way, world)[:, :3, 3] for world in worlds[taken]]
        return found

    def _taken(self, rows):
        """For each object of k rows whether the root takes it along as if it were its child: nothing else moves it, (k,) bool."""
        return np.array([self._parents[row] is None and self.still.own[row] is not None for row in rows], bool)

    def _worlds(self, frames, rows):
        """Return objects at frames (n,): (own Transforms, world matrices (k, n, 4, 4), matrices of the spaces of their channels or None).

        rows: k indices of the objects. Transforms and spaces have k * n rows, object by object.
        """
        count = len(frames)
        owns = [self.still.own[row] or self._own[row].values(frames) for row in rows]
        own = Transforms(*(np.concatenate([np.broadcast_to(one, (count, one.shape[1])) for one in part]) for part in zip(*owns)))
        found, space = own.matrices, None
        parents = [self._parents[row] for row in rows]
        if any(parents):
            carried = {parent: track.values(frames) for parent, track in self._carried.items() if parent in parents} | {
                None: np.eye(4)[None]
            }
            above = np.concatenate([np.broadcast_to(carried[parent], (count, 4, 4)) for parent in parents])
            space = rotations.chained(above, np.repeat(self.still.offsets[list(rows)], count, axis=0))
            found = rotations.chained(space, found)
        return own, found.reshape(-1, count, 4, 4), space

    def moved(self, frames, particles, weight):
        """Return the Moved at frames (n,). particles: (n, k + 1, 3), world space, the root's first. weight: 0 to 1."""
        rows, count = range(len(self._thing)), len(frames)
        rooted = np.broadcast_to(self._rooted.values(frames), (count, 4, 4))
        own, worlds, space = self._worlds(frames, rows)
        rests = np.concatenate([rooted[None, :, :3, 3], self._rests(rooted, worlds, rows)])
        places = np.swapaxes(particles, 0, 1)
        before = np.ascontiguousarray(np.swapaxes(np.diff(rests, axis=0), 0, 1))
        links = native.module.link_turns(before, np.ascontiguousarray(np.diff(particles, axis=1)))
        turns, taken = np.swapaxes(links, 0, 1).copy(), self._taken(rows)
        if taken.any():
            way = rotations.of_axes(rotations.chained(rooted, self.still.back[None])[:, :3, :3])
            turns[taken] = [rotations.product(turn, way) for turn in turns[taken]]
        if weight != 1.0:
            flat = turns.reshape(-1, 4)
            turns = rotations.mixed(np.broadcast_to(_STILL, flat.shape), flat, np.full(len(flat), weight)).reshape(turns.shape)
        axes = rotations.product(own.rotations, rotations.mirrored(own.scales))
        if space is not None:
            axes = rotations.product(rotations.of_axes(space[:, :3, :3]), axes)
        return Moved(weight * (places[1:] - worlds[..., :3, 3]), turns, axes.reshape(turns.shape))


class Read(NamedTuple):
    """What a row reads: its evaluated root and objects, and the index of the spline that they anchor, or -1."""

    root: Any
    things: tuple
    spline: int

    def stamp(self, owner, scene):
        """Hashable value that changes whenever the animation of the row may; None if changes cannot be detected."""
        drawn = np.asarray(curves.places(owner, self.spline)).tobytes()
        return strips.together((drawn, Origins(self.root, self.things, scene).stamp))


class Kept(NamedTuple):
    """What is kept of a row between evaluations. still: what does not change over time."""

    read: Read
    still: Still

    @staticmethod
    def fill(context, _text, parts):
        """Move and turn the objects of rows to their particles.

        parts: [(making.Part, places (k + 1, 3) of its particles, weight)].
        """
        now = np.array([context.frame], float)
        for part, particles, weight in parts:
            read, still = part.kept
            source = Origins(read.root, read.things, context.depsgraph.scene, still)
            moves, turns, axes = (one[:, 0] for one in source.moved(now, particles[None], weight))
            places = slice(part.rows.start, part.rows.stop)
            context.locations[places] = [_along_channels(*pair) for pair in zip(read.things, moves)]
            context.rotations[places] = rotations.product(axes * (1.0, -1.0, -1.0, -1.0), rotations.product(turns, axes))


def _along_channels(obj, move):
    """A move in the world along the axes in which a constraint adds it to an object's location: even below a bone those of its parent object."""
    if obj.parent is None:
        return move
    axes: Matrix = (obj.parent.matrix_world @ obj.matrix_parent_inverse).to_3x3()
    return axes.inverted_safe() @ Vector(move)
