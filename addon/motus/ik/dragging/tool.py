"""Tool *Drag Chain* in the toolbar of Pose Mode, with which chains are dragged one after the other."""

from pathlib import Path

import bpy

from ...core.interface.view import toolbar
from .operators import MOTUS_OT_ik_drag

PRESS = {"type": 'LEFTMOUSE', "value": 'PRESS'}
KEYMAP = (
    ("view3d.select", {**PRESS, "shift": True}, {"properties": [("toggle", True)]}),
    # For a press beside all bones, which the drag passes on. Blender tries the key-map items of add-ons from the last to the first.
    ("view3d.select", PRESS, {"properties": [("deselect_all", True)]}),
    (MOTUS_OT_ik_drag.bl_idname, PRESS, None),
)


class DragChainTool(bpy.types.WorkSpaceTool):
    bl_space_type = 'VIEW_3D'
    bl_context_mode = 'POSE'
    bl_idname = MOTUS_OT_ik_drag.bl_idname
    bl_label = "Drag Chain"
    bl_description = (
        "Take hold of a bone at any point with the left mouse button; the chain follows the mouse.\n"
        "X, Y and Z hold it to an axis; a click selects the bone"
    )
    bl_icon = str(Path(__file__).resolve().parent / "icons" / "drag_chain")
    bl_cursor = 'HAND'
    bl_keymap = None

    @staticmethod
    def draw_settings(context, layout, tool):
        if context.region.type != 'TOOL_HEADER':
            layout.use_property_split = True
            layout.use_property_decorate = False
        settings = tool.operator_properties(MOTUS_OT_ik_drag.bl_idname)
        layout.prop(settings, "chain_length")
        if settings.chain_length == 0 and context.region.type == 'TOOL_HEADER':
            layout.label(text="All connected bones up to a branch")


TOOLS = (DragChainTool,)


def register():
    """Add the Drag Chain tool to the toolbar, with its key map."""
    toolbar.register(TOOLS, KEYMAP)


def unregister():
    """Remove the Drag Chain tool from the toolbar, with its key map."""
    toolbar.unregister(TOOLS)
