"""Inputs of dynamics: the animation over time that an entry filters, without the effect of the dynamics themselves.

An entry is one item in an owner's list of dynamics. Inputs read tracks: a track gives a property or transform at any times.
"""

import functools

from ..core import tracks, wiring
from ..core.animation import strips
from ..core.declare import registered
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import Refused
from ..core.tracks import in_world, rotations
from ..core.tracks.inputs import PARENT, Input, Tails, carrier, stamp_of_known
from . import filters, sampling
from .sampling import Samples


def of_object(obj, entry, scene):
    """Make the input (motion to be filtered) of an object's entry: its world motion or its own channels. obj: original or evaluated."""
    return WorldInput(obj, entry, scene) if follows_parent(obj, entry) else OwnInput(obj, entry, scene)


def follows_parent(obj, entry):
    """Whether an object's entry follows its motion in the world, its parent's motion included, instead of its own channels alone."""
    return entry.follow == 'WORLD' and obj.parent is not None


MOST_NUMBERS = 32
"""Greatest number of elements of an array property that can have dynamics: Blender's own arrays are not longer."""


class _Filtered(Input):
    """Base class of the inputs of entries: the motion that an entry filters, read from tracks. Made anew for each use."""

    def __init__(self, thing, entry, scene):
        super().__init__(thing, scene)
        self._entry = entry

    @property
    def price(self):
        """Price of sampling one piece of the input, sampling.PIECE seconds (for its unit see core/measures/bounds.py)."""
        return sampling.RATE * sampling.PIECE * super().price

    def times(self, reach, entry=None):
        """Return the frames, rising, at which the input is sampled for a sampling.Reach. entry: by whose settings; None: the input's own."""
        return times_of(self, entry or self._entry, self._scene, reach)

    def frames(self, timing):
        """Return the frames (n,), rising, of a sampling.Timing."""
        return self.kept(timing, lambda: timing.times(self.tracks, self._scene))

    def sampled(self, reach):
        """Return the Samples of the input for a sampling.Reach, kept until the input changes, so that an edit of the filter reads nothing anew."""
        frames, entry = self.times(reach), self._entry
        what = "dynamics", self.place, frozenset(entry.channels), entry.jump, self.fps, frames.tobytes()
        return tracks.kept_by(strips.together(map(stamp_of_known, self.tracks)), what, lambda: self.samples(frames))

    def is_cut(self, reach, entries):
        """Whether any of several entries would need more samples of the input than a sampling.Reach allows."""
        pasts = {past_of(entry) for entry in entries if not has_loop(entry)}
        return self.extent is not None and any(_span_of(self, past, self._scene, reach).is_cut for past in pasts)


def has_loop(entry):
    """Whether an entry is set to loop over a range of frames that is not empty."""
    return entry.use_loop and entry.loop_end > entry.loop_start


def times_of(source, entry, scene, reach):
    """Return the frames, rising, at which the tracks of an input are sampled for an entry. reach: a sampling.Reach."""
    return source.frames(timing_of(source, entry, scene, reach))


def timing_of(source, entry, scene, reach):
    """Return the sampling.Timing that says, with the input's tracks, at which frames the input is sampled for an entry."""
    if has_loop(entry):
        return sampling.Timing((float(entry.loop_start), float(entry.loop_end)), sampling.FEW * reach.length, source.fps)
    return sampling.Timing(_span_of(source, past_of(entry), scene, reach), reach.length, source.fps)


def _span_of(source, past, scene, reach):
    """Return the sampling.Span of an input for a sampling.Reach. past: seconds before that, which count too."""
    return sampling.span_of(source.extent, scene, reach, past * source.fps)


def past_of(entry):
    """Return how many seconds of its past input affect an entry's output: the filter's memory and the delay."""
    return filters.memory(filters.numbers(entry)) + entry.delay


def seconds_of(frames, scene):
    """Convert frames of the scene to seconds."""
    return scene_time.seconds(scene, frames)


