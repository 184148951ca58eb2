"""Gizmo that draws and picks all handles of the active emitter in the viewport."""

import bpy

from ..core.interface.dragging import handle_groups
from ..core.interface.view import drawing
from ..core.translations import tr
from . import dragging, handles
from .build import is_emitter, system

RADIUS = 5.0
"""Radius of a drawn handle, in pixels at a Resolution Scale of 1."""
RIM = 1.5
COLOR, LIT, RIM_COLOR = (0.55, 0.80, 1.0, 0.95), (1.0, 0.75, 0.35, 1.0), (0.05, 0.05, 0.08, 0.85)


class MOTUS_GT_snow(bpy.types.Gizmo):
    bl_idname = "MOTUS_GT_snow"
    __slots__ = ("hovered",)

    def setup(self):
        self.hovered = ""

    def test_select(self, context, location):
        near = handles.NEAR * context.preferences.system.ui_scale
        found = dragging.pick(context.object, context.region, context.region_data.perspective_matrix, location, near)
        setting = found[0] if found else ""
        if setting != self.hovered:
            self.hovered = setting
            context.area.tag_redraw()
        return 0 if found else -1

    def draw(self, context):
        import gpu

        emitter, region, matrix = context.object, context.region, context.region_data.perspective_matrix
        scale = context.preferences.system.ui_scale
        gpu.state.blend_set('ALPHA')
        for setting, point in zip(*dragging.places(emitter)):
            seen = drawing.project(matrix, point[None])
            if seen is None:
                continue
            place = (seen[0] + 1.0) * (region.width / 2.0, region.height / 2.0)
            is_hovered = self.is_highlight and setting == self.hovered
            drawing.discs([place, place], [(RADIUS + RIM) * scale, RADIUS * scale], [RIM_COLOR, LIT if is_hovered else COLOR])
            if is_hovered:
                drawing.text([tr(emitter.motus.snow.bl_rna.properties[setting].name)], *(place + 1.5 * RADIUS * scale), scale)  # type: ignore[call-arg]
        gpu.state.blend_set('NONE')


class MOTUS_GGT_snow(handle_groups.HandleGroup, bpy.types.GizmoGroup):
    bl_idname = "MOTUS_GGT_snow"
    bl_label = "Emitter of Snow"

    gizmo, operator = MOTUS_GT_snow.bl_idname, dragging.MOTUS_OT_snow_drag.bl_idname
    system = staticmethod(system)

    @staticmethod
    def is_owner(obj):
        """Whether an object is an emitter of snow whose settings may be edited: it is not linked."""
        return is_emitter(obj) and obj.library is None


classes = (*dragging.classes, MOTUS_GT_snow, MOTUS_GGT_snow)
