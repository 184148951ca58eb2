"""Panels of inverse kinematics: the sidebar's tab and the bone's constraint properties draw the same parts."""

import bpy

from ..core import native, ui
from ..core.translations import OWN_SENSE
from . import limits_panel, presets, status
from .setup import system


def shown_entry(context):
    """The entry that the panels are about, or None."""
    rig = context.object
    if native.module is None or rig is None or rig.type != 'ARMATURE':
        return None
    settings = rig.motus.ik
    index = settings.active_entry
    return settings.entries[index] if 0 <= index < len(settings.entries) else None


def draw_main(layout, context):
    """The rig's chains, buttons, and what is wrong."""
    if not ui.draw_native_status(layout):
        return
    rig = context.object
    settings = rig.motus.ik
    entry = shown_entry(context)
    if entry is None:
        _draw_add(layout, context, rig)
        return
    row = layout.row()
    row.template_list("MOTUS_UL_ik_entries", "", settings, "entries", settings, "active_entry", rows=3)
    buttons = row.column(align=True)
    buttons.operator("motus.ik_add", text="", icon='ADD')
    remove = buttons.operator("motus.ik_remove", text="", icon='REMOVE')
    remove.object, remove.bone = rig.name, entry.name
    icon, sentence = status.sentence(context, rig, entry)
    if sentence:
        ui.draw_message(layout, sentence, icon)
    else:
        ui.draw_problem(layout, context, system(), rig)
    column = ui.split(layout)
    column.prop_search(entry, "name", rig.data, "bones", text="Bone")
    column.prop(entry, "chain_length", text="Length")
    column.prop(entry, "use_tail")
    column.prop(settings, "influence", slider=True)
    ui.draw_bake(layout, system(), rig)
    column = layout.column(align=True)
    column.operator("motus.ik_refresh", icon='FILE_REFRESH')
    everything = column.operator("motus.ik_remove", text="Remove All", icon='X')
    everything.object = rig.name


def _draw_add(layout, context, rig):
    active = rig.data.bones.active
    if active is None or context.mode not in {'POSE', 'OBJECT'}:
        layout.label(text="Select a bone in Pose Mode", icon='INFO')
        return
    layout.label(text=active.name, icon='BONE_DATA', translate=False)
    column = layout.column(align=True)
    column.operator("motus.ik_add", text="Add", icon='CON_KINEMATIC')
    column.operator("motus.ik_add", text="Add with a Pole", icon='EMPTY_AXIS').make_pole = True


def draw_goal(column, owner, pointer, bone):
    """An object, and a bone of it where it is an armature."""
    column.prop(owner, pointer, text="")  # a label would leave no room for the name in a narrow sidebar
    goal = getattr(owner, pointer)
    if goal and goal.type == 'ARMATURE':
        column.prop_search(owner, bone, goal.data, "bones", text="")


def draw_target(layout, context):
    """What the chain goes to, and what else it can go to."""
    entry = shown_entry(context)
    draw_goal(layout.column(), entry, "target", "target_bone")
    ui.split(layout).prop(entry, "rotation_offset", text="Offset", text_ctxt=OWN_SENSE)
    layout.use_property_split = False
    layout.label(text="Further Targets")
    row = layout.row()
    row.template_list("MOTUS_UL_ik_targets", "", entry, "extra_targets", entry, "active_extra_target", rows=2)
    buttons = row.column(align=True)
    for operator, icon in (("motus.ik_target_add", 'ADD'), ("motus.ik_target_remove", 'REMOVE')):
        button = buttons.operator(operator, text="", icon=icon)
        button.object, button.bone = context.object.name, entry.name
    if not entry.extra_targets:
        return
    extra = entry.extra_targets[min(entry.active_extra_target, len(entry.extra_targets) - 1)]
    draw_goal(layout.column(), extra, "object", "bone")
    ui.split(layout).prop(entry, "target_blend")


