"""Shape of the cursor on the surface: rings around the pulled vertex, shaded by the force, and the bump of one dab."""

import math

from ...core import native
from ...core.lazy import numpy as np

RINGS = 14
CORNERS = 64


def forces(brush, shares):
    """Forces of the brush at distances from the pulled vertex that are given as shares (0 to 1) of the reach."""
    distances = np.asarray(shares, np.float32) * np.float32(brush.reach_of(brush.radius))
    return native.module.pull_forces(distances, brush.radius, **brush.profile)


def frame(normal, matrix):
    """Two world vectors, as rows, that span a circle of radius 1 around a surface normal.

    matrix: 3x3 matrix from the object's space to the world if lengths are measured in the object; None if they are measured in the world.
    """
    normal = np.asarray(normal, float)
    matrix = np.eye(3) if matrix is None else np.asarray(matrix, float)
    normal = matrix.T @ normal
    length = np.linalg.norm(normal)
    normal = normal / length if length > 0.0 else np.array((0.0, 0.0, 1.0))
    # Start with the axis that the normal is farthest from.
    first = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(normal, first)]) @ matrix.T


def circle(center, axes, radius):
    """Points of a closed circle around `center`, (CORNERS + 1, 3). axes: two vectors from frame()."""
    angles = np.linspace(0.0, 2.0 * math.pi, CORNERS + 1)
    return center + radius * (np.cos(angles)[:, None] * axes[0] + np.sin(angles)[:, None] * axes[1])


def disc(center, axes, brush):
    """Disc of rings from the pulled vertex to the rim of the brush.

    Returns points (n, 3), force at each point (n,), and triangles (t, 3). axes: two vectors from frame().
    """
    shares = np.linspace(0.0, 1.0, RINGS + 1)
    # The force on the rim is zero; the last ring lies just inside, and shows the step of a falloff that ends sharply.
    strengths = forces(brush, np.minimum(shares, 0.999))
    points = np.concatenate([circle(center, axes, share * brush.reach_of(brush.radius)) for share in shares])
    width = CORNERS + 1
    first = (np.arange(RINGS)[:, None] * width + np.arange(CORNERS)).reshape(-1, 1)
    return points, np.repeat(strengths, width), np.concatenate([first + (0, 1, width + 1), first + (0, width + 1, width)])


def thinned(places, least, most, apart):
    """Choose how dots at positions on the screen (n, 2), in pixels, are thinned out.

    Returns (step, size): every step-th position is drawn as a dot of this size. The size is between `least` and `most`. The mean distance
    of the dots is at least `apart` times the size.
    """
    if len(places) == 0:
        return 1, least
    width, height = np.maximum(np.ptp(places, axis=0), 1.0)
    spacing = math.sqrt(width * height / len(places))
    step = math.ceil((apart * least / spacing) ** 2 - 1e-6)
    return max(step, 1), min(max(spacing / apart, least), most)


def bump(center, axes, brush, displacement, across):
    """Line (n, 3) that one dab would make of a straight line over the surface through `center`.

    axes: two vectors from frame(). displacement: of the pulled vertex. across: world direction to the right in the view.
    """
    turn = math.atan2(axes[1] @ across, axes[0] @ across)
    along = math.cos(turn) * axes[0] + math.sin(turn) * axes[1]
    shares = np.linspace(-1.0, 1.0, 4 * RINGS + 1)
    strengths = forces(brush, np.minimum(np.abs(shares), 0.999))
    flat = center + (shares * brush.reach_of(brush.radius))[:, None] * along
    return flat + strengths[:, None] * np.asarray(displacement, float)
