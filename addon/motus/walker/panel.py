"""Panel of a walker, in the sidebar and in the object's constraint properties; shown for the walker, its body and its foot objects."""

import math

from ..core.declare import Problem, is_owner, leader_of
from ..core.interface import panels, ui
from ..core.interface.tracks import panel as track_panel
from ..core.refusals import Refused
from ..core.translations import tr
from . import legs, pace, plan, presets, rows, told
from .setup import system
from .steps import chart, chosen

MOST_SHOWN = 16
"""Most legs that the panel lists."""


def _walker(context):
    """Return the walker of the active object, which is the walker itself, its body or one of its feet; None if there is none."""
    obj = context.object
    return obj if is_owner(system(), obj) else leader_of(system(), obj)


def is_used(obj):
    """Whether an object is a walker, or the body or a foot of a walker."""
    return is_owner(system(), obj) or leader_of(system(), obj) is not None


def draw_main(layout, context):
    """Draw the walker's problem if there is one, how the motion of the walking object is known, and the settings of the gait."""
    owner = _walker(context)
    if owner != context.object:
        box = layout.box().column()
        box.label(text=owner.name, icon='LINKED', translate=False)
        box.operator("motus.walker_select", icon='RESTRICT_SELECT_OFF')
    problem = ui.draw_problem(layout, context, system(), owner, lambda one: told.sentence(context, owner, one))
    track = plan.body_track(owner, context.scene)
    if not track.is_known or problem == plan.UNKNOWN or told.is_moved(context, owner):
        track_panel.draw(layout, track, datablock=owner.name)
    rows.GAIT.draw(ui.split(layout), owner.motus.walker)


def draw_ground(layout, context):
    """Draw the settings of the ground that the feet stand on."""
    settings = _walker(context).motus.walker
    column = ui.split(layout)
    column.prop(settings, "ground")
    column.prop(settings, "grounds")
    column.prop(settings, "carrier")
    rows.GROUND.draw(column, settings)


def draw_soles(layout, context):
    """Draw the settings of how feet lie on the ground and roll over heel and toe."""
    rows.SOLES.draw(ui.split(layout), _walker(context).motus.walker)


def draw_body(layout, context):
    """Draw the settings of how the body rises and leans with the feet."""
    owner = _walker(context)
    settings = owner.motus.walker
    column = ui.split(layout)
    if owner.pose:
        column.prop_search(settings, "body_bone", owner.data, "bones")
    else:
        column.prop(settings, "body")
    rows.BODY.draw(column, settings)


def draw_legs(layout, context):
    """Draw the list of feet, their phases if the gait is Custom, and the button that sets the rest positions."""
    owner = _walker(context)
    settings = owner.motus.walker
    column = layout.column(align=True)
    for leg in settings.legs[:MOST_SHOWN]:
        row = column.row()
        row.label(text=legs.label(leg), icon='BONE_DATA' if legs.bone(leg) else 'OBJECT_DATA', translate=False)
        if settings.gait == 'OWN':
            row.prop(leg, "phase", text="", slider=True)
    if len(settings.legs) > MOST_SHOWN:
        column.label(text=tr("and {count} more").format(count=len(settings.legs) - MOST_SHOWN), translate=False)
    layout.operator("motus.walker_rest", icon='CON_FLOOR').object = owner.name


def _changed(context, owner):
    """As chosen.changed(); {} if there is no plan."""
    try:
        return chosen.changed(context, owner) if owner.motus.walker.steps else {}
    except Refused:
        return {}


def _draw_moments(row, context, owner, index, planned):
    """Draw when a changed step touches down and lifts: the frames that are set, and buttons that set the others where they are planned.

    planned: the chosen.Step of the entry of this index, or None.
    """
    step = owner.motus.walker.steps[index]
    for name in chart.MOMENTS:
        part = row.row(align=True)
        if getattr(step, f"use_{name}"):
            part.prop(step, name)
            part.prop(step, f"use_{name}", text="", icon='X', toggle=True, invert_checkbox=True)
            continue
        seconds = getattr(planned, name, math.inf)
        part.enabled = math.isfinite(seconds)
        button = part.operator("motus.walker_step_time", text=step.bl_rna.properties[name].name, icon='KEYFRAME')
        button.object, button.index = owner.name, index
        if part.enabled:
            setattr(button, name, round(told.shown(context.scene, seconds)))


