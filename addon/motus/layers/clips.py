"""Clips: actions on the bones of a rig, in the form in which the native module evaluates them.

An action is read once and cached until its keys are edited.
"""

import math

from ..core import keeping, native
from ..core.blender import actions
from ..core.evaluated import copies, read_keys
from ..core.lazy import numpy as np

LARGEST_CACHE = 64
"""Greatest number of Clips that are cached for one evaluated action: one for each slot and each list of bones with rotation modes."""
_CLIPS = keeping.OfEvaluation(
    "native LayerClips of an evaluated action",
    "slot of the action, names and rotation modes of the rig's bones",
    f"{LARGEST_CACHE} for each evaluated action",
)
MODES = ('QUATERNION', 'XYZ', 'XZY', 'YXZ', 'YZX', 'ZXY', 'ZYX', 'AXIS_ANGLE')
"""Rotation modes of Blender; the index of a mode is its number in the native LayerClip."""
_EULER = 'XYZ'
_FIRST = {"location": 0, "rotation_quaternion": 3, "rotation_euler": 3, "rotation_axis_angle": 3, "scale": 7}
_SIZES = {"location": 3, "rotation_quaternion": 4, "rotation_euler": 3, "rotation_axis_angle": 4, "scale": 3}
_PLAIN = 2
"""Greatest number that foreach_get() gives for the interpolations CONSTANT, LINEAR and BEZIER; greater numbers are easings."""
_NEAR = 0.011  # in frames; Blender does not evaluate the curve between keys that are nearer to each other


class Clip:
    """An action on the bones of a rig, ready for evaluation.

    native: the native LayerClip. frames: (first, last) frame of the action.
    """

    def __init__(self, action, slot, names, modes):
        self.frames = tuple(map(float, action.frame_range))
        self._given, keys, kinds, curves = [], [], [], []
        found = _curves_of_bones(action, slot, names)
        used = [_mode(mode, found.get(name, {})) for name, mode in zip(names, modes)]
        count = 0
        for row, name in enumerate(names):
            for channel, index, curve in _used(found.get(name, {}), used[row]):
                points = _points(curve)
                number = 0 if points is None else len(points[0])
                goes_on = _goes_around(curve) if points is None else curve.extrapolation == 'LINEAR'
                curves.append((row, _FIRST[channel] + index, count, number, goes_on))
                count += number
                if points is None:
                    self._given.append(curve)
                else:
                    keys.append(points[0])
                    kinds.append(points[1])
        self.native = native.module.LayerClip(
            np.array([MODES.index(mode) for mode in used], np.int32),
            np.array(curves, np.int32).reshape(-1, 5),
            np.concatenate(keys) if keys else np.empty((0, 6), np.float32),
            np.concatenate(kinds) if kinds else np.empty(0, np.int32),
        )
        self._kept = {}

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


def _curves_of_bones(action, slot, names):
    """Return {bone name: {channel: {array index: F-curve}}} of the action's F-curves that are not muted. channel: such as "location"."""
    wanted, found = set(names), {}
    for curve in actions.curves_for_object(action, slot, wanted):
        if curve.mute or (curve.group and curve.group.mute):
            continue
        name, channel = actions.bone_of(curve), curve.data_path.rpartition(".")[2]
        if name in wanted and channel in _SIZES and curve.array_index < _SIZES[channel]:
            found.setdefault(name, {}).setdefault(channel, {})[curve.array_index] = curve
    return found


def _mode(own, channels):
    """Return the rotation mode in which an action turns a bone: the bone's own mode if the action animates it or no mode at all.

    If the action animates only a different kind of rotation, its mode is returned. own: the bone's mode. channels: animated channels.
    """
    kinds = {'QUATERNION': "rotation_quaternion", 'AXIS_ANGLE': "rotation_axis_angle"}
    if kinds.get(own, "rotation_euler") in channels:
        return own
    others = [mode for mode, channel in (*kinds.items(), (_EULER, "rotation_euler")) if channel in channels]
    return others[0] if others else own


def _used(channels, mode):
    """Yield (channel, array index, F-curve) of location, scale and the rotation channel that is in effect in a rotation mode."""
    turning = {'QUATERNION': "rotation_quaternion", 'AXIS_ANGLE': "rotation_axis_angle"}.get(mode, "rotation_euler")
    for channel in ("location", turning, "scale"):
        for index, curve in channels.get(channel, {}).items():
            yield channel, index, curve


def _goes_around(curve):
    """Whether the values of an F-curve that Blender evaluates may go beyond half a turn, pi."""
    if curve.extrapolation == 'LINEAR' or any(not one.mute and one.type != 'NOISE' for one in curve.modifiers):
        return True
    return any(abs(point.co.y) > math.pi for point in curve.keyframe_points)


def _points(curve):
    """Return the k keys of an F-curve for the native module; None if only Blender can evaluate the F-curve.

    The keys are two arrays: (k, 6) float32 with the key, its left and its right handle; (k,) int32 with interpolations.
    """
    points, count = curve.keyframe_points, len(curve.keyframe_points)
    if count == 0 or any(not modifier.mute for modifier in curve.modifiers):
        return None
    columns = np.empty((3, 2 * count), np.float32)
    for column, name in zip(columns, ("co", "handle_left", "handle_right")):
        points.foreach_get(name, column)
    kinds = np.empty(count, np.int32)
    points.foreach_get("interpolation", kinds)
    keys = np.concatenate([column.reshape(-1, 2) for column in columns], axis=1)
    is_plain = kinds.max() <= _PLAIN and np.isfinite(keys).all() and (np.diff(keys[:, 0]) > _NEAR).all()
    return (np.ascontiguousarray(keys), kinds) if is_plain else None
