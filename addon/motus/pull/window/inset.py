"""Perspective view from a different side, drawn in the corner of the viewport while a mesh is pulled."""

import logging
import math

import bpy
from mathutils import Vector

from ...core import native
from ...core.blender import capabilities
from ...core.interface.view import drawing, framing, viewports
from . import hover, stage

log = logging.getLogger(__name__)

classes = ()

SHARE = 0.3
"""Width of the inset view, as a share of the viewport's width."""
ASPECT = 1.5
MARGIN = 12.0
FRAME = (0.9, 0.9, 0.9, 0.8)
TURN = math.radians(90.0)
"""Angle about the vertical axis between the inset's view and the viewport's view."""
RISE = math.radians(25.0)
"""Elevation of the inset's view above the horizon; larger if the viewport looks from straight above or below."""
SMALLEST = 96
SIDES = {'UI', 'TOOLS'}
SHELVES = {'ASSET_SHELF', 'ASSET_SHELF_HEADER'}

_handle = []
_buffers = {}
_failed = set()


def start():
    """Start drawing the inset view.

    A timer redraws the viewports: start() is called while the cursor is drawn, when tagging a viewport for redraw has no effect.
    """
    if not _handle:
        _handle.append(bpy.types.SpaceView3D.draw_handler_add(_draw, (), 'WINDOW', 'POST_PIXEL'))
        bpy.app.timers.register(viewports.redraw)


def stop():
    """Stop drawing the inset view, and free its buffers."""
    while _handle:
        bpy.types.SpaceView3D.draw_handler_remove(_handle.pop(), 'WINDOW')
    for buffer in _buffers.values():
        buffer.free()
    _buffers.clear()
    _failed.clear()


def rectangle(region, others=()):
    """Rectangle (x, y, width, height) of the inset view in a region, in pixels; None if there is no room.

    others: regions of the area. The inset avoids sidebars and shelves that overlap the region.
    """
    left, right, bottom = _free(region, others)
    width = int((right - left) * SHARE)
    height = int(width / ASPECT)
    if width < SMALLEST or height > (region.height - bottom) // 2:
        return None
    return int(right - width - MARGIN), int(bottom + MARGIN), width, height


def _free(region, others):
    """(left, right, bottom) edges, in pixels, of the part of a region that no sidebar or shelf overlaps."""
    left, right, bottom = 0, region.width, 0
    for other in others:
        x, y = other.x - region.x, other.y - region.y
        is_over = (
            min(other.width, other.height) > 1 and x < region.width and y < region.height and x + other.width > 0 and (y + other.height > 0)
        )
        if not is_over:
            continue
        if other.type in SIDES and x > region.width // 2:
            right = min(right, x)
        elif other.type in SIDES:
            left = max(left, x + other.width)
        elif other.type in SHELVES:
            bottom = max(bottom, y + other.height)
    return left, right, bottom


def camera(view_rotation, corners, aspect):
    """Return (view matrix, projection matrix) of the inset view.

    The view is from a different side than the viewport's, and as near as possible with all corners of a box in the picture. view_rotation:
    quaternion of the viewport. corners: world positions. aspect: width / height of the picture.
    """
    backward = view_rotation @ Vector((0.0, 0.0, 1.0))
    right = view_rotation @ Vector((1.0, 0.0, 0.0))
    # Measure the angle from the screen's right axis, which is horizontal in a view from above too.
    azimuth = math.atan2(right.y, right.x) - math.pi / 2.0 + TURN
    is_level = abs(backward.z) < 0.9
    rise = RISE if is_level else 1.4 * RISE
    toward = Vector((math.cos(rise) * math.cos(azimuth), math.cos(rise) * math.sin(azimuth), math.sin(rise)))
    return framing.camera(toward.to_track_quat('Z', 'Y'), corners, aspect)


def _is_wanted(context):
    if native.module is None or context.object is None or not context.scene.motus.pull.show_inset:
        return False
    return stage.current() is not None or hover.is_tool_active(context)


def _draw():
    context = bpy.context
    if not _is_wanted(context):
        return
    place = rectangle(context.region, context.area.regions)
    if place is None:
        return
    try:
        _draw_view(context, place)
    except Exception as error:
        # The graphics driver may refuse; the error is printed once, and the session goes on without an inset.
        if repr(error) not in _failed:
            _failed.add(repr(error))
            log.exception("Motus: the inset view could not be drawn")


def _draw_view(context, place):
    import gpu
    from gpu_extras.presets import draw_texture_2d

    x, y, width, height = place
    viewport = gpu.state.active_framebuffer_get()
    buffer = _buffer(width, height)
    corners = [context.object.matrix_world @ Vector(corner) for corner in context.object.bound_box]
    matrices = camera(context.region_data.view_rotation, corners, width / height)
    buffer.draw_view3d(
        context.scene,
        context.view_layer,
        context.space_data,
        context.region,
        *matrices,
        do_color_management=capabilities.has_textures_in_display_colors(),
    )
    # Creating a buffer leaves the window's frame buffer bound; Blender then draws the viewport over the inset.
    with viewport.bind():  # type: ignore[func-returns-value]
        gpu.state.depth_mask_set(False)
        gpu.state.blend_set('NONE')
        draw_texture_2d(buffer.texture_color, (x, y), width, height)
        gpu.state.blend_set('ALPHA')
        corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y)]
        drawing.line(corners, FRAME, 1.5 * context.preferences.system.pixel_size)
        gpu.state.blend_set('NONE')
        gpu.state.depth_mask_set(True)


def _buffer(width, height):
    """Off-screen buffer of the inset's picture, cached for each size, since only few sizes occur."""
    import gpu

    if (width, height) not in _buffers:
        if len(_buffers) >= 4:
            _buffers.pop(next(iter(_buffers))).free()
        _buffers[width, height] = gpu.types.GPUOffScreen(width, height)
        # A buffer that was created while Blender draws shows nothing in that redraw.
        bpy.app.timers.register(viewports.redraw)
    return _buffers[width, height]
