"""Panel of inverse kinematics, in the 3D Viewport's sidebar and in the Bone Constraints tab of the Properties editor."""

import bpy

from ..core.file.pointers import pointed
from ..core.interface import bone_entries, panels, ui
from ..core.translations import tr
from . import limits_panel, presets, rows, status, targets, tools_panel
from .setup import system
from .shown import shown_entry


def draw_main(layout, context):
    """Draw the list of the rig's chains, a message about what is wrong, and the bones of the selected chain."""
    rig, entry = context.object, shown_entry(context)
    if entry is None:
        return
    settings = rig.motus.ik
    ui.draw_rig_influence(layout, settings)
    _, remove, _ = ui.draw_list(layout, "MOTUS_UL_ik_entries", settings, "entries", "active_entry", "motus.ik_add", "motus.ik_remove")
    remove.object, remove.bone = rig.name, entry.name
    bone_entries.draw_shown(layout, system(), entry.name)
    icon, sentence = status.sentence(context, rig, entry)
    if sentence:
        ui.draw_message(layout, sentence, icon)
    else:
        ui.draw_problem(layout, context, system(), rig)
    column = ui.split(layout)
    column.prop_search(entry, "name", rig.data, "bones", text="Bone")
    rows.CHAIN.draw(column, entry)


def draw_actions(layout, context):
    """Draw the buttons that bake and remove inverse kinematics."""
    column = layout.column(align=True)
    ui.draw_bake(column)
    column.operator("motus.ik_remove", text="Remove All", icon='X').object = context.object.name


def draw_add(layout, context):
    """Draw the name of the bone with which a new chain would end, and the buttons that add the chain."""
    rig = context.object
    active = rig.data.bones.active if rig and rig.type == 'ARMATURE' else None
    column = layout.column(align=True)
    column.label(text=active.name if active else "", icon='BONE_DATA' if active else 'BLANK1', translate=False)
    bone_entries.draw_add(column, "motus.ik_add", 'CON_KINEMATIC', _words(context, rig, active))
    column.operator("motus.ik_add", text="IK with Pole", icon='EMPTY_AXIS').make_pole = True
    column.operator("motus.ik_add", text="IK with Control Bone", icon='BONE_DATA').make_control_bone = True
    ends = targets.ends(rig, bone_entries.posed(context)) if active else []
    words = tr("IK on {count} Bones").format(count=len(ends)) if len(ends) > 1 else ""
    bone_entries.draw_add(column, "motus.ik_add", 'GROUP_BONE', words, ends if words else (), tr("IK on All Selected Bones"))


def _words(context, rig, active):
    """Text of the button that gives the active bone a chain; "" if there is no bone that could be given one."""
    if active is None:
        return ""
    goal = targets.selected_goal(context, rig)
    if goal:
        return tr("IK on {bone} to {target}").format(bone=active.name, target=goal[1] or goal[0].name)
    if bone_entries.has_entry(rig, "ik", active.name):
        return ""
    return tr("IK on {bone}").format(bone=active.name)


def draw_target(layout, context):
    """Draw the target of the shown chain, and the list of its further targets."""
    entry = shown_entry(context)
    ui.draw_goal(layout.column(), entry, "target", "target_bone")
    if pointed(entry, "target") != context.object:
        _of_chain(layout.operator("motus.ik_control_bone_add", icon='BONE_DATA'), context.object, entry)
    rows.OFFSET.draw(ui.split(layout), entry)
    layout.use_property_split = False
    layout.label(text="Further Targets")
    add, remove, _ = ui.draw_list(
        layout,
        "MOTUS_UL_ik_targets",
        entry,
        "extra_targets",
        "active_extra_target",
        "motus.ik_target_add",
        "motus.ik_target_remove",
        rows=2,
    )
    for button in (add, remove):
        button.object, button.bone = context.object.name, entry.name
    if not entry.extra_targets:
        return
    extra = entry.extra_targets[min(entry.active_extra_target, len(entry.extra_targets) - 1)]
    ui.draw_goal(layout.column(), extra, "object", "bone")
    ui.split(layout).prop(entry, "target_blend")


