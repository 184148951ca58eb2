"""One draw handler for all systems: each gives batches of lines and points for a selected object."""

import logging
from typing import Any, NamedTuple

import bpy

from . import capabilities, native
from .system import registered

log = logging.getLogger(__name__)

classes = ()


class Batch(NamedTuple):
    """Lines or points in world space.

    kind: 'LINES' (pairs), 'LINE_STRIP' or 'POINTS'. points: (n, 3) float32. colors: one (r, g, b, a), or (n, 4) float32
    for lines. width: pixels.
    """

    kind: str
    points: Any
    colors: Any
    width: float = 1.0


_handler = []
_failed = set()


def register():
    """Start drawing."""
    _handler.append(bpy.types.SpaceView3D.draw_handler_add(_draw, (), 'WINDOW', 'POST_VIEW'))


def unregister():
    """Stop drawing."""
    _failed.clear()
    while _handler:
        bpy.types.SpaceView3D.draw_handler_remove(_handler.pop(), 'WINDOW')


def batches(context):
    """All batches for the context's selection."""
    owners = {found.name_full: found for found in [context.object, *context.selected_objects] if found}
    return [batch for system in registered.values() if system.overlay
            for owner in owners.values() for batch in system.overlay(context, owner)]


def _draw():
    context = bpy.context
    if native.module is None or not context.scene.motus.show_overlay or not context.space_data.overlay.show_overlays:
        return
    try:
        found = batches(context)
    except Exception as error:
        # Drawn at every redraw: said once, not sixty times a second.
        if repr(error) not in _failed:
            _failed.add(repr(error))
            log.exception("Motus: the overlay could not be computed")
        return
    _draw_batches(context, found)


def _draw_batches(context, found):
    import gpu

    gpu.state.blend_set('ALPHA')
    gpu.state.depth_test_set('LESS_EQUAL')
    scale = context.preferences.system.pixel_size
    for batch in found:
        if batch.kind == 'POINTS':
            _draw_points(batch, scale)
        else:
            _draw_lines(context, batch, scale)
    gpu.state.depth_test_set('NONE')
    gpu.state.blend_set('NONE')


def _draw_points(batch, scale):
    import gpu
    from gpu_extras.batch import batch_for_shader

    shader = gpu.shader.from_builtin(capabilities.point_shader())
    shader.bind()
    shader.uniform_float("color", batch.colors)
    gpu.state.point_size_set(batch.width * scale)
    batch_for_shader(shader, 'POINTS', {"pos": batch.points}).draw(shader)
    gpu.state.point_size_set(1.0)


def _draw_lines(context, batch, scale):
    import gpu
    from gpu_extras.batch import batch_for_shader

    is_uniform = isinstance(batch.colors, tuple)
    shader = gpu.shader.from_builtin(capabilities.line_shader(is_uniform))
    shader.bind()
    shader.uniform_float("viewportSize", (context.region.width, context.region.height))
    shader.uniform_float("lineWidth", batch.width * scale)
    content = {"pos": batch.points}
    if is_uniform:
        shader.uniform_float("color", batch.colors)
    else:
        content["color"] = batch.colors
    batch_for_shader(shader, batch.kind, content).draw(shader)
