"""The mesh that is pulled, in Object, Edit and Sculpt Mode: whether it may be edited, and where its vertices are."""

from ...core.lazy import numpy as np
from ...core.refusals import Refused
from ...core.translations import tr
from . import arrays

MODES = ('OBJECT', 'EDIT', 'SCULPT')


def problem(obj):
    """A sentence in the user's language that says why the object cannot be pulled as it is; None where it can."""
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
    if obj.mode != 'EDIT' and len(mesh.vertices) == 0:  # to ask for any vertex un-shares their places
        return tr("{object} has no vertices").format(object=obj.name)
    key = obj.active_shape_key
    if key is not None and getattr(key, "lock_shape", False):
        return tr("The shape key {key} is locked").format(key=key.name)
    return None


class ObjectMesh:
    """A mesh in Object or Sculpt Mode. With shape keys it is the active one that is read and written."""

    def __init__(self, obj):
        self.obj = obj
        self.mesh = obj.data
        key = obj.active_shape_key
        self._key_name = None if key is None else key.name
        self._key_followers = None

    @property
    def key(self):
        """The shape key, None without any. Raises ReferenceError where it is gone, which Blender itself would not notice."""
        return None if self._key_name is None else _key_of(self.mesh, self._key_name)

    writes_all = True
    """Writing all vertices takes little more time than to find out which have moved."""

    @property
    def count(self):
        """The number of vertices."""
        return len(self.mesh.vertices)

    def positions(self):
        """float32 (n, 3), in the object's space."""
        if self.key is None:
            return arrays.positions(self.mesh)
        return arrays.key_positions(self.key)

    def triangles(self, visible_only=False):
        """int32 (t, 3), as Blender triangulates the faces. visible_only: without those of hidden faces."""
        return arrays.triangles(self.mesh, visible_only)

    def edges(self):
        """int32 (e, 2)."""
        return arrays.edges(self.mesh)

    def corners(self):
        """int32 (c,): the vertex of each face corner."""
        return arrays.corners(self.mesh)

    def hidden(self):
        """bool (n,), or None where nothing is hidden."""
        return arrays.hidden_vertices(self.mesh)

    def mask(self):
        """Sculpt Mode's mask, float32 (n,); None in other modes and where there is none."""
        return arrays.sculpt_mask(self.mesh) if self.obj.mode == 'SCULPT' else None

    def weights(self, group_name):
        """Weights of a vertex group, float32 (n,). Raises Refused where there is no such group."""
        group = self.obj.vertex_groups.get(group_name)
        if group is None:
            raise Refused(tr("{object} has no vertex group {group}").format(object=self.obj.name, group=group_name))
        return arrays.group_weights(self.mesh, group.index)

    def write(self, positions, moved=None):
        """Put positions (n, 3) into the mesh and tag it.

        moved: indices of those that differ, in any order; all, if None.
        """
        flat = positions.reshape(-1)
        if self.key is None:
            arrays.set_positions(self.mesh, flat, moved)
        else:
            self._write_key(flat)
        self.mesh.update()

    def room(self):
        """Where all positions, float32 (n, 3), can be put at once, and then filled() be called; None where they cannot."""
        return arrays.own_positions(self.mesh) if self.key is None else None

    def filled(self):
        """What room() gave has been filled."""
        self.mesh.update()

    def finish(self):
        """Bring up to date what write() leaves for later."""

    def is_deformed(self):
        """Whether what is seen may stand elsewhere than the vertices that are written."""
        return self.key is not None or any(modifier.show_viewport for modifier in self.obj.modifiers)

    def evaluated_positions(self, depsgraph):
        """float32 (n, 3) of what is seen; None where modifiers have made other vertices of these."""
        depsgraph.update()
        seen = self.obj.evaluated_get(depsgraph).data
        if (len(seen.vertices), len(seen.loops)) != (len(self.mesh.vertices), len(self.mesh.loops)):
            return None
        return arrays.positions(seen)

    def follows_whole(self):
        """Whether all vertices follow, and what is written is the shape that pins are measured on."""
        mask = self.mask()
        has_mask = self.hidden() is not None or (mask is not None and mask.any())
        return not has_mask and (self.key is None or self.key == self.mesh.shape_keys.reference_key)

    def share_seen(self):
        """How much of what is written is seen: the value of a shape key."""
        keys = self.mesh.shape_keys
        is_whole = self.key is None or self.key == keys.reference_key or not keys.use_relative
        if is_whole or self.obj.show_only_shape_key:
            return 1.0
        return 0.0 if self.key.mute else self.key.value

    def _write_key(self, flat):
        key, keys = self.key, self.mesh.shape_keys
        if self._key_followers is None:
            # As Blender's own tools do: keys that are relative to this one go along, and so mean what they meant.
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
    """The shape keys that are relative to `leader`, or to one of those."""
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
    """The sentence on a shape key of which nothing is seen."""
    return tr("The shape key {key} is not seen, as its value is 0 or it is muted").format(key=key.name)


def nearest(positions, place, metric, hidden=None):
    """(index, distance) of the vertex nearest to `place`, in the space of the positions; measured by the metric."""
    away = (positions - np.asarray(place, np.float32)) @ np.asarray(metric, np.float32).T
    squares = np.einsum("ij,ij->i", away, away)
    squares[~np.isfinite(squares)] = np.inf
    if hidden is not None:
        squares[hidden] = np.inf
    index = int(squares.argmin())
    return index, float(np.sqrt(squares[index]))
