"""Inputs of solvers of bones, at any times: bones' own transforms, the pose of the bone above, settings, and goals."""

import functools

from .. import keeping, native, rigs
from ..animation import keys, strips
from ..animation.channel import Channel
from ..animation.strips import together
from ..evaluated import copies
from ..evaluated.question import answered
from ..lazy import numpy as np
from . import laid
from .in_world import World
from .transforms import Own

_KEPT = keeping.OfEvaluation(
    "values that are derived from a rig's keys, settings and rest pose, and the latest motion over time of what is solved together",
    "name of the value; recomputed if the stamp of what it depends on differs",
    "one for each name",
)


class RigInputs:
    """Inputs at any times of a solver of bones of one rig, original or evaluated.

    name: hashable tuple that names what is solved. bones: names of the bones whose own transforms (matrix_basis) are read.
    above: name of the bone that these bones hang on; "" if there is none. goals: for each goal the (object, name of its bone or "") whose
    world matrix is read, or None if the goal is not set. settings(): {any name: (data path, index)} of numbers of the rig; the index is
    that of an array's element.
    lays_pose: whether the solver belongs to a system that changes the bones' own transforms before all other systems
    (System.lays_pose). It then reads nothing but the bones' own channels and the settings; above, goals and scene are ignored.
    """

    def __init__(self, rig, scene, name, bones, above, goals, settings, lays_pose=False):
        self._rig, self._name, self._bones, self._above, self._paths = rig, name, bones, above, settings
        self._lays_pose = lays_pose
        self._hung = World(rig.pose.bones[above] if above else rig, scene)
        self._world = World(rig, scene)
        self._goals = [goal and World(goal[0].pose.bones[goal[1]] if goal[1] else goal[0], scene) for goal in goals]

    @functools.cached_property
    def own(self):
        """Own transforms of the bones over time: {bone name: Own, or Laid if a system lays poses over the bone}."""
        bones = {name: self._rig.pose.bones[name] for name in self._bones}
        return {name: Own(bone) if self._lays_pose else laid.over(Own(bone), bone) for name, bone in bones.items()}

    @functools.cached_property
    def settings(self):
        """Settings over time: {name: Channel}, with the names that the `settings` function has given."""
        return {name: Channel(self._rig, path, index) for name, (path, index) in self._paths().items()}

    @property
    def _others(self):
        return [] if self._lays_pose else [self._hung, *filter(None, self._goals)]

    @property
    def _parts(self):
        return [*self.settings.values(), *self.own.values(), *self._others]

    @functools.cached_property
    def reason(self):
        """Reason why an input of the solver is unknown at frames other than the present one; None if all inputs are known."""
        mine = kept(self._rig, (*self._name, "reason"), lambda: _first_reason([*self.settings.values(), *self.own.values()]))
        return mine or _first_reason(self._others)

    def bounds(self, first, last):
        """Rising frames from first to last, whole frames included; between two neighbouring frames all inputs change smoothly."""
        return keys.union([[first, *keys.whole(first, last), last], *(part.bounds(first, last) for part in self._parts)])

    @property
    def extent(self):
        """(first, last) frame between which any of the inputs changes; None if all inputs are constant."""
        return keys.united(part.extent for part in self._parts)

    @property
    def stamp(self):
        """Hashable value that changes whenever one of the inputs may change at any time; None if changes cannot be detected."""
        lying = [own for own in self.own.values() if isinstance(own, laid.Laid)]
        return together((stamp_of(self._rig), *(part.stamp for part in (*lying, *self._others))))

    def numbers(self, times):
        """Values of the numeric settings at times (n,), as {name: array (n,)}."""
        return {name: channel.values(times) for name, channel in self.settings.items()}

    def worlds(self, times):
        """World matrices of the rig at times (n,), as (n, 16), column by column."""
        return columns(self._world.values(times), len(times))

    def goals(self, times):
        """World matrices (n, 16) of each goal (an object or bone that the solver aims at), column by column; None for an unset goal."""
        return [goal and columns(goal.values(times), len(times)) for goal in self._goals]

    def rows(self, times, names):
        """Yields, for each time, the pair (poses, basis): PoseBone.matrix and PoseBone.matrix_basis of all bones of the rig.

        Each array is (B, 16) float32, column by column, as in rigs.Arrays. names: names of all bones, in the order of the pose.
        `basis` is right only for `bones`, and `poses` only for the bone `above`. Each step overwrites the two arrays of the step before.
        """
        places = {name: row for row, name in enumerate(names)}
        basis = np.tile(np.eye(4, dtype=np.float32).ravel(), (len(names), 1))
        poses = basis.copy()
        rows = [places[name] for name in self.own]
        moved = np.stack([columns(own.values(times).matrices, len(times)) for own in self.own.values()], axis=1)
        hung = columns(self._hung.poses(times), len(times)) if self._above else None
        for index in range(len(times)):
            basis[rows] = moved[index]
            if hung is not None:
                poses[places[self._above]] = hung[index]
            yield poses, basis

    def turns(self, times, bones, places, shares, scales=None):
        """Quaternions (n, k, 4) that point the tails of k bones to places in the world at times (n,), on top of their own pose.

        bones: their names, parents first, all among those of the inputs. places: (n, k, 3). shares: (k,), 0 to 1, by how much. scales:
        (n, k, 3), by which the bones are scaled along their own axes; None scales no bone.
        """
        names = rigs.names_of(self._rig)
        still, worlds = rigs.still(self._rig, names), self.worlds(times)
        rows = [names.index(name) for name in bones]
        plan = native.module.TailPlan(rigs.parents(self._rig, list(names)), rows)
        found = []
        for index, (poses, basis) in enumerate(self.rows(times, names)):
            basis = rigs.scaled(basis, rows, None if scales is None else scales[index])
            found.append(plan.solve(still.rest, poses, basis, still.inheritance, worlds[index], places[index], shares))
        return np.stack(found)


