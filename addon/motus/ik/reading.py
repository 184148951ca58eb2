"""Read from an evaluated rig what native IkPlan needs: arrays of its bones, the entries' settings, targets, poles and limits.

This code runs at every frame. So each setting is read by one call for all entries, and targets that are bones of the rig itself are
taken from the arrays of bones that are read anyway.
"""

from typing import Any, NamedTuple

from ..core import rigs
from ..core.evaluated import copies
from ..core.lazy import numpy as np
from .goals import blend_targets, floors, places as goal_places
from .groups import PLAN
from .reasons import MUTED
from .wired import RigChanged, Wired

ANIMATED = {
    "position_weight": "f4",
    "rotation_weight": "f4",
    "softness": "f4",
    "stretch": "f4",
    "volume": "f4",
    "pole_angle": "f4",
    "hinge_angle": "f4",
    "use_limits": "?",
}
"""{name: type} of settings that are read at every frame by foreach_get, which is fast for arrays of these types.

Further settings that may be animated, such as the chain's length, are read in different ways. The rest is known when the rig is wired.
"""


class Posed(NamedTuple):
    """Pose of a rig's bones, and the rig's world matrix.

    poses: PoseBone.matrix of the bones, (B, 16) float32, column by column; valid until the rig is read at the next frame.
    world: as native functions take it, see rigs.world().
    """

    poses: Any
    world: Any


class Gathered(NamedTuple):
    """Arguments of IkPlan.solve and IkPlan.match for a group of chains, and what keeps chains from being solved.

    off: {row of a chain: reason for which it is switched off, such as NO_TARGET}. is_stiff: whether a chain should stretch, or
    have more bones, but was wired without. is_astray: whether the setting Blend of an entry needs a further target that is missing.
    """

    wired: Wired
    bones: Any
    posed: Posed
    settings: Any
    targets: Any
    poles: Any
    limits: Any
    off: dict
    is_stiff: bool
    is_astray: bool


def gather(rig, text, depsgraph):
    """Read the Gathered of a group from an evaluated rig. text: from groups.plan_of(). Raises RigChanged if the bones have changed."""
    return _source(rig, copies.of(rig), text).gather(depsgraph, None)


def gather_wired(context):
    """Read the Gathered of the group that a Context is for, with only the poses that IkPlan.solve reads.

    Raises RigChanged if the bones have changed.
    """
    found = _source(context.owner, context.copy, context.data.get(PLAN))
    return found.gather(context.depsgraph, found.wired.posed)


def _source(rig, copy, text):
    return rigs.source(rig, copy, text, lambda rig, rows: Wired(rig, rows, text), _Source)


class _Settings(NamedTuple):
    """Settings of the C entries of a group, as arrays.

    numbers: settings as IkPlan.solve() reads them. muted: list of the rows of muted entries. weights: rotation weights (C,), None
    if all are 0. offsets: rotation offsets (C, 3), Euler angles in radians; None if weights is None. has_limits: whether an entry
    keeps its bones' limits. is_stiff: whether a chain should stretch, or have more bones, but was wired without.
    """

    numbers: Any
    muted: Any
    weights: Any
    offsets: Any
    has_limits: bool
    is_stiff: bool


