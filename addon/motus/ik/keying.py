"""Key transform channels: find the channels' values for a transform, and write keys fast into a range of frames."""

import math

import bpy
from mathutils import Euler, Quaternion, Vector

from ..core.bake.sampling import rotation_path
from ..core.blender import actions
from ..core.blender.datablocks import Named
from ..core.blender.frames import assign
from ..core.lazy import numpy as np
from .curve_cut import SAME_FRAME, around, beside, cut, hold

_KEY = (
    "co",
    "handle_left",
    "handle_right",
    "handle_left_type",
    "handle_right_type",
    "interpolation",
    "easing",
    "back",
    "amplitude",
    "period",
    "type",
)


def rotation_values(thing, rotation, last):
    """Convert a quaternion to values of the rotation channel of an Object or PoseBone `thing`, in its rotation mode.

    Of the values that give this rotation, it returns those near to the values `last`, so that keys do not jump.
    """
    if thing.rotation_mode == 'QUATERNION':
        return -rotation if rotation.dot(Quaternion(last)) < 0.0 else rotation
    if thing.rotation_mode == 'AXIS_ANGLE':
        # Quaternion.to_axis_angle() uses an arc cosine, which is off by up to 5e-4 rad for small angles.
        axis = Vector((rotation.x, rotation.y, rotation.z))
        angle = 2.0 * math.atan2(axis.length, rotation.w)
        axis = axis.normalized() if axis.length > 0.0 else Vector(last[1:])
        if axis.dot(Vector(last[1:])) < 0.0:
            axis, angle = -axis, -angle
        return (angle + math.tau * round((last[0] - angle) / math.tau), *axis)  # type: ignore[misc]
    return rotation.to_euler(thing.rotation_mode, Euler(last, thing.rotation_mode))


class Channels:
    """Values of transform channels of an Object or PoseBone, collected frame by frame.

    channels: some of "location", "rotation", "scale". values: {name of the property: list of a tuple for each frame}.
    """

    def __init__(self, thing, channels):
        self._named = Named.of(thing)
        paths = {"location": "location", "rotation": rotation_path(thing), "scale": "scale"}
        self.values = {paths[channel]: [] for channel in channels}
        self._last = None

    @property
    def thing(self):
        """The Object or PoseBone whose channels these are. Raises ReferenceError if it was removed."""
        return self._named.thing

    def add(self, basis):
        """Append the channels' values at one more frame. basis: Matrix of the transform relative to the parents, like matrix_basis."""
        location, rotation, scale = basis.decompose()
        if isinstance(self.thing, bpy.types.Object):
            location, rotation, scale = _without_deltas(self.thing, location, rotation, scale)
        for path, rows in self.values.items():
            if path == "location":
                rows.append(tuple(location))
            elif path == "scale":
                rows.append(tuple(scale))
            else:
                # At the first frame, the values stay near to the channel's present values.
                last = getattr(self.thing, path) if self._last is None else self._last
                self._last = tuple(rotation_values(self.thing, rotation, tuple(last)))
                rows.append(self._last)


def _without_deltas(obj, location, rotation, scale):
    """Location, rotation and scale for an object's own channels, with which its delta transform gives these values."""
    if obj.rotation_mode == 'QUATERNION':
        rotation = obj.delta_rotation_quaternion.normalized().inverted() @ rotation
    elif obj.rotation_mode != 'AXIS_ANGLE':
        rotation = obj.delta_rotation_euler.to_quaternion().inverted() @ rotation
    scale = [value / delta if delta else own for value, delta, own in zip(scale, obj.delta_scale, obj.scale)]
    return location - obj.delta_location, rotation, scale


