"""Values, bends and integral of one F-curve over time. The work is bounded, however many keys the F-curve has."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any

import bpy

from .. import keeping
from ..evaluated import copies
from ..lazy import numpy as np
from . import native_keys

if TYPE_CHECKING:
    Array = np.ndarray[Any, Any]

NODES = 0.5 - 0.5 * math.sqrt(0.6), 0.5, 0.5 + 0.5 * math.sqrt(0.6)
WEIGHTS = 5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0
"""Nodes and weights of three-point Gauss-Legendre quadrature on [0, 1]: exact for polynomials up to degree 5.

No node lies at an end of the interval, where the value of a key with constant interpolation jumps.
"""

CLOSE = 1e-4  # frames; bounds that are nearer to each other count as one
BEFORE = 1e-3  # frames, from the bound before a jump of the value to the jump
CONSTANT = 0
"""Keyframe.interpolation 'CONSTANT' (the key holds its value until the next one) as foreach_get reads it."""
SHORT = 2.0  # frames; between keys that are nearer, pieces are halved, since the value bends much within a frame
STEP = 0.5  # frames; a rate is measured between this long before and after a frame

MOST = 10_000
"""Most pieces between all keys, and most pieces in samples(); if there are more frames, a piece has several frames."""
LEAST = 32
"""Between two keys at least this many pieces are allowed, however many keys there are, up to MOST keys.

If there are more than MOST keys, MOST // LEAST evenly chosen keys stand for all.
"""
NEAR = 2048  # frames beyond the keys; if modifiers change the value there, each of these frames is a piece
OCTAVE = 256  # pieces from NEAR frames to twice as many, and in each further doubling of the distance
FARTHEST = 2.0**20  # frames beyond the keys; everything farther away is one piece

LARGEST_CACHE = 64
_FOUND = keeping.OfEvaluation(
    "frames of the keys of F-curves, and their integrals from a frame up to the first key to each piece that follows, up to the last key",
    "address of the F-curve, first frame of the integrals",
    f"{LARGEST_CACHE} for each evaluated action",
)


def values(curve: Any, times: Array) -> Array:
    """Values (n,), float64, of an F-curve at times, (n,) frames of the scene in any order, as Blender evaluates them, unrounded."""
    times = np.asarray(times, float)
    player = native_keys.player(curve, len(times))
    return _asked(curve, times) if player is None else player.values(times)


def _asked(curve: Any, times: Array) -> Array:
    """Values of an F-curve that Blender evaluates one by one. times: (n,) frames."""
    return np.fromiter(map(curve.evaluate, times.tolist()), float, len(times))


def integral(curve: Any, first: float, last: float) -> float:
    """Integral of the F-curve from frame `first` to frame `last`, in frames times the unit of the value.

    Between keys, each frame is integrated on its own. Between keys that are more than some hundred frames apart (see MOST), a piece
    has several frames; the result then differs by up to 1e-6 for a Bezier or easing curve.
    Beyond the keys, straight lines and the laps of a Cycles modifier are integrated as a whole.
    Other modifiers are sampled in each frame near the keys, and in pieces that grow with the distance farther away. Far away, only
    the mean of a Noise modifier is therefore correct.
    """
    places = _places(curve)
    cycles = _cycles(curve, places)
    if cycles is not None and not (places[0] <= first and last <= places[-1]):
        laps = _Laps(curve, places, cycles)
        return laps.until(last) - laps.until(first)
    end = places[-1]
    if not first < min(end, last):
        return _integral(curve, _pieces(curve, places, first, last))
    origin = _origin(curve, places, first)
    sums = _kept(curve, origin, lambda: _Sums(curve, _pieces(curve, places, origin, end)))
    beyond = _terms(curve, _pieces(curve, places, end, last)).tolist() if last > end else []
    return math.fsum([*sums.terms(first, min(last, end)), *beyond])


def samples(curve: Any, first: float, last: float) -> tuple[list[float], list[float]]:
    """Samples (frames, values) of the F-curve: at `first` and `last`, and three between each two neighbouring frames of bounds()."""
    nodes = _nodes(bounds(curve, first, last)).tolist()
    frames = [first, *nodes, last]
    return frames, values(curve, np.array(frames)).tolist()


def bounds(curve: Any, first: float, last: float) -> list[float]:
    """Rising frames from `first` to `last`, between which the F-curve changes smoothly: its keys, and whole frames.

    All whole frames are included unless there are more than MOST. Also included are frames just before the value jumps, middles between
    near keys, and repeated keys of a Cycles modifier. If the value is constant beyond the keys, no whole frames beyond them are included.
    """
    places = _places(curve)
    start, end = first, last
    if curve.extrapolation == 'CONSTANT' and _is_straight_beyond(curve, places):
        start, end = max(first, places[0]), min(last, places[-1])
    repeated = _repeated(curve, places, first, last)
    return _rising(first, last, {*whole(start, end), *places, *_halves(places), *_before_steps(curve, places), *repeated})


def extent(curve: Any) -> tuple[float, float]:
    """(frame of the first key, frame of the last key), if the value of the F-curve is constant before and after; otherwise (-inf, inf)."""
    places = _places(curve)
    points = curve.keyframe_points
    if _is_straight_beyond(curve, places) and (curve.extrapolation == 'CONSTANT' or len(points) < 2):
        return places[0], places[-1]
    return -math.inf, math.inf


def united(extents: Iterable[tuple[float, float] | None]) -> tuple[float, float] | None:
    """Extent that covers several extents, each (first, last) frame of change, or None for no change; None if all are None."""
    found = [one for one in extents if one is not None]
    return (min(first for first, _ in found), max(last for _, last in found)) if found else None


def union(lists: list[list[float]]) -> list[float]:
    """Rising frames that combine the bounds of several F-curves; at most MOST, evenly chosen if there are more.

    lists: rising frames of each F-curve; all lists have the first and the last frame in common.
    """
    first, last = lists[0][0], lists[0][-1]
    frames = _rising(first, last, {frame for frames in lists for frame in frames})
    if len(frames) <= MOST:
        return frames
    return [frames[index * (len(frames) - 1) // (MOST - 1)] for index in range(MOST)]


def rate(curve: Any, frame: float) -> float:
    """Change of the F-curve's value per frame, at a frame."""
    before, after = values(curve, np.array([frame - STEP, frame + STEP])).tolist()
    return (after - before) / (2.0 * STEP)


