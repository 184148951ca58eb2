"""Transforms over time of the bones of chains, for systems that need past frames: the solver runs once for each time.

Times are frames of F-curves, which differ from the scene's frames under Time Stretching.
"""

from typing import Any

from mathutils import Matrix

from ..core import rigs
from ..core.animation.strips import together
from ..core.evaluated.question import answered
from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.settings import entry_keys
from ..core.tracks import rotations
from ..core.tracks.rig_inputs import RigInputs, SolvedBone, kept, once
from . import groups, reading
from .goals import floors, places as goal_places
from .wired import Wired

NUMBERS = (*reading.ANIMATED, "chain_length", "bend", "target_blend", "is_muted")


def over_time(owner, thing, scene):
    """OverTime of a pose bone that a chain drives, as System.over_time declares it; None if no chain drives the bone.

    None also for the effector of a stretching chain if its head reaches for the target: that bone keeps its own scale.
    owner: the armature object with the entries. thing: the PoseBone or Object that is asked about.
    """
    surveyed = kept(owner, ("ik", "survey"), lambda: _survey(owner))
    index, *found = next((one for one in surveyed if thing.name in one[1].driven), (-1,))
    if index < 0 or (found[1] and thing.name not in found[0].bones):
        return None
    entry = owner.motus.ik.entries[index]
    solved = answered((hash(owner), "ik", index, hash(scene)), lambda: _Chain(owner, groups.Found(entry, *found), index, scene))
    return OverTime(solved, thing.name)


def _survey(owner):
    """(index of the entry, Chain, stretches, guards) of each entry of an owner that is solved, with the fields of groups.Found."""
    entries = owner.motus.ik.entries
    return [(entries.find(found.entry.name), *found[1:]) for found in groups.survey(owner)]


class OverTime(SolvedBone):
    """Transform over time of one bone that a chain drives, in an original or evaluated rig.

    core/tracks/solved.py lists the attributes that systems read of it.
    """

    def __init__(self, chain, bone):
        super().__init__(chain.inputs)
        self._chain, self._bone = chain, bone

    @property
    def stamp(self):
        """Hashable value that changes whenever the bone's motion may change; None if changes cannot be detected.

        It holds the bone's name, and the stamp of its chain.
        """
        return together((self._bone, self._chain.stamp))

    def applied(self, times, transforms):
        """Transforms of the bone at times (n,): the chain's turns and stretches on top of `transforms`, which its own channels give."""
        place, turns, factors = self._chain.solved(times)
        row = place[self._bone]
        return transforms._replace(
            rotations=rotations.product(transforms.rotations, turns[:, row]), scales=transforms.scales * factors[:, row]
        )


