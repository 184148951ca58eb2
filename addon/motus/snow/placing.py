"""Faces where they stand in the world."""

from typing import Any, NamedTuple

from ..core.lazy import numpy as np
from . import births


class Placed(NamedTuple):
    """Faces and where they stand. stamp: of both."""

    stamp: Any
    faces: Any
    matrix: Any

    __eq__, __hash__ = births.Poses.__eq__, births.Poses.__hash__


def placed(obj, matrix):
    """The faces of an evaluated mesh object, Placed; None where it has none."""
    faces = births.faces(obj)
    return faces and Placed((faces.stamp, np.array(matrix, float).tobytes()), faces, matrix.copy())


def joined(parts):
    """(positions (v, 3) in the world, float32; triangles (t, 3), int32) of several that are Placed."""
    positions, triangles, count = [], [], 0
    for part in parts:
        positions.append(births.placed(part.faces, part.matrix).positions)
        triangles.append(part.faces.triangles + np.int32(count))
        count += len(positions[-1])
    return np.concatenate(positions), np.concatenate(triangles)
