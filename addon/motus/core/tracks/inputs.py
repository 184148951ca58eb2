"""Inputs that are read from several tracks, such as the motion of bones' tails in the world: what all systems that filter them share."""

import functools
from collections.abc import Sequence
from typing import Any

from .. import wiring
from ..animation import keys, strips
from ..declare import Problem
from ..evaluated.question import answered
from ..lazy import numpy as np
from ..measures import scene_time
from ..translations import tr
from . import bone_channels, in_world, laid, rotations
from .track import kept_by, own_track, world_track

PARENT = None
"""Stands for the parent of the object (an object or bone) in lists of bone names, in which "" stands for the object itself."""


NEEDS_RECORDING = Problem("Some of the followed motion cannot be read from keys: record it", blocking=False)
NOT_KNOWN = Problem("Some of what is followed is not known on other frames, and cannot be recorded", blocking=False)
BAD_NUMBERS = Problem("Some numbers are outside of what a motion can be computed from", blocking=False)
MISSING_BONES = Problem("Some bones that follow are not there any more: remove them from the list", blocking=False)
LOOPED_BONES = Problem("Some bones move with what they follow, and are left out", blocking=False)
BONES_CHANGED = Problem("The rig's bones have changed: press Refresh")


def of_unknown(source):
    """Return the Problem of an input (core/tracks/inputs.py) that is not known."""
    return NOT_KNOWN if source.reason else NEEDS_RECORDING


def carrier(obj, scene):
    """Return the track of the world matrix of an object's parent, which is an object or a bone."""
    return world_track(in_world.parent_of(obj), scene)


def stamp_of_carrier(owner, name, scene, system):
    """Return a hashable value that changes whenever the motion of a carrier may. name: of a bone, "" for the rig, or PARENT.

    system: the System that reads the carrier, and whose effect on it is left out; None to leave out none.
    """
    if name is PARENT:
        reason = in_world.of_parent(owner)
        return reason.kind if reason else stamp_of_known(carrier(owner, scene))
    thing = owner.pose.bones[name] if name else owner
    return stamp_of_known(world_track(thing, scene, system))


def stamp_of_known(track):
    """Return the stamp of a track; () if the track is unknown because it has not been recorded, since then nothing reads it."""
    return track.stamp if track.is_known else ()


class Input:
    """Base class of inputs: a motion that is read from tracks. Made anew for each use.

    carriers: names (of bones, "" or PARENT) of what the input reads world tracks of. These tracks may change although neither the
    owner nor its keys are edited.
    Subclasses define `listed`, [(track, keywords of the operator motus.track_record or None)].
    """

    carriers: Sequence[Any] = ()

    def __init__(self, thing, scene):
        self._thing, self._scene = thing, scene

    @property
    def laid(self):
        """Names of bones whose own transforms the input reads and over which different systems of Motus lay poses."""
        names = [keywords["bone"] for _, keywords in self.listed if keywords and keywords["transform"] == 'OWN' and "bone" in keywords]
        return [name for name in names if laid.is_laid(self._rig.pose.bones[name])]

    @property
    def _rig(self):
        return self._thing.id_data

    @property
    def reason(self):
        """The Reason why the input is unknown even if it is recorded; None if there is none."""
        return None

    @property
    def unknown(self):
        """[(track, keywords of motus.track_record)] of the tracks that have to be recorded, or have been recorded."""
        return [(track, keywords) for track, keywords in self.listed if track.reason is not None]

    def sentence(self, thing):
        """Return the sentence for the user that says why the input is unknown. thing: label of what follows the input."""
        if self.reason:
            return tr("What {thing} follows is not known on other frames: {reason}").format(thing=thing, reason=self.reason.sentence)
        reason = next(track.reason for track, _ in self.unknown if not track.is_known)
        return tr("What {thing} follows needs recording: {reason}").format(thing=thing, reason=reason.sentence)

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
        """Price of reading the input at one time, in units of core/measures/bounds.py (about a microsecond)."""
        return self.kept("price", lambda: sum(track.price for track in self.tracks))


class Tails(Input):
    """Input that is the motion of bones' tails in world space, from the animation of their rig and of the rig's parents.

    bones: all bones of one chain that follow, topmost first. Parent bones of the chain may be moved by systems of Motus.
    system: a System whose effect on these parent bones is left out; None to leave out none.
    """

    def __init__(self, bones, scene, system):
        super().__init__(bones, scene)
        self._system = system
        self._names = tuple(bone.name for bone in bones)
        self._found = {}

    @property
    def _rig(self):
        return self._thing[0].id_data

    @functools.cached_property
    def _read(self):
        """{name of each bone that is read: whether its world matrix is read, instead of its own transform}.

        The bones that follow and those between them are read by their own transforms, so that what the system does is left out; the first
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
        return {"": world_track(rig, scene)} | {name: world_track(rig.pose.bones[name], scene, self._system) for name in bases}

    @functools.cached_property
    def listed(self):
        """[(track, keywords of the operator motus.track_record)] of the rig, and of the bones that are read."""
        rig = self._rig
        found = [(self._worlds[""], {"datablock": rig.name, "transform": 'WORLD'})]
        for name, is_base in self._read.items():
            track = self._worlds[name] if is_base else own_track(rig.pose.bones[name])
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
        found = [name for name, is_base in self._read.items() if is_base and self._is_turned(rig.pose.bones[name])]
        if any(self._worlds[name].is_known for name in found):  # the stamps of these tracks change with the rig's motion as well
            return found
        return [*found, *([""] if len(rig.constraints) else [PARENT] if rig.parent else [])]

    def kept(self, name, make):
        """Return make(), kept until the animation or the armature changes, so that an edit of the entries does not compute it again."""
        if name not in self._found:
            self._found[name] = kept_by(self.stamp, (name, self._names), make)
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
    def stamp(self):
        """Hashable value that changes whenever the input or the rest pose of its bones may change; None if changes cannot be detected."""
        if self._channels is not None:
            return strips.together((self._channels, *(track.stamp for track in self._worlds.values())))
        bones = self._rig.pose.bones
        return strips.together((*(in_world.rest_stamp(bones[name]) for name in self._read), *(track.stamp for track in self.tracks)))

    def _is_turned(self, bone):
        """Whether a PoseBone or one of its parents has constraints whose effect is not left out."""
        acting = (one for above in (bone, *bone.parent_recursive) for one in above.constraints)
        return any(self._system is None or not wiring.is_sink(self._system, one) for one in acting)

    def places(self, frames):
        """Return world positions (n, 3) at frames (n,): of the head of the topmost bone, then of the tail of each bone."""
        found = []
        for bone, placed in zip(self._thing, self.matrices(frames)):
            if not found:
                found.append(placed[:, :3, 3])
            found.append(placed[:, :3, 3] + bone.bone.length * placed[:, :3, 1])
        return tuple(np.broadcast_to(one, (len(frames), 3)) for one in found)

    def sides(self, frames):
        """Return vectors (n, 3) along the X axes of the bones in the world at frames (n,): one of 0 for the head of the topmost bone first."""
        return np.zeros((len(frames), 3)), *(placed[:, :3, 0] for placed in self.matrices(frames))

    def matrices(self, frames):
        """Return the world matrices (n, 4, 4) of each bone at frames (n,), as a list."""
        world = self.tracks[0].values(frames)
        inverse, poses = _inverse(world), {}
        placed = (rotations.chained(world, self._pose(bone, frames, inverse, poses)) for bone in self._thing)
        return [np.broadcast_to(one, (len(frames), 4, 4)) for one in placed]

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