class SolvedBone:
    """Base class of what System.over_time returns for a bone that is solved from RigInputs alone.

    A subclass adds `applied` and `stamp` (see solved.py).
    """

    def __init__(self, inputs):
        self._inputs = inputs
        self.bounds = inputs.bounds

    @property
    def reason(self):
        """Reason why the bone's transform is unknown at frames other than the present one; None if it is known."""
        return self._inputs.reason

    @property
    def extent(self):
        """(first, last) frame between which any input of the bone's solver changes; None if all inputs are constant."""
        return self._inputs.extent


def columns(matrices, count):
    """Matrices (count or 1, 4, 4) as (count, 16), column by column."""
    return np.broadcast_to(np.swapaxes(matrices, 1, 2), (count, 4, 4)).reshape(count, 16)


def once(rig, name, times, make, stamp=None):
    """Result of make() for a rig and times, computed once while one question about a track is answered (see evaluated/question.py).

    Bones that are solved together are asked for one by one: all of them share the result. name: hashable name of what is solved.
    stamp(): hashable value that changes whenever the result may; None if changes cannot be detected. If it is given, the latest result is
    kept, so that all solvers that ask for the same times share it, too.
    """
    marks = times.tobytes()
    if stamp is None:
        return answered((hash(rig), name, marks), make)
    return answered((hash(rig), name, marks), lambda: _latest(rig, (name, "over time"), together((stamp(), marks)), make))


def stamp_of(rig):
    """Stamp of a rig: hashable value that changes whenever its settings, keys or rest pose may change.

    Values that drivers set are not covered. The result is None if changes cannot be detected.
    """
    copy = copies.of(rig)
    return copy and together((copy.number, strips.stamp_of(rig.animation_data), copies.stamp_of_data(rig)))


def kept(rig, name, make):
    """Result of make() for a rig, kept under a name until the rig's stamp_of() changes; if stamp_of() is None, it is made anew each time.

    name: hashable. The result must not refer to Blender's data.
    """
    return _latest(rig, name, stamp_of(rig), make)


def _latest(rig, name, stamp, make):
    """Result of make() for a rig, kept under a name until the stamp is another one; made anew each time if the stamp is None."""
    if stamp is None:
        return make()
    known = _KEPT.on(copies.of(rig))
    found = known.get(name)
    if found is None or found[0] != stamp:
        found = known[name] = stamp, make()
    return found[1]


def _first_reason(parts):
    return next((part.reason for part in parts if part.reason), None)
