"""Compute a follower's distance along the path at a frame, by converting the timing settings into a Timing of the native module."""

import math
from dataclasses import dataclass, field
from typing import Any

from ..core import native
from ..core.animation import keys
from ..core.declare import Problem
from ..core.file.choices import chosen
from ..core.lazy import numpy as np
from . import keyed
from .properties import SLOWEST

NO_PINS = Problem("Add a pin: a frame and the place to be at")
SAME_FRAME = Problem("Two pins are on the same frame: the later one in the list counts", False)
DRIVEN_SPEED = Problem("The speed is driven, so its past is not known: its present value counts for the whole way", False)
SPEED_IN_STRIPS = Problem(
    "The speed is animated in NLA strips, so its past is not known: its present value counts for the whole way", False
)
FRACTION_IN_STRIPS = Problem("The fraction is animated in NLA strips, so the speed is not known: banking and lag take it for 0", False)
DISTANCE_IN_STRIPS = Problem("The distance is animated in NLA strips, so the speed is not known: banking and lag take it for 0", False)
PAST_UNKNOWN = Problem("The distance is driven or animated in NLA strips, so its past is not known: gaps by time have no effect", False)
NO_SPEEDS = Problem("Add a speed: a place on the path and the speed there")
SAME_PLACE = Problem("Two speeds are at the same place: the later one in the list counts", False)
OFF_PATH = Problem("A speed is at a place before or beyond the path, which repeats: it is left out", False)
NOT_FINITE = Problem("A setting is not a finite number")
PROBLEMS = (
    NO_PINS,
    SAME_FRAME,
    DRIVEN_SPEED,
    SPEED_IN_STRIPS,
    FRACTION_IN_STRIPS,
    DISTANCE_IN_STRIPS,
    PAST_UNKNOWN,
    NO_SPEEDS,
    SAME_PLACE,
    OFF_PATH,
    NOT_FINITE,
)

IN_STRIPS = {"distance_factor": FRACTION_IN_STRIPS, "distance": DISTANCE_IN_STRIPS}
AFTER_EASE = {'CLAMP': "rest", 'EXTRAPOLATE': "go_on", 'LOOP': "repeat", 'PING_PONG': "repeat", 'LINE_UP': "rest"}
LAPS = {'LOOP': 1, 'PING_PONG': 2}  # lengths of the path after which the places are the same again
SHORTEST = 1e-6  # shortest duration, s; keys and drivers can exceed the limits of the setting
INFINITE = 3.4e38  # Blender stores infinity as a number above this one


@dataclass(frozen=True)
class Motion:
    """Motion of a follower along the curve: the distance at the present frame is timing.distance(time) + offset.

    problem: a Problem that does not block the solver, or None. clock: keywords of FollowPlan.add(), in the native module, by which the plan
    computes the time at any frame until a setting changes; None if the timing belongs to one frame. start: time before which the follower
    rests, s; None if the timing says itself what was before. behind: {delay: metres} to add at a delay, where the timing is not as exact as
    at the present frame; absent delays need none.
    """

    timing: Any
    time: float
    offset: float = 0.0
    problem: Problem | None = None
    clock: dict[str, float] | None = None
    start: float | None = None
    behind: dict[float, float] = field(default_factory=dict)

    @property
    def distance(self):
        return self.timing.distance(self.time) + self.offset

    @property
    def speed(self):
        return self.timing.speed(self.time)


def motion(context, numbers, length, past, delays=()):
    """Compute the Motion of a follower at the context's frame; returns a blocking Problem if the settings have no meaning.

    numbers: {name: value} of the numeric settings. length: length of the path.
    past: seconds before the present time for which the timing must be exact. *Lag* and the viewport overlay look back so far. delays: times
    before the present one, s, at which the timing must be exact too: members that follow by time are there.
    """
    if not all(map(is_finite, numbers.values())):
        return NOT_FINITE
    return _BY_TIMING[chosen(context.settings, "timing")](context, numbers, length, past, delays)


def reads_length(settings):
    """Whether the Motion of a follower whose settings are not animated depends on the length of the path."""
    timing = chosen(settings, "timing")
    if timing == 'PLACES':
        return chosen(settings, "extend") in LAPS
    return timing in {'DURATION', 'MANUAL'} or (timing == 'PINS' and chosen(settings, "pins_by") == 'FRACTION')


def is_finite(value):
    """Whether a number from a setting is finite. Blender stores infinity as the largest single-precision number."""
    return abs(value) < INFINITE


def _since_start(context, numbers):
    start = numbers["start_frame"]
    return (context.frame - start) / context.fps if context.frame > start else 0.0


def _by_duration(context, numbers, length, _past, _delays):
    duration = max(numbers["duration"], SHORTEST)
    ease_in = min(max(numbers["ease_in"], 0.0), 1.0)
    ease_out = min(max(numbers["ease_out"], 0.0), 1.0 - ease_in)
    after = AFTER_EASE[chosen(context.settings, "extend")]
    timing = native.module.Timing.eased(duration, length, ease_in, ease_out, after)
    return Motion(timing, _since_start(context, numbers), clock={"start_frame": numbers["start_frame"]}, start=0.0)


