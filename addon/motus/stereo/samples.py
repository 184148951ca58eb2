"""Sample the depths of the visible scene by rays through a grid over the camera's image."""

from ..core import native
from ..core.lazy import numpy as np
from .rig import axis_matrix

COLUMNS, ROWS = 41, 23
"""Numbers of columns and rows of the grid of rays; the outer columns and rows lie on the edges of the image."""


def take(scene, owner, depsgraph):
    """Sample the depths that a camera sees, from the middle between its eyes: (x, depths), each (m,).

    x: distance from the middle of the image, as a fraction of its width. Rays that hit nothing give no sample.
    """
    evaluated = owner.evaluated_get(depsgraph)
    camera, matrix = evaluated.data, evaluated.matrix_world
    into_camera = axis_matrix(matrix)
    out_of_camera = into_camera.inverted()
    top_right, bottom_right, bottom_left, top_left = camera.view_frame(scene=scene)
    start, turn = out_of_camera.translation, out_of_camera.to_3x3()
    places, depths = [], []
    for row in range(ROWS):
        left = bottom_left.lerp(top_left, row / (ROWS - 1))
        right = bottom_right.lerp(top_right, row / (ROWS - 1))
        for column in range(COLUMNS):
            share = column / (COLUMNS - 1)
            ray = left.lerp(right, share)
            depth = _depth(scene, depsgraph, into_camera, start, turn @ ray, ray, camera)
            if depth is not None:
                places.append(share - 0.5)
                depths.append(depth)
    return np.array(places), np.array(depths)


def depth_range(scene, owner, depsgraph, left_out):
    """Return (near, far) depth of the visible scene; None if no ray hits anything.

    left_out: share of the samples that is ignored at the near end, and again at the far end.
    """
    _, depths = take(scene, owner, depsgraph)
    return native.module.depth_range(depths, left_out, 1.0 - left_out)


def beyond(near, far):
    """Return `far`, or a depth slightly behind `near` if `far` is not behind it."""
    return max(far, near * 1.001)


def _depth(scene, depsgraph, into_camera, start, direction, ray, camera):
    """Depth of the first surface that a ray hits between the camera's clipping distances; None if it hits nothing."""
    slope = ray.length / -ray.z
    origin = start + direction.normalized() * (camera.clip_start * slope)
    reach = max(camera.clip_end - camera.clip_start, 0.0) * slope
    is_hit, place, *_ = scene.ray_cast(depsgraph, origin, direction, distance=reach)
    return -(into_camera @ place).z if is_hit else None
