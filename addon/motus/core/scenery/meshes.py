"""Faces of evaluated meshes, read once for each evaluated copy of a mesh, and their world matrices."""

import hashlib
import threading
from typing import Any, NamedTuple

from .. import keeping
from ..evaluated import copies
from ..lazy import numpy as np

MOST_BYTES = 256 << 20
"""Most bytes of faces that are kept; the least recently used are dropped."""

_faces = keeping.OfFile(
    "triangles of evaluated meshes as arrays (Faces)",
    "unique number of the evaluated copy of the mesh",
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
    """Triangles of a mesh, in the object's local space.

    stamp: hash of positions and triangles. positions: (v, 3) float32. triangles: (t, 3) int32, vertex indices.
    area: upper bound of the area in local space, m^2.
    """

    stamp: Any
    positions: Any
    triangles: Any
    area: float

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]

    @property
    def bytes(self):
        """Memory of the arrays, in bytes."""
        return self.positions.nbytes + self.triangles.nbytes


class Placed(NamedTuple):
    """A triangle mesh with the world matrix of its object.

    stamp: hashable, equal for equal mesh and matrix. faces: the Faces. matrix: mathutils.Matrix.
    """

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
        """A Placed mesh that has only some of the triangles; None if it would have none. which: (t,) bool, true for triangles to keep."""
        if not which.any():
            return None
        faces = self.faces._replace(triangles=np.ascontiguousarray(self.faces.triangles[which]))
        return self._replace(stamp=(self.stamp, which.tobytes()), faces=faces)


def faces(obj):
    """Faces of an evaluated object's mesh; None if the object is no mesh, has no area, or has vertices at infinity.

    The Faces are kept for as long as Blender keeps this evaluated copy of the mesh.
    """
    if obj.type != 'MESH':
        return None
    mesh = obj.data
    if mesh == obj.original.data:  # an original mesh: evaluated copies would inherit a number that is written into it
        return _read_shown(obj)
    return _faces.made(copies.number_given(mesh), lambda: _read_shown(obj))


def _read_shown(obj):
    if not obj.data.is_editmode:
        return _read(obj.data)
    with _temporary_mesh:  # in Edit Mode the evaluated mesh is empty until to_mesh() is called
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
    """Triangles of an evaluated mesh object together with a world matrix, as Placed; None if the object is no mesh or has no area."""
    found, matrix = faces(obj), matrix.copy()  # a copy: reading a row of an object's own matrix would read the matrix from the object again
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