def _by_speed(context, numbers, _length, past, delays):
    settings, owner = context.settings, context.owner
    curve = unknown = None
    if not context.is_still:
        curve = keyed.find(owner, settings, "speed")
        if keyed.is_driven(owner, settings, "speed"):
            unknown = DRIVEN_SPEED
        elif keyed.is_in_strips(owner, settings, "speed"):
            unknown = SPEED_IN_STRIPS
    if curve is None or unknown:
        timing = native.module.Timing.constant(numbers["speed"])
        return Motion(timing, _since_start(context, numbers), problem=unknown, clock={"start_frame": numbers["start_frame"]}, start=0.0)
    start = numbers["start_frame"]
    now = max(start, context.frame)
    if now == start:
        return Motion(native.module.Timing.constant(curve.evaluate(start)), 0.0, start=0.0)
    distance = keys.integral(curve, start, now) / context.fps
    if not is_finite(distance):
        return NOT_FINITE
    past = max((past, *delays))
    if not past:
        return Motion(native.module.Timing.constant(curve.evaluate(now)), 0.0, distance)
    frames, speeds = keys.samples(curve, max(start, now - past * context.fps), now)
    times = (np.array(frames) - start) / context.fps
    timing = native.module.Timing.speeds(times, speeds)
    offset = distance - timing.distance(times[-1])
    behind = {}
    for delay in delays:
        frame = max(start, now - delay * context.fps)
        behind[delay] = keys.integral(curve, start, frame) / context.fps - timing.distance(max(0.0, times[-1] - delay)) - offset
    return Motion(timing, times[-1], offset, start=0.0, behind=behind)


def place_on_path(settings, distance, length):
    """Return the place on the path, from 0 to its length, to which a distance leads on a path that repeats; else the distance."""
    lap = LAPS.get(chosen(settings, "extend"), 0) * length
    if not lap:
        return distance
    place = distance % lap
    return min(place, lap - place) if lap > length else place


def _by_places(context, numbers, length, _past, _delays):
    settings = context.settings
    found = {one.distance: max(one.speed, SLOWEST) for one in settings.speeds}
    if not found:
        return NO_SPEEDS
    if not all(map(is_finite, (value for one in found.items() for value in one))):
        return NOT_FINITE
    lap = LAPS.get(chosen(settings, "extend"), 0) * length
    places = sorted(found.items())
    problem = SAME_PLACE if len(found) < len(settings.speeds) else None
    if lap:
        end = length * (1.0 + 1e-6)  # the settings are in single precision
        on_path = [(min(place, length), speed) for place, speed in places if 0.0 <= place <= end]
        if len(on_path) < len(places):
            problem = OFF_PATH
        places = on_path or places[:1]
    if lap > length:  # back along the same places
        places += [(lap - place, speed) for place, speed in reversed(places) if lap - place > places[-1][0]]
    distances, speeds = np.array(places).T
    timing = native.module.Timing.speeds_by_distance(distances - numbers["offset"], speeds, lap or None)
    return Motion(timing, _since_start(context, numbers), problem=problem, clock={"start_frame": numbers["start_frame"]}, start=0.0)


def _by_pins(context, _numbers, length, _past, _delays):
    settings = context.settings
    if not settings.pins:
        return NO_PINS
    by_fraction = reads_length(settings)
    places = {pin.frame: pin.fraction * length if by_fraction else pin.distance for pin in settings.pins}
    pins = sorted(places.items())
    if not all(map(is_finite, (value for pin in pins for value in pin))):
        return NOT_FINITE
    frames, distances = np.array(pins).T
    timing = native.module.Timing.pins(frames / context.fps, distances)
    problem = SAME_FRAME if len(pins) < len(settings.pins) else None
    return Motion(timing, context.frame / context.fps, problem=problem, clock={})


def _by_fraction(context, numbers, length, past, delays):
    return _by_hand(context, "distance_factor", numbers, length, past, delays)


def _by_distance(context, numbers, _length, past, delays):
    return _by_hand(context, "distance", numbers, 1.0, past, delays)


def _by_hand(context, name, numbers, unit, past, delays):
    """Motion of a follower whose place is a setting that is keyed or driven. name: of the setting. unit: metres that a value of 1 means."""
    settings, owner = context.settings, context.owner
    distance = numbers[name] * unit
    is_animated = not context.is_still
    curve = keyed.find(owner, settings, name) if is_animated else None
    in_strips = is_animated and keyed.is_in_strips(owner, settings, name)
    if curve is None or in_strips:
        has_no_past = delays and (in_strips or (is_animated and keyed.is_driven(owner, settings, name)))
        unknown = PAST_UNKNOWN if has_no_past else IN_STRIPS[name] if in_strips else None
        return Motion(native.module.Timing.constant(0.0), 0.0, distance, unknown)
    past = max((past, *delays))
    if not past or len(curve.keyframe_points) == 0:
        speed = keys.rate(curve, context.frame) * unit * context.fps
        return Motion(native.module.Timing.constant(speed), 0.0, distance)
    first = curve.keyframe_points[0].co[0]
    earliest = -math.inf if delays else first  # an F-curve may move before its first key
    now = max(earliest, context.frame)
    # The sampled range ends after the present frame, which then has neighbours on both sides; the neighbours stay the same until
    # the next whole frame. The start of the range is treated in the same way.
    oldest = max(earliest, math.floor(max(earliest, now - past * context.fps)) - 2.0)
    frames = keys.bounds(curve, oldest, math.floor(now) + 2.0)
    timing = native.module.Timing.pins((np.array(frames) - first) / context.fps, [curve.evaluate(frame) * unit for frame in frames])
    time = (now - first) / context.fps
    offset = distance - timing.distance(time)
    behind = {delay: curve.evaluate(now - delay * context.fps) * unit - timing.distance(time - delay) - offset for delay in delays}
    return Motion(timing, time, offset, behind=behind)


_BY_TIMING = {
    'DURATION': _by_duration,
    'SPEED': _by_speed,
    'PINS': _by_pins,
    'MANUAL': _by_fraction,
    'DISTANCE': _by_distance,
    'PLACES': _by_places,
}
