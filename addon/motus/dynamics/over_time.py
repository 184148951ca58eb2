"""Motion of an object or bone with dynamics at any times, for systems of Motus that need its past."""

import functools

from ..core import tracks
from ..core.animation import keys
from ..core.animation.channel import Channel
from ..core.animation.reason import Reason
from ..core.animation.strips import together
from ..core.evaluated.question import answered
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.settings import entry_keys
from ..core.tracks import in_world, rotations
from ..core.tracks.inputs import carrier
from ..core.tracks.rig_inputs import RigInputs, kept, once, stamp_of
from ..core.tracks.solved import turned
from . import groups, inputs, motion, sampling, setup
from .properties import KEYWORDS


def over_time(owner, thing, scene):
    """Return the motion over time of an object or bone with its dynamics; None if it has no dynamics itself.

    This is the function System.over_time. owner, thing: both original or both evaluated.
    """
    if thing != owner:
        index = setup.find(owner.motus.dynamics, thing.name)
        surveyed = answered((hash(owner), "dynamics"), lambda: groups.units(owner)) if index >= 0 else ()
        unit = next((unit for unit in surveyed if thing in unit.things), None)
        return unit and _OF_BONES[unit.kind](owner, index, unit, thing, scene)
    index = setup.find(owner.motus.dynamics, "")
    return OverTime(owner, index, scene) if index >= 0 else None


class _OverTime:
    """Base class of the motion over time of an object or bone with dynamics. owner: original or evaluated.

    Its members are listed in core/tracks/solved.py. index: of the entry.
    """

    def __init__(self, owner, index, scene):
        self._owner, self._index, self._scene = owner, index, scene
        self._entry = owner.motus.dynamics.entries[index]

    def _channels(self, indices=()):
        entries = self._owner.motus.dynamics.entries
        prefixes = [entry_keys.animated_prefix(self._owner, "motus.dynamics.entries", entries, index) for index in (self._index, *indices)]
        paths = ["motus.dynamics.influence", *(prefix + name for prefix in prefixes for name in ("weight", "is_muted"))]
        return [Channel(self._owner, path, -1) for path in paths]

    @property
    def reason(self):
        """The Reason why the motion at other frames cannot be computed; None if it can."""
        if not all(channel.is_constant for channel in self._channels()):
            return Reason(Reason.INFLUENCE, thing=self._owner.name, name=self._owner.name)
        source = self._input
        return source.reason or next((track.reason for track in source.tracks if not track.is_known), None)

    def bounds(self, first, last):
        """Return rising frames from first to last; the motion is smooth between neighbours.

        They are the whole frames and the frames at which a track of the input is not smooth.
        """
        found = [track.bounds(first, last) for track in self._input.tracks]
        return keys.union([[first, *keys.whole(first, last), last], *found])

    @property
    def extent(self):
        """First and last frame between which the motion changes; None if nothing moves.

        They are infinite if anything moves, because a filter's oscillation never ends exactly.
        """
        found = self._input.extent
        return None if found is None else (-np.inf, np.inf)

    def _weight(self, entry):
        return 0.0 if entry.is_muted else self._owner.motus.dynamics.influence * entry.weight

    def _part(self, thing, times):
        """Return (motion.Part, weight) of a member for times (n,); (None, 0.0) if the weight is 0 or there are no times."""
        weight = self._weight(self._entry)
        if weight <= 0.0 or len(times) == 0:
            return None, 0.0
        reach = self._reach(times)
        return answered((hash(thing), hash(self._scene), "dynamics", reach), lambda: self._made(thing, reach)), weight

    def _reach(self, times):
        """Return the sampling.Reach for times (n,), n > 0."""
        return sampling.reach_of(self._scene, float(np.min(times)), float(np.max(times)), self._input.price)

    def _made(self, thing, reach):
        try:
            return motion.part_of(thing, self._entry, 0, self._index, self._scene, reach)
        except (ValueError, motion.OpenLoop):
            return None

    @property
    def _time(self):
        """Tuple that changes whenever the scene's frame rate or first frame does."""
        return scene_time.stamp(self._scene)


class OverTime(_OverTime):
    """Motion over time of an object with dynamics."""

    @functools.cached_property
    def _input(self):
        return inputs.of_object(self._owner, self._entry, self._scene)

    def applied(self, times, matrices):
        """World matrices (n, 4, 4) of the object with its dynamics, from `matrices` without them, at times (n,) of the scene."""
        part, weight = self._part(self._owner, times)
        if part is None:
            return matrices
        count = len(times)
        matrices = np.broadcast_to(matrices, (count, 4, 4)).copy()
        moves, turns, ratios = part.at(inputs.seconds_of(np.asarray(times, float), self._scene), weight)
        if turns is not None:
            matrices = turned(matrices, turns, tracks.own_track(self._owner).values(times).scales)
        if ratios is not None:
            matrices[:, :3, :3] *= ratios[:, None, :]
        if moves is not None:
            matrices[:, :3, 3] += moves if part.in_world else self._in_world(times, moves)
        return matrices

    def _in_world(self, times, moves):
        """Convert moves (n, 3) from the space of the object's location channels to world space."""
        if self._owner.parent is None:
            return moves
        carried = carrier(self._owner, self._scene).values(times)
        space = rotations.chained(carried, in_world.parent_offset(self._owner))[:, :3, :3]
        return rotations.chained(space, moves[:, :, None])[:, :, 0]

    @property
    def stamp(self):
        """Hashable value that changes whenever the object's motion may. Its parents do not count: callers read them separately."""
        entry = self._entry
        settings = (getattr(entry, name) for name in KEYWORDS)
        return together(
            (
                *self._time,
                self._owner.motus.dynamics.influence,
                entry.is_muted,
                self._input.tracks[0].stamp,
                *(tuple(sorted(value)) if isinstance(value, set) else value for value in settings),
            )
        )


