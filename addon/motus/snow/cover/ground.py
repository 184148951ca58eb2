"""What snow lies on: the surfaces as one mesh in the world, refined, and what else flakes land on."""

import functools
from typing import Any, NamedTuple

from ...core import native
from ...core.lazy import numpy as np

MOST = 1 << 21
"""Vertices of the layer."""
KEPT = 3


class Ground(NamedTuple):
    """collider: the native SnowCollider of the surfaces and what shelters them. layer: the SnowLayer of the surfaces alone,
    whose vertices come first in the collider."""

    collider: Any
    layer: Any


@functools.lru_cache(maxsize=KEPT)
def made(lain_on, shelters, resolution, up):
    """The Ground of Faces in the world; None where it would have more than MOST vertices."""
    positions, triangles = _joined(lain_on)
    try:
        positions, triangles = native.module.refine(positions, triangles, resolution, MOST)
    except ValueError:
        return None
    layer = native.module.SnowLayer(positions, triangles, up)
    others = _joined(shelters)
    collider = native.module.SnowCollider(
        np.concatenate((positions, others[0])), np.concatenate((triangles, others[1] + len(positions))))
    return Ground(collider, layer)


def _joined(faces):
    """Positions and triangles of several Faces as those of one."""
    starts = np.cumsum([0, *(len(one.positions) for one in faces)])
    return (np.concatenate([np.empty((0, 3), np.float32), *(one.positions for one in faces)]),
            np.concatenate([np.empty((0, 3), np.int32),
                            *(one.triangles + np.int32(start) for one, start in zip(faces, starts))]).astype(np.int32))
