"""Draw the cursor of Pick & Pull: a circle on the surface, shaded by the falloff, with the bump that one dab would make.

The cursor is drawn while the tool is active or a session runs. It is drawn over the viewport without redrawing the viewport
(WindowManager.draw_cursor_add).
"""

import logging

import bpy
from bpy.app.handlers import persistent

from ...core import native
from ...core.blender import handlers
from ...core.interface.view import drawing
from ...core.interface.view.viewports import View
from ...core.lazy import numpy as np
from ...core.refusals import Refused
from ..brush import AXIS_INDEX, Brush
from . import cursor_shape, hover, inset, stage, status

log = logging.getLogger(__name__)

classes = ()

UP = (1.0, 0.56, 0.16)
DOWN = (0.28, 0.62, 1.0)
SMOOTHING = (0.45, 0.85, 0.4)
AXIS_COLORS = ((0.96, 0.2, 0.32), (0.53, 0.84, 0.01), (0.16, 0.56, 1.0))
AXIS_LENGTH = 4.0
"""Length of the drawn axis from the pulled vertex to either side, as a multiple of the brush's reach."""
SHADE = 0.4
"""Opacity of the cursor's shading at a point where the force is 1."""
MOST_DOTS = 6000
DOT_SIZE = 5.0
LEAST_DOT_SIZE = 2.0
DOTS_APART = 2.0
"""Least mean distance between dots, as a multiple of a dot's size, so that the surface stays visible between them."""
DOT_OPACITY = 0.85
WAITING_SIZE = 6.0

_handle = []
_failed = set()


def register():
    """Start drawing the cursor of Pick & Pull over all viewports."""
    handlers.add(_watchers())
    _start()


def unregister():
    """Stop drawing the cursor of Pick & Pull."""
    handlers.remove(_watchers())
    _stop()


def _watchers():
    return ((bpy.app.handlers.load_post, _renew),)


def _start():
    _handle.append(bpy.types.WindowManager.draw_cursor_add(_draw, (), 'VIEW_3D', 'WINDOW'))


def _stop():
    _failed.clear()
    while _handle:
        bpy.types.WindowManager.draw_cursor_remove(_handle.pop())


@persistent
def _renew(*_arguments):
    # Blender drops the cursors of add-ons when it opens a file.
    _stop()
    _start()


def _draw(place):
    context = bpy.context
    if native.module is None or context.region is None or context.region_data is None:
        return
    try:
        _draw_in(context, View(context.area, context.region, context.region_data), place)
    except (ReferenceError, Refused):
        hover.drop()
    except Exception as error:
        # The cursor is drawn at every movement of the mouse, so that the error is printed once.
        if repr(error) not in _failed:
            _failed.add(repr(error))
            log.exception("Motus: the cursor could not be drawn")


def _draw_in(context, view, place):
    import gpu

    pulling, dragged = stage.current(), None
    if pulling is None:
        session = hover.session(context)
        if session is None:
            return
        session.brush = Brush.of(context.scene.motus.pull)
        hit, color = session.pick(*view.ray(*place)), UP
    elif pulling.adjustment is not None:
        session, hit, color = pulling.session, pulling.adjustment.hit, UP
        if view.region != pulling.adjustment.view.region:
            return
    else:
        session, stroke = pulling.session, pulling.stroke
        hit, dragged = stroke.cursor(session, view, place) if stroke else (session.pick(*view.ray(*place)), None)
        is_down = pulling.sign < 0.0 and session.brush.direction != 'CURSOR'
        color = SMOOTHING if stroke and pulling.is_smooth else DOWN if is_down else UP
    if context.scene.motus.pull.show_inset:
        inset.start()
    gpu.state.blend_set('ALPHA')
    scale = context.preferences.system.ui_scale
    if hit is None:
        _draw_cross(place, context.preferences.system.pixel_size)
    else:
        sign = pulling.sign if pulling is not None and pulling.is_stroking else 1.0
        displacement = _displacement(session, hit, sign, view) if dragged is None else np.array(dragged)
        if pulling is not None and pulling.is_dragging:
            _draw_axis(view, pulling, context.preferences.system.pixel_size)
        _draw_brush(context, view, session, hit, color, displacement)
        adjusted = pulling.adjustment if pulling is not None else None
        _draw_text(context, session.brush, adjusted, place, scale)
    gpu.state.blend_set('NONE')


