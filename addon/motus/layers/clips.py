"""Clips: actions on the bones of a rig, in the form in which the native module evaluates them.

An action is read once and cached until its keys are edited.
"""

import math

from mathutils import Euler, Quaternion

from ..core import keeping, native
from ..core.animation import native_keys
from ..core.blender import actions
from ..core.evaluated import copies, read_keys
from ..core.lazy import numpy as np
from ..core.tracks.rotations import MODES

LARGEST_CACHE = 64
"""Greatest number of Clips that are cached for one evaluated action: one for each slot and each list of bones with rotation modes."""
_CLIPS = keeping.OfEvaluation(
    "native LayerClips of an evaluated action",
    "slot of the action, names and rotation modes of the rig's bones",
    f"{LARGEST_CACHE} for each evaluated action",
)
_EULER = 'XYZ'
FIRST = {"location": 0, "rotation_quaternion": 3, "rotation_euler": 3, "rotation_axis_angle": 3, "scale": 7}
SIZES = {"location": 3, "rotation_quaternion": 4, "rotation_euler": 3, "rotation_axis_angle": 4, "scale": 3}


def at_rest(channel):
    """Return the numbers of a channel at rest. channel: "location", "scale", or the name of a rotation's property."""
    if channel == "scale":
        return (1.0, 1.0, 1.0)
    return {"rotation_quaternion": (1.0, 0.0, 0.0, 0.0), "rotation_axis_angle": (0.0, 0.0, 1.0, 0.0)}.get(channel, (0.0, 0.0, 0.0))


class Clip:
    """An action on the bones of a rig, ready for evaluation.

    native: the native LayerClip. frames: (first, last) frame of the action. count: how many bones the rig has.
    """

    def __init__(self, action, slot, names, modes):
        self.frames = tuple(map(float, action.frame_range))
        self._given, curves, players = [], [], []
        found = curves_of_bones(action, slot, names)
        used = [mode_of(mode, found.get(name, {})) for name, mode in zip(names, modes)]
        for row, name in enumerate(names):
            for channel, index, curve in _used(found.get(name, {}), used[row]):
                player = native_keys.player(curve)
                is_given = player is None
                goes_around = (is_given or not player.is_plain) and _goes_around(curve)
                curves.append((row, FIRST[channel] + index, -1 if is_given else len(players), goes_around))
                (self._given if is_given else players).append(curve if is_given else player)
        self.native = native_clip(used, curves, players)
        self._kept, self.count = {}, len(names)

    @property
    def asks_curves(self):
        """Whether the action has F-curves that Blender has to evaluate at each frame."""
        return bool(self._given)

    def given(self, frame):
        """Return the values at a frame of the F-curves that only Blender can evaluate, not the native module; None if there are none."""
        if not self._given:
            return None
        # Modifiers of an F-curve can make any number, even infinity.
        return np.nan_to_num([curve.evaluate(frame) for curve in self._given], posinf=0.0, neginf=0.0)

    def reference(self, frame):
        """Return LayerClip.pose() at a frame of the action; the last frame's result is cached."""
        return self._found("pose", frame, lambda: self.native.pose(frame, self.given(frame)))

    def laps(self, begin, end, reference):
        """Return start values, and their change in one repetition, of rotations that do not return to their start; None if there are none.

        begin, end: frames of the played part, in playing order. reference: frame of the reference pose; None if that pose is not taken
        from the action.
        """
        if not self.native.spins:
            return None
        start = begin if reference is None else reference
        return self._found(
            "laps", (begin, end, start), lambda: np.hstack((self._numbers(start), self._numbers(end) - self._numbers(begin)))
        )

    def _numbers(self, frame):
        return self.native.numbers(frame, self.given(frame))

    def _found(self, what, place, make):
        """Return the result of make(), which is cached under the name `what` until `place` differs."""
        known, found = self._kept.get(what, (None, None))
        if known != place:
            found = make()
            self._kept[what] = place, found
        return found


def native_clip(modes, curves, players):
    """Return a native LayerClip. modes: rotation modes of all bones. curves, players: its arguments `curves` and `fcurves`."""
    return native.module.LayerClip(
        np.array([MODES.index(mode) for mode in modes], np.int32), np.array(curves, np.int32).reshape(-1, 4), players
    )


