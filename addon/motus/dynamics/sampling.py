"""When inputs are looked at, and what makes up an entry's samples: the same for a time, whichever frame is asked for."""

import math
from typing import Any, NamedTuple

from ..core import scene_time
from ..core.lazy import numpy as np
from ..core.tracks.keys import union

RATE = 192.0
"""Samples in a second, about: between them an input is taken for linear, by which it is 3e-5 of its amplitude off at 2 Hz."""
PIECE = 40.0  # s
PIECES = 64
"""Pieces of equal length; each further one is twice as long as the one before, with as many samples."""
MOST_PIECES = 80


class Span(NamedTuple):
    """Which samples are there: from `first` on for a number of pieces, or to `last`. Frames."""

    first: float
    last: float
    pieces: int


def span_of(extent, scene, frame):
    """The Span of an input that changes within `extent`, as far as it is needed for a frame.

    What has no first key is taken to rest before the scene's first frame.
    """
    first = min(scene_time.first(scene), extent[1]) if math.isinf(extent[0]) else extent[0]
    reach = min(extent[1], max(frame, first))
    pieces = 1
    while pieces < MOST_PIECES and _edge(first, pieces, scene) < reach:
        pieces *= 2  # so that it is not made anew too often
    return Span(first, extent[1], min(pieces, MOST_PIECES))


def times(tracks, span, scene):
    """Rising frames over a Span: what the tracks bend at, and enough between."""
    found = [span.first]
    for piece in range(span.pieces):
        start, end = _edge(span.first, piece, scene), min(_edge(span.first, piece + 1, scene), span.last)
        if end > start:
            found += between(tracks, start, end, scene)[1:]
    return np.array(found)


def between(tracks, start, end, scene):
    """The same from one frame to another."""
    fps = scene_time.fps(scene)
    bounds = union([track.bounds(start, end) for track in tracks] or [[start, end]])
    length = min(1.0 / RATE, PIECE / RATE) * fps * max(1.0, (end - start) / (PIECE * fps))
    found = [start]
    for low, high in zip(bounds, bounds[1:]):
        parts = max(1, math.ceil((high - low) / length - 1e-6))
        found += [low + (high - low) * part / parts for part in range(1, parts)] + [high]
    return found


def _edge(first, piece, scene):
    """Where a piece begins."""
    length = max(1.0, round(PIECE * scene_time.fps(scene)))
    if piece <= PIECES:
        return first + length * piece
    return first + length * (PIECES - 1 + 2.0 ** (piece - PIECES))


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
