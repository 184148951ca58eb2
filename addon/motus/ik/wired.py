"""Data of a group of chains that does not change until the rig is wired again: it is computed once, not at every frame."""

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
            "floor?": bool,
            "settings": {"tolerance": float, "iterations": float},
        }
    ],
    "guards": [(str, int)],
}
"""Form of the JSON text that groups.plan_of() writes."""


class RigChanged(Exception):
    """Raised if the rig no longer has the chains that were wired: its bones were edited, and it will be wired again."""


class Wired:
    """Group of chains as it was wired. Bones are given by their rows in the rig's arrays (core/rigs/arrays.py)."""

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
        self.key = text  # all that is kept here follows from this text and the rig's bones
        self.names = [chain["name"] for chain in chains]
        # Number of bones in each chain, and the largest number that it could have, up to the rig's root.
        self.counts = np.array([len(chain) for chain in bones])
        self.most = np.array([chain.get("all", len(chain["bones"])) for chain in chains])
        self.stretches = np.array([chain["stretches"] for chain in chains])
        self.is_elastic = bool(self.stretches.any())
        self.columns = {name: column for column, name in enumerate(native.module.IkPlan.SETTINGS)}
        self.settings = self._settings_as_wired(chains)
        self.floors = [row for row, chain in enumerate(chains) if chain.get("floor")]
        self.is_blended = any(chain["extras"] for chain in chains)
        self.all_bones = np.array([row for chain in bones for row in chain])
        self.targets = _Goals(rows, chains, "target")
        self.poles = _Goals(rows, chains, "pole")
        report = native.module.IkPlan.REPORT
        self.told_numbers = len(OUTPUTS) * len(chains)
        self.told = np.array([report.index(name) for name in OUTPUTS])  # columns of the report that are outputs
        parents = rigs.parents(rig, list(rows))
        try:
            self.plan = native.module.IkPlan(parents, bones, effectors, guards)
        except ValueError as error:  # bones of a chain are no longer parent and child
            raise RigChanged from error
        roots = {parents[chain[0]] for chain in bones} - {-1}
        # posed: rows of the bones whose poses are read. moved: names of the bones whose own transforms are read.
        self.posed = sorted(roots.union(*(map(int, goals.own[1]) for goals in (self.targets, self.poles))))
        self.members = len(self.plan.rows)
        names = tuple(rows)
        self.moved = frozenset(names[row] for row in self.plan.rows)

        self._known_rest = None, None

    def bones_of(self, basis):
        """IkBones of the native plan, with given own transforms. basis: (B, 16) float32, column by column, for all B bones of the rig."""
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
        if still is not self.still:  # rigs.plan() has found that the armature was edited
            still = self.still
            rest = self.plan.rest(still.rest, still.lengths, still.inheritance)
            self._known_rest = still, rest
        return rest


class _Goals:
    """Targets or poles of a group's chains, sorted by where they are read.

    key: "target" or "pole". own: for those that are bones of the rig itself, (rows of the chains, rows of the bones), two arrays.
    other_rows: rows of the chains whose target or pole is a different object. other_bones: {row of a chain: name of that object's
    bone}. none: rows of the chains that have no target or pole.
    """

    def __init__(self, rows, chains, key):
        found = [(index, chain[key], chain[key + "_bone"]) for index, chain in enumerate(chains)]
        own = [(index, rows[bone]) for index, where, bone in found if where == 'OWN' and bone in rows]
        self.own = tuple(np.array(own, dtype=int).reshape(-1, 2).T)
        mine = {index for index, _ in own}
        self.other_rows = [index for index, where, _ in found if where and index not in mine]
        self.other_bones = {index: bone for index, where, bone in found if bone and where and index not in mine}
        self.are_any = bool(own or self.other_rows)
        self.none = [index for index, where, _ in found if not where]
