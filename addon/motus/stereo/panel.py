"""Panel of a stereo rig, in the sidebar and in the camera's properties."""

import math

from ..core import native
from ..core.interface import panels, ui
from ..core.interface.view import graph
from ..core.lazy import numpy as np
from ..core.translations import tr
from . import around, presets, results, rig, rows, screens, viewing
from .rig import system
from .solve import depth_of

MOST_RULERS = 3
BAR = 8  # points of the graph for each column of the histogram
POINTS = 128  # of a graph over frames


def draw_main(layout, context):
    """Draw the solver's error message, and the settings of the rig's eyes."""
    owner = context.object
    ui.draw_problem(layout, context, system(), owner)
    if not rig.renders_both_eyes(context.scene):
        ui.draw_message(layout, rig.one_eye(), 'INFO')
    column = ui.split(layout)
    column.prop(owner.data.stereo, "convergence_mode")
    rows.EYES.draw(column, owner.motus.stereo)
    if owner.motus.stereo.convergence == 'BUDGET':
        button = layout.row()
        button.operator_context = 'INVOKE_DEFAULT'
        button.operator("motus.stereo_measure", icon='DRIVER_DISTANCE').object = owner.name
        column = ui.split(layout)
    rows.OBJECT.draw(column, owner.motus.stereo)
    column.prop(owner.data, "angle")
    rows.INFLUENCE.draw(column, owner.motus.stereo)


def draw_screen(layout, context):
    """Draw the settings of the screen that the audience looks at."""
    settings = context.object.motus.stereo
    rows.SCREEN.draw(ui.split(layout), settings)
    if settings.convergence == 'BUDGET':
        layout.row().operator("motus.stereo_fit", icon='FULLSCREEN_EXIT').object = context.object.name


def draw_window(layout, context):
    """Draw the settings of the floating window."""
    rows.WINDOW.draw(ui.split(layout), context.object.motus.stereo)
    row = layout.row()
    row.operator_context = 'INVOKE_DEFAULT'
    row.operator("motus.stereo_window", icon='MOD_MASK').object = context.object.name


def draw_readouts(layout, context):
    """Draw the present eye distances, the parallax of the selected objects, and the result of the last check."""
    owner, scene, depsgraph = context.object, context.scene, context.view_layer.depsgraph
    eyes, _ = rig.eyes(scene, owner, depsgraph)
    settings = owner.motus.stereo
    screen = screens.of(settings)
    if eyes is not None and screens.is_sound(screen):
        ui.draw_readouts(layout, [*_of_eyes(context, settings, eyes, screen), *_rulers(context, owner, eyes)])
        if settings.convergence == 'BUDGET':
            _draw_strain(layout, settings, screen)
    if around.is_used(owner.data):
        _draw_around(layout, context, owner)
    _draw_check(layout, context, owner, screen)


def _of_eyes(context, settings, eyes, screen):
    """Return read-outs of the eye distances that the solver has computed, unless a setting shows them already."""
    if settings.convergence == 'BUDGET':
        yield ui.Readout(text="Interocular", value=ui.length(context, eyes["interaxial"]))
    if math.isfinite(eyes["convergence"]):
        roundness = native.module.roundness(eyes["convergence"], **eyes, **screen)
        if settings.convergence != 'DISTANCE':
            yield ui.Readout(text="Convergence", value=ui.length(context, eyes["convergence"]))
        yield ui.Readout(text="Roundness", value=f"{100.0 * roundness:.0f} %")
    limits = native.module.comfortable_parallax(**screen)
    near, far = native.module.depth_budget(*limits, **eyes)
    yield ui.Readout(text="Safe from", value=ui.length(context, near))
    yield ui.Readout(text="Safe to", value=ui.length(context, far) if math.isfinite(far) else "∞")


def _draw_strain(layout, settings, screen):
    """Draw a warning if the rig's depth budget is uncomfortable on the audience's screen."""
    limits = [100.0 * limit for limit in native.module.comfortable_parallax(**screen)]
    if any(mine > limit for mine, limit in zip((settings.near_parallax, settings.far_parallax), limits)):
        near, far = (f"{limit:.2f}" for limit in limits)
        sentence = tr("The budget strains the eyes: on this screen {near} % in front and {far} % behind are comfortable")
        ui.draw_message(layout, sentence.format(near=near, far=far), 'ERROR')


def _rulers(context, owner, eyes):
    """Return read-outs of the parallax of the selected objects, the camera excepted."""
    matrix, pixels = owner.matrix_world, rig.width_in_pixels(context.scene.render)
    for obj in [obj for obj in context.selected_objects if obj != owner][:MOST_RULERS]:
        depth = depth_of(matrix, obj.matrix_world.translation)
        if depth > 0.0:
            found = native.module.parallax(depth, **eyes)
            yield ui.Readout(text=obj.name, value=f"{100.0 * found:+.2f} %  {pixels * found:+.1f} px")


