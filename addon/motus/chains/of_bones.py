"""Chains of bones: a bone with all bones below it, which turn so that their tails lie where the particles are."""

from typing import Any, NamedTuple

from ..core import rigs
from ..core.declare import BonesOwn, Member, Transform
from ..core.lazy import numpy as np
from ..core.tracks import own_track
from ..core.tracks.inputs import Tails, stamp_of_carrier, stamp_of_known
from . import squash, uneven

TURN = frozenset({"rotation"})
SQUASH = frozenset({"rotation", "scale"})


class Bones(NamedTuple):
    """A chain of bones. entry: its settings. things: its PoseBones, each after its parent, the topmost one first.

    of_objects.Row has the same attributes, for objects.
    """

    entry: Any
    things: tuple

    @property
    def names(self):
        """Names of the bones, as a tuple."""
        return tuple(bone.name for bone in self.things)

    @property
    def pinnable(self):
        """Names of the bones whose tails pins may hold."""
        return self.names

    @property
    def drives(self):
        """The names, which the order of evaluation is found from."""
        return self.names

    @property
    def yields(self):
        """Names of all bones but the topmost one: where a different system takes one over the chain ends, and so the system follows it."""
        return self.names[1:]

    @property
    def hangs_on(self):
        """Name of the bone on which the chain hangs; "" if there is none."""
        parent = self.things[0].parent
        return parent.name if parent else ""

    @property
    def reads(self):
        """((object, name of a bone or ""), ...) of each transform that the chain needs."""
        return ((self.things[0].id_data, self.hangs_on),)

    @property
    def inputs(self):
        """Inputs of the Group for which the solver waits."""
        rig = self.things[0].id_data
        return (Transform(rig, self.hangs_on), *(BonesOwn(rig, bone.name) for bone in self.things))

    @property
    def members(self):
        """Members of the Group: the bones, which turn, and with Squash are scaled, on top of their own transforms."""
        channels = SQUASH if self.entry.squash > 0.0 else TURN
        return tuple(Member(bone, channels, 'LOCAL', is_relative=True) for bone in self.things)

    @property
    def parents(self):
        """Index of the parent of each particle, -1 first: the head of the topmost bone, then the tail of each bone."""
        places = {bone.name: place for place, bone in enumerate(self.things, 1)}
        return [-1, 0, *(places[bone.parent.name] for bone in self.things[1:])]

    def is_as_wired(self, names):
        """Whether the chain has the things that had these names when the owner was wired."""
        return self.names == tuple(names)

    @property
    def links(self):
        """The bones as links."""
        return uneven.Links(self.parents, [bone.bone.length for bone in self.things])

    def kept(self, _source):
        """The Kept."""
        return Kept(self.names, self.links, squash.shares(self.things, self.entry.squash))

    @property
    def ends(self):
        """Both ends of each link, as they stand now, in the world. For evaluated bones."""
        world = self.things[0].id_data.matrix_world
        return [world @ end for bone in self.things for end in (bone.head, bone.tail)]

    @staticmethod
    def read_by(source):
        """List what an input reads that may change although neither the rig nor its keys are edited: hashable, with stamp(owner, scene)."""
        return [*map(Carrier, source.carriers), *map(Laid, source.laid)]

    def source(self, scene):
        """Make the input (core/tracks/inputs.py) with the places of the particles in the animation."""
        return Tails(self.things, scene, None)


class Carrier(NamedTuple):
    """What a chain reads beside its rig and keys: the motion of what its bones hang on. name: as in core/tracks/inputs.py."""

    name: Any

    def stamp(self, owner, scene):
        """Hashable value that changes whenever that motion may; None if changes cannot be detected."""
        return stamp_of_carrier(owner, self.name, scene, None)


class Laid(NamedTuple):
    """What a chain reads beside its rig and keys: poses that a different system lays over a bone. name: of the bone."""

    name: str

    def stamp(self, owner, _scene):
        """Hashable value that changes whenever these poses may; None if changes cannot be detected."""
        return stamp_of_known(own_track(owner.pose.bones[self.name]))


class Kept(NamedTuple):
    """What is kept of a chain between evaluations. names: of its bones. links: the bones as links. shares: squash.shares() of them."""

    names: tuple
    links: uneven.Links
    shares: Any

    def aimed(self, particles, part, seconds, weight, axes):
        """Return (where the tails of the bones come to, their scales), both (n, 3), at a time, s.

        particles: places (n + 1, 3). part: the making.Part. axes: uneven.axes_of() the rig.
        """
        parents, lengths = self.links
        scales = np.ones((len(self.names), 3))
        if self.shares:
            taken = [share * weight for share in self.shares]
            scales, lengths = squash.sizes(particles, part.rests.at(part.moved.within(seconds)), parents, taken, axes)
        return uneven.tails(particles, parents, lengths, axes), scales

    @staticmethod
    def fill(context, text, parts):
        """Turn and scale bones of the context's owner to their particles. text: stands for what the rig was when it was wired.

        parts: [(making.Part, places (n + 1, 3) of its particles, weight)].
        """
        members = tuple(pair for part, *_ in parts for pair in zip(part.kept.names, part.rows))
        axes, seconds = uneven.axes_of(context.owner.matrix_world), context.frame / context.fps
        aims = [part.kept.aimed(particles, part, seconds, weight, axes) for part, particles, weight in parts]
        places, scales = (np.concatenate(found) for found in zip(*aims))
        influences = np.concatenate([np.full(len(part.rows), weight) for part, _, weight in parts])
        rigs.turn(context, text, members, places, influences, scales if any(part.kept.shares for part, *_ in parts) else None)
