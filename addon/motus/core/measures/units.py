"""Convert lengths, speeds and accelerations between metres and the scene's unit.

Blender stores lengths in units. The scene's Unit Scale says how many metres a unit is.
"""

from __future__ import annotations

import math
from collections.abc import Container
from dataclasses import dataclass
from typing import Any

import bpy

LENGTHS = {'LENGTH', 'VELOCITY', 'ACCELERATION'}
FOOT = 0.3048  # metres
FACTORY_GRAVITY = 0.0, 0.0, -9.81
"""Gravity that Blender gives every new scene, whatever the scene's unit is."""


def metres(scene: bpy.types.Scene) -> float:
    """How many metres one unit of the scene is: the Unit Scale, or 1 if the unit system is None."""
    settings = scene.unit_settings
    return 1.0 if settings.system == 'NONE' else settings.scale_length


def in_scene(scene: bpy.types.Scene, prop: Any, value: Any) -> Any:
    """Convert a length, speed or acceleration from metres to the scene's unit. Values of different kinds are returned unchanged.

    prop: RNA property that the value is for; its unit tells the kind of value. value: a number, or a sequence for an array property.
    """
    if getattr(prop, "unit", 'NONE') not in LENGTHS:
        return value
    unit = metres(scene)
    return [part / unit for part in value] if prop.is_array else value / unit


def defaults(scene: bpy.types.Scene, item: Any, names: Container[str]) -> dict[str, Any]:
    """Defaults of the lengths, speeds and accelerations among `names`, converted from metres to the scene's unit.

    item: settings or Operator.properties, which have the properties. Returns {name: default}; {} if the unit is a metre.
    """
    if metres(scene) == 1.0:
        return {}
    properties = [prop for prop in item.bl_rna.properties if prop.identifier in names and getattr(prop, "unit", 'NONE') in LENGTHS]
    return {prop.identifier: in_scene(scene, prop, prop.default_array if prop.is_array else prop.default) for prop in properties}


def is_gravity_meant(scene: Any) -> bool:
    """Whether the scene's gravity fits the scene's unit: the unit is a metre, or the user has changed gravity from Blender's default."""
    return metres(scene) == 1.0 or any(abs(one - own) > 1e-4 for one, own in zip(scene.gravity, FACTORY_GRAVITY))


@dataclass(frozen=True)
class Shown:
    """How Blender's interface shows values of a unit. factor: of a shown number to the value. sign: text behind the number."""

    factor: float = 1.0
    sign: str = ""

    def text(self, number: float) -> str:
        """A number, which is a value times the factor, as text with its unit."""
        return f"{number + 0.0:.6g}{self.sign}"


def shown(scene: bpy.types.Scene, unit: str) -> Shown:
    """How the interface shows values of a property. unit: of the property, as Blender names it, such as 'ROTATION'."""
    settings = scene.unit_settings
    if unit == 'ROTATION' and settings.system_rotation == 'DEGREES':
        return Shown(math.degrees(1.0), "°")
    if unit == 'LENGTH' and settings.system == 'METRIC':
        return Shown(settings.scale_length, " m")
    if unit == 'LENGTH' and settings.system == 'IMPERIAL':
        return Shown(settings.scale_length / FOOT, "'")
    return Shown()