class Told:
    """A Clip that says every channel of some bones: what a Clip says of them, and the rest pose of all others.

    bones: rows of the bones that it says something of besides those of the Clip.
    """

    asks_curves = True

    def __init__(self, clip, bones):
        self._clip, self.frames = clip, clip.frames
        self._bones = sorted({*clip.native.bones, *bones})
        modes = ['QUATERNION'] * clip.count
        self.native = native_clip(modes, [(bone, channel, -1, False) for bone in self._bones for channel in range(len(REST))], [])

    def given(self, frame):
        """Return the numbers of all channels at a frame."""
        return pose_of(self._clip, self._bones, frame).ravel()

    def laps(self, _begin, _end, _reference):
        """Rotations go the shorter way."""


REST = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0)
"""Location, quaternion and scale at rest."""


def pose_of(clip, bones, frame):
    """Return location, quaternion and scale of bones, (n, 10), as a Clip says them at a frame; at rest what it does not say. bones: rows."""
    places = {bone: place for place, bone in enumerate(clip.native.bones)}
    pose = clip.reference(frame)
    return np.array([pose[places[bone]] if bone in places else REST for bone in bones]).reshape(-1, len(REST))


def numbers_of(row, mode, near=None):
    """Return the numbers of location, rotation and scale of a row of pose_of(), with the rotation in a mode.

    near: numbers of a rotation in this mode; Euler angles and quaternions near to these are chosen.
    """
    turn = Quaternion(row[3:7])
    if mode == 'QUATERNION':
        is_far = near is not None and turn.dot(Quaternion(near)) < 0.0
        turned = [-part for part in turn] if is_far else turn[:]
    elif mode == 'AXIS_ANGLE':
        turned = [turn.angle, *turn.axis[:]]
    else:
        turned = (turn.to_euler(mode) if near is None else turn.to_euler(mode, Euler(near, mode)))[:]
    return row[:3], turned, row[7:]


def clip_of(action, slot, names, modes):
    """Return the Clip of an evaluated action; it is cached until the action's keys are edited.

    slot: identifier of the action slot. names, modes: names and rotation modes of the rig's bones.
    """
    if read_keys.is_noting():
        read_keys.number_of(action)
    kept, place = _CLIPS.within(copies.found_of_action(action)), (slot, names, modes)
    found = kept.get(place)
    if found is None:
        if len(kept) >= LARGEST_CACHE:
            kept.clear()
        found = kept[place] = Clip(action, slot, names, modes)
    return found


def curves_of_bones(action, slot, names):
    """Return {bone name: {channel: {array index: F-curve}}} of the action's F-curves that are not muted. channel: such as "location"."""
    wanted, found = set(names), {}
    for curve in actions.curves_for_object(action, slot, wanted):
        if curve.mute or (curve.group and curve.group.mute):
            continue
        name, channel = actions.bone_of(curve), curve.data_path.rpartition(".")[2]
        if name in wanted and channel in SIZES and curve.array_index < SIZES[channel]:
            found.setdefault(name, {}).setdefault(channel, {})[curve.array_index] = curve
    return found


def mode_of(own, channels):
    """Return the rotation mode in which an action turns a bone: the bone's own mode if the action animates it or no mode at all.

    If the action animates only a different kind of rotation, its mode is returned. own: the bone's mode. channels: animated channels.
    """
    kinds = {'QUATERNION': "rotation_quaternion", 'AXIS_ANGLE': "rotation_axis_angle"}
    if kinds.get(own, "rotation_euler") in channels:
        return own
    others = [mode for mode, channel in (*kinds.items(), (_EULER, "rotation_euler")) if channel in channels]
    return others[0] if others else own


def rotation_of(mode):
    """Return the name of the property that turns a bone in a rotation mode."""
    return {'QUATERNION': "rotation_quaternion", 'AXIS_ANGLE': "rotation_axis_angle"}.get(mode, "rotation_euler")


def _used(channels, mode):
    """Yield (channel, array index, F-curve) of location, scale and the rotation channel that is in effect in a rotation mode."""
    for channel in ("location", rotation_of(mode), "scale"):
        for index, curve in channels.get(channel, {}).items():
            yield channel, index, curve


def _goes_around(curve):
    """Whether the values of an F-curve that is more than its keys may go beyond half a turn, pi."""
    if curve.extrapolation == 'LINEAR' or any(not one.mute and one.type != 'NOISE' for one in curve.modifiers):
        return True
    return any(abs(point.co.y) > math.pi for point in curve.keyframe_points)
