"""Tracks: values of properties and transforms at any times, for solvers that need the past or future of their inputs.

    property_track    Track of a number, boolean or enum property
    own_track         Track of the transform that the channels of an object or pose bone give, below parents and constraints
    world_track       Track of the world matrix of an object or pose bone
    moving_numbers    values of a datablock's animated properties on one frame
    kept, kept_by     cache what a solver has computed from a Track, until the Track changes or another file is opened
    keys_stamp        hashable value that changes whenever a key of a datablock's action changes

A Track is of one of three kinds. EXACT: it is read from keys, NLA strips and parents. SOLVED: a system of Motus computes it.
RECORDED: an operator goes through the frames and keeps samples in the file. See also docs/tracks.md.
"""

from ..animation.strips import keys_stamp
from .track import Kind, Track, kept, kept_by, moving_numbers, own_track, property_track, world_track

__all__ = (
    "Kind",
    "Track",
    "kept",
    "kept_by",
    "keys_stamp",
    "moving_numbers",
    "own_track",
    "property_track",
    "world_track",
)
