"""Pictures of assets, drawn by a 3D viewport: from the side that it shows, near the owner, or just as it is."""

import bpy
from mathutils import Vector

from ..view import framing, viewports

SIZE = 256
"""Width and height in pixels."""
_LEFT_OUT = (
    "show_floor",
    "show_ortho_grid",
    "show_axis_x",
    "show_axis_y",
    "show_axis_z",
    "show_cursor",
    "show_text",
    "show_relationship_lines",
)
"""Overlays of the viewport that are no part of a picture."""


def draw(context, owner, is_framed):
    """Draw a picture of an owner; returns its RGBA values from the lower left, or None if there is no viewport.

    is_framed: whether the picture shows the owner, and not the viewport's middle.
    """
    space = None if bpy.app.background else viewports.space_for(context)
    area = space and next((area for area in context.window.screen.areas if area.spaces.active == space), None)
    if area is None:
        return None
    region = next(region for region in area.regions if region.type == 'WINDOW')
    matrices = _framed(space.region_3d, owner) if is_framed else _middle(space.region_3d, region)
    overlay = space.overlay
    before = {name: getattr(overlay, name) for name in _LEFT_OUT}
    try:
        for name in _LEFT_OUT:
            setattr(overlay, name, False)
        return _drawn(context, space, region, matrices)
    finally:
        for name, value in before.items():
            setattr(overlay, name, value)


def _framed(view, owner):
    seen = owner.evaluated_get(bpy.context.evaluated_depsgraph_get())
    corners = [seen.matrix_world @ Vector(corner) for corner in seen.bound_box]
    if max((corner - corners[0]).length for corner in corners) < 1e-6:
        reach = max(seen.empty_display_size, 1e-3) if seen.type == 'EMPTY' else 1.0
        corners = [seen.matrix_world.translation + reach * Vector(corner) for corner in ((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0))]
    return framing.camera(view.view_matrix.to_quaternion().inverted(), corners, 1.0)


def _middle(view, region):
    """Matrices of the square in the middle of a viewport."""
    projection = view.window_matrix.copy()
    shorter = min(region.width, region.height)
    projection[0] *= region.width / shorter
    projection[1] *= region.height / shorter
    return view.view_matrix, projection


def _drawn(context, space, region, matrices):
    import gpu

    buffer = gpu.types.GPUOffScreen(SIZE, SIZE)
    try:
        buffer.draw_view3d(context.scene, context.view_layer, space, region, *matrices, do_color_management=True)
        with buffer.bind():
            values = gpu.state.active_framebuffer_get().read_color(0, 0, SIZE, SIZE, 4, 0, 'FLOAT')
    finally:
        buffer.free()
    values.dimensions = 4 * SIZE * SIZE  # type: ignore[assignment]
    return values


def give(holder, values):
    """Make a picture the preview of an asset. holder: the asset. values: from draw()."""
    preview = holder.preview_ensure()
    preview.image_size = SIZE, SIZE
    preview.image_pixels_float.foreach_set(values)