class _Sums:
    """Sums of the terms of an integral from the first of rising frames, `edges`, to each of them, each as a sum and what its rounding lost.

    With what was lost, the sum of the terms between two edges is rounded but once, as by math.fsum().
    """

    def __init__(self, curve: Any, edges: list[float]) -> None:
        self._curve, self._edges = curve, np.array(edges)
        terms = _terms(curve, edges)
        sums = np.concatenate([[0.0], np.cumsum(terms)])  # one after the other, so that equal samples give equal bits in every process
        added = sums[1:] - sums[:-1]
        lost = np.concatenate([[0.0], np.cumsum((sums[:-1] - (sums[1:] - added)) + (terms - added))])
        self._sums, self._lost = sums[:: len(NODES)], lost[:: len(NODES)]

    def terms(self, first: float, last: float) -> list[float]:
        """Terms whose sum is the integral from one frame to a later one. They may lie before the edges if the value is a straight line there."""
        begin = int(np.searchsorted(self._edges, first, "left"))
        end = int(np.searchsorted(self._edges, last, "right")) - 1
        if end < begin:
            return _terms(self._curve, [first, last]).tolist()
        between = [self._sums[end], -self._sums[begin], self._lost[end], -self._lost[begin]]
        rests = [(first, float(self._edges[begin])), (float(self._edges[end]), last)]
        return [*map(float, between), *(term for rest in rests if rest[0] < rest[1] for term in _terms(self._curve, rest).tolist())]


