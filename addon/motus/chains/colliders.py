"""Colliders, which chains do not enter: empties of a collection. A sphere is a ball, each other empty a plane."""

from typing import Any, NamedTuple

from ..core import tracks
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np


class Obstacles(NamedTuple):
    """Colliders at m times, as the native module takes them.

    shapes: names of k shapes. places: (m, k, 2, 3), two places for each. radii: (k,).
    """

    shapes: list
    places: Any
    radii: Any


def objects(settings):
    """List the empties that the settings of a rig name as colliders."""
    collection = pointed(settings, "colliders")
    return [] if collection is None else empties(collection.all_objects)


def empties(found):
    """List the empties among objects."""
    return [obj for obj in found if obj is not None and obj.type == 'EMPTY']


def over_time(touched, scene):
    """List (empty, track of its world matrix) for empties, evaluated or original."""
    return [(obj, tracks.world_track(obj, scene)) for obj in touched]


def form(obj):
    """Hashable value that says, with the track of an empty, what shape it is."""
    return obj.empty_display_type == 'SPHERE', obj.empty_display_size


def at(moving, frames):
    """Return the Obstacles at frames (n,). moving: over_time() of the empties, whose tracks are known. None if there are none.

    A ball is as large as the empty is on the first frame.
    """
    if not moving:
        return None
    shapes, places, radii = [], [], []
    for obj, track in moving:
        is_ball, size = form(obj)
        matrices = track.values(frames)
        centres = matrices[:, :3, 3]
        scale = np.sqrt((matrices[0, :3, :3] ** 2).sum(axis=0)).max()
        shapes.append("capsule" if is_ball else "plane")
        places.append(np.stack([centres, centres if is_ball else centres + matrices[:, :3, 2]], axis=1))
        radii.append(size * scale if is_ball else 0.0)
    return Obstacles(shapes, np.stack(places, axis=1), np.array(radii))
