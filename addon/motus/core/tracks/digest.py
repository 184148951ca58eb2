"""What a recording was made from, as far as that is known, as a short text that changes with it.

Known are keys, drivers, constraints, parents, the settings of Motus's systems, and the values that nothing animates; of the
thing itself and of all that these lead to. Not known are geometry, simulations and what scripts do.
"""

import hashlib
import re

import bpy

from ..animation import channel
from ..blender import actions
from ..declare import systems
from ..lazy import numpy as np
from ..refusals import Refused

MOST = 256
"""Datablocks that are looked at."""
DEEPEST = 4
"""Groups of settings within each other."""

_INDEXED = re.compile(r"^(.*?)(?:\[(\d+)\])?$", re.DOTALL)
_NUMBERS = {'BOOLEAN', 'INT', 'FLOAT', 'STRING', 'ENUM'}
_OF_EDITORS = {"rna_type", "name", "select", "active", "show_expanded", "wired"}
"""Properties that move nothing."""
_KEYS = (("co", 2), ("handle_left", 2), ("handle_right", 2), ("back", 1), ("amplitude", 1), ("period", 1))
_KINDS = "interpolation", "easing"
_TRANSFORM = ("location", "rotation_mode", "rotation_euler", "rotation_quaternion", "rotation_axis_angle", "scale")
_OBJECT = _TRANSFORM + (
    "delta_location",
    "delta_rotation_euler",
    "delta_rotation_quaternion",
    "delta_scale",
    "matrix_parent_inverse",
    "parent_type",
    "parent_bone",
)


def of(id_data):
    """The digest of an original datablock."""
    found = _Digest()
    found.want(id_data)
    return found.text()


class _Digest:
    """Goes from datablock to datablock."""

    def __init__(self):
        self._hash = hashlib.blake2b(digest_size=16)
        self._seen, self._waiting = set(), []
        self._animated = ()

    def want(self, id_data):
        """Add a datablock to those that the digest covers, unless the digest already covers MOST datablocks."""
        if id_data is not None and id_data not in self._seen and len(self._seen) < MOST:
            self._seen.add(id_data)
            self._waiting.append(id_data)

    def text(self):
        """The digest of all that is wanted, and of what that leads to."""
        while self._waiting:
            self._look(self._waiting.pop(0))
        return self._hash.hexdigest()

    def _note(self, *values):
        self._hash.update(repr(values).encode())

    def _look(self, id_data):
        self._note(type(id_data).__name__)
        self._animated = self._animation(id_data)
        if not isinstance(id_data, bpy.types.Object):
            return
        self._values(id_data, "", _OBJECT)
        self.want(id_data.parent)
        self._constraints(id_data)
        for bone in id_data.pose.bones if id_data.pose else ():
            self._values(bone, f"{bone.path_from_id()}.", _TRANSFORM)
            self._note(bone.name, bone.parent and bone.parent.name, tuple(bone.bone.matrix_local.to_translation()))
            self._constraints(bone)
        if id_data.is_property_set("motus"):  # to ask for what is not there would make it
            for system in systems():
                settings = getattr(id_data.motus, system.name)
                if settings.is_active:
                    self._settings(settings)

    def _animation(self, id_data):
        """Notes keys and drivers; returns the beginnings of data paths that they set."""
        data = getattr(id_data, "animation_data", None)
        if data is None:
            return ()
        paths = set()
        for player in actions.players(id_data):
            for curve in actions.curves_of(player):
                paths.add(curve.data_path)
                self._curve(curve)
        for track in data.nla_tracks:
            for strip in track.strips:
                self._settings(strip)
        for curve in data.drivers:
            paths.add(curve.data_path)
            self._note(curve.data_path, curve.array_index, curve.mute, curve.driver.type, curve.driver.expression)
            for variable in curve.driver.variables:
                for target in variable.targets:
                    self._note(variable.type, target.data_path, target.bone_target, _still(target))
                    self.want(target.id)
        return tuple(paths)

    def _curve(self, curve):
        points = curve.keyframe_points
        self._note(curve.data_path, curve.array_index, curve.mute, curve.extrapolation, len(points))
        for name, width in _KEYS:
            room = np.empty(width * len(points), np.float32)
            points.foreach_get(name, room)
            self._hash.update(room.tobytes())
        for name in _KINDS:
            room = np.empty(len(points), np.int32)
            points.foreach_get(name, room)
            self._hash.update(room.tobytes())
        for modifier in curve.modifiers:
            self._settings(modifier)

    def _constraints(self, thing):
        for constraint in thing.constraints:
            self._settings(constraint)
            for target in getattr(constraint, "targets", ()):
                self._note(target.subtarget)
                self.want(target.target)

    def _values(self, holder, path, names):
        for name in names:
            if path + name not in self._animated:
                value = getattr(holder, name)
                self._note(name, _plain(value))

    def _settings(self, group, depth=0):
        """Notes all plain properties of a group that nothing animates, and looks at the datablocks that it points to."""
        try:
            path = f"{group.path_from_id()}."
        except ValueError:  # what has no path cannot be animated
            path = ""
        for prop in group.bl_rna.properties:
            name = prop.identifier
            if (path and path + name in self._animated) or name in _OF_EDITORS:
                continue
            if prop.type in _NUMBERS:
                if not prop.is_readonly:
                    self._note(name, _plain(getattr(group, name)))
            elif prop.type == 'POINTER':
                self._pointer(getattr(group, name), depth)
            elif prop.type == 'COLLECTION' and depth < DEEPEST:
                for item in getattr(group, name):
                    if isinstance(item, bpy.types.PropertyGroup):
                        self._settings(item, depth + 1)

    def _pointer(self, value, depth):
        if isinstance(value, bpy.types.ID):
            self.want(value)
        elif isinstance(value, bpy.types.PropertyGroup) and depth < DEEPEST:
            self._settings(value, depth + 1)


def _still(target):
    """The number that a driver's variable reads, where nothing animates it; else None."""
    path, index = _INDEXED.match(target.data_path).groups()
    if target.id is None or not path:
        return None
    try:
        read = channel.Channel(target.id, path, -1 if index is None else int(index))
    except Refused:
        return None
    declared = read.number.holder.bl_rna.properties.get(read.number.name)
    return read.number.present if read.is_constant and (declared is None or declared.is_animatable) else None


def _plain(value):
    """Convert an array property to nested tuples and a set to a sorted list; a number or text is returned unchanged."""
    if isinstance(value, (str, int, float, set)):
        return sorted(value) if isinstance(value, set) else value
    return tuple(map(_plain, value))
