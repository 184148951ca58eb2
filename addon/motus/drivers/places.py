"""The property that a driver is put on, found by its data path, and what is there already."""

import re
from dataclasses import dataclass
from typing import Any

import bpy

from ..core.blender import datablocks
from ..core.refusals import Refused
from ..core.translations import tr
from . import expressions

_PATH = re.compile(r'(?:(?P<owner>.*)\.)?(?P<name>\w+)$|(?P<holder>.*?)(?P<key>\["(?:[^"\\]|\\.)*"\])$', re.DOTALL)
_INDEX = re.compile(r"\[(\d{1,9})\]$")
_NUMBERS = {'FLOAT', 'INT', 'BOOLEAN'}
BY_PATH, FIRST = 'PATH', 'ROTATION_X'
CHANNELS = [(BY_PATH, "By Path", "The property that the data path names")] + [
    (f"{kind}_{axis}", f"{label} {axis}", f"{label} {where} this axis of the object")
    for kind, label, where in (('LOCATION', "Location", "along"), ('ROTATION', "Rotation", "about"), ('SCALE', "Scale", "along"))
    for axis in "XYZ"]
"""Items: what an object's motion drivers are put on where nothing is under the mouse."""


@dataclass(frozen=True)
class Place:
    """A number. struct: whose property it is. name: of the property, or ["its name"]. index: in an array; -1 in none."""

    struct: Any
    name: str
    index: int

    @property
    def holder(self):
        """The datablock with the driver."""
        return self.struct.id_data

    @property
    def path(self):
        """From the datablock."""
        own = "" if self.struct == self.holder else self.struct.path_from_id()
        return own + self.name if self.name.startswith("[") or not own else f"{own}.{self.name}"

    @property
    def curve(self):
        """The F-curve of the driver that is there; None without one."""
        animation = self.holder.animation_data
        return animation and animation.drivers.find(self.path, index=max(self.index, 0))

    @property
    def value(self):
        """As it stands."""
        return _at(_values(self.struct, self.name), self.index)

    def rest_at(self, number):
        """Give it a value."""
        if self.index >= 0:
            _values(self.struct, self.name)[self.index] = number
        elif self.name.startswith("["):
            self.struct[_key(self.name)] = number
        else:
            setattr(self.struct, self.name, number)

    def evaluated(self, depsgraph):
        """The value as it was evaluated; as it stands where the datablock was not."""
        try:
            return _at(self.holder.evaluated_get(depsgraph).path_resolve(self.path), self.index)
        except (ValueError, TypeError, IndexError, RuntimeError):
            return self.value

    def add(self, expression):
        """Drive it by the expression, in place of what drives it."""
        if self.curve:
            self.remove()
        made = self.struct.driver_add(self.name, self.index)
        while made.modifiers:
            made.modifiers.remove(made.modifiers[0])
        for key in reversed(made.keyframe_points):
            made.keyframe_points.remove(key)
        made.driver.type = 'SCRIPTED'
        made.driver.use_self = "(self" in expression
        made.driver.expression = expression

    def remove(self):
        """Drive it no more."""
        self.struct.driver_remove(self.name, self.index)


def label(found):
    """What the interface calls the property of these Places: one number, or all of an array."""
    first = found[0]
    return datablocks.label_of(first.holder, first.path, first.index if len(found) == 1 else -1)


def of_channel(obj, channel):
    """(data path, index) of one of CHANNELS."""
    kind, axis = channel.split("_")
    if not isinstance(obj, bpy.types.Object):
        raise Refused(tr("Only objects and bones have a transform: give a data path"))
    if kind == 'ROTATION' and obj.rotation_mode in {'QUATERNION', 'AXIS_ANGLE'}:
        raise Refused(tr("{object} is not turned by angles about X, Y and Z: choose another rotation mode").format(
            object=obj.name))
    return ("rotation_euler" if kind == 'ROTATION' else kind.lower()), "XYZ".index(axis)


def free_channel(obj):
    """The first of CHANNELS that has no driver, rotations before the others; FIRST where all have one."""
    for channel in sorted((name for name, *_ in CHANNELS if name != BY_PATH), key=lambda name: not name.startswith('ROTATION')):
        try:
            place, = find(obj, *of_channel(obj, channel))
        except Refused:
            continue  # an object that is not turned by angles
        if place.curve is None:
            return channel
    return FIRST


