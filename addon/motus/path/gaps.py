"""How far behind each other objects stand that touch."""

from mathutils import Vector

from ..core.measures import axes
from .properties import DEFAULT_GAP
import itertools

NO_LENGTH = 1e-6  # m


def touching_gaps(train, forward_axis):
    """Distances of the objects' origins from one to the next where each touches the one in front.

    Between what has no extent, such as lights, it is DEFAULT_GAP.
    """
    extents = [_extent(obj, Vector(axes.vector(forward_axis))) for obj in train]
    gaps = [front - rear for (rear, _), (_, front) in itertools.pairwise(extents)]
    return [gap if gap > NO_LENGTH else DEFAULT_GAP for gap in gaps]


def _extent(obj, direction):
    """Rear and front end of the object along its own axis, from its origin, m."""
    scale = abs(obj.matrix_world.to_scale().dot(direction))
    if obj.type == 'EMPTY':
        size = obj.empty_display_size * scale
        return -size, size
    along = [Vector(corner).dot(direction) * scale for corner in obj.bound_box]
    return min(along), max(along)
