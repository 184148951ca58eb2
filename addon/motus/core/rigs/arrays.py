"""Bones of a rig as arrays for solvers. A row is a bone; rows are in the order of Object.pose.bones."""

from typing import Any, NamedTuple

from mathutils import Matrix

from .. import keeping
from ..evaluated import copies
from ..evaluated.per_thread import scratch
from ..lazy import numpy as np

INHERIT_SCALE = {"FULL": 0, "FIX_SHEAR": 1, "ALIGNED": 2, "AVERAGE": 3, "NONE": 4, "NONE_LEGACY": 5}
"""Bone.inherit_scale as the native module's motus::InheritScale, whose numbers differ from Blender's."""

INHERITS_ROTATION, HAS_LOCAL_LOCATION = 8, 16

_LAID = keeping.OfEvaluation(
    "transforms that systems lay over a rig's bones: {key: (rows, (n, 16) float32)}, written by lay()",
    "the evaluated rig",
    "one for each rig",
)

LENDS_MEMORY = hasattr(Matrix, "__buffer__")  # mathutils.Matrix has the buffer protocol from Blender 5 on


class Still(NamedTuple):
    """The part of a rig that only edits of its armature change: names, rest pose, lengths and inheritance of the bones."""

    names: tuple
    places: Any  # (B,): for each row the bone's index in Armature.bones; None if the pose has this order too
    inheritance: Any  # (B,) int32: motus::InheritScale | INHERITS_ROTATION | HAS_LOCAL_LOCATION
    rest: Any  # (B, 16) float32, column by column: Bone.matrix_local
    lengths: Any  # (B,) float32
    bones: tuple  # bytes of the arrays that _at_rest() reads, in the order of Armature.bones


class Arrays(NamedTuple):
    """Data that solvers read of one rig at one moment, as arrays with a row for each bone; poses and rest pose are in armature space.

    Arrays share memory between rigs: they are valid until the same thread reads the next rig.
    """

    names: tuple
    rest: Any  # (B, 16) float32, column by column: Bone.matrix_local
    poses: Any  # (B, 16) float32: PoseBone.matrix, right only for bones that Blender has already evaluated
    basis: Any  # (B, 16) float32: PoseBone.matrix_basis, the animated transform
    lengths: Any  # (B,) float32: Bone.length
    inheritance: Any  # (B,) int32, the flags of inheritance()
    world: Any  # (16,) float64, column by column: the rig's matrix_world


def names_of(rig):
    """Names of a rig's bones in the order of its pose, which is the order of the rows."""
    return tuple(rig.pose.bones.keys())


def still(rig, names):
    """Read the Still of a rig: everything that changes only if the armature is edited. names: names of the bones, row by row."""
    bones = rig.data.bones
    order = bones.keys()
    places = None
    if list(names) != order:  # bones that were added later stand at the end of the pose
        rows = {name: row for row, name in enumerate(order)}
        places = np.array([rows[name] for name in names])
    rest, lengths, inheritance = (array.copy() for array in _at_rest(bones, len(names)))
    as_bytes = tuple(array.tobytes() for array in (rest, lengths, inheritance))
    if places is not None:
        rest, lengths, inheritance = rest[places], lengths[places], inheritance[places]
    return Still(names, places, inheritance, rest, lengths, as_bytes)


def is_still(rig, known):
    """Whether a rig's bones match a Still: number of bones, rest matrices, lengths and inheritance from the parent.

    Bone names are not compared, which is slower and not needed: a renamed bone keeps its row.
    """
    bones, count = rig.data.bones, len(known.names)
    # foreach_get does not raise if the array is longer than the data.
    return len(bones) == count and tuple(array.tobytes() for array in _at_rest(bones, count)) == known.bones


def _at_rest(bones, count):
    lengths = scratch("rig_lengths", (count,), np.float32)
    bones.foreach_get("length", lengths)
    # One by one: in Blender 3.4 foreach_get reads wrong values for Bone.inherit_scale.
    return _matrices("rest", bones, "matrix_local", count), lengths, np.array(list(map(inheritance, bones)), np.int32)


def inheritance(bone):
    """Bit field of how a Bone inherits from its parent, for the native module.

    The number of motus::InheritScale, with the flags INHERITS_ROTATION and HAS_LOCAL_LOCATION.
    """
    return INHERIT_SCALE[bone.inherit_scale] | INHERITS_ROTATION * bone.use_inherit_rotation | HAS_LOCAL_LOCATION * bone.use_local_location


def read(rig, known=None):
    """Read the Arrays of an evaluated rig: rest pose, poses, own transforms and world matrix.

    known: the rig's current Still (the part that only edits of the armature change), for example from plan(); None reads the Still too.
    """
    known = known or still(rig, names_of(rig))
    return Arrays(
        known.names, known.rest, poses(rig, known), basis(rig, known), known.lengths, known.inheritance, columns(rig.matrix_world)
    )


FEW = 60
"""To read one pose by itself takes as long as to read at least this many poses by one foreach_get, in all versions of Blender."""


