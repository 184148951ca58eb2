"""Operator that switches a viewport between the rig's anaglyph view and its previous view."""

import bpy

from ..core.interface.operators import Operator, object_keyword
from ..core.interface.view import viewports
from ..core.refusals import Refused
from ..core.translations import tr
from . import rig, targets

_BOTH = {"region_3d.view_perspective": 'CAMERA', "stereo_3d_camera": rig.BOTH_EYES, "overlay.show_overlays": False}
_ONE = {"region_3d.view_perspective": 'PERSP', "overlay.show_overlays": True, "stereo_3d_camera": rig.ONE_EYE}
"""Values of viewport settings by data path: _BOTH for the anaglyph view; _ONE after it, if the previous values are unknown."""
_DISPLAY = {"display_mode": 'ANAGLYPH', "anaglyph_type": 'RED_CYAN'}
"""Values of Window.stereo_3d_display for the anaglyph view."""
_displays = viewports.PerViewport()
"""Values of Window.stereo_3d_display before the anaglyph view, {name: value} for each viewport."""


def is_shown(context, camera):
    """Whether the viewport shows the anaglyph view through a camera."""
    space = viewports.space_for(context)
    if space is None or space.region_3d is None or not viewports.has(space, _BOTH):
        return False
    return camera == (space.camera if space.use_local_camera else context.scene.camera)


class MOTUS_OT_stereo_view(Operator, bpy.types.Operator):
    bl_idname = "motus.stereo_view"
    bl_label = "Anaglyph View"
    bl_description = "Show the images of both eyes in the viewport, for red and cyan glasses; a second time restores the previous view"
    bl_options = {'REGISTER'}

    object: object_keyword("Name of the camera; empty takes the active one, or the scene's")

    @classmethod
    def check_offer(cls, context):
        targets.rig_for(context, "")

    def run(self, context):
        camera, space = targets.rig_for(context, self.object), viewports.space_for(context)
        if space is None or space.region_3d is None:
            raise Refused(tr("There is no 3D viewport here"))
        if is_shown(context, camera):
            local = {"camera": context.scene.camera, "use_local_camera": False} if space.use_local_camera else {}
            viewports.restore(space, _ONE | local)
            _show_images(context.window, _displays.take(space) or {})
            return
        if not rig.renders_both_eyes(context.scene):
            raise Refused(rig.one_eye())
        if context.scene.camera != camera:
            viewports.change(space, {"camera": camera, "use_local_camera": True})
        viewports.change(space, _BOTH)
        if _displays.get(space) is None:
            _displays.put(space, {name: getattr(context.window.stereo_3d_display, name) for name in _DISPLAY})
        _show_images(context.window, _DISPLAY)


def _show_images(window, values):
    """Set how a window displays stereo images. values: {name: value} of Window.stereo_3d_display."""
    for name, value in values.items():
        # Each assignment of the display mode recreates the windows.
        if getattr(window.stereo_3d_display, name) != value:
            setattr(window.stereo_3d_display, name, value)


classes = (MOTUS_OT_stereo_view,)
