"""The wooden pilot's limbs: turned segments between ball joints, hands with fingers, and boots."""

import math

import numpy as np

from ..stage import shapes
from . import parts, skeleton

# Profiles of turned parts: (radius in m, place along the bone as a fraction of its length), from the bone's end to its start.
UPPER_ARM = (
    (0.003, 0.93),
    (0.024, 0.925),
    (0.033, 0.89),
    (0.037, 0.74),
    (0.046, 0.45),
    (0.048, 0.25),
    (0.038, 0.09),
    (0.003, 0.07),
)
FOREARM = (
    (0.003, 0.97),
    (0.020, 0.965),
    (0.025, 0.93),
    (0.030, 0.72),
    (0.042, 0.36),
    (0.043, 0.22),
    (0.034, 0.10),
    (0.003, 0.08),
)
THIGH = (
    (0.003, 0.935),
    (0.036, 0.93),
    (0.048, 0.90),
    (0.054, 0.72),
    (0.071, 0.36),
    (0.074, 0.20),
    (0.060, 0.07),
    (0.003, 0.05),
)
SHIN = (
    (0.003, 0.97),
    (0.030, 0.965),
    (0.034, 0.93),
    (0.041, 0.70),
    (0.055, 0.36),
    (0.054, 0.20),
    (0.042, 0.08),
    (0.003, 0.06),
)
CUFF = ((0.026, 0.86), (0.035, 0.83), (0.039, 0.77), (0.037, 0.71), (0.030, 0.68))
# Cross-sections of a boot from heel to toe: y, half width, half height, height of the middle; in m.
BOOT_SHAPE = (
    (0.064, 0.006, 0.014, 0.034),
    (0.056, 0.032, 0.040, 0.042),
    (0.024, 0.042, 0.056, 0.056),
    (-0.030, 0.044, 0.048, 0.048),
    (-0.085, 0.049, 0.037, 0.037),
    (-0.135, 0.052, 0.033, 0.033),
    (-0.178, 0.044, 0.029, 0.029),
    (-0.204, 0.008, 0.010, 0.022),
)
SOLE_HEIGHT = 0.013
# Of each finger: x across the knuckles (positive towards the thumb), y, length, radius; in m.
FINGERS = (
    (0.027, 0.086, 0.077, 0.0100),
    (0.009, 0.088, 0.083, 0.0105),
    (-0.009, 0.086, 0.078, 0.0100),
    (-0.026, 0.080, 0.064, 0.0090),
)
CURL = (math.radians(10.0), math.radians(34.0))  # of a finger's two halves at rest, towards the palm


def add(body, side):
    """Add arm, hand, leg and boot of one side, "L" or "R", to the pilot's body."""
    _add_arm(body, side)
    _add_hand(body, side)
    _add_leg(body, side)


def _add_arm(body, side):
    upper, lower = f"upper_arm.{side}", f"forearm.{side}"
    body.add_local(parts.ball(0.052), upper, parts.DARK)
    body.add_local(parts.along(upper, UPPER_ARM), upper, parts.WOOD)
    body.add_local(parts.ball(0.036), lower, parts.DARK)
    body.add_local(parts.along(lower, FOREARM), lower, parts.WOOD)
    body.add_local(parts.along(lower, CUFF, 16), lower, parts.SCARF)


def _add_leg(body, side):
    thigh, shin, foot = (f"{name}.{side}" for name in ("thigh", "shin", "foot"))
    body.add_local(parts.ball(0.068), thigh, parts.DARK)
    body.add_local(parts.along(thigh, THIGH), thigh, parts.CREAM)
    body.add_local(parts.ball(0.047), shin, parts.DARK)
    body.add_local(parts.along(shin, SHIN), shin, parts.WOOD)
    body.add_local(parts.ball(0.036), shin, parts.DARK)
    x = skeleton.JOINTS[foot].head[0]
    _add_boot(body, side, x)
    body.add(shapes.upright(shapes.torus(0.040, 0.014, 32, 12), (x, 0.020, 0.098)), foot, parts.CREAM)


def _add_boot(body, side, x, rows=40, points=40):
    """Add a boot with a flat dark sole; its toes are moved by the toe bone."""
    profile = shapes.smooth_profile(BOOT_SHAPE, rows)
    angle = shapes.ring(points)
    y, width, tall, middle = (profile[:, i : i + 1] for i in range(4))
    across = np.sign(np.cos(angle)) * np.abs(np.cos(angle)) ** 0.8
    upward = np.sign(np.sin(angle)) * np.abs(np.sin(angle)) ** 0.8
    height = np.maximum(middle + tall * upward, 0.0)
    part = shapes.loft(np.stack((x + width * across, np.broadcast_to(y, (rows, points)), height), axis=-1))
    low = height[:-1, :] + np.roll(height, -1, axis=1)[:-1, :] < 2.0 * SOLE_HEIGHT
    low &= width[:-1] > 0.03  # the tip of the toes has no sole, because it turns up
    ball = skeleton.JOINTS[f"toe.{side}"].head[1]
    bones = [f"{'toe' if vertex[1] < ball else 'foot'}.{side}" for vertex in part[0]]
    body.add(part, bones, np.where(low, parts.DARK, parts.BOOT).ravel())


def _add_hand(body, side):
    """Add a palm, four fingers of two halves each, and a thumb. The thumb is at the hand bone's +X on the left, at its -X on the right."""
    hand, thumbward = f"hand.{side}", 1.0 if side == "L" else -1.0
    body.add_local(parts.ball(0.024), hand, parts.DARK)
    body.add_local(shapes.sphere(1.0, (0.0, 0.052, 0.0), (0.042, 0.050, 0.017), 28, 18), hand, parts.WOOD)
    for index, (x, y, length, thickness) in enumerate(FINGERS):
        bone = f"index.{side}" if index == 0 else f"fingers.{side}"
        line = _finger_line(np.array((x * thumbward, y, 0.0)), length)
        body.add(_in_armature(parts.capsule(line, thickness), hand), bone, parts.WOOD)
    start = np.array((0.030 * thumbward, 0.026, -0.004))
    bend = start + 0.042 * _unit((0.62 * thumbward, 0.72, -0.30))
    end = bend + 0.032 * _unit((0.25 * thumbward, 0.92, -0.30))
    body.add(_in_armature(parts.capsule(np.array((start, bend, end)), 0.0125), hand), hand, parts.WOOD)


def _finger_line(start, length):
    line = [start]
    for curl, share in zip(CURL, (0.54, 0.46)):
        line.append(line[-1] + share * length * np.array((0.0, math.cos(curl), -math.sin(curl))))
    return np.array(line)


def index_tip(side, turn):
    """Return the position of the index finger's tip in the armature's space, if its bone is turned about X by `turn` and all else rests."""
    x, y, length, thickness = FINGERS[0]
    line = _finger_line(np.array((x if side == "L" else -x, y, 0.0)), length)
    tip = line[-1] + thickness * _unit(line[-1] - line[-2])
    rest = skeleton.frame(f"index.{side}")
    x, y, z, _ = np.linalg.inv(rest) @ skeleton.frame(f"hand.{side}") @ (*tip, 1.0)
    cos, sin = math.cos(turn), math.sin(turn)
    return (rest @ (x, y * cos - z * sin, y * sin + z * cos, 1.0))[:3]


def _in_armature(part, bone):
    matrix = skeleton.frame(bone)
    return part[0] @ matrix[:3, :3].T + matrix[:3, 3], part[1]


def _unit(vector):
    vector = np.asarray(vector, dtype=float)
    return vector / np.linalg.norm(vector)
