"""An F-curve over time: its values, where it bends, and its integral; bounded work however many keys it has."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any

from ..lazy import numpy as np

if TYPE_CHECKING:
    Array = np.ndarray[Any, Any]

NODES = 0.5 - 0.5 * math.sqrt(0.6), 0.5, 0.5 + 0.5 * math.sqrt(0.6)
WEIGHTS = 5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0
"""Gauss-Legendre on [0, 1]: exact for polynomials up to degree 5, and never at an end, where a stepped key jumps."""

CLOSE = 1e-4  # frames; nearer bounds are one
BEFORE = 1e-3  # frames, from a bound to the step after it
CONSTANT = 0
"""What foreach_get makes of the interpolation of a key that holds its value."""
SHORT = 2.0  # frames; between nearer keys the value bends so much in a frame that it is halved
STEP = 0.5  # frames, to either side of where a rate is measured

MOST = 10_000
"""Pieces between the keys in all, and in samples(): where there are more frames, a piece has several."""
LEAST = 32
"""Pieces between two keys, however many keys there are, up to MOST keys. Of more keys MOST // LEAST stand for all."""
NEAR = 2048  # frames beyond the keys, each a piece where modifiers change the value there
OCTAVE = 256  # pieces from there to twice as far, and so on
FARTHEST = 2.0**20  # frames; what lies beyond is one piece


def values(curve: Any, times: Array) -> Array:
    """The F-curve's values at times of the scene, in any order; times: (n,). As Blender evaluates them, unrounded."""
    times = np.asarray(times, float)
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
    if cycles is None or (places[0] <= first and last <= places[-1]):
        return _integral(curve, _pieces(curve, places, first, last))
    laps = _Laps(curve, places, cycles)
    return laps.until(last) - laps.until(first)


def samples(curve: Any, first: float, last: float) -> tuple[list[float], list[float]]:
    """(frames, values) of the F-curve: at `first` and `last`, and three or more in each piece of bounds()."""
    nodes = _nodes(bounds(curve, first, last)).tolist()
    frames = [first, *nodes, last]
    return frames, list(map(curve.evaluate, frames))


def bounds(curve: Any, first: float, last: float) -> list[float]:
    """Rising frames from `first` to `last`: those of the keys, and whole ones, all of them where they are not too many."""
    places = _places(curve)
    start, end = first, last
    if curve.extrapolation == 'CONSTANT' and _is_straight_beyond(curve, places):
        start, end = max(first, places[0]), min(last, places[-1])
    repeated = _repeated(curve, places, first, last)
    return _rising(first, last, {*whole(start, end), *places, *_halves(places), *_before_steps(curve, places), *repeated})


def extent(curve: Any) -> tuple[float, float]:
    """(frame of the first key, of the last): outside of them the value rests; infinite where it goes on."""
    places = _places(curve)
    points = curve.keyframe_points
    if _is_straight_beyond(curve, places) and (curve.extrapolation == 'CONSTANT' or len(points) < 2):
        return places[0], places[-1]
    return -math.inf, math.inf


def united(extents: Iterable[tuple[float, float] | None]) -> tuple[float, float] | None:
    """The extent of several, each of which may be None: nothing changes then; None where nothing changes at all."""
    found = [one for one in extents if one is not None]
    return (min(first for first, _ in found), max(last for _, last in found)) if found else None


