"""What native IkPlan needs, read from an evaluated rig: its arrays, the entries' settings, targets, poles and limits.

It runs at every frame, so numbers of all entries are read by one call each, and bones of the rig itself are taken from
the arrays that are there already.
"""

from typing import Any, NamedTuple

from ..core import native, rigs
from ..core.evaluated import copies
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from .goals import places as goal_places, stations
from .groups import PLAN
from .reasons import MUTED
from .wired import RigChanged, Wired

ANIMATED = {
    "position_weight": "f4",
    "rotation_weight": "f4",
    "softness": "f4",
    "stretch": "f4",
    "pole_angle": "f4",
    "hinge_angle": "f4",
    "use_limits": "?",
}
"""Settings that are read at every frame, with the types that foreach_get has quickly. Others are known when it is wired."""


class Posed(NamedTuple):
    """Where a rig and its bones stand. poses: as in rigs.Arrays, valid until the thread reads the next rig."""

    poses: Any
    world: Any


class Gathered(NamedTuple):
    """Arguments of IkPlan.solve and IkPlan.match, and what keeps an entry from them.

    off: why an entry is switched off, NO_TARGET and the like, by row. is_stiff: whether one should stretch, or have more
    bones, but was wired when it did not. is_astray: whether one's Blend needs a target that is missing.
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
    """Read an evaluated rig. text: what groups.py noted of the group. Raises RigChanged."""
    return _source(rig, text).gather(depsgraph, None)


def gather_wired(rig, data, depsgraph):
    """Read an evaluated rig for a group's data as the wiring keeps it; only the poses that IkPlan.solve reads are filled in."""
    found = _source(rig, data.get(PLAN))
    return found.gather(depsgraph, found.wired.posed)


def _source(rig, text):
    return rigs.source(rig, text, lambda rig, rows: Wired(rig, rows, text), _Source)


class _Settings(NamedTuple):
    """Settings of the entries of a group, as arrays.

    numbers: as in Gathered, settings. muted: rows. weights: of the rotation, None where no entry takes one; offsets: (C, 3)
    with it. has_limits: whether an entry keeps its bones' limits.
    """

    numbers: Any
    muted: Any
    weights: Any
    offsets: Any
    has_limits: bool
    is_stiff: bool


class _Source:
    """An evaluated copy of a rig, as a group's entries need it. What nothing animates is read once."""

    def __init__(self, rig, wired):
        self._rig, self.wired, self._copy = rig, wired, copies.of(rig)
        every = rig.motus.ik.entries
        self._places = _places(every, wired.names)
        self._entries = entries = list(every) if self._places is None else [every[place] for place in self._places]
        self._targets = goal_places.Others(wired.targets, [pointed(entries[row], "target") for row in wired.targets.other_rows])
        self._poles = goal_places.Others(wired.poles, [pointed(entries[row], "pole") for row in wired.poles.other_rows])
        self._further = stations.Further(entries)
        self._still_settings = self._still_bones = None

    def gather(self, depsgraph, rows):
        """The Gathered of the present frame. rows: as rigs.poses() takes them."""
        rig, wired = self._rig, self.wired
        known = self._settings()
        posed = Posed(rigs.poses(rig, wired.still, rows), rigs.columns(rig.matrix_world))
        off = {}
        targets = goal_places.read_targets(wired, self._targets, posed, depsgraph, off)
        is_astray = wired.is_blended and goal_places.blend(targets, self._entries, self._further, off)
        if known.weights is not None:
            goal_places.turn(targets, known.offsets, known.weights)
        if known.muted:
            off.update(dict.fromkeys(known.muted, MUTED))
        numbers = known.numbers
        if off:
            numbers = numbers.copy()
            numbers[list(off), native.module.IkPlan.SETTINGS.index("is_on")] = 0.0
        poles = goal_places.read_poles(wired, self._poles, posed, depsgraph)
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
            self._still_bones = self.wired.bones(self._rig)
        return self._still_bones


def _places(entries, names):
    """Index of each of the group's entries among all; None where they are the same."""
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
    """(C, len(IkPlan.SETTINGS)) float64, and whether a chain should stretch, or be longer, than it was wired for."""
    numbers, columns = wired.settings.copy(), wired.columns
    # Without animation, what was wired without stretch has none.
    reads_stretch = wired.is_elastic or is_animated
    for name, dtype in ANIMATED.items():
        if name != "stretch" or reads_stretch:
            numbers[:, columns[name]] = _column(settings.entries, name, places, dtype=dtype)
    lengths = _column(settings.entries, "chain_length", places, dtype="i4")
    lengths = np.where(lengths > 0, np.minimum(lengths, wired.most), wired.most)
    numbers[:, columns["left_out"]] = np.maximum(wired.counts - lengths, 0)
    if wired.poles.are_any:
        # foreach_get reads no enumerations of add-ons (3.4).
        bends = np.array([-1.0 if entry.bend == 'AWAY' else 1.0 for entry in settings.entries])
        numbers[:, columns["bend"]] = bends if places is None else bends[places]
    is_stiff = bool((lengths > wired.counts).any())
    if reads_stretch:
        # The sinks of a chain that was wired without stretch cannot lengthen a bone.
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
