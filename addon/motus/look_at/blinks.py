"""Blinks along with large turns of the gaze, which is known at any time from tracks of the targets and of what carries the head.

A blink begins where the gaze, the direction in the world from the head to its targets, has turned by more than an angle within
2 * AROUND * STEP seconds. The times that are looked at are multiples of STEP, so that each frame finds the same blinks.
"""

import functools
import math

from mathutils import Matrix

from ..core import native
from ..core.file import deleted
from ..core.lazy import numpy as np
from ..core.settings import entry_keys
from ..core.tracks import property_track, world_track
from ..core.tracks.inputs import Input
from . import anatomy, groups

STEP = 0.02
"""Seconds between the times at which turns of the gaze are looked for."""
AROUND = 5
"""Number of steps before and after a time between which the turn is measured."""
LASTS = 0.3
"""Seconds that a blink takes (native.module.blink)."""


class Gaze(Input):
    """Direction in the world in which a head looks over time, from the head's place on the bone that carries spine and head.

    owner: the rig, original or evaluated. index: of the head's entry. bones: names of the bones that the entry turns.
    """

    def __init__(self, owner, index, bones, scene):
        super().__init__(owner, scene)
        self._entry, self._bones = owner.motus.look_at.entries[index], bones
        self._prefix = entry_keys.animated_prefix(owner, "motus.look_at.entries", owner.motus.look_at.entries, index)

    @functools.cached_property
    def _carrier(self):
        return self._thing.data.bones[self._bones[0]].parent

    @functools.cached_property
    def _goals(self):
        """(index among the targets, object, bone or "") of each target that is there."""
        found = []
        for index, (goal, bone) in enumerate(groups.goals(self._entry)):
            if goal and not deleted.is_deleted(goal) and not (goal.pose and bone and bone not in goal.pose.bones):
                found.append((index, goal, bone if goal.pose else ""))
        return found

    @functools.cached_property
    def listed(self):
        """[(track, keywords of motus.track_record)]: of the carrier, of the targets, and of the weights of the look and of the targets."""
        rig, scene = self._thing, self._scene
        things = [(rig, self._carrier.name if self._carrier else ""), *((goal, bone) for _, goal, bone in self._goals)]
        found = []
        for obj, bone in things:
            names = {"datablock": obj.name, "transform": 'WORLD'} | ({"bone": bone} if bone else {})
            found.append((world_track(obj.pose.bones[bone] if bone else obj, scene), names))
        paths = ["motus.look_at.influence", *(self._prefix + name for name in ("weight", *self._weights))]
        return [*found, *((property_track(rig, path), {"datablock": rig.name, "data_path": path}) for path in paths)]

    @property
    def _weights(self):
        """Data paths in the entry of the weights of the targets that are there."""
        return ["target_weight" if index == 0 else f"extra_targets[{index - 1}].weight" for index, *_ in self._goals]

    def directions(self, frames):
        """Unit vectors of the gaze in the world at frames (n,), (n, 3)."""
        values = [track.values(frames) for track, _ in self.listed]
        count = len(self._goals)
        carrier, goals, (influence, weight, *weights) = values[0], values[1 : count + 1], values[count + 1 :]
        place, ahead = self._seen_from_carrier
        places = _product(carrier, place) + carrier[:, :3, 3]
        found, total = np.zeros((len(frames), 3)), np.zeros(len(frames))
        for goal, share in zip(goals, weights):
            share = np.maximum(share, 0.0)
            found += share[:, None] * _unit(goal[:, :3, 3] - places)
            total += share
        share = np.clip(influence * weight, 0.0, 1.0) * np.minimum(total, 1.0)
        looked = found / np.where(total > 0.0, total, 1.0)[:, None]
        return _unit((1.0 - share)[:, None] * _unit(_product(carrier, ahead)) + share[:, None] * looked)

    @functools.cached_property
    def _seen_from_carrier(self):
        """(place of the head, direction in which its face looks) at rest, in the space of the carrier."""
        head = self._thing.data.bones[self._entry.name]
        back = self._carrier.matrix_local.inverted_safe() if self._carrier else Matrix()
        ahead = head.matrix_local.to_3x3() @ anatomy.head_forward(self._thing, self._entry)
        return back @ head.head_local, back.to_3x3() @ ahead

    def closed(self, frame, angle):
        """How far blinks along with turns by more than an angle, in radians, have shut the eyes on a frame, 0 to 1."""
        if self.extent is None:
            return 0.0
        seconds = frame / self.fps
        first, last = math.ceil((seconds - LASTS) / STEP), math.floor(seconds / STEP)
        steps = np.arange(first - 1 - AROUND, last + AROUND + 1)
        ways = self.directions(steps * STEP * self.fps)
        before, after = ways[: -2 * AROUND], ways[2 * AROUND :]
        turns = before[:, 0] * after[:, 0] + before[:, 1] * after[:, 1] + before[:, 2] * after[:, 2] < math.cos(angle)
        begun = np.flatnonzero(turns[1:] & ~turns[:-1]) + first
        return max((native.module.blink(seconds - step * STEP) for step in begun.tolist()), default=0.0)


def _product(matrices, vector):
    """Vector of a space in the world, (n, 3). Sums are made by hand, so that each time has the same bits among any others."""
    x, y, z = vector
    return matrices[:, :3, 0] * x + matrices[:, :3, 1] * y + matrices[:, :3, 2] * z


def _unit(vectors):
    """Vectors (n, 3) at unit length; those without length stay as they are."""
    sizes = np.sqrt(vectors[:, 0] * vectors[:, 0] + vectors[:, 1] * vectors[:, 1] + vectors[:, 2] * vectors[:, 2])
    return vectors / np.where(sizes > 0.0, sizes, 1.0)[:, None]
