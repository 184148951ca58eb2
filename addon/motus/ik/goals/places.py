"""Read the world matrices of the targets, and the world positions of the poles, of a group's C chains from the evaluated scene.

Bones of the rig itself are taken from arrays of bones that are read anyway; all different objects are read by one call. World matrices
(C, 16) are stored column by column. The setting Blend passes a chain from its target (0) to its further targets (1, 2, ...).
"""

import math

from mathutils import Euler, Matrix

from ...core import native, rigs
from ...core.file.pointers import pointed
from ...core.lazy import numpy as np
from ..reasons import NO_TARGET, NO_TARGET_BONE, NOT_FINITE, TARGET_DELETED
from . import blend_targets


class Places:
    """Reads the targets and poles of a group's C chains from one evaluated copy of a rig. entries: evaluated, one for each chain."""

    def __init__(self, wired, entries):
        targets, poles = (
            [(row, pointed(entries[row], name)) for row in goals.other_rows]
            for name, goals in (("target", wired.targets), ("pole", wired.poles))
        )
        self._missing = {row: NO_TARGET for row, one in targets if one is None} | dict.fromkeys(wired.targets.none, NO_TARGET)
        targets, poles = ([(row, one) for row, one in pairs if one is not None] for pairs in (targets, poles))
        self._rows = [row for row, _ in targets]
        objects = [one for _, one in (*targets, *poles)]
        self._reader = rigs.WorldMatrixReader(objects)
        bones = [goals.other_bones.get(row) for goals, pairs in ((wired.targets, targets), (wired.poles, poles)) for row, _ in pairs]
        self._bones = [(index, objects[index], bone) for index, bone in enumerate(bones) if bone]
        self._targets = _goals(len(entries), wired.targets, targets, 0)
        self._poles = _goals(len(entries), wired.poles, poles, len(targets)) if wired.poles.are_any else None
        self._no_poles = np.full((len(entries), 3), np.nan)

    def read(self, posed, depsgraph):
        """Return (world matrices of the targets (C, 16), world positions of the poles (C, 3), {row of a chain without a target: reason}).

        A pole is NaN if the chain has none, or if it is missing. posed: reading.Posed of the rig.
        """
        off = self._missing.copy()
        gone = self._reader.read(depsgraph)
        things = self._reader.found
        for index in gone:
            self._leave_out(index, TARGET_DELETED, off)
        for index, one, bone in self._bones:
            matrix = world_matrix(one, bone)
            if matrix is None:
                self._leave_out(index, NO_TARGET_BONE, off)
            elif index not in gone:
                things[index] = rigs.columns(matrix)
        targets = self._targets.matrices(*posed, things)
        return targets, self._no_poles if self._poles is None else self._poles.points(*posed, things), off

    def _leave_out(self, index, reason, off):
        if index < len(self._rows):
            off.setdefault(self._rows[index], reason)
        else:
            self._reader.found[index] = np.nan


def _goals(count, goals, others, first):
    """The native RigGoals for the targets or poles of a group's chains.

    goals: Wired.targets or Wired.poles. others: (row of the chain, object) of those that are no bones of the rig itself; the first of them
    has the row `first` in the array of the objects' matrices.
    """
    return native.module.RigGoals(count, np.stack(goals.own, axis=1), [(row, first + index) for index, (row, _) in enumerate(others)])


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
