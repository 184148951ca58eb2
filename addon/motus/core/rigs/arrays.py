"""What solvers of bones read of a rig, as arrays. A row is a bone, in the order of the rig's pose."""

from typing import Any, NamedTuple

from mathutils import Matrix

from .. import keeping
from ..evaluated import copies
from ..evaluated.per_thread import scratch
from ..lazy import numpy as np

_INHERIT_SCALE = {"FULL": 0, "FIX_SHEAR": 1, "ALIGNED": 2, "AVERAGE": 3, "NONE": 4, "NONE_LEGACY": 5}
"""Bone.inherit_scale as motus::InheritScale; Blender's own numbers are others."""

INHERITS_ROTATION, HAS_LOCAL_LOCATION = 8, 16

_LAID = keeping.OfEvaluation(
    "transforms that a system lays over a rig's bones: {key: (rows, (n, 16) float32)}, see lay()", "the rig", "one for each rig"
)

LENDS_MEMORY = hasattr(Matrix, "__buffer__")  # Blender 5


class Still(NamedTuple):
    """The part of a rig that only edits of its armature change: names, rest pose, lengths, inheritance."""

    names: tuple
    places: Any  # for each row the place in Bone order, None where they are the same
    inheritance: Any  # (B,) int32: motus::InheritScale | INHERITS_ROTATION | HAS_LOCAL_LOCATION
    rest: Any  # as in Arrays
    lengths: Any  # (B,) float32
    bones: tuple  # bytes of what _at_rest() reads, in Bone order


class Arrays(NamedTuple):
    """One rig at one moment, in armature space; valid until the thread reads the next rig."""

    names: tuple
    rest: Any  # (B, 16) float32, column by column: Bone.matrix_local
    poses: Any  # (B, 16) float32: PoseBone.matrix, right for bones that stand already and were asked for
    basis: Any  # (B, 16) float32: PoseBone.matrix_basis, the animated transform
    lengths: Any  # as in Still
    inheritance: Any  # as in Still
    world: Any  # (16,) float64, column by column: the rig's matrix_world


def names_of(rig):
    """Names of the bones, row by row."""
    return tuple(rig.pose.bones.keys())


def still(rig, names):
    """The Still of a rig."""
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
    """Whether the rig's bones are those of a Still: as many, each as it was at rest and inheriting what it did.

    Cheaper than to compare names; a bone that is only renamed keeps its row.
    """
    bones, count = rig.data.bones, len(known.names)
    # foreach_get says nothing where the array is longer than need be.
    return len(bones) == count and tuple(array.tobytes() for array in _at_rest(bones, count)) == known.bones


def _at_rest(bones, count):
    lengths = scratch("rig_lengths", (count,), np.float32)
    bones.foreach_get("length", lengths)
    # One by one: in 3.4 foreach_get takes something else for a bone's inherit_scale.
    return _matrices("rest", bones, "matrix_local", count), lengths, np.array(list(map(inheritance, bones)), np.int32)


def inheritance(bone):
    """How a bone inherits from its parent: motus::InheritScale with the flags above."""
    return _INHERIT_SCALE[bone.inherit_scale] | INHERITS_ROTATION * bone.use_inherit_rotation | HAS_LOCAL_LOCATION * bone.use_local_location


def read(rig, known=None):
    """Arrays of an evaluated rig. known: its Still, where plan() has just given that."""
    known = known or still(rig, names_of(rig))
    return Arrays(
        known.names, known.rest, poses(rig, known), basis(rig, known), known.lengths, known.inheritance, columns(rig.matrix_world)
    )


FEW = 5
"""A bone's pose that is asked for by itself takes as long as so many that are read by one call."""


def poses(rig, known, rows=None):
    """Arrays.poses alone. rows: a list of the only ones that are needed, others may be anything; None for all."""
    pose, count = rig.pose.bones, len(known.names)
    if rows is None or FEW * len(rows) > count:
        return _matrices("poses", pose, "matrix", count)
    found = scratch("rig_few_poses", (count, 16), np.float32)
    for row in rows:
        found[row] = columns(pose[known.names[row]].matrix)
    return found


def basis(rig, known):
    """Arrays.basis alone: the bones' own transforms, after systems that lay poses over the bones."""
    found = own_basis(rig, known)
    for rows, matrices in _LAID.on(copies.of(rig)).get("laid", {}).values():
        found[rows] = matrices
    return found


def own_basis(rig, known):
    """PoseBone.matrix_basis, as keys and drivers have it."""
    return _matrices("basis", rig.pose.bones, "matrix_basis", len(known.names))


def lay(rig, key, rows, matrices):
    """Note what the own transforms of some bones of an evaluated rig become, (n, 16) float32.

    For a system that lays poses; others wait for its solver. The note stands until this is called again with the same key.
    """
    kept = _LAID.on(copies.of(rig))
    # A new dictionary each time: other threads may go through the one that is there.
    kept["laid"] = kept.get("laid", {}) | {key: (rows, matrices)}


def laid_bones(rig):
    """Names of the bones of an evaluated rig whose own transforms are other ones now by what lay() was told."""
    known = still(rig, names_of(rig))
    own = own_basis(rig, known).copy()
    return {known.names[row] for row in np.flatnonzero((basis(rig, known) != own).any(axis=1))}


def is_laid(copy):
    """Whether a system lays poses over bones of an evaluated rig's Copy."""
    return bool(_LAID.on(copy))


def columns(matrix):
    """(16,) float64 of a mathutils.Matrix, column by column."""
    if LENDS_MEMORY:  # which is in that order, and 'A' leaves it so
        return np.frombuffer(memoryview(matrix).tobytes('A'), np.float32).astype(float)
    x, y, z, place = matrix.copy().col  # a copy, since each look into an object's own matrix asks the object
    return np.array((*x, *y, *z, *place))


def parents(rig, names):
    """Row of each bone's parent, -1 for none."""
    rows = {name: row for row, name in enumerate(names)}
    bones = rig.data.bones
    return [rows[bones[name].parent.name] if bones[name].parent else -1 for name in names]


def _matrices(name, collection, attribute, count):
    found = scratch("rig_" + name, (count, 16), np.float32)
    collection.foreach_get(attribute, found.ravel())
    return found
