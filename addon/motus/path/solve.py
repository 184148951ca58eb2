"""Solver of Follow Path: declares its inputs, and has the native module place all followers of a solver and their wagons in one call."""

from typing import Any, NamedTuple

import mathutils

from ..core import native
from ..core.declare import Context, Deformed, Matrix, Problem, Setting, Splines
from ..core.file import deleted
from ..core.file.choices import chosen
from ..core.lazy import numpy as np
from ..core.measures.handedness import is_constant, is_mirrored
from . import curves, members, motion

NO_CURVE = Problem("Choose a curve to follow")
CURVE_DELETED = Problem("The curve is in no collection any more: choose another one")
NO_RAIL = Problem("Choose the curve that is the rail")
RAIL_DELETED = Problem("The rail is in no collection any more: choose another one")
AXES_NOT_ACROSS = Problem("The forward axis and the up axis must be perpendicular to each other")
PROBLEMS = (NO_CURVE, CURVE_DELETED, NO_RAIL, RAIL_DELETED, AXES_NOT_ACROSS) + curves.PROBLEMS + motion.PROBLEMS

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
    "distance",
    "rail_spline",
    "side",
    "height",
    "wheelbase",
)
SHARED = (
    "influence",
    "timing",
    "extend",
    "orientation",
    "forward_axis",
    "up_axis",
    "lag_by",
    "pins",
    "pins_by",
    "speeds",
    "space",
    "rail_by",
    "rail_side",
    "side_by",
    "gaps_by",
)


class _AlsoDeformed(Deformed):
    """Deformed input of a further object, whose argument is None: the one variable of the first such input waits for both objects."""

    def variable(self, _owner, _settings):
        """None, since that of the first input reads the same proxy."""

    def read(self, _value, _settings):
        """None: what is waited for is read by the other inputs."""


INPUTS = (
    Matrix("matrix", of="curve"),
    Splines("splines", of="curve"),
    Deformed("deformed", of="curve"),
    Matrix("rail_matrix", of="rail"),
    Splines("rail_splines", of="rail"),
    _AlsoDeformed("rail_deformed", of="rail"),
    *(Setting(name) for name in NUMBERS),
)

HALF_TURNS = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}
OUTPUTS = ("parameter", "fraction", "distance", "speed", "length")


class Course(NamedTuple):
    """What a follower rides, if that is more than a curves.WorldCurve in the world.

    curve, tilt: those of `path`. path: curves.WorldCurve, in `space`. space: matrix without scale of the space in which the frames are computed;
    None for the world. rail: curves.WorldCurve of the rail, in `space`; None if the orientation reads none.
    """

    curve: Any
    tilt: Any
    path: Any
    space: Any
    rail: Any

    def told(self, reads_length, reads_tilt):
        """Return what a plan of followers is made from; see WorldCurve.told(). A rail is a part of the plan itself."""
        return *self.path.told(reads_length, reads_tilt), self.rail


def solve(context, matrix, splines, deformed, rail_matrix, rail_splines, rail_deformed, **numbers):
    """Write the world-space poses of the owner and its wagons at the context's frame into context.locations and context.rotations.

    matrix, splines, deformed: evaluated inputs from the curve object; those of the rail likewise. numbers: numeric settings by name.
    Returns a Problem or None; a user's error never raises an exception.
    """
    reads, is_mirrored_owner, in_own_space, has_rail = context.kept("fixed", None, lambda: _fixed(context))
    which = int(numbers["spline"]), in_own_space, int(numbers["rail_spline"]) if has_rail else None
    course = _course(context, which, (matrix, splines), (rail_matrix, rail_splines))
    return course if course.__class__ is Problem else _go(context, course, numbers, reads, is_mirrored_owner)


