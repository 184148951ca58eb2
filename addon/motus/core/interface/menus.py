"""The Motus submenus of Blender's Add, Object and Pose menus, grouped by system. F3 search finds operators that are in a menu."""

from typing import Any

import bpy

from . import panels
from .view import offering

_entries: dict[str, tuple[Any, ...]] = {"add": (), "object": (), "pose": ()}


class MOTUS_MT_add(bpy.types.Menu):
    bl_label = "Motus"

    def draw(self, _context):
        _draw(self.layout, "add")


class MOTUS_MT_object(bpy.types.Menu):
    bl_label = "Motus"

    def draw(self, _context):
        _draw(self.layout, "object")


class MOTUS_MT_pose(bpy.types.Menu):
    bl_label = "Motus"

    def draw(self, _context):
        _draw(self.layout, "pose")


def _draw(layout, kind):
    layout = offering.offer(layout)
    layout.operator_context = 'INVOKE_DEFAULT'
    for index, ((label, label_context), identifiers) in enumerate(_entries[kind]):
        if index:
            layout.separator()
        if label:
            layout.label(text=label, text_ctxt=label_context)
        for identifier in identifiers:
            if identifier is None:
                layout.separator()
            elif "." in identifier:
                layout.operator(identifier)
            else:
                layout.menu(identifier)


def _draw_add(menu, _context):
    menu.layout.separator()
    menu.layout.menu(MOTUS_MT_add.__name__, icon='CON_FOLLOWPATH')


def _draw_object(menu, _context):
    menu.layout.separator()
    menu.layout.menu(MOTUS_MT_object.__name__, icon='CON_FOLLOWPATH')


def _draw_pose(menu, _context):
    menu.layout.separator()
    menu.layout.menu(MOTUS_MT_pose.__name__, icon='CON_FOLLOWPATH')


classes = (MOTUS_MT_add, MOTUS_MT_object, MOTUS_MT_pose)
_WITHOUT_LABEL = "", "*"
_OF_ALL = ("motus.bake", "motus.unbake")


def register(systems, extra_add=()):
    """Add the Motus submenus to Blender's Add, Object and Pose menus.

    A submenu has the operators of each system below the system's label, and at the end the operators that work for all systems. None in a
    system's operators draws a separator. extra_add: operators, or names of menus, at the end of the Add menu.
    """
    for kind, shared in (("add", tuple(extra_add)), ("object", _OF_ALL), ("pose", _OF_ALL)):
        groups = [(panels.title(one), getattr(one, f"{kind}_menu")) for one in systems]
        _entries[kind] = (*((title, names) for title, names in groups if names), (_WITHOUT_LABEL, shared))
    bpy.types.VIEW3D_MT_add.append(_draw_add)
    bpy.types.VIEW3D_MT_object.append(_draw_object)
    bpy.types.VIEW3D_MT_pose.append(_draw_pose)


def entries(kind):
    """Identifiers of all operators in one of the Motus menus. kind: "add", "object" or "pose"."""
    return [name for _, names in _entries[kind] for name in names if name and "." in name]


def unregister():
    """Remove the Motus submenus from Blender's menus."""
    bpy.types.VIEW3D_MT_pose.remove(_draw_pose)
    bpy.types.VIEW3D_MT_object.remove(_draw_object)
    bpy.types.VIEW3D_MT_add.remove(_draw_add)
