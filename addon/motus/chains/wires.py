"""Shapes as lines for the overlay of chains, and distances from them. Lines are pairs of points, (n, 3)."""

from ..core.lazy import numpy as np

AROUND = 24
"""Segments of a circle."""
CONE_LINES = 6


def capsules(places, radii):
    """Lines of capsules between two places each, (k, 2, 3), balls among them. radii: (k,)."""
    along = _directions(places[:, 1] - places[:, 0])
    axes = np.stack([*_across(along), along], axis=1)
    ends, offsets = _capsule()
    points = places[:, ends] + radii[:, None, None] * (offsets @ axes)
    return points.reshape(-1, 3)


def planes(places, near, size):
    """Squares in planes through the first of two places each, (k, 2, 3), across the way to the second. They lie before a place `near`.

    size: half the length of a side.
    """
    normals = _directions(places[:, 1] - places[:, 0])
    first, second = _across(normals)
    middles = near - normals * ((near - places[:, 0]) * normals).sum(axis=1, keepdims=True)
    corners = [middles + size * (one * first + other * second) for one, other in ((-1, -1), (-1, 1), (1, 1), (1, -1))]
    turned = np.stack([corners[index] for index in (0, 1, 1, 2, 2, 3, 3, 0, 0, 2, 1, 3)], axis=1)
    return turned.reshape(-1, 3)


def cone(apex, along, size, angle):
    """Lines of a cone: its side lines, and the circle at their ends. angle: between them and the axis, radians."""
    axis = _directions(along[None])
    first, second = (one[0] for one in _across(axis))
    turns = np.linspace(0.0, 2.0 * np.pi, AROUND + 1)[:, None]
    ring = apex + size * (np.cos(angle) * axis[0] + np.sin(angle) * (np.cos(turns) * first + np.sin(turns) * second))
    sides = ring[: -1 : AROUND // CONE_LINES]
    return np.concatenate([_strip(ring), np.stack([np.broadcast_to(apex, sides.shape), sides], axis=1).reshape(-1, 3)])


def distances(points, places, radii):
    """Distances (n,) of points (n, 3) from the nearest of capsules between two places each, (k, 2, 3); inf without any. radii: (k,)."""
    way = places[:, 1] - places[:, 0]
    square = np.maximum((way**2).sum(axis=1), np.finfo(float).tiny)
    apart = points[:, None] - places[:, 0]
    shares = np.clip((apart * way).sum(axis=2) / square, 0.0, 1.0)
    return (np.linalg.norm(apart - shares[:, :, None] * way, axis=2) - radii).min(axis=1, initial=np.inf)


def heights(points, places):
    """Heights (n,) of points (n, 3) above the nearest of planes, given as those of planes(); inf without any."""
    normals = _directions(places[:, 1] - places[:, 0])
    return ((points[:, None] - places[:, 0]) * normals).sum(axis=2).min(axis=1, initial=np.inf)


def _directions(ways):
    """Ways (n, 3) scaled to length 1; Z for those without length."""
    lengths = np.linalg.norm(ways, axis=1, keepdims=True)
    return np.where(lengths > 0.0, ways / np.where(lengths > 0.0, lengths, 1.0), (0.0, 0.0, 1.0))


def _across(directions):
    """Two directions each, (n, 3), that are perpendicular to directions (n, 3) and to each other."""
    beside = np.where(np.abs(directions[:, :1]) < 0.7, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    first = _directions(np.cross(beside, directions))
    return first, np.cross(directions, first)


def _strip(points):
    """Pairs of points from the points of a line strip."""
    return np.stack([points[:-1], points[1:]], axis=1).reshape(-1, 3)


def _capsule():
    """(which end, offset from it in radii) of the points of a capsule's lines along Z."""
    turns = np.linspace(0.0, np.pi, AROUND // 2 + 1)
    around, none = np.linspace(0.0, 2.0 * np.pi, AROUND + 1), np.zeros(AROUND + 1)
    ring = np.stack([np.cos(around), np.sin(around), none], axis=1)
    found = [(end, _strip(ring)) for end in (0, 1)]
    for end, up in ((0, -1.0), (1, 1.0)):
        arc, flat = np.stack([np.cos(turns), up * np.sin(turns)], axis=1), np.zeros(len(turns))
        found += [(end, _strip(np.stack(one, axis=1))) for one in ((arc[:, 0], flat, arc[:, 1]), (flat, arc[:, 0], arc[:, 1]))]
    ends = np.concatenate([np.full(len(points), end) for end, points in found])
    offsets = np.concatenate([points for _, points in found])
    sides = np.repeat(np.array([(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0)]), 2, axis=0)
    return np.concatenate([ends, np.tile([0, 1], 4)]), np.concatenate([offsets, sides])
