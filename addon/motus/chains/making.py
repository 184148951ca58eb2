"""Make the motions of chains, from what their animation and their surroundings are over the scene."""

import functools
import math
from typing import Any, NamedTuple

from ..core import tracks
from ..core.animation.channel import Channel
from ..core.animation.strips import together
from ..core.declare import Problem, registered
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.settings import entry_keys
from ..core.tracks import solved
from ..core.tracks.inputs import BAD_NUMBERS, of_unknown, stamp_of_known
from . import air, colliders, groups, motion, pins, spaces, squash
from .properties import NUMBERS, is_bone

LOOP_IS_OPEN = Problem("A chain does not come back to where its loop began", blocking=False)
CONSTRAINED = Problem(
    "Bones or objects of a chain have constraints of their own, which the chain does not follow, and which may undo its motion",
    blocking=False,
)
COLLIDER_NOT_KNOWN = Problem("The motion of a collider is not known on other frames: chains pass through it", blocking=False)
GRAVITY_NOT_KNOWN = Problem("The scene's gravity is not known on other frames: chains move without it", blocking=False)
WIND_NOT_KNOWN = Problem("The wind is not known on other frames: chains move without it", blocking=False)
NO_SNOW = Problem("What the wind is taken from emits no snow: choose an emitter", blocking=False)
LOOPED_CHAINS = Problem("Some chains move with what they follow, and are left out", blocking=False)
THINGS_MISSING = Problem("Some bones or objects of chains are not there any more: remove these from the list", blocking=False)
THINGS_CHANGED = Problem("What hangs has changed: press Refresh")
DEFORMED_COLLIDER = Problem(
    "A mesh that changes its shape is no collider: name its armature, whose bones are capsules, or empties instead", blocking=False
)
LARGE_COLLIDER = Problem(
    "A mesh has too many triangles to be a collider: give it a modifier Decimate, or take a simpler one", blocking=False
)
PIN_NOT_KNOWN = Problem("The motion of what holds a pin is not known on other frames: the pin does not hold", blocking=False)
PIN_WEIGHT_NOT_KNOWN = Problem("The weight of a pin is not known on other frames: the pin does not hold", blocking=False)
CHAINS_PARTED = Problem("Chains that wait for each other, as by a pin or a collider, do not touch each other", blocking=False)
TOO_LONG = Problem("The scene is too long for so many chains, which come to a stop before its end: split it, or mute some", blocking=False)
KEEPS_LENGTHS = Problem(
    "Bones keep their lengths whose children inherit their scale: set Inherit Scale of the children to None", blocking=False
)
CUT = "cut"
"""Beginning of the names of the markers at which chains start anew."""


def cuts(settings, scene):
    """List the frames of a scene's markers at which chains start anew, rising, in the keys' time. settings: of the rig."""
    if not settings.use_cuts or settings.use_loop:
        return []
    found = {marker.frame for marker in scene.timeline_markers if marker.name.lower().startswith(CUT)}
    return [scene_time.keys_time(scene, frame) for frame in sorted(found)]


class Surroundings(NamedTuple):
    """What acts on the chains of a rig beside its own animation.

    rig: whose settings have the wind. scene: whose frames count. pulling: scene whose gravity is read. cuts: frames at which chains start
    anew. touched: the objects that are colliders. bones: names of what hangs, whose pins count. In a solver, all but `scene`
    are evaluated.
    """

    rig: Any
    scene: Any
    pulling: Any
    cuts: list
    touched: tuple
    bones: Any

    @property
    def gravity(self):
        """Tracks of the gravity along X, Y and Z."""
        return [tracks.property_track(self.pulling, "gravity", axis) for axis in range(3)]

    @property
    def wind(self):
        """Tracks of the wind along X, Y and Z."""
        return [tracks.property_track(self.rig, "motus.chains.wind", axis) for axis in range(3)]

    @property
    def snowy(self):
        """The air of the emitter of snow whose wind is felt too (air.of); None without one."""
        return air.of(self.rig.motus.chains)

    @property
    def colliders(self):
        """List of what chains touch (solids.py)."""
        return colliders.over_time(self.rig.motus.chains, self.touched, self.scene)

    @property
    def pins(self):
        """List of pins.Held of the chains."""
        return pins.over_time(self.rig, self.bones, self.scene)

    @property
    def stamp(self):
        """Hashable value that changes whenever the surroundings may change at any time; None if changes cannot be detected."""
        found = [*scene_time.stamp(self.scene), scene_time.last(self.scene), self.pulling.use_gravity, tuple(self.cuts)]
        # Of an original scene, which over_time.py reads, edits of keys cannot be detected; most have none.
        pull = self.gravity if self.pulling.is_evaluated or self.pulling.animation_data else ()
        found += map(stamp_of_known, (*pull, *self.wind))
        snowy = self.snowy
        found.append(snowy.stamp if snowy else ())
        found += [solid.stamp for solid in self.colliders]
        found += [*(pin.bone for pin in self.pins), *(stamp_of_known(track) for pin in self.pins for track in (pin.place, pin.weight))]
        return together((*found, *self.pulling.gravity)) if not pull else together(found)


