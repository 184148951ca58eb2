"""Plain orthographic views of a path in the viewport, and back to what was there.

All at once they are Blender's own quad view; nothing is added to the file. What was there is known as long as Blender runs.
"""

import math
from functools import partial
from typing import Any, NamedTuple

import bpy
from mathutils import Euler, Quaternion, Vector

from ..core import teardown
from ..core.operators import Operator
from ..core.refusals import Refused
from ..core.rows import Rows
from ..core.translations import tr
from . import targets

MARGIN = 1.3  # of the curve's size
SMALLEST = 1.0  # m
SENSOR = 72.0  # mm: Blender shows so much along the larger side of a viewport, times its distance over its lens

VIEWS = {'TOP': Quaternion(), 'SIDE': Euler((math.pi / 2.0, 0.0, 0.0)).to_quaternion()}
"""How each view is turned."""
KEPT = ("view_perspective", "view_rotation", "view_location", "view_distance", "is_orthographic_side_view", "view_perspective")
"""What of a view is put back, in that order: a camera's view takes none of the rest."""


class _Before(NamedTuple):
    """view: which edit view is shown. is_quad: whether the viewport was a quad view. kept: of its views, {name: value} each."""

    view: str
    is_quad: bool
    kept: Any


_before = {}
"""What viewports with edit views were, by the areas' addresses."""


class MOTUS_OT_path_edit_views(Operator, bpy.types.Operator):
    bl_idname = "motus.path_edit_views"
    bl_label = "Path Edit Views"
    bl_description = "Look at the path from the top, the front and the side at once, without perspective; once more to go back"
    bl_options = {'REGISTER'}  # no undo step: nothing in the file changes

    curve: bpy.props.StringProperty(
        name="Curve", description="Name of the curve object; empty takes the selected one or what the active object follows",
        options={'SKIP_SAVE'})
    view: bpy.props.EnumProperty(
        name="View", description="Which view to show", default='NEXT', options={'SKIP_SAVE'}, items=(
            ('NEXT', "Next", "From the top or from the side, whichever is not shown"),
            ('TOP', "Top", "From above"),
            ('SIDE', "Side", "From the side"),
            ('ALL', "All", "From the top, the front and the right, and the viewport's own view"),
            ('LEAVE', "Leave", "Back to what the viewport showed before"),
        ))

    redo = (Rows(("view",)),)

    @classmethod
    def check_offer(cls, context):
        targets.curve_for(context, "", *_owners(context))

    def invoke(self, context, _event):
        """There and back, where nobody says which view."""
        if not self.is_given("view"):
            self.view = 'LEAVE' if is_on(context) else 'ALL'
        return self.execute(context)

    def run(self, context):
        areas = _areas(context)
        if self.view == 'LEAVE':
            for area in areas:
                _leave(context.window, area)
            return
        curve = targets.curve_for(context, self.curve, *_owners(context))
        if self.view == 'ALL' and bpy.app.background:
            raise Refused(tr("Blender runs without a window: choose a single view"))
        context.view_layer.update()
        view = self.view if self.view != 'NEXT' else _other(areas)
        for area in areas:
            _leave(context.window, area)
            _enter(context.window, area, view, _corners(curve))
        self.report({'INFO'}, tr("Edit Views of {curve}").format(curve=curve.name))


def is_on(context):
    """Whether edit views are shown where the context's operator would act."""
    return any(_shown(area) for area in _areas(context))


def draw_buttons(layout, context):
    """The button that goes there, or back."""
    if is_on(context):
        _draw_leave(layout)
    else:
        layout.operator(MOTUS_OT_path_edit_views.bl_idname, text="Edit Views", icon='VIEW_ORTHO').view = 'ALL'


def register():
    """Put the way back into the viewport's header."""
    bpy.types.VIEW3D_HT_header.append(_draw_header)


def unregister():
    """Let all viewports be what they were."""
    teardown.run(_leave_all, partial(bpy.types.VIEW3D_HT_header.remove, _draw_header), _before.clear)


def _draw_header(header, context):
    if _shown(context.area):
        _draw_leave(header.layout)


def _draw_leave(layout):
    layout.operator(MOTUS_OT_path_edit_views.bl_idname, text="Leave Edit Views", icon='LOOP_BACK').view = 'LEAVE'


def _owners(context):
    return [context.object] if context.object else []


def _areas(context):
    """The 3D viewport that the call comes from, else all of the screen."""
    if context.area and context.area.type == 'VIEW_3D':
        return [context.area]
    return [area for area in context.screen.areas if area.type == 'VIEW_3D'] if context.screen else []


def _shown(area):
    """Which edit view an area shows; "" for none."""
    before = _before.get(area.as_pointer())
    if before is None or area.type != 'VIEW_3D':
        return ""
    # A quad view may have been left by Blender's own key.
    is_there = before.view != 'ALL' or bool(area.spaces.active.region_quadviews)
    return before.view if is_there else ""


def _other(areas):
    return 'SIDE' if any(_shown(area) == 'TOP' for area in areas) else 'TOP'


def _views(space):
    """The RegionView3Ds of a viewport: one, or the four of a quad view."""
    return list(space.region_quadviews) or [space.region_3d]


def _enter(window, area, view, corners):
    space = area.spaces.active
    is_quad = bool(space.region_quadviews)
    kept = [{name: _value(one, name) for name in KEPT} for one in _views(space)]
    region = _region(area)
    width, height = region.width, region.height
    if view == 'ALL':
        if not is_quad:
            _toggle_quad(window, area)
            width, height = width / 2.0, height / 2.0  # Blender lays the regions out later
        for one in _views(space)[:3]:
            _fit(space, one, one.view_rotation, corners, width, height)
    else:
        space.region_3d.view_perspective = 'ORTHO'
        space.region_3d.view_rotation = VIEWS[view]
        _fit(space, space.region_3d, VIEWS[view], corners, width, height)
    _before[area.as_pointer()] = _Before(view, is_quad, kept)
    area.tag_redraw()


def _leave(window, area):
    shown, before = _shown(area), _before.pop(area.as_pointer(), None)
    if not shown:
        return
    space = area.spaces.active
    if bool(space.region_quadviews) != before.is_quad:
        _toggle_quad(window, area)
    for one, kept in zip(_views(space), before.kept):
        for name in KEPT:
            if getattr(one, name) != kept[name]:  # what is set again comes out a rounding away
                setattr(one, name, kept[name])
    area.tag_redraw()


def _leave_all():
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            _leave(window, area)


def _value(view, name):
    value = getattr(view, name)
    return value.copy() if hasattr(value, "copy") else value


def _region(area):
    """The region of the viewport's own view, the last of a quad view."""
    return [region for region in area.regions if region.type == 'WINDOW'][-1]


def _toggle_quad(window, area):
    with bpy.context.temp_override(window=window, area=area, region=_region(area)):
        bpy.ops.screen.region_quadview()


def _fit(space, view, rotation, corners, width, height):
    """Let an orthographic view show all corners. width, height: of its region, pixels."""
    turned = [rotation.inverted() @ corner for corner in corners]
    low, high = (Vector(map(end, zip(*turned))) for end in (min, max))
    size = [max(side, SMALLEST) for side in high - low]
    larger = max(width, height, 1.0)
    seen = MARGIN * max(size[0] * larger / max(width, 1.0), size[1] * larger / max(height, 1.0))
    view.view_location = rotation @ ((low + high) / 2.0)
    view.view_distance = seen * space.lens / SENSOR


def _corners(curve):
    return [curve.matrix_world @ Vector(corner) for corner in curve.bound_box]


classes = (MOTUS_OT_path_edit_views,)
