"""Where targets and poles of a group's entries are: world matrices and places, read from the evaluated scene.

Bones of the rig itself are taken from the arrays that are there already, other objects are read by one call.
"""

import math

from mathutils import Euler, Matrix

from ...core import rigs
from ...core.file import deleted
from ...core.file.pointers import pointed
from ...core.lazy import numpy as np
from ..reasons import NO_TARGET, NO_TARGET_BONE, NOT_FINITE, TARGET_DELETED
from . import stations


class Others:
    """Targets or poles of chains that are not bones of the rig itself: other objects and bones of other rigs, read together."""

    def __init__(self, goals, objects):
        """goals: as wired. objects: evaluated, one for each of the goals' other rows, or None."""
        pairs = [(row, one) for row, one in zip(goals.other_rows, objects) if one is not None]
        self.missing = [row for row, one in zip(goals.other_rows, objects) if one is None]
        self.rows, self.objects = [row for row, _ in pairs], [one for _, one in pairs]
        self._standing = rigs.Standing(self.objects)
        self._bones = [(row, one, goals.other_bones[row]) for row, one in pairs if row in goals.other_bones]

    def take(self, found, depsgraph, gone, lost):
        """Fill in world matrices (C, 16). gone(row): called for objects that were deleted; lost(row): for bones that are not there."""
        if not self.rows:
            return
        matrices = self._standing.matrices(depsgraph)
        if matrices is None:
            for index in deleted.which(self.objects):
                gone(self.rows[index])
            matrices = rigs.standing(self.objects)
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
    """Fill in world matrices of bones of the rig itself."""
    rows, bones = goals.own
    # Column by column, a matrix reads as its transpose.
    matrices = posed.poses[bones].reshape(-1, 4, 4) @ posed.world.reshape(4, 4)
    found[rows] = matrices.reshape(-1, 16)


def world_matrix(target, bone=""):
    """World matrix of an evaluated object or its bone; None where it has no such bone.

    Of an object without bones the name counts for nothing: it is left from an earlier target, and no panel shows it.
    """
    if not bone or target.pose is None:
        return target.matrix_world
    posed = target.pose.bones.get(bone)
    return target.matrix_world @ posed.matrix if posed else None


def blend(found, entries, further, off):
    """Replace the target of each entry whose Blend is between two stations by the mixture of both.

    One that is missing counts as the one before it.

    An entry whose own target is missing is off until its blend has left that. Returns whether another one is missing.
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
    """(matrix at a Blend's value between stations, or None if a station is missing; numbers of the stations that it needs)."""
    numbers, share = stations.needed(value, places)
    ends = [stations.nearest(number, places) for number in numbers]
    return None if None in ends else _between(ends[0], ends[-1], share), numbers


def _further_places(entry, are_there):
    """World matrices of an entry's further targets, None for those that are missing, or whose bone is."""
    return [
        world_matrix(pointed(extra, "object"), extra.bone) if is_there else None for extra, is_there in zip(entry.extra_targets, are_there)
    ]


def _between(start, end, share):
    """Matrix between two: place by a straight line, orientation by the shorter way; without their scales."""
    turned = start.to_quaternion().slerp(end.to_quaternion(), share)
    matrix = turned.to_matrix().to_4x4()
    matrix.translation = start.translation.lerp(end.translation, share)
    return matrix


def turn(targets, offsets, weights):
    """Apply rotation offsets in the targets' own space, where an orientation is taken."""
    for row in np.flatnonzero(weights * np.abs(offsets).sum(axis=1)):
        turn = np.array(Euler(offsets[row].tolist()).to_matrix())
        axes = targets[row].reshape(4, 4)[:3]
        axes[:] = turn.T @ axes


def read_poles(wired, others, posed, depsgraph):
    """(C, 3) places in the world; NaN where there is no pole."""
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
