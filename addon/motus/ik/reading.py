"""What native IkPlan needs, read from an evaluated rig: its arrays, the entries' settings, targets, poles and limits.

It runs at every frame, so numbers of all entries are read by one call each, and bones of the rig itself are taken from
the arrays that are there already.
"""

import json
from typing import Any, NamedTuple

from mathutils import Euler

from ..core import native, rigs
from ..core.lazy import numpy as np
from .groups import OUTPUTS

# Values of the output "reason" beside native.Reason's own.
NOT_FINITE, NO_TARGET, TARGET_DELETED, NO_TARGET_BONE, MUTED = -1.0, -2.0, -3.0, -4.0, -5.0
UNWANTED = (NOT_FINITE, NO_TARGET, TARGET_DELETED, NO_TARGET_BONE)

_DTYPES = {"iterations": "i4", "use_limits": "?", "is_muted": "?"}
_FILLED_IN = {"is_on", "bend"}


class RigChanged(Exception):
    """The rig has not all bones that were wired: it was edited, and will be wired again."""


class Wired:
    """A group as it was wired, with rows of bones in the rig's arrays."""

    def __init__(self, rig, rows, text):
        known = json.loads(text)
        chains = known["chains"]
        try:
            bones = [[rows[name] for name in chain["bones"]] for chain in chains]
            effectors = [rows[chain["effector"]] for chain in chains]
            guards = [(rows[name], chain) for name, chain in known["guards"]]
        except KeyError as error:
            raise RigChanged from error
        self.still = rigs.still(rig, tuple(rows))
        self.names = [chain["name"] for chain in chains]
        self.stretches = np.array([chain["stretches"] for chain in chains])
        self.is_blended = any(chain["extras"] for chain in chains)
        self.all_bones = np.array([row for chain in bones for row in chain])
        self.targets = _Goals(rows, chains, "target")
        self.poles = _Goals(rows, chains, "pole")
        self.with_pole = [row for row, chain in enumerate(chains) if chain["pole"]]
        report = native.module.IkPlan.REPORT
        self.told = [report.index(name) for name in OUTPUTS]  # columns of the report
        self.plan = native.module.IkPlan(rigs.parents(rig, list(rows)), bones, effectors, guards)


class _Goals:
    """Targets or poles: `own` are (entries, bones of the rig) as arrays; of the others the bones by entry, if any."""

    def __init__(self, rows, chains, key):
        found = [(index, chain[key], chain[key + "_bone"]) for index, chain in enumerate(chains)]
        own = [(index, rows[bone]) for index, where, bone in found if where == 'OWN' and bone in rows]
        self.own = np.array(own, dtype=int).reshape(-1, 2).T
        mine = {index for index, _ in own}
        self.other_rows = [index for index, where, _ in found if where and index not in mine]
        self.other_bones = {index: bone for index, where, bone in found if bone and where and index not in mine}
        self.none = [index for index, where, _ in found if not where]


class Gathered(NamedTuple):
    """Arguments of IkPlan.solve and IkPlan.match, and what keeps an entry from them.

    reasons: (C,) 0, or why an entry is switched off: NO_TARGET and the like. is_stiff: whether one should stretch, but
    was wired when it could not.
    """

    wired: Wired
    rig: rigs.Arrays
    settings: Any
    targets: Any
    poles: Any
    limits: Any
    reasons: Any
    is_stiff: bool


def gather(rig, text, depsgraph):
    """Read an evaluated rig. text: what groups.py noted of the group. Raises RigChanged."""
    wired = rigs.plan(rig, rigs.names_of(rig), text, lambda rig, rows: Wired(rig, rows, text))
    arrays = rigs.read(rig, wired.still)
    settings = rig.motus.ik
    places = _places(settings.entries, wired.names)
    reasons = np.zeros(len(wired.names))
    numbers = _settings(settings, places, wired)
    columns = {name: numbers[:, index] for index, name in enumerate(native.module.IkPlan.SETTINGS)}
    # The sinks of a chain that was wired without stretch cannot lengthen a bone.
    is_stiff = bool(columns["stretch"][~wired.stretches].any())
    columns["stretch"] *= wired.stretches
    entries = list(settings.entries)
    if places is not None:
        entries = [entries[place] for place in places]
    weights = columns["rotation_weight"]
    presence = rigs.Presence(depsgraph.view_layer, depsgraph.scene)
    targets = _targets(entries, wired, arrays, weights, presence, reasons)
    if weights.any():
        _turn(targets, _column(settings.entries, "rotation_offset", places, 3), weights)
    reasons[_column(settings.entries, "is_muted", places)] = MUTED
    columns["is_on"][:] = reasons == 0.0
    columns["bend"][:] = 1.0
    for row in wired.with_pole:
        # Blenders before 5 do not give enums by foreach_get.
        if entries[row].bend == 'AWAY':
            columns["bend"][row] = -1.0
    poles = _poles(entries, wired, arrays, presence)
    limits = _limits(rig, wired) if columns["use_limits"].any() else None
    return Gathered(wired, arrays, numbers, targets, poles, limits, reasons, is_stiff)


def _places(entries, names):
    """Index of each of the group's entries among all; None where they are the same."""
    keys = entries.keys()
    if keys == names:
        return None
    if not set(names) <= set(keys):
        raise RigChanged
    return [keys.index(name) for name in names]


def _settings(settings, places, wired):
    """(C, len(IkPlan.SETTINGS)) float64; is_on and bend are left to be filled in."""
    names = native.module.IkPlan.SETTINGS
    numbers = np.empty((len(wired.names), len(names)))
    for index, name in enumerate(names):
        if name not in _FILLED_IN:
            numbers[:, index] = _column(settings.entries, name, places)
    if settings.influence != 1.0:
        for name in ("position_weight", "rotation_weight"):
            numbers[:, names.index(name)] *= settings.influence
    return numbers


