"""When inputs are looked at, and what makes up an entry's samples: the same for a time, whichever frame is asked for."""

import itertools
import math
from typing import Any, NamedTuple

from ..core.animation.keys import union
from ..core.lazy import numpy as np
from ..core.measures import scene_time

RATE = 192.0
"""Samples in a second, about: between them an input is taken for linear, by which it is 3e-5 of its amplitude off at 2 Hz."""
PIECE = 40.0  # s
FEW = 4
"""Pieces that are looked at whatever they cost: for what is read in a moment, what most filters remember of the one before."""


class Reach(NamedTuple):
    """Frames `low` to `high` for which inputs are looked at, by at most so many pieces."""

    low: float
    high: float
    most: int = FEW


class Span(NamedTuple):
    """Which samples there are: those of the pieces `begin` up to `end`, which follow each other from frame `first` on, up to frame `last`.

    is_cut: whether more would be needed.
    """

    first: float
    last: float
    begin: int
    end: int
    is_cut: bool


def reach_of(scene, low, high, most=FEW):
    """The Reach for some frames: the same for many, so that inputs are not looked at too often."""
    first, length = scene_time.first(scene), _length(scene)
    blocks = math.floor((low - first) / length), math.floor((high - first) / length)
    start = first + length * blocks[0] if blocks[0] > 0 else -math.inf
    return Reach(start, first + length * (max(blocks[1], 0) + 1), most)


def span_of(extent, scene, reach, past):
    """The Span of an input that changes within `extent`, as far as it matters within a Reach, of which the last `past` frames count.

    What has no first key is taken to rest before the scene's first frame. Where too many pieces would count, the first ones do.
    """
    first = min(scene_time.first(scene), extent[1]) if math.isinf(extent[0]) else extent[0]
    length = _length(scene)
    end = max(1, math.ceil((min(extent[1], reach.high) - first) / length - 1e-9))
    begin = max(0.0, (min(extent[1], reach.low) - past - first) / length)
    begin = 0 if end <= FEW else min(math.floor(begin), end - 1)
    is_cut = end - begin > reach.most
    return Span(first, extent[1], 0, reach.most, True) if is_cut else Span(first, extent[1], begin, end, False)


def times(tracks, span, scene):
    """Rising frames over a Span: what the tracks bend at, and enough between."""
    length = _length(scene)
    found = [span.first + length * span.begin]
    for piece in range(span.begin, span.end):
        start, end = span.first + length * piece, min(span.first + length * (piece + 1), span.last)
        if end > start:
            found += between(tracks, start, end, scene)[1:]
    return np.array(found)


def between(tracks, start, end, scene):
    """Rising frames from `start` to `end`: where the tracks bend, and at least RATE a second between."""
    fps = scene_time.fps(scene)
    bounds = union([track.bounds(start, end) for track in tracks] or [[start, end]])
    length = min(1.0 / RATE, PIECE / RATE) * fps * max(1.0, (end - start) / (PIECE * fps))
    found = [start]
    for low, high in itertools.pairwise(bounds):
        parts = max(1, math.ceil((high - low) / length - 1e-6))
        found += [low + (high - low) * part / parts for part in range(1, parts)] + [high]
    return found


def _length(scene):
    """Frames of a piece."""
    return max(1.0, round(PIECE * scene_time.fps(scene)))


class Samples(NamedTuple):
    """What an entry follows: seconds (n,), locations (n, 3), rotations (n, 4), scales (n, 3); resets: indices of teleports."""

    seconds: Any
    locations: Any
    rotations: Any
    scales: Any
    resets: list


def resets(frames, places, jump):
    """Indices of samples to which places (n, 3) have jumped: farther than `jump` within their frame."""
    if jump <= 0.0 or len(frames) < 2:
        return []
    ways = np.diff(places, axis=0)
    moved = np.sqrt((ways * ways).sum(axis=1))
    # Of a sample its frame is the one that it ends or lies in.
    at = np.ceil(frames[1:] - 1e-6)
    starts = np.concatenate([[True], at[1:] != at[:-1]])
    begins = np.maximum.accumulate(np.where(starts, np.arange(len(at)), 0))
    ends = np.append(np.flatnonzero(starts)[1:], len(at))[np.cumsum(starts) - 1]
    spans = np.maximum(frames[ends] - frames[begins], 1.0)
    whole = places[ends] - places[begins]
    far = np.sqrt((whole * whole).sum(axis=1)) > jump * spans
    return (np.flatnonzero(far & (moved > 0.0)) + 1).tolist()
