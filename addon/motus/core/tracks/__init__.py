"""Inputs over time: what a property or transform is at any times, for solvers that need its past or future.

    property_track, own_track, world_track   a number, the channels of an object or bone, its world matrix: each a Track
    moving_numbers                           what keys make of some properties on one frame
    kept, kept_by                            keeps what a solver made of a Track until the keys change, or another file is opened
    keys_stamp                               when these do, of properties that nothing but keys animates

A Track is EXACT (read from keys, NLA strips and parents), SOLVED (a system of Motus's is asked), or RECORDED: an operator goes
through the frames and keeps samples in the file. See docs/tracks.md.
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
