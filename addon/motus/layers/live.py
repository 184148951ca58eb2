"""What a layer is while it is edited by its keys (editing.py), as its solver reads it: its own channels, and what lies beneath them.

A strip of the NLA in tweak mode plays the layer's action, so that the own channels of the bones that the action animates are what the
layer says. The rig's own action is played by a strip on a track below.
"""

import json
from types import SimpleNamespace

from ..core.animation import channel, strips
from ..core.file import stored
from ..core.lazy import numpy as np
from ..core.tracks import rotations
from ..core.tracks.transforms import Transforms
from . import clips

BENEATH, BESIDE, TWEAKED = "Motus: Beneath the Layer", "Motus: Beside the Layer", "Motus: Layer"
"""Names of the NLA tracks that a rig has while a layer is edited.

BENEATH has the rig's own action. Below an additive layer it is muted, and BESIDE has a copy without the bones in the layer's mask, whose own
channels then are what the layer says, also where its action says nothing yet.
"""
SAME = 1e-5
"""Difference of a number from its neutral value up to which it counts as unchanged."""
_FORM = [(str, str, [float])]
"""Structure of the JSON text of the values that channels had when the editing began: (bone, channel, numbers) of each."""


def keep_channels(rig):
    """Store the values that the channels of a rig's bones have, for kept_channels()."""
    rig.motus.layers.kept_channels = json.dumps(
        [(bone.name, name, list(getattr(bone, name))) for bone in rig.pose.bones for name in channels_of(bone)]
    )


def kept_channels(settings):
    """Return {bone: {channel: numbers}} of a rig when the editing of a layer began. Raises Damaged if a file has something different."""
    found = {}
    for bone, name, numbers in stored.parse(settings.kept_channels, _FORM):
        if len(numbers) == clips.SIZES.get(name):
            found.setdefault(bone, {})[name] = numbers
    return found


def edited(rig):
    """Return the index of the layer of a rig that is edited; None if there is none. rig: may be evaluated."""
    animation = rig.animation_data
    if animation is None or not animation.use_tweak_mode or TWEAKED not in animation.nla_tracks:
        return None
    return next((index for index, entry in enumerate(rig.motus.layers.entries) if entry.is_edited), None)


def was_left(rig):
    """Whether the user has left the tweak mode in the NLA editor, so that what editing has made is still there."""
    return edited(rig) is None and any(entry.is_edited for entry in rig.motus.layers.entries)


class Live:
    """A Clip of what the own channels of an evaluated rig's bones are, for the layer that is edited. Whole turns are not kept.

    channels: {bone: names of the properties that count}. names, modes: of all bones of the rig.
    """

    asks_curves = True

    def __init__(self, rig, clip, channels, names, modes):
        self._clip, self.frames = clip, clip.frames
        self._bones = [(rig.pose.bones[name], channels[name]) for name in names if name in channels]
        curves = [
            (row, clips.FIRST[channel] + index, -1, False)
            for row, name in enumerate(names)
            for channel in channels.get(name, ())
            for index in range(clips.SIZES[channel])
        ]
        self.native = clips.native_clip(modes, curves, [])

    def given(self, _frame):
        """Return the present numbers of all channels."""
        return [number for bone, channels in self._bones for channel in channels for number in getattr(bone, channel)]

    def reference(self, frame):
        """Return the pose of the action at a frame, at rest what it says nothing of."""
        return clips.pose_of(self._clip, self.native.bones, frame)

    def laps(self, _begin, _end, _reference):
        """Rotations go the shorter way."""


