"""What entries follow, over time: read from tracks, beneath what dynamics themselves make of it."""

import functools
from collections.abc import Sequence
from typing import Any

from ..core import tracks, wiring
from ..core.animation import keys
from ..core.declare import registered
from ..core.evaluated.question import answered
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import Refused
from ..core.tracks import laid, rotations, transforms
from . import filters, sampling
from .sampling import Samples


def of_object(obj, entry, scene):
    """The input (motion to be filtered) of an object's entry: its world motion or its own channels. obj: original or evaluated."""
    return WorldInput(obj, entry, scene) if follows_parent(obj, entry) else OwnInput(obj, entry, scene)


def follows_parent(obj, entry):
    """Whether an object's entry follows its motion in the world, its parent's motion included, instead of its own channels alone."""
    return entry.follow == 'WORLD' and obj.parent is not None


def carrier(obj, scene):
    """Track of the world matrix of an object's parent, an object or bone."""
    return tracks.world_track(transforms.parent_of(obj), scene)


MOST_NUMBERS = 32
"""Numbers of an array property that can follow: Blender's own arrays have no more."""


PARENT = None
"""Among names of bones: what the object hangs on, object or bone. The name of the object itself is ""."""


class _Input:
    """What an entry follows, read from tracks. Built anew for each use.

    carriers: names whose world tracks count for it, and change though neither the owner nor its keys are edited.
    """

    carriers: Sequence[Any] = ()

    @property
    def laid(self):
        """Names of bones whose own transforms count for it, and other systems lay poses over."""
        names = [keywords["bone"] for _, keywords in self.listed if keywords and keywords["transform"] == 'OWN' and "bone" in keywords]
        return [name for name in names if laid.is_laid(self._rig.pose.bones[name])]

    @property
    def _rig(self):
        return self._thing.id_data

    def __init__(self, thing, entry, scene):
        self._thing, self._entry, self._scene = thing, entry, scene

    @property
    def reason(self):
        """A Reason for which nobody knows it, recorded or not; None without."""
        return None

    @property
    def unknown(self):
        """(track, keywords of motus.track_record) of what has to be recorded, or was."""
        return [(track, keywords) for track, keywords in self.listed if track.reason is not None]

    @property
    def is_known(self):
        """Whether all of it can be read."""
        return self.reason is None and all(track.is_known for track, _ in self.listed)

    @property
    def tracks(self):
        """All tracks that it is made from."""
        return [track for track, _ in self.listed]

    @property
    def extent(self):
        """First and last frame between which any of the input's tracks changes; None if none does."""
        return extent_of(self.tracks)

    def times(self, reach):
        """Frames at which it is looked at for a sampling.Reach."""
        return times_of(self._entry, self.tracks, self._scene, reach)


def has_loop(entry):
    """Whether an entry loops over some frames."""
    return entry.use_loop and entry.loop_end > entry.loop_start


def extent_of(found):
    """First and last frame between which any of several tracks changes; None if none does."""
    return keys.united(track.extent for track in found)


def times_of(entry, found, scene, reach):
    """Frames at which the tracks of an entry are looked at for a sampling.Reach."""
    if has_loop(entry):
        return np.array(sampling.between(found, float(entry.loop_start), float(entry.loop_end), scene))
    return sampling.times(found, _span_of(entry, found, scene, reach), scene)


def is_cut(entry, found, scene, reach):
    """Whether more of the tracks of an entry would count than may be looked at for a sampling.Reach."""
    return not has_loop(entry) and extent_of(found) is not None and _span_of(entry, found, scene, reach).is_cut


def _span_of(entry, found, scene, reach):
    return sampling.span_of(extent_of(found), scene, reach, past_of(entry) * scene_time.fps(scene))


def price_of(source):
    """Price of sampling one piece of an input (see core/measures/bounds.py)."""
    return sampling.RATE * sampling.PIECE * sum(track.price for track in source.tracks)


def past_of(entry):
    """Seconds of its input that count for an entry at a time."""
    return filters.memory(filters.numbers(entry)) + entry.delay


def seconds_of(frames, scene):
    """Times in seconds."""
    return scene_time.seconds(scene, frames)


