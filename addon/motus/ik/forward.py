"""Where a chain's bones stand with the turns that a solver gives, without asking Blender to evaluate them."""

import json
from typing import NamedTuple

from mathutils import Matrix, Quaternion, Vector

from ..core import rigs
from ..core.lazy import numpy as np
from . import groups, reading


class ChainRows(NamedTuple):
    """The rows of one chain in the arrays of results that the solver of a group of chains fills.

    bones: names of the chain's bones from the root, then of the bone whose orientation is set if it is not one of them. rows: one
    for each of these bones. is_effector_absolute: the last row holds rotation and scale in the rig's space, not on top of the
    bone's own.
    """

    name: str
    index: int  # type: ignore[assignment]  # a tuple has a method of this name
    bones: tuple
    rows: tuple
    is_effector_absolute: bool


def chain_rows(group):
    """{entry: ChainRows} of a group of the rig."""
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
    """(Solver, ChainRows) of an entry; None where it is solved by no group."""
    for group in groups.groups(rig):
        rows = chain_rows(group).get(name)
        if rows:
            return Solver(rig.evaluated_get(depsgraph), group, depsgraph), rows
    return None


class Solver:
    """One group's solution for other targets, poles, weights or lengths than the evaluated ones."""

    def __init__(self, evaluated, group, depsgraph):
        found = reading.gather(evaluated, group.data[groups.PLAN], depsgraph)
        # The arrays hold only until the next rig is read.
        self._posed = found.posed._replace(poses=found.posed.poses.copy())
        self._basis = rigs.basis(evaluated, found.wired.still).copy()
        self._plan, self._own, self._limits = found.wired.plan, found.bones, found.limits
        self.settings, self.targets, self.poles = map(np.array, (found.settings, found.targets, found.poles))
        self.columns = {name: column for column, name in enumerate(self._plan.SETTINGS)}
        self.world = Matrix(found.posed.world.reshape(4, 4).T.tolist())
        self._rows = {name: row for row, name in enumerate(found.wired.still.names)}
        self._armature = evaluated.original.data
        self.rotations = np.zeros((len(self._plan.rows), 4))
        self.scales = np.ones((len(self._plan.rows), 3))

    def solve(self):
        """Solve with settings, targets and poles as they are now."""
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
        """(C, 16) targets and (C, 3) poles for which the solution is the animated pose."""
        return self._plan.match(self._own, *self._posed, self.settings)

    def poses(self, chain):
        """World matrices of a chain's bones, by ChainRows, as it was solved last."""
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
    """Pose matrix of a bone from its own transform and its parent's pose matrix (None without a parent)."""
    if above is None:
        return bone.convert_local_to_pose(basis, bone.matrix_local)
    return bone.convert_local_to_pose(basis, bone.matrix_local, parent_matrix=above, parent_matrix_local=bone.parent.matrix_local)