def _draw_around(layout, context, owner):
    """Draw what a stereo panorama has as parallax for the selected objects, and a warning about headsets."""
    camera = owner.evaluated_get(context.view_layer.depsgraph).data
    eyes, pixels = around.eyes(camera), rig.width_in_pixels(context.scene.render) / around.width(camera)
    found = []
    for obj in [obj for obj in context.selected_objects if obj != owner][:MOST_RULERS]:
        place = rig.axis_matrix(owner.matrix_world) @ obj.matrix_world.translation
        distance = place.length
        if distance > 0.5 * eyes["interaxial"]:
            parallax = native.module.parallax_around(distance, elevation=math.asin(place.y / distance), **eyes)
            found.append(ui.Readout(text=obj.name, value=f"{math.degrees(parallax):+.2f}°  {pixels * parallax:+.1f} px"))
    ui.draw_readouts(layout, found)
    if math.isfinite(eyes["convergence"]):
        sentence = tr("In a headset the eyes turn apart for what is beyond {distance}; Parallel avoids that")
        ui.draw_message(layout, sentence.format(distance=ui.length(context, eyes["convergence"])), 'INFO')


def _draw_check(layout, context, owner, screen):
    found = results.of(owner)
    if found is None:
        return
    box = layout.box().column()
    if found.shares.any():
        box.label(text="Measured Parallax")
        box.template_icon(graph.icon("stereo", np.repeat(found.shares, BAR)), scale=5.0)
        row = box.row()
        row.label(text=f"{100.0 * found.lowest:+.2f} %", translate=False)
        row.label(text=f"{100.0 * found.highest:+.2f} %", translate=False)
    for sentence in found.sentences:
        ui.draw_message(box, sentence, 'ERROR')
    if found.verdict:
        ui.draw_message(box, found.verdict, 'CHECKMARK')
    if len(found.frames) > 1:
        _draw_over_frames(box, context, found, screen)
        if owner.motus.stereo.convergence == 'BUDGET':
            button = box.row().operator("motus.stereo_measure", text="Key Shot", icon='DECORATE_KEYFRAME')
            button.object, button.frame_start, button.frame_end = owner.name, round(found.frames[0]), round(found.frames[-1])


def _ticks(low, high, least):
    """Heights of a graph of values from low to high that are at least so far apart that their texts differ. least: range of the graph."""
    wider = 0.5 * max(least - (high - low), 0.0)
    return graph.ticks(low - wider, high + wider)


def _draw_over_frames(box, context, found, screen):
    """Draw graphs of a check's frames: the farthest and nearest parallax with the screen's limits, and the convergence distance.

    Frames with a fault are red.
    """
    first, last = found.frames[0], found.frames[-1]
    frames = np.linspace(first, last, POINTS)
    flags = found.is_faulty[np.abs(frames[:, None] - found.frames).argmin(axis=1)]
    columns = [f"{frame:.5g}" for frame in (first, (first + last) / 2.0, last)]
    nearest, farthest, convergence = (np.interp(frames, found.frames, one) for one in (found.nearest, found.farthest, found.convergence))
    heights = {one: f"{100.0 * one:+.2f} %" for one in _ticks(nearest.min(), farthest.max(), results.NARROWEST)}
    near, far = native.module.comfortable_parallax(**screen) if screens.is_sound(screen) else (math.inf, math.inf)
    limits = [np.full(POINTS, one) for one in (-near, far) if min(heights) <= one <= max(heights)]
    box.label(text="Parallax over Frames")
    graph.draw(box, "stereo_parallax", farthest, heights, columns, (nearest, *limits), flags)
    if np.isfinite(convergence).all():
        heights = {one: ui.length(context, one) for one in _ticks(convergence.min(), convergence.max(), 0.1 * convergence.max())}
        box.label(text="Convergence over Frames")
        graph.draw(box, "stereo_convergence", convergence, heights, columns, (), flags)


def draw_actions(layout, context):
    """Draw the buttons that show the anaglyph view, check the frames, set the output, bake the rig, and remove it."""
    name = context.object.name
    column = layout.column(align=True)
    column.operator_context = 'INVOKE_DEFAULT'
    column.operator("motus.stereo_view", icon='CAMERA_STEREO', depress=viewing.is_shown(context, context.object)).object = name
    column.operator("motus.stereo_check", icon='VIEWZOOM').object = name
    column.operator_menu_enum("motus.stereo_output", "format", icon='OUTPUT').object = name
    if rig.writes_pair(context.scene):
        column.operator("motus.stereo_combine", icon='COLOR').object = name
    ui.draw_bake(column)
    column.operator("motus.stereo_rig_remove", text="Remove", icon='X').object = name


PANEL = panels.SystemPanel(
    name="stereo",
    prefix="MOTUS_PT_stereo",
    label="Stereo Camera",
    editors={"": ui.Sidebar, "_camera": ui.CameraData},
    suits=lambda obj: True,
    is_used=rig.has_rig,
    draw=draw_main,
    parts=(panels.Part("screen", "Screen", draw_screen, is_open=True), panels.Part("window", "Floating Window", draw_window)),
    readouts=draw_readouts,
    actions=draw_actions,
    refresh=panels.REFRESH,
    presets=presets.PANEL,
    adders=("motus.stereo_rig_add",),
)

classes = panels.classes(PANEL)
