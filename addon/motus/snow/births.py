"""Motion of the emitter and velocity of the wind over the lives of the flakes: the native library computes flakes from both."""

import math
from typing import Any, NamedTuple

from ..core import tracks
from ..core.evaluated import copies
from ..core.lazy import numpy as np
from ..core.scenery.meshes import hash_of, is_same
from . import shots

BLOCK = 256
"""Number of frames in a block. Long motions are sampled in whole blocks, so that the samples do not change on every frame."""
LONGEST = 4096
"""Most frames of a motion that is sampled as a whole, on whatever frame; a longer motion is sampled in blocks."""
PARTS = 4
"""Number of samples from one key, or whole frame, to the next; between samples the library moves and turns evenly."""
WIND = "motus.snow.wind"
CALM = 0.0, 0.0, 0.0


class Poses(NamedTuple):
    """World matrices of the emitter over time. seconds: (k,), since the start frame, rising. matrices: (k, 4, 4).

    stamp: hashable value that changes whenever the samples may change.
    """

    stamp: Any
    seconds: Any
    matrices: Any

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]


class Winds(NamedTuple):
    """Velocities of the air over time. seconds: (k,), since the start frame, rising. velocities: (k, 3), m/s, world space.

    stamp: hashable value that changes whenever the samples may change.
    """

    stamp: Any
    seconds: Any
    velocities: Any

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]


def track(obj, scene):
    """Return the Track (world matrix at any frame) of the object at which flakes are born."""
    return tracks.world_track(obj, scene)


def stands(obj, scene):
    """Whether an object never moves: True only if that holds for as long as its evaluated copy and its keys (strips.stamp_of) stay."""
    moved = track(obj, scene)
    return moved.rests_on_keys and moved.extent is None


def standing(matrix):
    """Return the Poses of an emitter that does not move: a single sample. matrix: its world matrix."""
    rows = np.array(matrix, float)
    return Poses(rows.tobytes(), np.zeros(1), rows[None])


def over_time(obj, scene, present, frame, longest, start_frame, fps, view=None):
    """Return (Poses at which the flakes of a frame were born, whether the motion is known).

    An object whose motion is not known counts as one that does not move. The Poses are None if they are not finite.
    obj: object at which flakes are born. present: its world matrix now. longest: most seconds that a flake lives.
    start_frame: frame at which the seconds of the Poses begin. view: (half the angles of the view, closest, farthest) of a camera, for
    shots.alone(); each shot of the camera then has flakes of its own, born as if the camera filmed this shot at all times.
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
    """Return the Poses of a moving emitter at which the flakes of a frame were born; None if they are not finite.

    moved: Track of the emitter, whose values are known. longest: most seconds that a flake lives.
    start_frame: frame at which the seconds of the Poses begin.
    """
    found = _over_lives([moved], frame, longest, start_frame, fps)
    return found and Poses(found[0], found[1], found[2][0])


def winds(emitter, frame, longest, start_frame, fps):
    """Return (wind over the lives of the flakes of a frame, whether the wind is known at all these times).

    The wind is a Winds if it is keyed, otherwise a single velocity (x, y, z); None if a keyed wind is not finite.
    emitter: evaluated emitter. longest: most seconds that a flake lives. start_frame: frame at which the seconds of the Winds begin.
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
    """Sample Tracks over the lives of the flakes of a frame; returns (stamp, seconds (k,), [samples (k, ...) of each Track]).

    None if a sample is not finite. moved: Tracks. longest: most seconds that a flake lives.
    """
    extents = [one.extent for one in moved if one.extent is not None]
    extent = (min(start for start, _ in extents), max(end for _, end in extents)) if extents else None
    first, last = _span(extent, frame - longest * fps, frame)
    name = "snow", first, last, start_frame, fps
    stamps = tuple(one.stamp for one in moved)
    stamp = None if None in stamps else stamps
    seconds, values = tracks.kept_by(stamp, name, lambda: _sampled(moved, first, last, start_frame, fps))
    if not all(np.isfinite(one).all() for one in values):
        return None
    # If changes of the motion cannot be detected, the stamp differs from every stamp before.
    return (object() if stamp is None else (stamp, name)), seconds, values


def wind_tracks(owner):
    """Tracks (values at any frame) of the X, Y and Z components of an emitter's wind."""
    return [tracks.property_track(owner, WIND, axis) for axis in range(3)]


def _span(extent, first, last):
    """Return the (first, last) frame over which a motion is sampled.

    They are the whole extent of a short motion, or of a long one the blocks of frames that contain `first` to `last`.
    extent: (first, last) frame of the motion; None if it does not move.
    """
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