def union(lists: list[list[float]]) -> list[float]:
    """Bounds of several F-curves at once: rising frames, MOST at most; all from one first frame to one last frame."""
    first, last = lists[0][0], lists[0][-1]
    frames = _rising(first, last, {frame for frames in lists for frame in frames})
    if len(frames) <= MOST:
        return frames
    return [frames[index * (len(frames) - 1) // (MOST - 1)] for index in range(MOST)]


def rate(curve: Any, frame: float) -> float:
    """Change of the value per frame."""
    return (curve.evaluate(frame + STEP) - curve.evaluate(frame - STEP)) / (2.0 * STEP)


class _Laps:
    """Integral of an F-curve that nothing but a Cycles modifier changes, from its first key on."""

    def __init__(self, curve: Any, places: list[float], cycles: Any) -> None:
        self._curve, self._places, self._cycles = curve, places, cycles
        self._first, self._last = places[0], places[-1]
        self._period = self._last - self._first
        self._lap = self._within(self._first, self._last)

    def until(self, frame: float) -> float:
        """Integral from the first key to a frame, which may lie before the key."""
        if frame < self._first:
            return -self._beyond(self._first - frame, -1.0, self._cycles.mode_before, self._cycles.cycles_before)
        if frame > self._last:
            beyond = self._beyond(frame - self._last, 1.0, self._cycles.mode_after, self._cycles.cycles_after)
            return self._lap + beyond
        return self._within(self._first, frame)

    def _beyond(self, distance: float, side: float, mode: str, count: int) -> float:
        """Over a distance from the first key back (side -1) or from the last one on (side 1)."""
        cyclic = 0.0 if mode == 'NONE' else min(distance, count * self._period) if count else distance
        laps = math.floor(cyclic / self._period)
        rest = min(max(cyclic - laps * self._period, 0.0), self._period)
        # Mirrored, every other lap begins where the one before has ended.
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
    widths = np.diff(edges)[:, None]
    parts = evaluate(_nodes(edges)) * (widths * np.array(WEIGHTS)).ravel()
    # fsum: rounded once, so that the same samples give the same bits in every process.
    return math.fsum(parts.tolist())


def _integral(curve: Any, edges: Any) -> float:
    return over_pieces(lambda times: values(curve, times), edges)


def _nodes(edges: Any) -> Array:
    """Frames at which an integrand is sampled: the three Gauss-Legendre nodes of each interval between neighbouring `edges`, in frames."""
    edges = np.array(edges)
    return (edges[:-1, None] + np.diff(edges)[:, None] * np.array(NODES)).ravel()


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
    """Whole frames from `start` away to one side: every one at first, then ever fewer."""
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
    """Just before the keys at which a stepped value jumps, as far as there are not too many."""
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
    ordered = [first]
    for frame in sorted(inner):
        if ordered[-1] + CLOSE < frame < last - CLOSE:
            ordered.append(frame)
    return [*ordered, last]


def _places(curve: Any) -> list[float]:
    """Frames of the keys; of the first and the last sample where it was made of samples; one at least."""
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
    """The modifiers that change the value."""
    has_period = len(curve.keyframe_points) > 1 and places[-1] - places[0] > CLOSE
    return [modifier for modifier in curve.modifiers if not modifier.mute and (has_period or modifier.type != 'CYCLES')]


def _is_straight_beyond(curve: Any, places: list[float]) -> bool:
    """Whether the F-curve is a straight line before its first and after its last key."""
    return not _modifiers(curve, places)


def _cycles(curve: Any, places: list[float]) -> Any:
    """The Cycles modifier, where it alone changes the value, at all times; else None."""
    modifiers = _modifiers(curve, places)
    if len(modifiers) != 1 or modifiers[0].type != 'CYCLES':
        return None
    cycles = modifiers[0]
    return None if cycles.use_restricted_range or cycles.use_influence else cycles


def _repeated(curve: Any, places: list[float], first: float, last: float) -> list[float]:
    """Frames near the keys at which a Cycles modifier meets a key again; none where they are too many."""
    if all(modifier.type != 'CYCLES' for modifier in _modifiers(curve, places)):
        return []
    period = places[-1] - places[0]
    # Those of a mirrored lap as well.
    within = {*places, *(places[0] + places[-1] - place for place in places)}
    laps = range(math.floor((first - places[-1]) / period), math.ceil((last - places[0]) / period) + 1)
    if len(laps) * len(within) > MOST:
        return []
    return [place + lap * period for lap in laps for place in within]
