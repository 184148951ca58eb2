"""Rotations over time as arrays: quaternions (n, 4; w, x, y, z), as Blender makes them of its rotation modes; and matrices."""

import math

from mathutils import Matrix

from ..lazy import numpy as np


def unit(quaternions):
    """Quaternions (n, 4) of length 1."""
    lengths = np.linalg.norm(quaternions, axis=1, keepdims=True)
    # What Blender makes of a quaternion of zeros.
    return np.where(lengths > 0.0, quaternions / np.where(lengths > 0.0, lengths, 1.0), (0.0, 1.0, 0.0, 0.0))


def from_axis_angle(values):
    """Quaternions of (n, 4): an angle, and an axis of any length."""
    lengths = np.linalg.norm(values[:, 1:], axis=1, keepdims=True)
    axes = values[:, 1:] / np.where(lengths > 0.0, lengths, 1.0)
    cosines, sines = _cosines_and_sines(0.5 * values[:, 0])
    return np.where(lengths > 0.0, np.column_stack((cosines, sines[:, None] * axes)), (1.0, 0.0, 0.0, 0.0))


def from_euler(angles, order):
    """Quaternions of turns about the fixed axes, one after the other in the order of the letters; angles: (n, 3)."""
    found = None
    for letter in order:
        axis = "XYZ".index(letter)
        turn = np.zeros((len(angles), 4))
        turn[:, 0], turn[:, 1 + axis] = _cosines_and_sines(0.5 * angles[:, axis])
        found = turn if found is None else product(turn, found)
    return found


def _cosines_and_sines(angles):
    # NumPy's own (1.24) give one of two results for the same number, from call to call.
    listed = angles.tolist()
    return np.array(list(map(math.cos, listed))), np.array(list(map(math.sin, listed)))


def product(left, right):
    """Quaternions of the right turn and then the left one."""
    w, x, y, z = left.T
    a, b, c, d = right.T
    return np.stack(
        (w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c, w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a), axis=1
    )


def matrices(quaternions):
    """(n, 3, 3) in rows, of unit quaternions."""
    w, x, y, z = quaternions.T
    rows = (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
        (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
    )
    return np.moveaxis(np.array(rows), -1, 0)


def chained(left, right):
    """Products of matrices (n or 1, k, k). Row by row: those of a linear algebra library depend on where the arrays lie."""
    return sum(left[:, :, index, None] * right[:, None, index, :] for index in range(left.shape[-1]))


def of_axes(rows):
    """Quaternions that turn as matrices (n, 3, 3) do, whatever else these do; a mirrored one turns as its negative."""
    return np.array([Matrix(row).to_quaternion() for row in rows])


def mixed(lower, upper, parts):
    """Unit quaternions between two, the shorter way; parts: (n,) in [0, 1]."""
    upper = np.where((lower * upper).sum(axis=1, keepdims=True) < 0.0, -upper, upper)
    return unit(lower + parts[:, None] * (upper - lower))