class Part(NamedTuple):
    """A chain of a group with its motion. entry: index of its entry. rows: of its members in the group.

    moved: motion.Motion, of which the slice `particles` are the chain's. kept: what can be kept of the chain between evaluations, its
    of_bones.Kept or of_objects.Kept. rests: squash.Rests of the chain.
    """

    moved: Any
    particles: slice
    entry: int
    rows: range
    kept: Any
    rests: squash.Rests


class Ready(NamedTuple):
    """A chain of which all is known. source: its input (core/tracks/inputs.py). chain: of_bones.Bones or of_objects.Row. entry, rows: of the Part."""

    source: Any
    chain: Any
    entry: int
    rows: range


class Making:
    """Makes motions of chains of an owner, and lists their problems.

    parts: [Part]. problems: Problems. read: what all chains read, that may change although the owner is not edited: hashable, with
    stamp(owner, scene). count: number of all members, of chains without a motion too. share: of the limit of work, that the owner has.
    """

    def __init__(self, owner, settings, surroundings, share):
        self._owner, self._settings, self._surroundings, self._share = owner, settings, surroundings, share
        self.parts, self.problems, self.read, self.count = [], [], [], 0

    def make(self, plan):
        """Make the motions of the chains of a plan: for each the name of its entry, and the names of its bones or objects."""
        ready = []
        for name, names in plan:
            index = self._settings.entries.find(name)
            chain = None if index < 0 else groups.chain_of(self._owner, self._settings.entries[index], names)
            if chain is None or not chain.is_as_wired(names):
                raise KeyError(name)
            source = chain.source(self._surroundings.scene)
            self.read += chain.read_by(source)
            if self._is_ready(source, chain):
                ready.append(Ready(source, chain, index, range(self.count, self.count + len(names))))
            self.count += len(names)
        if ready:
            self._solve(ready)

    def _is_ready(self, source, chain):
        entry = chain.entry
        if any(one.influence > 0.0 for thing in chain.things for one in solved.acting_on(thing, registered["chains"])):
            self.problems.append(CONSTRAINED)
        if not source.is_known and not entry.is_muted:
            self.problems.append(of_unknown(source))
        if not all(math.isfinite(getattr(entry, name)) for name in NUMBERS):
            self.problems.append(BAD_NUMBERS)
            return False
        if is_bone(entry) and entry.squash > 0.0 and any(map(squash.first_inheriting, chain.things)):
            self.problems.append(KEEPS_LENGTHS)
        return source.is_known

    def _solve(self, ready):
        settings, around = self._settings, self._surroundings
        solids, is_loop = self._solids, settings.use_loop
        touching = [one for one in ready if not self._is_always_muted(one)] if settings.use_touch else []
        price = sum(one.source.price for one in ready) + sum(solid.price for solid in solids)
        price += sum(pin.place.price + pin.weight.price for pin in around.pins)
        counts = [(len(one.chain.things), one.chain.entry) for one in ready]
        step = motion.step_price(counts, solids, self._near_pairs(touching) if touching else None)
        # Groups share the owner's limit as owners share the scene's.
        share = self._share * min(motion.step_price(counts, solids, None) / max(groups.load(settings), 1.0), 1.0)
        times = motion.times_of(around.scene, around.cuts, motion.most_seconds(price, step, is_loop, share), is_loop)
        if times.is_cut_short:
            self.problems.append(TOO_LONG)
        settle = motion.settling(settings.settle, step, 1 + len(times.cuts), share)
        world = motion.world_of({"settle": settle, **self._world(times)}, self._space(times))
        alone = world.alone()
        strands = [(one, *self._strand(one, world, times)) for one in ready]
        for closes in (False, True):
            some = [(one, strand) for one, strand, is_closed in strands if is_closed == closes]
            beside = [pair for pair in some if pair[0] in touching]
            if beside:
                self._add(beside, world, times, closes)
            for pair in some:
                if pair not in beside:
                    self._add([pair], alone, times, closes)

    def _is_always_muted(self, one):
        """Whether a Ready chain is muted, and no key or driver lets it act at a different time."""
        path = entry_keys.animated_prefix(self._owner, "motus.chains.entries", self._settings.entries, one.entry)
        return one.chain.entry.is_muted and Channel(self._owner, f"{path}is_muted", -1).is_constant

    def _near_pairs(self, touching):
        frames = np.array([scene_time.first(self._surroundings.scene)])
        poses = [np.stack(one.source.places(frames), axis=1) for one in touching]
        strands = [motion.Strand(list(one.chain.parents), pose, b"", None, one.chain.entry, {}) for one, pose in zip(touching, poses)]
        try:
            return motion.near_pairs(strands)
        except ValueError:  # which is told when the motion is made
            return 0

    def _strand(self, one, world, times):
        """Return (motion.Strand, whether it is solved as a loop) of a Ready chain."""
        source, chain = one.source, one.chain
        name = times.frames.tobytes()

        def placed():
            places = np.stack(source.places(times.frames), axis=1)
            return places, motion.hashed((places,))

        places, stamp = source.kept(("places", name), placed)
        poses, parents, is_loop = world.inside({"poses": places})["poses"], list(chain.parents), self._settings.use_loop
        strand = motion.Strand(parents, poses, stamp, None, chain.entry, {})
        if is_loop and np.abs(poses[-1] - poses[0]).max() > motion.CLOSED * strand.length:
            self.problems.append(LOOP_IS_OPEN)
            is_loop = False
        if is_loop:
            poses = np.concatenate([poses[:-1], poses[:1]])
        rows = {name: row for row, name in enumerate(chain.pinnable, 1)}
        ends = [row for row in range(1, len(parents)) if row not in parents] if chain.entry.hold_end else []
        held = pins.at([pin for pin in self._held if pin.bone in rows], rows, times.frames, ends, places)
        sides = None
        if strand._replace(sides=()).is_limited_sideways and hasattr(source, "sides"):
            sides = source.kept(("sides", name), lambda: np.stack(source.sides(times.frames), axis=1))
        return strand._replace(poses=poses, sides=sides, held=held), is_loop

    def _add(self, some, world, times, is_loop):
        """Add the Parts of chains that are solved together: [(Ready, motion.Strand)]. If that cannot be, those that can be alone."""
        try:
            moved = motion.motion_of([strand for _, strand in some], world, times, is_loop)
        except ValueError:
            if len(some) == 1:
                self.problems.append(BAD_NUMBERS)
            for one in some if len(some) > 1 else ():
                self._add([one], world, times, is_loop)
            return
        start = 0
        for one, strand in some:
            particles = slice(start, start + len(strand.parents))
            rests = squash.Rests(times.seconds, strand.poses, world.space)
            self.parts.append(Part(moved, particles, one.entry, one.rows, one.chain.kept(one.source), rests))
            start = particles.stop

    def _space(self, times):
        """Return the spaces.Space in which chains feel a part of their owner's motion alone; None if they feel all of it."""
        inherit, around = self._settings.inherit, self._surroundings
        if inherit >= 1.0:
            return None
        track = tracks.world_track(self._owner, around.scene)
        return spaces.following(track, times.frames, times.seconds, 1.0 - max(inherit, 0.0))

    def _world(self, times):
        """Return the keywords of the native StrandMotion that all chains share: the air, gravity, what they touch."""
        settings, around = self._settings, self._surroundings
        winds = self._winds(times)
        found = {"air": sum(winds)} if winds else {}
        pull = self._over_time(around.gravity, times, GRAVITY_NOT_KNOWN) if around.pulling.use_gravity else None
        if pull is not None:
            found["gravity"] = pull
        if settings.use_touch:
            found |= {"touching": True, "touching_friction": settings.friction}
        return found | colliders.at(self._solids, times.frames, settings.friction)

    def _winds(self, times):
        """List the winds (m, 3) at the Times that are known: the own one, and that of an emitter of snow."""
        settings, around = self._settings, self._surroundings
        own = self._over_time(around.wind, times, WIND_NOT_KNOWN)
        found = [] if own is None else [motion.with_gusts(own, times.seconds, settings.gusts, settings.gust_frequency, settings.use_loop)]
        if air.is_missing(settings):
            self.problems.append(NO_SNOW)
        snowy = around.snowy
        if snowy and snowy.is_known:
            period = float(times.seconds[-1] - times.seconds[0]) if settings.use_loop else 0.0
            found.append(snowy.velocities(times.frames, scene_time.fps(around.scene), period))
        elif snowy:
            self.problems.append(WIND_NOT_KNOWN)
        return found

    @functools.cached_property
    def _solids(self):
        """List of what can be touched (solids.py); the problems say what cannot."""
        around, found = self._surroundings, []
        for solid in around.colliders:
            if not solid.is_known:
                self.problems.append(COLLIDER_NOT_KNOWN)
            elif colliders.deforms(solid, around.scene):
                self.problems.append(DEFORMED_COLLIDER)
            elif colliders.is_too_large(solid):
                self.problems.append(LARGE_COLLIDER)
            else:
                found.append(solid)
        return found

    @functools.cached_property
    def _held(self):
        """List of pins.Held that are known; the problems say what is not."""
        found = self._surroundings.pins
        if not all(pin.place.is_known for pin in found):
            self.problems.append(PIN_NOT_KNOWN)
        if not all(pin.weight.is_known for pin in found):
            self.problems.append(PIN_WEIGHT_NOT_KNOWN)
        return [pin for pin in found if pin.is_known]

    def _over_time(self, along, times, problem):
        """Return the vectors (m, 3) of three tracks at the Times; None if one is not known, which `problem` says."""
        if not all(track.is_known for track in along):
            self.problems.append(problem)
            return None
        return np.stack([track.values(times.frames) for track in along], axis=1)
