"""Motion of a walker's feet and body at any times, for solvers that need their past, such as those of the legs' IK chains."""

import functools
import math

from mathutils import Matrix, Quaternion, Vector

from ..core.animation.channel import Channel
from ..core.animation.keys import union, united, whole
from ..core.animation.strips import together
from ..core.declare import Problem
from ..core.evaluated.question import answered
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.tracks import rotations
from ..core.tracks.in_world import World
from ..core.tracks.solved import placed
from . import carrier, keyed, leaning, legs, plan, soles
from .steps import stored

CYCLES = 2.0
"""Number of cycles of all legs, at the slowest cadence, in which all feet come to rest after the body has stopped."""
SLOWEST = 1e-3
"""Smallest cadence and frequency, in Hz, that count; a damaged file may have smaller ones, such as 0."""
FADES = 8.0
"""Number of periods of the body's spring, of the setting Frequency, in which the body comes to rest over its feet."""


def over_time(owner, thing, scene):
    """Return the motion over time of an object or bone that a walker drives; None if the walker does not drive the thing.

    This is System.over_time of walkers. owner: object that walks. thing: Object or PoseBone. scene: Scene whose frame rate counts.
    """
    foot = next((foot for foot in legs.feet(owner) if foot.thing == thing), None)
    if foot is not None:
        return (_BoneFoot if foot.is_bone else _Foot)(owner, foot, scene)
    if legs.body(owner) == thing:
        return (_BoneBody if owner.pose else _Body)(owner, thing, scene)
    return None


class _OverTime:
    """Motion over time of a foot or body of a walker, in the form that core/tracks/solved.py asks for.

    The thing (foot or body) and the owner (object that walks) are both original or both evaluated.
    """

    def __init__(self, owner, thing, scene):
        self._owner, self._thing, self._scene = owner, thing, scene
        self._influence = Channel(owner, "motus.walker.influence", -1)
        self._body, self._way = plan.body_track(owner, scene), plan.way_track(owner, scene)

    @functools.cached_property
    def _plan(self):
        """The Plan of the owner's walk, or the Problem that keeps the owner from walking."""
        return answered(
            (hash(self._owner), hash(self._scene), "walker"), lambda: plan.of(self._owner, self._scene, plan.read(self._owner.motus.walker))
        )

    @property
    def reason(self):
        """The Reason for which the motion is not known at frames different from the present one; None if it is known."""
        return next((track.reason for track in (self._body, *self._carriers) if not track.is_known), None) or self._influence.reason

    @property
    def _carriers(self):
        """The Track of the walker's carrier, in a list; [] if it has none."""
        found = carrier.track_of(self._owner, self._scene)
        return [] if found is None else [found]

    @property
    def _fps(self):
        return scene_time.fps(self._scene)

    def _seconds(self, times):
        return np.asarray(times, float) / self._fps

    def bounds(self, first, last):
        """Rising frames from `first` to `last` between which the motion is smooth: whole frames, and bends of body and influence."""
        return union([[first, *whole(first, last), last], self._way.bounds(first, last), self._influence.bounds(first, last)])

    @property
    def extent(self):
        """(first, last) frame between which the motion changes; None if it never changes.

        The last frame is an estimate of when the feet come to rest, which is later than when the body does. The exact frame would need
        the plan of the walk, which takes longer to compute.
        """
        moving, settings = self._way.extent, self._owner.motus.walker
        if moving is not None:
            rest = CYCLES / max(SLOWEST, self._cadence(moving[1])) + FADES / max(SLOWEST, settings.frequency)
            moving = moving[0], max(moving[1], stored.last_moment(settings)) + rest * self._fps
        return united([moving, self._influence.extent])

    def _cadence(self, frame):
        """The setting Cadence at a frame, which may be infinite; by its keys, if it has any."""
        found = keyed.channel(self._owner, "cadence")
        return self._owner.motus.walker.cadence if found.reason or not math.isfinite(frame) else float(found.values(np.array([frame]))[0])

    @property
    def stamp(self):
        """Hashable value that changes whenever the motion may change at any time; None if changes cannot be detected."""
        found = self._plan
        if isinstance(found, Problem):
            return together((found.sentence, self._influence.stamp))
        return together((found.stamp, self._body.stamp, self._fps, self._own, self._influence.stamp))

    @property
    def _own(self):
        """Hashable name of the thing (foot or body) within the plan, so that two things of one walker have different stamps."""
        return self._thing.name


class _Foot(_OverTime):
    """Motion over time of a foot that is an object."""

    def __init__(self, owner, foot, scene):
        super().__init__(owner, foot.thing, scene)
        self._leg = foot.index

    def _places(self, times):
        """Places (n, 3) of the foot, in world space, at frames (n,); None if a Problem keeps the owner from walking."""
        if isinstance(self._plan, Problem):
            return None
        return self._plan.walker.feet(self._seconds(times))[:, self._leg]

    def _turns(self, times):
        """Turns (n, 4) of the foot, in world space, at frames (n,); None if the foot does not turn with the ground."""
        return soles.turned(self._plan, self._seconds(times))[:, self._leg] if self._plan.turns else None

    def applied(self, times, matrices):
        """Move the world matrices of a foot object to the footholds of the walk, by the setting Influence; returns (n, 4, 4).

        times: (n,), frames. matrices: (n, 4, 4), by the object's own channels and parents.
        """
        places = self._places(times)
        if places is None:
            return matrices
        matrices = np.broadcast_to(matrices, (len(times), 4, 4))
        weights = self._influence.values(times)[:, None]
        own, turns = matrices[:, :3, 3], self._turns(times)
        if turns is not None:
            turns = soles.mixed(rotations.of_axes(matrices[:, :3, :3]), turns, weights[:, 0])
        return placed(matrices, own + weights * (places - own), turns, np.ones(len(times), bool))

    @property
    def _own(self):
        return self._leg