class OwnInput(_Filtered):
    """Input that is an Object's or PoseBone's own transform: its location, rotation and scale channels without its parents."""

    place = 'OWN'
    """What of the thing itself, besides its tracks, the samples depend on; hashable."""

    @functools.cached_property
    def listed(self):
        """[(track of the transform, keywords of the operator motus.track_record that records it)]: one pair."""
        thing = self._thing
        names = {"datablock": thing.id_data.name, "transform": 'OWN'}
        parts = {name.lower() for name in self._entry.channels}
        if "rotation" in parts:
            parts.add("scale")  # negative scales change the rotation that the matrix contains
        return [(tracks.own_track(thing, parts), names if thing == thing.id_data else names | {"bone": thing.name})]

    def samples(self, frames):
        """Return the Samples of the input at frames (n,): locations, rotations and scales of the thing's own transform."""
        found = self.tracks[0].values(frames)
        turns = rotations.product(found.rotations, rotations.mirrored(found.scales))
        return Samples(
            seconds_of(frames, self._scene),
            found.locations,
            turns,
            found.scales,
            sampling.resets(frames, found.locations, self._entry.jump),
        )


class WorldInput(_Filtered):
    """Input that is an object's motion in the world: its own transform on top of its parent's world matrix."""

    carriers = (PARENT,)

    @property
    def place(self):
        """What of the object itself, besides its tracks, the samples depend on: how it hangs on its parent; hashable."""
        return in_world.parent_offset(self._thing).tobytes()

    @functools.cached_property
    def listed(self):
        """[(track, keywords of the operator motus.track_record)]: of the object's own transform and of its parent's world matrix."""
        obj, parent = self._thing, in_world.parent_of(self._thing)
        names = {"datablock": obj.parent.name, "transform": 'WORLD'}
        if parent != obj.parent:
            names["bone"] = parent.name
        return [*OwnInput(obj, self._entry, self._scene).listed, (carrier(obj, self._scene), names)]

    @property
    def reason(self):
        return in_world.of_parent(self._thing)

    def samples(self, frames):
        """Return the Samples of the input at frames (n,): locations and rotations in world space, scales as keyed."""
        own, carried = (track.values(frames) for track in self.tracks)
        space = rotations.chained(carried, in_world.parent_offset(self._thing))
        found = rotations.chained(space, own.matrices)
        places = found[:, :3, 3]
        return Samples(
            seconds_of(frames, self._scene),
            places,
            rotations.of_axes(found[:, :3, :3]),
            own.scales,
            sampling.resets(frames, places, self._entry.jump),
        )


class ValueInput(_Filtered):
    """Input that is a property's value by its own keys, without the drivers by which dynamics change it.

    `tracks` is empty if the property does not exist any more.
    """

    @functools.cached_property
    def listed(self):
        """[(track, None)] for each element of the property: None because a property cannot be recorded while it is driven."""
        places = numbers_of(self._thing, self._entry)
        return [
            (tracks.property_track(place.id_data, place.data_path, place.number.index, is_beneath_driver=True), None) for place in places
        ]

    @property
    def reason(self):
        return next((track.reason for track in self.tracks if track.reason), None)

    def values(self, frames):
        """Return the values of the property's elements at frames (n,), as an array (n, elements)."""
        return np.stack([track.values(frames) for track in self.tracks], axis=1)


def numbers_of(owner, entry):
    """List the Places of the elements of an entry's property; [] if the property does not exist.

    owner: original or evaluated; the entry's data path starts from the owner. A Place says where an element lies in its datablock.
    """
    return [wiring.property_place(owner, entry.data_path, index) for index in indices_of(owner, entry.data_path, entry.index)]


def indices_of(owner, path, index, most=MOST_NUMBERS):
    """List the indices of the elements of a property that can be driven; [] if the property does not exist or is no number.

    path: data path from the owner. index: of one element; -1 selects all elements of an array, at most `most`.
    The result is [-1] for a property that is not an array.
    """
    try:
        value = owner.path_resolve(path)
        count = len(value) if index < 0 and hasattr(value, "__len__") and not isinstance(value, str) else 0
        found = list(range(min(count, most))) or [index]
        wiring.property_place(owner, path, found[0])
    except (ValueError, Refused):
        return []
    return found


class TailInput(_Filtered, Tails):
    """Input that is the motion of bones' tails in world space, from the animation of their rig and of the rig's parents.

    bones: all bones of one chain that follow, topmost first. Parent bones of the chain may be moved by different systems of Motus.
    """

    def __init__(self, bones, entry, scene):
        Tails.__init__(self, bones, scene, registered["dynamics"])
        self._entry = entry

    def tails(self, timing):
        """Return {bone name: positions of its tail in world space, (n, 3)} at the n frames of a sampling.Timing."""
        return dict(zip(self._names, self.kept(("tails", timing), lambda: self.places(self.frames(timing))[1:])))
