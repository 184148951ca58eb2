"""Motion of the emitter, wind and rate over the lives of the flakes, by the snow's own time: the native library computes flakes from them."""

import math
from typing import Any, NamedTuple

from ..core import tracks
from ..core.animation import strips
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
WIND, RATE = "motus.snow.wind", "motus.snow.rate"
JOINT = 1e-6
"""Share of a loop's time in which what is repeated goes from the end of the loop to its start."""
CALM = 0.0, 0.0, 0.0


class Poses(NamedTuple):
    """World matrices of the emitter over time. seconds: (k,), of the snow's own time, rising. matrices: (k, 4, 4).

    stamp: hashable value that changes whenever the samples may change. frames: (first, last) frame that is sampled; None for one sample.
    """

    stamp: Any
    seconds: Any
    matrices: Any
    frames: Any = None

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]

    def repeated(self, period, until):
        """The Poses of a loop, whose samples are from 0 to its period, over and over until a time. period, until: seconds."""
        seconds, laps = _repeated(self.seconds, period, until)
        return self._replace(stamp=(self.stamp, period, laps), seconds=seconds, matrices=np.tile(self.matrices, (laps, 1, 1)))


class Winds(NamedTuple):
    """Velocities of the air over time. seconds: (k,), of the snow's own time, rising. velocities: (k, 3), m/s, world space.

    stamp: hashable value that changes whenever the samples may change.
    """

    stamp: Any
    seconds: Any
    velocities: Any

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]

    def repeated(self, period, until):
        """The Winds of a loop, whose samples are from 0 to its period, over and over until a time. period, until: seconds."""
        seconds, laps = _repeated(self.seconds, period, until)
        return Winds((self.stamp, period, laps), seconds, np.tile(self.velocities, (laps, 1)))


class Rates(NamedTuple):
    """Flakes that are born in a second, over time. seconds: (k,), of the snow's own time, rising. values: (k,).

    stamp: hashable value that changes whenever the samples may change.
    """

    stamp: Any
    seconds: Any
    values: Any

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]

    def until(self, time):
        """Number of flakes that are born from 0 to a time, as a fraction: the integral of the rate."""
        inside = self.seconds[(self.seconds > 0.0) & (self.seconds < time)]
        places = np.concatenate([[0.0], inside, [max(time, 0.0)]])
        values = np.interp(places, self.seconds, self.values)
        return float((0.5 * (values[1:] + values[:-1]) * np.diff(places)).sum())

    def scaled(self, factor):
        """The Rates times a factor."""
        return Rates((self.stamp, factor), self.seconds, self.values * factor)


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


def over_time(obj, scene, present, frame, longest, clock, loop=None, view=None):
    """Return (Poses at which the flakes of a frame were born, whether the motion is known).

    An object whose motion is not known counts as one that does not move. The Poses are None if they are not finite.
    obj: object at which flakes are born. present: its world matrix now. longest: most own seconds that a flake lives.
    clock: Clock of the snow. loop: Loop whose frames alone count, or None. view: (half the angles of the view, closest, farthest) of a
    camera, for shots.alone(); each shot of the camera then has flakes of its own, born as if the camera filmed this shot at all times.
    """
    moved = track(obj, scene)
    is_standing = not moved.is_known or moved.extent is None
    poses = standing(present) if is_standing else moving(moved, frame, longest, clock, loop)
    if poses is not None and obj.type == 'CAMERA':
        poses = poses._replace(matrices=shots.unscaled(poses.matrices))
        if view is not None and not is_standing and loop is None:
            poses = shots.alone(poses, moved, view, frame, clock)
    return poses, moved.is_known


def moving(moved, frame, longest, clock, loop=None):
    """Return the Poses of a moving emitter at which the flakes of a frame were born; None if they are not finite.

    moved: Track of the emitter, whose values are known. longest, clock, loop: as in over_time().
    """
    found = _over_lives([moved], frame, longest, clock, loop)
    return found and Poses(found[0], found[1], found[2][0], found[3])


