"""Where an object with dynamics is at any times, for systems that need its past."""

import functools

from ..core import tracks
from ..core.lazy import numpy as np
from ..core.tracks import rotations
from ..core.tracks.animation import Channel
from ..core.tracks.question import answered
from ..core.tracks.reason import Reason
from ..core.tracks.solved import turned
from ..core.tracks.strips import together
from . import inputs, motion, setup
from .properties import KEYWORDS


def over_time(owner, thing, scene):
    """System.over_time; None where the object itself has no dynamics."""
    index = setup.find(owner.motus.dynamics, "") if thing == owner else -1
    return OverTime(owner, index, scene) if index >= 0 else None


class OverTime:
    """An object that follows; see core/tracks/solved.py. Original or evaluated."""

    def __init__(self, owner, index, scene):
        self._owner, self._index, self._scene = owner, index, scene
        self._entry = owner.motus.dynamics.entries[index]

    @functools.cached_property
    def _input(self):
        return inputs.of_object(self._owner, self._entry, self._scene)

    def _channels(self):
        paths = self._owner.motus.dynamics.path_from_id() + ".influence", f"{self._entry.path_from_id()}.weight"
        return [Channel(self._owner, path, -1) for path in paths]

    @property
    def reason(self):
        """As Channel.reason."""
        if not all(channel.is_constant for channel in self._channels()):
            return Reason(Reason.INFLUENCE, thing=self._owner.name, name=self._owner.name)
        source = self._input
        return source.reason or next((track.reason for track in source.tracks if not track.is_known), None)

    def applied(self, times, matrices):
        """See core/tracks/solved.py."""
        entry, count = self._entry, len(times)
        weight = 0.0 if entry.is_muted else self._owner.motus.dynamics.influence * entry.weight
        if weight <= 0.0 or count == 0:
            return matrices
        reach = inputs.reach(self._scene, float(np.max(times)))
        part = answered((hash(self._owner), hash(self._scene), "dynamics", reach), lambda: self._part(reach))
        if part is None:
            return matrices
        matrices = np.broadcast_to(matrices, (count, 4, 4)).copy()
        moves, turns, ratios = part.at(inputs.seconds_of(np.asarray(times, float), self._scene), weight)
        if turns is not None:
            matrices = turned(matrices, turns, tracks.own_track(self._owner).values(times).scales)
        if ratios is not None:
            matrices[:, :3, :3] *= ratios[:, None, :]
        if moves is not None:
            matrices[:, :3, 3] += moves if part.in_world else self._in_world(times, moves)
        return matrices

    def _part(self, reach):
        try:
            return motion.part_of(self._owner, self._entry, 0, self._index, self._scene, reach)
        except (ValueError, motion.OpenLoop):
            return None

    def _in_world(self, times, moves):
        """Moves (n, 3) in the space of the object's own location, in world space."""
        if self._owner.parent is None:
            return moves
        carried = inputs.carrier(self._owner, self._scene).values(times)
        space = rotations.chained(carried, inputs.transforms.parent_offset(self._owner))[:, :3, :3]
        return rotations.chained(space, moves[:, :, None])[:, :, 0]

    def bounds(self, first, last):
        """As Channel.bounds(): at each frame."""
        found = [track.bounds(first, last) for track in self._input.tracks]
        return inputs.keys.union([[first, *inputs.keys.whole(first, last), last], *found])

    @property
    def extent(self):
        """As Channel.extent: it swings on for ever."""
        found = self._input.extent
        return None if found is None else (-np.inf, np.inf)

    @property
    def stamp(self):
        """As Channel.stamp, of what no parent brings: whoever asks for the object asks for its parents too."""
        entry, render = self._entry, self._scene.render
        return together((
            render.fps, render.fps_base, self._scene.frame_start, self._owner.motus.dynamics.influence, entry.is_muted,
            *(tuple(sorted(value)) if isinstance(value, set) else value for value in (getattr(entry, name) for name in KEYWORDS)),
            tracks.own_track(self._owner).stamp))
