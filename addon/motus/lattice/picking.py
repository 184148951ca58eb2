"""Find the point of a deformed surface that lies under the mouse."""

from bpy_extras.view3d_utils import region_2d_to_origin_3d, region_2d_to_vector_3d
from mathutils import Vector

from ..core import native
from ..core.lazy import numpy as np

NEAR = 20.0
"""Largest distance of a picked vertex from the mouse if no face lies under the mouse, in pixels at the interface's normal size."""


def pick(shapes, region, view, mouse, near):
    """Pick a point of the shapes under the mouse: (shape, [(vertex, share)]), or None.

    The point lies on the nearest face under the mouse; without a face it is the nearest vertex within `near` pixels.
    """
    origin, direction = region_2d_to_origin_3d(region, view, mouse), region_2d_to_vector_3d(region, view, mouse)
    hits = []
    for shape in shapes:
        triangles = shape.triangles()
        hit = native.module.Picker(shape.after, triangles).ray(origin, direction)
        if hit is not None:
            hits.append((hit[2], shape, _corners(shape, triangles[hit[0]], np.array(hit[1], np.float64))))
    if hits:
        return min(hits, key=lambda hit: hit[0])[1:]
    found = [(*_nearest_vertex(shape, region, view, mouse), shape) for shape in shapes]
    distance, vertex, shape = min(found, key=lambda one: one[0])
    return (shape, [(vertex, 1.0)]) if distance < near else None


def _corners(shape, vertices, place):
    """Barycentric coordinates of a place on a triangle: [(vertex, coordinate)]."""
    a, b, c = shape.after[vertices].astype(np.float64)
    # Least squares in the plane of the triangle, or on its line if the triangle is a needle.
    shares = np.linalg.lstsq(np.column_stack((b - a, c - a)), place - a, rcond=None)[0]
    return [(int(vertex), float(share)) for vertex, share in zip(vertices, (1.0 - shares.sum(), *shares))]


def _nearest_vertex(shape, region, view, mouse):
    """(distance in pixels, index) of the visible vertex that is nearest to the mouse in the region."""
    rows = np.array(view.perspective_matrix)
    clip = shape.after @ rows[:, :3].T + rows[:, 3]
    in_front = clip[:, 3] > 0.0
    if not in_front.any():
        return float("inf"), 0
    with np.errstate(divide='ignore', invalid='ignore'):
        screen = (clip[:, :2] / clip[:, 3:] + 1.0) * (0.5 * region.width, 0.5 * region.height)
    distance = np.where(in_front, np.hypot(*(screen - np.array(mouse)).T), np.inf)
    vertex = int(distance.argmin())
    return float(distance[vertex]), vertex


def place_of(shape, corners):
    """World position of a point of the deformed surface."""
    return Vector(sum(share * shape.after[vertex].astype(np.float64) for vertex, share in corners).tolist())