def going(moved, frame, longest, clock, loop=None):
    """Return the Poses of a collider that moves, over the whole lives of the flakes of a frame; None if they are not finite.

    moved: Track of the collider, whose values are known. longest, clock, loop: as in over_time().
    """
    found = _over_lives([moved], clock.later(frame, longest), 2.0 * longest, clock, loop)
    poses = found and Poses(found[0], found[1], found[2][0], found[3])
    return poses.repeated(loop.period, loop.period + longest) if poses and loop else poses


def winds(emitter, frame, longest, clock, loop=None):
    """Return (wind over the lives of the flakes of a frame, whether the wind is known at all these times).

    The wind is a Winds if it is keyed, otherwise a single velocity (x, y, z); None if a keyed wind is not finite.
    emitter: evaluated emitter. longest, clock, loop: as in over_time(); the wind of a loop is repeated for as long as its flakes live.
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
    found = _over_lives(moved, frame, longest, clock, loop)
    wind = found and Winds(found[0], found[1], np.stack(found[2], axis=1))
    return (wind.repeated(loop.period, loop.period + longest) if wind and loop else wind), True


def rate_of(emitter, frame, clock, loop=None):
    """Return (rate at which flakes are born until a frame, whether it is known at all these times).

    The rate is Rates if it is keyed, otherwise a number; None if a keyed rate is not finite. emitter: evaluated emitter.
    clock, loop: as in over_time().
    """
    settings = emitter.motus.snow
    if not copies.has_moving_settings(emitter):
        return settings.rate, True
    moved = rate_track(emitter)
    if not moved.is_known or moved.extent is None:
        return settings.rate, moved.is_known
    # All births since the start count, however long ago.
    found = _over_lives([moved], frame, math.inf, clock, loop)
    return found and Rates(found[0], found[1], found[2][0]), True


def highest_rate(emitter):
    """Largest rate of an emitter on any frame; the present one if it is not known on which frames it changes."""
    if emitter.animation_data is not None:
        moved = rate_track(emitter)
        if moved.is_known and moved.extent is not None and all(map(math.isfinite, moved.extent)):
            return float(moved.values(np.array(moved.bounds(*moved.extent))).max())
    return emitter.motus.snow.rate


def _over_lives(moved, frame, longest, clock, loop):
    """Sample Tracks over the lives of the flakes of a frame; returns (stamp, seconds (k,), [samples (k, ...) of each Track], frames).

    frames: (first, last) that are sampled. None if a sample is not finite. moved: Tracks. longest: most own seconds that a flake lives;
    infinite for all flakes since the start. clock, loop: as in over_time().
    """
    if loop is None:
        extents = [one.extent for one in moved if one.extent is not None]
        extent = (min(start for start, _ in extents), max(end for _, end in extents)) if extents else None
        first, last = _span(extent, clock.earlier(frame, longest) if longest < math.inf else min(frame, clock.start), frame)
    else:
        first, last = loop.start, loop.end
    name = "snow", first, last
    stamp = strips.together((clock.stamp, *(one.stamp for one in moved)))
    seconds, values = tracks.kept_by(stamp, name, lambda: _sampled(moved, first, last, clock))
    if not all(np.isfinite(one).all() for one in values):
        return None
    # If changes of the motion cannot be detected, the stamp differs from every stamp before.
    return (object() if stamp is None else (stamp, name)), seconds, values, (first, last)


def _repeated(seconds, period, until):
    """Return (rising times of samples that are repeated until a time, number of repetitions). seconds: (k,), from 0 to the period."""
    laps = math.ceil(until / period)
    seconds, last = seconds.copy(), seconds[-1]
    seconds[-1] = max(last - JOINT * period, 0.5 * (last + seconds[-2]))
    return (seconds + period * np.arange(laps)[:, None]).ravel(), laps


def rate_track(owner):
    """Track (values at any frame) of an emitter's rate."""
    return tracks.property_track(owner, RATE)


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


def _sampled(moved, first, last, clock):
    edges = np.unique(np.array([first, *(at for one in moved for at in one.bounds(first, last)), last], float))
    parts = np.arange(PARTS) / PARTS
    frames = np.append((edges[:-1, None] + np.diff(edges)[:, None] * parts).ravel(), edges[-1])
    seconds, places = np.unique(clock.many(frames), return_index=True)
    return seconds, [one.values(frames[places]) for one in moved]
