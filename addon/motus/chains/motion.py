"""The motion of a chain over the scene: what the native module solves once, from the chain's animation, and reads at any time."""

import hashlib
import math
import threading
import time
from typing import Any, NamedTuple

from ..core import keeping, native
from ..core.lazy import numpy as np
from ..core.measures import bounds, scene_time
from . import along

RATE = 240.0
"""Samples a second of what chains read: times that do not depend on the frame rate, every second one of the solver's steps."""
STEPS = 480.0
"""Steps of the solver a second."""
STEP_PRICE, BEND_PRICE, OBSTACLE_PRICE, SURFACE_PRICE = 1.0, 0.6, 0.2, 20.0
"""Prices of a step of a link, of its bend limit, and of each collider and mesh, in units of core/measures/bounds.MANY_AT_ONCE (0.1 microseconds)."""
TOUCHING_PRICE, COMPARED_PRICE, PAIR_PRICE = 2.0, 0.01, 3.0
"""Prices of a step of a link that may touch others: of itself, of each of all links, and of each pair that is near in the first pose."""
LINED_UP = 4.0
"""How many times faster than toward the pose a bone swings back into line with its parent. With looser joints a chain would fold where its end
carries the rest."""
SETTLING = 0.25
"""Part of the limit of work that may go into settling before the scene begins, and after cuts."""
CYCLES = 40
"""How often a loop is gone through at most, until it closes."""
SLICE = 0.01
"""Seconds for which is solved before it is looked whether the time that was asked for is reached."""
SUDDEN = 1.0 / 64.0
"""Time in frames, before a cut, at which what chains read is still that of the shot before."""
CLOSED = 1e-3
"""Tolerance of a closed loop, as a part of the chain's length."""
LARGEST_MEMORY = 1 << 28  # bytes

_MOTIONS = keeping.OfFile(
    "solved motions of chains (Motion)",
    "hash of the settings and of all samples that the motion is made from",
    most_size=LARGEST_MEMORY,
    size=lambda _, motion: motion.size,
    unit="bytes",
)


class Times(NamedTuple):
    """When chains are looked at. frames: (m,), rising, in the keys' time. seconds: (m,), the same in seconds.

    cuts: indices of those at which chains start anew. is_cut_short: whether the scene goes on for longer.
    """

    frames: Any
    seconds: Any
    cuts: list
    is_cut_short: bool


def times_of(scene, cuts, most, is_loop):
    """Return the Times of a scene, from its first frame to the one after its last.

    cuts: frames at which chains start anew. most: seconds, at most. is_loop: whether the last time has to be that very frame.
    """
    first, last = scene_time.first(scene), scene_time.keys_time(scene, scene.frame_end + 1)
    fps = scene_time.fps(scene)
    span = min((last - first) / fps, most)
    count = max(math.ceil(span * RATE - 1e-6), 1)
    frames = np.linspace(first, first + span * fps, count + 1) if is_loop else first + np.arange(count + 1) * fps / RATE
    inside = [frame for frame in cuts if first < frame < frames[-1]]
    frames = np.unique(np.concatenate([frames, inside, [frame - SUDDEN for frame in inside if frame - SUDDEN > first]]))
    return Times(frames, scene_time.seconds(scene, frames), np.searchsorted(frames, inside).tolist(), (last - first) / fps > most)


def step_price(chains, solids, near_pairs):
    """Return the price of a step. chains: [(number of bones, settings)]. solids: what they touch (solids.py).

    near_pairs: how many pairs of their links may touch each other; None if chains do not.
    """
    touching = sum(SURFACE_PRICE if solid.is_mesh else OBSTACLE_PRICE * solid.count for solid in solids)
    if near_pairs is not None:
        touching += TOUCHING_PRICE + COMPARED_PRICE * sum(count for count, _ in chains)
    return PAIR_PRICE * (near_pairs or 0) + sum(
        count * (STEP_PRICE + touching + (BEND_PRICE if min(numbers.bend_limit, numbers.side_limit) < math.pi else 0.0))
        for count, numbers in chains
    )


def most_seconds(price, step, is_loop, share):
    """Return how many seconds may be looked at. price: of what is read, at one time. step: step_price(). share: of the limit of work."""
    return bounds.MANY_AT_ONCE * share / max(RATE * price + STEPS * step * (CYCLES if is_loop else 1), 1.0)


def settling(wanted, step, beginnings, share):
    """Return the time in which chains may come to rest: that which is wanted, or what the limit of work allows, s.

    step: step_price(). beginnings: how often they come to rest. share: of the limit of work.
    """
    return min(wanted, SETTLING * bounds.MANY_AT_ONCE * share / max(STEPS * step * beginnings, 1.0))


