"""Solver of Follow Path: declares its inputs, and has the native module place all followers of a solver and their wagons in one call."""

from ..core import native
from ..core.declare import Context, Deformed, Matrix, Problem, Setting, Splines
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
    path = _path(context, matrix, splines, int(numbers["spline"]))
    if path.__class__ is Problem:
        return path
    reads, is_mirrored_owner = context.kept("fixed", None, lambda: _fixed(context))
    if is_mirrored_owner is None:
        is_mirrored_owner = is_mirrored(context.owner)
    found = context.kept(
        "made", (path, context.fps, is_mirrored_owner), lambda: _kept_plan(context, numbers, path, reads, is_mirrored_owner)
    )
    if found.__class__ is Problem:
        return found
    plan, problem, mirrored = found
    _follow(plan, context, [path])
    if mirrored:
        _turn_mirrored(context.rotations, mirrored, context.settings)
    return problem


def solve_rows(context, rows, matrix, splines, deformed):
    """Do for all owners that share a solver what solve() does for one of them; see System.solve_rows."""
    reads = context.kept("reads", None, lambda: _reads_of_rows(rows))
    paths = [_path(context, matrix, splines, index) for index in reads]
    key = context.fps, *(path if path.__class__ is Problem else path.told(*read) for path, read in zip(paths, reads.values()))
    plan, problems = context.kept("plan", key, lambda: _plan_of_rows(context, rows, list(reads), paths))
    _follow(plan, context, paths)
    return problems


def _spline_of(row):
    return int(row.inputs["spline"])


def _reads(settings):
    """Return (whether a plan with these settings is made from the path's length, whether it is made from the path's tilt).

    A curve that moves as a whole changes its length in the last digits: a plan that does not read the length is kept then.
    """
    return motion.reads_length(settings), chosen(settings, "orientation") == 'TILT'


def _reads_of_rows(rows):
    """Return {index of a spline: what _reads() says of all followers of the spline together}. rows: as in solve_rows()."""
    found = {}
    for row in filter(None, rows):
        before, now = found.get(_spline_of(row), (False, False)), _reads(row.settings)
        found[_spline_of(row)] = before[0] or now[0], before[1] or now[1]
    return found


def _kept_plan(context, numbers, path, reads, is_mirrored_owner):
    """Return what _plan() returns; it is kept for a path that only moves, if what the plan reads of the path stays the same."""
    key = path.told(*reads), context.fps, is_mirrored_owner
    return context.kept("plan", key, lambda: _plan(context, numbers, path))


def _plan(context, numbers, path):
    """Return (native FollowPlan of the owner and its wagons, Problem or None, indices of mirrored objects); a Problem if it blocks."""
    plan = native.module.FollowPlan()
    still = _still(context, numbers, path.curve.length())
    if isinstance(still, Problem):
        return still
    _add_to(plan, 0, path, still, numbers)
    moving, _, _, mirrored = still
    return plan, moving.problem, mirrored


def _plan_of_rows(context, rows, indices, paths):
    """Return (native FollowPlan of the owners in these rows, tuple with a Problem, an exception or None for each row)."""
    plan, problems = native.module.FollowPlan(), []
    for row in rows:
        problem = None
        if row is not None:
            place = indices.index(_spline_of(row))
            try:
                problem = _add_row(plan, context, row, place, paths[place])
            except Exception as error:  # of this row alone
                problem = error
        if row is None or isinstance(problem, Exception) or (problem is not None and problem.blocking):
            plan.skip()
        problems.append(problem)
    return plan, tuple(problems)


def _add_row(plan, context, row, place, path):
    """Add the owner of a row to a plan, unless a Problem blocks it; returns the Problem or None."""
    if isinstance(path, Problem):
        return path
    length = path.curve.length()
    its = Context(row.settings, None, context.frame, context.depsgraph, member_data=row.member_data, memo=row.memo)
    key = length if motion.reads_length(row.settings) else None, context.fps
    still = its.kept("still", key, lambda: _still(its, row.inputs, length))
    if isinstance(still, Problem):
        return still
    _add_to(plan, place, path, still, row.inputs)
    return still[0].problem


def _add_to(plan, place, path, still, numbers):
    """Add a follower to a native FollowPlan. place: index of its path in the list that the plan is given. still: result of _still()."""
    moving, options, offsets, _ = still
    clock = {"time": moving.time} if moving.clock is None else moving.clock
    tilt = {"tilt": path.tilt} if "tilt" in options else {}
    plan.add(place, moving.timing, offsets, moved=moving.offset, offset=numbers["offset"], **(options | clock | tilt))


def _follow(plan, context, paths):
    plan.solve([None if path.__class__ is Problem else path.curve for path in paths], context.frame, context.fps, context.poses)


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


def _fixed(context):
    """Return (result of _reads(), whether the owner is mirrored; None if that may change without an edit of the settings)."""
    return _reads(context.settings), is_mirrored(context.owner) if is_constant(context.owner) else None


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
