"""The panel of dynamics in the sidebar and in the constraint properties of objects and bones."""

import bpy

from ..core import native
from ..core.interface import bone_entries, panels, ui
from ..core.interface.tracks import panel as track_panel
from ..core.interface.view import graph, widths
from ..core.lazy import numpy as np
from ..core.translations import OWN_SENSE, counted, tr
from . import filters, presets, rows, styles, told
from .groups import units
from .setup import active_entry, label, system

POINTS = 256  # number of points of the graph
BEFORE = 0.06  # part of the graph before the step, relative to the part after the step


def draw_main(layout, context):
    """Draw the list of entries, the problem of the dynamics if there is one, and settings of the active entry."""
    owner = context.object
    settings = owner.motus.dynamics
    if owner.type == 'ARMATURE':
        ui.draw_rig_influence(layout, settings)
    else:
        ui.split(layout).prop(settings, "influence", slider=True)
    _, remove, _ = ui.draw_list(
        layout, "MOTUS_UL_dynamics_entries", settings, "entries", "active_entry", "motus.dynamics_add", "motus.dynamics_remove", rows=2
    )
    entry = active_entry(owner)
    remove.object, remove.only_active = owner.name, True
    ui.draw_problem(layout, context, system(), owner, lambda problem: told.sentence(owner, problem, context.scene))
    if entry:
        bone_entries.draw_shown(layout, system(), label(entry), _icon_of(entry))
        column = ui.split(layout)
        rows.FOLLOW.draw(column, entry)
        rows.AMOUNT.draw(column, entry)


def _icon_of(entry):
    return 'FCURVE' if entry.data_path else 'BONE_DATA' if entry.name else 'OBJECT_DATA'


def draw_motion(layout, context):
    """Draw the numbers of the active entry's filter and the graph of its step response."""
    entry = active_entry(context.object)
    if entry is None:
        return
    column = ui.split(layout)
    row = column.split(factor=widths.LABELS)
    label_of_row = row.row()
    label_of_row.alignment = 'RIGHT'
    label_of_row.label(text="Style")
    # An operator instead of the property, because the style is given to all selected objects or bones.
    row.operator_menu_enum(presets.USE.bl_idname, "preset", text=styles.label_of(entry), translate=False)
    column.prop(entry, "shape")
    rows.MOTION.draw(column, entry)
    draw_graph(layout, filters.numbers(entry))


def draw_graph(layout, numbers):
    """Draw the step response of a filter as a graph. numbers: (frequency, damping, response)."""
    if native.module is None:
        return
    try:
        seconds = filters.seconds_shown(numbers)
        times = np.linspace(-BEFORE * seconds, seconds, POINTS)
        found = native.module.step_response(times, *numbers)
    except ValueError as error:
        ui.draw_message(layout, str(error), 'ERROR')
        return
    box = layout.box().column(align=True)
    step = (times >= 0.0).astype(float)
    box.template_icon(graph.icon("dynamics", found, (0.0, 1.0), (step,)), scale=7.0)
    box.label(text=tr("A sudden move, over {seconds} s").format(seconds=f"{seconds:.2g}"), translate=False)


def draw_loop(layout, context):
    """Draw the settings of the active entry's loop."""
    entry = active_entry(context.object)
    if entry is None:
        return
    rows.LOOP.draw(ui.split(layout), entry)
    button = layout.operator("motus.dynamics_loop", icon='FILE_REFRESH')
    button.object, button.only_active = context.object.name, True


def _draw_loop_switch(layout, context):
    entry = active_entry(context.object)
    if entry is not None:
        layout.prop(entry, "use_loop", text="")