def with_gusts(wind, seconds, gusts, frequency, is_loop):
    """Return a wind (m, 3) with gusts of a frequency, 1/s, at times (m,), s: those of snow. Gusts of a loop close."""
    if gusts <= 0.0:
        return wind
    period = float(seconds[-1] - seconds[0]) if is_loop else 0.0
    return wind * (1.0 + gusts * native.module.gusts(seconds, frequency, period)[:, None])


class Motion:
    """Motion of chains that are solved together. Threads share it: each solves on as far as it asks, while the others wait.

    solver: native StrandMotion. last: time at which a loop begins again, s; None if the motion is no loop. first: its first time, s.
    length: of the shortest chain, m. space: spaces.Space in which it is solved; None for the world.
    """

    def __init__(self, solver, first, last, length, space):
        self._solver, self._lock, self._first, self._last, self._space = solver, threading.Lock(), first, last, space
        self._most_gap = CLOSED * length
        self._at_once = 1
        self._is_solved, self._until, self._gap = solver.is_solved, first, 0.0
        self.size = solver.nbytes

    def __len__(self):
        return len(self._solver)

    def places(self, seconds, patience=math.inf):
        """Return where the particles are at a time, s: (n, 3), of each chain its root first.

        patience: for how long, s, the motion may be solved up to there; None is returned if that was not enough, and the next call goes on.
        """
        end = time.perf_counter() + patience
        seconds = self.within(seconds)
        while True:
            left = end - time.perf_counter()
            if not self._lock.acquire(timeout=-1 if math.isinf(patience) else max(left, 0.0)):
                return None
            try:
                if self._is_known(seconds):
                    found = self._solver.places(seconds)
                    return found if self._space is None else self._space.outside(found, seconds)
                if left <= 0.0:
                    return None
                self._go_on()
            finally:
                self._lock.release()

    def within(self, seconds):
        """Return the time of the first cycle, s, at which a loop is as at a time; that time itself if the motion is no loop."""
        return seconds if self._last is None else self._first + (seconds - self._first) % (self._last - self._first)

    def _go_on(self):
        """Solve for about SLICE, with the lock."""
        begun = time.perf_counter()
        self._solver.solve(self._at_once)
        taken = time.perf_counter() - begun
        self._at_once = max(int(self._at_once * min(SLICE / max(taken, 1e-6), 4.0)), 1)
        self._is_solved, self._until, self._gap = self._solver.is_solved, self._solver.solved_until, self._solver.gap

    def _is_known(self, seconds):
        # Before its first step a solver has the first pose, not yet settled, at the first time.
        return self._is_solved or (self._last is None and self._until > seconds)

    def done(self, seconds):
        """Return which part of the motion up to a time, s, is solved, from 0 to 1. That of a loop is not known before all of it is."""
        if self._is_known(seconds):
            return 1.0
        return 0.0 if self._last is not None else (self._until - self._first) / max(seconds - self._first, 1e-9)

    @property
    def is_open(self):
        """Whether the motion is a loop that is solved and does not close."""
        return self._last is not None and self._is_solved and self._gap > self._most_gap


class World(NamedTuple):
    """What chains share. keywords: of the native StrandMotion, with a solids.Surface for each surface. stamp: hash of all.

    space: spaces.Space in which they are solved; None for the world.
    """

    keywords: dict
    stamp: bytes
    space: Any

    def inside(self, keywords):
        """Return keywords of the native StrandMotion, given in the world, as they are in the space."""
        return keywords if self.space is None else self.space.inside(keywords)

    def alone(self):
        """Return the World of chains that touch no others."""
        return self._replace(
            keywords={name: value for name, value in self.keywords.items() if name != "touching"}, stamp=b"alone" + self.stamp
        )


def world_of(keywords, space):
    """Return the World of keywords of the native StrandMotion, which are given in the world. space: spaces.Space, or None."""
    told = keywords | {"surfaces": [one.stamp for one in keywords.get("surfaces", ())]}
    stamp = hashed([*told.items(), *(space or ())])
    return World(keywords if space is None else space.inside(keywords), stamp, space)


