"""Tools of the toolbar: put there with their keys, and taken back; where one is in hand then, Blender's own takes its place."""

from functools import partial

import bpy

from ...blender import handlers

RESTING = {'OBJECT': "builtin.select_box", 'EDIT_MESH': "builtin.select_box", 'POSE': "builtin.select_box", 'SCULPT': "builtin.move"}
"""Blender's tools by mode."""

_registered = []


def register(tools, keys):
    """Put WorkSpaceTools into the toolbars. keys: the keymap of each of them."""
    has_keys = bpy.context.window_manager.keyconfigs.addon is not None  # there are none in the background
    for one in tools:
        one.bl_keymap = keys if has_keys else None
        bpy.utils.register_tool(one, separator=True)
        _registered.append(one)


def unregister(tools):
    """Take them back."""
    handlers.take_back(partial(_put_down, {one.bl_idname for one in tools}))
    for one in [one for one in reversed(_registered) if one in tools]:
        _registered.remove(one)
        handlers.take_back(partial(bpy.utils.unregister_tool, one))


def in_hand(context):
    """Name of the tool of the viewport in the context's mode; None without one."""
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
