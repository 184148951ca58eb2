"""Which page of the manual tells of which setting."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from ..declare import page, registered, title
from . import overlay
from .view import preferences

GENERAL = "operators"
"""Name of the page that tells of the settings of no system: the switch of all overlays, and the add-on's preferences."""


class Table(NamedTuple):
    """The settings of one struct that one page of the manual tells of.

    page: name of the page. struct: name of the class. title, translation_context: what the interface calls the settings, in English.
    settings: RNA properties.
    """

    page: str
    struct: str
    title: str
    translation_context: str
    settings: list[Any]


def tables() -> Iterator[Table]:
    """The Tables of all settings that the interface shows, those of each feature one after another."""
    scene = overlay.MOTUS_PG_scene.bl_rna
    switches: set[str] = set()
    for feature in registered.values():
        seen: set[str] = set()
        for kind in filter(None, (feature.settings, feature.scene_settings)):
            yield from _of_group(page(feature), kind.bl_rna, *title(feature), seen)
        own = overlay.properties_of(feature).keys()
        if own:
            yield Table(page(feature), scene.identifier, "Overlay", "*", [scene.properties[name] for name in own])
        switches.update(own)
    yield Table(GENERAL, scene.identifier, "Overlay", "*", [prop for prop in _shown(scene) if prop.identifier not in switches])
    rna = preferences.MOTUS_AP_preferences.bl_rna
    yield Table(GENERAL, rna.identifier, "Motus", "*", _shown(rna))


def _of_group(page: str, rna: Any, name: str, context: str, seen: set[str]) -> Iterator[Table]:
    """The Table of a property group, then those of the groups in its lists. seen: groups that have had their Table."""
    if rna.identifier in seen:
        return
    seen.add(rna.identifier)
    settings = _shown(rna)
    if settings:
        yield Table(page, rna.identifier, name, context, settings)
    for prop in rna.properties:
        if _is_group(prop) and not prop.is_hidden:
            yield from _of_group(page, prop.fixed_type, prop.name, prop.translation_context, seen)


def _shown(rna: Any) -> list[Any]:
    """The properties of a struct that the user can right-click: neither hidden ones nor lists, nor the index of a list's active item."""
    return [prop for prop in rna.properties if prop.is_runtime and prop.description and not (prop.is_hidden or _is_group(prop))]


def _is_group(prop: Any) -> bool:
    """Whether a property of Motus is a property group or a list of such groups."""
    return prop.is_runtime and prop.type in {'POINTER', 'COLLECTION'} and getattr(prop.fixed_type.base, "identifier", "") == 'PropertyGroup'
