"""The pilot's steps in the main scene: his path, and where each foot stands, so that no foot slides.

Times are frames of the scene. Places are metres on the path: `ahead` from its start, and `high` above it. The armature faces -Y, and
the path leads along -Y.
"""

import math
from bisect import bisect_right
from typing import NamedTuple

from mathutils import Matrix

from ...core.blender import actions
from ..character import clips, skeleton
from ..stage.keying import key

STRIDE = clips.STRIDE
PACE = 2.0 * clips.STEP[0][1] / (STRIDE / 2)  # m per frame, the speed for which the legs of the walk action are made
WALK_END, REST = 73, 85  # frame after three seconds of walking, and frame at which the pilot stands still
WALK_START = 1.0 - STRIDE / 2  # first frame of the walk action; the right foot comes down on the first and the last frame of the walk
LENGTH = PACE * (WALK_END - 1)
STAND = LENGTH + 0.5 * PACE * (REST - WALK_END)  # m ahead at which the pilot comes to rest
CONTACTS = {"R": (-23, 1, 25, 49, 73), "L": (-11, 13, 37, 61, 88)}  # frames at which each foot comes down
CONTACT_AHEAD = 0.225  # m by which a flat foot is ahead of the pilot when it comes down
LAST_AHEAD = {"R": -0.02, "L": 0.055}  # m by which each foot is ahead of the pilot at rest
ASIDE, LAST_ASIDE, TURNED_OUT = 0.088, {"R": 0.088, "L": 0.112}, math.radians(7.0)
HEEL, BALL = (-0.036, 0.0), (0.125, 0.030)  # points over which a foot rolls: m ahead of the ankle, and m above the ground
ANKLE = 0.090  # height of the ankle of a flat foot, m
# Frames after a foot has come down, and the angle of its sole in degrees, positive if the toes point up: it rolls over heel and ball.
ROLL = ((0.0, 15.0), (2.5, 0.0), (8.0, 0.0), (11.0, -14.0), (14.0, -40.0))
# Motion of a foot through the air: share of the time, share of the distance, m above the straight line, degrees of the sole.
SWING = ((0.0, 0.0, 0.0, -40.0), (0.18, 0.07, 0.055, -48.0), (0.5, 0.52, 0.065, -16.0), (0.8, 0.88, 0.030, 11.0), (1.0, 1.0, 0.0, 15.0))
LAST_SWING = ((0.0, 0.0, 0.0, -40.0), (0.2, 0.12, 0.050, -42.0), (0.55, 0.62, 0.060, -12.0), (0.85, 0.96, 0.020, 3.0), (1.0, 1.0, 0.0, 0.0))
FLAT, LIFTED = ROLL[2][0], ROLL[-1][0]


def key_way(stage):
    """Key the pilot's motion along the path: even speed, then slowing down to a stop. stage: empty that carries the pilot."""
    key(stage, "location", ((1, 0.0), (WALK_END, -LENGTH), (REST, -STAND)), 1)
    curve = next(curve for curve in actions.fcurves(stage) if curve.data_path == "location" and curve.array_index == 1)
    first, slower, last = curve.keyframe_points
    first.interpolation = 'LINEAR'
    for point in (slower, last):
        point.handle_left_type = point.handle_right_type = 'FREE'
    third = (REST - WALK_END) / 3.0  # a cubic with the slopes of the walking speed and 0 at its ends slows down evenly
    slower.handle_right = slower.co.x + third, slower.co.y - third * PACE
    last.handle_left = last.co.x - third, last.co.y
    last.handle_right = last.co.x + third, last.co.y
    curve.update()


def key_feet(targets, rig):
    """Key the place of each foot at every frame, and its toes, which stay flat while the heel rises.

    targets: {side: empty that the foot follows}.
    """
    for side, target in targets.items():
        target.rotation_mode = 'QUATERNION'
        toe = rig.pose.bones[f"toe.{side}"]
        for frame in range(1, CONTACTS["L"][-1] + 1):
            step = foot(side, frame)
            target.matrix_basis = _matrix(side, step)
            for name in ("location", "rotation_quaternion"):
                target.keyframe_insert(name, frame=frame)
            toe.rotation_euler.x = math.radians(step.toe)
            toe.keyframe_insert("rotation_euler", index=0, frame=frame)
        for curve in actions.fcurves(target):
            for point in curve.keyframe_points:
                point.interpolation = 'LINEAR'