def _go(context, course, numbers, reads, is_mirrored_owner):
    """Do what solve() does once the curve has been read. Returns a Problem or None."""
    if is_mirrored_owner is None:
        is_mirrored_owner = is_mirrored(context.owner)
    found = context.kept(
        "made",
        ((course.path, course.rail) if course.__class__ is Course else course, context.fps, is_mirrored_owner),
        lambda: _kept_plan(context, numbers, course, reads, is_mirrored_owner),
    )
    if found.__class__ is Problem:
        return found
    plan, problem, mirrored = found
    plan.solve([course.curve], context.frame, context.fps, context.poses, None if course.space is None else [course.space])
    if mirrored:
        _turn_mirrored(context.rotations, mirrored, context.settings)
    return problem


def solve_moments(context_at, moments, splines, rail_splines):
    """Yield (Context, Problem or None) of one moment after the other, solved as solve() does.

    The curves are read anew only where their matrices are others than at the moment before; their shapes must stay what they are.
    context_at(frame): a Context. moments: (frame, numbers, matrix of the curve, matrix of the rail), with matrices (4, 4) or None.
    splines, rail_splines: of both; None where there is none.
    """
    read, course = None, None
    for frame, numbers, *matrices in moments:
        context = context_at(frame)
        reads, is_mirrored_owner, in_own_space, has_rail = context.kept("fixed", None, lambda context=context: _fixed(context))
        which = int(numbers["spline"]), in_own_space, int(numbers["rail_spline"]) if has_rail else None
        places = which, *(None if one is None else one.tobytes() for one in matrices)
        if places != read:
            path, rail = (None if one is None else mathutils.Matrix(one) for one in matrices)
            read, course = places, _course(context, which, (path, splines), (rail, rail_splines))
        yield context, course if course.__class__ is Problem else _go(context, course, numbers, reads, is_mirrored_owner)


def solve_rows(context, rows, matrix, splines, deformed, rail_matrix, rail_splines, rail_deformed):
    """Do for all owners that share a solver what solve() does for one of them; see System.solve_rows."""
    reads = context.kept("reads", None, lambda: _reads_of_rows(rows))
    courses = [_course(context, which, (matrix, splines), (rail_matrix, rail_splines)) for which in reads]
    key = context.fps, *(one if one.__class__ is Problem else one.told(*read) for one, read in zip(courses, reads.values()))
    plan, problems = context.kept("plan", key, lambda: _plan_of_rows(context, rows, list(reads), courses))
    _follow(plan, context, courses)
    return problems


def _which(settings, numbers):
    """Return what tells one Course on a curve from another: (spline, whether it is in the path's own space, the rail's spline or None)."""
    in_own_space, has_rail = _spaces(settings)
    return int(numbers["spline"]), in_own_space, int(numbers["rail_spline"]) if has_rail else None


def _spaces(settings):
    """Return (whether all is meant in the path's own space, whether the orientation reads a rail)."""
    return chosen(settings, "space") == 'PATH', chosen(settings, "orientation") == 'RAIL'


def _reads(settings):
    """Return (whether a plan with these settings is made from the path's length, whether it is made from the path's tilt).

    A curve that moves as a whole changes its length in the last digits: a plan that does not read the length is kept then.
    """
    return motion.reads_length(settings), chosen(settings, "orientation") == 'TILT'


def _reads_of_rows(rows):
    """Return {result of _which(): what _reads() says of all its followers together}. rows: as in solve_rows()."""
    found = {}
    for row in filter(None, rows):
        which = _which(row.settings, row.inputs)
        before, now = found.get(which, (False, False)), _reads(row.settings)
        found[which] = before[0] or now[0], before[1] or now[1]
    return found


def _kept_plan(context, numbers, course, reads, is_mirrored_owner):
    """Return what _plan() returns; it is kept for a path that only moves, if what the plan reads of the path stays the same."""
    key = course.told(*reads), context.fps, is_mirrored_owner
    return context.kept("plan", key, lambda: _plan(context, numbers, course))


def _plan(context, numbers, course):
    """Return (native FollowPlan of the owner and its wagons, Problem or None, indices of mirrored objects); a Problem if it blocks."""
    plan = native.module.FollowPlan()
    still = _still(context, numbers, course.curve.length())
    if isinstance(still, Problem):
        return still
    _add_to(plan, 0, course, still, numbers)
    moving, _, _, mirrored = still
    return plan, moving.problem, mirrored


