"""A mesh in Edit Mode: read from the arrays that Blender fills from its edit mesh, written vertex by vertex."""

import bmesh

from ...core.lazy import numpy as np
from .object_mesh import ObjectMesh

MOST_SINGLE_NORMALS = 0.02
"""Share of the vertices up to which their normals are computed one by one, rather than all of them."""


class EditMesh(ObjectMesh):
    """What is hidden, masked or keyed is read as in Object Mode; Blender itself takes relative shape keys along."""

    writes_all = False

    def __init__(self, obj):
        super().__init__(obj)
        self._moved = np.zeros(self.count, bool)

    def write(self, positions, moved=None):
        """Put positions (n, 3) into the edit mesh. moved: indices of those that differ, in any order; all, if None."""
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
        """What is in the arrays is not in the edit mesh."""

    def finish(self):
        """Triangulate the faces anew, which depends on their shape."""
        if self._moved.any():
            bmesh.update_edit_mesh(self.mesh, loop_triangles=True, destructive=False)

    def is_deformed(self):
        """The cage is what is seen and edited."""
        return False

    def share_seen(self):
        """Edit Mode shows the shape key that is edited."""
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
