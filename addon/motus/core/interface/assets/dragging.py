"""The operator that takes an asset from the shelf and gives its settings to the object or bone over which the mouse is released."""

import bpy
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

from ...lazy import numpy as np
from ...refusals import Refused
from ...translations import tr
from ..view import drawing, viewports
from . import under_mouse
from .giving import Giving

COLOR = (1.0, 0.6, 0.1, 1.0)
PAD = 6.0
"""Pixels, at a scale of 1, between what is under the mouse and the frame around it."""


class _Frame:
    """The frame that the viewport draws around what is under the mouse. found: the Found; None draws none. label: name of the asset."""

    def __init__(self, label):
        self.label, self.found = label, None
        self._handler = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), 'WINDOW', 'POST_PIXEL')

    def remove(self):
        bpy.types.SpaceView3D.draw_handler_remove(self._handler, 'WINDOW')
        viewports.redraw()

    def _draw(self):
        context, found = bpy.context, self.found
        if found is None or found.view.region != context.region:
            return
        try:
            obj, name = found.object, found.bone or found.object.name
        except ReferenceError:  # a script has removed the object
            return
        corners = _corners(obj, found.bone)
        seen = [place for place in (location_3d_to_region_2d(context.region, found.view.data, corner) for corner in corners) if place]
        if not seen:
            return
        scale = context.preferences.system.ui_scale
        low, high = np.min(seen, axis=0) - PAD * scale, np.max(seen, axis=0) + PAD * scale
        drawing.line([low, (high[0], low[1]), high, (low[0], high[1]), low], COLOR, 2.0 * scale)
        drawing.text([name, self.label], high[0] + PAD * scale, high[1] - 2.0 * PAD * scale, scale)


def _corners(obj, bone):
    """Places in the world around which the frame is drawn."""
    if bone:
        posed = obj.pose.bones.get(bone)
        return [obj.matrix_world @ place for place in (posed.head, posed.tail)] if posed else []
    return [obj.matrix_world @ Vector(corner) for corner in obj.bound_box]


class MOTUS_OT_asset_drag(Giving, bpy.types.Operator):
    bl_idname = "motus.asset_drag"
    bl_label = "Give by Dragging"
    bl_description = "Give the settings that the asset holds to the object or bone over which the mouse is released"

    def invoke(self, context, _event):
        if not self.find_asset(context):
            return {'CANCELLED', 'PASS_THROUGH'}
        try:
            self.what()
        except Refused as refusal:
            return self.refuse(refusal)
        self._frame = _Frame(self.name)
        context.workspace.status_text_set(tr("Release the mouse over an object, in Pose Mode over a bone; Esc or the right button cancels"))
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        if event.type in {'ESC', 'RIGHTMOUSE'} and event.value == 'PRESS':
            self.cancel(context)
            return {'CANCELLED'}
        if event.type == 'MOUSEMOVE' or (event.type == 'LEFTMOUSE' and event.value == 'RELEASE'):
            self._frame.found = under_mouse.find(context, event.mouse_x, event.mouse_y)
            viewports.redraw()
        if event.type == 'LEFTMOUSE' and event.value == 'RELEASE':
            return self._release(context)
        return {'RUNNING_MODAL'}

    def _release(self, context):
        found = self._frame.found
        self.cancel(context)
        if found is None:
            return {'CANCELLED'}
        self.object, self.bones = found.object.name, found.bone
        return self.execute(context)

    def cancel(self, context):
        self._frame.remove()
        context.workspace.status_text_set(None)


classes = (MOTUS_OT_asset_drag,)
