"""What an action says of a rig's bones, as the native module plays it: read once for each state of the action."""

import math

from ..core import keeping, native
from ..core.blender import actions
from ..core.evaluated import copies, read_keys
from ..core.lazy import numpy as np

LARGEST_CACHE = 64
"""Rigs, or states of one, for which an action is kept."""
_CLIPS = keeping.OfEvaluation(
    "native clips of an evaluated action", "slot, names and rotation modes of the rig's bones", f"{LARGEST_CACHE} for each evaluated action"
)
MODES = ('QUATERNION', 'XYZ', 'XZY', 'YXZ', 'YZX', 'ZXY', 'ZYX', 'AXIS_ANGLE')
"""Rotation modes by their numbers in LayerClip."""
_EULER = 'XYZ'
_FIRST = {"location": 0, "rotation_quaternion": 3, "rotation_euler": 3, "rotation_axis_angle": 3, "scale": 7}
_SIZES = {"location": 3, "rotation_quaternion": 4, "rotation_euler": 3, "rotation_axis_angle": 4, "scale": 3}
_PLAIN = 2
"""CONSTANT, LINEAR and BEZIER, as foreach_get has them; what is above are easings."""
_NEAR = 0.011  # frames: of keys that are nearer Blender does not go by the curve between them


class Clip:
    """An action on a rig's bones. native: a LayerClip. frames: the first and last one."""

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
        """Whether there are curves that Blender has to be asked for on each frame."""
        return bool(self._given)

    def given(self, frame):
        """Values at a frame of the F-curves that Blender has to evaluate, because the native module cannot; None if there are none."""
        if not self._given:
            return None
        # An F-curve may give any number where its modifiers have such settings.
        return np.nan_to_num([curve.evaluate(frame) for curve in self._given], posinf=0.0, neginf=0.0)

    def reference(self, frame):
        """LayerClip.pose() at a frame of the action; the last frame's result is cached."""
        return self._found("pose", frame, lambda: self.native.pose(frame, self.given(frame)))

    def laps(self, begin, end, reference):
        """Start values, and their change over one lap, of the rotations that do not return to their start; None if there are none.

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
        """Result of make(), cached under the name `what` until `place` differs."""
        known, found = self._kept.get(what, (None, None))
        if known != place:
            found = make()
            self._kept[what] = place, found
        return found


def clip_of(action, slot, names, modes):
    """The Clip of an evaluated action; kept until its keys are edited. modes: rotation modes of the bones."""
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
    """{bone: {channel: {index: F-curve}}} of what is not muted."""
    wanted, found = set(names), {}
    for curve in actions.curves_for_object(action, slot, wanted):
        if curve.mute or (curve.group and curve.group.mute):
            continue
        name, channel = actions.bone_of(curve), curve.data_path.rpartition(".")[2]
        if name in wanted and channel in _SIZES and curve.array_index < _SIZES[channel]:
            found.setdefault(name, {}).setdefault(channel, {})[curve.array_index] = curve
    return found


def _mode(own, channels):
    """Rotation mode in which the action turns a bone: the bone's own, if the action has keys for it."""
    kinds = {'QUATERNION': "rotation_quaternion", 'AXIS_ANGLE': "rotation_axis_angle"}
    if kinds.get(own, "rotation_euler") in channels:
        return own
    others = [mode for mode, channel in (*kinds.items(), (_EULER, "rotation_euler")) if channel in channels]
    return others[0] if others else own


def _used(channels, mode):
    """(channel, index, F-curve) of the channels that count in a rotation mode."""
    turning = {'QUATERNION': "rotation_quaternion", 'AXIS_ANGLE': "rotation_axis_angle"}.get(mode, "rotation_euler")
    for channel in ("location", turning, "scale"):
        for index, curve in channels.get(channel, {}).items():
            yield channel, index, curve


def _goes_around(curve):
    """Whether the values of a curve that Blender has to be asked for go beyond half a turn."""
    if curve.extrapolation == 'LINEAR' or any(not one.mute and one.type != 'NOISE' for one in curve.modifiers):
        return True
    return any(abs(point.co.y) > math.pi for point in curve.keyframe_points)


def _points(curve):
    """((k, 6) float32, (k,) int32) of keys that the native module can follow; None where Blender has to be asked."""
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
