"""The pendulum's own time: from the start frame on it runs while Playing is set, at the speed of the setting Speed.

Both settings may have keys.
"""

import math
from typing import NamedTuple

from ..core.animation.channel import Channel
from ..core.declare import Problem
from ..core.lazy import numpy as np

UNKNOWN = Problem("Playing or Speed is driven, or in NLA strips that are not known ahead: its present value counts for all the time", False)


class Clock(NamedTuple):
    """Time of a pendulum at a frame.

    seconds: of the pendulum's own time since its start. rate: seconds of that time per second of the scene; None if the rate changes.
    """

    seconds: float
    rate: float | None
    problem: Problem | None = None


def steady(settings):
    """Return (start frame, rate) of a pendulum whose settings are not animated. The rate is 0 if the pendulum is paused."""
    return settings.start_frame, settings.speed if settings.is_playing else 0.0


def read(owner, settings, frame, fps):
    """Return the Clock of a pendulum at a frame of the scene: the time it has been running, from its keys. owner: original or evaluated."""
    start, frame = settings.start_frame, max(settings.start_frame, frame)
    playing, speed = (Channel(owner, f"{settings.path_from_id()}.{name}", -1) for name in ("is_playing", "speed"))
    if playing.reason or speed.reason:
        return _steady(settings, frame, fps)._replace(problem=UNKNOWN)
    if playing.is_constant and speed.is_constant:
        return _steady(settings, frame, fps)
    runs = _runs(playing, start, frame) if frame > start else []
    return Clock(math.fsum(speed.integral(first, last) for first, last in runs) / fps, None)


def _steady(settings, frame, fps):
    start, rate = steady(settings)
    return Clock((frame - start) / fps * rate, rate)


def _runs(playing, first, last):
    """List the spans, [first, last] frame, between two frames in which a boolean Channel is true."""
    edges = playing.bounds(first, last)
    middles = 0.5 * (np.array(edges[:-1]) + np.array(edges[1:]))
    runs = []
    for begin, end, is_on in zip(edges, edges[1:], playing.values(middles)):
        if not is_on:
            continue
        if runs and runs[-1][1] == begin:
            runs[-1][1] = end
        else:
            runs.append([begin, end])
    return runs
