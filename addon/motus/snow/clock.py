"""The snow's own time, which passes at the speed of the setting Tempo, and the loop over which the snowfall repeats."""

import math
from typing import Any, NamedTuple

from ..core.animation import strips
from ..core.animation.channel import Channel
from ..core.declare import Problem
from ..core.evaluated import copies
from ..core.lazy import numpy as np

SPEED = "motus.snow.time_speed"
UNKNOWN = Problem("Tempo is driven, or in NLA strips that are not known ahead: its present value counts for all the time", False)
NO_LOOP = Problem("A loop ends before it begins, and is none: set its end behind its start", False)
TOO_SHORT = Problem("The loop is too short for flakes that live so long: make it longer, or the lifetime shorter")
PROBLEMS = UNKNOWN, NO_LOOP, TOO_SHORT
SHORTEST = 1e-3
"""Least own time of a loop, in seconds."""
FAR = 4096.0
"""Frames for which the motion of colliders ahead of a frame counts, if it is not known how far flakes live into it."""
MOST_LAPS = 4096
"""Most loops for which a flake may live."""


class Clock(NamedTuple):
    """Own time of a snow, in seconds, at frames of the scene.

    start: frame at which it is 0. fps: frames per second. speed: own seconds per second of the scene; not used with `keyed`, the Channel
    of the speed if it is animated.
    """

    start: float
    fps: float
    speed: float = 1.0
    keyed: Any = None

    def seconds(self, frame):
        """Own time at a frame, exact: of a keyed speed it is the integral."""
        if self.keyed is None:
            return (frame - self.start) / self.fps * self.speed
        first, last = sorted((self.start, frame))
        return math.copysign(self.keyed.integral(first, last) / self.fps, frame - self.start)

    def many(self, frames):
        """Own times (n,) at rising frames (n,); they never fall."""
        if self.keyed is None:
            return (frames - self.start) / self.fps * self.speed
        return np.maximum.accumulate(np.array([self.seconds(frame) for frame in frames.tolist()]))

    def speed_at(self, frame):
        """Own seconds per second of the scene at a frame."""
        return self.speed if self.keyed is None else float(self.keyed.values(np.array([frame]))[0])

    def earlier(self, frame, seconds):
        """Frame that is at least so many own seconds before a frame, or at which nothing was born yet."""
        if self.keyed is None and self.speed > 0.0:
            return frame - seconds * self.fps / self.speed
        return min(frame, self.start)

    def later(self, frame, seconds):
        """Frame that is at least so many own seconds after a frame, or far beyond it if the speed is keyed or 0."""
        return frame + (seconds * self.fps / self.speed if self.keyed is None and self.speed > 0.0 else FAR)

    @property
    def stamp(self):
        """Hashable value that changes whenever seconds() of an evaluated emitter may change; None if changes cannot be detected."""
        return strips.together((self.start, self.fps, self.speed, 0 if self.keyed is None else self.keyed.stamp))


class Loop(NamedTuple):
    """Frames over which a snowfall repeats. start, end: frames; at `end` it is as at `start`. period: own seconds between them."""

    start: float
    end: float
    period: float

    def within(self, frame):
        """Frame of the loop that looks like any frame of the scene: from `start` to just before `end`."""
        return self.start + (frame - self.start) % (self.end - self.start)

    def number(self, frame):
        """How many times the loop has ended before a frame of the scene."""
        return math.floor((frame - self.start) / (self.end - self.start))

    def laps(self, longest):
        """For how many loops a flake lives at most, begun ones included, and at least 1. longest: most own seconds that a flake lives."""
        return max(1, math.ceil(longest / self.period))

    @property
    def frame(self):
        """Own seconds of a frame, on average."""
        return self.period / (self.end - self.start)


def read(emitter, fps):
    """Return (Clock of an emitter, original or evaluated; whether its speed is known at all times)."""
    settings = emitter.motus.snow
    steady = Clock(settings.start_frame, fps, settings.time_speed)
    if not copies.has_moving_settings(emitter):
        return steady, True
    speed = Channel(emitter, SPEED, -1)
    if speed.is_constant or speed.reason:
        return steady, speed.is_constant
    return steady._replace(speed=1.0, keyed=speed), True


def looped(settings, clock, longest):
    """Return (Clock that begins with the loop, Loop, Problem to show or None); (clock, None, Problem or None) without a loop.

    longest: most own seconds that a flake lives.
    """
    if not settings.use_loop:
        return clock, None, None
    start, end = float(settings.loop_start), float(settings.loop_end)
    own = clock._replace(start=start)
    loop = Loop(start, end, own.seconds(end))
    if loop.end <= loop.start:
        return clock, None, NO_LOOP
    if loop.period < SHORTEST:  # time stands still
        return clock, None, None
    return own, loop, None if loop.laps(longest) <= MOST_LAPS else TOO_SHORT
