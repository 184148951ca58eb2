"""Transforms of followers at any times, for systems whose solvers read the past of an object.

The path's solver is called for each time.
"""

import functools
from types import SimpleNamespace

from mathutils import Matrix

from ..core import native
from ..core.animation.channel import Channel
from ..core.animation.keys import union, whole
from ..core.animation.reason import Reason
from ..core.animation.strips import together
from ..core.declare import Context
from ..core.evaluated import copies
from ..core.file.choices import chosen
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.tracks import world_track
from ..core.tracks.solved import placed
from . import curves, members, solve

CHOICES = tuple(name for name in solve.SHARED if name not in {"influence", "pins", "speeds"})


def over_time(owner, thing, scene):
    """Return an OverTime for an object that the owner's path settings move (the hook System.over_time of the registry).

    Returns None if the object is neither the owner nor one of its wagons, such as a copied wagon.
    """
    return OverTime(owner, thing, scene) if thing in members.members(owner) else None


class OverTime:
    """Transforms over time of a follower or wagon; core/tracks/solved.py calls the methods.

    owner: object with the path settings. thing: the owner or a wagon. Both are original objects, or both are evaluated copies.
    """

    def __init__(self, owner, thing, scene):
        self._owner, self._thing, self._scene = owner, thing, scene
        self._settings = owner.motus.path
        self._index = members.members(owner).index(thing)

    @functools.cached_property
    def _numbers(self):
        return {name: self._channel(name) for name in solve.NUMBERS}

    def _channel(self, name):
        return Channel(self._owner, f"motus.path.{name}", -1)

    @functools.cached_property
    def _curve(self):
        curve = pointed(self._settings, "curve")
        return world_track(curve, self._scene) if curve and curve.type == 'CURVE' else None

    @functools.cached_property
    def _rail(self):
        rail = pointed(self._settings, "rail") if chosen(self._settings, "orientation") == 'RAIL' else None
        return world_track(rail, self._scene) if rail and rail.type == 'CURVE' else None

    @property
    def _curves(self):
        """[(track, name of the setting)] of the curves that are read."""
        return [(track, name) for track, name in ((self._curve, "curve"), (self._rail, "rail")) if track]

    @property
    def reason(self):
        """Reason why the transforms at other frames are unknown; None if they are known."""
        settings, thing = self._settings, self._thing.name
        if not self._channel("influence").is_constant or settings.influence != 1.0:
            return Reason(Reason.INFLUENCE, thing=thing, name=self._owner.name)
        for _, name in self._curves:
            if _changes_shape(pointed(settings, name)):
                return Reason(Reason.GEOMETRY, thing=thing, name=pointed(settings, name).name)
        tracks = [*self._numbers.values(), *(track for track, _ in self._curves)]
        return next((track.reason for track in tracks if track.reason), None)

    def applied(self, times, matrices):
        """Return world matrices (n, 4, 4) with the location and rotation that the path gives at `times`, and the scale of `matrices`.

        matrices: world matrices that the object would have if the path did not act. core/tracks/solved.py calls this method.
        """
        return placed(np.broadcast_to(matrices, (len(times), 4, 4)), *self._poses(times))

    def _poses(self, times):
        """Call the solver at each of the times (n,).

        Returns (locations, rotations or None if the path sets none, whether the path acts at each time).
        """
        offsets, count = members.offsets(self._owner), len(times)
        values = np.stack([track.values(times) for track in self._numbers.values()], axis=1).tolist()
        curve, rail = (track.values(times) if track else [None] * count for track in (self._curve, self._rail))
        locations, rotations, acts = np.zeros((count, 3)), np.zeros((count, 4)), np.zeros(count, bool)
        told = np.zeros(len(solve.OUTPUTS))
        poses = native.module.PoseBuffer(len(offsets), told)
        graph = SimpleNamespace(scene=self._scene)
        memo = {} if all(track.is_constant for track in self._numbers.values()) else None
        moments = (
            (time, dict(zip(self._numbers, numbers)), *matrices) for time, numbers, *matrices in zip(times.tolist(), values, curve, rail)
        )
        solved = solve.solve_moments(
            lambda time: Context(self._settings, self._owner, time, graph, outputs=told, member_data=offsets, memo=memo, poses=poses),
            moments,
            *(track and pointed(self._settings, name).data.splines for track, name in ((self._curve, "curve"), (self._rail, "rail"))),
        )
        for row, (context, problem) in enumerate(solved):
            acts[row] = problem is None or not problem.blocking
            locations[row], rotations[row] = context.locations[self._index], context.rotations[self._index]
        is_turned = "rotation" in members.channels(self._settings)
        return locations, rotations if is_turned else None, acts

    def bounds(self, first, last):
        """Return rising times from first to last; between neighbours the transforms are smooth.

        The times are whole frames, and the times at which a setting or the curve's transform may bend.
        """
        found = [track.bounds(first, last) for track in self._numbers.values()]
        found += [track.bounds(first, last) for track, _ in self._curves]
        return union([[first, *whole(first, last), last], *found])

    @property
    def extent(self):
        """(first, last) frame between which the transforms change: infinite, since the frames without motion are unknown."""
        return -np.inf, np.inf

    @property
    def stamp(self):
        """Hashable value that changes whenever the transforms at any time change; None if this cannot be known."""
        settings = self._settings
        return together(
            (
                self._index,
                tuple(members.offsets(self._owner)),
                *scene_time.stamp(self._scene),
                settings.influence,
                *(getattr(settings, name) for name in CHOICES),
                *((pin.frame, pin.fraction, pin.distance) for pin in settings.pins),
                *((one.distance, one.speed) for one in settings.speeds),
                *members.wheelbases(self._owner),
                *(track.stamp for track in self._numbers.values()),
                *(part for track, name in self._curves for part in (track.stamp, self._shape(name))),
            )
        )

    def _shape(self, name):
        """Hashable value of a curve's control points, closedness and tilt; a Problem if it cannot be read. name: of its setting."""
        curve, spline = pointed(self._settings, name), self._settings.spline if name == "curve" else self._settings.rail_spline
        try:
            read = curves.read(curve, curve.data.splines, None, spline, Matrix())
        except curves.Unreadable as unreadable:
            return unreadable.problem
        return read.curve.control_points.tobytes(), read.curve.cyclic, read.tilt.tobytes()


def _changes_shape(curve):
    data = curve.original.data
    return bool(curve.modifiers) or data.shape_keys is not None or copies.has_animation(data)
