"""Gizmo that draws and picks the handles of the active walker's steps in the viewport."""

import bpy

from ...core.declare import is_owner
from ...core.interface.dragging import handle_groups
from ...core.interface.view import drawing
from .. import legs, setup
from . import handles, operators

RADIUS, SMALL = 4.0, 1.5
"""Radius of a drawn handle, and of one of a planned step, which hides no foothold; in pixels at a Resolution Scale of 1."""
RIM, WIDTH = 1.5, 1.5
COLOR, CHOSEN, LOCKED, LIT = (0.85, 0.85, 0.90, 0.9), (1.0, 0.85, 0.3, 1.0), (1.0, 0.35, 0.25, 1.0), (1.0, 1.0, 1.0, 1.0)
RIM_COLOR = (0.05, 0.05, 0.08, 0.85)
"""Colours of handles: of planned steps, of steps that were dragged or turned, of locked ones, of the one under the mouse, and of rims."""


class MOTUS_GT_walker(bpy.types.Gizmo):
    bl_idname = "MOTUS_GT_walker"
    __slots__ = ("hovered",)

    def setup(self):
        self.hovered = None

    def test_select(self, context, location):
        found = handles.pick(context, context.object, context.region, context.region_data.perspective_matrix, location)
        hovered = found and _name(found[0])
        if hovered != self.hovered:
            self.hovered = hovered
            context.area.tag_redraw()
        return 0 if found else -1

    def draw(self, context):
        import gpu

        owner, region = context.object, context.region
        scale = context.preferences.system.ui_scale
        gpu.state.blend_set('ALPHA')
        places = {}
        for handle, place in handles.seen(region, context.region_data.perspective_matrix, handles.of(context, owner)):
            places[_name(handle)] = place
            color, is_hovered = _color(owner, handle), self.is_highlight and _name(handle) == self.hovered
            if handle.turns:
                drawing.line([places.get((handle.step.leg, handle.step.middle, False), place), place], color, WIDTH * scale)
            if is_hovered or color != COLOR:
                drawing.discs([place, place], [(RADIUS + RIM) * scale, RADIUS * scale], [RIM_COLOR, LIT if is_hovered else color])
            else:
                drawing.discs([place], [SMALL * scale], [color])
            if is_hovered:
                drawing.text([legs.label(owner.motus.walker.legs[handle.step.leg])], *(place + 1.5 * RADIUS * scale), scale)  # type: ignore[call-arg]
        gpu.state.blend_set('NONE')


def _name(handle):
    """What tells a handle apart from the others of its walker."""
    return handle.step.leg, handle.step.middle, handle.turns


def _color(owner, handle):
    entries, index = owner.motus.walker.steps, handle.step.entry
    if not 0 <= index < len(entries):
        return COLOR
    return LOCKED if entries[index].is_locked else CHOSEN


class MOTUS_GGT_walker(handle_groups.HandleGroup, bpy.types.GizmoGroup):
    bl_idname = "MOTUS_GGT_walker"
    bl_label = "Steps of a Walker"

    gizmo, operator = MOTUS_GT_walker.bl_idname, operators.MOTUS_OT_walker_step.bl_idname
    system = staticmethod(setup.system)

    @staticmethod
    def is_owner(obj):
        """Whether an object is a walker whose steps may be edited: it is neither linked nor baked."""
        return is_owner(setup.system(), obj) and obj.library is None and not (obj.motus.walker.is_baked or obj.motus.bake.is_baked)


classes = (MOTUS_GT_walker, MOTUS_GGT_walker)
