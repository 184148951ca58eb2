"""What was recorded of things that nobody knows ahead: kept in the file, with the datablock that it was recorded of.

A recording is a custom property of that datablock: samples at even distances, what they are of, and a digest of what they
were made from as far as that is known. Copies and appended or linked datablocks bring theirs along. What a file holds is
checked before it is used.
"""

import hashlib
import uuid
from typing import Any, NamedTuple

from .. import stored
from ..lazy import numpy as np
from . import keys, rotations

KEY = "motus_recorded_"
"""Beginning of the custom properties' names."""
VERSION = 1
LARGEST = 1 << 18
"""Numbers in a recording: 2 MB in the file, and a world matrix for a quarter of an hour."""
WIDTHS = {"world": 12, "own": 10}
"""Numbers in a sample, of a transform: a matrix without its last row; location, rotation and scale. Else one."""


class Recording(NamedTuple):
    """samples: (n, width) at times start, start + step, ...; stamp: told apart from all others by it; digest: see digest.py."""

    start: float
    step: float
    samples: Any
    stamp: str
    digest: str

    @property
    def end(self):
        """Time of the last sample."""
        return self.start + self.step * (len(self.samples) - 1)

    @property
    def bytes(self):
        """Of the file."""
        return self.samples.nbytes

    def between(self, times):
        """(places, following, parts): between which two samples times lie, and how far; beyond the ends the end's twice."""
        last = len(self.samples) - 1
        along = np.clip((np.asarray(times, float) - self.start) / self.step, 0.0, last)
        places = np.minimum(np.floor(along).astype(int), max(last - 1, 0))
        return places, np.minimum(places + 1, last), along - places


def key(what):
    """Name of the custom property that holds a recording. what: data path and index, or a path and the kind of transform."""
    return KEY + hashlib.blake2b(what.encode(), digest_size=8).hexdigest()


def read(id_data, what, width):
    """The Recording of a datablock, original or evaluated; None where there is none. Raises Damaged."""
    found = id_data.get(key(what))
    if found is None:
        return None
    try:
        version, said = found["version"], found["what"]
        start, step, numbers, stamp, digest = (found[name] for name in ("start", "step", "numbers", "stamp", "digest"))
    except (TypeError, KeyError, IndexError):
        raise stored.Damaged("no recording") from None
    if type(version) is int and version > VERSION:
        raise stored.Newer("a recording of a newer version")
    texts_fit = stored.fits([said, stamp, digest], [str]) and said == what and len(stamp) <= 64 and len(digest) <= 64
    if not texts_fit or not stored.fits([start, step], [float]) or step <= 0.0:
        raise stored.Damaged("another recording")
    samples = np.frombuffer(stored.doubles(numbers))
    if not 0 < len(samples) <= LARGEST or len(samples) % width or not np.isfinite(samples).all():
        raise stored.Damaged("another number of samples")
    return Recording(float(start), float(step), samples.reshape(-1, width), stamp, digest)


def write(id_data, what, start, step, samples, digest):
    """Keep samples (n, width) with an original datablock; returns the Recording."""
    samples = np.ascontiguousarray(samples, float)
    made = Recording(float(start), float(step), samples, uuid.uuid4().hex, digest)
    id_data[key(what)] = {
        "version": VERSION, "what": what, "start": made.start, "step": made.step, "stamp": made.stamp, "digest": digest,
        "numbers": samples.ravel()}
    id_data.update_tag()
    return made


def remove(id_data, what):
    """Forget a recording; returns whether there was one."""
    if id_data.pop(key(what), None) is None:
        return False
    id_data.update_tag()
    return True


def most_samples(width):
    """How many samples a recording may have."""
    return LARGEST // width


def frames_text(recording):
    """The recorded range as it is written in panels: 1-250."""
    return "-".join(f"{frame:g}" for frame in (round(recording.start, 3), round(recording.end, 3)))


def bounds(recording, first, last):
    """Times from first to last between which it is smooth: those of the samples, as far as they are not too many."""
    times = recording.start + recording.step * np.arange(len(recording.samples))
    return keys.union([[first, *times[(first < times) & (times < last)].tolist(), last]])


def numbers(recording, times):
    """(n, width) at times, linear between samples."""
    places, following, parts = recording.between(times)
    lower, upper = recording.samples[places], recording.samples[following]
    return lower + parts[:, None] * (upper - lower)


def transforms(recording, times):
    """Locations, rotations and scales at times, of samples of "own"."""
    found = numbers(recording, times)
    places, following, parts = recording.between(times)
    turns = rotations.mixed(recording.samples[places, 3:7], recording.samples[following, 3:7], parts)
    return found[:, :3], turns, found[:, 7:]


def matrices(recording, times):
    """(n, 4, 4) at times, of samples of "world": what turns from one sample to the next turns between, the rest is linear."""
    places, following, parts = recording.between(times)
    needed, where = np.unique(np.stack((places, following)), return_inverse=True)
    lower, upper = where.reshape(2, -1)
    rows = recording.samples[needed].reshape(-1, 3, 4)
    turns = rotations.of_axes(rows[:, :, :3])
    stretches = rotations.chained(np.swapaxes(rotations.matrices(turns), 1, 2), rows[:, :, :3])
    share = parts[:, None, None]
    found = np.zeros((len(places), 4, 4))
    mixed = rotations.matrices(rotations.mixed(turns[lower], turns[upper], parts))
    found[:, :3, :3] = rotations.chained(mixed, stretches[lower] + share * (stretches[upper] - stretches[lower]))
    found[:, :3, 3] = rows[lower, :, 3] + parts[:, None] * (rows[upper, :, 3] - rows[lower, :, 3])
    found[:, 3, 3] = 1.0
    at_sample = parts == 0.0
    found[at_sample, :3] = rows[lower[at_sample]]
    return found
