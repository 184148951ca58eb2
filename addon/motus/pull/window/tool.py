"""The tool Pick & Pull in the toolbars of Object Mode, Edit Mode and Sculpt Mode."""

from pathlib import Path

import bpy

from ...core.blender import handlers
from ...core.interface.view import toolbar
from ..panel import draw_accumulate, draw_radius, draw_strength
from . import cursor, hover, inset, keymap, stage

ICON = str(Path(__file__).resolve().parent / "icons" / "pick_pull")

classes = ()


class _Tool:
    bl_space_type = 'VIEW_3D'
    bl_idname = hover.TOOL
    bl_label = "Pick & Pull"
    bl_description = (
        "Pull the surface up with the left mouse button, down with the right one or with Ctrl; Shift smooths.\n"
        "F and Shift F change radius and strength. With the direction Cursor a drag takes the surface along"
    )
    bl_icon = ICON
    bl_cursor = 'CROSSHAIR'
    bl_keymap = None

    @staticmethod
    def draw_settings(context, layout, _tool):
        brush = context.scene.motus.pull
        if context.region.type != 'TOOL_HEADER':
            layout.use_property_split = True
            layout.use_property_decorate = False
        draw_radius(layout, brush)
        draw_strength(layout, brush)
        for name in ("direction", "falloff", "distance"):
            layout.prop(brush, name)
        draw_accumulate(layout, brush)
        row = layout.row(align=True)
        if context.region.type == 'TOOL_HEADER':
            row.label(text="Mirror")
        row.prop(brush, "mirror", expand=True)
        layout.prop(brush, "show_inset")


class ObjectTool(_Tool, bpy.types.WorkSpaceTool):
    bl_context_mode = 'OBJECT'


class EditTool(_Tool, bpy.types.WorkSpaceTool):
    bl_context_mode = 'EDIT_MESH'


class SculptTool(_Tool, bpy.types.WorkSpaceTool):
    bl_context_mode = 'SCULPT'


TOOLS = (ObjectTool, EditTool, SculptTool)


def register():
    """Add the tool to the toolbars, and register its cursor and its handlers."""
    toolbar.register(TOOLS, keymap.TOOL_KEYMAP)
    hover.register()
    cursor.register()


def unregister():
    """Remove the tool from the toolbars, its cursor and its handlers."""
    handlers.take_back(stage.clear, inset.stop, cursor.unregister, hover.unregister)
    toolbar.unregister(TOOLS)