class _Laps:
    """Integral, from the first key on, of an F-curve that has no modifier but a Cycles modifier. A lap is one repetition of the keys.

    places: frames of the keys, rising. cycles: the Cycles modifier.
    """

    def __init__(self, curve: Any, places: list[float], cycles: Any) -> None:
        self._curve, self._places, self._cycles = curve, places, cycles
        self._first, self._last = places[0], places[-1]
        self._period = self._last - self._first
        self._lap = self._within(self._first, self._last)

    def until(self, frame: float) -> float:
        """Integral from the first key to a frame, which may lie before the first key."""
        if frame < self._first:
            return -self._beyond(self._first - frame, -1.0, self._cycles.mode_before, self._cycles.cycles_before)
        if frame > self._last:
            beyond = self._beyond(frame - self._last, 1.0, self._cycles.mode_after, self._cycles.cycles_after)
            return self._lap + beyond
        return self._within(self._first, frame)

    def _beyond(self, distance: float, side: float, mode: str, count: int) -> float:
        """Integral over a distance in frames beyond the keys: before the first key (side -1) or after the last key (side 1).

        mode, count: mode and number of repetitions of the Cycles modifier on this side; a count of 0 repeats without end.
        """
        cyclic = 0.0 if mode == 'NONE' else min(distance, count * self._period) if count else distance
        laps = math.floor(cyclic / self._period)
        rest = min(max(cyclic - laps * self._period, 0.0), self._period)
        # In mode MIRROR every second lap runs backward.
        from_first = (side > 0.0) != (mode == 'MIRROR' and laps % 2 == 0)
        if from_first:
            part = self._within(self._first, self._first + rest)
        else:
            part = self._within(self._last - rest, self._last)
        total = laps * self._lap + part
        if mode == 'REPEAT_OFFSET':
            keys = self._curve.keyframe_points
            rise = side * (keys[-1].co[1] - keys[0].co[1])
            total += rise * (0.5 * laps * (laps + 1.0) * self._period + (laps + 1.0) * rest)
        if distance > cyclic:
            edge = self._last if side > 0.0 else self._first
            total += _integral(self._curve, sorted((edge + side * cyclic, edge + side * distance)))
        return total

    def _within(self, first: float, last: float) -> float:
        return _integral(self._curve, _pieces(self._curve, self._places, first, last)) if last > first else 0.0


def over_pieces(evaluate: Callable[[Any], Any], edges: Any) -> float:
    """Integral of a function over time by Gauss-Legendre quadrature, piece by piece.

    evaluate(times): array of the function's values at frames (n,). edges: rising frames, the ends of the pieces.
    """
    # fsum rounds only once, so that equal samples give equal bits in every process.
    return math.fsum(_parts(evaluate, edges).tolist())


def _parts(evaluate: Callable[[Any], Any], edges: Any) -> Array:
    """The terms of over_pieces(): three for each piece."""
    widths = np.diff(edges)[:, None]
    found: Array = evaluate(_nodes(edges)) * (widths * np.array(WEIGHTS)).ravel()
    return found


def _terms(curve: Any, edges: Any) -> Array:
    return _parts(lambda times: values(curve, times), edges)


def _integral(curve: Any, edges: Any) -> float:
    return over_pieces(lambda times: values(curve, times), edges)


def _nodes(edges: Any) -> Array:
    """Frames at which an integrand is sampled: the three Gauss-Legendre nodes of each interval between neighbouring `edges`, in frames."""
    edges = np.array(edges)
    return (edges[:-1, None] + np.diff(edges)[:, None] * np.array(NODES)).ravel()


def _origin(curve: Any, places: list[float], first: float) -> float:
    """Frame from which an integral's pieces are summed up: the same one for many frames `first`, since the start of a motion may be keyed.

    places: frames of the keys. Where modifiers change the value before the first key, it lies 2, 4, 8, ... frames before that key.
    """
    if first >= places[0] or _is_straight_beyond(curve, places):
        return places[0]
    return places[0] - math.ldexp(1.0, math.frexp(max(places[0] - first, 1.0))[1])


