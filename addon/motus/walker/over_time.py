"""Where feet and bodies of walkers are at any times, for systems that need their past, and for the legs that reach for feet."""

import functools

from mathutils import Matrix

from ..core.animation.channel import Channel
from ..core.animation.keys import union, united, whole
from ..core.animation.strips import together
from ..core.declare import Problem
from ..core.evaluated.question import answered
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.tracks import rotations
from ..core.tracks.solved import placed
from ..core.tracks.transforms import World
from . import leaning, legs, plan

CYCLES = 2.0
"""Of the slowest cadence, in which all feet come to rest."""
SLOWEST = 1e-3
"""Hz: what a file that somebody has changed may fall short of."""
FADES = 8.0
"""Swings of the body's filter until it rests."""


def over_time(owner, thing, scene):
    """System.over_time; None for what the owner does not drive."""
    foot = next((foot for foot in legs.feet(owner) if foot.thing == thing), None)
    if foot is not None:
        return (_BoneFoot if foot.is_bone else _Foot)(owner, foot, scene)
    if legs.body(owner) == thing:
        return (_BoneBody if owner.pose else _Body)(owner, thing, scene)
    return None


class _OverTime:
    """The motion of a foot or body of a walker, as core/tracks/solved.py asks for it. Thing and owner are both original or both evaluated."""

    def __init__(self, owner, thing, scene):
        self._owner, self._thing, self._scene = owner, thing, scene
        self._influence = Channel(owner, "motus.walker.influence", -1)
        self._body = plan.body_track(owner, scene)

    @functools.cached_property
    def _plan(self):
        """The Plan, or the Problem that keeps the owner from walking."""
        return answered(
            (hash(self._owner), hash(self._scene), "walker"), lambda: plan.of(self._owner, self._scene, plan.read(self._owner.motus.walker))
        )

    @property
    def reason(self):
        """The Reason for which the motion is not known at other frames; None if it is known."""
        return (None if self._body.is_known else self._body.reason) or self._influence.reason

    @property
    def _fps(self):
        return scene_time.fps(self._scene)

    def _seconds(self, times):
        return np.asarray(times, float) / self._fps

    def bounds(self, first, last):
        """Rising frames between which the motion is smooth: every whole frame, and where the body's motion bends."""
        return union([[first, *whole(first, last), last], self._body.bounds(first, last), self._influence.bounds(first, last)])

    @property
    def extent(self):
        """First and last frame between which the motion changes. The end is an estimate: the feet come to rest after the body.

        An exact end would need the plan of the walk, which takes longer to compute.
        """
        moving, settings = self._body.extent, self._owner.motus.walker
        if moving is not None:
            rest = CYCLES / max(SLOWEST, settings.cadence) + FADES / max(SLOWEST, settings.frequency)
            moving = moving[0], moving[1] + rest * self._fps
        return united([moving, self._influence.extent])

    @property
    def stamp(self):
        """Changes whenever the motion may."""
        found = self._plan
        if isinstance(found, Problem):
            return together((found.sentence, self._influence.stamp))
        return together((found.stamp, self._body.stamp, self._fps, self._own, self._influence.stamp))

    @property
    def _own(self):
        """The part of the native plan that moves the thing."""
        return self._thing.name


class _Foot(_OverTime):
    """A foot that is an object."""

    def __init__(self, owner, foot, scene):
        super().__init__(owner, foot.thing, scene)
        self._leg = foot.index

    def _places(self, times):
        """(n, 3) in the world; None where nothing walks."""
        if isinstance(self._plan, Problem):
            return None
        return self._plan.walker.feet(self._seconds(times))[:, self._leg]

    def applied(self, times, matrices):
        """World matrices of a foot that is an object, moved to where the walk puts the foot, by the influence.

        times: (n,), frames. matrices: (n, 4, 4), by the object's own channels and parents.
        """
        places = self._places(times)
        if places is None:
            return matrices
        matrices = np.broadcast_to(matrices, (len(times), 4, 4))
        weights = self._influence.values(times)[:, None]
        own = matrices[:, :3, 3]
        return placed(matrices, own + weights * (places - own), None, np.ones(len(times), bool))

    @property
    def _own(self):
        return self._leg


