"""The native Snow that the settings ask for, and its flakes in Blender's memory."""

from ..core import keeping, native
from ..core.declare import Problem
from ..core.evaluated.per_thread import scratch
from ..core.file.choices import chosen
from ..core.lazy import numpy as np
from ..core.refusals import INFINITE
from ..core.scenery import meshes
from .births import Winds
from .properties import KEYWORDS, WHITE

MOST = 1 << 24
"""Flakes at once."""
BYTES = 68
"""Of a flake: position, velocity, turn, colour, radius, age and number."""
_snows = keeping.OfFile(
    "native Snow of an emitter, with where its flakes land; or what is wrong with it", "all that the flakes' ways are made from", most=32
)
_colliders = keeping.OfFile("native SnowCollider of meshes that flakes land on", "stamps of the faces, and where they stand", most=4)
STEP = 1 << 16
"""Flakes for whose numbers there is room are a multiple of it, so that the room stays the same from frame to frame."""

NOT_FINITE = Problem("A setting is not a finite number")
TOO_MANY = Problem("More than 16 million flakes at once would need over 1 GB of memory: lower the rate or the lifetime")
OUT_OF_RANGE = Problem("A setting is outside of what flakes can do")

_DIRECT = (
    "start_speed",
    "lifetime",
    "rate",
    "delay",
    "duration",
    "looping",
    "cone_radius",
    "cone_angle",
    "random_speed",
    "random_orientation",
    "random_lifetime",
    "random_size",
    "random_color",
    "seed",
    "snow",
    "max_angle",
    "snow_frequency",
    "snow_offsets",
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
"""Settings that the library has under the same names and in the same units."""
_SHAPES = {'CAMERA': "frustum"}
"""The library's names that are others."""
_NAMES = (("position", "position"), ("velocity", "velocity"), ("size", "radius"), ("color", "tint"), ("age", "age"), ("rotation", "turn"))
"""The library's name, and that of the points' attribute."""
# The golden ratio of 2^32: products with it are spread evenly over 32 bits.
_SCATTER = 2654435769


def most(settings):
    """How many flakes there can be at once."""
    longest = longest_life(settings)
    births = longest if settings.looping else min(longest, settings.duration)
    return settings.rate * births + 1.0 + settings.burst


def longest_life(settings):
    """Seconds that a flake lives, at most."""
    return settings.lifetime + (1.0 if settings.random_lifetime else 0.0)


def numbers(settings):
    """Keywords of the library as a tuple of pairs, hashable, without the wind; or what is wrong with the settings."""
    values = [getattr(settings, name) for name in KEYWORDS]
    parts = [part for value in values for part in (value if hasattr(value, "__len__") else (value,))]
    stops = sorted((stop.position, tuple(stop.color)) for stop in settings.stops) or [(0.0, WHITE)]
    parts += [part for position, color in stops for part in (position, *color)]
    if not all(abs(part) < INFINITE for part in parts if isinstance(part, float)):
        return NOT_FINITE
    if not most(settings) <= MOST:
        return TOO_MANY
    found, shape = [(name, getattr(settings, name)) for name in _DIRECT], chosen(settings, "shape")
    found += [
        ("collision", chosen(settings, "collision").lower()),
        ("start_size", _size(settings)),
        ("shape", _SHAPES.get(shape) or shape.lower()),
        ("start_color", (tuple(position for position, _ in stops), tuple(color for _, color in stops))),
    ]
    if settings.use_ground:
        found.append(("ground", settings.ground))
    if shape == 'CAMERA':
        found += [("frustum_near", settings.closest), ("frustum_far", settings.farthest)]
    if settings.burst > 0:
        found += [("burst_times", (settings.burst_time,)), ("burst_counts", (settings.burst,))]
    return tuple(found)


def _size(settings):
    """Scale of instances: 1 for objects that the artist chose, half the width for Motus' own shapes and for points."""
    is_scale = settings.look in {'OBJECT', 'COLLECTION'}
    return settings.start_size * (1.0 if is_scale else 0.5 * settings.flake_width)


def made(*what):
    """The native Snow of what _made() is given, or what is wrong with it."""
    return _snows.made(what, lambda: _made(*what))


def _made(keywords, acceleration, poses, wind, faces=None, angles=None, collider=None):
    """The native Snow; or what is wrong with it.

    wind: of births.winds(). faces: that flakes leave. angles: half those that a camera sees by. collider: a SnowCollider. Each
    of the last three may be None.
    """
    given = dict(keywords)
    if isinstance(wind, Winds):
        given |= {"wind_times": wind.seconds, "wind_values": wind.velocities}
    else:
        given["wind"] = wind
    if angles is not None:
        given["frustum_angles"] = angles
    if collider is not None:
        given["collider"] = collider
    if faces is not None:
        given |= {"surface_positions": faces.positions, "surface_triangles": faces.triangles}
    try:
        return native.module.Snow(**given, acceleration=acceleration, emitter_times=poses.seconds, emitter_matrices=poses.matrices)
    except ValueError:
        return OUT_OF_RANGE


def collider(parts):
    """The native SnowCollider of faces that are Placed, or None where they cannot be one."""
    return _colliders.made(parts, lambda: _collider(parts))


def _collider(parts):
    try:
        return native.module.SnowCollider(*meshes.joined(parts))
    except ValueError:
        return None


def fill(points, snow, seconds, share, is_found=True):
    """Fill Blender's point arrays with the flakes of a time, all of them or a chosen share.

    points: Context.points. is_found: whether it is known where all flakes land; else those are left out of which it is not.
    """
    if share >= 1.0:
        found = {}

        def room(count):
            found.update(points(count))
            return _named(found) | {"id": _numbers(count)}

        numbered = snow.evaluate(seconds, out=room, known=not is_found)["id"]
        found["id"][:] = numbered
        return
    ids = snow.evaluate(seconds, ("id",), known=not is_found)["id"]
    places = np.flatnonzero(is_chosen(ids, share))
    found = points(len(places))
    found["id"][:] = ids[places]
    named = _named(found)
    every = snow.evaluate(seconds, tuple(named), known=not is_found)
    for name, array in named.items():
        np.take(every[name], places, axis=0, out=array)


def is_chosen(ids, share):
    """Mask of the flakes that belong to a share of all; a smaller share is contained in a greater one."""
    return (ids.astype(np.uint64) * np.uint64(_SCATTER)).astype(np.uint32) < share * 2.0**32


def _named(points):
    """Blender's arrays by the library's names, but for the flakes' numbers, of which Blender has shorter ones."""
    return {own: points[name] for own, name in _NAMES if name in points}


def _numbers(count):
    return scratch("snow_ids", (STEP * (1 + count // STEP),), np.int64)[:count]
