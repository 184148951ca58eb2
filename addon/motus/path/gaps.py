"""Compute the gaps of a train whose members touch: the distances between the origins of neighbouring objects."""

import itertools

from mathutils import Vector

from ..core.measures import axes
from .properties import DEFAULT_GAP

NO_LENGTH = 1e-6  # shortest extent that counts, m


def touching_gaps(train, forward_axis):
    """Return the distance from each object's origin to the next object's origin at which neighbours in the train touch.

    Neighbours without extent along the path, such as lights, get DEFAULT_GAP.
    """
    extents = [_extent(obj, Vector(axes.vector(forward_axis))) for obj in train]
    gaps = [front - rear for (rear, _), (_, front) in itertools.pairwise(extents)]
    return [gap if gap > NO_LENGTH else DEFAULT_GAP for gap in gaps]


def _extent(obj, direction):
    """Return (rear end, front end) of an object along a direction of its own axes, measured from its origin, in metres."""
    scale = abs(obj.matrix_world.to_scale().dot(direction))
    if obj.type == 'EMPTY':
        size = obj.empty_display_size * scale
        return -size, size
    along = [Vector(corner).dot(direction) * scale for corner in obj.bound_box]
    return min(along), max(along)
