"""Frames at which the inputs of dynamics are sampled, and the samples.

Time is divided into pieces of equal length, so that an input has the same samples whichever frame is evaluated.
"""

import math
from typing import Any, NamedTuple

from ..core.animation.keys import union
from ..core.lazy import numpy as np
from ..core.measures import bounds, scene_time

RATE = 192.0
"""Samples per second, approximately. An input is interpolated linearly between samples: at 2 Hz the error is 3e-5 of the amplitude."""
PIECE = 40.0  # seconds per piece
FEW = 4
"""Number of pieces that are always sampled, whatever they cost: most filters remember no more of the past."""


class Reach(NamedTuple):
    """Range of frames, `low` to `high`, for which inputs are sampled. length: frames in a piece. most: greatest number of pieces to sample."""

    low: float
    high: float
    length: float
    most: int = FEW


class Span(NamedTuple):
    """The pieces of an input that are sampled.

    first: frame at which piece 0 starts. last: frame after which the input does not change. begin, end: index of the first sampled
    piece, and of the first piece after the sampled ones. is_cut: whether more pieces would be needed than are allowed.
    """

    first: float
    last: float
    begin: int
    end: int
    is_cut: bool


def reach_of(scene, low, high, price, share=1.0):
    """Return the Reach for the frames `low` to `high`, rounded to whole pieces: many frames share it, so that inputs are rarely sampled.

    price: of a piece of PIECE of all inputs together. share: of the limit of work, see core/evaluated/shares.py. If FEW such pieces are
    too much work, the pieces are shorter.
    """
    first = scene_time.first(scene)
    limit = bounds.MANY_AT_ONCE * share
    parts = 2 ** max(0, math.ceil(math.log2(max(FEW * price / limit, 1.0))))
    length = max(1.0, round(PIECE * scene_time.fps(scene) / parts))
    most = max(FEW, int(min(bounds.AT_ONCE, limit) // max(price, 1)))
    blocks = math.floor((low - first) / length), math.floor((high - first) / length)
    start = first + length * blocks[0] if blocks[0] > 0 else -math.inf
    return Reach(start, first + length * (max(blocks[1], 0) + 1), length, most)


def span_of(extent, scene, reach, past):
    """Return the Span of an input that has to be sampled for a Reach.

    extent: first and last frame between which the input changes. past: number of frames before the Reach that affect its motion.
    An input that starts at minus infinity is taken to rest before the scene's first frame. If more pieces than reach.most are
    needed, the first ones are sampled.
    """
    first = min(scene_time.first(scene), extent[1]) if math.isinf(extent[0]) else extent[0]
    length = reach.length
    end = max(1, math.ceil((min(extent[1], reach.high) - first) / length - 1e-9))
    begin = max(0.0, (min(extent[1], reach.low) - past - first) / length)
    begin = 0 if end <= FEW else min(math.floor(begin), end - 1)
    is_cut = end - begin > reach.most
    return Span(first, extent[1], 0, reach.most, True) if is_cut else Span(first, extent[1], begin, end, False)


class Timing(NamedTuple):
    """At which frames tracks are sampled; for the same tracks, equal Timings mean the same frames.

    where: a Span, or the (first, last) frame of a loop. length: frames in a piece of a Span; of a loop, as between()'s `longest`. fps: of
    the scene.
    """

    where: Any
    length: float
    fps: float

    def times(self, tracks, scene):
        """Return the rising frames (n,) at which to sample the tracks."""
        if isinstance(self.where, Span):
            return times(tracks, self.where, self.length, scene)
        first, last = self.where
        return np.array(between(tracks, first, last, scene, self.length))


def times(tracks, span, length, scene):
    """Return rising frames over a Span, (n,): those at which the tracks are not smooth, and enough frames between them.

    length: frames in a piece.
    """
    found = [np.array([span.first + length * span.begin])]
    for piece in range(span.begin, span.end):
        start, end = span.first + length * piece, min(span.first + length * (piece + 1), span.last)
        if end > start:
            found.append(between(tracks, start, end, scene)[1:])
    return np.concatenate(found)


def between(tracks, start, end, scene, longest=math.inf):
    """List rising frames from `start` to `end`: those at which the tracks are not smooth, and RATE a second between them.

    If `start` to `end` is longer than PIECE, or than `longest` frames, the distances grow, so that the number of frames stays about that
    of one piece, or of so many frames.
    """
    fps = scene_time.fps(scene)
    longest = min(PIECE * fps, longest)
    bends = np.array(union([track.bounds(start, end) for track in tracks] or [[start, end]]))
    length = min(1.0 / RATE, PIECE / RATE) * fps * max(1.0, (end - start) / longest)
    widths = np.diff(bends)
    parts = np.maximum(1, np.ceil(widths / length - 1e-6)).astype(int)
    ends = np.cumsum(parts)
    place = np.arange(1, ends[-1] + 1) - np.repeat(ends - parts, parts)
    found = np.repeat(bends[:-1], parts) + np.repeat(widths, parts) * place / np.repeat(parts, parts)
    found[ends - 1] = bends[1:]
    return np.concatenate([bends[:1], found])


class Samples(NamedTuple):
    """Sampled input of an entry: seconds (n,), locations (n, 3), rotations (n, 4) as quaternions, scales (n, 3).

    resets: indices of the samples at which the input teleports, so that its filter restarts at rest.
    """

    seconds: Any
    locations: Any
    rotations: Any
    scales: Any
    resets: list


def resets(frames, places, jump):
    """List the indices of samples to which positions (n, 3) have jumped: farther than `jump` within one frame; [] if `jump` is 0."""
    if jump <= 0.0 or len(frames) < 2:
        return []
    ways = np.diff(places, axis=0)
    moved = np.sqrt((ways * ways).sum(axis=1))
    # The frame to which a sample belongs: the first whole frame that is not before the sample.
    at = np.ceil(frames[1:] - 1e-6)
    starts = np.concatenate([[True], at[1:] != at[:-1]])
    begins = np.maximum.accumulate(np.where(starts, np.arange(len(at)), 0))
    ends = np.append(np.flatnonzero(starts)[1:], len(at))[np.cumsum(starts) - 1]
    spans = np.maximum(frames[ends] - frames[begins], 1.0)
    whole = places[ends] - places[begins]
    far = np.sqrt((whole * whole).sum(axis=1)) > jump * spans
    return (np.flatnonzero(far & (moved > 0.0)) + 1).tolist()
