"""Solver of Follow Path: declares its inputs and calls the native module once for the owner and all its wagons."""

from ..core import native
from ..core.declare import Deformed, Matrix, Problem, Setting, Splines
from ..core.file import deleted
from ..core.file.choices import chosen
from ..core.lazy import numpy as np
from ..core.measures.handedness import is_constant, is_mirrored
from . import curves, members, motion

NO_CURVE = Problem("Choose a curve to follow")
CURVE_DELETED = Problem("The curve is in no collection any more: choose another one")
AXES_NOT_ACROSS = Problem("The forward axis and the up axis must be perpendicular to each other")
PROBLEMS = (NO_CURVE, CURVE_DELETED, AXES_NOT_ACROSS) + curves.PROBLEMS + motion.PROBLEMS

NUMBERS = (
    "spline",
    "duration",
    "speed",
    "start_frame",
    "offset",
    "distance_factor",
    "ease_in",
    "ease_out",
    "bank_strength",
    "bank_limit",
    "bank_smoothing",
    "gravity",
    "lag_rate",
    "curvature_outward",
)
SHARED = ("influence", "timing", "extend", "orientation", "forward_axis", "up_axis", "lag_by", "pins", "pins_by")
INPUTS = (
    Matrix("matrix", of="curve"),
    Splines("splines", of="curve"),
    Deformed("deformed", of="curve"),
    *(Setting(name) for name in NUMBERS),
)

HALF_TURNS = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}
OUTPUTS = ("parameter", "fraction", "distance", "speed", "length")


def solve(context, matrix, splines, deformed, **numbers):
    """Write the world-space poses of the owner and its wagons at the context's frame into context.locations and context.rotations.

    matrix, splines, deformed: evaluated inputs from the curve object. numbers: numeric settings by name.
    Returns a Problem or None; a user's error never raises an exception.
    """
    index = int(numbers["spline"])
    common = context.common
    if index not in common:
        common[index] = _path(context, matrix, splines, index)
    path = common[index]
    if path.__class__ is Problem:
        return path
    length, fps = path.curve.length(), context.fps
    key = length, fps, context.owner is not None and _is_owner_mirrored(context)
    still = context.kept("still", key, lambda: _still(context, numbers, length))
    if still.__class__ is Problem:
        return still
    moving, options, offsets, mirrored = still
    time = moving.clock(context, numbers) if moving.clock else moving.time
    if "tilt" in options:
        options = options | {"tilt": path.tilt}
    native.module.follow(path.curve, moving.timing, time, offsets, locations=context.locations, rotations=context.rotations, **options)
    if mirrored:
        _turn_mirrored(context.rotations, mirrored, context.settings)
    extend = 'clamp' if options["line_up"] else options["extend"]  # the first member of a train that lines up stops at the ends
    _write_outputs(context.outputs, path.curve, length, moving, time, numbers["offset"], extend)
    return moving.problem


def _path(context, matrix, splines, index):
    """Convert the followed curve into a curves.WorldCurve; returns a Problem if the curve cannot be followed."""
    if context.owner is None:  # what rows keep is of several evaluated copies
        followed, is_deleted = _followed(context)
    else:
        followed, is_deleted = context.kept("followed", deleted.changes(), lambda: _followed(context))
    if matrix is None or splines is None or followed is None:
        return NO_CURVE
    if is_deleted:
        return CURVE_DELETED
    try:
        return curves.read(followed, splines, context.depsgraph, index, matrix)
    except curves.Unreadable as error:
        return error.problem
    except ReferenceError:  # the evaluated copy that was kept has been freed
        del context.memo["followed"]
        return _path(context, matrix, splines, index)


def _followed(context):
    """Return (evaluated object that is followed, or None if it is no curve, whether it was deleted)."""
    followed = context.target("curve")
    if followed is None or followed.type != 'CURVE':
        return None, False
    return followed, deleted.is_deleted(followed)


def _is_owner_mirrored(context):
    known = context.kept("mirrored", None, lambda: is_mirrored(context.owner) if is_constant(context.owner) else None)
    return is_mirrored(context.owner) if known is None else known


