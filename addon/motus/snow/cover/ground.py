"""Ground of a snow cover: its surfaces as one refined mesh in world space, and the objects that shelter them from flakes."""

from typing import Any, NamedTuple

from ...core import keeping, native
from ...core.lazy import numpy as np
from ...core.scenery import meshes

MOST = 1 << 21
"""Most vertices of the layer of snow."""
_grounds = keeping.OfFile(
    "surfaces that carry a snow cover (Ground), or None",
    "stamps and world matrices of the faces, resolution, up direction, angle of repose",
    most=3,
)


class Ground(NamedTuple):
    """Surfaces that carry a snow cover, together with the objects that shelter these surfaces from flakes.

    collider: native SnowCollider of surfaces and sheltering objects, with vertex_count vertices; the vertices of the surfaces come first.
    layer: native SnowLayer of the surfaces alone. ends: (m, 2), the two vertices between which each of the last m vertices of the layer
    was put in.
    """

    collider: Any
    layer: Any
    vertex_count: int
    ends: Any


def made(*what):
    """Return the Ground of surfaces, kept for equal arguments; None if it would have more than MOST vertices.

    what: lain_on and shelters, tuples of meshes.Placed (a triangle mesh with its world matrix); then resolution, up and repose, as in
    work.Plan (edge length of the refined surface, direction against gravity, angle of repose).
    """
    return _grounds.made(what, lambda: _made(*what))


def _made(lain_on, shelters, resolution, up, repose):
    positions, triangles = meshes.joined(lain_on)
    try:
        positions, triangles, ends = native.module.refine(positions, triangles, resolution, MOST)
    except ValueError:
        return None
    joined = [(positions, triangles)]
    if shelters:
        more = meshes.joined(shelters)
        joined.append((more[0], more[1] + np.int32(len(positions))))
    collider = native.module.SnowCollider(*map(np.concatenate, zip(*joined)))
    layer = native.module.SnowLayer(positions, triangles, up, collider, repose)
    return Ground(collider, layer, sum(len(one) for one, _ in joined), ends)
