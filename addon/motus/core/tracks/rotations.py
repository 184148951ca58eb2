"""Rotations as arrays: quaternions (n, 4; w, x, y, z) as Blender computes them from its rotation modes, and rotation matrices."""

import functools
import itertools

from mathutils import Matrix

from .. import native
from ..lazy import numpy as np

MODES = ('QUATERNION', 'XYZ', 'XZY', 'YXZ', 'YZX', 'ZXY', 'ZYX', 'AXIS_ANGLE')
"""Rotation modes by their numbers in the native module."""
ALONG = 1e-9
"""Part of an axis by which it may lean away from another one, and it still counts as along it."""


def by_rows(make):
    """Let what makes each row of the same rows of its arrays (n or 1, ...) alone work on one row, if all rows are the same memory.

    Such arrays, as broadcast_to() makes them, stand for what does not move. The result is one too, and cannot be written into.
    """

    @functools.wraps(make)
    def made(*arrays):
        count = max(map(len, arrays))
        if count < 2 or not all(len(one) == 1 or one.strides[0] == 0 for one in arrays):
            return make(*arrays)
        found = make(*(one[:1] for one in arrays))
        return np.broadcast_to(found, (count, *found.shape[1:]))

    return made


def unit(quaternions):
    """Quaternions (n, 4) scaled to length 1."""
    lengths = np.linalg.norm(quaternions, axis=1, keepdims=True)
    # Blender reads a quaternion of zeros as (0, 1, 0, 0).
    return np.where(lengths > 0.0, quaternions / np.where(lengths > 0.0, lengths, 1.0), (0.0, 1.0, 0.0, 0.0))


def of_mode(numbers, mode):
    """Unit quaternions (n, 4) of a rotation mode's numbers: (n, 4) of quaternions or angle and axis, (n, 3) of Euler angles in radians.

    Numbers that are not finite count as 0. An axis of length 0 gives no rotation.
    """
    index = MODES.index(mode)

    @by_rows
    def made(numbers):
        rows = np.zeros((len(numbers), 4))
        rows[:, : numbers.shape[1]] = np.nan_to_num(numbers, posinf=0.0, neginf=0.0)
        return native.module.rotations_of(index, rows)

    return made(numbers)


@by_rows
def product(left, right):
    """Quaternions (n, 4) that rotate by `right` first and by `left` after that."""
    w, x, y, z = left.T
    a, b, c, d = right.T
    return np.stack(
        (w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c, w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a), axis=1
    )


@by_rows
def matrices(quaternions):
    """Rotation matrices (n, 3, 3), for column vectors, of unit quaternions (n, 4)."""
    w, x, y, z = quaternions.T
    rows = (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
        (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
    )
    return np.moveaxis(np.array(rows), -1, 0)


@by_rows
def chained(left, right):
    """Matrix products left @ right, (n, k, m), of arrays (n or 1, k, k) and (n or 1, k, m).

    Computed without a linear algebra library, whose results depend in their last bits on where the arrays lie in memory.
    """
    # What stands for all rows is the same memory in each of them.
    pair = (np.ascontiguousarray(one[:1] if one.strides[0] == 0 else one, float) for one in (left, right))
    return native.module.matrix_products(*pair)


@by_rows
def rigid(matrices):
    """Turns and moves, (n, 4, 4), of affine matrices (n, 4, 4), which may also scale, shear and mirror.

    X keeps its direction, and Y its plane with X. An axis without length counts as any that fits.
    """
    found = np.zeros_like(matrices)
    x = _directions(matrices[:, :3, 0], np.array([(1.0, 0.0, 0.0)]))
    beneath = matrices[:, :3, 1]
    y = beneath - x * (x * beneath).sum(axis=1, keepdims=True)
    y[np.abs(y).max(axis=1) <= ALONG * np.abs(beneath).max(axis=1)] = 0.0
    beside = np.where(np.abs(x[:, 2:]) < 0.5, np.cross((0.0, 0.0, 1.0), x), np.cross((1.0, 0.0, 0.0), x))
    found[:, :3, 0] = x
    found[:, :3, 1] = y = _directions(y, _directions(beside, x))
    found[:, :3, 2] = np.cross(x, y)
    found[:, :, 3] = matrices[:, :, 3]
    return found


@by_rows
def of_rigid(matrices):
    """Unit quaternions (n, 4) of the turns in matrices (n, 4, 4) that turn and move alone, in double precision."""
    m = matrices
    w, x, y, z = (
        1.0 + sign * (m[:, 0, 0] + other * m[:, 1, 1] + third * m[:, 2, 2])
        for sign, other, third in ((1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, -1.0, 1.0), (-1.0, 1.0, -1.0))
    )
    a, b, c = m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0], m[:, 1, 0] - m[:, 0, 1]
    d, e, f = m[:, 1, 0] + m[:, 0, 1], m[:, 0, 2] + m[:, 2, 0], m[:, 2, 1] + m[:, 1, 2]
    # Each row is the quaternion times another one of its parts: the largest part divides best.
    found = np.stack([np.stack(row, axis=1) for row in ((w, a, b, c), (a, x, d, e), (b, d, y, f), (c, e, f, z))], axis=1)
    largest = np.argmax(np.stack([w, x, y, z], axis=1), axis=1)
    return unit(found[np.arange(len(m)), largest])


def _directions(vectors, others):
    """Vectors (n, 3) scaled to length 1; `others` in the place of those that have no length."""
    lengths = np.sqrt((vectors**2).sum(axis=1, keepdims=True))
    return np.where(lengths > 0.0, vectors / np.where(lengths > 0.0, lengths, 1.0), others)


@by_rows
def of_axes(rows):
    """Unit quaternions (n, 4) of the rotations in matrices (n, 3, 3), which may also scale and shear.

    The quaternion of a mirroring matrix is that of the negative matrix.
    """
    # Matrix reads Python's own numbers several times as fast as those of arrays.
    found = itertools.chain.from_iterable(Matrix(row).to_quaternion() for row in rows.tolist())
    return np.fromiter(found, float, 4 * len(rows)).reshape(-1, 4)


@by_rows
def mirrored(scales):
    """Return quaternions (n, 4) by which Blender's decomposition of a matrix turns further than the keyed rotation.

    scales: (n, 3) keyed scales. Blender decomposes a mirroring matrix into three negative scales, and any other matrix into three
    positive ones. The remaining signs become half a turn.
    """
    signs = np.where(scales < 0.0, -1.0, 1.0)
    signs *= np.prod(signs, axis=1, keepdims=True)
    # Two negative signs are left, which are half a turn about the third axis; or no sign is left, which is no turn.
    turned = (signs < 0.0).any(axis=1)
    found = np.zeros((len(scales), 4))
    found[~turned, 0] = 1.0
    found[:, 1:] = np.where(turned[:, None] & (signs > 0.0), 1.0, 0.0)  # type: ignore[index]
    return found


def mixed(lower, upper, parts):
    """Unit quaternions (n, 4) between `lower` and `upper`, (n, 4), along the shorter way, by normalized linear interpolation.

    parts: (n,) in [0, 1]; 0 gives `lower`, 1 gives `upper`.
    """
    upper = np.where((lower * upper).sum(axis=1, keepdims=True) < 0.0, -upper, upper)
    return unit(lower + parts[:, None] * (upper - lower))
