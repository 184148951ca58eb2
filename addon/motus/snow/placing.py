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

    @property
    def area(self):
        """m^2 in the world: of what is scaled unevenly as much as it is at most."""
        *_, larger, largest = sorted(axis.length for axis in self.matrix.to_3x3().col)
        return self.faces.area * larger * largest

    def chosen(self, which):
        """Of these triangles alone, (t,) bool; None without any."""
        if not which.any():
            return None
        faces = self.faces._replace(triangles=np.ascontiguousarray(self.faces.triangles[which]))
        return self._replace(stamp=(self.stamp, which.tobytes()), faces=faces)


def placed(obj, matrix):
    """The faces of an evaluated mesh object, Placed; None where it has none."""
    faces = births.faces(obj)
    return faces and Placed((faces.stamp, np.array(matrix, float).tobytes()), faces, matrix.copy())


def joined(parts):
    """(positions (v, 3) in the world, float32; triangles (t, 3), int32) of several that are Placed."""
    positions, triangles, count = [], [], 0
    for part in parts:
        rows = np.array(part.matrix, float)
        positions.append((part.faces.positions @ rows[:3, :3].T + rows[:3, 3]).astype(np.float32))
        triangles.append(part.faces.triangles + np.int32(count))
        count += len(positions[-1])
    return np.concatenate(positions), np.concatenate(triangles)