def draw_steps(layout, context):
    """Draw the steps that were changed by hand, each with its foot, frame and lock, and the button that changes further ones."""
    owner = _walker(context)
    settings = owner.motus.walker
    column = layout.column(align=True)
    changed = _changed(context, owner)
    for index, step in enumerate(settings.steps[:MOST_SHOWN]):
        label = legs.label(settings.legs[step.leg]) if step.leg < len(settings.legs) else ""
        row = column.row(align=True)
        row.label(text=label, translate=False)
        row.prop(step, "frame", text="")
        if settings.use_soles:
            row.prop(step, "turn", text="")
        lock = row.operator("motus.walker_step", text="", icon='LOCKED' if step.is_locked else 'UNLOCKED')
        lock.object, lock.index, lock.lock = owner.name, index, not step.is_locked
        again = row.operator("motus.walker_step_remove", text="", icon='X')
        again.object, again.index = owner.name, index
        _draw_moments(column.row(align=True), context, owner, index, changed.get(index))
    if len(settings.steps) > MOST_SHOWN:
        column.label(text=tr("and {count} more").format(count=len(settings.steps) - MOST_SHOWN), translate=False)
    layout.prop(context.scene.motus, "show_walker_times")
    layout.operator("motus.walker_step", icon='VIEW_PAN').object = owner.name
    layout.operator("motus.walker_prints", icon='ADD').object = owner.name


def draw_whole(layout, context):
    """Draw the settings of the body's axes, of jumps, and of the walk's influence."""
    rows.WHOLE.draw(ui.split(layout), _walker(context).motus.walker)


def _of_the_pace(context, owner):
    """Readouts of the body's speed, if its strides go by it; [] otherwise, or if the speed is not known."""
    evaluated = owner.evaluated_get(context.evaluated_depsgraph_get())
    track = plan.body_track(evaluated, context.scene)
    if not (owner.motus.walker.use_natural and track.is_known):
        return []
    now, height = pace.of(evaluated, context.scene, track)
    if height == 0.0:
        return []
    return [
        ui.Readout(text="Speed", value=f"{now.speed:.2f} m/s"),
        ui.Readout(text="Froude Number", value=f"{pace.froude(now.speed, height):.2f}"),
        ui.Readout(text="Speed at Ease", value=f"{pace.at_ease(height, now.slope):.2f} m/s"),
    ]


def draw_readouts(layout, context):
    """Draw the number of planned steps, and the frame from which the feet rest. Draws nothing if there is no plan."""
    owner = _walker(context)
    planned = told.found(context, owner)
    if isinstance(planned, Problem):
        return
    steps = planned.walker.steps
    found = _of_the_pace(context, owner) + [ui.Readout(text="Steps", value=str(int((steps["touch"] > steps["lift"]).sum())))]
    if planned.known == plan.EVER and len(steps["leg"]):
        found.append(ui.Readout(text="At Rest From", value=f"{told.shown(context.scene, planned.walker.settled):.0f}"))
    ui.draw_readouts(layout, found)


def draw_actions(layout, context):
    """Draw the buttons that bake and remove the walker."""
    column = layout.column(align=True)
    ui.draw_bake(column)
    column.operator("motus.walker_remove", text="Remove", icon='X').object = _walker(context).name


def draw_add(layout, context):
    """Draw the buttons that set up a walker on the selected objects or add a walking spider."""
    column = layout.column(align=True)
    column.operator("motus.walker_add", icon='ADD')
    column.operator("motus.spider_add", icon='ADD')


PANEL = panels.SystemPanel(
    name="walker",
    prefix="MOTUS_PT_walker",
    label="Walker",
    editors={"": ui.Sidebar, "_constraint": ui.ObjectConstraints},
    suits=lambda obj: True,
    is_used=is_used,
    draw=draw_main,
    parts=(
        panels.Part("ground", "Ground", draw_ground, is_open=True),
        panels.Part("soles", "Soles", draw_soles),
        panels.Part("body", "Body", draw_body, is_open=True),
        panels.Part("legs", "Legs", draw_legs),
        panels.Part("steps", "Steps", draw_steps),
        panels.Part("whole", "More", draw_whole),
    ),
    readouts=draw_readouts,
    actions=draw_actions,
    refresh=panels.REFRESH,
    presets=presets.PANEL,
    draw_add=draw_add,
)

classes = panels.classes(PANEL)
