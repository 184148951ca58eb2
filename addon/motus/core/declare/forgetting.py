"""Settings are taken off objects, so that the file holds nothing of a system that is gone."""

from __future__ import annotations

from typing import Any

import bpy

from ..blender import capabilities
from .registry import of_owner


def forget(system: Any, owner: Any) -> None:
    """Take a system's settings off an object; with the last that say anything all of Motus, so that the file holds nothing."""
    drop_dead_copy(owner)
    owner.motus.property_unset(system.name)
    reference = owner.override_library and owner.override_library.reference
    if reference and reference.is_property_set("motus") and _is_set(reference.motus, system.name):
        # What is unset is the library's again when the file is loaded; what is set Blender saves.
        of_owner(system, owner).is_released = True
    if not says_anything(owner.motus):
        owner.property_unset("motus")


def drop_dead_copy(owner: Any) -> None:
    """Remove what Blender 5 has made of the settings in a file of an older version, which keeps alive what they pointed to."""
    if capabilities.keeps_settings_apart():
        owner.pop("motus", None)


def says_anything(settings: Any) -> bool:
    """Whether a group of settings, or a group within it, differs from what an object without settings has."""
    names = set(settings.bl_rna.properties.keys()) - {"rna_type"}
    return any(_is_set(settings, name) for name in names)


def _is_set(settings: Any, name: str) -> bool:
    prop = settings.bl_rna.properties[name]
    # One that is computed (SKIP_SAVE) is set always. To ask for the value of a group that is not there would make one.
    if prop.is_skip_save or not settings.is_property_set(name):
        return False
    value = getattr(settings, name)
    if isinstance(value, bpy.types.PropertyGroup):
        return says_anything(value)
    if prop.type in {'POINTER', 'COLLECTION'}:
        return bool(value)
    if getattr(prop, "is_array", False):
        return tuple(value) != tuple(prop.default_array)
    return value != (prop.default_flag if prop.type == 'ENUM' and prop.is_enum_flag else prop.default)
