"""The panel of a pendulum, in the sidebar and in the constraint properties of its pivot, rods and bobs."""

import math

from ..core import native, wiring
from ..core.declare import Problem
from ..core.interface import panels, ui
from ..core.interface.tracks import panel as track_panel
from . import parts, pivot_motion, plots, presets, rows, solve, trail
from .build import system

STRAY = Problem("A copy of a rod, or one without its pivot: it hangs on another pendulum", blocking=False)


def _pivot(context):
    return parts.pivot_of(context.object)


def draw_main(layout, context):
    """Draw the pendulum's problem if there is one, and its settings; for a rod or bob also the name of its pivot."""
    pivot = _pivot(context)
    if pivot is None:
        ui.draw_message(layout, STRAY.sentence, 'INFO')
        layout.operator("motus.pendulum_remove", text="Remove", icon='X').object = context.object.name
        return
    if pivot != context.object:
        box = layout.box().column()
        box.label(text=pivot.name, icon='LINKED', translate=False)
        box.operator("motus.pendulum_select_pivot", icon='RESTRICT_SELECT_OFF')
    ui.draw_problem(layout, context, system(), pivot)
    rows.SWING.draw(ui.split(layout), pivot.motus.pendulum)


def draw_forces(layout, context):
    """Draw the forces that act on the bobs."""
    pivot = _pivot(context)
    settings = pivot.motus.pendulum
    rows.FORCES.draw(ui.split(layout), settings)
    if settings.use_pivot_motion:
        track_panel.draw(layout, pivot_motion.track(pivot, context.scene), datablock=pivot.name)


def draw_time(layout, context):
    """Draw the settings of when and how fast the pendulum swings."""
    rows.TIME.draw(ui.split(layout), _pivot(context).motus.pendulum)


def draw_trail(layout, context):
    """Draw the settings of the pendulum's trail, or the button that adds a trail."""
    pivot = _pivot(context)
    obj = parts.own_trail(pivot)
    if obj is None:
        layout.operator("motus.pendulum_trail_add", icon='ADD').object = pivot.name
        return
    ui.draw_problem(layout, context, trail.system(), obj)
    rows.TRAIL.draw(ui.split(layout), obj.motus.pendulum_trail)
    layout.operator("motus.pendulum_trail_remove", icon='X').object = pivot.name


def draw_plots(layout, context):
    """Draw the choice of a plot, and the plot of the pendulum's motion."""
    pivot = _pivot(context)
    layout.row(align=True).prop(pivot.motus.pendulum, "plot", expand=True)
    plots.draw(layout, context, pivot)


def draw_readouts(layout, context):
    """Draw the pendulum's angles and time at the present frame, and its period."""
    pivot, depsgraph = _pivot(context), context.view_layer.depsgraph
    settings = pivot.motus.pendulum
    values = {name: wiring.output(system(), pivot, name, depsgraph) for name in ("angle1", "angle2", "seconds")}
    if None in values.values():
        return
    has_two = parts.rods_each(settings) == 2
    found = [ui.Readout(text="Upper Angle" if has_two else "Angle", value=_degrees(values["angle1"]))]
    if has_two:
        found.append(ui.Readout(text="Lower Angle", value=_degrees(values["angle2"])))
    if settings.kind == 'SPHERICAL':
        found.append(ui.Readout(text="Heading", value=_degrees(values["angle2"])))
    found.append(ui.Readout(text="Time", value=f"{values['seconds']:.3f} s"))
    period = _period(settings, context.scene)
    if period is not None:
        found.append(ui.Readout(text="Period", value=f"{period:.4f} s"))
    ui.draw_readouts(layout, found)


def _degrees(angle):
    return f"{math.degrees(angle):.2f}°"


def _period(settings, scene):
    """Return the period of a single pendulum without damping, in s; None for a double or damped pendulum and for an infinite period."""
    if settings.kind != 'SINGLE' or settings.damping > 0.0 or not settings.length1 > 0.0:
        return None
    gravity = max(solve.gravity_of(settings, scene), 0.0)
    period = native.module.pendulum_period(settings.angle1, settings.velocity1, settings.length1, gravity)
    return period if math.isfinite(period) else None


def draw_actions(layout, context):
    """Draw the buttons that play, drag, bake and remove the pendulum."""
    pivot = _pivot(context)
    column = layout.column(align=True)
    is_playing = pivot.motus.pendulum.is_playing
    column.operator("motus.pendulum_play", text="Pause" if is_playing else "Play", icon='PAUSE' if is_playing else 'PLAY')
    column.operator("motus.pendulum_drag", icon='VIEW_PAN')
    ui.draw_bake(column)
    column.operator("motus.pendulum_remove", text="Remove", icon='X').object = context.object.name


def draw_add(layout, context):
    """Draw the buttons that add a pendulum on the active object (or at the 3D cursor if there is none) or from the selected objects."""
    column = layout.column(align=True)
    column.operator("motus.pendulum_add", icon='ADD').take = 'ACTIVE' if context.object else 'NEW'
    row = column.row(align=True)
    row.enabled = len(context.selected_objects) in {2, 3}
    row.operator("motus.pendulum_add", text="Pendulum of the Selected", icon='ADD').take = 'PLACED'


def _has_settings(obj):
    return parts.pivot_of(obj) is not None


PANEL = panels.SystemPanel(
    name="pendulum",
    prefix="MOTUS_PT_pendulum",
    label="Pendulum",
    editors={"": ui.Sidebar, "_constraint": ui.ObjectConstraints},
    suits=lambda obj: True,
    is_used=lambda obj: _has_settings(obj) or parts.is_stray(obj),
    has_settings=_has_settings,
    draw=draw_main,
    parts=(
        panels.Part("forces", "Forces", draw_forces),
        panels.Part("time", "Time", draw_time, is_open=True),
        panels.Part("trail", "Trails", draw_trail),
        panels.Part("plots", "Plots", draw_plots),
    ),
    readouts=draw_readouts,
    actions=draw_actions,
    refresh=panels.REFRESH,
    presets=presets.PANEL,
    draw_add=draw_add,
)


def draw_own_trail(layout, context):
    """Draw the panel of a trail object: its problem if there is one, and its settings."""
    ui.draw_problem(layout, context, trail.system(), context.object)
    rows.TRAIL.draw(ui.split(layout), context.object.motus.pendulum_trail)


TRAIL_PANEL = panels.SystemPanel(
    name="pendulum_trail",
    prefix="MOTUS_PT_pendulum_trail_object",
    label="Pendulum Trails",
    editors={"": ui.Sidebar, "_constraint": ui.ObjectConstraints},
    suits=parts.is_trail,
    is_used=parts.is_trail,
    draw=draw_own_trail,
    actions=lambda layout, context: layout.operator("motus.pendulum_trail_remove", icon='X'),
    refresh=panels.REFRESH,
)

classes = panels.classes(PANEL)
trail_classes = panels.classes(TRAIL_PANEL)
