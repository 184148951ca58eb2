"""Faces of evaluated meshes, read once for each copy that Blender makes of a mesh, and where they stand in the world."""

import hashlib
import threading
from typing import Any, NamedTuple

from .. import keeping
from ..evaluated import copies
from ..lazy import numpy as np

MOST_BYTES = 256 << 20
"""Of faces that are kept."""

_faces = keeping.OfFile(
    "Faces of an evaluated mesh",
    "number of the evaluated copy of the mesh",
    most_size=MOST_BYTES,
    size=lambda _, found: found.bytes if found else 0,
    unit="bytes",
)
# A second to_mesh() on an object frees the first one's result, and drivers run in several threads.
_temporary_mesh = threading.RLock()


def is_same(one, other):
    """Whether two named tuples have equal stamps; used as __eq__ of classes whose `stamp` changes with their content."""
    return other is not None and one.stamp == other.stamp


def hash_of(one):
    """Hash of a named tuple by its `stamp`; used as __hash__ of classes whose __eq__ is is_same()."""
    return hash(one.stamp)


class Faces(NamedTuple):
    """Triangles in the space of their object. stamp: of their content. area: m^2, in that space, at most."""

    stamp: Any
    positions: Any
    triangles: Any
    area: float

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]

    @property
    def bytes(self):
        return self.positions.nbytes + self.triangles.nbytes


class Placed(NamedTuple):
    """A triangle mesh with the world matrix of its object. stamp: hashable, equal for equal mesh and matrix."""

    stamp: Any
    faces: Any
    matrix: Any

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]

    @property
    def area(self):
        """Upper bound of the mesh's area in world space, m^2, for any scale of the object."""
        *_, larger, largest = sorted(axis.length for axis in self.matrix.to_3x3().col)
        return self.faces.area * larger * largest

    def chosen(self, which):
        """This Placed with only the triangles that `which`, (t,) bool, selects; None if it selects none."""
        if not which.any():
            return None
        faces = self.faces._replace(triangles=np.ascontiguousarray(self.faces.triangles[which]))
        return self._replace(stamp=(self.stamp, which.tobytes()), faces=faces)


def faces(obj):
    """The Faces of an evaluated object's mesh; None where it has no area, or is no mesh.

    Kept for as long as Blender keeps that copy of the mesh.
    """
    if obj.type != 'MESH':
        return None
    mesh = obj.data
    if mesh == obj.original.data:  # all its copies would have its number
        return _read_shown(obj)
    return _faces.made(copies.number_given(mesh), lambda: _read_shown(obj))


def _read_shown(obj):
    if not obj.data.is_editmode:
        return _read(obj.data)
    with _temporary_mesh:  # in Edit Mode Blender leaves the evaluated mesh empty until somebody asks for one
        try:
            with keeping.aside():
                mesh = obj.to_mesh()
            return _read(mesh)
        finally:
            obj.to_mesh_clear()


def _read(mesh):
    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    positions = np.empty(3 * len(mesh.vertices), np.float32)
    triangles = np.empty(3 * count, np.int32)
    areas = np.empty(count, np.float32)
    mesh.vertices.foreach_get("co", positions)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    mesh.loop_triangles.foreach_get("area", areas)
    if not (np.isfinite(positions).all() and (areas > 0.0).any()):
        return None
    stamp = hashlib.blake2b(positions, digest_size=16)
    stamp.update(triangles)
    return Faces(stamp.digest(), positions.reshape(-1, 3), triangles.reshape(-1, 3), float(areas.sum(dtype=float)))


def placed(obj, matrix):
    """Triangles of an evaluated mesh object together with its world matrix, as Placed; None if the mesh has no faces."""
    found, matrix = faces(obj), matrix.copy()  # each row of which is not asked of Blender then
    return found and Placed((found.stamp, np.array(matrix, float).tobytes()), found, matrix)


def joined(parts):
    """(positions (v, 3) in world space, float32; triangles (t, 3), int32) of several Placed meshes as one mesh.

    The vertex order of mirrored meshes is reversed, so that all triangles are counter-clockwise seen from outside.
    """
    positions, triangles, count = [], [], 0
    for part in parts:
        rows = np.array(part.matrix, float)
        positions.append((part.faces.positions @ rows[:3, :3].T + rows[:3, 3]).astype(np.float32))
        corners = part.faces.triangles[:, ::-1] if part.matrix.is_negative else part.faces.triangles
        triangles.append(corners + np.int32(count))
        count += len(positions[-1])
    return np.concatenate(positions), np.concatenate(triangles)