def draw_input(layout, context):
    """Draw whether the active entry's input is known, with buttons that record its unknown tracks, and the Teleport setting."""
    entry = active_entry(context.object)
    if entry is None:
        return
    rows.JUMP.draw(ui.split(layout), entry)
    source = input_of(context.object, entry, context.scene)
    if source is None:
        ui.draw_message(layout, tr("{object} has no bone {bone}").format(object=context.object.name, bone=entry.name), 'ERROR')
        return
    if not source.tracks:
        ui.draw_message(layout, tr("{object} has no number {path}").format(object=context.object.name, path=entry.data_path), 'ERROR')
        return
    if source.reason is not None:
        ui.draw_message(layout, source.reason.sentence, 'ERROR')
        return
    unknown = source.unknown
    for track, keywords in unknown:
        track_panel.draw(layout, track, **keywords)
    if not unknown:
        moves = source.extent is not None
        ui.draw_message(layout, tr("Exact at any frame") if moves else tr("Nothing moves here yet that could be followed"), 'INFO')


def input_of(owner, entry, scene):
    """Return the input (motion to be filtered) of an entry of an original owner; None if the entry's bone does not exist."""
    for unit in units(owner):
        if entry in unit.entries:
            return unit.input(scene)
    return None


def draw_actions(layout, context):
    """Draw the buttons that bake and remove the dynamics."""
    column = layout.column(align=True)  # the buttons would be too narrow side by side in a narrow editor
    ui.draw_bake(column)
    column.operator("motus.dynamics_remove", text="Remove All", icon='X').object = context.object.name


def draw_add(layout, context):
    """Draw the buttons that add dynamics to the selected objects or bones."""
    column = layout.column(align=True)
    # False is set explicitly, because a button without a value takes the operator's last value.
    bone_entries.draw_add(column, "motus.dynamics_add", 'FORCE_HARMONIC', _words(context)).whole_chains = False
    row = column.row(align=True)
    row.enabled = context.mode == 'POSE'
    row.operator("motus.dynamics_add", text="Dynamics of Whole Chains", icon='FORCE_HARMONIC').whole_chains = True


def _words(context):
    """Return the label of the button that adds dynamics to the selected objects or bones; "" if none is selected."""
    if context.mode == 'POSE':
        found, many = [bone.name for bone in context.selected_pose_bones or ()], tr("Dynamics on {count} Bones")
    else:
        found, many = [obj.name for obj in context.selected_objects], tr("Dynamics on {count} Objects")
    return counted(len(found), tr("Dynamics on {name}").format(name=found[0]), many) if found else ""


class MOTUS_UL_dynamics_entries(bpy.types.UIList):
    def draw_item(self, _context, layout, _settings, entry, _icon, _active, _name, _index):
        row = layout.row(align=True)
        row.active = not entry.is_muted
        columns = row.split(factor=0.65, align=True)  # the factor leaves room for the name even in a narrow sidebar
        columns.label(text=label(entry), icon=_icon_of(entry), translate=False)
        columns.prop(entry, "weight", text="", slider=True, emboss=False, text_ctxt=OWN_SENSE)
        row.prop(entry, "is_muted", text="", icon='HIDE_ON' if entry.is_muted else 'HIDE_OFF', emboss=False)


PANEL = panels.SystemPanel(
    name="dynamics",
    prefix="MOTUS_PT_dynamics",
    label="Dynamics",
    editors={"": ui.Sidebar, "_constraint": ui.ObjectConstraints, "_bone_constraint": ui.BoneConstraints},
    suits=lambda obj: True,
    is_used=lambda obj: len(obj.motus.dynamics.entries) > 0,
    draw=draw_main,
    parts=(
        panels.Part("motion", "Motion", draw_motion, is_open=True),
        panels.Part("loop", "Loop", draw_loop, draw_header=_draw_loop_switch),
        panels.Part("input", "Input", draw_input, is_open=True),
    ),
    actions=draw_actions,
    refresh=panels.REFRESH,
    presets=presets.PANEL,
    draw_add=draw_add,
)

classes = (MOTUS_UL_dynamics_entries, *panels.classes(PANEL))
