"""Lines that show the joint limits of a bone in the viewport: the border of its swing as a cone, and an arc of its twist.

A turn is split as the solver does it (native/include/motus/bones/chains/limited.hpp): a twist about the bone, then a swing, whose rotation
vector in the plane of X and Z stays within an ellipse, or within a band if one of the two axes is free.
"""

import itertools
import math
from typing import NamedTuple

from mathutils import Matrix, Quaternion, Vector

from .forward import in_pose

STEPS = 48  # lines of which a border is drawn
SIDES = 8  # lines from the joint to the border
TWIST_PLACE, TWIST_SIZE = 0.35, 0.2  # place along the bone and radius of a twist's arc, in lengths of the bone
Y, X = Vector((0.0, 1.0, 0.0)), Vector((1.0, 0.0, 0.0))


class Limits(NamedTuple):
    """Least and largest angles about X, Y and Z, in radians; infinite where the bone is free."""

    least: tuple
    most: tuple

    @property
    def are_any(self):
        """Whether any angle is limited."""
        return any(map(math.isfinite, (*self.least, *self.most)))


def limits_of(bone):
    """Limits of a pose bone for inverse kinematics, as reading.limits() reads those of all bones."""
    ends = {"min": [], "max": []}
    for letter in "xyz":
        is_locked, is_limited = getattr(bone, f"lock_ik_{letter}"), getattr(bone, f"use_ik_limit_{letter}")
        for end, free in (("min", -math.inf), ("max", math.inf)):
            ends[end].append(0.0 if is_locked else getattr(bone, f"ik_{end}_{letter}") if is_limited else free)
    return Limits(tuple(ends["min"]), tuple(ends["max"]))


def swing_border(limits):
    """Rotation vectors (x, z), in radians, along the border of a bone's swing: a list of lines, each a list of vectors; [] if it is free."""
    (low_x, _, low_z), (high_x, _, high_z) = limits
    is_free = [not (math.isfinite(low) and math.isfinite(high)) for low, high in ((low_x, high_x), (low_z, high_z))]
    if all(is_free):
        return []
    if any(is_free):
        return _rectangle((max(low_x, -math.pi), min(high_x, math.pi)), (max(low_z, -math.pi), min(high_z, math.pi)))
    turns = [math.tau * step / STEPS for step in range(STEPS + 1)]
    return [
        [
            ((high_x if math.cos(turn) > 0.0 else -low_x) * math.cos(turn), (high_z if math.sin(turn) > 0.0 else -low_z) * math.sin(turn))
            for turn in turns
        ]
    ]


def _rectangle(x, z):
    corners = [(x[0], z[0]), (x[1], z[0]), (x[1], z[1]), (x[0], z[1]), (x[0], z[0])]
    shares = [step / (STEPS // 4) for step in range(STEPS // 4)]
    line = [
        tuple(one + share * (other - one) for one, other in zip(start, end))
        for start, end in itertools.pairwise(corners)
        for share in shares
    ]
    return [[*line, corners[0]]]


def swung(x, z):
    """Quaternion of a swing by its rotation vector (x, z), in radians."""
    vector = Vector((x, 0.0, z))
    return Quaternion(vector, vector.length) if vector.length else Quaternion()


def lines(rig, name):
    """Pairs of world positions, one after another, of the lines that show the limits of a bone of an evaluated rig; [] without limits."""
    bone = rig.pose.bones[name]
    limits = limits_of(bone)
    if not limits.are_any:
        return []
    # The pose with the bone's own rotation taken out: there the angles are 0.
    above = bone.parent.matrix if bone.parent else None
    unturned = rig.matrix_world @ in_pose(bone.bone, Matrix(), above)
    axes = Matrix([column.normalized() for column in unturned.to_3x3().transposed()]).transposed()
    posed = rig.matrix_world @ bone.matrix
    place = posed.translation
    size = (rig.matrix_world @ bone.tail - place).length
    found = []
    for border in swing_border(limits):
        points = [place + size * (axes @ (swung(*vector) @ Y)) for vector in border]
        found += _joined(points)
        found += [end for point in points[: -1 : STEPS // SIDES] for end in (place, point)]
    return found + _twist(limits, axes, posed, place, size)


def _twist(limits, axes, posed, place, size):
    low, high = limits.least[1], limits.most[1]
    if not (math.isfinite(low) and math.isfinite(high)):
        return []
    turn = (axes.transposed() @ posed.to_3x3()).to_quaternion()
    twist = 2.0 * math.atan2(turn.y, turn.w)
    swing = turn @ Quaternion(Y, twist).inverted()
    middle = place + TWIST_PLACE * size * (axes @ (swing @ Y))

    def at(angle):
        return middle + TWIST_SIZE * size * (axes @ (swing @ (Quaternion(Y, angle) @ X)))

    arc = [at(low + (high - low) * step / STEPS) for step in range(STEPS + 1)]
    return [middle, arc[0], *_joined(arc), arc[-1], middle, middle, at(twist)]


def _joined(points):
    return [point for pair in itertools.pairwise(points) for point in pair]
