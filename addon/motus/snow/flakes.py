"""Make the native Snow from an emitter's settings, and write its flakes into Blender's point attributes."""

import math
from typing import NamedTuple

from ..core import keeping, native
from ..core.declare import Problem
from ..core.evaluated.per_thread import scratch
from ..core.file.choices import chosen
from ..core.lazy import numpy as np
from ..core.refusals import INFINITE
from ..core.scenery import meshes
from .births import Rates, Winds, highest_rate
from .properties import KEYWORDS, WHITE

MOST = 1 << 24
"""Most flakes that may exist at one time."""
BYTES = 68
"""Memory of one flake, in bytes: position, velocity, rotation, colour, radius, age and number."""
_snows = keeping.OfFile(
    "native Snow objects of emitters, with the landing places of the flakes, or the Problem of the emitter",
    "all values that the flakes' motion depends on",
    most=32,
)
_colliders = keeping.OfFile(
    "native SnowColliders, made of the meshes that flakes land on", "stamps and world matrices of the meshes' faces", most=4
)
STEP = 1 << 16
"""The size of the scratch array for flakes' numbers is a multiple of this, so that the array is seldom made anew."""

NOT_FINITE = Problem("A setting is not a finite number")
NUMBERS = 720720
"""In a loop flakes of equal numbers but for a multiple of this look alike: the numbers from 1 to 16 divide it, so that flakes choose among
as many objects of a collection alike.
"""
SHUTTER = 2.0
"""Frames for which a number stays unused after a flake has gone, in a loop."""
TOO_MANY = Problem("More than 16 million flakes at once would need over 1 GB of memory: lower the rate or the lifetime")
OUT_OF_RANGE = Problem("A setting is outside of what flakes can do")

_DIRECT = (
    "start_speed",
    "lifetime",
    "delay",
    "duration",
    "looping",
    "emitter_radius",
    "cone_angle",
    "random_speed",
    "random_orientation",
    "random_lifetime",
    "random_size",
    "random_color",
    "seed",
    "use_steering",
    "max_angle",
    "steering_frequency",
    "steering_per_flake",
    "gravity",
    "drag",
    "gusts",
    "gust_frequency",
    "turbulence",
    "turbulence_size",
    "tumble",
    "melt_time",
    "friction",
)
"""Settings that are arguments of the native library, in equal units."""
_NATIVE = {
    "emitter_radius": "cone_radius",
    "use_steering": "snow",
    "steering_frequency": "snow_frequency",
    "steering_per_flake": "snow_offsets",
}
"""Name of a setting -> name of the argument of the native library, if the two differ."""
_SHAPES = {'CAMERA': "frustum"}
"""Shape in the settings -> name of the shape in the native library, if it is not the lower-case word."""
_NAMES = (("position", "position"), ("velocity", "velocity"), ("size", "radius"), ("color", "tint"), ("age", "age"), ("rotation", "turn"))
"""(name of a result of the native library, name of the point attribute that gets it)."""
# The golden ratio of 2^32: products with it are spread evenly over 32 bits.
_SCATTER = 2654435769


def most(settings):
    """Largest number of flakes that can exist at one time, by an emitter's settings."""
    longest = longest_life(settings)
    births = longest if settings.looping else min(longest, settings.duration)
    return highest_rate(settings.id_data) * births + 1.0 + settings.burst


def longest_life(settings):
    """Most seconds that a flake of an emitter with these settings lives."""
    return settings.lifetime + (1.0 if settings.random_lifetime else 0.0)


