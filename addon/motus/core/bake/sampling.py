"""Sample the evaluated transforms of driven objects and bones frame by frame, as values of their transform properties."""

import math

import bpy
from mathutils import Euler, Matrix, Quaternion, Vector

from ..blender.datablocks import Named
from ..measures.handedness import scale_is_mirrored

ROTATION_PATHS = {'QUATERNION': "rotation_quaternion", 'AXIS_ANGLE': "rotation_axis_angle"}


class Track:
    """Samples of the baked transform channels of one Object or PoseBone, one for each frame.

    channels: which of "location", "rotation" and "scale" are sampled. values: {name of a transform property: its samples}.
    """

    def __init__(self, thing, channels):
        self._named = Named.of(thing)
        self.channels = channels
        self.values = {path: [] for path in _paths(thing, channels)}
        self._last_rotation = None

    @property
    def thing(self):
        return self._named.thing

    @property
    def id_data(self):
        return self._named.object

    def data_path(self, name):
        """Data path of a transform property from the object, or for a bone from its rig. name: of the property, such as "location"."""
        if isinstance(self.thing, bpy.types.PoseBone):
            return f"{self.thing.path_from_id()}.{name}"
        return name

    def record(self, depsgraph):
        """Append samples that reproduce the thing's evaluated transform at the depsgraph's present frame."""
        self.record_basis(basis(self.thing, self.id_data.evaluated_get(depsgraph)))

    def record_basis(self, matrix):
        """Append samples that reproduce a transform. matrix: of the Object or PoseBone relative to its parent."""
        deltas = _deltas(self.thing)
        signs = _signs(self.thing, deltas, matrix)
        if "location" in self.channels:
            self.values["location"].append(matrix.translation - deltas.location)
        if "rotation" in self.channels:
            columns = [axis.normalized() * sign for axis, sign in zip(matrix.to_3x3().col, signs)]
            rotation = deltas.rotation.inverted() @ Matrix(columns).transposed().to_quaternion()
            path = rotation_path(self.thing)
            self._last_rotation = _rotation(self.thing, rotation, self._last_rotation)
            self.values[path].append(self._last_rotation)
        if "scale" in self.channels:
            lengths = [axis.length * sign for axis, sign in zip(matrix.to_3x3().col, signs)]
            self.values["scale"].append(
                [
                    length / delta if delta else factor  # if the delta scale is 0 any value would do
                    for length, delta, factor in zip(lengths, deltas.scale, self.thing.scale)
                ]
            )

    def curves(self):
        """Yield (data path, index, samples) for each F-curve that the track needs."""
        for name, rows in self.values.items():
            for index, column in enumerate(zip(*rows)):
                yield self.data_path(name), index, column

    @property
    def group(self):
        """Name of the channel group for the track's F-curves: the bone's name, or "Object Transforms" for an object."""
        return self.thing.name if isinstance(self.thing, bpy.types.PoseBone) else "Object Transforms"


class NumberTrack:
    """Samples of one property that a system drives, one for each frame; it has the interface of a Track.

    read(obj): returns the Place (id_data, data_path, number) of the property on an original or evaluated object. `values` is empty, since
    no transform channels are sampled.
    """

    values = {}
    group = "Properties"

    def __init__(self, obj, read):
        self.thing, self._read = obj, read
        found = read(obj)
        self.id_data, self._path, self.number, self._rows = found.id_data, found.data_path, found.number, []

    def record(self, depsgraph):
        """Append the property's evaluated value at the depsgraph's present frame to the samples."""
        self._rows.append(self._read(self.thing.evaluated_get(depsgraph)).number.present)

    def curves(self):
        """Yield (data path, index, samples) for the property's F-curve."""
        yield self._path, max(self.number.index, 0), self._rows

    @property
    def own(self):
        """(data path, index, value without the system's result) of the property, for unbaking; index -1 stands for a single number."""
        return self._path, self.number.index, self.number.present


class _Deltas:
    """The delta transform that Blender applies on top of an object's transform properties; the identity for a bone."""

    location = Vector((0.0, 0.0, 0.0))
    rotation = Quaternion()
    scale = Vector((1.0, 1.0, 1.0))


def _deltas(thing):
    deltas = _Deltas()
    if isinstance(thing, bpy.types.Object):
        deltas.location = thing.delta_location
        deltas.scale = thing.delta_scale
        if thing.rotation_mode == 'QUATERNION':
            deltas.rotation = thing.delta_rotation_quaternion.normalized()
        elif thing.rotation_mode != 'AXIS_ANGLE':
            deltas.rotation = thing.delta_rotation_euler.to_quaternion()
    return deltas


def _signs(thing, deltas, matrix):
    """Signs (x, y, z) for the scale that is decomposed from a matrix: those of the thing's own scale if they fit the matrix.

    They fit if their product has the sign of the matrix's determinant. If they do not fit, all three are -1 for a matrix that mirrors,
    otherwise 1. thing: an Object or PoseBone. deltas: its delta transform.
    """
    signs = [math.copysign(1.0, factor * delta) for factor, delta in zip(thing.scale, deltas.scale)]
    if scale_is_mirrored(signs) != matrix.is_negative:
        return [-1.0 if matrix.is_negative else 1.0] * 3
    return signs


def rotation_path(thing):
    """Name of the property that holds the rotation of an Object or PoseBone in its rotation mode, such as "rotation_quaternion"."""
    return ROTATION_PATHS.get(thing.rotation_mode, "rotation_euler")


def _paths(thing, channels):
    names = {"location": "location", "rotation": rotation_path(thing), "scale": "scale"}
    return [path for channel, path in names.items() if channel in channels]


def basis(thing, evaluated):
    """Evaluated matrix of an Object or PoseBone relative to its parent: the transform that its baked channels have to produce.

    thing: the original. evaluated: the evaluated object; for a PoseBone its evaluated rig.
    """
    if isinstance(thing, bpy.types.PoseBone):
        bone = evaluated.pose.bones[thing.name]
        return evaluated.convert_space(pose_bone=bone, matrix=bone.matrix, from_space='POSE', to_space='LOCAL')
    if evaluated.parent is None:
        return evaluated.matrix_world
    return evaluated.matrix_parent_inverse.inverted_safe() @ evaluated.matrix_local


def _rotation(thing, rotation, last):
    """Convert a rotation quaternion to a value of a thing's rotation property, as close as possible to the sample before it.

    thing: an Object or PoseBone, whose rotation mode decides the property. last: the sample before, None at the first frame.
    """
    if thing.rotation_mode == 'QUATERNION':
        return -rotation if last is not None and rotation.dot(last) < 0.0 else rotation
    if thing.rotation_mode == 'AXIS_ANGLE':
        return _axis_angle(rotation, last or tuple(thing.rotation_axis_angle))
    return rotation.to_euler(thing.rotation_mode, last or Euler(thing.rotation_euler, thing.rotation_mode))


def _axis_angle(rotation, last):
    axis, angle = rotation.to_axis_angle()
    if axis.dot(Vector(last[1:])) < 0.0:
        axis, angle = -axis, -angle
    return (angle + math.tau * round((last[0] - angle) / math.tau), *axis)