def _column(entries, name, places, size=1):
    dtype = _DTYPES.get(name, "f4")
    found = np.empty(len(entries) * size, dtype)
    entries.foreach_get(name, found)
    if size > 1:
        found = found.reshape(-1, size)
    return found if places is None else found[places]


def _targets(entries, wired, arrays, weights, presence, reasons):
    """(C, 16) world matrices; only their places where no orientation is taken."""
    found = np.zeros((len(entries), 16))
    found[:, 0] = found[:, 5] = found[:, 10] = found[:, 15] = 1.0
    _take_own(found, wired.targets, arrays)
    _take_others(found, entries, wired, weights, presence, reasons)
    reasons[wired.targets.none] = NO_TARGET
    if wired.is_blended:
        _blend(found, entries, presence)
    return found


def _take_others(found, entries, wired, weights, presence, reasons):
    """Fill in world matrices of targets that are no bones of the rig."""
    rows = wired.targets.other_rows
    targets = [entries[row].target for row in rows]
    if None in targets:
        reasons[[row for row, target in zip(rows, targets) if target is None]] = NO_TARGET
        rows = [row for row, target in zip(rows, targets) if target]
        targets = [target for target in targets if target]
    for index in presence.deleted(targets):
        reasons[rows[index]] = TARGET_DELETED
    if not rows:
        return
    found[rows, 12:15] = [target.matrix_world.translation.to_tuple() for target in targets]
    bones = wired.targets.other_bones
    is_turned = weights.any()
    for row, target in zip(rows, targets) if bones or is_turned else ():
        if row in bones or weights[row]:
            matrix = world_matrix(target, bones.get(row, ""))
            if matrix is None:
                reasons[row] = reasons[row] or NO_TARGET_BONE
            else:
                found[row] = rigs.columns(matrix)


def _take_own(found, goals, arrays):
    """Fill in world matrices of bones of the rig itself."""
    rows, bones = goals.own
    if len(rows):
        # Column by column, a matrix reads as its transpose.
        posed = arrays.poses[bones].reshape(-1, 4, 4) @ arrays.world.reshape(4, 4)
        found[rows] = posed.reshape(-1, 16)


def world_matrix(target, bone=""):
    """World matrix of an evaluated object or its bone; None where it has no such bone."""
    if not bone:
        return target.matrix_world
    posed = target.pose and target.pose.bones.get(bone)
    return target.matrix_world @ posed.matrix if posed else None


def _blend(found, entries, presence):
    """Replace targets by the mixture of two of them, where an entry's blend says so."""
    from mathutils import Matrix
    for row, entry in enumerate(entries):
        if entry.target_blend <= 0.0 or not entry.extra_targets:
            continue
        stations = [Matrix(found[row].reshape(4, 4).T)]
        for extra in entry.extra_targets:
            is_there = extra.object and not presence.is_deleted(extra.object)
            # One that is gone leaves the chain where it was before.
            stations.append(is_there and world_matrix(extra.object, extra.bone) or stations[-1])
        share = min(entry.target_blend, len(stations) - 1.0)
        first = min(int(share), len(stations) - 2)
        found[row] = rigs.columns(mixed(stations[first], stations[first + 1], share - first))


def mixed(start, end, share):
    """Matrix between two: place by a straight line, orientation by the shorter way; without their scales."""
    from mathutils import Matrix
    turned = start.to_quaternion().slerp(end.to_quaternion(), share)
    matrix = turned.to_matrix().to_4x4()
    matrix.translation = start.translation.lerp(end.translation, share)
    return matrix


def _turn(targets, offsets, weights):
    """Apply rotation offsets in the targets' own space, where an orientation is taken."""
    for row in np.flatnonzero(weights * np.abs(offsets).sum(axis=1)):
        turn = np.array(Euler(offsets[row].tolist()).to_matrix())
        axes = targets[row].reshape(4, 4)[:3]
        axes[:] = turn.T @ axes


def _poles(entries, wired, arrays, presence):
    """(C, 3) places in the world; NaN where there is no pole."""
    found = np.full((len(entries), 3), np.nan)
    rows, bones = wired.poles.own
    if len(rows):
        heads = arrays.poses[bones, 12:16] @ arrays.world.reshape(4, 4)
        found[rows] = heads[:, :3]
    for row in wired.poles.other_rows:
        pole = entries[row].pole
        if pole and not presence.is_deleted(pole):
            matrix = world_matrix(pole, wired.poles.other_bones.get(row, ""))
            if matrix:
                found[row] = matrix.translation
    return found


def _limits(rig, wired):
    """(number of chain bones, 6) rad, least x, y, z and largest x, y, z; infinite where a bone has no limit."""
    bones = rig.pose.bones
    found = np.empty((len(wired.all_bones), 6))
    for axis, letter in enumerate("xyz"):
        low, high = (_of_bones(bones, f"ik_{end}_{letter}", np.float32, wired) for end in ("min", "max"))
        is_limited = _of_bones(bones, f"use_ik_limit_{letter}", np.bool_, wired)
        is_locked = _of_bones(bones, f"lock_ik_{letter}", np.bool_, wired)
        found[:, axis] = np.where(is_locked, 0.0, np.where(is_limited, low, -np.inf))
        found[:, axis + 3] = np.where(is_locked, 0.0, np.where(is_limited, high, np.inf))
    return found


def _of_bones(bones, name, dtype, wired):
    found = np.empty(len(bones), dtype)
    bones.foreach_get(name, found)
    return found[wired.all_bones]