class Strand(NamedTuple):
    """A chain as it is solved.

    parents: index of the parent of each particle, -1 first. poses: (m, n, 3), where the animation has the particles at the Times, in the
    space of the World. stamp: hash of them. sides: (m, n, 3), where the sides of its links point in the world; None: it has no sides.
    numbers: the entry, or what has its settings. held: keywords of the native StrandMotion for pins, in the world.
    """

    parents: list
    poses: Any
    stamp: bytes
    sides: Any
    numbers: Any
    held: dict

    @property
    def length(self):
        """Of all links, m."""
        return float(np.linalg.norm(self.poses[0, 1:] - self.poses[0, self.parents[1:]], axis=1).sum())

    @property
    def is_limited_sideways(self):
        """Whether its links have a limit towards their sides."""
        return self.sides is not None and self.numbers.side_limit < min(self.numbers.bend_limit, math.pi)

    def keywords(self):
        """Return the keywords of the native StrandMotion that have a number for each particle."""
        numbers, depths = self.numbers, [0]
        for parent in self.parents[1:]:
            depths.append(depths[parent] + 1)
        shares = along.shares(np.maximum(np.array(depths) - 1.0, 0.0) / max(max(depths) - 1, 1), numbers)
        frequency = numbers.frequency * (1.0 + (numbers.tip_frequency - 1.0) * shares)
        found = {
            "frequency": np.minimum(frequency, STEPS / 8.0),
            "bend_frequency": np.minimum(LINED_UP * frequency, STEPS / 8.0),
            "mass": 1.0 + (numbers.tip_mass - 1.0) * shares,
            "thickness": numbers.thickness * (1.0 + (numbers.tip_thickness - 1.0) * shares),
            "bend": min(numbers.bend_limit, math.pi),
            "side_bend": min(numbers.side_limit, math.pi),
            "gravity_factor": numbers.gravity,
        }
        found |= {name: getattr(numbers, name) for name in ("damping", "response", "drag", "stretch")}
        return {name: np.broadcast_to(value, len(depths)) for name, value in found.items()}


def near_pairs(strands):
    """Return how many pairs of links of Strands, of which the first pose is read, are so near each other that they may touch."""
    parents, _ = _rows(strands)
    thickness = np.concatenate([strand.keywords()["thickness"] for strand in strands])
    poses = np.concatenate([strand.poses[:1] for strand in strands], axis=1)
    return native.module.StrandMotion(parents, [0.0], poses, thickness=thickness, touching=True).near_pairs


def _rows(strands):
    """Return (index of the parent of each particle of several Strands in a row, index of the first particle of each)."""
    starts = [0, *np.cumsum([len(strand.parents) for strand in strands]).tolist()]
    return [-1 if one < 0 else one + start for strand, start in zip(strands, starts) for one in strand.parents], starts


def motion_of(strands, world, times, is_loop):
    """Return the Motion of Strands that are solved together: their particles in a row. Raises ValueError if a number cannot be computed with.

    world: World, with the settle time and the scene's gravity.
    """
    own = _joined([strand.keywords() for strand in strands], 0)
    starts = np.cumsum([0, *(len(strand.parents) for strand in strands)])
    parents = [-1 if one < 0 else one + int(start) for strand, start in zip(strands, starts) for one in strand.parents]
    held = [
        strand.held | {"pinned": [int(start) + one for one in strand.held["pinned"]]}
        for strand, start in zip(strands, starts)
        if strand.held
    ]
    if held:
        own |= world.inside(_joined(held, 1))
    if any(strand.is_limited_sideways for strand in strands):
        sides = [np.zeros_like(one.poses) if one.sides is None else one.sides for one in strands]
        own |= world.inside({"sides": np.concatenate(sides, axis=1)})
    seconds = times.seconds

    def make():
        keywords = own | world.keywords
        if "surfaces" in keywords:
            keywords["surfaces"] = [one.native for one in keywords["surfaces"]]
        resets = None if is_loop else times.cuts
        poses = strands[0].poses if len(strands) == 1 else np.concatenate([strand.poses for strand in strands], axis=1)
        solver = native.module.StrandMotion(parents, seconds, poses, **keywords, resets=resets, rate=STEPS, loop=is_loop, cycles=CYCLES)
        length = min(strand.length for strand in strands)
        return Motion(solver, float(seconds[0]), float(seconds[-1]) if is_loop else None, length, world.space)

    stamps = [strand.stamp for strand in strands]
    return _MOTIONS.made(hashed((parents, seconds, *stamps, times.cuts, is_loop, world.stamp, *own.items())), make)


def _joined(keywords, axis):
    """Return keywords that have what several have, one after the other: along an axis of arrays, and as lists."""
    found = {}
    for name, value in keywords[0].items():
        rows = [one[name] for one in keywords]
        found[name] = [item for row in rows for item in row] if isinstance(value, list) else np.concatenate(rows, axis)
    return found


def hashed(values):
    """Return a hash of numbers, texts, bytes, arrays, and lists and tuples of these."""
    found = hashlib.sha256()
    for value in values:
        _note(found, value)
    return found.digest()


def _note(found, value):
    """Let a hash cover a value: a number, a text, an array, or a list or tuple of these."""
    if isinstance(value, (list, tuple)):
        found.update(f"{len(value)}".encode())
        for one in value:
            _note(found, one)
    elif hasattr(value, "tobytes"):
        found.update(f"{value.shape}".encode())
        found.update(np.ascontiguousarray(value).data)
    else:
        found.update(f"{value!r},".encode())
