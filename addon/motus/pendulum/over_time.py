"""Motion of the rods of a pendulum at any times, for systems of Motus that need the past of objects."""

import functools

from ..core.animation.channel import Channel
from ..core.animation.keys import union, united, whole
from ..core.animation.strips import together
from ..core.declare import Problem
from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import INFINITE
from ..core.tracks import own_track, rotations
from ..core.tracks.solved import turned
from . import clock, directions, parts, pivot_motion, solve

AT_REST = 0.0, 0.0, -1.0, 0.0, 0.0, 0.0
"""State of a spherical pendulum that hangs at rest."""


def over_time(owner, thing, scene):
    """Return the motion over time of a rod; None if the object is no rod of the pendulum of this owner.

    This is the function System.over_time. owner, thing: the pivot and the rod, both original or both evaluated.
    """
    numbers = {pointed(entry, "object"): entry.number for entry in parts.own_rods(owner)}
    return OverTime(owner, thing, numbers[thing], tuple(numbers.values()), scene) if thing in numbers else None


class OverTime:
    """Motion of one rod of a pendulum over time. owner, rod: both original or both evaluated. numbers: indices of all its rods.

    Its members are listed in core/tracks/solved.py.
    """

    def __init__(self, owner, rod, number, numbers, scene):
        self._owner, self._rod, self._number, self._numbers, self._scene = owner, rod, number, numbers, scene
        self._settings = owner.motus.pendulum
        path = self._settings.path_from_id()
        self._channels = {name: Channel(owner, f"{path}.{name}", -1) for name in ("is_playing", "speed", "influence")}

    @functools.cached_property
    def _pivot(self):
        return pivot_motion.track(self._owner, self._scene) if self._settings.use_pivot_motion else None

    @property
    def reason(self):
        """The Reason why the motion at other frames cannot be computed; None if it can."""
        if self._pivot and not self._pivot.is_known:
            return self._pivot.reason
        return next((channel.reason for channel in self._channels.values() if channel.reason), None)

    def applied(self, times, matrices):
        """World matrices (n, 4, 4) of the rod with its swing, from `matrices` without the swing, at times (n,) of the scene."""
        scales = own_track(self._rod).values(times).scales
        return turned(matrices, self._turns(times), scales)

    def _turns(self, times):
        """Return the quaternions (n, 4) that turn the rod relative to the rod above it, at times (n,)."""
        influences = self._channels["influence"].values(times)
        turns = np.zeros((len(times), 3))
        swing = solve.swing_of(self._settings, self._scene)
        if isinstance(swing, Problem) or deleted.is_deleted(self._owner) or not swing.has_rods(self._numbers):
            return rotations.of_mode(turns, 'XYZ')
        states = self._states(swing, times)
        if swing.is_spherical:
            return np.array([directions.turn(state[:3], share) for state, share in zip(states.tolist(), influences.tolist())])
        rod = self._number % swing.each
        turns[:, 1] = -influences * (states[:, rod] - (states[:, 0] if rod else 0.0))
        return rotations.of_mode(turns, 'XYZ')

    def _states(self, swing, times):
        """Return the states (n, m) of the rod's pendulum at times (n,); those of a pendulum at rest where they are unknown."""
        seconds, rate = self._clock(times)
        felt = pivot_motion.felt(self._owner, self._scene, rate, swing.is_spherical)[0] if self._pivot else {}

        def states(at):
            return swing.way(at, number=self._number // swing.each, **felt)

        try:
            return states(seconds)
        except ValueError:  # at some times, too far from the start, the motion is unknown, and there the rods hang as they are placed
            rest = np.array([AT_REST if swing.is_spherical else (0.0,) * 2 * swing.each])
            return np.concatenate([_known(states, second, rest) for second in seconds])

    def _clock(self, times):
        """Return (seconds (n,), rate) of the pendulum's own time at times (n,); the rate is None if it changes."""
        fps = scene_time.fps(self._scene)
        if all(self._channels[name].is_constant for name in ("is_playing", "speed")):
            start, rate = clock.steady(self._settings)
            return np.where(times > start, (times - start) / fps * rate, 0.0), rate
        return np.array([clock.read(self._owner, self._settings, time, fps).seconds for time in times.tolist()]), None

    @property
    def _is_running(self):
        playing, speed = self._channels["is_playing"], self._channels["speed"]
        return not (playing.is_constant and speed.is_constant) or clock.steady(self._settings)[1] != 0.0

    def bounds(self, first, last):
        """Return rising frames from first to last; the rod's motion is smooth between neighbours.

        They include the start, all whole frames, and frames at which animated settings are not smooth.
        """
        start = self._settings.start_frame
        found = [channel.bounds(first, last) for channel in self._channels.values()]
        return union([[first, *([start] if first < start < last else []), *whole(first, last), last], *found])

    @property
    def extent(self):
        """First and last frame between which the motion changes: the start frame and infinity, if the pendulum runs; None if it rests.

        Keys of the influence extend the range.
        """
        moving = (self._settings.start_frame, np.inf) if self._is_running else None
        return united([moving, self._channels["influence"].extent])

    @property
    def stamp(self):
        """Hashable value that changes whenever the rod's motion may."""
        settings, scene = self._settings, self._scene
        return together(
            (
                self._number,
                self._numbers,
                settings.kind,
                settings.use_limits,
                settings.count,
                solve.gravity_of(settings, scene),
                *(getattr(settings, name) for name in solve.NUMBERS if name not in self._channels),
                *scene_time.stamp(scene),
                *(channel.stamp for channel in self._channels.values()),
                own_track(self._rod).stamp,
                *((self._pivot.stamp, scene_time.last(scene)) if self._pivot else ()),
            )
        )


def _known(states, second, rest):
    """Return the state of a pendulum at one time, (1, m); `rest` if it is unknown. states: function of times (n,)."""
    try:
        return states(np.array([second])) if abs(second) < INFINITE else rest
    except ValueError:
        return rest