class Step(NamedTuple):
    """Place of a foot's ankle on the path in m, and angles by which sole and toes point up, in degrees."""

    left: float  # m to the left of the middle of the path
    ahead: float
    high: float
    sole: float
    toe: float


def foot(side, frame):
    """Return the Step of a foot at a frame. side: "L" or "R"."""
    contacts = CONTACTS[side]
    number = bisect_right(contacts, frame) - 1
    since = frame - contacts[number]
    is_last = number == len(contacts) - 1
    if is_last or since <= LIFTED:
        return _standing(side, number, min(since, FLAT) if is_last else since)
    start, end = _standing(side, number, LIFTED), _standing(side, number + 1, 0.0)
    share = (since - LIFTED) / (contacts[number + 1] - contacts[number] - LIFTED)
    way, lift, sole = _smooth(LAST_SWING if _closes(side, number + 1) else SWING, share)
    left, ahead, high = (one + way * (other - one) for one, other in zip(start[:3], end[:3]))
    return Step(left, ahead, high + lift, sole, start.toe * max(0.0, 1.0 - 2.5 * share))


def _standing(side, number, since):
    """Return the Step of a foot on the ground, which rolls over its heel and then over its ball.

    side: "L" or "R". number: of the foot's contact with the ground. since: frames after that contact.
    """
    is_last = number == len(CONTACTS[side]) - 1
    sole = 0.0 if _closes(side, number) else _smooth(ROLL, since)[0]
    pivot, turn = HEEL if sole > 0.0 else BALL, math.radians(sole)
    along, up = -pivot[0], ANKLE - pivot[1]
    rolled = pivot[0] + along * math.cos(turn) - up * math.sin(turn)
    sign = 1.0 if side == "L" else -1.0
    flat = STAND + LAST_AHEAD[side] if is_last else PACE * (CONTACTS[side][number] - 1) + CONTACT_AHEAD
    return Step(
        left=sign * ((LAST_ASIDE[side] if is_last else ASIDE) + rolled * math.sin(TURNED_OUT)),
        ahead=flat + rolled * math.cos(TURNED_OUT),
        high=pivot[1] + along * math.sin(turn) + up * math.cos(turn),
        sole=sole,
        toe=max(-sole, 0.0),
    )


def _closes(side, number):
    """Whether a contact is the last one, at which the left foot comes down flat beside the right foot. number: of the contact."""
    return side == "L" and number == len(CONTACTS[side]) - 1


def _matrix(side, step):
    """Return the matrix of a foot's bone in the space of the path, for a Step."""
    turn = Matrix.Rotation(TURNED_OUT if side == "L" else -TURNED_OUT, 4, 'Z') @ Matrix.Rotation(-math.radians(step.sole), 4, 'X')
    rest = skeleton.rest_matrix(f"foot.{side}").to_3x3().to_4x4()
    return Matrix.Translation((step.left, -step.ahead, step.high)) @ turn @ rest


def _smooth(rows, place):
    """Interpolate rows (place, value, ...) at a place with cubic Hermite splines; constant before the first and after the last row."""
    places = [row[0] for row in rows]
    if place <= places[0]:
        return rows[0][1:]
    if place >= places[-1]:
        return rows[-1][1:]
    index = bisect_right(places, place) - 1
    width = places[index + 1] - places[index]
    u = (place - places[index]) / width
    weights = (2 * u**3 - 3 * u**2 + 1, u**3 - 2 * u**2 + u, 3 * u**2 - 2 * u**3, u**3 - u**2)
    found = []
    for column in range(1, len(rows[0])):
        (start, rise), (end, other) = (_slope(rows, at, column) for at in (index, index + 1))
        found.append(weights[0] * start + weights[1] * width * rise + weights[2] * end + weights[3] * width * other)
    return found


def _slope(rows, at, column):
    """Return (value, slope) of the row with index `at`; the slope is 0 at the ends and at extremes, so that nothing overshoots."""
    value = rows[at][column]
    if at in (0, len(rows) - 1):
        return value, 0.0
    before, after = (rows[one][column] for one in (at - 1, at + 1))
    if (after - value) * (value - before) <= 0.0:
        return value, 0.0
    return value, (after - before) / (rows[at + 1][0] - rows[at - 1][0])
