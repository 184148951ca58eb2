"""The panel of a stereo rig: in the sidebar's tab and in the camera's properties."""

import math

from ..core import graph, native, panels, ui
from ..core.lazy import numpy as np
from . import presets, results, rig, rows, screens
from .rig import system
from .solve import depth_of

MOST_RULERS = 3
BAR = 8  # points of the graph that a column of the histogram takes


def draw_main(layout, context):
    """What is wrong, and the eyes."""
    owner = context.object
    ui.draw_problem(layout, context, system(), owner)
    if not rig.renders_both_eyes(context.scene):
        ui.draw_message(layout, rig.one_eye(), 'INFO')
    column = ui.split(layout)
    column.prop(owner.data.stereo, "convergence_mode")
    rows.EYES.draw(column, owner.motus.stereo)
    rows.OBJECT.draw(column, owner.motus.stereo)
    column.prop(owner.data, "angle")
    rows.INFLUENCE.draw(column, owner.motus.stereo)


def draw_screen(layout, context):
    """What the audience looks at."""
    rows.SCREEN.draw(ui.split(layout), context.object.motus.stereo)


def draw_readouts(layout, context):
    """The eyes as they are, parallax of what is selected, and what the last check has found."""
    owner, scene, depsgraph = context.object, context.scene, context.view_layer.depsgraph
    eyes, _ = rig.eyes(scene, owner, depsgraph)
    screen = screens.of(owner.motus.stereo)
    if eyes is not None and screens.is_sound(screen):
        ui.draw_readouts(layout, [*_of_eyes(context, eyes, screen), *_rulers(context, owner, eyes)])
    _draw_check(layout, owner)


def _of_eyes(context, eyes, screen):
    yield ui.Readout(text="Interocular", value=ui.length(context, eyes["interaxial"]))
    if math.isfinite(eyes["convergence"]):
        roundness = native.module.roundness(eyes["convergence"], **eyes, **screen)
        yield ui.Readout(text="Convergence", value=ui.length(context, eyes["convergence"]))
        yield ui.Readout(text="Roundness", value=f"{100.0 * roundness:.0f} %")
    limits = native.module.comfortable_parallax(**screen)
    near, far = native.module.depth_budget(*limits, **eyes)
    yield ui.Readout(text="Safe from", value=ui.length(context, near))
    yield ui.Readout(text="Safe to", value=ui.length(context, far) if math.isfinite(far) else "∞")


def _rulers(context, owner, eyes):
    """Parallax of the objects that are selected beside the camera."""
    matrix, pixels = owner.matrix_world, rig.width_in_pixels(context.scene.render)
    for obj in [obj for obj in context.selected_objects if obj != owner][:MOST_RULERS]:
        depth = depth_of(matrix, obj.matrix_world.translation)
        if depth > 0.0:
            found = native.module.parallax(depth, **eyes)
            yield ui.Readout(text=obj.name, value=f"{100.0 * found:+.2f} %  {pixels * found:+.1f} px")


def _draw_check(layout, owner):
    found = results.of(owner)
    if found is None:
        return
    box = layout.box().column()
    if found.shares.any():
        box.label(text="Parallax of what is seen")
        box.template_icon(graph.icon("stereo", np.repeat(found.shares, BAR)), scale=5.0)
        row = box.row()
        row.label(text=f"{100.0 * found.lowest:+.2f} %", translate=False)
        row.label(text=f"{100.0 * found.highest:+.2f} %", translate=False)
    for sentence in found.sentences:
        ui.draw_message(box, sentence, 'ERROR')


def draw_actions(layout, context):
    """Measuring, checking, output, baking, removing."""
    name = context.object.name
    column = layout.column(align=True)
    column.operator_context = 'INVOKE_DEFAULT'
    column.operator("motus.stereo_measure", icon='DRIVER_DISTANCE').object = name
    column.operator("motus.stereo_check", icon='VIEWZOOM').object = name
    column.operator("motus.stereo_output", icon='OUTPUT').object = name
    ui.draw_bake(column, system())
    column.operator("motus.stereo_rig_remove", text="Remove", icon='X').object = name


def _is_camera(obj):
    return obj.type == 'CAMERA'


PANEL = panels.SystemPanel(
    name="stereo", prefix="MOTUS_PT_stereo", label="Stereo Camera",
    editors={"": ui.Sidebar, "_camera": ui.CameraData},
    suits=_is_camera, is_used=rig.has_rig, draw=draw_main,
    parts=(panels.Part("screen", "Screen", draw_screen, is_open=True),),
    readouts=draw_readouts, actions=draw_actions, refresh="motus.stereo_refresh", presets=presets.PANEL,
    adders=("motus.stereo_rig_add",))

classes = panels.classes(PANEL)
