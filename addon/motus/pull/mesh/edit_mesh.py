"""Mesh in Edit Mode: read from the arrays that Blender fills from its edit mesh, and written vertex by vertex."""

import bmesh

from ...core.lazy import numpy as np
from .object_mesh import ObjectMesh

MOST_SINGLE_NORMALS = 0.02
"""Largest share of the vertices for which normals are computed one by one; for more of them all normals are computed."""


class EditMesh(ObjectMesh):
    """A mesh in Edit Mode. Hidden vertices, masks and keys are read as in Object Mode; relative shape keys are moved along by Blender."""

    writes_all = False

    def __init__(self, obj):
        super().__init__(obj)
        self._moved = np.zeros(self.count, bool)

    def write(self, positions, moved=None):
        """Write positions (n, 3) into the edit mesh. moved: indices of vertices that differ, in any order; None for all."""
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
        """No memory to write to: Blender does not read the arrays back into its edit mesh."""

    def finish(self):
        """Triangulate the faces again, since the triangulation depends on the shape."""
        if self._moved.any():
            bmesh.update_edit_mesh(self.mesh, loop_triangles=True, destructive=False)

    def is_deformed(self):
        """Always False: in Edit Mode the cage is what the user sees and edits."""
        return False

    def share_seen(self):
        """Always 1: Edit Mode shows the edited shape key in full."""
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
