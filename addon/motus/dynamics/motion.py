"""Filtered motion of the members of a group at any time, from native tracks that are made once from the entries' inputs and kept.

A member is an object or bone that dynamics drive. A native track holds a filtered input in a form that can be evaluated at any time.
"""

import functools
from typing import Any, NamedTuple

from ..core import native
from ..core.lazy import numpy as np
from ..core.tracks import rotations
from . import filters, inputs

CLOSED = 1e-3
"""Tolerance of a closed loop: the dot product of its first and last quaternion must be at least 1 - CLOSED / 2."""


class OpenLoop(Exception):
    """Raised if the last rotation of a loop differs from its first rotation."""


class Part(NamedTuple):
    """Filtered motion of one member, by one entry.

    row: index of the member in its group. place: index of the entry. delay: in seconds. in_world: whether locations are in world
    space. swings_through: whether the input of a loop has jumps, at which a loop cannot restart its filter.
    locations, rotations, scales: native tracks; None for a channel without dynamics.
    """

    row: int
    place: int
    delay: float
    is_object: bool
    in_world: bool
    swings_through: bool
    locations: Any
    rotations: Any
    scales: Any

    def at(self, seconds, weight):
        """Return (moves, turns, ratios of scale) by which dynamics change the member; None for a channel without dynamics.

        seconds: one time, or times (n,). weight: share of the dynamics, from 0 to 1.
        """
        moves = None if self.locations is None else weight * moved(self.locations, seconds, self.delay)
        turns = None if self.rotations is None else _shares(_turned(self.rotations, seconds, self.delay), weight)
        if self.scales is None:
            return moves, turns, None
        before = self.scales.evaluate(seconds) - self.scales.offsets(seconds)
        reached = before + moved(self.scales, seconds, self.delay)
        ratios = np.divide(reached, before, out=np.ones_like(reached), where=before != 0.0)
        return moves, turns, 1.0 + weight * (ratios - 1.0)

    def write(self, seconds, weight, context, to_local):
        """Write the member's move, turn and scale at a time into its row of the context's arrays.

        to_local(moves, in_world): function that converts an object's moves to the axes in which its constraint adds them.
        """
        moves, turns, ratios = self.at(seconds, weight)
        if moves is not None:
            context.locations[self.row] = to_local(moves, self.in_world) if self.is_object else moves
        if turns is not None:
            context.rotations[self.row] = turns
        if ratios is not None:
            context.scales[self.row] = ratios


class Values(NamedTuple):
    """Filtered motion of one property, by one entry.

    outputs: slice of the group's outputs, one output for each element of the property. place: index of the entry. delay: in seconds.
    swings_through: whether the input of a loop has jumps, at which a loop cannot restart its filter. track: native track of all elements.
    """

    outputs: slice
    place: int
    delay: float
    swings_through: bool
    track: Any

    def write(self, seconds, weight, outputs):
        """Write the values of the property at a time, in seconds, into its outputs. weight: share of the dynamics, from 0 to 1."""
        own = self.track.evaluate(seconds) - self.track.offsets(seconds)
        outputs[self.outputs] = own + weight * moved(self.track, seconds, self.delay)


def moved(track, seconds, delay):
    """Return the offset of a delayed native Track from its undelayed input. seconds: one time, or times (n,)."""
    found = track.offsets(seconds)
    return found + (track.evaluate(seconds - delay) - track.evaluate(seconds)) if delay else found


def _turned(track, seconds, delay):
    """Return the offset of a delayed native RotationTrack from its undelayed input, as quaternions in the input's own axes."""
    found = track.offsets(seconds)
    if not delay:
        return found
    late, now = (track.evaluate(at).reshape(-1, 4) for at in (seconds - delay, seconds))
    back = rotations.product(now * (1.0, -1.0, -1.0, -1.0), late)
    return rotations.product(found.reshape(-1, 4), back).reshape(found.shape)


class Tails(NamedTuple):
    """Filtered positions of the tails of bones whose entries have equal filters, delays, loops and jumps.

    track: native track of all positions. delay: in seconds. rows: indices of the bones. places: indices of their entries.
    swings_through: whether the input of a loop has jumps, at which a loop cannot restart its filter.
    """

    track: Any
    delay: float
    rows: Any
    places: Any
    swings_through: bool


def _shares(turns, weight):
    """Scale the rotations of unit quaternions (4,) or (n, 4) by a weight from 0 to 1, along the shorter way."""
    if weight == 1.0:
        return turns
    mixed = weight * turns
    mixed[..., 0] += (1.0 - weight) * np.where(turns[..., 0] >= 0.0, 1.0, -1.0)
    return mixed / np.sqrt((mixed * mixed).sum(axis=-1, keepdims=True))


