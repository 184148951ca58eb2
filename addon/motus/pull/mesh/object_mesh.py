"""Mesh in Object or Sculpt Mode: whether the mesh can be pulled, and access to its vertices.

EditMesh in edit_mesh.py derives from the class ObjectMesh.
"""

from ...core.lazy import numpy as np
from ...core.refusals import Refused
from ...core.translations import tr
from . import arrays

MODES = ('OBJECT', 'EDIT', 'SCULPT')


def problem(obj):
    """Sentence in the user's language that says why an object's mesh cannot be pulled; None if it can be pulled."""
    if obj is None:
        return tr("Select a mesh")
    if obj.type != 'MESH':
        return tr("{object} is not a mesh").format(object=obj.name)
    mesh = obj.data
    if mesh.library or mesh.override_library:
        return tr("The mesh of {object} is linked from another file: make it local first").format(object=obj.name)
    if obj.mode not in MODES:
        return tr("Go to Object, Edit or Sculpt Mode first")
    if obj.mode == 'SCULPT' and obj.use_dynamic_topology_sculpting:
        return tr("Dynamic topology changes the vertices while they are pulled: switch it off first")
    if any(modifier.type == 'MULTIRES' for modifier in obj.modifiers):
        return tr("{object} has a Multiresolution modifier: apply it or remove it first").format(object=obj.name)
    if obj.mode != 'EDIT' and len(mesh.vertices) == 0:  # Accessing a single vertex would make a copy of the shared positions.
        return tr("{object} has no vertices").format(object=obj.name)
    key = obj.active_shape_key
    if key is not None and getattr(key, "lock_shape", False):
        return tr("The shape key {key} is locked").format(key=key.name)
    return None


