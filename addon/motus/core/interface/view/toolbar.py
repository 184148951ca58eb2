"""Add tools to the toolbar with their keymaps, and remove them; a tool of Blender replaces a removed tool that is active."""

from functools import partial

import bpy

from ...blender import handlers

RESTING = {'OBJECT': "builtin.select_box", 'EDIT_MESH': "builtin.select_box", 'POSE': "builtin.select_box", 'SCULPT': "builtin.move"}
"""{mode: identifier of the tool of Blender that replaces a removed tool}."""

_registered = []


def register(tools, keys):
    """Add WorkSpaceTools to the toolbars. keys: the keymap that each tool gets."""
    has_keys = bpy.context.window_manager.keyconfigs.addon is not None  # Blender without a window has no keymaps
    for one in tools:
        one.bl_keymap = keys if has_keys else None
        bpy.utils.register_tool(one, separator=True)
        _registered.append(one)


def unregister(tools):
    """Remove WorkSpaceTools from the toolbars; in viewports in which one is active, a tool of Blender becomes active."""
    handlers.take_back(partial(_put_down, {one.bl_idname for one in tools}))
    for one in [one for one in reversed(_registered) if one in tools]:
        _registered.remove(one)
        handlers.take_back(partial(bpy.utils.unregister_tool, one))


def in_hand(context):
    """Identifier of the active tool of the 3D viewport in the context's mode; None if there is none."""
    if context.workspace is None:
        return None
    tool = context.workspace.tools.from_space_view3d_mode(context.mode, create=False)
    return tool and tool.idname


def _put_down(names):
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type != 'VIEW_3D':
                continue
            with bpy.context.temp_override(window=window, area=area):
                if in_hand(bpy.context) in names:
                    bpy.ops.wm.tool_set_by_id(name=RESTING[bpy.context.mode])