class _Chain:
    """One IK entry, which is solved at any times; all bones of its chain are solved together."""

    def __init__(self, owner, found, index, scene):
        self._owner, self._found, self._index = owner, found, index
        entry, chain = found.entry, found.chain
        parent = owner.data.bones[chain.bones[0]].parent
        goals = [
            (pointed(entry, "pole"), entry.pole_bone),
            (pointed(entry, "target"), entry.target_bone),
            *((pointed(extra, "object"), extra.bone) for extra in entry.extra_targets),
            (pointed(entry, "floor"), ""),
        ]
        self._goals = list(map(_goal, goals))
        self.inputs = RigInputs(owner, scene, ("ik", index), chain.driven, parent.name if parent else "", self._goals, self._paths)

    def _paths(self):
        prefix = entry_keys.animated_prefix(self._owner, "motus.ik.entries", self._owner.motus.ik.entries, self._index)
        paths: dict[Any, tuple[str, int]] = {name: (prefix + name, -1) for name in NUMBERS}
        paths |= {axis: (f"{prefix}rotation_offset", axis) for axis in range(3)}
        if self._goals[-1]:
            paths |= {name: (prefix + name, -1) for name in ("floor_height", "floor_margin")}
        return paths | {"influence": ("motus.ik.influence", -1)}

    @property
    def stamp(self):
        """Hashable value that changes whenever the chain's motion may change; None if changes cannot be detected.

        It holds which targets and poles exist, and the stamp of the solver's inputs.
        """
        return together((tuple(goal is not None for goal in self._goals), self.inputs.stamp))

    def solved(self, times):
        """Turns of the chain's bones at times (n,): ({bone: row}, rotations w, x, y, z (n, rows, 4), scales (n, rows, 3))."""
        return once(self._owner, ("ik", self._index), times, lambda: self._solved(times))

    def _solved(self, times):
        wired, names = self._wired
        place = {names[row]: index for index, row in enumerate(wired.plan.rows)}
        count, inputs = len(times), self.inputs
        turns, factors = np.zeros((count, len(place), 4)), np.ones((count, len(place), 3))
        turns[:, :, 0] = 1.0
        numbers = inputs.numbers(times)
        pole, *goals, floor = inputs.goals(times)
        targets, is_there = _blended(goals, numbers["target_blend"], count)
        if floor is not None:
            floors.above_all(targets[:, 12:15], floor, numbers["floor_height"], numbers["floor_margin"])
        settings = self._settings(wired, numbers, is_there)
        goal_places.turn(targets, np.stack([numbers[axis] for axis in range(3)], axis=1), numbers["rotation_weight"])
        poles = np.full((count, 3), np.nan) if pole is None else pole[:, 12:15]
        limits = reading.limits(self._owner, wired) if numbers["use_limits"].any() else None
        worlds = inputs.worlds(times)
        for index, (poses, basis) in enumerate(inputs.rows(times, names)):
            if settings[index, wired.columns["is_on"]]:
                wired.plan.solve(
                    wired.bones_of(basis),
                    poses,
                    worlds[index],
                    settings[index : index + 1],
                    targets[index : index + 1],
                    poles[index : index + 1],
                    limits=limits,
                    rotations=turns[index],
                    scales=factors[index],
                )
        return place, turns, factors

    @property
    def _wired(self):
        """(Wired of a group that has only this entry, names of all bones of the rig)."""
        owner = self._owner
        text = groups.plan_of(owner, [self._found])
        wired = rigs.plan(owner, text, lambda rig, rows: Wired(rig, rows, text))
        return wired, rigs.names_of(owner)

    def _settings(self, wired, numbers, is_there):
        """Settings of the chain at n times as IkPlan.solve() reads them, (n, len(IkPlan.SETTINGS)) float64.

        numbers: {name: values (n,)} of the entry's settings. is_there: whether there is a target, (n,).
        """
        found = np.repeat(wired.settings, len(is_there), axis=0)
        for name in reading.ANIMATED:
            found[:, wired.columns[name]] = numbers[name]
        for name in ("position_weight", "rotation_weight"):
            found[:, wired.columns[name]] *= numbers["influence"]
        lengths, most = numbers["chain_length"], wired.most[0]
        lengths = np.where(lengths > 0, np.minimum(lengths, most), most)
        found[:, wired.columns["left_out"]] = np.maximum(wired.counts[0] - lengths, 0)
        if wired.poles.are_any:
            found[:, wired.columns["bend"]] = np.where(numbers["bend"] == _AWAY, -1.0, 1.0)
        found[:, wired.columns["stretch"]] *= wired.stretches[0]
        found[:, wired.columns["is_on"]] = is_there & (numbers["is_muted"] == 0.0)
        return found


_AWAY = 1.0
"""Index of 'AWAY' among the items of the setting Bend."""


def _goal(pair):
    """(object, bone or "") of a target or pole; None if it is not chosen, was deleted, or lacks the chosen bone.

    pair: (object or None, bone name) as the entry has them.
    """
    obj, bone = pair
    if obj is None or deleted.is_deleted(obj) or (obj.pose and bone and bone not in obj.pose.bones):
        return None
    return obj, bone if obj.pose else ""


def _blended(goals, blends, count):
    """Mix the target and the further targets of a chain by its setting Blend: (world matrices (n, 16), whether there is a target (n,)).

    goals: world matrices (n, 16) of the target and each further target, None for a missing one. blends: Blend at each time, (n,).
    """
    first = goals[0]
    found = np.tile(np.eye(4).ravel(), (count, 1)) if first is None else first.copy()
    are_there = np.full(count, first is not None)
    if len(goals) > 1:
        for index in np.flatnonzero(blends > 0.0):
            places = [goal if goal is None else Matrix(goal[index].reshape(4, 4).T) for goal in goals]
            mixed, _ = goal_places.mixed(blends[index], places)
            if mixed is not None:
                found[index], are_there[index] = rigs.columns(mixed), True
    return found, are_there
