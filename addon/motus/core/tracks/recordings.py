"""What was recorded of things that nobody knows ahead: kept in the file, with the datablock that it was recorded of.

A recording is an entry of a list that every datablock has: samples at even distances, what they are of, and a digest of what
they were made from as far as that is known. Copies and appended or linked datablocks bring theirs along, and library overrides
keep theirs. What a file holds is checked before it is used.
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
"""Name of the list."""
VERSION = 1
LARGEST = 1 << 18
"""Numbers in a recording: 1.4 MB in the file, and a world matrix for a quarter of an hour."""
WIDTHS = {"world": 12, "own": 10}
"""Numbers in a sample, of a transform: a matrix without its last row; location, rotation and scale. Else one."""
LARGEST_MEMORY = 1 << 28
"""Bytes of recordings that are kept unpacked, the latest ones."""

_FORM = (int, float, float, str, str)
_read = keeping.OfFile(
    "recordings, unpacked",
    "what was recorded, and the recording's header, which no other recording has",
    most_size=LARGEST_MEMORY,
    size=lambda _, found: found.samples.nbytes,
    unit="bytes",
)


class MOTUS_PG_recording(bpy.types.PropertyGroup):
    # The name is what was recorded.
    head: bpy.props.StringProperty(
        name="Header",
        description="Times at which the samples were taken, and their source",
        options=set(),
        override={'LIBRARY_OVERRIDABLE'},
    )
    data: bpy.props.StringProperty(name="Data", description="The samples", options=set(), override={'LIBRARY_OVERRIDABLE'})


class Recording(NamedTuple):
    """samples: (n, width) at times start, start + step, ...; stamp: told apart from all others by it; digest: see digest.py."""

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
        """(places, following, parts): between which two samples times lie, and how far; beyond the ends the end's twice."""
        last = len(self.samples) - 1
        along = np.clip((np.asarray(times, float) - self.start) / self.step, 0.0, last)
        places = np.minimum(np.floor(along).astype(int), max(last - 1, 0))
        return places, np.minimum(places + 1, last), along - places


def read(id_data, what, width):
    """The Recording of a datablock, original or evaluated; None where there is none. Raises Damaged."""
    entry = getattr(id_data, LIST).get(what)
    head = entry.head if entry else ""
    if not head:
        return None
    return _read.made((what, head), lambda: _opened(head, entry.data, width))


def _opened(head, data, width):
    """The Recording that an entry holds."""
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
    """Forget a recording; returns whether there was one."""
    listed = getattr(id_data, LIST)
    entry = listed.get(what)
    if entry is None or not entry.head:
        return False
    index = listed.find(what)
    if index < libraries.count_from_library(id_data, LIST):
        entry.head = entry.data = ""  # of an override, which cannot be without what its library has
    else:
        listed.remove(index)
    if not listed:
        id_data.property_unset(LIST)
    id_data.update_tag()
    return True


def most_samples(width):
    """How many samples a recording may have."""
    return LARGEST // width


def bounds(recording, first, last):
    """Times from first to last between which it is smooth: those of the samples, as far as they are not too many."""
    times = recording.start + recording.step * np.arange(len(recording.samples))
    return keys.union([[first, *times[(first < times) & (times < last)].tolist(), last]])


def numbers(recording, times):
    """(n, width) at times, linear between samples."""
    places, following, parts = recording.between(times)
    lower, upper = recording.samples[places], recording.samples[following]
    return lower + parts[:, None] * (upper - lower)


def steps(recording, times):
    """(n, width) at times, each sample's until the next one: of what has nothing between."""
    places, following, parts = recording.between(times)
    return recording.samples[np.where(parts < 1.0, places, following)]


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