class KeyWriter:
    """Writes keys into ranges of F-curves, keeps the keys outside of them, and can restore what was there before.

    written: set of (datablock, data path) that have new keys.
    """

    def __init__(self):
        self._before = {}
        self._done = []
        self.written = set()

    def write(self, holder, name, frames, rows, interpolation='BEZIER', group="", instead_of=""):
        """Key the property `name` of an Object, PoseBone or PropertyGroup `holder` at rising frames.

        Keys from the first to the last frame are replaced. Keys next to that range keep their automatic handles as they are.
        rows: a number or a sequence of numbers for each frame. group: name of the F-curves' group. instead_of: a different data
        path by which the property may be keyed already; if it is, the new keys use this path.
        """
        owner = holder.id_data
        path = instead_of if instead_of and actions.find(owner, instead_of) else holder.path_from_id(name)
        self._remember(owner)
        self.written.add((owner, path))
        value = getattr(holder, name)
        is_array = not isinstance(value, (bool, int, float))
        self._done.append((owner, holder.path_from_id(name), tuple(value) if is_array else value, None))
        for index, column in enumerate(zip(*rows) if is_array else [rows]):
            curve = actions.find(owner, path, index)
            is_new = curve is None
            if is_new:
                # keyframe_insert() makes the action, slot and F-curve as the running version of Blender needs them.
                holder.keyframe_insert(name, index=index if is_array else -1, frame=frames[0], group=group or "Motus")
                curve = actions.find(owner, path, index)
            self._done.append((owner, path, index, (None, frames) if is_new else _hold_beside(curve, frames)))
            _replace(curve, frames, column, interpolation)

    def cut(self, owner, path, frame):
        """Insert a key into the F-curve of a numeric property without changing the curve; returns the key. owner: the datablock."""
        self._remember(owner)
        curve = actions.find(owner, path)
        self.written.add((owner, path))
        frames = sorted([frame, *(points[0].co.x for points in around(curve, frame) if points)])
        self._done.append((owner, path, 0, (_keys(_between(curve, frames)), frames)))
        return cut(curve, frame)

    def set(self, holder, name, value):
        """Set a property that is not animated, so that take_back() can restore its value."""
        self._done.append((holder.id_data, holder.path_from_id(name), getattr(holder, name), None))
        setattr(holder, name, value)

    def take_back(self):
        """Restore all keys and values as they were before the first call of write(), cut() or set()."""
        self.written.clear()
        for owner, path, index, written in reversed(self._done):
            if written is None:
                assign(owner, path, index)
                continue
            curve = actions.find(owner, path, index)
            kept, frames = written
            if kept is None:
                actions.fcurves(owner).remove(curve)
            else:
                _put_back(curve, frames, kept)
        for owner, (had_animation, action, slot) in self._before.items():
            own = owner.animation_data.action if owner.animation_data else None
            if own != action:
                actions.assign(owner, action, slot)
                bpy.data.actions.remove(own)
            if not had_animation:
                owner.animation_data_clear()

    def _remember(self, owner):
        """Note the action of a datablock before it is keyed, and give the datablock a copy of the action if the action is linked."""
        if owner in self._before:
            return
        animation = owner.animation_data
        action = animation.action if animation else None
        self._before[owner] = animation is not None, action, actions.slot_identifier(owner)
        actions.make_local(owner)


def _hold_beside(curve, frames):
    """Free the automatic handles of the keys next to a range of frames, so that new keys in the range do not move them.

    Returns (keys that change, as _keys() gives them before the change; their frames in rising order).
    """
    held = beside(curve, frames[0], frames[-1])
    touched = sorted([frames[0], frames[-1], *(point.co.x for point in held)])
    kept = _keys(_between(curve, touched))
    for point in held:
        hold(point)
    return kept, touched


def _between(curve, frames):
    first, last = frames[0] - SAME_FRAME, frames[-1] + SAME_FRAME
    return [point for point in curve.keyframe_points if first <= point.co.x <= last]


def _keys(points):
    """Copies of keyframes, as {attribute: value} for each, from which _put_back() makes the keyframes again."""
    return [
        {
            name: value if isinstance(value, (str, float)) else tuple(value)
            for name, value in ((name, getattr(point, name)) for name in _KEY)
        }
        for point in points
    ]


def _clear(curve, frames):
    points = curve.keyframe_points
    first, last = frames[0] - SAME_FRAME, frames[-1] + SAME_FRAME
    for index in range(len(points) - 1, -1, -1):
        if first <= points[index].co.x <= last:
            points.remove(points[index], fast=True)


def _replace(curve, frames, values, interpolation):
    _clear(curve, frames)
    points = curve.keyframe_points
    before = len(points)
    points.add(len(frames))
    places = np.empty(2 * len(points), np.float32)
    points.foreach_get("co", places)
    places[2 * before :: 2], places[2 * before + 1 :: 2] = frames, values
    points.foreach_set("co", places)
    for point in points[before:]:
        point.interpolation = interpolation
        point.handle_left_type = point.handle_right_type = 'AUTO_CLAMPED'
    curve.update()


def _put_back(curve, frames, keys):
    _clear(curve, frames)
    points = curve.keyframe_points
    before = len(points)
    points.add(len(keys))
    for point, key in zip(points[before:], keys):
        for name in ("handle_left_type", "handle_right_type", *_KEY):  # setting one handle may move its opposite
            setattr(point, name, key[name])
    curve.update()
