"""What is known of a group's chains from when they were wired: it is worked out once, not at every frame."""

from ..core import native, rigs
from ..core.file import stored
from ..core.lazy import numpy as np
from .groups import OUTPUTS

_WHERE = ("", 'OWN', 'OTHER').__contains__
_FORM = {
    "fingerprint": int,
    "chains": [
        {
            "name": str,
            "bones": [str],
            "effector": str,
            "stretches": bool,
            "all?": int,
            "target": _WHERE,
            "target_bone": str,
            "pole": _WHERE,
            "pole_bone": str,
            "extras": int,
            "settings": {"tolerance": float, "iterations": float},
        }
    ],
    "guards": [(str, int)],
}
"""Of what groups.py notes."""


class RigChanged(Exception):
    """The rig has not the chains that were wired: it was edited, and will be wired again."""


class Wired:
    """A group as it was wired, with rows of bones in the rig's arrays."""

    def __init__(self, rig, rows, text):
        known = stored.parse(text, _FORM)
        chains = known["chains"]
        try:
            bones = [[rows[name] for name in chain["bones"]] for chain in chains]
            effectors = [rows[chain["effector"]] for chain in chains]
            guards = [(rows[name], chain) for name, chain in known["guards"]]
        except KeyError as error:
            raise RigChanged from error
        self.still = rigs.still(rig, tuple(rows))
        self.key = text  # nothing else makes the same
        self.names = [chain["name"] for chain in chains]
        # Bones of each chain, and how many there are up to the root.
        self.counts = np.array([len(chain) for chain in bones])
        self.most = np.array([chain.get("all", len(chain["bones"])) for chain in chains])
        self.stretches = np.array([chain["stretches"] for chain in chains])
        self.is_elastic = bool(self.stretches.any())
        self.columns = {name: column for column, name in enumerate(native.module.IkPlan.SETTINGS)}
        self.settings = self._settings_as_wired(chains)
        self.is_blended = any(chain["extras"] for chain in chains)
        self.all_bones = np.array([row for chain in bones for row in chain])
        self.targets = _Goals(rows, chains, "target")
        self.poles = _Goals(rows, chains, "pole")
        self.no_targets = np.tile(np.eye(4).ravel(), (len(chains), 1))
        self.no_poles = np.full((len(chains), 3), np.nan)
        report = native.module.IkPlan.REPORT
        self.told_numbers = len(OUTPUTS) * len(chains)
        self.told = np.array([report.index(name) for name in OUTPUTS])  # columns of the report
        parents = rigs.parents(rig, list(rows))
        try:
            self.plan = native.module.IkPlan(parents, bones, effectors, guards)
        except ValueError as error:  # a chain that has been taken apart
            raise RigChanged from error
        roots = {parents[chain[0]] for chain in bones} - {-1}
        # Rows whose poses are read, and names of the bones whose own transforms are.
        self.posed = sorted(roots.union(*(map(int, goals.own[1]) for goals in (self.targets, self.poles))))
        self.members = len(self.plan.rows)
        names = tuple(rows)
        self.moved = frozenset(names[row] for row in self.plan.rows)

        self._known_rest = None, None

    def bones(self, rig):
        """The native plan's bones, with the own transforms that an evaluated rig's bones have."""
        return self.bones_of(rigs.basis(rig, self.still))

    def bones_of(self, basis):
        """The native plan's bones with own transforms given as rigs.Arrays.basis."""
        return self.plan.bones(self._at_rest(), basis)

    def _settings_as_wired(self, chains):
        found = np.zeros((len(chains), len(self.columns)))
        for row, chain in zip(found, chains):
            for name, value in chain["settings"].items():
                row[self.columns[name]] = value
        found[:, self.columns["is_on"]] = 1.0
        return found

    def _at_rest(self):
        still, rest = self._known_rest
        if still is not self.still:  # rigs.plan() has found the armature edited
            still = self.still
            rest = self.plan.rest(still.rest, still.lengths, still.inheritance)
            self._known_rest = still, rest
        return rest


class _Goals:
    """Targets or poles: `own` are (entries, bones of the rig) as arrays; of the others the bones by entry, if any."""

    def __init__(self, rows, chains, key):
        found = [(index, chain[key], chain[key + "_bone"]) for index, chain in enumerate(chains)]
        own = [(index, rows[bone]) for index, where, bone in found if where == 'OWN' and bone in rows]
        self.own = tuple(np.array(own, dtype=int).reshape(-1, 2).T)
        self.has_own = len(own) > 0
        mine = {index for index, _ in own}
        self.other_rows = [index for index, where, _ in found if where and index not in mine]
        self.other_bones = {index: bone for index, where, bone in found if bone and where and index not in mine}
        self.are_any = bool(self.has_own or self.other_rows)
        self.none = [index for index, where, _ in found if not where]
