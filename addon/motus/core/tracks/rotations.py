"""Rotations as arrays: quaternions (n, 4; w, x, y, z) as Blender computes them from its rotation modes, and rotation matrices."""

import math

from mathutils import Matrix

from ..lazy import numpy as np


def unit(quaternions):
    """Quaternions (n, 4) scaled to length 1."""
    lengths = np.linalg.norm(quaternions, axis=1, keepdims=True)
    # Blender reads a quaternion of zeros as (0, 1, 0, 0).
    return np.where(lengths > 0.0, quaternions / np.where(lengths > 0.0, lengths, 1.0), (0.0, 1.0, 0.0, 0.0))


def from_axis_angle(values):
    """Unit quaternions (n, 4) from rows of an angle in radians and an axis of any length, (n, 4). An axis of length 0 gives no rotation."""
    lengths = np.linalg.norm(values[:, 1:], axis=1, keepdims=True)
    axes = values[:, 1:] / np.where(lengths > 0.0, lengths, 1.0)
    cosines, sines = _cosines_and_sines(0.5 * values[:, 0])
    return np.where(lengths > 0.0, np.column_stack((cosines, sines[:, None] * axes)), (1.0, 0.0, 0.0, 0.0))


def from_euler(angles, order):
    """Unit quaternions (n, 4) from Euler angles (n, 3) in radians.

    order: rotation mode such as 'XYZ'. The rotations are about the fixed axes, one after the other in the order of the letters.
    """
    found = None
    for letter in order:
        axis = "XYZ".index(letter)
        turn = np.zeros((len(angles), 4))
        turn[:, 0], turn[:, 1 + axis] = _cosines_and_sines(0.5 * angles[:, axis])
        found = turn if found is None else product(turn, found)
    return found


def _cosines_and_sines(angles):
    # np.cos and np.sin of NumPy 1.24 give one of two results for the same number, from call to call.
    listed = angles.tolist()
    return np.array(list(map(math.cos, listed))), np.array(list(map(math.sin, listed)))


def product(left, right):
    """Quaternions (n, 4) that rotate by `right` first and by `left` after that."""
    w, x, y, z = left.T
    a, b, c, d = right.T
    return np.stack(
        (w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c, w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a), axis=1
    )


def matrices(quaternions):
    """Rotation matrices (n, 3, 3), for column vectors, of unit quaternions (n, 4)."""
    w, x, y, z = quaternions.T
    rows = (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
        (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
    )
    return np.moveaxis(np.array(rows), -1, 0)


def chained(left, right):
    """Matrix products left @ right of arrays (n or 1, k, k).

    Computed without a linear algebra library, whose results depend in their last bits on where the arrays lie in memory.
    """
    return sum(left[:, :, index, None] * right[:, None, index, :] for index in range(left.shape[-1]))


def of_axes(rows):
    """Unit quaternions (n, 4) of the rotations in matrices (n, 3, 3), which may also scale and shear.

    The quaternion of a mirroring matrix is that of the negative matrix.
    """
    return np.array([Matrix(row).to_quaternion() for row in rows])


def mixed(lower, upper, parts):
    """Unit quaternions (n, 4) between `lower` and `upper`, (n, 4), along the shorter way, by normalized linear interpolation.

    parts: (n,) in [0, 1]; 0 gives `lower`, 1 gives `upper`.
    """
    upper = np.where((lower * upper).sum(axis=1, keepdims=True) < 0.0, -upper, upper)
    return unit(lower + parts[:, None] * (upper - lower))
