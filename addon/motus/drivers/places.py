"""Find a property by its data path, its driver, and all motion drivers (drivers that call Motus functions) on a datablock."""

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
    for axis in "XYZ"
]
"""Enum items: transform channels of an object, one of which an operator drives if no property is under the mouse."""


@dataclass(frozen=True)
class Place:
    """A number of Blender that can be driven: a property, or one component of an array property.

    struct: owner of the property. name: name of the property, or ["name"] for a custom property. index: index in an array; -1 if the
    property is no array.
    """

    struct: Any
    name: str
    index: int

    @property
    def holder(self):
        """The datablock that holds the property, and so its driver."""
        return self.struct.id_data

    @property
    def path(self):
        """Data path of the property, relative to its datablock."""
        own = "" if self.struct == self.holder else self.struct.path_from_id()
        return own + self.name if self.name.startswith("[") or not own else f"{own}.{self.name}"

    @property
    def curve(self):
        """Driver F-curve of the property; None if the property has no driver."""
        animation = self.holder.animation_data
        return animation and animation.drivers.find(self.path, index=max(self.index, 0))

    @property
    def unit(self):
        """Unit of the property, as Blender names it, such as 'ROTATION'; 'NONE' for a custom property."""
        return getattr(self.struct.bl_rna.properties.get(self.name), "unit", 'NONE')

    @property
    def value(self):
        """Present value of the property, or of the component of an array."""
        return _at(_values(self.struct, self.name), self.index)

    @property
    def is_moved(self):
        """Whether a motion driver drives the property."""
        return self.curve is not None and expressions.names_ours(self.curve.driver.expression)

    @property
    def base(self):
        """Value that a motion is added to: the base of the motion driver that the property has, otherwise the present value."""
        known = self.curve and expressions.read(self.curve.driver.expression)
        return known.get("base", 0.0) if known else float(self.value)

    def rest_at(self, number):
        """Assign a value to the property, or to the component of an array."""
        if self.index >= 0:
            _values(self.struct, self.name)[self.index] = number
        elif self.name.startswith("["):
            self.struct[_key(self.name)] = number
        else:
            setattr(self.struct, self.name, number)

    def evaluated(self, depsgraph):
        """Value of the property on the evaluated copy of its datablock; the original value if there is no evaluated copy."""
        try:
            return _at(self.holder.evaluated_get(depsgraph).path_resolve(self.path), self.index)
        except (ValueError, TypeError, IndexError, RuntimeError):
            return self.value

    def add(self, expression):
        """Add a driver with this expression to the property, in place of the driver that it has. Raises Refused if it cannot be driven."""
        if self.curve:
            self.remove()
        try:
            made = self.struct.driver_add(self.name, self.index)
        except TypeError as error:
            raise Refused(str(error)) from error
        while made.modifiers:
            made.modifiers.remove(made.modifiers[0])
        for key in reversed(made.keyframe_points):
            made.keyframe_points.remove(key)
        self.set_expression(expression)

    def set_expression(self, expression):
        """Change the expression of the driver of the property."""
        driver = self.curve.driver
        driver.type = 'SCRIPTED'
        driver.use_self = "(self" in expression
        driver.expression = expression

    def remove(self):
        """Remove the driver of the property."""
        self.struct.driver_remove(self.name, self.index)


def label(found):
    """Label of a property in the interface. found: its Places, either one number or all components of an array."""
    first = found[0]
    return datablocks.label_of(first.holder, first.path, first.index if len(found) == 1 else -1)


def of_channel(obj, channel):
    """Return (data path, index) of the transform channel of an object that an item of CHANNELS names.

    Raises Refused if `obj` is no object, or if the channel is an Euler rotation that the object does not use.
    """
    kind, axis = channel.split("_")
    if not isinstance(obj, bpy.types.Object):
        raise Refused(tr("Only objects and bones have a transform: give a data path"))
    if kind == 'ROTATION' and obj.rotation_mode in {'QUATERNION', 'AXIS_ANGLE'}:
        raise Refused(tr("{object} is not turned by angles about X, Y and Z: choose another rotation mode").format(object=obj.name))
    return ("rotation_euler" if kind == 'ROTATION' else kind.lower()), "XYZ".index(axis)