class OwnInput(_Input):
    """The own transform of an Object or PoseBone."""

    @functools.cached_property
    def listed(self):
        """[(track, keywords of motus.track_record)]."""
        thing = self._thing
        names = {"datablock": thing.id_data.name, "transform": 'OWN'}
        parts = {name.lower() for name in self._entry.channels}
        if "rotation" in parts:
            parts.add("scale")  # what is mirrored turns otherwise
        return [(tracks.own_track(thing, parts), names if thing == thing.id_data else names | {"bone": thing.name})]

    def samples(self, frames):
        """Samples at frames (n,)."""
        found = self.tracks[0].values(frames)
        turns = rotations.product(found.rotations, _mirrored(found.scales))
        return Samples(
            seconds_of(frames, self._scene),
            found.locations,
            turns,
            found.scales,
            sampling.resets(frames, found.locations, self._entry.jump),
        )


def _mirrored(scales):
    """Quaternions by which a transform with these scales (n, 3) turns more than its rotation, as Blender takes it apart.

    Blender makes a mirrored matrix one with three negative scales, any other one with none.
    """
    signs = np.where(scales < 0.0, -1.0, 1.0)
    signs *= np.prod(signs, axis=1, keepdims=True)
    # Half a turn about the axis that keeps its sign, or none.
    turned = (signs < 0.0).any(axis=1)
    found = np.zeros((len(scales), 4))
    found[~turned, 0] = 1.0
    found[:, 1:] = np.where(turned[:, None] & (signs > 0.0), 1.0, 0.0)  # type: ignore[index]
    return found


class WorldInput(_Input):
    """An object's motion in the world: its own transform on top of its parent's."""

    carriers = (PARENT,)

    @functools.cached_property
    def listed(self):
        """(track, keywords of motus.track_record) of the tracks that the input is made from."""
        obj, parent = self._thing, transforms.parent_of(self._thing)
        names = {"datablock": obj.parent.name, "transform": 'WORLD'}
        if parent != obj.parent:
            names["bone"] = parent.name
        return [*OwnInput(obj, self._entry, self._scene).listed, (carrier(obj, self._scene), names)]

    @property
    def reason(self):
        return transforms.of_parent(self._thing)

    def samples(self, frames):
        """The Samples at frames: locations and rotations in world space, scales as they are keyed."""
        own, carried = (track.values(frames) for track in self.tracks)
        space = rotations.chained(carried, transforms.parent_offset(self._thing))
        found = rotations.chained(space, own.matrices)
        places = found[:, :3, 3]
        return Samples(
            seconds_of(frames, self._scene),
            places,
            rotations.of_axes(found[:, :3, :3]),
            own.scales,
            sampling.resets(frames, places, self._entry.jump),
        )


class ValueInput(_Input):
    """The numbers of a property by its own keys, beneath the drivers through which it follows; no tracks where it is gone."""

    @functools.cached_property
    def listed(self):
        """The tracks of the property's numbers; without keywords, since a property cannot be recorded while it is driven."""
        places = numbers_of(self._thing, self._entry)
        return [
            (tracks.property_track(place.id_data, place.data_path, place.number.index, is_beneath_driver=True), None) for place in places
        ]

    @property
    def reason(self):
        return next((track.reason for track in self.tracks if track.reason), None)

    def values(self, frames):
        """Their values, (n, numbers)."""
        return np.stack([track.values(frames) for track in self.tracks], axis=1)


def numbers_of(owner, entry):
    """The Places of an entry's property, by its path from an original or evaluated owner; [] where that is gone."""
    return [wiring.property_place(owner, entry.data_path, index) for index in indices_of(owner, entry.data_path, entry.index)]


def indices_of(owner, path, index, most=MOST_NUMBERS):
    """Indices of the numbers that are meant at a path from an object, -1 of what is no array; [] where there are none."""
    try:
        value = owner.path_resolve(path)
        count = len(value) if index < 0 and hasattr(value, "__len__") and not isinstance(value, str) else 0
        found = list(range(min(count, most))) or [index]
        wiring.property_place(owner, path, found[0])
    except (ValueError, Refused):
        return []
    return found


