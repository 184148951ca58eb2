"""The operator that lets the viewport show what both eyes of a rig see, and whether it does."""

import bpy

from ..core import viewports
from ..core.operators import Operator, object_keyword
from ..core.refusals import Refused
from ..core.translations import tr
from . import rig, targets

_BOTH = {"region_3d.view_perspective": 'CAMERA', "stereo_3d_camera": 'S3D', "overlay.show_overlays": False}
_ONE = {"region_3d.view_perspective": 'PERSP', "overlay.show_overlays": True, "stereo_3d_camera": 'S3D'}
"""Values of a viewport, by their paths: through both eyes, and otherwise."""


def is_shown(context, camera):
    """Whether the viewport looks through both eyes of a camera."""
    space = viewports.space_for(context)
    if space is None or space.region_3d is None or not viewports.has(space, _BOTH):
        return False
    return camera == (space.camera if space.use_local_camera else context.scene.camera)


class MOTUS_OT_stereo_view(Operator, bpy.types.Operator):
    bl_idname = "motus.stereo_view"
    bl_label = "Anaglyph View"
    bl_description = "Look through both eyes of the camera in the viewport, with red and cyan glasses; once more to look as before"
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
            return
        if not rig.renders_both_eyes(context.scene):
            raise Refused(rig.one_eye())
        if context.scene.camera != camera:
            viewports.change(space, {"camera": camera, "use_local_camera": True})
        viewports.change(space, _BOTH)
        display = context.window.stereo_3d_display
        if display.display_mode != 'ANAGLYPH':
            display.display_mode = 'ANAGLYPH'


classes = (MOTUS_OT_stereo_view,)
