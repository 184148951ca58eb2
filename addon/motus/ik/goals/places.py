"""Read the world matrices of the targets, and the world positions of the poles, of a group's C chains from the evaluated scene.

Bones of the rig itself are taken from arrays of bones that are read anyway; all different objects are read by one call. World matrices
(C, 16) are stored column by column. The setting Blend passes a chain from its target (0) to its further targets (1, 2, ...).
"""

import math

from mathutils import Euler, Matrix

from ...core import rigs
from ...core.file import deleted
from ...core.file.pointers import pointed
from ...core.lazy import numpy as np
from ..reasons import NO_TARGET, NO_TARGET_BONE, NOT_FINITE, TARGET_DELETED
from . import blend_targets


class Others:
    """Targets or poles of chains that are not bones of the rig itself, but different objects or bones of different rigs; read together."""

    def __init__(self, goals, objects):
        """Note the objects to read. goals: Wired.targets or Wired.poles. objects: evaluated object or None for each of goals.other_rows."""
        pairs = [(row, one) for row, one in zip(goals.other_rows, objects) if one is not None]
        self.missing = [row for row, one in zip(goals.other_rows, objects) if one is None]
        self.rows, self.objects = [row for row, _ in pairs], [one for _, one in pairs]
        self._reader = rigs.WorldMatrixReader(self.objects)
        self._bones = [(row, one, goals.other_bones[row]) for row, one in pairs if row in goals.other_bones]

    def take(self, found, depsgraph, gone, lost):
        """Write the world matrices of these targets or poles into `found`, (C, 16).

        gone(row) is called for each chain whose object was deleted, lost(row) for each chain whose object lacks the bone.
        """
        if not self.rows:
            return
        matrices = self._reader.matrices(depsgraph)
        if matrices is None:
            for index in deleted.which(self.objects):
                gone(self.rows[index])
            matrices = rigs.world_matrices(self.objects)
        found[self.rows] = matrices
        for row, one, bone in self._bones:
            matrix = world_matrix(one, bone)
            if matrix is None:
                lost(row)
            else:
                found[row] = rigs.columns(matrix)


def read_targets(wired, others, posed, depsgraph, off):
    """World matrices (C, 16) of the targets of all C chains of a group. off: {row: reason} gets the chains whose target is missing."""
    found = wired.no_targets.copy()
    if wired.targets.has_own:
        _take_own(found, wired.targets, posed)
    others.take(found, depsgraph, lambda row: off.update({row: TARGET_DELETED}), lambda row: off.setdefault(row, NO_TARGET_BONE))
    for row in others.missing:
        off[row] = NO_TARGET
    if wired.targets.none:
        off.update(dict.fromkeys(wired.targets.none, NO_TARGET))
    return found


def _take_own(found, goals, posed):
    """Write the world matrices of those targets that are bones of the rig itself into `found`, (C, 16)."""
    rows, bones = goals.own
    # Stored column by column, matrices appear transposed here, so their product has the opposite order.
    matrices = posed.poses[bones].reshape(-1, 4, 4) @ posed.world.reshape(4, 4)
    found[rows] = matrices.reshape(-1, 16)


def world_matrix(target, bone=""):
    """World matrix of an evaluated object, or of its bone if a bone is named; None if the object lacks the bone.

    If the object has no bones at all, the name has no effect: it is left from an earlier target, and no panel shows it.
    """
    if not bone or target.pose is None:
        return target.matrix_world
    posed = target.pose.bones.get(bone)
    return target.matrix_world @ posed.matrix if posed else None


def blend(found, entries, further, off):
    """Replace the target of each entry whose Blend is above 0 by the further target to which Blend passes, or by a mixture of two.

    A missing target counts as the target before it. An entry whose first target is missing is switched off until its Blend has left
    that target. found: world matrices (C, 16) of the targets, changed in place. further: the entries' blend_targets.Further. off:
    {row: reason} of entries that are switched off, changed in place. Returns whether a Blend needs a further target that is missing.
    """
    is_astray = False
    for row, are_there in further.there().items():
        entry = entries[row]
        if entry.target_blend <= 0.0:
            continue
        if not math.isfinite(entry.target_blend):
            off[row] = NOT_FINITE
            continue
        places = [None if row in off else Matrix(found[row].reshape(4, 4).T), *_further_places(entry, are_there)]
        matrix, numbers = mixed(entry.target_blend, places)
        if matrix is None:
            continue
        off.pop(row, None)
        found[row] = rigs.columns(matrix)
        is_astray |= not entry.is_muted and None in [places[number] for number in numbers]
    return is_astray


def mixed(value, places):
    """Mix the targets of a chain by its setting Blend: (world matrix, numbers of the targets that are needed).

    value: of Blend; 0 is the target, 1, 2, ... are the further targets. The matrix is None if a needed target and all targets
    before it are missing. places: world matrices of the target and the further targets, None for a missing one.
    """
    numbers, share = blend_targets.needed(value, places)
    ends = [blend_targets.nearest(number, places) for number in numbers]
    return None if None in ends else _between(ends[0], ends[-1], share), numbers


def _further_places(entry, are_there):
    """World matrices of an entry's further targets; None for each that is missing or lacks its bone. are_there: whether each exists."""
    return [
        world_matrix(pointed(extra, "object"), extra.bone) if is_there else None for extra, is_there in zip(entry.extra_targets, are_there)
    ]


def _between(start, end, share):
    """Matrix at a share, 0 to 1, of the way from one matrix to a second one, without their scales.

    The place moves along a straight line; the orientation turns by the shorter way.
    """
    turned = start.to_quaternion().slerp(end.to_quaternion(), share)
    matrix = turned.to_matrix().to_4x4()
    matrix.translation = start.translation.lerp(end.translation, share)
    return matrix


def turn(targets, offsets, weights):
    """Apply the chains' rotation offsets to their targets, each in the target's own space, if the chain's rotation weight is not 0.

    targets: world matrices (C, 16), changed in place. offsets: Euler angles (C, 3), radians. weights: rotation weights (C,).
    """
    for row in np.flatnonzero(weights * np.abs(offsets).sum(axis=1)):
        turn = np.array(Euler(offsets[row].tolist()).to_matrix())
        axes = targets[row].reshape(4, 4)[:3]
        axes[:] = turn.T @ axes


def read_poles(wired, others, posed, depsgraph):
    """World positions (C, 3) of the poles of all C chains of a group; NaN for a chain that has no pole, or whose pole is missing."""
    goals = wired.poles
    if not goals.are_any:
        return wired.no_poles
    found = wired.no_poles.copy()
    if goals.has_own:
        rows, bones = goals.own
        heads = posed.poses[bones, 12:16] @ posed.world.reshape(4, 4)
        found[rows] = heads[:, :3]
    if others.rows:
        matrices, none = np.empty((len(found), 16)), []
        others.take(matrices, depsgraph, none.append, none.append)
        matrices[none] = np.nan
        found[others.rows] = matrices[others.rows, 12:15]
    return found
