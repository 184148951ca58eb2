"""Motion of a bone or object of a chain at any times, for systems of Motus that need its past."""

import functools

from ..core.animation import keys
from ..core.animation.channel import Channel
from ..core.animation.reason import Reason
from ..core.animation.strips import together
from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.settings import entry_keys
from ..core.tracks import in_world, rotations
from ..core.tracks.rig_inputs import RigInputs, once
from . import colliders, groups, making, setup, uneven
from .of_bones import Bones
from .properties import KEYWORDS


def over_time(owner, thing, scene):
    """Return the motion over time of a bone or object with its chain; None if it belongs to none. This is the function System.over_time.

    owner, thing: both original or both evaluated. An object that has chains of its own may hang on a chain of a different owner.
    """
    for one in (owner, pointed(thing.motus.chains, "leader") if thing == owner else None):
        chain = one and not deleted.is_deleted(one) and next((chain for chain in groups.chains(one) if thing in chain.things), None)
        if chain:
            return (_Bone if isinstance(chain, Bones) else _Object)(one, chain, thing, scene)
    return None


class _Hanging:
    """Base class of the motion over time of a bone or object of a chain. Its members are listed in core/tracks/solved.py."""

    def __init__(self, owner, chain, thing, scene):
        self._owner, self._chain, self._scene = owner, chain, scene
        self._row = chain.things.index(thing)
        self._input = chain.source(scene)
        self._name = "chains", chain.entry.name

    @functools.cached_property
    def _around(self):
        settings = self._owner.motus.chains
        touched = tuple(colliders.objects(settings))
        names = {name for chain in self._together for name in chain.pinnable}
        return making.Surroundings(self._owner, self._scene, self._scene, making.cuts(settings, self._scene), touched, names)

    @functools.cached_property
    def _together(self):
        """List of the chains that are solved with this one, and it itself: those that it touches."""
        return groups.beside(self._owner, self._chain) if self._owner.motus.chains.use_touch else [self._chain]

    @functools.cached_property
    def _inputs(self):
        """Inputs (core/tracks/inputs.py) of these chains."""
        return [self._input if chain is self._chain else chain.source(self._scene) for chain in self._together]

    @property
    def reason(self):
        """The Reason why the motion at other frames cannot be computed; None if it can."""
        settings = self._owner.motus.chains
        index = settings.entries.find(self._chain.entry.name)
        prefix = entry_keys.animated_prefix(self._owner, "motus.chains.entries", settings.entries, index)
        paths = "motus.chains.influence", f"{prefix}weight", f"{prefix}is_muted"
        if not all(Channel(self._owner, path, -1).is_constant for path in paths):
            return Reason(Reason.INFLUENCE, thing=self._owner.name, name=self._owner.name)
        acting = (in_world.constrained(thing, setup.system()) for thing in self._chain.things)
        return (
            next(filter(None, acting), None)
            or next((track.reason for track in self._read if not track.is_known), None)
            or next(filter(None, (one.reason for one in self._inputs)), None)
        )

    @property
    def _read(self):
        around = self._around
        held = [track for pin in around.pins for track in (pin.place, pin.weight)]
        own = [track for one in self._inputs for track in one.tracks]
        touched = [track for solid in around.colliders for track in solid.tracks]
        winds = [*around.wind, *(around.snowy.along if around.snowy else ())]
        return [*own, *touched, *around.gravity, *winds, *held]

    def bounds(self, first, last):
        """Return rising frames from first to last; the motion is smooth between neighbours."""
        return keys.union([[first, *keys.whole(first, last), last], *(track.bounds(first, last) for track in self._read)])

    @property
    def extent(self):
        """First and last frame between which the motion changes: infinite, for a chain swings on after what moved it."""
        return -np.inf, np.inf

    @property
    def _stamp_of_all(self):
        """Hashable value that changes whenever the motion of the chain may; None if changes cannot be detected."""
        raise NotImplementedError

    @property
    def stamp(self):
        """Hashable value that changes whenever the motion of the bone or object may; None if changes cannot be detected."""
        return together((self._row, self._stamp_of_all))

    @property
    def _weight(self):
        entry = self._chain.entry
        return 0.0 if entry.is_muted else self._owner.motus.chains.influence * entry.weight

    def _part(self, times):
        """The making.Part of the chain; None if it has no motion at times (n,) of the scene."""
        if self._weight <= 0.0 or len(times) == 0:
            return None
        found = making.Making(self._owner, self._owner.motus.chains, self._around, 1.0)
        found.make([(chain.entry.name, chain.names) for chain in self._together])
        own = self._owner.motus.chains.entries.find(self._chain.entry.name)
        return next((part for part in found.parts if part.entry == own), None)

    def _seconds(self, times):
        return scene_time.seconds(self._scene, np.asarray(times, float))

    @staticmethod
    def _particles(part, seconds):
        """Places (n, particles, 3) of a Part in the world at times (n,), s."""
        return np.stack([part.moved.places(at)[part.particles] for at in seconds])


