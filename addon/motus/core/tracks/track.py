"""One input over time: exact from keys, or from a recording; and what the panel says of it."""

import enum
import functools

from .. import keeping
from ..animation import channel
from ..animation.channel import Channel
from ..animation.strips import keys_stamp
from ..file import stored
from ..lazy import numpy as np
from ..translations import tr
from . import laid, recordings
from .transforms import PARTS, Own, Transforms, World

LARGEST_CACHE = 8192  # of what kept() keeps: some thousand properties or bones, in a viewport and a render
LARGEST_MEMORY = 1 << 30  # bytes of that

_made = keeping.OfFile(
    "what solvers make of tracks: native tracks, samples, plans",
    "what it is, and the tracks' stamps",
    LARGEST_CACHE,
    LARGEST_MEMORY,
    lambda _, found: _bytes(found),
    "bytes",
)


class Kind(enum.Enum):
    """EXACT: read from keys, or constant. SOLVED: a system of Motus's is asked. RECORDED: it has to be recorded, or was."""

    EXACT = enum.auto()
    SOLVED = enum.auto()
    RECORDED = enum.auto()


class Track:
    """Values of a property or transform at any times, in any order; times are frames of the scene, fractions included.

    A solver may read a Track if the property's owner, object or bone is one of the solver's declared inputs: Blender then has
    evaluated it before. `thing` or `id_data` has to be the evaluated one in this case. A Track refers to Blender's data, so that
    it is built anew for each use; kept() keeps what a solver has computed from it.
    """

    def __init__(self, source, id_data, what, width):
        self._source, self.id_data, self.what, self.width = source, id_data, what, width

    @functools.cached_property
    def reason(self):
        """Reason why the input has to be recorded; None if keys or a system of Motus give the input at any time."""
        return self._source.reason

    @property
    def kind(self):
        if self.reason is not None:
            return Kind.RECORDED
        return Kind.SOLVED if self._solvers else Kind.EXACT

    @property
    def _solvers(self):
        return getattr(self._source, "solvers", ())

    @functools.cached_property
    def recording(self):
        """The recording of this input; None without one, or if it is damaged."""
        try:
            return recordings.read(self.id_data, self.what, self.width)
        except stored.Damaged:
            return None

    @property
    def is_constant(self):
        """Whether nothing animates the input, so that its present value holds at all times."""
        return getattr(self._source, "is_constant", False)

    @property
    def is_known(self):
        """Whether values() may be called."""
        return self.reason is None or self.recording is not None

    @property
    def sentence(self):
        """Sentence of the panel about this input, in the user's language."""
        if self.reason is None:
            if self._solvers:
                return tr("Exact at any frame: solved by {systems}").format(systems=", ".join(map(tr, self._solvers)))
            return tr("Exact at any frame: read from keys")
        if self.recording:
            start, end, step = (f"{round(value, 3):g}" for value in (self.recording.start, self.recording.end, self.recording.step))
            return tr("Recorded {start}-{end} by steps of {step}; beyond, the first and last value hold").format(
                start=start, end=end, step=step
            )
        return tr("Needs recording: {reason}").format(reason=self.reason.sentence)

    def values(self, times):
        """At times (n,): numbers (n,), Transforms, or world matrices (n, 4, 4). ValueError where they are not known."""
        times = np.asarray(times, float)
        if self.reason is None:
            return self._source.values(times)
        if self.recording is None:
            raise ValueError(f"{self.what} has to be recorded")
        if self.what.endswith("world"):
            return recordings.matrices(self.recording, times)
        if self.what.endswith("own"):
            return Transforms(*recordings.transforms(self.recording, times))
        read = recordings.numbers if self._source.number.type == 'FLOAT' else recordings.steps
        return read(self.recording, times)[:, 0]

    def bounds(self, first, last):
        """Rising times from first to last between which the input is smooth, for sampling; a bounded number."""
        if self.reason is None:
            return self._source.bounds(first, last)
        return recordings.bounds(self.recording, first, last) if self.recording else [first, last]

    @property
    def extent(self):
        """(first, last) time between which it changes, infinite where it goes on; None where nothing ever does."""
        if self.reason is None:
            return self._source.extent
        return (self.recording.start, self.recording.end) if self.recording else None

    @property
    def price(self):
        """Price of one time in values(), in units of core/measures/bounds.py: about a microsecond each."""
        return getattr(self._source, "price", 1) if self.reason is None else self.width

    @property
    def stamp(self):
        """Something hashable that changes whenever values() of an evaluated thing may; None if nobody can tell."""
        if self.reason is None:
            return self._source.stamp
        return self.recording and self.recording.stamp

    def present(self):
        """A sample for a recording, (width,), of an evaluated thing."""
        return self._source.present


