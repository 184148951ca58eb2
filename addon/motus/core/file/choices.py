"""Enumerations of settings: what is chosen, if the file names an item that there is."""

from __future__ import annotations

from typing import Any


def chosen(settings: Any, name: str) -> str:
    """The item that an enumeration of settings says; its default if a script or another version has written one that there is not.

    Blender reads such an item as an empty text.
    """
    return getattr(settings, name) or settings.bl_rna.properties[name].default


def number(settings: Any, name: str) -> int:
    """Integer value of the chosen item of an enumeration property, as F-curves and drivers use it."""
    return settings.bl_rna.properties[name].enum_items[chosen(settings, name)].value
