"""Solve pendulums: read the settings from Blender and look the motion up in the native tables."""

import functools
import math
from collections.abc import Callable
from typing import NamedTuple

from ..core import native
from ..core.declare import OwnMatrix, Problem, Setting, registered
from ..core.evaluated.shares import share_of, waits_for_all
from ..core.file import deleted
from ..core.file.stored import Damaged
from ..core.measures import bounds
from ..core.refusals import INFINITE
from . import clock, directions, parts, pivot_motion

NO_RODS = Problem("There are no rods: they are another pivot's, or were deleted", False)
PIVOT_DELETED = Problem("The pivot is in no collection any more: the rods hang as they are placed")
NOT_FINITE = Problem("A setting is not a finite number")
NO_LENGTH = Problem("The lengths must be greater than 0")
NO_MASS = Problem("The masses must be greater than 0")
NO_LIMIT = Problem("The limits must be greater than 0")
NO_FAN = Problem("A fan has 1 to 500 pendulums")
TOO_FAR = Problem("The motion is not known so far from its start: start it later, or let it run more slowly, or without damping")
FAN_TOO_FAR = Problem(
    "The motion of so many pendulums is not known so far from its start: start it later, let it run more slowly, or take fewer"
)
TOO_EXTREME = Problem("A length, mass, angle, velocity, gravity or damping is too large or too small for the motion to be computed")
TABLE = 200_000.0
"""Price of the native module's longest table of one pendulum's motion: about the microseconds that it takes (core/measures/bounds.py)."""
FARTHEST = 25_000.0
"""Time up to which the native module has the motion of a damped or spherical pendulum, as a multiple of the square root of length / gravity."""
NEAR = 60.0
"""Seconds since the start within which the motion is unknown only if the settings have extreme values."""
PROBLEMS = (
    NO_RODS,
    PIVOT_DELETED,
    NOT_FINITE,
    NO_LENGTH,
    NO_MASS,
    NO_LIMIT,
    TOO_FAR,
    clock.UNKNOWN,
    pivot_motion.UNKNOWN,
    pivot_motion.NOT_STEADY,
    TOO_EXTREME,
    NO_FAN,
    FAN_TOO_FAR,
)

NUMBERS = (
    "length1",
    "length2",
    "mass1",
    "mass2",
    "angle1",
    "angle2",
    "heading",
    "angle_step",
    "velocity1",
    "velocity2",
    "velocity_sideways",
    "gravity",
    "damping",
    "most_velocity",
    "most_acceleration",
    "start_frame",
    "speed",
    "influence",
)
INPUTS = (OwnMatrix("pivot", when="use_pivot_motion"), Setting("influence"))

OUTPUTS = ("angle1", "angle2", "velocity1", "velocity2", "seconds")


class Swing(NamedTuple):
    """Motion of a pendulum or fan of pendulums, which gives the states at any time.

    A state is [angle1, velocity1], [angle1, angle2, velocity1, velocity2], or that of a spherical pendulum (directions.py).
    at(seconds, **pivot): list of the states of all pendulums at one time.
    way(times, number=0, **pivot): states of one pendulum at times (n,), one row for each time.
    pivot: keywords from pivot_motion.felt(). each: rods of one pendulum. count: number of pendulums. Both functions raise ValueError
    if the motion is not known at a time. farthest: seconds up to which the native module has the motion of one pendulum; infinite if the
    motion is a formula, which takes no longer at a later time. is_spherical: whether it swings to all sides.
    """

    each: int
    at: Callable
    way: Callable
    count: int = 1  # type: ignore[assignment]  # a tuple has a method of this name
    farthest: float = math.inf
    is_spherical: bool = False

    def has_rods(self, numbers):
        """Whether the pendulum or fan has rods with all of these numbers. numbers: as parts.numbers() returns them."""
        return min(numbers) >= 0 and max(numbers) < self.each * self.count

    def takes_too_long(self, seconds, pivot, depsgraph):
        """Whether a viewport would have to wait too long for the states at a time, if nothing of the motion is computed yet.

        pivot: object that has the settings of the pendulum. A render waits for all pendulums.
        """
        if waits_for_all(depsgraph) or math.isinf(self.farthest):
            return False
        price = TABLE * self.count * min(1.0, abs(seconds) / self.farthest)
        return price > bounds.AT_ONCE * share_of(registered["pendulum"], pivot, depsgraph)


