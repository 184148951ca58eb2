"""The hint where to begin, in the tab Motus of the sidebar: shown until it is hidden, or until an operator of Motus was used.

The add-on's preferences remember that, so that the hint is not shown again.
"""

import bpy

from . import preferences


class MOTUS_OT_hide_first_steps(bpy.types.Operator):
    bl_idname = "motus.hide_first_steps"
    bl_label = "Hide First Steps"
    bl_description = "Do not show this hint again; it can be switched on in the add-on's preferences"
    bl_options = {'INTERNAL'}

    def execute(self, context):
        hide(context)
        return {'FINISHED'}


def has_window():
    """Whether there is somebody to read the hint."""
    return not bpy.app.background


def is_shown(context):
    """Whether the hint is to be drawn. Without preferences of the add-on, which scripts can enable without them, nothing would remember to hide it."""
    own = preferences.own(context)
    return has_window() and own is not None and own.show_first_steps


def hide(context):
    """Do not show the hint again. Blender saves the preferences on exit, unless the user has switched that off."""
    if is_shown(context):
        preferences.own(context).show_first_steps = False
        context.preferences.is_dirty = True


classes = (MOTUS_OT_hide_first_steps,)