class Reader:
    """Reads poses and own transforms of the bones of one evaluated rig, at every frame into the same arrays.

    rig: evaluated. copy: the rig's Copy (core/evaluated/copies.py). known: the rig's Still.
    """

    def __init__(self, rig, copy, known):
        self._rig, self._copy, self._names = rig, copy, known.names
        self._poses, self._basis = (np.empty((len(known.names), 16), np.float32) for _ in range(2))
        self._flat_poses, self._flat_basis = self._poses.reshape(-1), self._basis.reshape(-1)

    def poses(self, rows=None):
        """Pose matrices (PoseBone.matrix) of the bones in armature space, (B, 16) float32, column by column.

        rows: list of the rows that are needed; the values of the remaining rows are then undefined. None reads all rows.
        """
        bones = self._rig.pose.bones
        if rows is None or FEW * len(rows) > len(self._names):
            bones.foreach_get("matrix", self._flat_poses)
        else:
            for row in rows:
                self._poses[row] = columns(bones[self._names[row]].matrix)
        return self._poses

    def basis(self):
        """Own transforms of all bones, (B, 16) float32: PoseBone.matrix_basis, or the transforms that lay() has stored for some bones."""
        return _lay_over(self.own_basis(), self._copy)

    def own_basis(self):
        """PoseBone.matrix_basis of all bones, (B, 16) float32, as keys and drivers set it, without the transforms that lay() has stored."""
        self._rig.pose.bones.foreach_get("matrix_basis", self._flat_basis)
        return self._basis


def poses(rig, known):
    """Pose matrices (PoseBone.matrix) of the bones in armature space, (B, 16) float32, column by column. known: the rig's Still."""
    return _matrices("poses", rig.pose.bones, "matrix", len(known.names))


def basis(rig, known):
    """Own transforms of all bones, (B, 16) float32: PoseBone.matrix_basis, or the transforms that lay() has stored for some bones."""
    return _lay_over(own_basis(rig, known), copies.of(rig))


def scaled(basis, rows, scales):
    """Own transforms (B, 16) of bones, those in k rows scaled by (k, 3) along the bones' own axes; the same array without scales."""
    if scales is None:
        return basis
    found, factors = basis.copy(), np.ones((len(rows), 4, 1), np.float32)
    factors[:, :3, 0] = scales
    found[rows] = (found[rows].reshape(-1, 4, 4) * factors).reshape(-1, 16)
    return found


def _lay_over(found, copy):
    """Replace rows of `found`, own transforms (B, 16), by the transforms that lay() has stored for them. copy: the rig's Copy."""
    laid = _LAID.on(copy)
    if laid:
        for rows, matrices in laid["laid"].values():
            found[rows] = matrices
    return found


def own_basis(rig, known):
    """PoseBone.matrix_basis of all bones, (B, 16) float32, as keys and drivers set it, without the transforms that lay() has stored."""
    return _matrices("basis", rig.pose.bones, "matrix_basis", len(known.names))


def lay(copy, key, rows, matrices):
    """Store transforms that replace the own transforms (matrix_basis) of some bones of an evaluated rig, for solvers that run later.

    copy: the rig's Copy (core/evaluated/copies.py). rows: rows of these bones. matrices: (n, 16) float32, column by column. key: name of
    the caller's layer of transforms; a later call with the same key replaces the transforms of the earlier call. Only for systems that
    lay poses (System.lays_pose): all solvers of different systems on the rig run after the solvers of such systems.
    """
    kept = _LAID.on(copy)
    # A new dictionary each time, since other threads may iterate over the present one.
    kept["laid"] = kept.get("laid", {}) | {key: (rows, matrices)}


def laid_bones(rig):
    """Names of the bones of an evaluated rig whose own transforms (matrix_basis) are changed by transforms that lay() has stored."""
    known = still(rig, names_of(rig))
    own = own_basis(rig, known).copy()
    return {known.names[row] for row in np.flatnonzero((basis(rig, known) != own).any(axis=1))}


def is_laid(copy):
    """Whether lay() has stored transforms for bones of an evaluated rig. copy: the rig's Copy (core/evaluated/copies.py)."""
    return bool(_LAID.on(copy))


def bytes_of(matrix):
    """The bytes of a 4 x 4 mathutils.Matrix, which differ if its numbers do."""
    return memoryview(matrix).tobytes('A') if LENDS_MEMORY else columns(matrix).tobytes()


def world(rig):
    """The rig's matrix_world as native functions take it: a mathutils.Matrix if it lends its memory, else (16,) float64."""
    return rig.matrix_world if LENDS_MEMORY else columns(rig.matrix_world)


def columns(matrix):
    """The numbers of a 4 x 4 mathutils.Matrix, column by column, (16,) float64."""
    if LENDS_MEMORY:  # Blender stores a matrix column by column, and 'A' keeps that order
        return np.frombuffer(memoryview(matrix).tobytes('A'), np.float32).astype(float)
    x, y, z, place = matrix.copy().col  # a copy, since each access to a row of an object's matrix reads the matrix from the object again
    return np.array((*x, *y, *z, *place))


def parents(rig, names):
    """List of the row of each bone's parent, -1 for a bone without a parent. names: names of the bones, row by row."""
    rows = {name: row for row, name in enumerate(names)}
    bones = rig.data.bones
    return [rows[bones[name].parent.name] if bones[name].parent else -1 for name in names]


def _matrices(name, collection, attribute, count):
    found = scratch("rig_" + name, (count, 16), np.float32)
    collection.foreach_get(attribute, found.ravel())
    return found