def property_track(id_data, data_path, index=-1, is_beneath_driver=False):
    """The Track of a float, int, bool or enum property; index: in an array. Refuses what is no number.

    is_beneath_driver: of what its keys say, where a driver that reads them sets it in their place.
    """
    return Track(_Number(id_data, data_path, index, is_beneath_driver), id_data, f"{data_path}[{index}]", 1)


def moving_numbers(id_data, names, frame):
    """{name: number at a frame} of the properties among `names` that keys or strips are known to animate on an evaluated datablock.

    For a solver that must not wait for its own datablock's animation. Where no NLA takes part, without a Track, which takes longer
    than the numbers.
    """
    played = id_data.animation_data
    if played is None or not (played.action or played.nla_tracks):
        return {}
    stamp = keys_stamp(id_data)
    if stamp is None:
        found = {name: property_track(id_data, name) for name in names}
        return {name: float(track.values([frame])[0]) for name, track in found.items() if track.is_known and not track.is_constant}
    ranges = kept_by(stamp, ("moving", type(id_data).__name__, names), lambda: _keyed_ranges(id_data, names))
    curves = {name: channel.acting_curve(id_data, name) for name in ranges if not channel.is_driven(id_data, name)}
    return {name: min(max(curve.evaluate(frame), ranges[name][0]), ranges[name][1]) for name, curve in curves.items() if curve}


def _keyed_ranges(id_data, names):
    """{name: (least, most)} of the properties that the active action animates."""
    keyed = [channel.number(id_data, name) for name in names if channel.acting_curve(id_data, name)]
    return {number.name: (number.least, number.most) for number in keyed}


def own_track(thing, parts=PARTS):
    """The Track of what the channels of an Object or PoseBone make, delta transforms and layers included, as Transforms.

    parts: those that count, of "location", "rotation" and "scale"; for the others the present value may stand at all times.
    """
    return Track(laid.over(Own(thing, parts), thing), thing.id_data, _what(thing, "own"), recordings.WIDTHS["own"])


def world_track(thing, scene, beneath=None):
    """The Track of the world matrix of an Object or PoseBone. scene: whose frame rate counts for what systems drive.

    beneath: a System that acts on top of the animation of the bones of a rig: what it makes of these is left out. Without its
    sinks a recording is taken of what it makes of them all the same.
    """
    return Track(World(thing, scene, beneath), thing.id_data, _what(thing, "world"), recordings.WIDTHS["world"])


def kept(track, name, make):
    """The result of make(), kept while the track does not change; make() is called anew if changes cannot be told.

    name: hashable, of all else that make() depends on. What is kept is shared by threads, and must not be changed.
    """
    return kept_by(track.stamp, name, make)


def kept_by(stamp, name, make):
    """The result of make(), kept by a stamp: a track's, or another hashable value that changes whenever make()'s input may; None keeps nothing."""
    if stamp is None:
        return make()
    return _made.made((name, stamp), make)


def _bytes(found):
    """Rough number of bytes that arrays and native tracks take."""
    if isinstance(found, tuple):
        return sum(map(_bytes, found))
    return getattr(found, "nbytes", 0)


class _Number(Channel):
    """A Channel with what a recording needs."""

    @property
    def present(self):
        return np.array([self.number.present])


def _what(thing, kind):
    return kind if thing == thing.id_data else f"{thing.path_from_id()}.{kind}"
