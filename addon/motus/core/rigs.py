"""What solvers of bones read of a rig, as arrays; and plans that are made once and used for many frames.

A row is a bone, in the order of the rig's pose.
"""

import zlib
from collections import OrderedDict
from typing import Any, NamedTuple

from mathutils import Matrix

from . import copies, deleted
from .lazy import numpy as np
from .per_thread import kept
from .stored import Damaged
from .scratch import scratch

_INHERIT_SCALE = {"FULL": 0, "FIX_SHEAR": 1, "ALIGNED": 2, "AVERAGE": 3, "NONE": 4, "NONE_LEGACY": 5}
"""Bone.inherit_scale as motus::InheritScale; Blender's own numbers are others."""
INHERITS_ROTATION, HAS_LOCAL_LOCATION = 8, 16
LARGEST_CACHE = 64
LARGE_SCENE = 4  # objects for each target
LAID = "laid"
"""Key of Copy.found: {key: (rows, (n, 16) float32)}, see lay()."""

# How many objects a view layer had when they were last counted: only for the faster of two ways to the same answer.
_layer_sizes = {}
_LENDS_MEMORY = hasattr(Matrix, "__buffer__")  # Blender 5


class Still(NamedTuple):
    """What of a rig only an edit of its armature changes; a new fingerprint comes with that."""

    names: tuple
    places: Any       # for each row the place in Bone order, None where they are the same
    inheritance: Any  # (B,) int32: motus::InheritScale | INHERITS_ROTATION | HAS_LOCAL_LOCATION
    rest: Any         # as in Arrays
    lengths: Any      # (B,) float32
    bones: tuple      # bytes of what _at_rest() reads, in Bone order


class Arrays(NamedTuple):
    """One rig at one moment, in armature space; valid until the thread reads the next rig."""

    names: tuple
    rest: Any         # (B, 16) float32, column by column: Bone.matrix_local
    poses: Any        # (B, 16) float32: PoseBone.matrix, right for bones that stand already and were asked for
    basis: Any        # (B, 16) float32: PoseBone.matrix_basis, the animated transform
    lengths: Any      # as in Still
    inheritance: Any  # as in Still
    world: Any        # (16,) float64, column by column: the rig's matrix_world


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
    return _matrices("rest", bones, "matrix_local", count), lengths, np.array(list(map(_inheritance, bones)), np.int32)


def _inheritance(bone):
    return (_INHERIT_SCALE[bone.inherit_scale] | INHERITS_ROTATION * bone.use_inherit_rotation
            | HAS_LOCAL_LOCATION * bone.use_local_location)


def read(rig, known=None):
    """Arrays of an evaluated rig. known: its Still, where plan() has just given that."""
    known = known or still(rig, names_of(rig))
    return Arrays(
        known.names, known.rest, poses(rig, known), basis(rig, known), known.lengths, known.inheritance,
        columns(rig.matrix_world))


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
    """Arrays.basis alone: where a system lays poses over the bones, what it makes of them."""
    found = own_basis(rig, known)
    copy = copies.of(rig)
    for rows, matrices in list(copy.found.get(LAID, {}).values()) if copy else ():
        found[rows] = matrices
    return found


def own_basis(rig, known):
    """PoseBone.matrix_basis, as keys and drivers have it."""
    return _matrices("basis", rig.pose.bones, "matrix_basis", len(known.names))


def lay(rig, key, rows, matrices):
    """Note what the own transforms of some bones of an evaluated rig become, (n, 16) float32, until this is called again with the
    same key. For a system that lays poses; others wait for its solver."""
    copy = copies.of(rig)
    if copy is not None:
        # A new dictionary each time: other threads may go through the one that is there.
        copy.found[LAID] = copy.found.get(LAID, {}) | {key: (rows, matrices)}


def laid_bones(rig):
    """Names of the bones of an evaluated rig whose own transforms are other ones now by what lay() was told."""
    known = still(rig, names_of(rig))
    own = own_basis(rig, known).copy()
    return {known.names[row] for row in np.flatnonzero((basis(rig, known) != own).any(axis=1))}


def is_laid(copy):
    """Whether a system lays poses over bones of an evaluated rig's Copy."""
    return LAID in copy.found


def columns(matrix):
    """(16,) float64 of a mathutils.Matrix, column by column."""
    if _LENDS_MEMORY:  # which is in that order, and 'A' leaves it so
        return np.frombuffer(memoryview(matrix).tobytes('A'), np.float32).astype(float)
    x, y, z, place = matrix.copy().col  # a copy, since each look into an object's own matrix asks the object
    return np.array((*x, *y, *z, *place))