class TailInput(_Input):
    """The motion of bones' tails in the world, by the animation of their rig and of the rig's parents.

    Of the bones that hang on each other all are given together. Bones above them may be moved by other systems.
    """

    def __init__(self, bones, entry, scene):
        super().__init__(bones, entry, scene)

    @property
    def _rig(self):
        return self._thing[0].id_data

    @functools.cached_property
    def listed(self):
        """(track, keywords of motus.track_record) of the tracks that the input is made from."""
        rig, scene = self._rig, self._scene
        found = {"": (tracks.world_track(rig, scene), {"datablock": rig.name, "transform": 'WORLD'})}
        names = {bone.name for bone in self._thing}
        for bone in self._thing:
            while bone is not None and bone.name not in found:
                if names.isdisjoint(one.name for one in (bone, *bone.parent_recursive)):
                    # Above all that follow.
                    found[bone.name] = (
                        tracks.world_track(bone, scene, registered["dynamics"]),
                        {"datablock": rig.name, "bone": bone.name, "transform": 'WORLD'},
                    )
                    break
                found[bone.name] = tracks.own_track(bone), {"datablock": rig.name, "bone": bone.name, "transform": 'OWN'}
                bone = bone.parent
        self._places = dict(zip(found, range(len(found))))
        return list(found.values())

    @property
    def carriers(self):
        """Names of the bones that constraints turn above the ones that follow, and "" for the rig: their world tracks count for the input."""
        rig = self._rig
        bases = {keywords["bone"]: track for track, keywords in self.listed if keywords["transform"] == 'WORLD' and "bone" in keywords}
        found = [name for name in bases if _is_turned(rig.pose.bones[name])]
        if any(bases[name].is_known for name in found):  # what is read of them says the same of the rig
            return found
        return [*found, *([""] if len(rig.constraints) else [PARENT] if rig.parent else [])]

    def tails(self, frames):
        """{bone's name: places of its tail (n, 3) in world space} at frames (n,)."""
        return answered((self, frames.tobytes()), lambda: self._tails(frames))

    def _tails(self, frames):
        found = self.tracks
        world = found[0].values(frames)
        inverse = _inverse(world)
        poses, tails = {}, {}
        for bone in self._thing:
            pose = self._pose(bone, frames, inverse, poses)
            tail = rotations.chained(world, pose)
            tails[bone.name] = np.broadcast_to(tail[:, :3, 3] + bone.bone.length * tail[:, :3, 1], (len(frames), 3))
        return tails

    def _pose(self, bone, frames, inverse, poses):
        """The bone's matrices (n, 4, 4) in the rig's space."""
        way = []
        while bone is not None and bone.name not in poses:
            way.append(bone)
            if self._is_base(bone):
                break
            bone = bone.parent
        for one in reversed(way):
            track = self.tracks[self._places[one.name]]
            if self._is_base(one):
                poses[one.name] = rotations.chained(inverse, track.values(frames))
            else:
                above = poses[one.parent.name] if one.parent else None
                poses[one.name] = np.broadcast_to(transforms.posed(one, track.values(frames), above), (len(frames), 4, 4))
        return poses[way[0].name] if way else poses[bone.name]

    def _is_base(self, bone):
        return self.tracks[self._places[bone.name]].what.endswith("world")


def _is_turned(bone):
    """Whether constraints that are not of dynamics act on a PoseBone, or on one above it."""
    return any(not wiring.is_sink(registered["dynamics"], one) for above in (bone, *bone.parent_recursive) for one in above.constraints)


def _inverse(matrices):
    """Inverses of affine matrices (n, 4, 4); zeros for a singular one. Summed by hand, so that the bits do not depend on how the arrays are aligned."""
    x, y, z = (matrices[:, :3, column] for column in range(3))
    rows = [_cross(y, z), _cross(z, x), _cross(x, y)]
    volume = (x * rows[0]).sum(axis=1)
    scale = np.where(volume != 0.0, 1.0, 0.0) / np.where(volume != 0.0, volume, 1.0)
    found = np.zeros_like(matrices)
    for index, row in enumerate(rows):
        found[:, index, :3] = row * scale[:, None]
        found[:, index, 3] = -(found[:, index, :3] * matrices[:, :3, 3]).sum(axis=1)
    found[:, 3, 3] = 1.0
    return found


def _cross(a, b):
    return np.stack(
        (a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1], a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2], a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), axis=1
    )
