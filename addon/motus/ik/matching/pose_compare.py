"""Measure how far the chains of a rig are from poses that were noted before."""

from typing import NamedTuple

from ...core import wiring
from ...core.lazy import numpy as np
from .. import forward, setup


class Error(NamedTuple):
    """Largest errors of a comparison of poses.

    length: in world units. angle: in radians. share: length of an error, divided by the length of its chain.
    """

    length: float = 0.0
    angle: float = 0.0
    share: float = 0.0


class Poses:
    """Notes the poses of chains at each frame, and compares later poses with them. chosen: list of job._Chain."""

    def __init__(self, rig, chosen):
        self._rig, self._chosen = rig, chosen
        self._lengths = [sum(rig.data.bones[name].length for name in chain.rows.bones) for chain in chosen]
        self.kept = []
        self.error = Error()

    def record(self, depsgraph):
        """Note the pose of the chains at the evaluated frame."""
        self.kept.append([self._evaluated(chain, depsgraph) for chain in self._chosen])

    def compare(self, depsgraph, index, with_all_weight=False):
        """Raise `error` to the difference between the evaluated pose and the noted pose of a frame, if that is larger.

        index: number of the frame in the order of record(). with_all_weight: compare the solution with position weight 1, too.
        """
        solved = self._solve(depsgraph) if with_all_weight else {}
        for chain, length, (heads, axes) in zip(self._chosen, self._lengths, self.kept[index]):
            self._widen(chain, length, heads, axes, *self._evaluated(chain, depsgraph))
            if solved:
                count = len(chain.rows.bones)
                posed = np.array(solved[chain.group.key].poses(chain.rows))
                self._widen(chain, length, heads[:count], axes[:count], posed[:, :3, 3], posed[:, :3, :3])

    def _evaluated(self, chain, depsgraph):
        evaluated = self._rig.evaluated_get(depsgraph)
        posed = np.array(evaluated.matrix_world) @ np.array([evaluated.pose.bones[name].matrix for name in chain.bones])
        return posed[:, :3, 3], posed[:, :3, :3]

    def _solve(self, depsgraph):
        evaluated = self._rig.evaluated_get(depsgraph)
        solved = {}
        for group in {chain.group.key: chain.group for chain in self._chosen}.values():
            solver = solved[group.key] = forward.Solver(evaluated, group, depsgraph)
            solver.settings[:, solver.columns["position_weight"]] = 1.0
            solver.solve()
        return solved

    def _widen(self, chain, length, heads, axes, heads_now, axes_now):
        bone_lengths = np.array([self._rig.data.bones[name].length for name in chain.bones])[: len(heads)]
        ends = axes[:, :, 1] * bone_lengths[:, None], axes_now[:, :, 1] * bone_lengths[:, None]
        away = max(np.linalg.norm(heads_now - heads, axis=1).max(), np.linalg.norm(heads_now + ends[1] - heads - ends[0], axis=1).max())
        chord = np.linalg.norm(_directions(axes_now) - _directions(axes), axis=(1, 2)).max()
        angle = 2.0 * np.arcsin(min(chord / np.sqrt(8.0), 1.0))
        whole = length * self._rig.matrix_world.median_scale
        self.error = Error(
            max(self.error.length, float(away)),
            max(self.error.angle, float(angle)),
            max(self.error.share, float(away / whole) if whole else 0.0),
        )


def _directions(axes):
    return axes / np.maximum(np.linalg.norm(axes, axis=1, keepdims=True), 1e-30)


class without_sinks:  # noqa: N801  (a context, named like a function)
    """Context manager that mutes the constraints by which Motus poses the chains' bones, so that these have their animated pose inside."""

    def __init__(self, rig, chosen):
        self._rig = rig
        self._bones = {name for chain in chosen for name in chain.bones}
        self._muted = set()

    def __enter__(self):
        for thing, constraint in self._sinks():
            if not constraint.mute:
                self._muted.add((thing.name, constraint.name))
                constraint.mute = True

    def __exit__(self, *_):
        for thing, constraint in self._sinks():
            if (thing.name, constraint.name) in self._muted:
                constraint.mute = False

    def _sinks(self):
        if not self._bones:
            return []
        return [
            (thing, constraint)
            for thing, constraint in wiring.sinks(setup.system(), self._rig)
            if thing.id_data == self._rig and thing.name in self._bones
        ]
