"""The add-on's preferences."""

import bpy

from ...blender import capabilities
from . import viewports

PACKAGE = __package__.removesuffix(".core.interface.view")
"""Name by which Blender knows the add-on: motus, or of an extension bl_ext.REPOSITORY.motus."""
_SHELF = "show_region_asset_shelf"


_TRIES, _PAUSE = 20, 0.1
"""How often, and after how many seconds, Blender is asked whether the region can be opened."""


def _show_shelf(own, context):
    """Open Blender's region for asset shelves in the viewports when the preset shelf is switched on; afterwards restore the regions.

    The region can be opened once Blender has found that there is a shelf to show, which it looks for when it draws the viewport.
    """
    if not own.show_preset_shelf:
        for space in _changeable(context):
            viewports.restore(space, {_SHELF: False})
        return
    left = iter(range(_TRIES))

    def open_regions():
        found = _changeable(bpy.context)
        for space in found:
            viewports.change(space, {_SHELF: True})
        return None if found or next(left, None) is None else _PAUSE

    viewports.redraw()
    bpy.app.timers.register(open_regions, first_interval=_PAUSE)


def _changeable(context):
    """The SpaceView3D of all viewports in the open windows whose region for asset shelves can be opened and closed."""
    areas = [area for window in context.window_manager.windows for area in window.screen.areas if area.type == 'VIEW_3D']
    return [area.spaces.active for area in areas if not area.spaces.active.is_property_readonly(_SHELF)]


class MOTUS_AP_preferences(bpy.types.AddonPreferences):
    bl_idname = PACKAGE

    show_first_steps: bpy.props.BoolProperty(
        name="First Steps",
        description="Show where to begin, in the tab Motus of the 3D viewport's sidebar; switched off when an operator of Motus was used",
        default=True,
    )
    show_preset_shelf: bpy.props.BoolProperty(
        name="Motus Presets",
        description="Show a shelf with your presets of Motus at the bottom of the 3D viewport: drag one onto an object, or click it for all "
        "that is selected",
        default=False,
        update=_show_shelf,
    )

    def draw(self, _context):
        column = self.layout.column()
        column.label(text="Motus is in the sidebar of the 3D viewport, which N opens, and in the menus Add, Object and Pose", icon='INFO')
        column.prop(self, "show_first_steps")
        if capabilities.has_asset_shelves():
            column.prop(self, "show_preset_shelf")


def own(context):
    """The add-on's preferences; None if a script has enabled the add-on without them."""
    addon = context.preferences.addons.get(PACKAGE)
    return addon and addon.preferences


classes = (MOTUS_AP_preferences,)
