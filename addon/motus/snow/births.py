"""The emitter's motion and the wind over time, which flakes start with."""

import math
from typing import Any, NamedTuple

from ..core import tracks
from ..core.evaluated import copies
from ..core.lazy import numpy as np
from ..core.scenery.meshes import hash_of, is_same
from . import shots

BLOCK = 256
"""Frames. Motions are read by whole blocks, so that what is read stays the same for a while."""
LONGEST = 4096
"""Frames of a motion that are read at once, whatever frame it is."""
PARTS = 4
"""Samples from one frame, or key, to the next, between which the library goes on linearly and turns evenly."""
WIND = "motus.snow.wind"
CALM = 0.0, 0.0, 0.0


class Poses(NamedTuple):
    """Poses of the emitter over time. stamp: hashable, changes with whatever the samples were read from."""

    stamp: Any
    seconds: Any
    matrices: Any

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]


class Winds(NamedTuple):
    """Velocities (k, 3) of the air over time. stamp: as of Poses."""

    stamp: Any
    seconds: Any
    velocities: Any

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]


def track(obj, scene):
    """The Track of what flakes are born at."""
    return tracks.world_track(obj, scene)


def standing(matrix):
    """Poses of an emitter that has always been where it is."""
    rows = np.array(matrix, float)
    return Poses(rows.tobytes(), np.zeros(1), rows[None])


def over_time(obj, scene, present, frame, longest, start_frame, fps, view=None):
    """(Poses at which the flakes of a frame were born, whether the motion is known; else it counts as standing).

    The Poses are None where they are not finite. present: the matrix of the object now. longest: as in moving(). view: of a
    camera whose shots count one by one, what shots.alone() compares; flakes are born then as if it had always filmed that one.
    """
    moved = track(obj, scene)
    is_standing = not moved.is_known or moved.extent is None
    poses = standing(present) if is_standing else moving(moved, frame, longest, start_frame, fps)
    if poses is not None and obj.type == 'CAMERA':
        poses = poses._replace(matrices=shots.unscaled(poses.matrices))
        if view is not None and not is_standing:
            poses = shots.alone(poses, moved, view, frame, start_frame, fps)
    return poses, moved.is_known


def moving(moved, frame, longest, start_frame, fps):
    """Poses of an emitter at which the flakes that there are on a frame were born; None where they are not finite.

    moved: a Track that is known. longest: seconds that a flake lives, at most.
    """
    found = _over_lives([moved], frame, longest, start_frame, fps)
    return found and Poses(found[0], found[1], found[2][0])


def winds(emitter, frame, longest, start_frame, fps):
    """(wind of an evaluated emitter over the lives of the flakes that there are on a frame, whether it is known).

    Winds if the wind is keyed, else its one velocity; None if a keyed wind is not finite. longest: as in moving().
    """
    settings = emitter.motus.snow
    if settings.drag == 0.0:
        return CALM, True
    standing = tuple(settings.wind)
    if not copies.has_moving_settings(emitter):
        return standing, True
    moved = wind_tracks(emitter)
    is_known = all(one.is_known for one in moved)
    if not is_known or all(one.extent is None for one in moved):
        return standing, is_known
    found = _over_lives(moved, frame, longest, start_frame, fps)
    return found and Winds(found[0], found[1], np.stack(found[2], axis=1)), True


def _over_lives(moved, frame, longest, start_frame, fps):
    """(stamp, seconds, samples of each track); None where they are not finite."""
    extents = [one.extent for one in moved if one.extent is not None]
    extent = (min(start for start, _ in extents), max(end for _, end in extents)) if extents else None
    first, last = _span(extent, frame - longest * fps, frame)
    name = "snow", first, last, start_frame, fps
    stamps = tuple(one.stamp for one in moved)
    stamp = None if None in stamps else stamps
    seconds, values = tracks.kept_by(stamp, name, lambda: _sampled(moved, first, last, start_frame, fps))
    if not all(np.isfinite(one).all() for one in values):
        return None
    # Where nobody can tell whether the motion is still the same, these are samples like no others.
    return (object() if stamp is None else (stamp, name)), seconds, values


def wind_tracks(owner):
    """Tracks (values at any frame) of the X, Y and Z components of an emitter's wind."""
    return [tracks.property_track(owner, WIND, axis) for axis in range(3)]


def _span(extent, first, last):
    """Frames over which the motion is read: all of a short one, or the blocks that hold what is asked for."""
    start, end = extent or (last, last)
    if not end - start <= LONGEST:
        start = min(max(start, BLOCK * math.floor(first / BLOCK)), BLOCK * math.floor(last / BLOCK))
        end = max(min(end, BLOCK * (math.floor(last / BLOCK) + 1)), start)
    return start, end


def _sampled(moved, first, last, start_frame, fps):
    edges = np.unique(np.array([first, *(at for one in moved for at in one.bounds(first, last)), last], float))
    parts = np.arange(PARTS) / PARTS
    frames = np.append((edges[:-1, None] + np.diff(edges)[:, None] * parts).ravel(), edges[-1])
    seconds, places = np.unique((frames - start_frame) / fps, return_index=True)
    return seconds, [one.values(frames[places]) for one in moved]
