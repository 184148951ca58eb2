"""Motion of a bone of a chain at any times, for systems of Motus that need its past."""

import functools

from ..core.animation import keys
from ..core.animation.channel import Channel
from ..core.animation.reason import Reason
from ..core.animation.strips import together
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.settings import entry_keys
from ..core.tracks import in_world, rotations
from ..core.tracks.inputs import Tails
from ..core.tracks.rig_inputs import RigInputs, once
from . import colliders, groups, making, setup, uneven


def over_time(owner, thing, scene):
    """Return the motion over time of a bone with its chain; None if it belongs to none. This is the function System.over_time.

    owner, thing: both original or both evaluated.
    """
    chain = next((chain for chain in groups.chains(owner) if thing in chain.bones), None)
    return chain and _Bone(owner, chain, thing, scene)


class _Bone:
    """Motion over time of a bone of a chain. Its members are listed in core/tracks/solved.py."""

    def __init__(self, owner, chain, bone, scene):
        self._owner, self._chain, self._scene = owner, chain, scene
        self._row = chain.bones.index(bone)
        self._input = Tails(chain.bones, scene, setup.system())
        self._name = "chains", chain.entry.name
        self._rig = RigInputs(owner, scene, self._name, list(chain.names), chain.parent, (), dict)

    @functools.cached_property
    def _around(self):
        settings = self._owner.motus.chains
        touched = tuple(colliders.objects(settings))
        return making.Surroundings(self._owner, self._scene, self._scene, making.cuts(settings, self._scene), touched, self._chain.names)

    @property
    def reason(self):
        """The Reason why the motion at other frames cannot be computed; None if it can."""
        settings = self._owner.motus.chains
        index = settings.entries.find(self._chain.entry.name)
        prefix = entry_keys.animated_prefix(self._owner, "motus.chains.entries", settings.entries, index)
        paths = "motus.chains.influence", f"{prefix}weight", f"{prefix}is_muted"
        if not all(Channel(self._owner, path, -1).is_constant for path in paths):
            return Reason(Reason.INFLUENCE, thing=self._owner.name, name=self._owner.name)
        acting = (in_world.constrained(bone, setup.system()) for bone in self._chain.bones)
        return (
            next(filter(None, acting), None) or next((track.reason for track in self._read if not track.is_known), None) or self._rig.reason
        )

    @property
    def _read(self):
        around = self._around
        held = [track for pin in around.pins for track in (pin.place, pin.weight)]
        return [*self._input.tracks, *(track for solid in around.colliders for track in solid.tracks), *around.gravity, *around.wind, *held]

    def bounds(self, first, last):
        """Return rising frames from first to last; the motion is smooth between neighbours."""
        return keys.union([[first, *keys.whole(first, last), last], *(track.bounds(first, last) for track in self._read)])

    @property
    def extent(self):
        """First and last frame between which the motion changes: infinite, for a chain swings on after what moved it."""
        return -np.inf, np.inf

    def applied(self, times, transforms):
        """Transforms of the bone in its chain, from `transforms` of its own channels, at times (n,) of the scene."""
        turns = once(self._owner, self._name, times, lambda: self._turns(times))
        return transforms if turns is None else transforms._replace(rotations=rotations.product(transforms.rotations, turns[:, self._row]))

    def _turns(self, times):
        """Quaternions (n, bones, 4) that the chain adds to its bones at times (n,) of the scene; None if it has no motion."""
        entry, settings = self._chain.entry, self._owner.motus.chains
        weight = 0.0 if entry.is_muted else settings.influence * entry.weight
        if weight <= 0.0 or len(times) == 0:
            return None
        names = list(self._chain.names)
        found = making.Making(self._owner, settings, self._around, 1.0)
        found.make([names])
        if not found.chains:
            return None
        moved, _, links = found.chains[0]
        seconds = scene_time.seconds(self._scene, np.asarray(times, float))
        worlds = self._rig.worlds(times).reshape(-1, 4, 4).swapaxes(1, 2)
        places = np.stack([uneven.tails(moved.places(at), links, uneven.axes_of(world)) for at, world in zip(seconds, worlds)])
        return self._rig.turns(times, names, places, np.full(len(names), weight))

    @property
    def stamp(self):
        """Hashable value that changes whenever the bone's motion may."""
        above = [track.stamp for track, keywords in self._input.listed if keywords["transform"] == 'WORLD']
        return together((self._row, self._rig.stamp, self._around.stamp, *above))
