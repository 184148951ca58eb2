"""Where bones under layers are at any times, for systems that need their past: the layers are laid for each time."""

import math

from ..core import entry_keys, read_keys, rigs
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.tracks import keys, rotations
from ..core.tracks.rig_inputs import RigInputs, SolvedBone, kept, once
from ..core.tracks.strips import together
from ..core.wiring import driven_bones
from . import groups, solve

_KEYED = ("weight", "is_muted")


def over_time(owner, thing, scene):
    """System.over_time; None for what no layer moves."""
    masked = kept(owner, ("layers", "masked"), lambda: frozenset(groups.masked(owner)))
    return OverTime(owner, thing, scene) if thing.name in masked else None


class OverTime(SolvedBone):
    """A bone in the mask of a layer; see core/tracks/solved.py. Original or evaluated."""

    def __init__(self, owner, bone, scene):
        self._owner, self._bone = owner, bone
        self._layers = list(owner.motus.layers.entries)
        is_steady = any(entry.in_armature for entry in self._layers)
        above = [one.name for one in bone.bone.parent_recursive] if is_steady else []
        super().__init__(RigInputs(
            owner, scene, ("layers", bone.name, is_steady), [bone.name, *above], "", [], self._paths, lays_pose=True))
        self.bounds = self._bounds

    def _paths(self):
        prefixes = [entry_keys.animated_prefix(self._owner, "motus.layers.entries", self._owner.motus.layers.entries, index)
                    for index in range(len(self._layers))]
        found = {(index, name): (prefix + name, -1) for index, prefix in enumerate(prefixes) for name in _KEYED}
        return found | {"influence": ("motus.layers.influence", -1)}

    @property
    def _spans(self):
        """(first, last) frame of the scene on which each layer changes something."""
        for entry in self._layers:
            if entry.action:
                first, last = solve.span(entry, entry.action.frame_range)
                length = (last - first) / abs(entry.speed) if entry.speed else 0.0
                yield entry.start, math.inf if entry.after == 'REPEAT' and length else entry.start + length

    def _bounds(self, first, last):
        """As Channel.bounds(): a layer may begin and end between frames."""
        ends = {end for span in self._spans for end in span if first < end < last}
        return keys.union([[first, *sorted(ends), last], self._inputs.bounds(first, last)])

    @property
    def extent(self):
        """As Channel.extent."""
        return keys.united([self._inputs.extent, *self._spans])

    @property
    def stamp(self):
        """As Channel.stamp."""
        playing = list(filter(None, (pointed(entry, "action") for entry in self._layers)))
        return together((self._bone.name, self._inputs.stamp, *map(read_keys.number_of, playing)))

    def applied(self, times, transforms):
        """See core/tracks/solved.py."""
        moves, turns, sizes = once(self._owner, ("layers", self._bone.name), times, lambda: self._solved(times))
        is_free = "location" in groups.channels_of(self._bone)
        return transforms._replace(
            locations=transforms.locations + moves if is_free else transforms.locations,
            rotations=rotations.product(transforms.rotations, turns), scales=transforms.scales * sizes)

    def _solved(self, times):
        """(n, 3), (n, 4), (n, 3) of what comes on top of the bone's own transform."""
        owner, name = self._owner, self._bone.name
        text = groups.plan_of(owner, [name], driven_bones(owner))
        wired = rigs.plan(owner, text, lambda rig, rows: solve.Wired(rig, rows, text))
        source = solve.Source(owner, wired)
        clips, numbers = source.clips(), self._inputs.numbers(times)
        settings = solve.still_settings(self._layers, clips)
        moves, turns, sizes = np.empty((len(times), 3)), np.empty((len(times), 4)), np.empty((len(times), 3))
        for place, (_, basis) in enumerate(self._inputs.rows(times, rigs.names_of(owner))):
            for index in range(len(self._layers)):
                weight = numbers["influence"][place] * numbers[index, "weight"][place]
                settings[index, solve.WEIGHT] = 0.0 if numbers[index, "is_muted"][place] else weight
            solve.lay(source, clips, settings, float(times[place]), basis, moves[place:place + 1], turns[place:place + 1],
                      sizes[place:place + 1])
        return moves, turns, sizes