class _OwnBone(_OverTime):
    """Motion over time of a bone whose dynamics follow its own channels."""

    def __init__(self, owner, index, unit, bone, scene):
        super().__init__(owner, index, scene)
        self._thing, self._input = bone, unit.input(scene)

    @property
    def reason(self):
        """The Reason why the motion at other frames cannot be computed; None if it can."""
        return kept(self._owner, ("dynamics", self._index), lambda: super(_OwnBone, self).reason)

    def applied(self, times, transforms):
        """Transforms of the bone with its dynamics, from `transforms` of its own channels, at times (n,) of the scene."""
        part, weight = self._part(self._thing, times)
        if part is None:
            return transforms
        moves, turns, ratios = part.at(inputs.seconds_of(np.asarray(times, float), self._scene), weight)
        return transforms._replace(
            locations=transforms.locations if moves is None else transforms.locations + moves,
            rotations=transforms.rotations if turns is None else rotations.product(transforms.rotations, turns),
            scales=transforms.scales if ratios is None else transforms.scales * ratios,
        )

    @property
    def stamp(self):
        """Hashable value that changes whenever the bone's motion may."""
        return together((*self._time, self._index, stamp_of(self._owner), *(track.stamp for track in self._input.tracks)))


class _Tail(_OverTime):
    """Motion over time of a bone whose tail has dynamics; all such bones of its chain are solved together."""

    def __init__(self, owner, index, unit, bone, scene):
        super().__init__(owner, index, scene)
        self._unit, self._input = unit, unit.input(scene)
        self._row = unit.things.index(bone)
        parent = owner.data.bones[unit.things[0].name].parent
        read = {one.name: one for bone in unit.things for one in _down_to(bone, unit.things[0])}
        self._between = [one for one in read.values() if one not in unit.things]
        self._rig = RigInputs(owner, scene, ("dynamics", unit.name), read, parent.name if parent else "", (), dict)

    @property
    def reason(self):
        """The Reason why the motion at other frames cannot be computed; None if it can."""
        # Bones without dynamics between bones of the chain are read by their own channels, so constraints on them make them unknown.
        held = next(filter(None, map(in_world.constrained, self._between)), None)
        return held or super().reason or self._rig.reason

    def _channels(self):
        settings = self._owner.motus.dynamics
        return super()._channels([setup.find(settings, thing.name) for thing in self._unit.things])

    def applied(self, times, transforms):
        """Transforms of the bone with its dynamics, from `transforms` of its own channels, at times (n,) of the scene."""
        turns = once(self._owner, ("dynamics", self._unit.name), times, lambda: self._turns(times))
        return transforms if turns is None else transforms._replace(rotations=rotations.product(transforms.rotations, turns[:, self._row]))

    def _turns(self, times):
        """Quaternions (n, bones, 4) that dynamics add to the unit's bones at times (n,) of the scene; None if nothing moves."""
        names = [bone.name for bone in self._unit.things]
        count, places = len(times), [setup.find(self._owner.motus.dynamics, name) for name in names]
        try:
            tails = (
                motion.tails_of(
                    self._input, self._unit.things, self._unit.entries, range(len(names)), places, self._scene, self._reach(times)
                )
                if count
                else []
            )
        except ValueError:
            return None
        if not tails:
            return None
        seconds = inputs.seconds_of(np.asarray(times, float), self._scene)
        targets = np.zeros((count, len(names), 3))
        for one in tails:
            targets[:, one.rows] = one.track.evaluate(seconds - one.delay).reshape(count, -1, 3)
        shares = np.array([self._weight(entry) for entry in self._unit.entries])
        return self._rig.turns(times, names, targets, shares)

    @property
    def stamp(self):
        """Hashable value that changes whenever the bone's motion may."""
        above = [track.stamp for track, keywords in self._input.listed if keywords["transform"] == 'WORLD']
        return together((*self._time, self._row, self._rig.stamp, *above))


_OF_BONES = {'OWN': _OwnBone, 'TAILS': _Tail}


def _down_to(bone, top):
    """Yield a bone and its parents up to the bone `top`, which is included."""
    while bone != top:
        yield bone
        bone = bone.parent
    yield top
