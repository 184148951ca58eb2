"""Where on the way at the present frame: the settings as a native Timing."""

import math
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from ..core import native
from ..core.system import Problem
from . import keyed

NO_PINS = Problem("Add a pin: a frame and the place to be at")
SAME_FRAME = Problem("Two pins are on the same frame")
DRIVEN_SPEED = Problem("The speed is driven, so its past is not known: its present value counts for the whole way", False)
PROBLEMS = (NO_PINS, SAME_FRAME, DRIVEN_SPEED)

REPEATING = {'LOOP', 'PING_PONG'}
SHORTEST = 1e-6  # s; keys and drivers can pass the setting's own limits
JUMP = 1e-9  # of the duration: how fast the speed jumps where there is no ease


@dataclass(frozen=True)
class Motion:
    """The distance along the curve is timing.distance(time) + offset."""

    timing: Any
    time: float
    offset: float = 0.0
    problem: Optional[Problem] = None

    @property
    def distance(self):
        return self.timing.distance(self.time) + self.offset

    @property
    def speed(self):
        return self.timing.speed(self.time)


def motion(context, numbers, length):
    """The Motion at the context's frame, or a blocking Problem."""
    return _BY_TIMING[context.settings.timing](context, numbers, length)


def _since_start(context, numbers):
    return max(0.0, (context.frame - numbers["start_frame"]) / context.fps)


def _by_duration(context, numbers, length):
    duration = max(numbers["duration"], SHORTEST)
    ease_in = min(max(numbers["ease_in"], 0.0), 1.0)
    ease_out = min(max(numbers["ease_out"], 0.0), 1.0 - ease_in)
    time = _since_start(context, numbers)
    repeats = context.settings.extend in REPEATING
    if time <= duration or not (repeats or context.settings.extend == 'EXTRAPOLATE'):
        return Motion(native.module.Timing.eased(duration, length, ease_in, ease_out), time)
    if numbers["lag_rate"] == 0.0 and repeats:
        laps = math.floor(time / duration)
        timing = native.module.Timing.eased(duration, length, ease_in, ease_out)
        return Motion(timing, time - laps * duration, laps * length)
    # The lag needs one history over all laps; after the last sample the speed holds.
    laps = math.floor(time / duration) + 1 if repeats else 1
    return Motion(_eased_laps(duration, length, ease_in, ease_out, laps, repeats), time)


def _eased_laps(duration, length, ease_in, ease_out, laps, repeats):
    """Timing of eased laps one after another; else one lap, and on at the speed that it ends with."""
    cruise = length / duration / (1.0 - 0.5 * (ease_in + ease_out))
    joint = 0.0 if ease_in or ease_out else cruise
    last = joint if repeats else 0.0 if ease_out else cruise
    lap = np.array([0.0, max(ease_in, JUMP), 1.0 - max(ease_out, JUMP)])
    fractions = np.append(np.add.outer(np.arange(laps), lap).ravel(), laps)
    speeds = np.append(np.tile([joint, cruise, cruise], laps), last)
    times, first = np.unique(fractions * duration, return_index=True)
    return native.module.Timing.speeds(times, speeds[first])


def _by_speed(context, numbers, _length):
    time = _since_start(context, numbers)
    settings = context.settings
    curve = keyed.find(context.owner, settings, "speed")
    if curve is None:
        driven = keyed.is_driven(context.owner, settings, "speed")
        return Motion(native.module.Timing.constant(numbers["speed"]), time, problem=DRIVEN_SPEED if driven else None)
    frames, speeds = keyed.samples(curve, numbers["start_frame"], context.frame)
    times = (frames - numbers["start_frame"]) / context.fps
    return Motion(native.module.Timing.speeds(times, speeds), time)


def _by_pins(context, _numbers, length):
    settings = context.settings
    if not settings.pins:
        return NO_PINS
    if settings.pins_by == 'FRACTION':
        pins = sorted((pin.frame, pin.fraction * length) for pin in settings.pins)
    else:
        pins = sorted((pin.frame, pin.distance) for pin in settings.pins)
    frames, distances = np.array(pins).T
    if not np.diff(frames).all():
        return SAME_FRAME
    return Motion(native.module.Timing.pins(frames / context.fps, distances), context.frame / context.fps)


def _by_hand(context, numbers, length):
    distance = numbers["distance_factor"] * length
    curve = keyed.find(context.owner, context.settings, "distance_factor")
    if curve is None:
        return Motion(native.module.Timing.constant(0.0), 0.0, distance)
    if numbers["lag_rate"] == 0.0 or len(curve.keyframe_points) == 0:
        speed = keyed.rate(curve, context.frame) * length * context.fps
        return Motion(native.module.Timing.constant(speed), 0.0, distance)
    first = curve.keyframe_points[0].co[0]
    frames, fractions = keyed.samples(curve, first, context.frame)
    times = (frames - first) / context.fps
    if len(times) < 2:
        return Motion(native.module.Timing.constant(0.0), 0.0, distance)
    timing = native.module.Timing.speeds(times, np.gradient(fractions * length, times))
    time = max(0.0, context.frame - first) / context.fps
    return Motion(timing, time, distance - timing.distance(time))


_BY_TIMING = {'DURATION': _by_duration, 'SPEED': _by_speed, 'PINS': _by_pins, 'MANUAL': _by_hand}
