"""Digest: a hash, as a short text, of what a recording was made from. A recording is outdated if the digest has changed.

The digest covers keys, drivers, constraints, parents, the settings of Motus's systems, and property values that nothing animates.
It covers these for the recorded datablock and for all datablocks that they refer to. It does not cover geometry, simulations and
the effects of scripts.
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
"""Most datablocks that one digest covers."""
DEEPEST = 4
"""Most levels of property groups within each other that a digest covers."""

_INDEXED = re.compile(r"^(.*?)(?:\[(\d+)\])?$", re.DOTALL)
_NUMBERS = {'BOOLEAN', 'INT', 'FLOAT', 'STRING', 'ENUM'}
_OF_EDITORS = {"rna_type", "name", "select", "active", "show_expanded", "wired"}
"""Names of properties that have no effect on motion: a digest leaves them out."""
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
    """Digest of an original datablock, as hexadecimal text."""
    found = _Digest()
    found.want(id_data)
    return found.text()


class _Digest:
    """Computes a digest: hashes one datablock after the next, and collects the datablocks that each refers to."""

    def __init__(self):
        self._hash = hashlib.blake2b(digest_size=16)
        self._seen, self._waiting = set(), []
        self._animated = ()

    def want(self, id_data):
        """Let the digest cover a datablock, unless the digest already covers MOST datablocks. None is ignored."""
        if id_data is not None and id_data not in self._seen and len(self._seen) < MOST:
            self._seen.add(id_data)
            self._waiting.append(id_data)

    def text(self):
        """Hash all datablocks given to want(), and the datablocks that they refer to; returns the digest as hexadecimal text."""
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
        if id_data.is_property_set("motus"):  # reading an unset pointer property would create it in the file
            for system in systems():
                settings = getattr(id_data.motus, system.name)
                if settings.is_active:
                    self._settings(settings)

    def _animation(self, id_data):
        """Hash the keys, NLA strips and drivers of a datablock; returns the data paths (no array indices) of its F-curves and drivers."""
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
        """Hash the properties of a group of settings, and let the digest cover the datablocks that the group points to.

        Hashed are numbers, texts and enums that can be edited and that nothing animates, and those in groups within the group, up to
        DEEPEST levels.
        """
        try:
            path = f"{group.path_from_id()}."
        except ValueError:  # a group without a data path cannot be animated
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
    """Number that a target of a driver variable reads by its data path; None if that is no number, or something animates it.

    The result is also None for a property that cannot be animated.
    """
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
    """Value of a property as plain Python data: an array as nested tuples, a set as a sorted list, a number or text unchanged."""
    if isinstance(value, (str, int, float, set)):
        return sorted(value) if isinstance(value, set) else value
    return tuple(map(_plain, value))