def numbers(settings):
    """Return the settings as keywords of the native Snow, or the Problem if they are wrong.

    The keywords are a hashable tuple of (name, value) pairs. The wind and the rate, which may change over time, are not among them.
    """
    values = [getattr(settings, name) for name in KEYWORDS]
    parts = [part for value in values for part in (value if hasattr(value, "__len__") else (value,))]
    stops = sorted((stop.position, tuple(stop.color)) for stop in settings.stops) or [(0.0, WHITE)]
    parts += [part for position, color in stops for part in (position, *color)]
    if not all(abs(part) < INFINITE for part in parts if isinstance(part, float)):
        return NOT_FINITE
    if not most(settings) <= MOST:
        return TOO_MANY
    found, shape = [(_NATIVE.get(name, name), getattr(settings, name)) for name in _DIRECT], chosen(settings, "shape")
    found += [
        ("collision", chosen(settings, "collision").lower()),
        ("start_size", _size(settings)),
        ("shape", _SHAPES.get(shape) or shape.lower()),
        ("start_color", (tuple(position for position, _ in stops), tuple(color for _, color in stops))),
    ]
    if settings.use_ground:
        found.append(("ground", settings.ground))
    if settings.emitter_velocity and not settings.use_local and shape != 'CAMERA':
        found.append(("inherited", settings.emitter_velocity))
    if shape == 'CAMERA':
        found += [("frustum_near", settings.closest), ("frustum_far", settings.farthest)]
    if settings.burst > 0:
        found += [("burst_times", (settings.burst_time,)), ("burst_counts", (settings.burst,))]
    return tuple(found)


def _size(settings):
    """Scale of the instances that flakes are shown as, or radius of the points.

    It is the setting Size, for Motus' own shapes and for points times half of Flake Width.
    """
    is_scale = settings.look in {'OBJECT', 'COLLECTION'}
    return settings.start_size * (1.0 if is_scale else 0.5 * settings.flake_width)


def looped(keywords, rate, period):
    """Return (keywords, rate, count) of the flakes that one loop lets be born, from 0 to its period; their count is made whole.

    keywords: result of numbers(). rate: births.Rates, or a number. period: of the loop, s.
    """
    given = dict(keywords) | {"delay": 0.0, "period": period, "looping": False}
    count = rate.until(period) if isinstance(rate, Rates) else rate * period
    if dict(keywords)["looping"] or given["duration"] >= period:
        factor = round(count) / count if count > 0.0 else 1.0
        rate = rate.scaled(factor) if isinstance(rate, Rates) else rate * factor
        last = float(rate.values[-1]) if isinstance(rate, Rates) else rate
        # Up to half way from the last flake's birth to the next one's, so that rounding leaves none out.
        given["duration"] = period + (0.5 / last if last > 0.0 else 0.0)
    if "burst_times" in given:
        given["burst_times"] = tuple(time % period for time in given["burst_times"])
    return tuple(given.items()), rate, count + sum(given.get("burst_counts", ()))


def made(*what):
    """Return the native Snow for the arguments of _made(), kept for equal arguments; a Problem if the library refuses them."""
    return _snows.made(what, lambda: _made(*what))


def _made(keywords, acceleration, poses, wind, rate, faces=None, angles=None, collider=None, carriers=()):
    """Make the native Snow of an emitter; returns the Problem OUT_OF_RANGE if the library refuses a value.

    keywords: result of numbers(). acceleration: of gravity, m/s^2. poses: births.Poses of the emitter. wind: births.Winds or (x, y, z).
    rate: births.Rates or a number. faces: meshes.Faces that flakes leave, or None. angles: half the angles of the camera's view in which
    flakes are born, or None. collider: native SnowCollider that flakes land on, or None. carriers: colliders.Carriers that they land on.
    """
    given = dict(keywords)
    if isinstance(wind, Winds):
        given |= {"wind_times": wind.seconds, "wind_values": wind.velocities}
    else:
        given["wind"] = wind
    if isinstance(rate, Rates):
        given |= {"rate_times": rate.seconds, "rate_values": rate.values}
    else:
        given["rate"] = rate
    if angles is not None:
        given["frustum_angles"] = angles
    if collider is not None:
        given["collider"] = collider
    if carriers:
        given["movers"] = [(one.collider, one.seconds, one.matrices) for one in carriers]
    if faces is not None:
        given |= {"surface_positions": faces.positions, "surface_triangles": faces.triangles}
    try:
        return native.module.Snow(**given, acceleration=acceleration, emitter_times=poses.seconds, emitter_matrices=poses.matrices)
    except ValueError:
        return OUT_OF_RANGE


