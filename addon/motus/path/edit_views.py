"""Show a path in orthographic views from the top, the front and the side, and later restore the viewport's previous views.

The view ALL is Blender's own quad view. Nothing is written into the file: the previous views are remembered until Blender quits.
"""

import math
from functools import partial
from typing import Any, NamedTuple

import bpy
from mathutils import Euler, Quaternion, Vector

from ..core.blender import handlers
from ..core.interface.operators import Operator
from ..core.interface.rows import Rows
from ..core.interface.view import viewports
from ..core.refusals import Refused
from ..core.translations import tr
from . import targets

MARGIN = 1.3  # margin around the curve, as a share of its size
SMALLEST = 1.0  # m
SENSOR = 72.0  # mm: a view shows this length along the larger side of a viewport, times its distance over its lens

VIEWS = {'TOP': Quaternion(), 'SIDE': Euler((math.pi / 2.0, 0.0, 0.0)).to_quaternion()}
"""Rotation of the viewport for each edit view."""
KEPT = ("view_perspective", "view_rotation", "view_location", "view_distance", "is_orthographic_side_view", "view_perspective")
"""Properties of RegionView3D that are restored, in this order: setting `view_perspective` to a camera view overrides the others."""


BESIDE = {'HEADER', 'TOOL_HEADER', 'TOOLS', 'UI'}
"""Types of regions (headers, toolbar, sidebar) that may overlap the 3D views of a viewport."""
LEAST_FREE = 0.25
"""Least share of a view's width and height that must be free of overlapping regions; below it the overlap is ignored."""


class _Box(NamedTuple):
    """A rectangle in the window's pixels."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self):
        return max(self.right - self.left, 1.0)

    @property
    def height(self):
        return max(self.top - self.bottom, 1.0)

    @property
    def middle(self):
        return Vector((self.left + self.right, self.bottom + self.top)) / 2.0


class _Before(NamedTuple):
    """State of a viewport before it showed edit views.

    view: name of the edit view that is shown now. is_quad: whether the viewport was a quad view.
    kept: a dictionary of property values (KEPT) for each RegionView3D that the viewport had.
    """

    view: str
    is_quad: bool
    kept: Any


_before = viewports.PerViewport()
"""State before the edit views (_Before) of each viewport that shows edit views."""


class MOTUS_OT_path_edit_views(Operator, bpy.types.Operator):
    bl_idname = "motus.path_edit_views"
    bl_label = "Path Edit Views"
    bl_description = (
        "Show the path from the top, the front and the side at once, without perspective; a second time restores the previous view"
    )
    bl_options = {'REGISTER'}  # no undo step is made, since nothing in the file changes

    curve: bpy.props.StringProperty(
        name="Curve",
        description="Name of the curve object; empty takes the selected curve, or the curve that the active object follows",
        options={'SKIP_SAVE'},
    )
    view: bpy.props.EnumProperty(
        name="View",
        description="Edit view that is shown",
        default='NEXT',
        options={'SKIP_SAVE'},
        items=(
            ('NEXT', "Next", "View from the side if the view from the top is shown, otherwise view from the top"),
            ('TOP', "Top", "View from above"),
            ('SIDE', "Side", "View from the side"),
            ('ALL', "All", "Views from the top, the front and the right, beside the viewport's present view"),
            ('LEAVE', "Leave", "Restore the view that the viewport had before"),
        ),
    )

    redo = (Rows(("view",)),)

    @classmethod
    def check_offer(cls, context):
        targets.curve_for(context, "", *_owners(context))

    def invoke(self, context, _event):
        """Toggle between the edit views and the previous views, unless the caller has set the keyword that names a view."""
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
    """Whether a viewport that the operator would act on in this context shows edit views.

    Edit views are orthographic views of a path from the top, the front and the side.
    """
    return any(_shown(area) for area in _areas(context))


def draw_buttons(layout, context):
    """Draw the button that shows the edit views of a path, or that restores the previous views while edit views are shown."""
    if is_on(context):
        _draw_leave(layout)
    else:
        layout.operator(MOTUS_OT_path_edit_views.bl_idname, text="Edit Views", icon='VIEW_ORTHO').view = 'ALL'


def register():
    """Add the button that ends the edit views to the viewport's header, behind the menus: a narrow header cuts off its end first."""
    bpy.types.VIEW3D_MT_editor_menus.append(_draw_header)


def unregister():
    """Restore the previous views of all viewports that show edit views, and remove the button from the viewport's header."""
    handlers.take_back(_leave_all, partial(bpy.types.VIEW3D_MT_editor_menus.remove, _draw_header))


def _draw_header(menus, context):
    if _shown(context.area):
        _draw_leave(menus.layout)


def _draw_leave(layout):
    layout.operator(MOTUS_OT_path_edit_views.bl_idname, text="Leave Edit Views", icon='LOOP_BACK').view = 'LEAVE'


def _owners(context):
    return [context.object] if context.object else []


