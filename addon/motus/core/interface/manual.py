"""The manual: which of its pages tells of which setting, and how Blender's *Online Manual* and the panels' help buttons open it.

A place is the end of an address: the page, and behind # what is told there, such as path.html#motus_pg_path.duration, all in lower case.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import bpy

from ..declare import page, registered, title
from ..refusals import Refused
from ..translations import tr
from . import overlay
from .view import preferences, widths

SITE = ""
"""Address of the manual's site, with / at its end. If it is empty, the pages in the add-on's folder are opened."""
START, GENERAL = "index", "operators"
"""Names of the first page, and of the page that tells of what is no system's: operators, the overlay's switch, the add-on's preferences."""
PAGES = Path(__file__).parents[2] / "manual"
"""Folder of the pages that come with the add-on, in a folder for each language."""


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


def address(place: str) -> str:
    """The address to open for a place: of the site, or of a page that leads to the add-on's own one. Raises Refused if there is neither.

    The place is in Spanish if that is the language of Blender's interface and there is such a page.
    """
    spanish = PAGES / "es" / place.partition("#")[0]
    is_spanish = _is_spanish() and spanish.exists()
    if SITE:
        return f"{SITE}{'es/' if is_spanish else ''}{place}"
    found = spanish if is_spanish else PAGES / "en" / spanish.name
    if not found.exists():
        raise Refused(tr("This copy of Motus has no manual: its pages are in the zips that Motus is installed from"))
    target = f"{found.as_uri()}#{place.partition('#')[2]}".removesuffix("#")
    return _written(f'<meta http-equiv="refresh" content="0; url={target}"><a href="{target}">{found.name}</a>')


def _is_spanish() -> bool:
    return bpy.app.translations.locale.startswith("es")


def _written(content: str) -> str:
    """The address of a page with this content, in Blender's temporary folder.

    What opens a file by its address drops what stands behind #, on Windows, macOS and with xdg-open. A browser does not, once it shows a
    page that leads there.
    """
    path = Path(bpy.app.tempdir, "motus_manual.html")
    path.write_text(
        f'<!DOCTYPE html><meta charset="utf-8"><meta name="color-scheme" content="light dark"><title>Motus</title>{content}\n',
        encoding="utf-8",
    )
    return path.as_uri()


class MOTUS_OT_manual(bpy.types.Operator):
    bl_idname = "motus.manual"
    bl_label = "Open Manual"
    bl_description = "Show in a browser what the manual says about this panel"
    bl_options = {'INTERNAL'}

    page: bpy.props.StringProperty()

    def execute(self, _context):
        try:
            found = address(f"{self.page}.html")
        except Refused as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        return bpy.ops.wm.url_open(url=found)


def draw_button(panel: bpy.types.Panel, layout: Any, name: str, beside: int = 0) -> None:
    """Draw a button that opens a page in the header of a panel, if there is room for it. name: of the page. beside: how many buttons there are."""
    if widths.title_fits(bpy.app.translations.pgettext_iface(panel.bl_label, panel.bl_translation_context), beside + 1):
        layout.operator(MOTUS_OT_manual.bl_idname, text="", icon='HELP', emboss=False).page = name


class _Beginning:
    """Beginning of all addresses, to which Blender adds the place that it has found in the manual map."""

    def __add__(self, place: str) -> str:
        try:
            return address(place)
        except Refused as refusal:
            return _written(f"<p>{refusal}</p>")


def manual_map() -> tuple[_Beginning, list[tuple[str, str]]]:
    """What Blender's *Online Manual* asks for: the beginning of all addresses, and (pattern of what was clicked, place), the first counts."""
    settings, structs = {}, {}
    for table in tables():
        struct = table.struct.lower()
        structs[f"bpy.types.{struct}.*"] = f"{table.page}.html#{struct}"  # what has no row in the table, such as the lines of a list
        for name in (f"{struct}.{setting.identifier}" for setting in table.settings):
            settings[f"bpy.types.{name}"] = f"{table.page}.html#{name}"
    operators = {f"bpy.ops.motus.{name}": f"{GENERAL}.html#motus.{name}" for name in dir(bpy.ops.motus)}
    return _Beginning(), list((settings | structs | operators).items())


def register() -> None:
    """Tell Blender where the manual tells of Motus."""
    bpy.utils.register_manual_map(manual_map)


def unregister() -> None:
    """Take the manual map back."""
    bpy.utils.unregister_manual_map(manual_map)


classes = (MOTUS_OT_manual,)
