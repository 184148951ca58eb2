"""Operator motus.pull_adjust: changes the brush's radius or strength with the mouse.

The keys F and Shift F call it, as they do for Blender's own brushes.
"""

import bpy

from ...core.interface.view import viewports
from ...core.refusals import Refused
from ..brush import Brush
from . import hover
from .adjusting import MOVES, notched
from .pulling import Pulling

NUMBERS = (
    ('RADIUS', "Radius", "Distance from the root that the brush reaches"),
    ('STRENGTH', "Strength", "Distance by which one dab moves the root"),
)


class MOTUS_OT_pull_adjust(bpy.types.Operator):
    bl_idname = "motus.pull_adjust"
    bl_label = "Adjust Pull"
    bl_description = "Change the brush's radius or strength by the mouse or by typing a number"
    bl_options = {'INTERNAL'}

    number: bpy.props.EnumProperty(
        name="Number", description="Number that is changed", items=NUMBERS, default='RADIUS', options={'SKIP_SAVE'}
    )
    steps: bpy.props.IntProperty(
        name="Steps", description="Steps by which the number goes up or down; 0 lets the mouse change it", default=0, options={'SKIP_SAVE'}
    )

    def execute(self, context):
        settings, name = context.scene.motus.pull, self.number.lower()
        if self.steps:
            setattr(settings, name, notched(settings, name, self.steps))
        for area in context.screen.areas if context.screen else ():
            if area.type == 'VIEW_3D':
                area.tag_redraw()
        return {'FINISHED'}

    def invoke(self, context, event):
        view = viewports.view_at(context.window, event.mouse_x, event.mouse_y) if context.window else None
        if self.steps or view is None:
            return self.execute(context)
        if not hover.is_tool_active(context):
            return {'CANCELLED', 'PASS_THROUGH'}
        try:
            # The tool handles the key at any position of the mouse: Blender's own operator on this key would change the mesh.
            session = hover.session(context) or hover.read_now(context)
            session.brush = Brush.of(context.scene.motus.pull)
        except Refused as refusal:
            self.report({'WARNING'}, str(refusal))
            return {'CANCELLED'}
        self._pulling = Pulling(context, session, {})
        self._pulling.adjust(context, self.number.lower(), view, event)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        try:
            self._pulling.handle_adjustment(context, event)
        except Exception:
            self.cancel(context)
            raise
        if self._pulling.adjustment is None:
            self.cancel(context)
            return {'FINISHED'}
        return {'PASS_THROUGH'} if event.type in MOVES else {'RUNNING_MODAL'}

    def cancel(self, context):
        """End the operator; the radius or strength keeps its present value."""
        self._pulling.close(context)


classes = (MOTUS_OT_pull_adjust,)
