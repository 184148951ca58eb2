"""The hint where to begin, in the tab Motus of the sidebar: shown until it is hidden, or until an operator of Motus was used.

The add-on's preferences remember that, so that the hint is not shown again.
"""

import bpy

PACKAGE = __package__.removesuffix(".core.interface.view")
"""Name by which Blender knows the add-on: motus, or of an extension bl_ext.REPOSITORY.motus."""


class MOTUS_AP_preferences(bpy.types.AddonPreferences):
    bl_idname = PACKAGE

    show_first_steps: bpy.props.BoolProperty(
        name="First Steps",
        description="Show where to begin, in the tab Motus of the 3D viewport's sidebar; switched off when an operator of Motus was used",
        default=True,
    )

    def draw(self, _context):
        column = self.layout.column()
        column.label(text="Motus is in the sidebar of the 3D viewport, which N opens, and in the menus Add, Object and Pose", icon='INFO')
        column.prop(self, "show_first_steps")


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
    own = context.preferences.addons.get(PACKAGE)
    return has_window() and own is not None and own.preferences.show_first_steps


def hide(context):
    """Do not show the hint again. Blender saves the preferences on exit, unless the user has switched that off."""
    if is_shown(context):
        context.preferences.addons[PACKAGE].preferences.show_first_steps = False
        context.preferences.is_dirty = True


classes = (MOTUS_AP_preferences, MOTUS_OT_hide_first_steps)