def collider(parts):
    """Return the native SnowCollider of triangle meshes, kept for equal meshes; None if the library refuses them.

    parts: tuple of meshes.Placed (a triangle mesh with its world matrix).
    """
    return _colliders.made(parts, lambda: _collider(parts))


def _collider(parts):
    try:
        return native.module.SnowCollider(*meshes.joined(parts))
    except ValueError:
        return None


class Moment(NamedTuple):
    """Flakes of a native Snow at a time. seconds: the time. numbered: what is added to their numbers."""

    seconds: float
    numbered: int = 0


def moments(clock, loop, frame, longest, count):
    """List the Moments whose flakes, together, are those of a frame: a single one without a loop.

    In a loop the native Snow has the flakes of one loop, which are there once for each loop in which they were born.
    clock: Clock. loop: Loop or None. longest: most own seconds that a flake lives. count: flakes that a loop lets be born, about.
    """
    if loop is None:
        return (Moment(clock.seconds(frame)),)
    seconds, number, laps = clock.seconds(loop.within(frame)), loop.number(frame), loop.laps(longest)
    # A flake has the same number in each loop that it lives in. Flakes that are there at once, or while a shutter is open, have different
    # ones: Blender blurs what has a number by the way from one place with that number to the next.
    apart, groups = NUMBERS * math.ceil((count + 1.0) / NUMBERS), loop.laps(longest + SHUTTER * loop.frame)
    if apart * groups >= 1 << 31:  # Blender's numbers have 32 bits
        apart = 0
    return tuple(Moment(seconds + lap * loop.period, apart * ((number - lap) % groups)) for lap in range(laps, -1, -1))


def fill(points, snow, when, share, is_found=True):
    """Write the flakes of some Moments, all of them or a share, into Blender's point attributes.

    points: Context.points, a function that returns the arrays for a number of points. snow: native Snow. when: the Moments.
    share: 0 to 1. is_found: whether all landing places are known; if not, flakes whose landing place is unknown are left out.
    Returns the arrays.
    """
    if share >= 1.0 and len(when) == 1:
        found = {}

        def room(count):
            found.update(points(count))
            return _named(found) | {"id": _numbers(count)}

        numbered = snow.evaluate(when[0].seconds, out=room, known=not is_found)["id"]
        found["id"][:] = numbered
        return found
    parts = [snow.evaluate(one.seconds, known=not is_found) for one in when]
    places = [np.flatnonzero(is_chosen(one["id"], share)) for one in parts]
    found = points(sum(map(len, places)))
    ends = np.cumsum([0, *map(len, places)])
    for part, chosen_ones, one, first, last in zip(parts, places, when, ends[:-1], ends[1:]):
        found["id"][first:last] = part["id"][chosen_ones] + one.numbered
        for name, array in _named(found).items():
            np.take(part[name], chosen_ones, axis=0, out=array[first:last])
    return found


def is_chosen(ids, share):
    """Mask (n,) of the flakes that belong to a share of all flakes; a larger share contains every smaller share.

    ids: (n,), numbers of the flakes. share: 0 to 1.
    """
    return (ids.astype(np.uint64) * np.uint64(_SCATTER)).astype(np.uint32) < share * 2.0**32


def _named(points):
    """Return {name of a result of the native library: Blender's point array that gets it}.

    The flakes' numbers are left out: the library's are 64-bit integers, and Blender's are 32-bit.
    """
    return {own: points[name] for own, name in _NAMES if name in points}


def _numbers(count):
    return scratch("snow_ids", (STEP * (1 + count // STEP),), np.int64)[:count]
