"""Transforms over time of the bones that Look At turns, for systems that need past frames: the solver runs once for each time.

Times are frames of F-curves, which differ from the scene's frames under Time Stretching.
"""

import math

from ..core import native, rigs
from ..core.animation.strips import together
from ..core.evaluated.question import answered
from ..core.file import deleted
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.settings import entry_keys
from ..core.tracks import rotations
from ..core.tracks.rig_inputs import RigInputs, SolvedBone, kept, once
from . import groups, solve


def over_time(owner, thing, scene):
    """OverTime of a pose bone that a head's entry turns, as System.over_time declares it; None if no head turns the bone.

    owner: the armature object with the entries. thing: the PoseBone or Object that is asked about.
    """
    surveyed = kept(owner, ("look_at", "survey"), lambda: _survey(owner))
    index, bones = next((one for one in surveyed if thing.name in one[1]), (-1, ()))
    if index < 0:
        return None
    solved = answered((hash(owner), "look_at", index, hash(scene)), lambda: _Head(owner, index, bones, scene))
    return OverTime(solved, bones.index(thing.name))


def _survey(owner):
    """(index of the entry, names of the turned bones) of each head of an owner that is solved."""
    entries = owner.motus.look_at.entries
    return [(entries.find(entry.name), bones) for entry, bones in groups.present(owner)]


class OverTime(SolvedBone):
    """Transform over time of one bone that a head's entry turns: a spine, head or eye bone of an original or evaluated rig.

    core/tracks/solved.py lists the attributes that systems read of it.
    """

    def __init__(self, head, row):
        super().__init__(head.inputs)
        self._head, self._row = head, row

    @property
    def stamp(self):
        """Hashable value that changes whenever the bone's motion may change; None if changes cannot be detected.

        It holds the bone's row among the head's bones, and the stamp of the head.
        """
        return together((self._row, self._head.stamp))

    @property
    def extent(self):
        """(first, last) frame between which the bone's turn changes, infinite for eyes with saccades; None if it is constant."""
        return (-math.inf, math.inf) if self._head.jumps(self._row) else super().extent

    def applied(self, times, transforms):
        """Transforms of the bone at times (n,), with Look At's turns after the rotations of `transforms`, which its own channels give."""
        return transforms._replace(rotations=rotations.product(transforms.rotations, self._head.turns(times)[:, self._row]))


class _Head:
    """One head's entry, which is solved at any times; all bones that it turns are solved together."""

    def __init__(self, owner, index, bones, scene):
        self._owner, self._index, self._bones, self._scene = owner, index, bones, scene
        self._entry = entry = owner.motus.look_at.entries[index]
        lowest = owner.data.bones[bones[0]].parent
        self._targets = [_present(*goal) for goal in groups.goals(entry)]
        self.inputs = RigInputs(
            owner,
            scene,
            ("look_at", index),
            dict.fromkeys(groups.read_bones(owner, entry, bones)),
            lowest.name if lowest else "",
            self._targets,
            self._paths,
        )

    def _paths(self):
        entries = self._owner.motus.look_at.entries
        prefix = entry_keys.animated_prefix(self._owner, "motus.look_at.entries", entries, self._index)
        saccades = ("saccade_amplitude",) if self._entry.use_saccades else ()
        names = (*solve.NUMBERS, "is_muted", *self._weight_names, *saccades)
        paths = {name: (prefix + name, -1) for name in names}
        return paths | {"influence": ("motus.look_at.influence", -1)}

    @property
    def _weight_names(self):
        """Data paths in the entry of its targets' weights."""
        return ["target_weight", *(f"extra_targets[{number}].weight" for number in range(len(self._targets) - 1))]

    @property
    def stamp(self):
        """Hashable value that changes whenever the head's motion may change; None if changes cannot be detected.

        It holds which targets the head has, and the stamp of the solver's inputs.
        """
        rate = scene_time.stamp(self._scene) if self._entry.use_saccades else ()
        return together((tuple(target is not None for target in self._targets), rate, self.inputs.stamp))

    def jumps(self, row):
        """Whether the bone of a row is an eye with saccades."""
        return self._entry.use_saccades and row > self._bones.index(self._entry.name)

    def turns(self, times):
        """Turns that the solver gives the head's bones at times (n,): quaternions w, x, y, z, (n, bones, 4).

        If the head has no target, all turns are the identity.
        """
        return once(self._owner, ("look_at", self._index), times, lambda: self._solved(times))

    def _solved(self, times):
        found = np.zeros((len(times), len(self._bones), 4))
        found[:, :, 0] = 1.0
        if self._targets[0] is None:
            return found
        worlds_of_targets = self.inputs.goals(times)
        targets = np.zeros((len(times), len(worlds_of_targets), 3))
        weights = np.zeros(targets.shape[:2])
        numbers = self.inputs.numbers(times)
        for number, (one, name) in enumerate(zip(worlds_of_targets, self._weight_names)):
            if one is not None:
                targets[:, number], weights[:, number] = one[:, 12:15], numbers[name]
        owner, text = self._owner, groups.plan_of(self._owner, [(self._entry, self._bones)], {self._entry.name: []})
        wired = rigs.plan(owner, text, lambda rig, rows: solve.Wired(rig, rows, text))
        settings, worlds, still = self._settings(wired, times), self.inputs.worlds(times), wired.still
        beside = self._beside(times, numbers)
        for index, (poses, basis) in enumerate(self.inputs.rows(times, rigs.names_of(owner))):
            wired.plan.solve(
                still.rest,
                poses,
                basis,
                still.inheritance,
                worlds[index],
                settings[index : index + 1],
                targets[index],
                wired.head_forward,
                wired.eyes_forward,
                rotations=found[index],
                up=wired.up,
                target_weights=weights[index],
                target_counts=[len(self._targets)],
                eyes_beside=None if beside is None else beside[index : index + 1],
            )
        return found

    def _beside(self, times, numbers):
        """How far the eyes look beside the target at times (n,), (n, 2) radians to the left and up; None without saccades."""
        entry = self._entry
        if not entry.use_saccades:
            return None
        seconds = times / scene_time.fps(self._scene)
        return native.module.saccades(seconds, numbers["saccade_amplitude"], entry.saccade_rate, entry.eyes_seed)

    def _settings(self, wired, times):
        numbers = self.inputs.numbers(times)
        found = np.zeros((len(times), len(wired.columns)))
        for name in solve.NUMBERS:
            found[:, wired.columns[name]] = numbers[name]
        found[:, wired.columns["weight"]] *= numbers["influence"]
        found[:, wired.columns["is_on"]] = numbers["is_muted"] == 0.0
        return found


def _present(target, bone):
    """(object, bone or "") of a target; None if there is no target, it was deleted, or it lacks the bone."""
    if target is None or deleted.is_deleted(target) or (target.pose and bone and bone not in target.pose.bones):
        return None
    return target, bone if target.pose else ""
