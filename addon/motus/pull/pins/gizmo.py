"""Gizmo that draws the handles of all pins of an object, and lets the user pick one."""

import bpy

from ...core.interface.dragging import handle_groups
from ...core.interface.view import drawing
from ...core.lazy import numpy as np
from ..window import hover
from . import handles, setup
from .dragging import MOTUS_OT_pin_drag

RADIUS = 5.0
"""Radius of a pin's handle, in pixels at the interface's normal size."""
ACTIVE_RADIUS = 7.0
RIM = 1.5
PULLING, RESTING, BROKEN = (0.95, 0.95, 1.0, 0.9), (0.6, 0.6, 0.65, 0.6), (0.95, 0.25, 0.3, 0.9)
ACTIVE = (1.0, 0.56, 0.16, 1.0)
LIT = 0.35
"""Share by which the handle under the mouse is lightened towards white."""
RIM_COLOR = (0.05, 0.05, 0.08, 0.85)


class MOTUS_GT_pins(bpy.types.Gizmo):
    bl_idname = "MOTUS_GT_pins"
    __slots__ = ("hovered",)

    def setup(self):
        self.hovered = -1

    def test_select(self, context, location):
        found = -1
        if not hover.is_tool_active(context):  # the tool's strokes may begin on a handle
            shown = handles.read(context.object, context.evaluated_depsgraph_get())
            near = handles.NEAR * context.preferences.system.ui_scale
            row = handles.pick(shown, context.region, context.region_data.perspective_matrix, location, near)
            found = -1 if row is None else int(shown.indices[row])
        if found != self.hovered:
            self.hovered = found
            context.area.tag_redraw()
        return 0 if found >= 0 else -1

    def draw(self, context):
        import gpu

        obj = context.object
        shown = handles.read(obj, context.evaluated_depsgraph_get())
        places, is_before = handles.on_screen(shown.places, context.region, context.region_data.perspective_matrix)
        if not is_before.any():
            return
        active = shown.indices == obj.motus.pull.active_pin
        scale = context.preferences.system.ui_scale
        radii = np.where(active, ACTIVE_RADIUS, RADIUS) * scale
        colors = np.where(shown.acts[:, None], PULLING, RESTING)
        colors[shown.is_broken] = BROKEN
        colors[active & ~shown.is_broken] = ACTIVE
        hovered = (shown.indices == self.hovered) if self.is_highlight else np.zeros(len(active), bool)
        colors[hovered] += LIT * (1.0 - colors[hovered])
        gpu.state.blend_set('ALPHA')
        rims = np.tile(RIM_COLOR, (len(places), 1))
        drawing.discs(places[is_before], radii[is_before] + RIM * scale, rims[is_before])
        drawing.discs(places[is_before], radii[is_before], colors[is_before])
        for row in np.flatnonzero(hovered & is_before):
            x, y = places[row] + (1.5 * ACTIVE_RADIUS * scale, ACTIVE_RADIUS * scale)
            drawing.text([obj.motus.pull.pins[int(shown.indices[row])].name], x, y, scale)
        gpu.state.blend_set('NONE')


class MOTUS_GGT_pins(handle_groups.HandleGroup, bpy.types.GizmoGroup):
    bl_idname = "MOTUS_GGT_pins"
    bl_label = "Pins"

    gizmo, operator = MOTUS_GT_pins.bl_idname, MOTUS_OT_pin_drag.bl_idname
    system = staticmethod(setup.system)

    @staticmethod
    def is_owner(obj):
        """Whether the object has pins, and so gets the gizmo."""
        return obj.type == 'MESH' and obj.motus.pull.is_active


classes = (MOTUS_GT_pins, MOTUS_GGT_pins)
