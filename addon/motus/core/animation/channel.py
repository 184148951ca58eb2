"""Channel: one number property of a datablock over time, with what animates it and its values at any frames."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy

from ..file import choices
from ..lazy import numpy as np
from ..refusals import Refused
from ..translations import tr
from . import keys, strips
from .reason import Reason

if TYPE_CHECKING:
    Array = np.ndarray[Any, Any]

_CUSTOM = re.compile(r'\["(?:[^"\\]|\\.)*"\]$')
TRUE = 1.0 - 2.0**-23
"""Blender sets an animated boolean to True if the F-curve's value is greater than this."""


class Number(NamedTuple):
    """A number property of a datablock, or one element of an array property, with its type and limits.

    holder: the datablock or group that has the property. name: the property's name in the holder; a custom property's name has its
    brackets. index: of the array's element; -1 if the property is no array. type: 'FLOAT', 'INT', 'BOOLEAN' or 'ENUM'.
    least, most: limits that Blender applies to values. subtype: of RNA, such as 'QUATERNION'. default: value in the NLA if no strip sets
    the property.
    """

    holder: Any
    name: str
    index: int  # type: ignore[assignment]  # NamedTuple: tuple.index is a method
    type: str
    least: float
    most: float
    subtype: str
    default: float

    @property
    def present(self) -> float:
        """Present value of the property; of an enum property, the integer of its chosen item."""
        if self.type == 'ENUM':
            return float(choices.number(self.holder, self.name))
        value = self.holder[_key(self.name)] if self.name.startswith("[") else getattr(self.holder, self.name)
        return float(value if self.index < 0 else value[self.index])

    def write(self, value: Any) -> None:
        """Set the property, or the array's element at `index`, to a value."""
        is_custom = self.name.startswith("[")
        if self.index >= 0:
            (self.holder[_key(self.name)] if is_custom else getattr(self.holder, self.name))[self.index] = value
        elif is_custom:
            self.holder[_key(self.name)] = value
        else:
            setattr(self.holder, self.name, value)

    def rounded(self, values: Array) -> Array:
        """Values of an F-curve as Blender writes them into the property: rounded for integers, 0 or 1 for booleans, within the limits."""
        if self.type == 'BOOLEAN':
            return (values > TRUE).astype(float)
        if self.type in {'INT', 'ENUM'}:
            values = np.trunc(values)
        return np.clip(values, self.least, self.most)


class Channel:
    """Value of a number property of a datablock at any time, read from its keys and NLA strips.

    reason: the Reason why the value at other frames cannot be computed; None if it can. values() and bounds() need reason to be None.
    is_beneath_driver: ignore the driver of the property, and read the animation below the driver.
    """

    def __init__(self, id_data: Any, data_path: str, index: int, is_beneath_driver: bool = False) -> None:
        self._id, self._path = id_data, data_path
        self._curve = self._stack = self.reason = None
        self.number = number(id_data, data_path, index)
        animation = id_data.animation_data
        if animation is None:
            return
        place = max(index, 0)
        if not is_beneath_driver and is_driven(id_data, data_path, place):
            self.reason = Reason(Reason.DRIVEN, thing=id_data.name, path=data_path)
        elif is_in_strips(id_data, data_path, place):
            found = strips.Stack.of(animation, data_path, self.number, acting_curve(id_data, data_path, place))
            if isinstance(found, Reason):
                self.reason = found
            else:
                self._stack = found
        else:
            self._curve = acting_curve(id_data, data_path, place)

    @property
    def is_constant(self) -> bool:
        """Whether nothing animates the property: neither an F-curve, NLA strips nor a driver."""
        return self._curve is None and self._stack is None and self.reason is None

    def values(self, times: Array) -> Array:
        """Values (n,), float64, of the property at times, (n,) frames of the scene."""
        if self._stack is not None:
            return self.number.rounded(self._stack.values(times))
        if self._curve is not None:
            return self.number.rounded(keys.values(self._curve, times))
        return np.full(len(times), self.number.present)

    def bounds(self, first: float, last: float) -> list[float]:
        """Rising frames from first to last, between which the value changes smoothly; at most about keys.MOST."""
        if self._stack is not None:
            return self._stack.bounds(first, last)
        return keys.bounds(self._curve, first, last) if self._curve is not None else [first, last]

    def integral(self, first: float, last: float) -> float:
        """Integral of the value of a float property over the frames from first to last, in frames times the unit of the value."""
        if self.is_constant:
            return self.number.present * (last - first)
        if self._curve is not None:
            return keys.integral(self._curve, first, last)
        return keys.over_pieces(self.values, self.bounds(first, last))

    @property
    def extent(self) -> tuple[float, float] | None:
        """(first, last) frame between which the property's value changes, infinite if it goes on changing; None if it is constant.

        Infinite for NLA strips, for an F-curve that is extrapolated without end, and for F-curve modifiers.
        """
        if self._stack is not None:
            return -np.inf, np.inf
        return keys.extent(self._curve) if self._curve is not None else None

    @property
    def stamp(self) -> Any:
        """Hashable value that changes whenever values() of an evaluated datablock may change.

        None for an original datablock, or if edits cannot be detected.
        """
        if not self._id.is_evaluated:
            return None
        if self._stack is not None:
            return strips.together((self._path, self.number.index, self._stack.stamp))
        if self._curve is not None:
            return strips.together((self._path, self.number.index, strips.stamp_of_action(self._id.animation_data)))
        return self.number.present