class _Source:
    """Reads the entries of a group from one evaluated copy of a rig. What is not animated is read only once."""

    def __init__(self, rig, copy, wired):
        self._rig, self.wired, self._copy = rig, wired, copy
        self._reader = rigs.Reader(rig, copy, wired.still)
        every = rig.motus.ik.entries
        self._places = _places(every, wired.names)
        self._entries = entries = list(every) if self._places is None else [every[place] for place in self._places]
        self._goals = goal_places.Places(wired, entries)
        self._further = blend_targets.Further(entries)
        self._still_settings = self._still_bones = None

    def gather(self, depsgraph, rows):
        """Gathered of the group at the evaluated frame. rows: rows of the bones whose poses are read; None reads all bones."""
        rig, wired = self._rig, self.wired
        known = self._settings()
        posed = Posed(self._reader.poses(rows), rigs.world(rig))
        targets, poles, off = self._goals.read(posed, depsgraph)
        is_astray = wired.is_blended and goal_places.blend(targets, self._entries, self._further, off)
        if wired.floors:
            floors.lift(targets, self._entries, wired.floors)
        if known.weights is not None:
            goal_places.turn(targets, known.offsets, known.weights)
        if known.muted:
            off.update(dict.fromkeys(known.muted, MUTED))
        numbers = known.numbers
        if off:
            numbers = numbers.copy()
            numbers[list(off), wired.columns["is_on"]] = 0.0
        bounds = limits(rig, wired) if known.has_limits else None
        return Gathered(wired, self._bones(), posed, numbers, targets, poles, bounds, off, known.is_stiff, is_astray)

    def _settings(self):
        is_still = self._copy is not None and not self._copy.has_animated_settings
        if not is_still or self._still_settings is None:
            is_animated = copies.has_animation(self._rig) if self._copy is None else not is_still
            self._still_settings = _read_settings(self._rig.motus.ik, self._places, self.wired, is_animated)
        return self._still_settings

    def _bones(self):
        is_still = self._copy is not None and not (rigs.is_laid(self._copy) or self._copy.has_animated_poses(self.wired.moved))
        if not is_still or self._still_bones is None:
            self._still_bones = self.wired.bones_of(self._reader.basis())
        return self._still_bones


def _places(entries, names):
    """Index of each entry of a group among all entries of the rig; None if both lists are the same. Raises RigChanged if one is gone."""
    keys = entries.keys()
    if keys == names:
        return None
    if not set(names) <= set(keys):
        raise RigChanged
    return [keys.index(name) for name in names]


def _read_settings(settings, places, wired, is_animated):
    numbers, is_stiff = _numbers(settings, places, wired, is_animated)
    muted = _column(settings.entries, "is_muted", places, dtype="?")
    weights = numbers[:, wired.columns["rotation_weight"]]
    is_turned = np.count_nonzero(weights) > 0
    return _Settings(
        numbers,
        np.flatnonzero(muted).tolist(),
        weights if is_turned else None,
        _column(settings.entries, "rotation_offset", places, 3) if is_turned else None,
        np.count_nonzero(numbers[:, wired.columns["use_limits"]]) > 0,
        is_stiff,
    )


def _numbers(settings, places, wired, is_animated):
    """(settings (C, len(IkPlan.SETTINGS)) float64, whether a chain should stretch or be longer, but was wired without)."""
    numbers, columns = wired.settings.copy(), wired.columns
    # If nothing is animated, chains that were wired without stretch still have none.
    reads_stretch = wired.is_elastic or is_animated
    for name, dtype in ANIMATED.items():
        if (name != "stretch" or reads_stretch) and (name != "volume" or wired.is_elastic):
            numbers[:, columns[name]] = _column(settings.entries, name, places, dtype=dtype)
    lengths = _column(settings.entries, "chain_length", places, dtype="i4")
    lengths = np.where(lengths > 0, np.minimum(lengths, wired.most), wired.most)
    numbers[:, columns["left_out"]] = np.maximum(wired.counts - lengths, 0)
    if wired.poles.are_any:
        # In Blender 3.4, foreach_get cannot read enum properties of add-ons.
        bends = np.array([-1.0 if entry.bend == 'AWAY' else 1.0 for entry in settings.entries])
        numbers[:, columns["bend"]] = bends if places is None else bends[places]
    is_stiff = bool((lengths > wired.counts).any())
    if reads_stretch:
        # The constraints of a chain that was wired without stretch cannot lengthen a bone.
        is_stiff = is_stiff or np.count_nonzero(numbers[~wired.stretches, columns["stretch"]]) > 0
        numbers[:, columns["stretch"]] *= wired.stretches
    influence = settings.influence
    if influence != 1.0:
        for name in ("position_weight", "rotation_weight"):
            numbers[:, columns[name]] *= influence
    return numbers, is_stiff


def _column(entries, name, places, size=1, dtype="f4"):
    found = np.empty(len(entries) * size, dtype)
    entries.foreach_get(name, found)
    if size > 1:
        found = found.reshape(-1, size)
    return found if places is None else found[places]


def limits(rig, wired):
    """Joint limits of all bones of a group's chains, (bones, 6) float64 in radians: least x, y, z, then largest x, y, z.

    A limit is infinite if the bone has none, and 0 if the axis is locked.
    """
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