def solve(context, pivot, influence):
    """Fill the context's arrays with the rotations that the swing adds to the rods at the context's frame.

    pivot: world matrix of the pivot, or None if its motion does not count. influence: share of the swing, from 0 to 1.
    Returns a Problem or None. A user's error never raises an exception.
    """
    settings = context.settings
    if context.kept("deleted", deleted.changes(), lambda: deleted.is_deleted(context.owner)):
        return PIVOT_DELETED
    scene = context.depsgraph.scene
    swing = context.kept("swing", gravity_of(settings, scene), lambda: swing_of(settings, scene))
    if swing.__class__ is Problem:
        return swing
    if context.memo is not None:
        start, rate = context.kept("clock", None, lambda: clock.steady(settings))
        now = clock.Clock((context.frame - start) / context.fps * rate if context.frame > start else 0.0, rate)
    else:
        now = clock.read(context.owner, settings, context.frame, context.fps)
    problem, felt = now.problem, {}
    if pivot is not None:
        felt, problem = pivot_motion.felt(context.owner, scene, now.rate, swing.is_spherical)
    if not abs(now.seconds) < INFINITE:
        return NOT_FINITE
    if swing.takes_too_long(now.seconds, context.owner, context.depsgraph):
        return FAN_TOO_FAR
    try:
        rows = swing.at(now.seconds, **felt)
    except ValueError:
        return unknown(now.seconds, swing.count)
    first, told = rows[0], context.outputs
    # One by one, since NumPy would first make an array of a tuple.
    if swing.is_spherical:
        told[0], told[1], told[2], told[3] = directions.angles(first)
    else:
        told[0], told[1], told[2], told[3] = first[0], first[swing.each - 1], first[swing.each], first[-1]
    told[4] = now.seconds
    rods = context.member_data.tolist()
    if not rods:
        return NO_RODS
    numbers = context.kept("rods", rods, lambda: _rods(swing, rods))
    if swing.is_spherical:
        context.rotations[:] = directions.turn(first[:3], influence)
        return problem
    turns = [_turn(rows, number, swing, influence) for number in numbers]
    if not turns[1:]:  # NumPy takes longer for a list of lists
        context.rotations[0, 0], context.rotations[0, 2] = turns[0]
    else:
        context.rotations[:, 0::2] = turns
    return problem


def _rods(swing, rods):
    """Return the numbers of the rods as integers. Raises Damaged if the pendulum or fan has no such rods."""
    numbers = [int(number) for number in rods]
    if not swing.has_rods(numbers):
        raise Damaged("no such rod")
    return numbers


def _turn(rows, number, swing, influence):
    """Return (w, y) of the quaternion that turns a rod relative to the rod above it. rows: states of all pendulums. number: of the rod."""
    fan, rod = divmod(number, swing.each)
    angle = rows[fan][rod] - (rows[fan][0] if rod else 0.0)
    # A positive turn about the pivot's Y axis swings to -X. The math module is used because NumPy's sine is not always the same to the last bit.
    half = -0.5 * influence * angle
    return math.cos(half), math.sin(half)


def unknown(seconds, count=1):
    """Return the Problem to report if the native module cannot compute the motion at a time. count: number of pendulums of the fan."""
    if abs(seconds) < NEAR:
        return TOO_EXTREME
    return TOO_FAR if count == 1 else FAN_TOO_FAR


def gravity_of(settings, scene):
    """Return the acceleration of gravity along the pivot's -Z axis, in m/s^2: the scene's or the pendulum's own."""
    if settings.use_scene_gravity:
        return scene.gravity.length if scene.use_gravity else 0.0
    return settings.gravity


def swing_of(settings, scene):
    """Make the Swing, the native model of the pendulum or fan with these settings; a Problem if the settings are invalid."""
    if not all(abs(getattr(settings, name)) < INFINITE for name in NUMBERS):
        return NOT_FINITE
    if not all(length > 0.0 for length in parts.lengths(settings)):
        return NO_LENGTH
    gravity, damping = max(gravity_of(settings, scene), 0.0), max(settings.damping, 0.0)
    farthest = FARTHEST * math.sqrt(settings.length1 / gravity) if gravity > 0.0 else math.inf
    if settings.kind == 'SPHERICAL':
        spherical = native.module.spherical_pendulum
        start = settings.angle1, settings.heading, settings.velocity1, settings.velocity_sideways, settings.length1, gravity, damping
        return Swing(
            1,
            lambda seconds, **felt: [spherical(seconds, *start, **felt).tolist()],
            lambda times, number=0, **felt: spherical(times, *start, **felt),
            farthest=farthest,
            is_spherical=True,
        )
    if settings.kind == 'SINGLE':
        single = native.module.single_pendulum
        known = settings.angle1, settings.velocity1, settings.length1, gravity, damping
        return Swing(
            1,
            lambda seconds, **felt: [single(seconds, *known, **felt).tolist()],
            lambda times, number=0, **felt: single(times, *known, **felt),
            farthest=farthest if damping > 0.0 else math.inf,
        )
    if not (settings.mass1 > 0.0 and settings.mass2 > 0.0):
        return NO_MASS
    if not 1 <= settings.count <= parts.LARGEST_FAN:
        return NO_FAN
    constants = {
        "mass1": settings.mass1,
        "mass2": settings.mass2,
        "length1": settings.length1,
        "length2": settings.length2,
        "gravity": gravity,
        "damping": damping,
    }
    if settings.use_limits:
        for name in ("most_velocity", "most_acceleration"):
            if not getattr(settings, name) > 0.0:
                return NO_LIMIT
            constants[name] = getattr(settings, name)
    starts = [
        (settings.angle1, settings.angle2 + index * settings.angle_step, settings.velocity1, settings.velocity2)
        for index in range(settings.count)
    ]

    def way(times, number=0, **felt):
        return native.module.double_pendulum(times, *starts[number], **constants, **felt)

    return Swing(2, functools.partial(_fan, starts=starts, constants=constants), way, settings.count, _farthest(starts[0], constants))


def _farthest(start, constants):
    """Seconds up to which the native module has the motion of a double pendulum; infinite if its numbers are refused anyway."""
    names = "mass1", "mass2", "length1", "length2", "gravity"
    try:
        return native.module.double_pendulum_longest_time(*start, **{name: constants[name] for name in names})
    except ValueError:
        return math.inf


def _fan(seconds, starts, constants, **felt):
    if len(starts) == 1:
        return [native.module.double_pendulum(seconds, *starts[0], **constants, **felt).tolist()]
    return native.module.double_pendulums(seconds, starts, **constants, **felt).tolist()