def free_channel(obj):
    """Identifier of a transform channel of the object that has no driver, such as 'ROTATION_X'; rotations come first.

    If all channels have drivers, the result is FIRST.
    """
    for channel in sorted((name for name, *_ in CHANNELS if name != BY_PATH), key=lambda name: not name.startswith('ROTATION')):
        try:
            (place,) = find(obj, *of_channel(obj, channel))
        except Refused:
            continue  # quaternion and axis-angle rotations have no such channels
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
    """Return the Places of a property: one number; with index -1 one Place for each component of an array.

    The data path may end with an array index. Raises Refused if the property does not exist or is no number.
    """
    path = data_path
    found = _INDEX.search(path)
    if found and index < 0:
        path, index = path[: found.start()], int(found[1])
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
        raise Refused(
            tr("{path} has {count} components: index goes from 0 to {last}").format(
                path=data_path, count=max(size, 1), last=max(size, 1) - 1
            )
        )
    indices = [-1] if size == 0 else range(size) if index < 0 else [index]
    return [Place(struct, name, one) for one in indices]


def _unknown(id_data, data_path):
    return tr("{object} has no property {path}").format(object=id_data.name, path=data_path)


def _size(struct, name, value):
    """Number of components of an array property; 0 for a single number; None if the property cannot be driven."""
    if name.startswith("["):
        if isinstance(value, (int, float)):
            return 0
        return len(value) if getattr(value, "typecode", None) in {"d", "f", "i", "b"} else None
    # Vectors have no RNA properties, and methods are among their attributes.
    rna = getattr(struct, "bl_rna", None)
    prop = rna and rna.properties.get(name)
    if prop is None or prop.type not in _NUMBERS or prop.is_readonly or not prop.is_animatable:
        return None
    return prop.array_length if prop.is_array else 0


@dataclass(frozen=True)
class Found:
    """A driver whose expression calls a Motus function.

    datablock: datablock on which the driver was searched. holder: the datablock, or its node tree, that has the driver.
    path: data path of the driven property, relative to `datablock`. index: component of an array, or -1.
    """

    datablock: Any
    holder: Any
    path: str
    index: int
    expression: str

    def remove(self):
        """Remove the driver, even if the driven property no longer exists."""
        path = self.path if self.holder == self.datablock else self.path.partition(".")[2]
        drivers = self.holder.animation_data.drivers
        for curve in [curve for curve in drivers if curve.data_path == path and self.index in (-1, curve.array_index)]:
            drivers.remove(curve)

    def places(self):
        """Return the driven numbers as Places. Raises Refused if the property no longer exists or is no longer a number."""
        return find(self.datablock, self.path, self.index)


def holders(obj):
    """{role: datablock} of an object, its data, its shape keys and its materials; the same role means the same on different objects."""
    found = {"object": obj, "data": obj.data, "shape keys": getattr(obj.data, "shape_keys", None)}
    found |= {f"material {index}": slot.material for index, slot in enumerate(obj.material_slots)}
    return {role: datablock for role, datablock in found.items() if datablock}


def of_object(obj):
    """Return the motion drivers (Found) on an object, its data, its shape keys and its materials."""
    return [one for datablock in dict.fromkeys(holders(obj).values()) for one in on(datablock)]


def on(datablock):
    """Yield the motion drivers (Found) on a datablock and on its node tree."""
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
    """Return the Places that motion drivers on a datablock or its node tree drive, leaving out properties that no longer exist."""
    return [place for one in on(datablock) if not _is_gone(one) for place in one.places()]


def gone(datablock):
    """Return the motion drivers (Found) on a datablock or its node tree whose property no longer exists or is no longer a number."""
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