class _Bone(_Hanging):
    """Motion over time of a bone of a chain."""

    def __init__(self, owner, chain, bone, scene):
        super().__init__(owner, chain, bone, scene)
        self._rig = RigInputs(owner, scene, self._name, chain.names, chain.hangs_on, (), dict)

    @property
    def reason(self):
        """The Reason why the motion at other frames cannot be computed; None if it can."""
        return super().reason or self._rig.reason

    def applied(self, times, transforms):
        """Transforms of the bone in its chain, from `transforms` of its own channels, at times (n,) of the scene."""
        found = once(self._owner, self._name, times, lambda: self._changes(times), lambda: self._stamp_of_all)
        if found is None:
            return transforms
        turns, scales = (one[:, self._row] for one in found)
        return transforms._replace(rotations=rotations.product(transforms.rotations, turns), scales=transforms.scales * scales)

    def _changes(self, times):
        """(quaternions (n, bones, 4), scales (n, bones, 3)) that the chain adds to its bones at times (n,); None if it has no motion."""
        part, names = self._part(times), self._chain.names
        if part is None:
            return None
        seconds = self._seconds(times)
        worlds = self._rig.worlds(times).reshape(-1, 4, 4).swapaxes(1, 2)
        aims = [
            part.kept.aimed(particles, part, at, self._weight, uneven.axes_of(world))
            for particles, at, world in zip(self._particles(part, seconds), seconds, worlds)
        ]
        places, scales = (np.stack(found) for found in zip(*aims))
        return self._rig.turns(times, names, places, np.full(len(names), self._weight), scales), scales

    @property
    def _stamp_of_all(self):
        above = [track.stamp for one in self._inputs for track, keywords in one.listed if keywords["transform"] == 'WORLD']
        return together((self._rig.stamp, self._around.stamp, *above))


class _Object(_Hanging):
    """Motion over time of an object of a row."""

    def applied(self, times, matrices):
        """World matrices (n, 4, 4) of the object in its row, from `matrices` without it, at times (n,) of the scene."""
        moved = once(self._owner, self._name, times, lambda: self._moved(times), lambda: self._stamp_of_all)
        if moved is None:
            return matrices
        found = np.broadcast_to(matrices, (len(times), 4, 4)).copy()
        found[:, :3, :3] = rotations.chained(rotations.matrices(moved.turns[self._row]), found[:, :3, :3])
        found[:, :3, 3] += moved.moves[self._row]
        return found

    def _moved(self, times):
        part = self._part(times)
        if part is None:
            return None
        return self._input.moved(np.asarray(times, float), self._particles(part, self._seconds(times)), self._weight)

    @property
    def _stamp_of_all(self):
        settings = self._owner.motus.chains
        numbers = [getattr(chain.entry, name) for chain in self._together for name in (*KEYWORDS, "weight", "is_muted", "hold_end")]
        shared = (
            settings.influence,
            settings.gusts,
            settings.gust_frequency,
            settings.settle,
            settings.use_loop,
            settings.friction,
            settings.inherit,
            settings.use_touch,
        )
        return together((*numbers, *shared, *(one.stamp for one in self._inputs), self._around.stamp))