def _plan_of_rows(context, rows, indices, courses):
    """Return (native FollowPlan of the owners in these rows, tuple with a Problem, an exception or None for each row)."""
    plan, problems = native.module.FollowPlan(), []
    for row in rows:
        problem = None
        if row is not None:
            place = indices.index(_which(row.settings, row.inputs))
            try:
                problem = _add_row(plan, context, row, place, courses[place])
            except Exception as error:  # of this row alone
                problem = error
        if row is None or isinstance(problem, Exception) or (problem is not None and problem.blocking):
            plan.skip()
        problems.append(problem)
    return plan, tuple(problems)


def _add_row(plan, context, row, place, course):
    """Add the owner of a row to a plan, unless a Problem blocks it; returns the Problem or None."""
    if isinstance(course, Problem):
        return course
    length = course.curve.length()
    its = Context(row.settings, None, context.frame, context.depsgraph, member_data=row.member_data, memo=row.memo)
    key = length if motion.reads_length(row.settings) else None, context.fps
    still = its.kept("still", key, lambda: _still(its, row.inputs, length))
    if isinstance(still, Problem):
        return still
    _add_to(plan, place, course, still, row.inputs)
    return still[0].problem


def _add_to(plan, place, course, still, numbers):
    """Add a follower to a native FollowPlan. place: index of its course in the list that the plan is given. still: result of _still()."""
    moving, options, members_at, _ = still
    clock = {"time": moving.time} if moving.clock is None else moving.clock
    curves_of = {"tilt": course.tilt} if "tilt" in options else {"rail": course.rail.curve} if "rail" in options else {}
    plan.add(place, moving.timing, moved=moving.offset, offset=numbers["offset"], **(options | members_at | clock | curves_of))


def _follow(plan, context, courses):
    found = [None if course.__class__ is Problem else course for course in courses]
    spaces, are_needed = [course and course.space for course in found], False
    for space in spaces:
        are_needed = are_needed or space is not None
    plan.solve([course and course.curve for course in found], context.frame, context.fps, context.poses, spaces if are_needed else None)


def _course(context, which, path, rail):
    """Return what is followed, a Course or curves.WorldCurve; a Problem if it cannot be followed.

    which: result of _which(). path, rail: (world matrix, splines) of the curve and of the rail, as inputs give them.
    """
    spline, in_own_space, rail_spline = which
    matrix = path[0]
    space = space_of(matrix) if in_own_space and matrix is not None else None
    found = _read(context, "curve", (NO_CURVE, CURVE_DELETED), path, spline, space)
    if found.__class__ is Problem:
        return found
    if rail_spline is None:
        return found if space is None else Course(found.curve, found.tilt, found, space, None)
    second = _read(context, "rail", (NO_RAIL, RAIL_DELETED), rail, rail_spline, space)
    return second if second.__class__ is Problem else Course(found.curve, found.tilt, found, space, second)


def space_of(matrix):
    """Matrix of the space that a path with this world matrix carries along: without the scale, so that metres are the world's."""
    location, rotation, _ = matrix.decompose()
    return mathutils.Matrix.LocRotScale(location, rotation, None)


def _read(context, name, problems, given, index, space):
    """Convert the curve of a setting into a curves.WorldCurve; returns a Problem if that is impossible.

    name: of the setting. problems: Problems for a curve that is missing, and for one that was deleted. given: (world matrix, splines).
    space: matrix of the space of the result; None for the world.
    """
    matrix, splines = given
    if context.owner is None:  # what rows keep is of several evaluated copies
        found, is_deleted = _found(context, name)
    else:
        found, is_deleted = context.kept(name, deleted.changes(), lambda: _found(context, name))
    if matrix is None or splines is None or found is None:
        return problems[0]
    if is_deleted:
        return problems[1]
    try:
        return curves.read(found, splines, context.depsgraph, index, matrix if space is None else space.inverted() @ matrix)
    except curves.Unreadable as error:
        return error.problem
    except ReferenceError:  # the evaluated copy that was kept has been freed
        del context.memo[name]
        return _read(context, name, problems, given, index, space)


