"""Viewport overlay of a path: draws the exact curve coloured by speed, the control polygon, tangents, and orientation axes."""

import math

from ..core import native
from ..core.declare import Context, Problem
from ..core.file.choices import chosen
from ..core.file.pointers import pointed
from ..core.interface.overlay import Batch, Overlay, Switch
from ..core.lazy import numpy as np
from ..core.measures import axes, scene_time
from . import curves, members, motion, solve, targets

STEPS_PER_SEGMENT = 48
LARGEST_STEPS = 4096
WHISKERS = 24
WHISKER_SHARE = 0.025  # length of the drawn axes (whiskers), as a share of the path's length
SPEED_SAMPLES = 400
CURVE_WIDTH = 3.0  # pixels
EVEN = 0.01  # least relative variation of speed that is coloured; below it the curve has its own colour

SLOW, MIDDLE, FAST = (0.15, 0.55, 0.95), (0.98, 0.80, 0.25), (0.95, 0.25, 0.30)
CURVE_COLOR = (0.98, 0.80, 0.25, 0.9)
POLYGON_COLOR = (0.75, 0.75, 0.80, 0.45)
POINT_COLOR = (0.95, 0.95, 1.0, 0.9)
TANGENT_COLOR = (0.95, 0.85, 0.60, 0.9)
RAIL_COLOR = (0.75, 0.55, 0.95, 0.9)
BOGIE_COLOR = (0.35, 0.95, 0.55, 0.9)
UP_COLOR = (0.30, 0.55, 1.0, 0.9)
RIGHT_COLOR = (0.95, 0.30, 0.35, 0.9)


def _batches(context, owner):
    """Return the drawing batches for a follower, a wagon, a followed curve or a Motus Bézier curve; [] for all other objects."""
    depsgraph = context.evaluated_depsgraph_get()
    leader = pointed(owner.motus.path, "leader") or owner
    if leader.motus.path.is_active and pointed(leader.motus.path, "curve"):
        return _of_follower(context.scene, leader.evaluated_get(depsgraph), depsgraph)
    if owner.type == 'CURVE':
        follower = next(iter(targets.followers_of(owner)), None)
        if follower:
            return _of_follower(context.scene, follower.evaluated_get(depsgraph), depsgraph)
        if curves.CONTROL_POLYGON_KEY in owner.data:
            return _of_curve(context.scene.motus, owner.evaluated_get(depsgraph), depsgraph)
    return []


def _of_curve(shown, curve_object, depsgraph):
    try:
        path = curves.read_evaluated(curve_object, depsgraph, curves.ALL_SPLINES)
    except curves.Unreadable:
        return []
    return _curve_batches(shown, path.curve, None)


def _of_follower(scene, owner, depsgraph):
    settings = owner.motus.path
    try:
        path = curves.read_evaluated(pointed(settings, "curve").evaluated_get(depsgraph), depsgraph, settings.spline)
        rail = _rail(settings, depsgraph)
    except curves.Unreadable:
        return []
    numbers = {name: getattr(settings, name) for name in solve.NUMBERS}
    last = Context(settings, owner, scene_time.last(scene), depsgraph, None, None)
    moving = motion.motion(last, numbers, path.curve.length(), past=math.inf)
    if path.curve.length() == 0.0 or moving == motion.NOT_FINITE:
        return []
    speeds = _speed_profile(settings, moving, path.curve.length())
    found = _curve_batches(scene.motus, path.curve, speeds if scene.motus.show_speed else None)
    distances = np.linspace(0.0, path.curve.length(), WHISKERS + 1)
    size = WHISKER_SHARE * path.curve.length()
    if scene.motus.show_tangents:
        tangents = path.curve.tangent(path.curve.t_at_length(distances))
        found.append(_whiskers(path.curve, distances, tangents, size, TANGENT_COLOR))
    if rail and scene.motus.show_curve:
        found.append(Batch('LINES', _pairs(rail.position(_parameters(rail).ravel()).reshape(*_parameters(rail).shape, 3)), RAIL_COLOR, 1.5))
    if scene.motus.show_frames and chosen(settings, "orientation") not in ({'NONE'} if rail else {'NONE', 'RAIL'}):
        space = (
            solve.space_of(pointed(settings, "curve").evaluated_get(depsgraph).matrix_world)
            if chosen(settings, "space") == 'PATH'
            else None
        )
        found += _frames(path, rail, space, settings, numbers, distances, speeds, size)
    if scene.motus.show_bogies:
        found += _bogies(owner, depsgraph)
    return found


def _rail(settings, depsgraph):
    """The native curve of the follower's rail, in world space; None if the orientation reads none. Raises Unreadable."""
    rail = pointed(settings, "rail") if chosen(settings, "orientation") == 'RAIL' else None
    if rail is None or rail.type != 'CURVE':
        return None
    return curves.read_evaluated(rail.evaluated_get(depsgraph), depsgraph, settings.rail_spline).curve