def _pieces(curve: Any, places: list[float], first: float, last: float) -> list[float]:
    """Rising frames from `first` to `last` that divide the integral of an F-curve into pieces. places: frames of the keys."""
    inner = {*places, *_halves(places)}
    most = max(LEAST, MOST // len(places))
    for place, following in itertools.pairwise(places):
        if place < last and following > first:
            step = max(1, math.ceil((following - place) / most))
            start = math.ceil(max(first, place) / step) * step
            inner.update(map(float, range(start, math.floor(min(last, following)) + 1, step)))
    if not _is_straight_beyond(curve, places):
        inner.update(_away(math.ceil(places[0]), -1.0, places[0] - first))
        inner.update(_away(math.floor(places[-1]), 1.0, last - places[-1]))
        inner.update(_repeated(curve, places, first, last))
    return _rising(first, last, inner)


def _away(start: float, side: float, distance: float) -> Iterator[float]:
    """Yields whole frames from `start` to one side (side 1 or -1): each frame near `start`, fewer and fewer farther away.

    distance: frames up to which they are needed.
    """
    reached, step = 0, 1
    while reached < min(distance, FARTHEST):
        yield start + side * reached
        reached += step
        if reached >= NEAR and reached & (reached - 1) == 0:
            step = reached // OCTAVE


def whole(first: float, last: float) -> Iterable[float]:
    """Whole frames from `first` to `last`, or only every n-th one, so that there are at most about MOST."""
    step = max(1, math.ceil((last - first) / MOST))
    return map(float, range(math.ceil(first / step) * step, math.floor(last) + 1, step))


def _before_steps(curve: Any, places: list[float]) -> list[float]:
    """Frames just before each key at which the value jumps, since the key before has constant interpolation.

    Empty if there are more than MOST keys.
    """
    points = curve.keyframe_points
    if len(points) != len(places):
        return []
    kinds = np.empty(len(points), np.int32)
    points.foreach_get("interpolation", kinds)
    return [place - BEFORE for place, kind in zip(places[1:], kinds.tolist()) if kind == CONSTANT]


def _halves(places: list[float]) -> list[float]:
    """Middles between neighbouring keys that are less than SHORT frames apart. places: frames of the keys, rising."""
    return [0.5 * (place + following) for place, following in itertools.pairwise(places) if following - place < SHORT]


def _rising(first: float, last: float, inner: Iterable[float]) -> list[float]:
    found = np.unique(np.fromiter(inner, float))
    found = found[(first + CLOSE < found) & (found < last - CLOSE)]
    if len(found) and (np.diff(found) > CLOSE).all():
        return [first, *found.tolist(), last]
    ordered = [first]
    for frame in found.tolist():
        if ordered[-1] + CLOSE < frame:
            ordered.append(frame)
    return [*ordered, last]


def _places(curve: Any) -> list[float]:
    """Rising frames of the keys of an F-curve: at least one frame, and evenly chosen keys if there are more than MOST.

    For a baked F-curve, which has samples in place of keys, these are the frames of its first and last sample.
    """
    return _kept(curve, None, lambda: _find_places(curve))


def _kept(curve: Any, what: float | None, make: Callable[[], Any]) -> Any:
    """Result of make(), kept until the keys of the F-curve's action are edited; only an evaluated action tells that.

    what: the frame from which integrals go; None for the frames of the keys.
    """
    action = curve.id_data
    if not isinstance(action, bpy.types.Action) or not action.is_evaluated:
        return make()
    kept, place = _FOUND.within(copies.found_of_action(action)), (curve.as_pointer(), what)
    found = kept.get(place)
    if found is None:
        found = make()
        if len(kept) >= LARGEST_CACHE:
            kept.clear()
        kept[place] = found
    return found


def _find_places(curve: Any) -> list[float]:
    points = curve.keyframe_points
    count = len(points)
    if count == 0 and len(curve.sampled_points) > 0:
        points = curve.sampled_points
        return [points[0].co[0], points[len(points) - 1].co[0]]
    if count > MOST:
        fewer = MOST // LEAST
        return [points[index * (count - 1) // (fewer - 1)].co[0] for index in range(fewer)]
    return [point.co[0] for point in points] or [0.0]


def _modifiers(curve: Any, places: list[float]) -> list[Any]:
    """F-curve modifiers that change the value: all unmuted ones, but a Cycles modifier only if the keys span some time."""
    has_period = len(curve.keyframe_points) > 1 and places[-1] - places[0] > CLOSE
    return [modifier for modifier in curve.modifiers if not modifier.mute and (has_period or modifier.type != 'CYCLES')]


def _is_straight_beyond(curve: Any, places: list[float]) -> bool:
    """Whether the F-curve is a straight line before its first and after its last key."""
    return not _modifiers(curve, places)


def _cycles(curve: Any, places: list[float]) -> Any:
    """The Cycles modifier of an F-curve, if it is the only modifier and acts at all times; None otherwise."""
    modifiers = _modifiers(curve, places)
    if len(modifiers) != 1 or modifiers[0].type != 'CYCLES':
        return None
    cycles = modifiers[0]
    return None if cycles.use_restricted_range or cycles.use_influence else cycles


def _repeated(curve: Any, places: list[float], first: float, last: float) -> list[float]:
    """Frames at which a Cycles modifier repeats a key, from about `first` to `last`; empty if there are none, or more than MOST."""
    if all(modifier.type != 'CYCLES' for modifier in _modifiers(curve, places)):
        return []
    period = places[-1] - places[0]
    # The keys of a mirrored lap are included.
    within = {*places, *(places[0] + places[-1] - place for place in places)}
    laps = range(math.floor((first - places[-1]) / period), math.ceil((last - places[0]) / period) + 1)
    if len(laps) * len(within) > MOST:
        return []
    return [place + lap * period for lap in laps for place in within]