class _OnBone:
    """Mixin for a foot or body that is a bone of the walker's rig: its motion depends also on that of its parent bone."""

    @functools.cached_property
    def _above(self):
        """World of what the bone hangs on; None without."""
        return World(self._thing.parent, self._scene) if self._thing.parent else None

    @property
    def reason(self):
        """The Reason for which the motion is not known at other frames; None if it is known."""
        return super().reason or (self._above.reason if self._above else None)  # type: ignore[misc]

    @property
    def stamp(self):
        """Changes whenever the motion may."""
        return together((super().stamp, *((self._above.stamp,) if self._above else ())))  # type: ignore[misc]

    def _each(self, times):
        """Yields (world matrix of the rig, pose of what the bone hangs on or None) of each time."""
        worlds = self._body.values(times)
        poses = self._above.poses(times) if self._above else [None] * len(times)
        for world, pose in zip(worlds, poses):
            yield Matrix(world.tolist()), None if pose is None else Matrix(pose.tolist())


class _BoneFoot(_OnBone, _Foot):
    """A foot that is a bone."""

    def applied(self, times, transforms):
        """Own transforms of a foot that is a bone, with the locations that put the foot where the walk needs it, by the influence.

        times: (n,), frames. transforms: Transforms from the bone's own channels.
        """
        places = self._places(times)
        if places is None:
            return transforms
        weights = self._influence.values(times).tolist()
        locations = np.array(np.broadcast_to(transforms.locations, (len(times), 3)))
        for row, (world, above) in enumerate(self._each(times)):
            at_rest, axes = leaning.of_bone(self._thing, leaning.IDENTITY, above, world)
            inverse, own = axes.inverted_safe(), locations[row]
            there = inverse @ (Matrix.Translation(places[row].tolist()).translation - at_rest.translation)
            locations[row] = own + weights[row] * (np.array(there) - own)
        return transforms._replace(locations=locations)


class _Leaning(_OverTime):
    """A body."""

    def _shares(self, times):
        """[(lift, turn)] of the times; None where nothing walks."""
        if isinstance(self._plan, Problem):
            return None
        lifts, turns = self._plan.walker.body(self._seconds(times))
        return [leaning.share(*one) for one in zip(lifts.tolist(), turns.tolist(), self._influence.values(times).tolist())]


class _Body(_Leaning):
    """A body that is an object."""

    def applied(self, times, matrices):
        """World matrices of a body that is an object, lifted and leaned by the walk on top of its own motion.

        times: (n,), frames. matrices: (n, 4, 4), by the object's own channels and parents.
        """
        shares = self._shares(times)
        if shares is None:
            return matrices
        found = np.array(np.broadcast_to(matrices, (len(times), 4, 4)))
        for row, (world, (lift, turn)) in enumerate(zip(self._body.values(times), shares)):
            about = Matrix.Translation(world[:3, 3].tolist())
            moved = Matrix.Translation(lift) @ about @ turn.to_matrix().to_4x4() @ about.inverted() @ Matrix(found[row].tolist())
            found[row] = np.array(moved)
        return found


class _BoneBody(_OnBone, _Leaning):
    """A body that is a bone."""

    def applied(self, times, transforms):
        """Own transforms of a body that is a bone, lifted and leaned by the walk on top of its own motion.

        times: (n,), frames. transforms: Transforms from the bone's own channels.
        """
        shares = self._shares(times)
        if shares is None:
            return transforms
        count = len(times)
        locations, turns = (np.array(np.broadcast_to(part, (count, part.shape[-1]))) for part in transforms[:2])
        basis = np.broadcast_to(transforms.matrices, (count, 4, 4))
        for row, ((world, above), (lift, turn)) in enumerate(zip(self._each(times), shares)):
            place, axes = leaning.of_bone(self._thing, Matrix(basis[row].tolist()), above, world)
            move, local = leaning.relative(place, axes, world.translation, lift, turn)
            locations[row] += move
            turns[row] = rotations.product(turns[row : row + 1], np.array([local]))[0]
        return transforms._replace(locations=locations, rotations=turns)