class ObjectMesh:
    """Access to a mesh in Object or Sculpt Mode. If the mesh has shape keys, the active shape key is read and written."""

    def __init__(self, obj):
        self.obj = obj
        self.mesh = obj.data
        key = obj.active_shape_key
        self._key_name = None if key is None else key.name
        self._key_followers = None

    @property
    def key(self):
        """Active shape key; None if the mesh has no shape keys.

        Raises ReferenceError if the key was removed, since Blender does not invalidate references to removed keys.
        """
        return None if self._key_name is None else _key_of(self.mesh, self._key_name)

    writes_all = True
    """Whether write() writes all vertices: outside Edit Mode finding the moved vertices would take as long as writing all."""

    @property
    def count(self):
        """Number of vertices of the mesh."""
        return len(self.mesh.vertices)

    def positions(self):
        """Local positions of the mesh's vertices, or of the active shape key's points, float32 (n, 3)."""
        if self.key is None:
            return arrays.positions(self.mesh)
        return arrays.key_positions(self.key)

    def triangles(self, visible_only=False):
        """Triangles of the mesh in Blender's triangulation, int32 (t, 3) vertex indices. visible_only: leave out hidden faces."""
        return arrays.triangles(self.mesh, visible_only)

    def edges(self):
        """Edges of the mesh, int32 (e, 2) vertex indices."""
        return arrays.edges(self.mesh)

    def corners(self):
        """Vertex index of each face corner of the mesh, int32 (c,)."""
        return arrays.corners(self.mesh)

    def hidden(self):
        """Whether each vertex of the mesh is hidden, bool (n,); None if none is hidden."""
        return arrays.hidden_vertices(self.mesh)

    def mask(self):
        """Sculpt mask of each vertex, float32 (n,); None if the mesh has no mask or the object is not in Sculpt Mode."""
        return arrays.sculpt_mask(self.mesh) if self.obj.mode == 'SCULPT' else None

    def weights(self, group_name):
        """Weights of the vertex group of this name, float32 (n,). Raises Refused if the object has no such group."""
        group = self.obj.vertex_groups.get(group_name)
        if group is None:
            raise Refused(tr("{object} has no vertex group {group}").format(object=self.obj.name, group=group_name))
        return arrays.group_weights(self.mesh, group.index)

    def write(self, positions, moved=None):
        """Write positions (n, 3) into the mesh or its active shape key, and tag the mesh for an update.

        moved: indices of vertices that differ, in any order; None for all vertices.
        """
        flat = positions.reshape(-1)
        if self.key is None:
            arrays.set_positions(self.mesh, flat, moved)
        else:
            self._write_key(flat)
        self.mesh.update()

    def room(self):
        """Memory of the mesh's positions, float32 (n, 3), which the caller may fill and then must call filled().

        None if the mesh has shape keys, or this Blender gives no access to the memory.
        """
        return arrays.own_positions(self.mesh) if self.key is None else None

    def filled(self):
        """Tag the mesh for an update after the caller has filled the memory from room()."""
        self.mesh.update()

    def finish(self):
        """Finish the mesh at the end of a stroke; here nothing is left to do, EditMesh overrides it."""

    def is_deformed(self):
        """Whether the user may see the vertices in different positions than write() writes, because of shape keys or modifiers."""
        return self.key is not None or any(modifier.show_viewport for modifier in self.obj.modifiers)

    def evaluated_positions(self, depsgraph):
        """Positions of the vertices on the evaluated mesh, float32 (n, 3).

        None if modifiers change the number of vertices or face corners.
        """
        depsgraph.update()
        seen = self.obj.evaluated_get(depsgraph).data
        if (len(seen.vertices), len(seen.loops)) != (len(self.mesh.vertices), len(self.mesh.loops)):
            return None
        return arrays.positions(seen)

    def follows_whole(self):
        """Whether a pull moves all vertices in reach in full, on the shape on which pins are measured.

        False if vertices are masked or hidden, or if the active shape key is not the reference key.
        """
        mask = self.mask()
        has_mask = self.hidden() is not None or (mask is not None and mask.any())
        return not has_mask and (self.key is None or self.key == self.mesh.shape_keys.reference_key)

    def share_seen(self):
        """Share of a written displacement that the user sees: the value of the active shape key, or 1.0."""
        keys = self.mesh.shape_keys
        is_whole = self.key is None or self.key == keys.reference_key or not keys.use_relative
        if is_whole or self.obj.show_only_shape_key:
            return 1.0
        return 0.0 if self.key.mute else self.key.value

    def _write_key(self, flat):
        key, keys = self.key, self.mesh.shape_keys
        if self._key_followers is None:
            # Like Blender's own tools: shape keys that are relative to the active key move along, which keeps their offsets.
            followers = _followers(keys, key)
            self._before = arrays.key_positions(key).reshape(-1) if followers else None
            self._key_followers = [(one.name, arrays.key_positions(one).reshape(-1)) for one in followers]
        arrays.set_key_positions(key, flat)
        if key == keys.reference_key:
            arrays.set_positions(self.mesh, flat)
        for name, before in self._key_followers:
            arrays.set_key_positions(_key_of(self.mesh, name), before + (flat - self._before))


def _key_of(mesh, name):
    found = mesh.shape_keys and mesh.shape_keys.key_blocks.get(name)
    if found is None:
        raise ReferenceError(f"{mesh.name} has no shape key {name} any more")
    return found


def _followers(keys, leader):
    """Return the shape keys that are relative to the key `leader`, directly or through further keys."""
    if not keys.use_relative:
        return []
    found, names = [], {leader.name}
    others = [key for key in keys.key_blocks if key != leader]
    while True:
        more = [key for key in others if key.relative_key.name in names and key.name not in names]
        if not more:
            return found
        found += more
        names |= {key.name for key in more}


def not_seen(key):
    """Sentence that reports a pull on a shape key that has no visible effect."""
    return tr("The shape key {key} is not seen, as its value is 0 or it is muted").format(key=key.name)


def nearest(positions, place, metric, hidden=None):
    """Return (index, distance) of the vertex nearest to a position.

    positions: (n, 3). place: position in the space of `positions`. metric: 3x3 matrix that measures lengths. hidden: bool (n,), vertices to
    be ignored, or None.
    """
    away = (positions - np.asarray(place, np.float32)) @ np.asarray(metric, np.float32).T
    squares = np.einsum("ij,ij->i", away, away)
    squares[~np.isfinite(squares)] = np.inf
    if hidden is not None:
        squares[hidden] = np.inf
    index = int(squares.argmin())
    return index, float(np.sqrt(squares[index]))