def _key(name):
    return bpy.utils.unescape_identifier(name[2:-2])


def _values(struct, name):
    return struct[_key(name)] if name.startswith("[") else getattr(struct, name)


def _at(value, index):
    return value[index] if index >= 0 else value


def find(id_data, data_path, index=-1):
    """The Places of a property: one, or of an array one for each component where index is -1. Raises Refused."""
    path = data_path
    found = _INDEX.search(path)
    if found and index < 0:
        path, index = path[:found.start()], int(found[1])
    match = _PATH.match(path)
    if match is None:
        raise Refused(_unknown(id_data, data_path))
    owner = match["owner"] if match["name"] else match["holder"]
    try:
        struct = id_data.path_resolve(owner) if owner else id_data
        value = _values(struct, match["name"] or match["key"])
    except (ValueError, AttributeError, KeyError, TypeError) as error:
        raise Refused(_unknown(id_data, data_path)) from error
    name = match["name"] or match["key"]
    size = _size(struct, name, value)
    if size is None:
        raise Refused(tr("{path} is no number that can be driven").format(path=data_path))
    if index >= max(size, 1):
        raise Refused(tr("{path} has {count} components: index goes from 0 to {last}").format(
            path=data_path, count=max(size, 1), last=max(size, 1) - 1))
    indices = [-1] if size == 0 else range(size) if index < 0 else [index]
    return [Place(struct, name, one) for one in indices]


def _unknown(id_data, data_path):
    return tr("{object} has no property {path}").format(object=id_data.name, path=data_path)


def _size(struct, name, value):
    """How many components a property has, 0 where it is a single number; None where it is none that can be driven."""
    if name.startswith("["):
        if isinstance(value, (int, float)):
            return 0
        return len(value) if getattr(value, "typecode", None) in {"d", "f", "i", "b"} else None
    # Vectors have no properties of Blender's, and among its attributes are methods.
    rna = getattr(struct, "bl_rna", None)
    prop = rna and rna.properties.get(name)
    if prop is None or prop.type not in _NUMBERS or prop.is_readonly or not prop.is_animatable:
        return None
    return prop.array_length if prop.is_array else 0


@dataclass(frozen=True)
class Found:
    """A driver of our functions. path: of the property from the named datablock. index: -1 where it is no array.

    holder: what has the driver, the datablock or a node tree in it.
    """

    datablock: Any
    holder: Any
    path: str
    index: int
    expression: str

    def remove(self):
        """Take the driver away, whether its property is there or not."""
        path = self.path if self.holder == self.datablock else self.path.partition(".")[2]
        drivers = self.holder.animation_data.drivers
        for curve in [curve for curve in drivers if curve.data_path == path and self.index in (-1, curve.array_index)]:
            drivers.remove(curve)

    def places(self):
        """The Places that it drives. Raises Refused where the property is gone, or no number any more."""
        return find(self.datablock, self.path, self.index)


def of_object(obj):
    """The drivers of our functions on an object, its data, its shape keys and its materials."""
    data = obj.data
    holders = obj, data, getattr(data, "shape_keys", None), *(slot.material for slot in obj.material_slots)
    return [one for datablock in dict.fromkeys(holders) if datablock for one in on(datablock)]


def on(datablock):
    """The drivers of our functions on a datablock, and on the node tree in it."""
    yield from _within(datablock, "")
    if getattr(datablock, "node_tree", None):
        yield from _within(datablock, "node_tree")


def _within(datablock, within):
    holder = getattr(datablock, within) if within else datablock
    animation = getattr(holder, "animation_data", None)
    for curve in animation.drivers if animation else ():
        if expressions.names_ours(curve.driver.expression):
            path = f"{within}.{curve.data_path}" if within else curve.data_path
            yield Found(datablock, holder, path, curve.array_index if _is_array(datablock, path) else -1, curve.driver.expression)


def there(datablock):
    """The Places on a datablock, or on the node tree in it, that our functions drive."""
    return [place for one in on(datablock) if not _is_gone(one) for place in one.places()]


def gone(datablock):
    """The drivers of our functions on a datablock, or on the node tree in it, whose property is gone, or no number any more."""
    return [one for one in on(datablock) if _is_gone(one)]


def _is_gone(found):
    try:
        found.places()
    except Refused:
        return True
    return False


def _is_array(datablock, path):
    try:
        return hasattr(datablock.path_resolve(path), "__len__")
    except ValueError:
        return False
