"""Where the bones of a head that looks are at any times, for systems that need their past: the solver is asked for each time."""

from ..core import deleted, entry_keys, rigs
from ..core.lazy import numpy as np
from ..core.tracks import rotations
from ..core.tracks.question import answered
from ..core.tracks.rig_inputs import RigInputs, SolvedBone, once
from ..core.tracks.strips import together
from . import groups, solve


def over_time(owner, thing, scene):
    """System.over_time; None for what no head turns."""
    present = answered((hash(owner), "look_at"), lambda: groups.present(owner))
    found = next(((entry, bones) for entry, bones in present if thing.name in bones), None)
    return OverTime(owner, *found, thing.name, scene) if found else None


class OverTime(SolvedBone):
    """A bone of a head, its spine or eyes; see core/tracks/solved.py. Both original or both evaluated."""

    def __init__(self, owner, entry, bones, bone, scene):
        self._owner, self._entry, self._bones, self._bone = owner, entry, bones, bone
        lowest = owner.data.bones[bones[0]].parent
        entries = owner.motus.look_at.entries
        prefix = entry_keys.animated_prefix(owner, "motus.look_at.entries", entries, entries.find(entry.name))
        settings = {name: (prefix + name, -1) for name in (*solve.NUMBERS, "is_muted")}
        settings["influence"] = f"{owner.motus.look_at.path_from_id()}.influence", -1
        super().__init__(RigInputs(
            owner, scene, dict.fromkeys(groups.read_bones(owner, entry, bones)), lowest.name if lowest else "",
            [_target(entry)], settings))

    @property
    def stamp(self):
        """As Channel.stamp."""
        entry = self._entry
        return together((self._bone, tuple(self._bones), entry.head_forward, entry.eyes_forward, _target(entry) is not None,
                         self._inputs.stamp))

    def applied(self, times, transforms):
        """See core/tracks/solved.py."""
        turns = once(self._owner, ("look_at", self._entry.name), times, lambda: self._solved(times))
        return transforms._replace(
            rotations=rotations.product(transforms.rotations, turns[:, self._bones.index(self._bone)]))

    def _solved(self, times):
        """(n, bones, 4) turns of the entry's bones."""
        found = np.zeros((len(times), len(self._bones), 4))
        found[:, :, 0] = 1.0
        target, = self._inputs.goals(times)
        if target is None:
            return found
        owner, text = self._owner, groups.plan_of(self._owner, [(self._entry, self._bones)])
        wired = rigs.plan(owner, text, lambda rig, rows: solve.Wired(rig, rows, text))
        settings, worlds, still = self._settings(wired, times), self._inputs.worlds(times), wired.still
        for index, (poses, basis) in enumerate(self._inputs.rows(times, rigs.names_of(owner))):
            wired.plan.solve(
                still.rest, poses, basis, still.inheritance, worlds[index], settings[index:index + 1],
                target[index:index + 1, 12:15], wired.head_forward, wired.eyes_forward, rotations=found[index])
        return found

    def _settings(self, wired, times):
        numbers = self._inputs.numbers(times)
        found = np.zeros((len(times), len(wired.columns)))
        for name in solve.NUMBERS:
            found[:, wired.columns[name]] = numbers[name]
        found[:, wired.columns["weight"]] *= numbers["influence"]
        found[:, wired.columns["is_on"]] = numbers["is_muted"] == 0.0
        return found


def _target(entry):
    """(object, bone or "") of what a head looks at; None where it is not there."""
    target, bone = entry.target, entry.target_bone
    if target is None or deleted.is_deleted(target) or target.pose and bone and bone not in target.pose.bones:
        return None
    return target, bone if target.pose else ""