def _of_chain(button, rig, entry):
    """Set the keywords of a button's operator to the chain of an entry. Returns the operator's properties."""
    button.object, button.bone = rig.name, entry.name
    return button


def draw_pole(layout, context):
    """Draw the pole towards which the shown chain bends, and the buttons that make a pole."""
    entry = shown_entry(context)
    ui.draw_goal(layout.column(), entry, "pole", "pole_bone")
    if pointed(entry, "pole") is None:
        row = layout.row(align=True)
        _of_chain(row.operator("motus.ik_pole_add", icon='EMPTY_AXIS'), context.object, entry)
        _of_chain(row.operator("motus.ik_pole_add", text="As Bone", icon='BONE_DATA'), context.object, entry).as_bone = True
    else:
        _of_chain(layout.operator("motus.ik_pole_angle", icon='DRIVER_ROTATIONAL_DIFFERENCE'), context.object, entry)
    rows.POLE.draw(ui.split(layout), entry)


def _draw_rows(group):
    """Function that draws the rows of a group for the shown chain, as panels.Part takes it."""
    return lambda layout, context: group.draw(ui.split(layout), shown_entry(context))


def draw_readouts(layout, context):
    """Draw how far the shown chain reaches, how far away its target is, and which distance and angle are left to it."""
    entry = shown_entry(context)
    report = status.report(context.object, entry.name, context.view_layer.depsgraph)
    if report is None or report.reason < 0.0:
        return
    found = [
        ui.Readout(text="Reach", value=ui.length(context, report.reach)),
        ui.Readout(text="Distance", value=ui.length(context, report.distance)),
        ui.Readout(text="Falls Short By", value=ui.length(context, report.residual)),
    ]
    if entry.rotation_weight > 0.0:
        found.append(ui.Readout(text="Angle Left", value=status.angle(report.angle)))
    ui.draw_readouts(layout, found)


class MOTUS_UL_ik_entries(bpy.types.UIList):
    def draw_item(self, context, layout, _settings, entry, _icon, _active, _name, _index):
        row = layout.row(align=True)
        row.label(text=entry.name, icon='CON_KINEMATIC', translate=False)
        icon, sentence = status.sentence(context, entry.id_data, entry)
        if sentence and not entry.is_muted:
            row.label(text="", icon=icon)
        row.prop(entry, "is_muted", text="", icon='HIDE_ON' if entry.is_muted else 'HIDE_OFF', emboss=False)


class MOTUS_UL_ik_targets(bpy.types.UIList):
    def draw_item(self, _context, layout, _entry, extra, _icon, _active, _name, index):
        named = pointed(extra, "object")
        name = named.name if named else "-"
        layout.label(text=f"{index + 1}  {name}  {extra.bone}", translate=False)


def _draw_limits(layout, context):
    limits_panel.draw(layout, context, shown_entry(context))


PANEL = panels.SystemPanel(
    name="ik",
    prefix="MOTUS_PT_ik",
    label="Inverse Kinematics",
    editors={"": ui.Sidebar, "_constraint": ui.BoneConstraints},
    suits=lambda obj: obj.type == 'ARMATURE',
    is_used=lambda rig: len(rig.motus.ik.entries) > 0,
    draw=draw_main,
    parts=(
        panels.Part("target", "Target", draw_target, is_open=True),
        panels.Part("weights", "Weights", _draw_rows(rows.WEIGHTS), is_open=True),
        panels.Part("pole", "Pole", draw_pole, is_open=True),
        panels.Part("reach", "Reach", _draw_rows(rows.REACH)),
        panels.Part("floor", "Floor", _draw_rows(rows.FLOOR)),
        panels.Part(
            "limits", "Limits", _draw_limits, draw_header=lambda layout, context: layout.prop(shown_entry(context), "use_limits", text="")
        ),
        panels.Part("precision", "Precision", _draw_rows(rows.PRECISION)),
        panels.Part("tools", "Tools", tools_panel.draw, is_open=True, is_action=True),
    ),
    readouts=draw_readouts,
    actions=draw_actions,
    refresh=panels.REFRESH,
    presets=presets.PANEL,
    draw_add=draw_add,
)

classes = (MOTUS_UL_ik_entries, MOTUS_UL_ik_targets, *panels.classes(PANEL))
