"""Recordings: samples over time of properties and transforms that cannot be computed ahead. The file keeps them.

A recording is an item of a collection property (LIST) that every datablock has. It holds the name of the recorded property or
transform, samples at even intervals, and a digest (hash) of what is known of their sources. Copied, appended and linked datablocks
bring their recordings along, and library overrides keep their recordings. The content of a file is checked before it is used.
"""

import base64
import binascii
import json
import uuid
from typing import Any, NamedTuple

import bpy

from .. import keeping
from ..animation import keys
from ..file import libraries, stored
from ..lazy import numpy as np
from . import rotations

LIST = "motus_recordings"
"""Name of the collection property in which a datablock keeps its recordings."""
VERSION = 1
LARGEST = 1 << 18
"""Most numbers in a recording: they take 1.4 MB in the file, and suffice for a quarter of an hour of a world matrix."""
WIDTHS = {"world": 12, "own": 10}
"""Count of numbers in one sample of a transform; a sample of a property has one number.

"world": a world matrix without its last row. "own": location, rotation (w, x, y, z) and scale that an object's or bone's channels give.
"""
LARGEST_MEMORY = 1 << 28
"""Most bytes of decoded recordings that are kept in memory; the least recently used recordings are dropped."""

_FORM = (int, float, float, str, str)
_read = keeping.OfFile(
    "unpacked samples of recordings",
    "recorded datablock, and the header of the recording, which is unique",
    most_size=LARGEST_MEMORY,
    size=lambda _, found: found.samples.nbytes,
    unit="bytes",
)


class MOTUS_PG_recording(bpy.types.PropertyGroup):
    # `name`, which each PropertyGroup has, is the name of the recorded property or transform.
    head: bpy.props.StringProperty(
        name="Header",
        description="Times at which the samples were taken, and their source",
        options={'HIDDEN'},
        override={'LIBRARY_OVERRIDABLE'},
    )
    data: bpy.props.StringProperty(name="Data", description="The samples", options={'HIDDEN'}, override={'LIBRARY_OVERRIDABLE'})


class Recording(NamedTuple):
    """A decoded recording.

    samples: (n, width) at the frames start, start + step, ... stamp: text that no other recording has. digest: hash of what the recording
    was made from (see digest.py).
    """

    start: float
    step: float
    samples: Any
    stamp: str
    digest: str

    @property
    def end(self):
        """Time of the last sample of the recording, in frames."""
        return self.start + self.step * (len(self.samples) - 1)

    def between(self, times):
        """Samples around each time: (indices of the samples before, indices of the samples after, fractions), each (n,).

        A fraction is 0 at the sample before and 1 at the sample after. A time outside the recording counts as the recording's nearest end.
        """
        last = len(self.samples) - 1
        along = np.clip((np.asarray(times, float) - self.start) / self.step, 0.0, last)
        places = np.minimum(np.floor(along).astype(int), max(last - 1, 0))
        return places, np.minimum(places + 1, last), along - places


def read(id_data, what, width):
    """Read a recording of a datablock, original or evaluated; None if there is none.

    what: name of the recorded property or transform. width: count of numbers in a sample. Raises stored.Damaged if the content of the
    file is not a valid recording.
    """
    entry = getattr(id_data, LIST).get(what)
    head = entry.head if entry else ""
    if not head:
        return None
    return _read.made((what, head), lambda: _opened(head, entry.data, width))


def _opened(head, data, width):
    """Decode a Recording from the header and data in the file. Raises Damaged if they are invalid, Newer if their version is newer."""
    version, start, step, stamp, digest = stored.parse(head, _FORM)
    if version > VERSION:
        raise stored.Newer("a recording of a newer version")
    if len(data) > 8 * LARGEST or step <= 0.0:
        raise stored.Damaged("another recording")
    try:
        samples = np.frombuffer(base64.b64decode(data, validate=True), "<f4").astype(float)
    except (binascii.Error, ValueError) as error:
        raise stored.Damaged("no samples") from error
    if not 0 < len(samples) <= LARGEST or len(samples) % width or not np.isfinite(samples).all():
        raise stored.Damaged("another number of samples")
    return Recording(float(start), float(step), samples.reshape(-1, width), stamp, digest)


def write(id_data, what, start, step, samples, digest):
    """Store samples (n, width) as float32 in an original datablock's list of recordings; returns the number of bytes stored.

    what: name of the recorded property or transform. start, step: frame of the first sample, and frames between samples.
    digest: text that tells what the recording was made from (see digest.py).
    """
    listed = getattr(id_data, LIST)
    entry = listed.get(what)
    if entry is None:
        entry = listed.add()
        entry.name = what
    entry.head = json.dumps([VERSION, float(start), float(step), uuid.uuid4().hex, digest])
    entry.data = base64.b64encode(np.asarray(samples, "<f4").tobytes()).decode()
    id_data.update_tag()
    return len(entry.data)


def remove(id_data, what):
    """Remove a recording from an original datablock; returns whether there was one.

    what: name of the recorded property or transform.
    """
    listed = getattr(id_data, LIST)
    entry = listed.get(what)
    if entry is None or not entry.head:
        return False
    index = listed.find(what)
    if index < libraries.count_from_library(id_data, LIST):
        entry.head = entry.data = ""  # a library override cannot remove an item that its library has
    else:
        listed.remove(index)
    if not listed:
        id_data.property_unset(LIST)
    id_data.update_tag()
    return True


def most_samples(width):
    """Most samples that a recording may have. width: count of numbers in a sample."""
    return LARGEST // width


def bounds(recording, first, last):
    """Rising frames from first to last, between which a recording is smooth: the frames of its samples.

    If these are more than keys.MOST frames, keys.MOST evenly chosen ones stand for all.
    """
    times = recording.start + recording.step * np.arange(len(recording.samples))
    return keys.union([[first, *times[(first < times) & (times < last)].tolist(), last]])


def numbers(recording, times):
    """Values (n, width) of a recording at times (n,), interpolated linearly between samples."""
    places, following, parts = recording.between(times)
    lower, upper = recording.samples[places], recording.samples[following]
    return lower + parts[:, None] * (upper - lower)


def steps(recording, times):
    """Values (n, width) of a recording at times (n,); each sample holds until the next one.

    Used for integers, booleans and enums, which have no values in between.
    """
    places, following, parts = recording.between(times)
    return recording.samples[np.where(parts < 1.0, places, following)]


def transforms(recording, times):
    """Locations (n, 3), rotations (n, 4; w, x, y, z) and scales (n, 3) at times (n,) of a recording of an own transform.

    Locations and scales are interpolated linearly, rotations as unit quaternions along the shorter way.
    """
    found = numbers(recording, times)
    places, following, parts = recording.between(times)
    turns = rotations.mixed(recording.samples[places, 3:7], recording.samples[following, 3:7], parts)
    return found[:, :3], turns, found[:, 7:]


def matrices(recording, times):
    """World matrices (n, 4, 4) at times (n,) of a recording of a world matrix.

    Between samples the rotation is interpolated as a unit quaternion. Location, and scale with shear, are interpolated linearly.
    """
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
