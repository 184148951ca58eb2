"""Removal of a system's settings from objects, so that the file holds nothing of a system that was removed."""

from __future__ import annotations

from typing import Any

import bpy

from ..blender import capabilities
from .registry import of_owner


def forget(system: Any, owner: Any) -> None:
    """Remove a system's settings from an object, and Object.motus altogether if no other settings differ from the defaults.

    A library override is marked (is_released), since Blender gives it the library's settings again when the file is loaded.
    """
    drop_dead_copy(owner)
    owner.motus.property_unset(system.name)
    reference = owner.override_library and owner.override_library.reference
    if reference and reference.is_property_set("motus") and _is_set(reference.motus, system.name):
        # When the file is loaded, settings that are unset come from the library again, but Blender keeps a setting that is set.
        of_owner(system, owner).is_released = True
    if not says_anything(owner.motus):
        owner.property_unset("motus")


def drop_dead_copy(owner: Any) -> None:
    """Remove the custom property "motus", which Blender 5 makes of the settings if it opens a file of an older Blender.

    Nothing reads the copy, and its pointers would keep removed objects in the file.
    """
    if capabilities.keeps_settings_apart():
        owner.pop("motus", None)


def says_anything(settings: Any) -> bool:
    """Whether any setting in a property group, or in a group within it, differs from its default."""
    names = set(settings.bl_rna.properties.keys()) - {"rna_type"}
    return any(_is_set(settings, name) for name in names)


def _is_set(settings: Any, name: str) -> bool:
    prop = settings.bl_rna.properties[name]
    # A computed property (SKIP_SAVE) always counts as set. Reading a group that does not exist would create it.
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
