"""Inputs of dynamics: the animation over time that an entry filters, without the effect of the dynamics themselves.

An entry is one item in an owner's list of dynamics. Inputs read tracks: a track gives a property or transform at any times.
"""

import functools
from collections.abc import Sequence
from typing import Any

from ..core import tracks, wiring
from ..core.animation import keys, strips
from ..core.declare import registered
from ..core.evaluated.question import answered
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import Refused
from ..core.tracks import bone_channels, in_world, laid, rotations
from . import filters, sampling
from .sampling import Samples


def of_object(obj, entry, scene):
    """Make the input (motion to be filtered) of an object's entry: its world motion or its own channels. obj: original or evaluated."""
    return WorldInput(obj, entry, scene) if follows_parent(obj, entry) else OwnInput(obj, entry, scene)


def follows_parent(obj, entry):
    """Whether an object's entry follows its motion in the world, its parent's motion included, instead of its own channels alone."""
    return entry.follow == 'WORLD' and obj.parent is not None


def carrier(obj, scene):
    """Return the track of the world matrix of an object's parent, which is an object or a bone."""
    return tracks.world_track(in_world.parent_of(obj), scene)


MOST_NUMBERS = 32
"""Greatest number of elements of an array property that can have dynamics: Blender's own arrays are not longer."""


PARENT = None
"""Stands for the parent of the object (an object or bone) in lists of bone names, in which "" stands for the object itself."""


class _Input:
    """Base class of the inputs of entries: the motion that an entry filters, read from tracks. Made anew for each use.

    carriers: names (of bones, "" or PARENT) of what the input reads world tracks of. These tracks may change although neither the
    owner nor its keys are edited.
    Subclasses define `listed`, [(track, keywords of the operator motus.track_record or None)].
    """

    carriers: Sequence[Any] = ()

    @property
    def laid(self):
        """Names of bones whose own transforms the input reads and over which different systems of Motus lay poses."""
        names = [keywords["bone"] for _, keywords in self.listed if keywords and keywords["transform"] == 'OWN' and "bone" in keywords]
        return [name for name in names if laid.is_laid(self._rig.pose.bones[name])]

    @property
    def _rig(self):
        return self._thing.id_data

    def __init__(self, thing, entry, scene):
        self._thing, self._entry, self._scene = thing, entry, scene

    @property
    def reason(self):
        """The Reason why the input is unknown even if it is recorded; None if there is none."""
        return None

    @property
    def unknown(self):
        """[(track, keywords of motus.track_record)] of the tracks that have to be recorded, or have been recorded."""
        return [(track, keywords) for track, keywords in self.listed if track.reason is not None]

    @functools.cached_property
    def fps(self):
        """Frames per second of the scene; Blender looks it up anew each time."""
        return scene_time.fps(self._scene)

    @functools.cached_property
    def is_known(self):
        """Whether the whole input can be read."""
        return self.reason is None and all(track.is_known for track, _ in self.listed)

    @functools.cached_property
    def tracks(self):
        """Tuple of all tracks from which the input is computed."""
        return tuple(track for track, _ in self.listed)

    @functools.cached_property
    def extent(self):
        """First and last frame between which any of the input's tracks changes; None if no track changes."""
        return self.kept("extent", lambda: keys.united(track.extent for track in self.tracks))

    def kept(self, name, make):
        """Return make(), which depends on the tracks and on `name` alone. Inputs that share their tracks find it once for one question."""
        return answered((self.tracks, name), make)

    @property
    def price(self):
        """Price of sampling one piece of the input, sampling.PIECE seconds (for its unit see core/measures/bounds.py)."""
        return self.kept("price", lambda: sampling.RATE * sampling.PIECE * sum(track.price for track in self.tracks))

    def times(self, reach, entry=None):
        """Return the frames, rising, at which the input is sampled for a sampling.Reach. entry: by whose settings; None: the input's own."""
        return times_of(self, entry or self._entry, self._scene, reach)

    def frames(self, timing):
        """Return the frames (n,), rising, of a sampling.Timing."""
        return self.kept(timing, lambda: timing.times(self.tracks, self._scene))

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