class Edited:
    """The layer of an evaluated rig that is edited.

    Channels count that the layer's action animates, and all others of bones in the mask that somebody has changed: they differ from what
    lies beneath an overriding layer, or from what an additive one is compared with.
    masked: names of the bones in the mask. names, modes: of all bones of the rig.
    """

    def __init__(self, rig, entry, masked, names, modes):
        self._rig, self._entry, self._masked, self._names, self._modes = rig, entry, masked, names, modes
        self._kept: tuple = None, None

    def at(self, clip, other, frame):
        """Return (Live, rows of bones, what their own matrices are beneath the layer, (n, 16)) at a frame of the scene.

        clip: of the layer's action. other: Clip of the action that the layer is compared with, or None.
        """
        animated = {self._names[row]: _names(flags, self._modes[row]) for row, flags in zip(clip.native.bones, clip.native.channels)}
        rows = [row for row, name in enumerate(self._names) if name in animated or name in self._masked]
        bones = [self._rig.pose.bones[self._names[row]] for row in rows]
        beneath = Beneath(self._rig, [bone.name for bone in bones])
        neutral = beneath.numbers(frame) if self._entry.mode == 'OVERRIDE' else neutral_numbers(self._entry, other, bones, rows)
        counting = {}
        for bone, numbers in zip(bones, neutral):
            said = animated.get(bone.name, ())
            changed = [name for name in numbers if bone.name in self._masked and not _is_same(getattr(bone, name), numbers[name])]
            counting[bone.name] = tuple(name for name in numbers if name in said or name in changed)
        place = clip, tuple(counting.items())
        if self._kept[0] != place:
            self._kept = place, Live(self._rig, clip, counting, self._names, self._modes)
        return self._kept[1], rows, beneath.matrices(frame)


def neutral_numbers(entry, other, bones, rows):
    """Return {property: numbers} of each bone with which an additive layer adds nothing: its reference, for what its action does not animate.

    other: Clip of the action that the layer is compared with, or None. rows: of the bones in the rig.
    """
    if entry.reference != 'ACTION' or other is None:
        return [{name: clips.at_rest(name) for name in channels_of(bone)} for bone in bones]
    pose = clips.pose_of(other, rows, entry.reference_frame)
    return [dict(zip(channels_of(bone), clips.numbers_of(row, bone.rotation_mode))) for bone, row in zip(bones, pose.tolist())]


def _is_same(numbers, others):
    return all(abs(one - other) <= SAME * max(1.0, abs(other)) for one, other in zip(numbers, others))


class Beneath:
    """Own transforms of bones of a rig as they are beneath the layer that is edited, at any frame. names: of the bones."""

    def __init__(self, rig, names):
        self.reason, kept = None, kept_channels(rig.motus.layers)
        self._lower = SimpleNamespace(
            id_data=rig,
            use_tweak_mode=False,
            nla_tracks=[
                SimpleNamespace(mute=track.mute and track.name != BENEATH, is_solo=False, strips=track.strips)
                for track in rig.animation_data.nla_tracks
                if track.name not in {TWEAKED, BESIDE}
            ],
            action=None,
        )
        self._strips = [strip for track in self._lower.nla_tracks if not track.mute for strip in track.strips]
        bones = [rig.pose.bones[name] for name in names]
        self._bones = [(bone, self._values(bone, kept.get(bone.name, {}))) for bone in bones]

    def _values(self, bone, kept):
        return {
            name: [self._value(bone, name, index, number) for index, number in enumerate(kept.get(name) or getattr(bone, name))]
            for name in channels_of(bone)
        }

    def _value(self, bone, name, index, own):
        """Return a Stack with the values of a number of a bone, or the number `own` if no strip animates it."""
        path = f"{bone.path_from_id()}.{name}"
        if not any(strips.animates(strip, path, index) for strip in self._strips):
            return own
        found = strips.Stack.of(self._lower, path, channel.number(bone.id_data, path, index), None)
        if isinstance(found, strips.Stack):
            return found
        self.reason = self.reason or found
        return own

    def numbers(self, frame):
        """Return {property: its numbers} of each bone at a frame of the scene."""
        times = np.array([frame], float)
        return [{name: [_at(one, times) for one in group] for name, group in found.items()} for _, found in self._bones]

    def matrices(self, frame):
        """Return the bones' own matrices at a frame of the scene, (n, 16), column by column."""
        made = np.empty((len(self._bones), 16))
        for place, ((bone, _), found) in enumerate(zip(self._bones, self.numbers(frame))):
            location, turn, scale = (np.array([found[name]]) for name in channels_of(bone))
            made[place] = Transforms(location, rotations.of_mode(turn, bone.rotation_mode), scale).matrices[0].T.ravel()
        return made


def _at(value, times):
    return float(value.values(times)[0]) if isinstance(value, strips.Stack) else value


def channels_of(bone):
    """Return the names of the properties that the own transform of a PoseBone is made of."""
    return ("location", clips.rotation_of(bone.rotation_mode), "scale")


def _names(flags, mode):
    """Return the names of the properties for a sum of the native module's flags of channels."""
    return [name for flag, name in ((1, "location"), (2, clips.rotation_of(mode)), (4, "scale")) if flags & flag]
