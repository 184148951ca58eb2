"""Gizmos of the active walker in the viewport: the handles of its steps, and the chart of when they are."""

import bpy

from ...core.declare import is_owner
from ...core.interface.dragging import handle_groups
from ...core.interface.view import drawing
from ...core.measures import scene_time
from .. import legs, overlay, setup
from . import chart, handles, operators

RADIUS, SMALL = 4.0, 1.5
"""Radius of a drawn handle, and of one of a planned step, which hides no foothold; in pixels at a Resolution Scale of 1."""
RIM, WIDTH = 1.5, 1.5
COLOR, CHOSEN, LOCKED, LIT = (0.85, 0.85, 0.90, 0.9), (1.0, 0.85, 0.3, 1.0), (1.0, 0.35, 0.25, 1.0), (1.0, 1.0, 1.0, 1.0)
RIM_COLOR = (0.05, 0.05, 0.08, 0.85)
"""Colours of handles: of planned steps, of steps that were dragged or turned, of locked ones, of the one under the mouse, and of rims."""
GROUND_COLOR, NOW_COLOR, BAR_ALPHA = (0.05, 0.05, 0.08, 0.55), (0.35, 0.65, 1.0, 0.9), 0.6
"""Colours of the chart's ground and of the present time in it, and the opacity of bars as a share of that of handles."""


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
            color, is_hovered = _color(owner, handle.step), self.is_highlight and _name(handle) == self.hovered
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


def _color(owner, step):
    entries, index = owner.motus.walker.steps, step.entry
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


class MOTUS_GT_walker_times(bpy.types.Gizmo):
    bl_idname = "MOTUS_GT_walker_times"
    __slots__ = ("hovered",)

    def setup(self):
        self.hovered = None

    def test_select(self, context, location):
        drawn = chart.Chart.of(context, context.object, context.region)
        found = drawn and drawn.pick(location)
        hovered = found and (found.step.leg, found.step.planned, found.moment)
        if hovered != self.hovered:
            self.hovered = hovered
            context.area.tag_redraw()
        return 0 if found else -1

    def draw(self, context):
        import gpu

        owner = context.object
        drawn = chart.Chart.of(context, owner, context.region)
        if drawn is None:
            return
        gpu.state.blend_set('ALPHA')
        scale, entries = drawn.scale, owner.motus.walker.steps
        low, high = drawn.y(drawn.rows - 1) - 0.5 * chart.ROW * scale, drawn.y(0) + 0.5 * chart.ROW * scale
        left, right = (drawn.x(drawn.now + side * chart.SECONDS) for side in (-1.0, 1.0))
        drawing.rectangle((left, low), (right, high), GROUND_COLOR)
        for leg in range(drawn.rows):
            drawing.text([legs.label(owner.motus.walker.legs[leg])], chart.LEFT * scale, drawn.y(leg) - 0.25 * chart.ROW * scale, scale)
        half = 0.5 * chart.BAR * scale
        sides = overlay.is_left(owner)
        for step in drawn.steps:
            color = _color(owner, step)
            if color == COLOR:
                color = overlay.LEFT_COLOR if sides[step.leg] else overlay.RIGHT_COLOR
            middle = drawn.y(step.leg)
            drawing.rectangle((drawn.x(step.touch), middle - half), (drawn.x(step.lift), middle + half), (*color[:3], BAR_ALPHA * color[3]))
        drawing.line([(drawn.x(drawn.now), low), (drawn.x(drawn.now), high)], NOW_COLOR, WIDTH * scale)
        for end in drawn.ends():
            step = end.step
            is_set = 0 <= step.entry < len(entries) and getattr(entries[step.entry], f"use_{end.moment}")
            is_hovered = self.is_highlight and (step.leg, step.planned, end.moment) == self.hovered
            if is_set or is_hovered:
                place = drawn.x(end.seconds), drawn.y(step.leg)
                colors = [RIM_COLOR, LIT if is_hovered else _color(owner, step)]
                drawing.discs([place, place], [(RADIUS + RIM) * scale, RADIUS * scale], colors, corners=4)
            if is_hovered:
                frame = scene_time.time_line(context.scene, end.seconds * scene_time.fps(context.scene))
                drawing.text([f"{frame:.1f}".rstrip("0").rstrip(".")], place[0] + 1.5 * RADIUS * scale, high + RADIUS * scale, scale)
        gpu.state.blend_set('NONE')


class MOTUS_GGT_walker_times(handle_groups.HandleGroup, bpy.types.GizmoGroup):
    bl_idname = "MOTUS_GGT_walker_times"
    bl_label = "Times of a Walker's Steps"

    gizmo, operator = MOTUS_GT_walker_times.bl_idname, operators.MOTUS_OT_walker_step_time.bl_idname
    system = staticmethod(setup.system)
    is_owner = MOTUS_GGT_walker.is_owner

    @classmethod
    def poll(cls, context):
        return context.scene.motus.show_walker_times and super().poll(context)


classes = (MOTUS_GT_walker, MOTUS_GGT_walker, MOTUS_GT_walker_times, MOTUS_GGT_walker_times)
