"""The form of the cursor on the surface: rings about the root, shaded by the force, and the bump that one dab makes."""

import math

from ...core import native
from ...core.lazy import numpy as np

RINGS = 14
CORNERS = 64


def forces(brush, shares):
    """Forces at shares of the reach from the root, 0 to 1."""
    distances = np.asarray(shares, np.float32) * np.float32(brush.reach_of(brush.radius))
    return native.module.pull_forces(distances, brush.radius, **brush.profile)


def frame(normal, matrix):
    """Two world vectors, as rows, that span the circle of radius 1 about the normal.

    matrix: of the object (3, 3), where lengths are the object's own; None where they are the world's.
    """
    normal = np.asarray(normal, float)
    matrix = np.eye(3) if matrix is None else np.asarray(matrix, float)
    normal = matrix.T @ normal
    length = np.linalg.norm(normal)
    normal = normal / length if length > 0.0 else np.array((0.0, 0.0, 1.0))
    # Across the axis that the normal is farthest from.
    first = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(normal, first)]) @ matrix.T


def circle(center, axes, radius):
    """CORNERS + 1 points of a closed circle, (n, 3)."""
    angles = np.linspace(0.0, 2.0 * math.pi, CORNERS + 1)
    return center + radius * (np.cos(angles)[:, None] * axes[0] + np.sin(angles)[:, None] * axes[1])


def disc(center, axes, brush):
    """Points (n, 3) of rings from the root to the rim, the force at each (n,), and the triangles between (t, 3)."""
    shares = np.linspace(0.0, 1.0, RINGS + 1)
    # The rim itself has no force, and the last ring shall show the step where a falloff ends sharply.
    strengths = forces(brush, np.minimum(shares, 0.999))
    points = np.concatenate([circle(center, axes, share * brush.reach_of(brush.radius)) for share in shares])
    width = CORNERS + 1
    first = (np.arange(RINGS)[:, None] * width + np.arange(CORNERS)).reshape(-1, 1)
    return points, np.repeat(strengths, width), np.concatenate([
        first + (0, 1, width + 1), first + (0, width + 1, width)])


def thinned(places, least, most, apart):
    """(step, size): every step-th of these places, pixels (n, 2), drawn as a dot of that size leaves room between them.

    The size lies between `least` and `most`; the dots are `apart` times as far from each other, on the average.
    """
    if len(places) == 0:
        return 1, least
    width, height = np.maximum(np.ptp(places, axis=0), 1.0)
    spacing = math.sqrt(width * height / len(places))
    step = math.ceil((apart * least / spacing) ** 2 - 1e-6)
    return max(step, 1), min(max(spacing / apart, least), most)


def bump(center, axes, brush, displacement, across):
    """The line, (n, 3), that a straight one over the surface becomes by a dab. across: the view's right."""
    turn = math.atan2(axes[1] @ across, axes[0] @ across)
    along = math.cos(turn) * axes[0] + math.sin(turn) * axes[1]
    shares = np.linspace(-1.0, 1.0, 4 * RINGS + 1)
    strengths = forces(brush, np.minimum(np.abs(shares), 0.999))
    flat = center + (shares * brush.reach_of(brush.radius))[:, None] * along
    return flat + strengths[:, None] * np.asarray(displacement, float)