class _OnBone:
    """Mixin for a foot or body that is a bone of the walker's rig: its motion depends on the motion of the parent bone too."""

    @functools.cached_property
    def _above(self):
        """World (pose and world matrix over time) of the parent bone; None if the bone has no parent."""
        return World(self._thing.parent, self._scene) if self._thing.parent else None

    @property
    def reason(self):
        """The Reason for which the motion is not known at frames different from the present one; None if it is known."""
        return super().reason or (self._above.reason if self._above else None)  # type: ignore[misc]

    @property
    def stamp(self):
        """Hashable value that changes whenever the motion may change at any time; None if changes cannot be detected."""
        return together((super().stamp, *((self._above.stamp,) if self._above else ())))  # type: ignore[misc]

    def _each(self, times):
        """Yields what leaning.of_bone() wants for each time: pose of the parent bone or None, world matrix of the rig, location channels."""
        worlds = map(Matrix, self._body.values(times).tolist())
        if self._above is None:
            channels = leaning.location_channels(self._thing, None)
            for world in worlds:
                yield None, world, channels
        else:
            for world, above in zip(worlds, map(Matrix, self._above.poses(times).tolist())):
                yield above, world, leaning.location_channels(self._thing, above)


class _BoneFoot(_OnBone, _Foot):
    """Motion over time of a foot that is a bone."""

    def applied(self, times, transforms):
        """Replace a foot bone's own location, and its rotation if soles turn, by the walk's; returns Transforms.

        The setting Influence mixes the two. times: (n,), frames. transforms: Transforms from the bone's own channels.
        """
        places = self._places(times)
        if places is None:
            return transforms
        weights = self._influence.values(times)
        own = np.broadcast_to(transforms.locations, (len(times), 3))
        own_turns, turns = np.broadcast_to(transforms.rotations, (len(times), 4)), self._turns(times)
        reached = []
        for row, (place, above) in enumerate(zip(places.tolist(), self._each(times))):
            at_rest, axes = leaning.of_bone(self._thing, leaning.IDENTITY, *above)
            reached.append(tuple(axes.inverted_safe() @ (Vector(place) - at_rest.translation)))
            if turns is not None:
                turns[row] = at_rest.to_quaternion().inverted() @ Quaternion(turns[row])
        locations = own + weights[:, None] * (np.array(reached).reshape(-1, 3) - own)
        if turns is None:
            return transforms._replace(locations=locations)
        return transforms._replace(locations=locations, rotations=soles.mixed(own_turns, turns, weights.tolist()))


class _Leaning(_OverTime):
    """Motion over time of a body that rises and leans with the feet."""

    def _shares(self, times):
        """List (lift, turn) of the body at each time, in the world, by the setting Influence; None if a Problem prevents walking."""
        if isinstance(self._plan, Problem):
            return None
        lifts, turns = self._plan.walker.body(self._seconds(times))
        return [leaning.share(*one) for one in zip(lifts.tolist(), turns.tolist(), self._influence.values(times).tolist())]


class _Body(_Leaning):
    """Motion over time of a body that is an object."""

    def applied(self, times, matrices):
        """Lift and lean the world matrices of a body object as the walk requires, in addition to its own motion; returns (n, 4, 4).

        times: (n,), frames. matrices: (n, 4, 4), by the object's own channels and parents.
        """
        shares = self._shares(times)
        if shares is None:
            return matrices
        found = np.broadcast_to(matrices, (len(times), 4, 4)).tolist()
        for row, (origin, (lift, turn)) in enumerate(zip(self._body.values(times)[:, :3, 3].tolist(), shares)):
            about = Matrix.Translation(origin)
            moved = Matrix.Translation(lift) @ about @ turn.to_matrix().to_4x4() @ about.inverted() @ Matrix(found[row])
            found[row] = [tuple(numbers) for numbers in moved]
        return np.array(found).reshape(-1, 4, 4)


class _BoneBody(_OnBone, _Leaning):
    """Motion over time of a body that is a bone."""

    def applied(self, times, transforms):
        """Lift and lean the own transforms of a body bone as the walk requires, in addition to its own motion; returns Transforms.

        times: (n,), frames. transforms: Transforms from the bone's own channels.
        """
        shares = self._shares(times)
        if shares is None:
            return transforms
        moves, turns = [], []
        basis = np.broadcast_to(transforms.matrices, (len(times), 4, 4)).tolist()
        for own, above, (lift, turn) in zip(basis, self._each(times), shares):
            place, axes = leaning.of_bone(self._thing, Matrix(own), *above)
            move, local = leaning.relative(place, axes, above[1].translation, lift, turn)
            moves.append(tuple(move))
            turns.append(tuple(local))
        rotated = rotations.product(np.broadcast_to(transforms.rotations, (len(times), 4)), np.array(turns).reshape(-1, 4))
        return transforms._replace(locations=transforms.locations + np.array(moves).reshape(-1, 3), rotations=rotated)
