"""Compute the poses of a chain's bones from the turns that the solver gives, without letting Blender evaluate the rig."""

import json
from typing import NamedTuple

from mathutils import Matrix, Quaternion, Vector

from ..core import rigs
from ..core.lazy import numpy as np
from . import groups, reading


class ChainRows(NamedTuple):
    """Rows of one chain in the arrays of results that the solver of a group of chains fills.

    name: of the chain's entry. index: row of the chain among the group's chains. bones: names of the chain's bones from the root,
    followed by the effector (the bone whose orientation is set) if it is not one of them. rows: row of each of these bones.
    is_effector_absolute: whether the last row holds rotation and scale in the rig's space; the rows of all bones otherwise act on
    top of the bones' own transforms.
    """

    name: str
    index: int  # type: ignore[assignment]  # tuples have a method of this name
    bones: tuple
    rows: tuple
    is_effector_absolute: bool


def chain_rows(group):
    """{name of the entry: ChainRows} of the chains of a Group that groups.groups() has declared."""
    known = json.loads(group.data[groups.PLAN])["chains"]
    first, free = 0, sum(len(chain["bones"]) for chain in known)
    found = {}
    for index, chain in enumerate(known):
        bones, rows = list(chain["bones"]), list(range(first, first + len(chain["bones"])))
        first += len(rows)
        is_free = chain["effector"] not in bones
        if is_free:
            bones.append(chain["effector"])
            rows.append(free)
            free += 1
        is_absolute = is_free and chain["stretches"]
        found[chain["name"]] = ChainRows(chain["name"], index, tuple(bones), tuple(rows), is_absolute)
    return found


def solver_of(rig, name, depsgraph):
    """(Solver, ChainRows) of the entry of a name; None if no group of the rig solves the entry."""
    for group in groups.groups(rig):
        rows = chain_rows(group).get(name)
        if rows:
            return Solver(rig.evaluated_get(depsgraph), group, depsgraph), rows
    return None


class Solver:
    """Solver of one group of C chains for targets, poles and settings that may be different from the evaluated ones.

    The caller may change these arrays before it calls solve(): settings (C, len(IkPlan.SETTINGS)), targets (C, 16) and
    poles (C, 3).
    """

    def __init__(self, evaluated, group, depsgraph):
        found = reading.gather(evaluated, group.data[groups.PLAN], depsgraph)
        # What was read is valid only until the rig is read at the next frame.
        self._posed = reading.Posed(found.posed.poses.copy(), rigs.columns(evaluated.matrix_world))
        self._basis = rigs.basis(evaluated, found.wired.still).copy()
        self._plan, self._own, self._limits = found.wired.plan, found.bones, found.limits
        self.settings, self.targets, self.poles = map(np.array, (found.settings, found.targets, found.poles))
        self.columns = {name: column for column, name in enumerate(self._plan.SETTINGS)}
        self.world = evaluated.matrix_world.copy()
        self._rows = {name: row for row, name in enumerate(found.wired.still.names)}
        self._armature = evaluated.original.data
        self.rotations = np.zeros((len(self._plan.rows), 4))
        self.scales = np.ones((len(self._plan.rows), 3))

    def solve(self):
        """Solve the chains with the present values of settings, targets and poles. Returns the report, (C, len(IkPlan.REPORT)) float64."""
        return self._plan.solve(
            self._own,
            *self._posed,
            self.settings,
            self.targets,
            self.poles,
            limits=self._limits,
            rotations=self.rotations,
            scales=self.scales,
        )

    def match(self):
        """Targets (C, 16) and poles (C, 3) for which the solution of the C chains is the animated pose."""
        return self._plan.match(self._own, *self._posed, self.settings)

    def poses(self, chain):
        """World matrices of a chain's bones by the last call of solve(), a list in the order of chain.bones. chain: the ChainRows."""
        bones = self._armature.bones
        first = bones[chain.bones[0]]
        above = self._matrix(self._posed.poses, first.parent.name) if first.parent else None
        found = []
        for name, row in zip(chain.bones, chain.rows):
            bone = bones[name]
            location, rotation, scale = self._matrix(self._basis, name).decompose()
            turn, stretch = Quaternion(self.rotations[row]), Vector(self.scales[row])
            is_absolute = chain.is_effector_absolute and name == chain.bones[-1]
            if not is_absolute:
                rotation, scale = rotation @ turn, scale * stretch
            posed = in_pose(bone, Matrix.LocRotScale(location, rotation, scale), above)
            if is_absolute:
                posed = Matrix.LocRotScale(posed.translation, turn, stretch)
            above = posed
            found.append(self.world @ posed)
        return found

    def _matrix(self, array, name):
        return Matrix(array[self._rows[name]].reshape(4, 4).T.tolist())


def in_pose(bone, basis, above):
    """Pose matrix of a bone from its own transform `basis` and its parent's pose matrix `above`; `above` is None if it has no parent."""
    if above is None:
        return bone.convert_local_to_pose(basis, bone.matrix_local)
    return bone.convert_local_to_pose(basis, bone.matrix_local, parent_matrix=above, parent_matrix_local=bone.parent.matrix_local)