def _bogies(owner, depsgraph):
    """Batches of the lines between the two bogies of each member that has a wheelbase."""
    settings = owner.motus.path
    if chosen(settings, "orientation") == 'NONE':
        return []
    forward = np.array(axes.vector(chosen(settings, "forward_axis")))
    found = []
    for member, wheelbase in zip(members.members(owner.original), members.wheelbases(owner.original)):
        if wheelbase > 0.0:
            matrix = np.array(member.evaluated_get(depsgraph).matrix_world)
            along = matrix[:3, :3] @ forward
            half = 0.5 * wheelbase * along / max(np.linalg.norm(along), 1e-12)
            found.append((matrix[:3, 3] - half, matrix[:3, 3] + half))
    if not found:
        return []
    strips = np.array(found)
    return [Batch('LINES', _pairs(strips), BOGIE_COLOR, 2.0), Batch('POINTS', strips.reshape(-1, 3).astype(np.float32), BOGIE_COLOR, 8.0)]


def _curve_batches(shown, curve, speeds):
    found = []
    points = curve.control_points.reshape(-1, curve.degree + 1, 3)
    if shown.show_control_points and curve.degree > 1:
        found.append(Batch('LINES', _pairs(points), POLYGON_COLOR))
        found.append(Batch('POINTS', points.reshape(-1, 3).astype(np.float32), POINT_COLOR, 6.0))
    if shown.show_curve:
        parameters = _parameters(curve)
        lines = _pairs(curve.position(parameters.ravel()).reshape(*parameters.shape, 3))
        if speeds is None or np.ptp(np.abs(speeds[1])) <= EVEN * np.abs(speeds[1]).max():
            found.append(Batch('LINES', lines, CURVE_COLOR, CURVE_WIDTH))
        else:
            speed = np.interp(curve.length_at(parameters.ravel()), *speeds).reshape(parameters.shape)
            colors = _speed_colors(speed, max(abs(speeds[1]).max(), 1e-9))
            found.append(Batch('LINES', lines, _pairs(colors), CURVE_WIDTH))
    return found


def _parameters(curve):
    """Return the parameters (segments, steps) at which a native curve is sampled for drawing.

    The last parameter of each segment lies just before the segment's end, since the next segment may begin at a different place.
    """
    count = curve.segment_count
    steps = max(2, min(STEPS_PER_SEGMENT, LARGEST_STEPS // count))
    if curve.degree == 1:
        steps = 2
    inside = np.linspace(0.0, 1.0 - 1e-9, steps)
    return np.add.outer(np.arange(count), inside)


def _pairs(strips):
    """Convert k strips of m points, (k, m, d), into an array of line segments: two consecutive rows for each segment."""
    pairs = np.stack((strips[:, :-1], strips[:, 1:]), axis=2)
    return np.ascontiguousarray(pairs.reshape(-1, strips.shape[-1]), dtype=np.float32)


def _speed_colors(speed, highest):
    stops = np.array([SLOW, MIDDLE, FAST])
    share = np.abs(speed) / highest
    colors = np.ones((*share.shape, 4))
    for channel in range(3):
        colors[..., channel] = np.interp(share, (0.0, 0.5, 1.0), stops[:, channel])
    return colors


def _speed_profile(settings, moving, length):
    """Arrays (distances, speeds) along the path until the end of the follower's motion, sorted by distance.

    moving: the follower's Motion, or a Problem, for which the speeds are 0. length: length of the path.
    """
    if isinstance(moving, Problem):
        return np.array([0.0, length]), np.zeros(2)
    times = np.linspace(min(0.0, moving.time), moving.time, SPEED_SAMPLES)
    if settings.timing == 'DURATION':
        times = np.linspace(0.0, settings.duration, SPEED_SAMPLES)
    distances = moving.timing.distance(times) + moving.offset
    speeds = moving.timing.speed(times)
    order = np.argsort(distances, kind='stable')
    return distances[order], speeds[order]


def _frames(path, rail, space, settings, numbers, distances, speeds, size):
    into = np.eye(4) if space is None else np.array(space.inverted())
    options = solve.mode_options(settings, numbers, path.tilt, rail and rail.transformed(into))
    if settings.orientation == 'BANKING':
        options["speed"] = np.interp(distances, *speeds)
    quaternions = native.module.frames(path.curve.transformed(into), distances, chosen(settings, "orientation").lower(), **options)
    w, x, y, z = quaternions.T
    right = np.column_stack((1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)))
    up = np.column_stack((2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)))
    up, right = up @ into[:3, :3], right @ into[:3, :3]  # the transposed inverse of a rotation is the rotation
    return [_whiskers(path.curve, distances, up, size, UP_COLOR), _whiskers(path.curve, distances, right, 0.6 * size, RIGHT_COLOR)]


def _whiskers(curve, distances, directions, size, color):
    start = curve.position_at_length(distances)
    strips = np.stack((start, start + size * directions), axis=1)
    return Batch('LINES', _pairs(strips), color, 1.5)


overlay = Overlay(
    _batches,
    (
        Switch("show_curve", "Curve", "Draw the curve that is followed"),
        Switch("show_control_points", "Control Points", "Draw the points of the curve, with the lines between them"),
        Switch("show_tangents", "Tangents", "Draw the direction of travel at equal distances along the path", default=False),
        Switch("show_frames", "Path Frames", "Draw at equal distances along the path which way is ahead, to the right and up"),
        Switch("show_bogies", "Bogies", "Draw the points of the path that carry wagons"),
        Switch("show_speed", "Speed", "Colour the curve by the follower's speed"),
    ),
)
