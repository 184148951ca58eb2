"""Track: a property or transform at any times, computed from keys or read from a recording, with a sentence for the panel."""

import enum
import functools

from .. import keeping
from ..animation import channel
from ..animation.channel import Channel
from ..animation.strips import keys_stamp
from ..evaluated import copies
from ..file import stored
from ..lazy import numpy as np
from ..translations import tr
from . import laid, recordings
from .in_world import World
from .transforms import PARTS, Own, Transforms

LARGEST_CACHE = 8192  # values that kept() keeps: some thousand properties or bones, in a viewport and a render
LARGEST_MEMORY = 1 << 30  # bytes of the values that kept() keeps

_made = keeping.OfFile(
    "values that solvers derive from tracks, the properties and transforms at any times: native tracks, samples, plans",
    "kind of the value, and the stamps of the tracks",
    LARGEST_CACHE,
    LARGEST_MEMORY,
    lambda _, found: _bytes(found),
    "bytes",
)

_KEYED = keeping.OfEvaluation(
    "F-curves of an evaluated action that animate numbers of a datablock, with the limits of the numbers",
    "stamp of the action and slot, type of the datablock, names of the properties",
    "one for each set of names",
)


class Kind(enum.Enum):
    """Where the values of a Track come from.

    EXACT: from keys, NLA strips and parents, or from a constant. SOLVED: from a system of Motus. RECORDED: from a recording, which
    may still have to be made.
    """

    EXACT = enum.auto()
    SOLVED = enum.auto()
    RECORDED = enum.auto()


class Track:
    """Values of a property or transform at any times, in any order; times are frames of the scene, fractions included.

    A solver may read a Track only if the property's owner, object or bone is one of the solver's declared inputs: Blender evaluates
    declared inputs before the solver. The datablock has to be the evaluated one in this case. A Track refers to Blender's data, so that
    it is built anew for each use; kept() keeps what a solver has computed from a Track.
    source: object that computes the values. what: name of the input in a recording. width: count of numbers in a recorded sample.
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
        """The Recording of this input; None if there is none, or if it is damaged."""
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
        """Whether values() can be called: the input can be computed, or was recorded."""
        return self.reason is None or self.recording is not None

    @property
    def sentence(self):
        """Sentence for the panel that says where the values of this input come from, in the user's language."""
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
        """Values of the input at times (n,), frames of the scene. Raises ValueError if the input still has to be recorded.

        Returns numbers (n,), Transforms for an own transform, or world matrices (n, 4, 4).
        """
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
        """Rising frames from first to last, between which the input changes smoothly, for sampling; their number is limited."""
        if self.reason is None:
            return self._source.bounds(first, last)
        return recordings.bounds(self.recording, first, last) if self.recording else [first, last]

    @property
    def extent(self):
        """(first, last) frame between which the input changes, infinite if it goes on changing; None if it is constant."""
        if self.reason is None:
            return self._source.extent
        return (self.recording.start, self.recording.end) if self.recording else None

    @property
    def price(self):
        """Cost of one time in values(), in units of core/measures/bounds.py (about a microsecond)."""
        return getattr(self._source, "price", 1) if self.reason is None else self.width

    @property
    def stamp(self):
        """Hashable value that changes whenever values() of an evaluated datablock may change; None if changes cannot be detected."""
        if self.reason is None:
            return self._source.stamp
        return self.recording and self.recording.stamp

    @property
    def rests_on_keys(self):
        """Whether values() stay as they are for as long as the evaluated copy of the datablock does, and keys_stamp() of it."""
        return getattr(self._source, "rests_on_keys", False)

    def present(self):
        """Present value of the input on an evaluated datablock, as a sample for a recording, (width,)."""
        return self._source.present


def property_track(id_data, data_path, index=-1, is_beneath_driver=False):
    """Track of a float, integer, boolean or enum property. Raises Refused if the data path leads to no number.

    index: index of an array's element, -1 for a property that is no array. is_beneath_driver: read the keys of the property although
    a driver sets it; used if that driver itself reads the keys.
    """
    return Track(_Number(id_data, data_path, index, is_beneath_driver), id_data, f"{data_path}[{index}]", 1)


def moving_numbers(id_data, names, frame):
    """Values at a frame, {name: number}, of the properties of an evaluated datablock that keys or NLA strips animate.

    names: tuple of property names. Properties that nothing animates, or that are not known at other frames, are left out.
    For a solver that must not wait for the animation of its own datablock. Without NLA the F-curves are read directly, since to make a
    Track takes longer.
    """
    played = id_data.animation_data
    if played is None or not (played.action or played.nla_tracks):
        return {}
    stamp = keys_stamp(id_data)
    if stamp is None:
        found = {name: property_track(id_data, name) for name in names}
        return {name: float(track.values([frame])[0]) for name, track in found.items() if track.is_known and not track.is_constant}
    kept, place = _KEYED.within(copies.found_of_action(played.action)), (stamp, type(id_data).__name__, names)
    if place not in kept:
        kept[place] = _keyed(id_data, names)
    keyed = kept[place]
    if len(played.drivers):
        keyed = [one for one in keyed if not channel.is_driven(id_data, one[0])]
    return {name: min(max(curve.evaluate(frame), least), most) for name, curve, least, most in keyed}


def _keyed(id_data, names):
    """(name, F-curve, least, most value) of those properties among `names` that the datablock's active action animates."""
    curves = {name: channel.acting_curve(id_data, name) for name in names}
    found = [(channel.number(id_data, name), curve) for name, curve in curves.items() if curve]
    return [(number.name, curve, number.least, number.most) for number, curve in found]


def own_track(thing, parts=PARTS):
    """Track of the transform that the channels of an Object or PoseBone give, below its parents and constraints, as Transforms.

    Delta transforms, and poses that systems such as layers lay over a bone, are included. parts: those of "location", "rotation" and
    "scale" that are needed; for the rest the Track may give the present value at all times.
    """
    return Track(laid.over(Own(thing, parts), thing), thing.id_data, _what(thing, "own"), recordings.WIDTHS["own"])


def world_track(thing, scene, beneath=None):
    """Track of the world matrix of an Object or PoseBone. scene: the scene whose frame rate counts for systems that drive it.

    beneath: a System that acts on top of the animation of a rig's bones; the Track leaves out its effect. None leaves out nothing.
    A recording contains the effect of that System all the same.
    """
    return Track(World(thing, scene, beneath), thing.id_data, _what(thing, "world"), recordings.WIDTHS["world"])


def kept(track, name, make):
    """Result of make(), kept until the Track changes; make() is called each time if changes cannot be detected.

    name: hashable, contains everything else that make() depends on. Threads share the result, so that nobody may change it.
    """
    return kept_by(track.stamp, name, make)


def kept_by(stamp, name, make):
    """Result of make(), kept under a stamp and a name; a stamp of None keeps nothing.

    stamp: hashable value that changes whenever the input of make() may change, such as Track.stamp. name: as in kept(): hashable,
    contains everything else that make() depends on.
    """
    if stamp is None:
        return make()
    return _made.made((name, stamp), make)


def _bytes(found):
    """Rough size of a value, in bytes: that of its arrays and native tracks. A tuple is summed up."""
    if isinstance(found, tuple):
        return sum(map(_bytes, found))
    return getattr(found, "nbytes", 0)


class _Number(Channel):
    """A Channel (a number property over time) that also gives its present value as a sample for a recording."""

    @property
    def present(self):
        return np.array([self.number.present])


def _what(thing, kind):
    return kind if thing == thing.id_data else f"{thing.path_from_id()}.{kind}"
