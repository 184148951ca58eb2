"""Entries that add and remove motion drivers, in the context menu of a property."""

import bpy

from ..core.interface.view import hovered
from . import expressions
from .operators import MOTUS_OT_driver_add, MOTUS_OT_driver_copy, MOTUS_OT_driver_remove, MOTUS_OT_driver_write_out


def _draw(menu, context):
    found = hovered.find(context, is_drawing=True)
    if found is None:
        return
    datablock, path, index = found
    animation = getattr(datablock, "animation_data", None)
    is_ours = any(
        curve.data_path == path and index in (-1, curve.array_index) and expressions.names_ours(curve.driver.expression)
        for curve in (animation.drivers if animation else ())
    )
    layout = menu.layout
    layout.separator()
    layout.operator_context = 'INVOKE_DEFAULT'
    layout.operator(MOTUS_OT_driver_add.bl_idname, text="Edit Motion Driver" if is_ours else "Add Motion Driver", icon='DRIVER')
    if is_ours:
        layout.operator(MOTUS_OT_driver_copy.bl_idname, icon='COPYDOWN')
        layout.operator(MOTUS_OT_driver_write_out.bl_idname, icon='KEYFRAME')
        layout.operator(MOTUS_OT_driver_remove.bl_idname, icon='X')


def register():
    """Add the entries for motion drivers to Blender's context menu of properties."""
    bpy.types.UI_MT_button_context_menu.append(_draw)


def unregister():
    """Remove the entries for motion drivers from Blender's context menu of properties."""
    bpy.types.UI_MT_button_context_menu.remove(_draw)