def _still(context, numbers, length):
    """Compute the values that stay constant until a setting changes, so that the result can be cached.

    Returns (Motion, keyword arguments of the native follow(), offsets of the owner and its wagons along the path, indices of mirrored
    objects). Returns a Problem if the settings have no meaning.
    """
    settings = context.settings
    if chosen(settings, "forward_axis")[-1] == chosen(settings, "up_axis")[-1]:
        return AXES_NOT_ACROSS
    if not (motion.is_finite(settings.influence) and np.isfinite(context.member_data).all()):
        return motion.NOT_FINITE
    past = native.module.LAG_MEMORY if numbers["lag_rate"] > 0.0 else 0.0
    moving = motion.motion(context, numbers, length, past)
    if isinstance(moving, Problem):
        return moving
    offsets = context.member_data + (numbers["offset"] + moving.offset)
    return moving, follow_options(settings, numbers, None), offsets, _mirrored(context)


def _mirrored(context):
    """Indices of the owner and its wagons whose scale, together with that of their parents, mirrors them.

    The result is empty if the orientation is off, or if several owners share one solver: their scales are not mirrored.
    """
    if context.owner is None or chosen(context.settings, "orientation") == 'NONE':
        return ()
    every = members.members(context.owner)[: len(context.rotations)]
    return [index for index, member in enumerate(every) if is_mirrored(member)]


def _turn_mirrored(rotations, which, settings):
    """Correct the quaternions of objects whose scale mirrors them; `which` holds their rows in `rotations`, which are changed in place.

    Blender's constraints write the rotation of a mirrored object as if its matrix had all axes reversed. A half turn about the third axis
    restores the forward and up axes.
    """
    across = ({"X", "Y", "Z"} - {chosen(settings, name)[-1] for name in ("forward_axis", "up_axis")}).pop()
    half_turn = np.array(HALF_TURNS[across])
    for index in which:
        w, x, y, z = rotations[index]
        rotations[index] = np.array(((-x, -y, -z), (w, -z, y), (z, w, -x), (-y, x, w))) @ half_turn


def follow_options(settings, numbers, tilt):
    """Keyword arguments of the native follow() for the settings of a follower. tilt: array for the orientation Tilt, or None."""
    mode, extend = chosen(settings, "orientation"), chosen(settings, "extend")
    options = {
        "mode": 'minimal' if mode == 'NONE' else mode.lower(),
        "rotate": mode != 'NONE',
        "extend": 'extrapolate' if extend == 'LINE_UP' else extend.lower(),
        "line_up": extend == 'LINE_UP',
        "forward": axis_name(chosen(settings, "forward_axis")),
        "up": axis_name(chosen(settings, "up_axis")),
        "lag_rate": max(numbers["lag_rate"], 0.0),
        "lag_by": chosen(settings, "lag_by").lower(),
    }
    return options | mode_options(settings, numbers, tilt)


def mode_options(settings, numbers, tilt):
    """Keyword arguments that the chosen orientation mode needs in the native functions frames() and follow()."""
    mode = chosen(settings, "orientation")
    if mode == 'TILT':
        return {"tilt": tilt}
    if mode not in {'BANKING', 'CURVATURE'}:
        return {}
    smoothing = {"smoothing": max(numbers["bank_smoothing"], 0.0)}
    if mode == 'CURVATURE':
        return smoothing | {"outward": bool(numbers["curvature_outward"])}
    return smoothing | {
        "strength": numbers["bank_strength"],
        "limit": max(numbers["bank_limit"], 0.0),
        "gravity": max(numbers["gravity"], 1e-3),
    }


def axis_name(identifier):
    """Name that the native module has for an axis of the settings: 'POS_Y' becomes 'Y', 'NEG_Y' becomes '-Y'."""
    return identifier.replace("POS_", "").replace("NEG_", "-")


def _write_outputs(outputs, curve, length, moving, time, offset, extend):
    gone = moving.timing.distance(time) + moving.offset + offset
    within = gone if 0.0 <= gone <= length else _within(gone, length, extend)
    on_curve = within if 0.0 <= within <= length else min(max(within, 0.0), length)
    # In a loop the distance goes on rising from lap to lap, so that a wheel driven by it turns on.
    distance = gone if extend == 'loop' and length else within
    outputs[:] = (curve.t_at_length(on_curve), within / length if length else 0.0, distance, moving.timing.speed(time), length)


def _within(distance, length, extend):
    """Apply the setting *Ends* to a distance along a path of this length.

    The result stops at an end (clamp), wraps around (loop, ping-pong), or goes on beyond the ends (extrapolate).
    """
    if extend == 'extrapolate' or length == 0.0:
        return distance
    if extend == 'clamp':
        return min(max(distance, 0.0), length)
    if extend == 'loop':
        return distance % length
    return length - abs(distance % (2.0 * length) - length)
