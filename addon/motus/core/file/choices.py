"""Chosen items of enumeration properties in settings, also if the file names an item that does not exist."""

from __future__ import annotations

from typing import Any


def chosen(settings: Any, name: str) -> str:
    """Identifier of the chosen item of an enumeration property; the default if the stored item does not exist.

    A script or a different version of Motus may have written such an item; Blender reads it as an empty text.
    """
    return getattr(settings, name) or settings.bl_rna.properties[name].default


def number(settings: Any, name: str) -> int:
    """Integer value of the chosen item of an enumeration property, as F-curves and drivers use it."""
    return settings.bl_rna.properties[name].enum_items[chosen(settings, name)].value
