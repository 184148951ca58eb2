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

BENEATH, TWEAKED = "Motus: Beneath the Layer", "Motus: Layer"
"""Names of the NLA tracks that a rig has while a layer is edited."""
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
    """A Clip of what the own channels of an evaluated rig's bones are, of those bones and channels that a layer's action animates.

    It stands in for the Clip of the layer that is edited. The whole turns of bones that go around are not kept.
    rows: of the bones. channels: {bone: names of its properties that the action animates}. names, modes: of all bones of the rig.
    """

    asks_curves = True

    def __init__(self, rig, clip, names, modes):
        self._rig, self._clip, self.frames = rig, clip, clip.frames
        self.rows = list(clip.native.bones)
        self.channels = {names[row]: _names(flags, modes[row]) for row, flags in zip(self.rows, clip.native.channels)}
        self._bones = [(rig.pose.bones[name], channels) for name, channels in self.channels.items()]
        curves = [
            (row, clips.FIRST[channel] + index, -1, False)
            for row, channels in zip(self.rows, self.channels.values())
            for channel in channels
            for index in range(clips.SIZES[channel])
        ]
        self.native = clips.native_clip(modes, curves, [])

    def given(self, _frame):
        """Return the present numbers of all channels."""
        return [number for bone, channels in self._bones for channel in channels for number in getattr(bone, channel)]

    def reference(self, frame):
        """Return the pose of the action at a frame, as Clip does."""
        return self._clip.reference(frame)

    def laps(self, _begin, _end, _reference):
        """Rotations go the shorter way."""

    def beneath(self, frame):
        """Return the bones' own matrices beneath the layer at a frame of the scene, (n, 16), column by column."""
        return Beneath(self._rig, self.channels).matrices(frame)


class Beneath:
    """Own transforms of bones of a rig as they are beneath the layer that is edited, at any frame.

    channels: {bone: names of the properties that are not the bone's own at present}; all others are as they stand.
    """

    def __init__(self, rig, channels):
        self.reason, kept = None, kept_channels(rig.motus.layers)
        self._lower = SimpleNamespace(
            id_data=rig,
            use_tweak_mode=False,
            nla_tracks=[track for track in rig.animation_data.nla_tracks if track.name != TWEAKED],
            action=None,
        )
        self._strips = [strip for track in self._lower.nla_tracks if not track.mute for strip in track.strips]
        self._bones = [
            (rig.pose.bones[name], self._values(rig.pose.bones[name], found, kept.get(name, {}))) for name, found in channels.items()
        ]

    def _values(self, bone, names, kept):
        return {
            name: [self._value(bone, name, index, number) for index, number in enumerate(kept.get(name) or getattr(bone, name))]
            for name in names
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
        """Return [(PoseBone, {property: its numbers})] at a frame of the scene."""
        times = np.array([frame], float)
        return [(bone, {name: [_at(one, times) for one in group] for name, group in found.items()}) for bone, found in self._bones]

    def matrices(self, frame):
        """Return the bones' own matrices at a frame of the scene, (n, 16), column by column."""
        made = np.empty((len(self._bones), 16))
        for place, (bone, found) in enumerate(self.numbers(frame)):
            turning = clips.rotation_of(bone.rotation_mode)
            location, turn, scale = (np.array([found.get(name) or list(getattr(bone, name))]) for name in ("location", turning, "scale"))
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