def _found(context, name):
    """Return (evaluated curve object of a setting, or None if it is no curve, whether it was deleted)."""
    found = context.target(name)
    if found is None or found.type != 'CURVE':
        return None, False
    return found, deleted.is_deleted(found)


def _fixed(context):
    """Return (result of _reads(), whether the owner is mirrored, None if that may change without an edit of the settings, *_spaces())."""
    return _reads(context.settings), is_mirrored(context.owner) if is_constant(context.owner) else None, *_spaces(context.settings)


def _still(context, numbers, length):
    """Compute the values that stay constant until a setting changes, so that the result can be cached.

    Returns (Motion, keyword arguments of the native follow(), its keyword arguments for the places of the owner and its wagons, indices of
    mirrored objects). Returns a Problem if the settings have no meaning.
    """
    settings = context.settings
    if chosen(settings, "forward_axis")[-1] == chosen(settings, "up_axis")[-1]:
        return AXES_NOT_ACROSS
    if not (motion.is_finite(settings.influence) and np.isfinite(context.member_data).all()):
        return motion.NOT_FINITE
    by_time = chosen(settings, "gaps_by") == 'TIME'
    delays = -context.member_data if by_time else np.zeros(len(context.member_data))
    past = native.module.LAG_MEMORY if numbers["lag_rate"] > 0.0 else 0.0
    moving = motion.motion(context, numbers, length, past, tuple(delays[delays > 0.0].tolist()))
    if isinstance(moving, Problem):
        return moving
    wheelbases = np.maximum(_wheelbases(context, numbers), 0.0)
    if not (wheelbases < motion.INFINITE).all():
        return motion.NOT_FINITE
    corrections = np.array([moving.behind.get(delay, 0.0) for delay in delays.tolist()])
    members_at = {
        "offsets": (context.member_data + delays) + corrections + (numbers["offset"] + moving.offset),
        "delays": delays,
        "wheelbases": wheelbases,
        "start": moving.start,
    }
    return moving, follow_options(settings, numbers, None), members_at, _mirrored(context)


def _wheelbases(context, numbers):
    """Return the wheelbase of the owner and of each wagon. Owners that share a solver have no wagons."""
    count = len(context.member_data)
    found = [numbers["wheelbase"]] if count == 1 else members.wheelbases(context.owner)[:count]
    return np.array(found + [0.0] * (count - len(found)))


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
    if extend == 'LINE_UP' and chosen(settings, "gaps_by") == 'TIME':
        extend = 'CLAMP'  # who is where the leader was stops where the leader stops
    options = {
        "mode": 'minimal' if mode == 'NONE' else mode.lower(),
        "rotate": mode != 'NONE',
        "extend": 'extrapolate' if extend == 'LINE_UP' else extend.lower(),
        "line_up": extend == 'LINE_UP',
        "forward": axis_name(chosen(settings, "forward_axis")),
        "up": axis_name(chosen(settings, "up_axis")),
        "lag_rate": max(numbers["lag_rate"], 0.0),
        "lag_by": chosen(settings, "lag_by").lower(),
        "side": numbers["side"],
        "height": numbers["height"],
        "level": (mode == 'NONE' or chosen(settings, "side_by") == 'LEVEL') and bool(numbers["side"] or numbers["height"]),
    }
    return options | mode_options(settings, numbers, tilt)


def mode_options(settings, numbers, tilt, rail=None):
    """Keyword arguments that the chosen orientation mode needs in the native functions frames() and follow().

    tilt: array for the orientation Tilt. rail: native curve for the orientation Rail.
    """
    mode = chosen(settings, "orientation")
    if mode == 'TILT':
        return {"tilt": tilt}
    if mode == 'RAIL':
        return {"rail": rail, "rail_point": chosen(settings, "rail_by").lower(), "rail_side": chosen(settings, "rail_side").lower()}
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
