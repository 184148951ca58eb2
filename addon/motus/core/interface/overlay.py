"""Viewport overlay of all systems: each system draws lines and points for selected objects, and a sentence for the active object."""

import logging
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import bpy

from .. import native
from ..bake import state
from ..blender import capabilities
from ..declare import registered
from .view import drawing

log = logging.getLogger(__name__)


class MOTUS_PG_scene(bpy.types.PropertyGroup):
    """Settings of a scene: switches of the viewport overlay, and settings of the systems' tools; registration adds both."""

    show_overlay: bpy.props.BoolProperty(
        name="Overlay", description="Show what the systems compute in the viewport", default=True, options=set()
    )


classes = (MOTUS_PG_scene,)


class Batch(NamedTuple):
    """Lines or points to be drawn in world space.

    kind: 'LINES' (pairs of points), 'LINE_STRIP' or 'POINTS'. points: (n, 3) float32. colors: one (r, g, b, a) tuple for all, or (n, 4)
    float32 for the points of lines. width: of the lines or points in pixels.
    """

    kind: str
    points: Any
    colors: Any
    width: float = 1.0


class Switch(NamedTuple):
    """Declaration of a switch that hides a part of a system's overlay: the boolean property Scene.motus.<name>."""

    name: str
    label: str
    description: str
    default: bool = True


@dataclass(frozen=True)
class Overlay:
    """Declaration of a system's viewport overlay. draw(context, owner): returns the Batches for a selected object.

    note(context, owner): returns a sentence that the viewport shows while the object is the active one, or "". switches: the Switches of
    parts of the overlay.
    """

    draw: Callable
    switches: tuple = ()
    note: Callable | None = None

    def __call__(self, context, owner):
        return self.draw(context, owner)


def switch_of(system):
    """Name of the boolean property of Scene.motus that shows or hides the whole overlay of a system."""
    return f"show_{system.name}"


def switches_of(system):
    """The Switches that a system's overlay declares for its parts; an empty tuple if there are none."""
    return getattr(system.overlay, "switches", ())


def properties_of(system):
    """{name: BoolProperty} that Scene.motus gets for a system's overlay; {} if the system has no overlay."""
    if system.overlay is None:
        return {}
    found = {
        switch_of(system): bpy.props.BoolProperty(
            name="Show", description="Draw in the viewport what this system computes for the selected objects", default=True, options=set()
        )
    }
    for switch in switches_of(system):
        found[switch.name] = bpy.props.BoolProperty(
            name=switch.label, description=switch.description, default=switch.default, options=set()
        )
    return found


NOTE_HEIGHT = 24.0
"""Height of the lowest note above the viewport's lower edge, and of each further line, in pixels at an interface scale of 1."""

_handler = []
_failed = set()


def register():
    """Add the viewport draw handlers that draw the overlays of all systems and their notes (sentences about the active object)."""
    for function, kind in ((_draw, 'POST_VIEW'), (_draw_notes, 'POST_PIXEL')):
        _handler.append(bpy.types.SpaceView3D.draw_handler_add(function, (), 'WINDOW', kind))


def unregister():
    """Remove the viewport draw handlers of the overlays and notes."""
    _failed.clear()
    while _handler:
        bpy.types.SpaceView3D.draw_handler_remove(_handler.pop(), 'WINDOW')


def batches(context):
    """List of the Batches that the switched-on overlays draw for the active and the selected objects.

    No Batch is computed for an object on which the system is baked.
    """
    owners = {found.name_full: found for found in [context.object, *context.selected_objects] if found}
    return [
        batch
        for system in _switched_on(context)
        for owner in owners.values()
        if not state.is_baked(system, owner)
        for batch in system.overlay(context, owner)
    ]


def notes(context):
    """List of the sentences that systems' overlays show about the active object, in the user's language."""
    found = [
        system.overlay.note(context, context.object)
        for system in _switched_on(context)
        if context.object and getattr(system.overlay, "note", None)
    ]
    return [bpy.app.translations.pgettext_tip(sentence) for sentence in found if sentence]


def is_shown(context, system):
    """Whether the context's viewport draws the overlay of a system."""
    return _is_on(context) and system in _switched_on(context)


def _is_on(context):
    return native.module is not None and context.scene.motus.show_overlay and context.space_data.overlay.show_overlays


def _switched_on(context):
    return [system for system in registered.values() if system.overlay and getattr(context.scene.motus, switch_of(system))]


def _draw():
    _draw_found(batches, _draw_batches)


def _draw_notes():
    _draw_found(notes, _draw_texts)


def _draw_found(find, draw):
    context = bpy.context
    if not _is_on(context):
        return
    try:
        found = find(context)
    except Exception as error:
        # The overlay is drawn at every redraw. An error is logged once, not sixty times a second.
        if repr(error) not in _failed:
            _failed.add(repr(error))
            log.exception("Motus: the overlay could not be computed")
        return
    draw(context, found)


def _draw_texts(context, lines):
    scale = context.preferences.system.ui_scale
    for index, content in enumerate(reversed(lines)):
        left = (context.region.width - drawing.width(content, scale)) / 2.0
        drawing.text([content], left, (1.0 + index) * NOTE_HEIGHT * scale, scale)


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