class OwnInput(_Input):
    """Input that is an Object's or PoseBone's own transform: its location, rotation and scale channels without its parents."""

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
        turns = rotations.product(found.rotations, _mirrored(found.scales))
        return Samples(
            seconds_of(frames, self._scene),
            found.locations,
            turns,
            found.scales,
            sampling.resets(frames, found.locations, self._entry.jump),
        )


@rotations.by_rows
def _mirrored(scales):
    """Return quaternions (n, 4) by which Blender's decomposition of a matrix turns further than the keyed rotation.

    scales: (n, 3) keyed scales. Blender decomposes a mirroring matrix into three negative scales, and any other matrix into three
    positive ones. The remaining signs become half a turn.
    """
    signs = np.where(scales < 0.0, -1.0, 1.0)
    signs *= np.prod(signs, axis=1, keepdims=True)
    # Two negative signs are left, which are half a turn about the third axis; or no sign is left, which is no turn.
    turned = (signs < 0.0).any(axis=1)
    found = np.zeros((len(scales), 4))
    found[~turned, 0] = 1.0
    found[:, 1:] = np.where(turned[:, None] & (signs > 0.0), 1.0, 0.0)  # type: ignore[index]
    return found


class WorldInput(_Input):
    """Input that is an object's motion in the world: its own transform on top of its parent's world matrix."""

    carriers = (PARENT,)

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


class ValueInput(_Input):
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