def standing(objects):
    """World matrices of evaluated objects, (n, 16) column by column."""
    if _LENDS_MEMORY:
        matrices = (memoryview(one.matrix_world).tobytes('A') for one in objects)
        return np.frombuffer(b"".join(matrices), np.float32).reshape(-1, 16)
    return np.array([columns(one.matrix_world) for one in objects])


def parents(rig, names):
    """Row of each bone's parent, -1 for none."""
    rows = {name: row for row, name in enumerate(names)}
    bones = rig.data.bones
    return [rows[bones[name].parent.name] if bones[name].parent else -1 for name in names]


def fingerprint(rig):
    """A number that changes when a bone is given another parent or row, or inherits otherwise."""
    lines = [f"{bone.name}\t{bone.parent.name if bone.parent else ''}\t{_inheritance(bone)}" for bone in rig.data.bones]
    lines += names_of(rig)
    return zlib.crc32("\n".join(lines).encode())


def plan(rig, key, make):
    """What `make(rig, rows)` gives, kept for the same `key` and bones; it has a Still as `still`. rows: name -> row.

    key: a string that stands for all that the plan is made of, the rig's fingerprint included. Kept by each thread for
    itself: a plan is not shared between threads.
    """
    if rig.pose is None or not isinstance(key, str):
        raise Damaged("no rig, or nothing that is known of it")
    plans = kept("plans", OrderedDict)
    place = key, rig.name, rig.library and rig.library.name
    found = plans.get(place)
    copy = copies.stamp_of_data(rig)
    if found is not None and copy and found.copy == copy:
        plans.move_to_end(place)
        return found
    if found is None or copy or not is_still(rig, found.still):
        # The key is what was wired; the rig may be one that was edited since.
        edited, names = fingerprint(rig), names_of(rig)
        if found is not None and found.edited == edited:
            found.still = still(rig, names)
        else:
            found = plans[place] = make(rig, {name: row for row, name in enumerate(names)})
            found.edited = edited
            if len(plans) > LARGEST_CACHE:
                plans.popitem(last=False)
    found.copy = copy
    plans.move_to_end(place)
    return found


def source(rig, key, make, read):
    """What `read(rig, plan)` makes of an evaluated rig and of plan(rig, key, make): kept for as long as Blender keeps these copies
    of the rig and of its armature; where the armature's cannot be told apart, for as long as its bones stay what they are."""
    copy, armature = copies.of(rig), rig.data and copies.stamp_of_data(rig)
    place = "source", key
    found = None if copy is None else copy.found.get(place)
    if found is None or found.armature != armature or armature is None and not is_still(rig, found.still):
        planned = plan(rig, key, make)
        found = _Source(armature, planned.still, read(rig, planned))
        if copy is not None:
            copy.found[place] = found
    return found.made


class _Source(NamedTuple):
    """What source() keeps. armature: its stamp. still: of the plan."""

    armature: Any
    still: Any
    made: Any


class Standing:
    """Where evaluated objects stand that an evaluated copy names, all of them read by one call."""

    def __init__(self, objects):
        self._objects = objects
        self._every = self._rows = self._room = self._scene = None

    def matrices(self, depsgraph):
        """World matrices, (n, 16) float32 column by column; None: they are to be asked one by one.

        So it is where one of the objects is not in the evaluated view layer, and where that has a great many others.
        """
        # Which objects stand in a view layer is part of the scene's own copy.
        scene, view_layer = copies.of(depsgraph.scene_eval), depsgraph.view_layer_eval
        if scene is None or scene is not self._scene:
            self._look(view_layer)
            self._scene = scene
        if self._rows is None:
            return None
        view_layer.objects.foreach_get("matrix_world", self._room)
        return self._room.reshape(-1, 16).take(self._rows, axis=0)

    def _look(self, view_layer):
        layer = view_layer.id_data.name, view_layer.name
        deleted.which(self._objects)  # from now on it is known when one of them is deleted
        most = LARGE_SCENE * len(self._objects)
        if _layer_sizes.get(layer, 0) <= most:
            # What is compared is where evaluated data lies in memory.
            every = list(map(hash, view_layer.objects.values()))
            _layer_sizes[layer] = len(every)
            if len(every) <= most:
                if every != self._every:
                    self._find(every)
                return
        self._every = self._rows = None

    def _find(self, every):
        rows, wanted = {mark: row for row, mark in enumerate(every)}, list(map(hash, self._objects))
        is_there = all(mark in rows for mark in wanted)
        self._rows = np.array([rows[mark] for mark in wanted]) if is_there else None
        self._room = np.empty(16 * len(every), np.float32)
        self._every = every


def _matrices(name, collection, attribute, count):
    found = scratch("rig_" + name, (count, 16), np.float32)
    collection.foreach_get(attribute, found.ravel())
    return found