def number(id_data: Any, data_path: str, index: int = -1) -> Number:
    """The Number (a number property, or one element of an array property) at a data path. Raises Refused if the datablock has none there.

    index: index of an array's element; -1 for a property that is no array.
    """
    try:
        holder, name = _holder(id_data, data_path)
        if holder.id_data != id_data:  # the path leads to a different datablock, which has its own animation
            raise TypeError
        found = (_custom if name.startswith("[") else _declared)(holder, name, index)
        _ = found.present  # raises if the property does not exist
    except (AttributeError, KeyError, IndexError, TypeError, ValueError):
        raise Refused(tr("{object} has no number {path}").format(object=id_data.name, path=data_path)) from None
    return found


def acting_curve(id_data: Any, data_path: str, index: int = 0) -> Any:
    """The F-curve of the active action that animates a number property; None if there is none. `id_data` may be evaluated."""
    return strips.acting(strips.read(id_data.animation_data), data_path, index)


def is_driven(id_data: Any, data_path: str, index: int = 0) -> bool:
    """Whether an unmuted driver sets a number property of a datablock. index: of an array's element, 0 for a property that is no array."""
    animation = id_data.animation_data
    driver = animation and animation.drivers.find(data_path, index=index)
    return driver is not None and not driver.mute


def is_in_strips(id_data: Any, data_path: str, index: int = 0) -> bool:
    """Whether a property's value depends on NLA strips, so that the F-curve of the active action alone does not give it.

    An active action that animates the property hides all strips if it replaces them at influence 1 and extrapolation Hold.
    """
    animation = id_data.animation_data
    if animation is None or not animation.use_nla:
        return False
    played = [strip for track in animation.nla_tracks if not track.mute for strip in track.strips]
    if not played:
        return False
    if acting_curve(id_data, data_path, index):
        return (
            animation.use_tweak_mode
            or animation.action_blend_type != 'REPLACE'
            or animation.action_influence != 1.0
            or animation.action_extrapolation != 'HOLD'
        )
    return any(strips.animates(strip, data_path, index) for strip in played)


def _holder(id_data: Any, data_path: str) -> tuple[Any, str]:
    """(datablock or group that holds the property at a data path, the property's name there). A custom property's name has its brackets."""
    custom = _CUSTOM.search(data_path)
    path, _, name = data_path.rpartition(".")
    if custom:
        path, name = data_path[: custom.start()], custom[0]
    return (id_data.path_resolve(path) if path else id_data), name


def _key(name: str) -> str:
    return bpy.utils.unescape_identifier(name[2:-2])


def _declared(holder: Any, name: str, index: int) -> Number:
    declared = holder.bl_rna.properties[name]
    if declared.type == 'ENUM' and not declared.is_enum_flag:
        return Number(holder, name, -1, 'ENUM', -np.inf, np.inf, 'NONE', 0.0)
    is_array = getattr(declared, "is_array", False)
    if declared.type not in {'FLOAT', 'INT', 'BOOLEAN'} or is_array != (index >= 0):
        raise TypeError
    least, most = (0.0, 1.0) if declared.type == 'BOOLEAN' else (declared.hard_min, declared.hard_max)
    if isinstance(holder, bpy.types.ShapeKey) and name == "value":
        least, most = holder.slider_min, holder.slider_max
    default = declared.default_array[index] if is_array else declared.default
    # Only arrays of four: Blender prints a warning if a script reads some subtypes that are units, which arrays of four do not have.
    subtype = declared.subtype if is_array and len(declared.default_array) == 4 else 'NONE'
    if subtype == 'QUATERNION':
        default = float(index == 0)
    return Number(holder, name, index, declared.type, least, most, subtype, float(default))


def _custom(holder: Any, name: str, index: int) -> Number:
    value = holder[_key(name)]
    if (index >= 0) != hasattr(value, "__len__"):
        raise TypeError
    one = value if index < 0 else value[index]
    kind = {bool: 'BOOLEAN', int: 'INT', float: 'FLOAT'}[type(one)]
    limits = holder.id_properties_ui(_key(name)).as_dict()
    default = limits.get("default", 0.0)
    if hasattr(default, "__len__"):  # an array without a default gives an empty one (Blender 3.4)
        default = default[index] if len(default) else 0.0
    return Number(
        holder, name, index, kind, limits.get("min", -np.inf), limits.get("max", np.inf), limits.get("subtype", 'NONE'), float(default)
    )
