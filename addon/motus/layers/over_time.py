"""Transforms of bones with all layers applied, at any times, for systems of Motus that need the past of bones."""

import math

from ..core import rigs
from ..core.animation import keys
from ..core.animation.reason import Reason
from ..core.animation.strips import together
from ..core.evaluated import read_keys
from ..core.evaluated.question import answered
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.settings import entry_keys
from ..core.tracks import rotations
from ..core.tracks.rig_inputs import RigInputs, SolvedBone, kept, once
from ..core.tracks.transforms import Own
from ..core.wiring import driven_bones
from . import groups, live, solve

MOST_AT_ONCE = 500_000
"""Greatest number of transforms (bones times frames) that are computed together for all masked bones of a rig."""
_KEYED = ("weight", "is_muted")


def over_time(owner, thing, _scene):
    """Return the transform over time of a bone with all layers applied; None if no layer moves the bone.

    This is the function System.over_time. owner, thing: the rig and a PoseBone of it, original or evaluated.
    """
    return OverTime(owner, thing) if thing.name in _masked(owner) else None


def _masked(owner):
    return kept(owner, ("layers", "masked"), lambda: frozenset(groups.masked(owner)))


def _inputs(owner, names, is_steady, paths):
    """Make the RigInputs that read bones over time. is_steady: whether all parents of the bones are read as well.

    paths: function that returns the data paths of the layers' settings that may be animated.
    """
    bones = owner.data.bones
    above = [one.name for name in names for one in bones[name].parent_recursive] if is_steady else []
    read = tuple(dict.fromkeys([*names, *above]))
    return RigInputs(owner, None, ("layers", names, is_steady), read, "", [], paths, lays_pose=True)


class OverTime(SolvedBone):
    """Transform over time of a bone in the mask of a layer, with all layers applied. bone: original or evaluated.

    Its members are listed in core/tracks/solved.py.
    """

    price = 50
    """Price of one transform, in the unit of core/measures/bounds.py: about 50 microseconds."""

    def __init__(self, owner, bone):
        self._owner, self._bone = owner, bone
        self._layers = list(owner.motus.layers.entries)
        self._is_steady = any(entry.in_armature for entry in self._layers)
        super().__init__(_inputs(owner, (bone.name,), self._is_steady, self._paths))
        self.bounds = self._bounds

    def _paths(self):
        prefixes = [
            entry_keys.animated_prefix(self._owner, "motus.layers.entries", self._owner.motus.layers.entries, index)
            for index in range(len(self._layers))
        ]
        found = {(index, name): (prefix + name, -1) for index, prefix in enumerate(prefixes) for name in _KEYED}
        return found | {"influence": ("motus.layers.influence", -1)}

    @property
    def reason(self):
        """Reason why the bone's transform is unknown at frames other than the present one; None if it is known.

        While a layer is edited, strips of the NLA stand for what lies beneath it.
        """
        if live.edited(self._owner) is not None:
            return Reason(Reason.STRIPS, thing=self._owner.name)
        return super().reason

    @property
    def _spans(self):
        """Yield (first, last) frame of the scene on which a layer plays its action, for each layer that has an action."""
        for entry in self._layers:
            action = pointed(entry, "action")
            if action:
                first, last = solve.span(entry, action.frame_range)
                length = (last - first) / abs(entry.speed) if entry.speed else 0.0
                yield entry.start, math.inf if entry.after == 'REPEAT' and length else entry.start + length

    def _bounds(self, first, last):
        """Return rising frames from first to last; the bone's motion is smooth between neighbours. Ends of layers are among them."""
        ends = {end for span in self._spans for end in span if first < end < last}
        return keys.union([[first, *sorted(ends), last], self._inputs.bounds(first, last)])

    @property
    def extent(self):
        """First and last frame between which the bone's motion under the layers changes; None if it does not change."""
        return keys.united([self._inputs.extent, *self._spans])

    @property
    def stamp(self):
        """Hashable value that changes whenever the bone's motion under the layers may."""
        playing = list(filter(None, (pointed(entry, name) for entry in self._layers for name in ("action", "reference_action"))))
        return together((self._bone.name, self._inputs.stamp, *map(read_keys.number_of, playing)))

    def applied(self, times, transforms):
        """Transforms of the bone with all layers applied, from `transforms` of its own channels, at times (n,) of the scene."""
        names = self._together(times)
        found = once(self._owner, ("layers", *names), times, lambda: self._solved(names, times))
        moves, turns, sizes = (part[:, names.index(self._bone.name)] for part in found)
        is_free = "location" in groups.channels_of(self._bone)
        return transforms._replace(
            locations=transforms.locations + moves if is_free else transforms.locations,
            rotations=rotations.product(transforms.rotations, turns),
            scales=transforms.scales * sizes,
        )

    def _together(self, times):
        """Return the names of the bones that are solved together with this bone.

        They are all masked bones whose motion is known, because callers usually read these as well; but this bone alone if
        the transforms at times (n,) would be more than MOST_AT_ONCE.
        """
        masked = _masked(self._owner)
        if len(masked) * len(times) > MOST_AT_ONCE:
            return (self._bone.name,)
        return answered(
            (hash(self._owner), "layers"),
            lambda: tuple(bone.name for bone in self._owner.pose.bones if bone.name in masked and self._is_known(bone)),
        )

    def _is_known(self, bone):
        return not any(Own(one).reason for one in (bone, *(bone.parent_recursive if self._is_steady else ())))

    def _solved(self, names, times):
        """Return (moves, quaternions, ratios of scale) that the layers add to the bones' own transforms at times (n,).

        Their shapes are (n, bones, 3), (n, bones, 4) and (n, bones, 3). names: of the bones.
        """
        owner = self._owner
        text = groups.plan_of(owner, names, driven_bones(owner))
        wired = rigs.plan(owner, text, lambda rig, rows: solve.Wired(rig, rows, text))
        source = solve.Source(owner, None, wired)
        clips = source.clips()
        rows = [row for row, clip in enumerate(clips) if clip is not None]
        settings, weights = solve.still_settings(self._layers, clips)[rows], self._weights(times)[:, rows]
        playing, laid = solve.Playing(source, clips, rows), np.empty((len(names), 16), np.float32)
        moves, turns, sizes = (np.empty((len(times), len(names), width)) for width in (3, 4, 3))
        for place, (_, basis) in enumerate(_inputs(owner, names, self._is_steady, self._paths).rows(times, rigs.names_of(owner))):
            settings[:, solve.WEIGHT] = weights[place]
            playing.lay(float(times[place]), settings, basis, moves[place], turns[place], sizes[place], laid)
        return moves, turns, sizes

    def _weights(self, times):
        """Return the weights of the L layers at times (n,), as an array (n, L). The weight of a muted layer is 0."""
        numbers = self._inputs.numbers(times)
        found = [
            np.where(is_silent | (numbers[index, "is_muted"] != 0.0), 0.0, numbers["influence"] * numbers[index, "weight"])
            for index, is_silent in enumerate(solve.silenced(self._layers))
        ]
        return np.stack(found, axis=1)