def draw_pole(layout, context):
    """Where the chain bends to."""
    entry = shown_entry(context)
    draw_goal(layout.column(), entry, "pole", "pole_bone")
    column = ui.split(layout)
    if entry.pole:
        column.prop(entry, "bend")
    column.prop(entry, "pole_angle")
    column.prop(entry, "hinge_angle")


def draw_reach(layout, context):
    """Softness and stretch, and how far the chain reaches."""
    entry = shown_entry(context)
    column = ui.split(layout)
    column.prop(entry, "softness", slider=True)
    column.prop(entry, "stretch", slider=True)
    report = status.report(context.object, entry.name, context.view_layer.depsgraph)
    if report is None or report.reason < 0.0:
        return
    grid = layout.box().grid_flow(columns=2, row_major=True, align=True)
    _draw_number(grid, status.length(context, report.reach), text="Reach")
    _draw_number(grid, status.length(context, report.distance), text="Distance")
    _draw_number(grid, status.length(context, report.residual), text="Residual")
    if entry.rotation_weight > 0.0:
        _draw_number(grid, status.angle(report.angle), text="Angle Left")


def _draw_number(grid, value, text):
    grid.label(text=text)
    grid.label(text=value, translate=False)


def draw_weights(layout, context):
    """Between animation and solution."""
    entry = shown_entry(context)
    column = ui.split(layout)
    column.prop(entry, "position_weight", slider=True)
    column.prop(entry, "rotation_weight", slider=True)


def draw_precision(layout, context):
    """When the search stops."""
    entry = shown_entry(context)
    column = ui.split(layout)
    column.prop(entry, "tolerance")
    column.prop(entry, "iterations")


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
        name = extra.object.name if extra.object else "-"
        layout.label(text=f"{index + 1}  {name}  {extra.bone}", translate=False)


class _Main:
    bl_label = "Inverse Kinematics"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == 'ARMATURE'

    def draw_header_preset(self, context):
        if shown_entry(context):
            presets.PANEL.draw_panel_header(self.layout)

    def draw(self, context):
        draw_main(self.layout, context)


class _Part:
    bl_options = {'DEFAULT_CLOSED'}

    @classmethod
    def poll(cls, context):
        return shown_entry(context) is not None

    def draw(self, context):
        type(self).draw_part(self.layout, context)


class _Target(_Part):
    bl_label = "Target"
    bl_options = set()
    draw_part = staticmethod(draw_target)


class _Weights(_Part):
    bl_label = "Weights"
    bl_options = set()
    draw_part = staticmethod(draw_weights)


class _Pole(_Part):
    bl_label = "Pole"
    draw_part = staticmethod(draw_pole)


class _Reach(_Part):
    bl_label = "Reach"
    draw_part = staticmethod(draw_reach)


class _Limits(_Part):
    bl_label = "Limits"
    draw_part = staticmethod(lambda layout, context: limits_panel.draw(layout, context, shown_entry(context)))

    def draw_header(self, context):
        self.layout.prop(shown_entry(context), "use_limits", text="")


class _Precision(_Part):
    bl_label = "Precision"
    draw_part = staticmethod(draw_precision)


_PARTS = {"target": _Target, "weights": _Weights, "pole": _Pole, "reach": _Reach, "limits": _Limits,
          "precision": _Precision}


class MOTUS_PT_ik(_Main, ui.Sidebar, bpy.types.Panel):
    pass


class MOTUS_PT_ik_constraint(_Main, ui.BoneConstraints, bpy.types.Panel):
    pass


def _parts(parent, editor):
    """A sub-panel of each part for one of the editors."""
    return [type(f"{parent}_{name}", (part, editor, bpy.types.Panel), {"bl_parent_id": parent, "__module__": __name__})
            for name, part in _PARTS.items()]


classes = (
    MOTUS_UL_ik_entries, MOTUS_UL_ik_targets,
    # Panels before their sub-panels.
    MOTUS_PT_ik, *_parts("MOTUS_PT_ik", ui.Sidebar),
    MOTUS_PT_ik_constraint, *_parts("MOTUS_PT_ik_constraint", ui.BoneConstraints),
)
