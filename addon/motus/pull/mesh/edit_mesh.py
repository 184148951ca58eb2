"""Mesh in Edit Mode: positions are read from the mesh's arrays, which Blender fills from its edit mesh (BMesh).

Positions are written vertex by vertex into the edit mesh.
"""

import bmesh

from ...core.lazy import numpy as np
from .object_mesh import ObjectMesh

MOST_SINGLE_NORMALS = 0.02
"""Largest share of moved vertices for which normals are computed singly; above it all normals are computed."""


class EditMesh(ObjectMesh):
    """A mesh in Edit Mode, with the methods of ObjectMesh.

    Hidden vertices, masks and keys are read as in Object Mode. Blender itself moves relative shape keys along with the edited key.
    """

    writes_all = False

    def __init__(self, obj):
        super().__init__(obj)
        self._moved = np.zeros(self.count, bool)

    def write(self, positions, moved=None):
        """Write positions (n, 3) into the edit mesh. moved: indices of vertices that differ, in any order; None for all vertices."""
        vertices = self._edit_mesh().verts
        moved = None if moved is None else np.unique(np.asarray(moved, int))
        indices = range(self.count) if moved is None else moved.tolist()
        places = (positions if moved is None else positions[moved]).tolist()
        for index, place in zip(indices, places):
            vertices[index].co = place
        self._moved[slice(None) if moved is None else moved] = True
        self._update_normals(indices)
        bmesh.update_edit_mesh(self.mesh, loop_triangles=False, destructive=False)

    def room(self):
        """Return None: an edit mesh has no memory for all positions, since Blender does not read the mesh's arrays back."""

    def finish(self):
        """Let Blender triangulate the faces again, since the triangulation depends on the shape."""
        if self._moved.any():
            bmesh.update_edit_mesh(self.mesh, loop_triangles=True, destructive=False)

    def is_deformed(self):
        """Return False: in Edit Mode the user sees and edits the cage, which is the written mesh."""
        return False

    def share_seen(self):
        """Return 1.0, the share of a displacement that the user sees: Edit Mode shows the edited shape key in full."""
        return 1.0

    def _edit_mesh(self):
        found = bmesh.from_edit_mesh(self.mesh)
        found.verts.ensure_lookup_table()
        return found

    def _update_normals(self, indices):
        edit = self._edit_mesh()
        if len(indices) > max(1000, MOST_SINGLE_NORMALS * self.count):
            edit.normal_update()
            return
        vertices = [edit.verts[index] for index in indices]
        for face in {face for vertex in vertices for face in vertex.link_faces}:
            face.normal_update()
        for vertex in vertices:
            vertex.normal_update()