def _draw_cross(place, pixel):
    size = WAITING_SIZE * pixel
    for dx, dy in ((size, 0.0), (0.0, size)):
        drawing.line([(place[0] - dx, place[1] - dy), (place[0] + dx, place[1] + dy)], (1.0, 1.0, 1.0, 0.7), pixel)


def _draw_axis(view, pulling, pixel):
    brush = pulling.brush
    ends = pulling.stroke.axis_line(AXIS_LENGTH * (1.0 if brush.distance == 'EDGES' else brush.reach_of(brush.radius)))
    if ends is not None:
        _line(view, np.array(ends), (*AXIS_COLORS[AXIS_INDEX[pulling.stroke.axis]], 0.9), pixel)


def _draw_brush(context, view, session, hit, color, displacement):
    brush, pixel = session.brush, context.preferences.system.pixel_size
    matrix = view.data.perspective_matrix
    center = np.array(hit.point)
    if brush.distance != 'STRAIGHT':
        _draw_dots(view, session, hit, color, pixel)
    if brush.distance != 'EDGES':
        axes = cursor_shape.frame(hit.normal, session.space.linear if brush.unit == 'LOCAL' else None)
        if brush.distance == 'STRAIGHT':
            _draw_disc(view, matrix, cursor_shape.disc(center, axes, brush), color)
        across = np.array(view.data.view_rotation.to_matrix().col[0])
        rim = cursor_shape.circle(center, axes, brush.reach_of(brush.radius))
        _line(view, rim, (0.0, 0.0, 0.0, 0.45), 3.5 * pixel)
        _line(view, rim, (*color, 1.0), 1.75 * pixel)
        _line(view, cursor_shape.bump(center, axes, brush, displacement, across), (1.0, 1.0, 1.0, 0.85), 1.25 * pixel)
    _line(view, np.stack([center, center + displacement]), (1.0, 1.0, 1.0, 0.95), 2.0 * pixel)


def _displacement(session, hit, sign, view):
    try:
        return np.array(session.displacement(hit.vertex, sign, view.toward_viewer()))
    except Refused:
        return np.zeros(3)  # the stroke reports why nothing can be pulled; in a drag the mouse gives the direction


def _draw_disc(view, matrix, shape, color):
    points, forces, triangles = shape
    places = drawing.to_window(view.region, matrix, points)
    if places is not None:
        drawing.triangles(places, _shades(forces, color), triangles)


def _draw_dots(view, session, hit, color, size):
    """Draw a dot on each vertex that a dab would move; leave out vertices evenly if they are dense on the screen.

    size: factor on the size of a dot in pixels.
    """
    indices, forces = session.forces(hit.vertex)
    step = len(indices) // MOST_DOTS + 1
    places = drawing.to_window(view.region, view.data.perspective_matrix, np.asarray(session.world_positions(indices[::step]), float))
    if places is None:
        return
    forces = forces[::step]
    step, size = cursor_shape.thinned(places, LEAST_DOT_SIZE * size, DOT_SIZE * size, DOTS_APART)
    # The opacity of a moving vertex is not below this, so that it differs from vertices that stay.
    drawing.dots(places[::step], _shades(0.2 + 0.8 * forces[::step], color, DOT_OPACITY), size)


def _shades(forces, color, opacity=SHADE):
    colors = np.empty((len(forces), 4), np.float32)
    colors[:, :3] = color
    colors[:, 3] = opacity * np.clip(forces, 0.0, 1.0)
    return colors


def _line(view, points, color, width):
    places = drawing.to_window(view.region, view.data.perspective_matrix, points)
    if places is not None:
        drawing.line(places, color, width)


def _draw_text(context, brush, adjustment, place, scale):
    adjusted, entry = (adjustment.name, adjustment.entry) if adjustment is not None else (None, None)
    lines = [status.pair(context, brush, name, entry if name == adjusted else None) for name in status.numbers(brush, adjusted)]
    drawing.text(lines, place[0] + 22.0 * scale, place[1] - 26.0 * scale, scale)