def part_of(thing, entry, row, place, scene, reach):
    """Make the Part of a member by its entry; None if the input of the entry does not move.

    row: index of the member in its group. place: index of the entry. reach: the sampling.Reach.
    Raises OpenLoop if a rotation does not close its loop, and ValueError if the entry's numbers make no filter.
    """
    is_object = thing == thing.id_data
    source = inputs.of_object(thing, entry, scene) if is_object else inputs.OwnInput(thing, entry, scene)
    extent = source.extent
    if extent is None:
        return None
    samples = source.sampled(reach)
    # One filter serves all channels of the member.
    follower = filters.second_order(filters.numbers(entry))
    is_loop = inputs.has_loop(entry)
    module, resets = native.module, [] if is_loop else samples.resets

    def followed(channel, make, numbers):
        """None where the channel does not follow, or has nothing to follow."""
        if channel not in entry.channels or _rests(numbers):
            return None
        return make(follower, samples.seconds, numbers, resets, is_loop)

    turns = _closed(samples.rotations) if is_loop and 'ROTATION' in entry.channels else samples.rotations
    return Part(
        row,
        place,
        entry.delay,
        is_object,
        is_object and inputs.follows_parent(thing, entry),
        is_loop and len(samples.resets) > 0,
        followed('LOCATION', module.Track, samples.locations),
        followed('ROTATION', module.RotationTrack, turns),
        followed('SCALE', module.Track, samples.scales),
    )


def _rests(numbers):
    """Whether all rows of an array (n, k) are the same."""
    return numbers.strides[0] == 0 or bool((numbers == numbers[0]).all())


def values_of(source, entry, outputs, place, scene, reach):
    """Filtered motion of a property over time, as Values; None if the property is not animated.

    source: the ValueInput that reads the property. outputs: slice of the group's outputs that the property's numbers set.
    place: index of the entry. reach: passed to source.times(). Raises ValueError if the entry's numbers make no filter.
    """
    if source.extent is None:
        return None
    frames = source.times(reach)
    numbers = source.values(frames)
    is_loop, jumps = inputs.has_loop(entry), inputs.sampling.resets(frames, numbers, entry.jump)
    track = native.module.Track(
        filters.second_order(filters.numbers(entry)), inputs.seconds_of(frames, scene), numbers, [] if is_loop else jumps, is_loop
    )
    return Values(outputs, place, entry.delay, is_loop and len(jumps) > 0, track)


def _closed(turns):
    """Return a copy of rotations (n, 4) whose last one equals the first, so that they close a loop. Raises OpenLoop if the two differ."""
    if abs((turns[0] * turns[-1]).sum()) < 1.0 - 0.5 * CLOSED:
        raise OpenLoop
    turns = turns.copy()
    turns[-1] = turns[0]
    return turns


def tails_of(source, bones, numbers, rows, places, scene, reach):
    """Make a list of Tails, one for the bones that share the filter, delay, loop and jump of their entries; [] if nothing moves.

    source: the TailInput of the bones. bones, numbers, rows, places: of equal length; numbers: of the entries, an attribute for each setting;
    rows: indices for Tails.rows; places: indices of the entries.
    Raises ValueError if the numbers of an entry make no filter.
    """
    if source.extent is None:
        return []
    ways = {}
    for index, entry in enumerate(numbers):
        timing = inputs.timing_of(source, entry, scene, reach)
        ways.setdefault((filters.numbers(entry), entry.delay, inputs.has_loop(entry), entry.jump, timing), []).append(index)
    found = []
    for (filtered, delay, is_loop, jump, timing), members in ways.items():
        names = tuple(bones[index].name for index in members)
        track, swings_through = source.kept(
            ("filtered", filtered, is_loop, jump, timing, names),
            functools.partial(_filtered, source, filtered, is_loop, jump, timing, names, scene),
        )
        found.append(
            Tails(
                track, delay, np.array([rows[index] for index in members]), np.array([places[index] for index in members]), swings_through
            )
        )
    return found


def _filtered(source, filtered, is_loop, jump, timing, names, scene):
    """Return (native track of the filtered positions of the named bones' tails, whether it is a loop that has jumps).

    source: the TailInput of the bones. filtered: numbers of the filter. timing: the sampling.Timing.
    """
    tails = source.tails(timing)
    frames = source.frames(timing)
    jumps = inputs.sampling.resets(frames, tails[names[0]], jump)
    places = np.concatenate([tails[name] for name in names], axis=1)
    track = native.module.Track(filters.second_order(filtered), inputs.seconds_of(frames, scene), places, [] if is_loop else jumps, is_loop)
    return track, is_loop and len(jumps) > 0