def _areas(context):
    """Return the 3D viewport that the operator was called from; all 3D viewports of the screen if it was called from a different editor."""
    if context.area and context.area.type == 'VIEW_3D':
        return [context.area]
    return [area for area in context.screen.areas if area.type == 'VIEW_3D'] if context.screen else []


def _shown(area):
    """Name of the edit view that an area shows now; "" if the area shows no edit view."""
    before = _before.get(area.spaces.active)
    if before is None or area.type != 'VIEW_3D':
        return ""
    # The user may have left the quad view with Blender's own key.
    is_there = before.view != 'ALL' or bool(area.spaces.active.region_quadviews)
    return before.view if is_there else ""


def _other(areas):
    return 'SIDE' if any(_shown(area) == 'TOP' for area in areas) else 'TOP'


def _views(space):
    """Return the RegionView3D objects of a viewport: one, or four if it is a quad view."""
    return list(space.region_quadviews) or [space.region_3d]


def _enter(window, area, view, corners):
    space = area.spaces.active
    is_quad = bool(space.region_quadviews)
    kept = [{name: _value(one, name) for name in KEPT} for one in _views(space)]
    whole, free = _boxes(area)
    if view == 'ALL':
        if not is_quad:
            _toggle_quad(window, area)
        for one, box in zip(_views(space), _quarters(whole)):
            _fit(space, one, corners, box, free)
    else:
        space.region_3d.view_perspective = 'ORTHO'
        space.region_3d.view_rotation = VIEWS[view]
        _fit(space, space.region_3d, corners, whole, free)
    _before.put(space, _Before(view, is_quad, kept))
    area.tag_redraw()


def _leave(window, area):
    space = area.spaces.active
    shown, before = _shown(area), _before.take(space)
    if not shown:
        return
    if bool(space.region_quadviews) != before.is_quad:
        _toggle_quad(window, area)
    for one, kept in zip(_views(space), before.kept):
        for name in KEPT:
            if getattr(one, name) != kept[name]:  # setting a view again changes its numbers by rounding
                setattr(one, name, kept[name])
    area.tag_redraw()


def _leave_all():
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            _leave(window, area)


def _value(view, name):
    value = getattr(view, name)
    return value.copy() if hasattr(value, "copy") else value


def _boxes(area):
    """Return two rectangles of an area: the area of all its 3D views, and the part of it that no header, toolbar or sidebar overlaps."""
    views = [_Box(one.x, one.y, one.x + one.width, one.y + one.height) for one in area.regions if one.type == 'WINDOW']
    low, high = ([pick(ends) for ends in zip(*views)] for pick in (min, max))
    whole = _Box(*low[:2], *high[2:])
    left, bottom, right, top = whole
    for one in area.regions:
        if one.type in BESIDE and min(one.width, one.height) > 1:
            if one.alignment == 'LEFT':
                left = max(left, one.x + one.width)
            elif one.alignment == 'RIGHT':
                right = min(right, one.x)
            elif one.alignment == 'TOP':
                top = min(top, one.y)
            elif one.alignment == 'BOTTOM':
                bottom = max(bottom, one.y + one.height)
    return whole, _Box(left, bottom, right, top)


def _quarters(box):
    """Return the rectangles of the front, top and right views of a quad view, which Blender lays out only after the operator has ended."""
    x, y = (box.left + box.right) / 2.0, (box.bottom + box.top) / 2.0
    return _Box(box.left, box.bottom, x, y), _Box(box.left, y, x, box.top), _Box(x, box.bottom, box.right, y)


def _toggle_quad(window, area):
    region = [region for region in area.regions if region.type == 'WINDOW'][-1]
    with bpy.context.temp_override(window=window, area=area, region=region):
        bpy.ops.screen.region_quadview()


def _fit(space, view, corners, box, free):
    """Move and zoom an orthographic view so that all corners lie in its free part.

    corners: world positions. box: rectangle of the view. free: rectangle that no region overlaps.
    """
    shown = _Box(*(max(ends) for ends in zip(box[:2], free[:2])), *(min(ends) for ends in zip(box[2:], free[2:])))
    if min(shown.width / box.width, shown.height / box.height) < LEAST_FREE:
        shown = box
    rotation = view.view_rotation
    turned = [rotation.inverted() @ corner for corner in corners]
    low, high = (Vector(map(end, zip(*turned))) for end in (min, max))
    size = [max(side, SMALLEST) for side in high - low]
    pixel = MARGIN * max(size[0] / shown.width, size[1] / shown.height)
    aside = shown.middle - box.middle
    view.view_location = rotation @ ((low + high) / 2.0 - pixel * aside.to_3d())
    view.view_distance = pixel * max(box.width, box.height) * space.lens / SENSOR


def _corners(curve):
    return [curve.matrix_world @ Vector(corner) for corner in curve.bound_box]


classes = (MOTUS_OT_path_edit_views,)
