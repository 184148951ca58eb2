"""Lengths, speeds and accelerations in a scene's unit. Blender keeps them in units; the scene says how many metres a unit is."""

from __future__ import annotations

from collections.abc import Container
from typing import Any

import bpy

LENGTHS = {'LENGTH', 'VELOCITY', 'ACCELERATION'}
FACTORY_GRAVITY = 0.0, 0.0, -9.81
"""Of a scene that nobody has given another gravity, whatever its unit is."""


def metres(scene: bpy.types.Scene) -> float:
    """How many metres Blender shows a unit of the scene as."""
    settings = scene.unit_settings
    return 1.0 if settings.system == 'NONE' else settings.scale_length


def in_scene(scene: bpy.types.Scene, prop: Any, value: Any) -> Any:
    """A value that is meant in metres as an RNA property has it in the scene; of a property that is no length the value itself."""
    if getattr(prop, "unit", 'NONE') not in LENGTHS:
        return value
    unit = metres(scene)
    return [part / unit for part in value] if prop.is_array else value / unit


def defaults(scene: bpy.types.Scene, item: Any, names: Container[str]) -> dict[str, Any]:
    """{name: default in the scene's unit} of the properties among `names` that are lengths; {} in a scene of metres. item: settings, or Operator.properties."""
    if metres(scene) == 1.0:
        return {}
    properties = [prop for prop in item.bl_rna.properties if prop.identifier in names and getattr(prop, "unit", 'NONE') in LENGTHS]
    return {prop.identifier: in_scene(scene, prop, prop.default_array if prop.is_array else prop.default) for prop in properties}


def is_gravity_meant(scene: Any) -> bool:
    """Whether the scene's gravity is one that somebody has set, or Blender's own in a scene of metres, for which that is meant."""
    return metres(scene) == 1.0 or any(abs(one - own) > 1e-4 for one, own in zip(scene.gravity, FACTORY_GRAVITY))