class TailInput(_Input):
    """Input that is the motion of bones' tails in world space, from the animation of their rig and of the rig's parents.

    bones: all bones of one chain that follow, topmost first. Parent bones of the chain may be moved by different systems of Motus.
    """

    def __init__(self, bones, entry, scene):
        super().__init__(bones, entry, scene)
        self._names = tuple(bone.name for bone in bones)
        self._found = {}

    @property
    def _rig(self):
        return self._thing[0].id_data

    @functools.cached_property
    def _read(self):
        """{name of each bone that is read: whether its world matrix is read, instead of its own transform}.

        The bones that follow and those between them are read by their own transforms, so that what dynamics do is left out; the first
        bone above all bones that follow is read by its world matrix.
        """
        names, found = set(self._names), {}
        for bone in self._thing:
            while bone is not None and bone.name not in found:
                is_base = bone.name not in names and names.isdisjoint(one.name for one in bone.parent_recursive)
                found[bone.name] = is_base
                bone = None if is_base else bone.parent
        return found

    @property
    def _own_names(self):
        return tuple(name for name, is_base in self._read.items() if not is_base)

    @functools.cached_property
    def _worlds(self):
        """{bone name, or "" for the rig: track of its world matrix}, of the rig and the bones that are read by their world matrix."""
        rig, scene = self._rig, self._scene
        bases = [name for name, is_base in self._read.items() if is_base]
        return {"": tracks.world_track(rig, scene)} | {
            name: tracks.world_track(rig.pose.bones[name], scene, registered["dynamics"]) for name in bases
        }

    @functools.cached_property
    def listed(self):
        """[(track, keywords of the operator motus.track_record)] of the rig, and of the bones that are read."""
        rig = self._rig
        found = [(self._worlds[""], {"datablock": rig.name, "transform": 'WORLD'})]
        for name, is_base in self._read.items():
            track = self._worlds[name] if is_base else tracks.own_track(rig.pose.bones[name])
            found.append((track, {"datablock": rig.name, "bone": name, "transform": 'WORLD' if is_base else 'OWN'}))
        return found

    @functools.cached_property
    def laid(self):
        bones = self._rig.pose.bones
        return [name for name in self._own_names if laid.is_laid(bones[name])]

    @functools.cached_property
    def is_known(self):
        """Whether the whole input can be read."""
        found = self.tracks if self._channels is None else self._worlds.values()
        return all(track.is_known for track in found)

    @property
    def carriers(self):
        """Names of parent bones of the chain whose world tracks the input reads because constraints act on them.

        The list also has "" if the rig itself is constrained, or PARENT if the rig has a parent: unless the world track of a
        listed bone is known, which depends on the rig's motion anyway.
        """
        rig = self._rig
        found = [name for name, is_base in self._read.items() if is_base and _is_turned(rig.pose.bones[name])]
        if any(self._worlds[name].is_known for name in found):  # the stamps of these tracks change with the rig's motion as well
            return found
        return [*found, *([""] if len(rig.constraints) else [PARENT] if rig.parent else [])]

    def tails(self, timing):
        """Return {bone name: positions of its tail in world space, (n, 3)} at the n frames of a sampling.Timing."""
        return dict(zip(self._names, self.kept(("tails", timing), lambda: self._tails(self.frames(timing)))))

    def kept(self, name, make):
        """Return make(), kept until the animation or the armature changes, so that an edit of the entries does not compute it again."""
        if name not in self._found:
            self._found[name] = tracks.kept_by(self._stamp, (name, self._names), make)
        return self._found[name]

    @functools.cached_property
    def _channels(self):
        """Stamp of the own transforms of the bones that are read by these, if nothing but keys moves them; None otherwise."""
        if not self._rig.is_evaluated or self.laid:
            return None
        names, bones = self._own_names, self._rig.pose.bones
        found = bone_channels.stamp(self._rig, names)
        return found and (found, tuple([bones[name].parent.name if bones[name].parent else "" for name in names]))

    @functools.cached_property
    def _stamp(self):
        if self._channels is not None:
            return strips.together((self._channels, *(track.stamp for track in self._worlds.values())))
        bones = self._rig.pose.bones
        return strips.together((*(in_world.rest_stamp(bones[name]) for name in self._read), *(track.stamp for track in self.tracks)))

    def _tails(self, frames):
        found = self.tracks
        world = found[0].values(frames)
        inverse = _inverse(world)
        poses, tails = {}, []
        for bone in self._thing:
            pose = self._pose(bone, frames, inverse, poses)
            tail = rotations.chained(world, pose)
            tails.append(np.broadcast_to(tail[:, :3, 3] + bone.bone.length * tail[:, :3, 1], (len(frames), 3)))
        return tuple(tails)

    def _pose(self, bone, frames, inverse, poses):
        """Return the pose matrices of a bone in the rig's space, (n, 4, 4).

        inverse: inverses of the rig's world matrices. poses: {bone name: matrices} of bones computed before, which is filled.
        """
        way = []
        while bone is not None and bone.name not in poses:
            way.append(bone)
            if self._is_base(bone):
                break
            bone = bone.parent
        for one in reversed(way):
            track = self._by_name[one.name]
            if self._is_base(one):
                poses[one.name] = rotations.chained(inverse, track.values(frames))
            else:
                above = poses[one.parent.name] if one.parent else None
                poses[one.name] = np.broadcast_to(in_world.posed(one, track.values(frames), above), (len(frames), 4, 4))
        return poses[way[0].name] if way else poses[bone.name]

    def _is_base(self, bone):
        return self._read[bone.name]

    @functools.cached_property
    def _by_name(self):
        return dict(zip(self._read, self.tracks[1:]))


def _is_turned(bone):
    """Whether a PoseBone or one of its parents has constraints that do not belong to dynamics."""
    return any(not wiring.is_sink(registered["dynamics"], one) for above in (bone, *bone.parent_recursive) for one in above.constraints)


@rotations.by_rows
def _inverse(matrices):
    """Return the inverses of affine matrices (n, 4, 4). The upper 3 x 3 part of the inverse of a singular matrix is zero.

    The sums are written out, so that the result does not depend on the alignment of the arrays to the last bit.
    """
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
