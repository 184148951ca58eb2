"""Panels of Look At: the sidebar's tab and the bone's constraint properties draw the same parts."""

import math

import bpy

from ..core import native, ui, wiring
from ..core.translations import OWN_SENSE, tr
from . import presets, reasons
from .groups import OUTPUTS, shared_bone
from .setup import system


def _is_looking(context):
    rig = context.object
    return native.module is not None and rig is not None and rig.type == 'ARMATURE' and rig.motus.look_at.is_active


def active_entry(rig):
    """The entry that the list has marked; None where there is none."""
    settings = rig.motus.look_at
    return settings.entries[settings.active_entry] if 0 <= settings.active_entry < len(settings.entries) else None


def outputs_of(context, rig, head):
    """What the solver told of a head, by name of the output; None where it told nothing."""
    found = wiring.outputs_of(system(), rig, head, OUTPUTS, context.view_layer.depsgraph)
    return None if found is None else dict(zip(OUTPUTS, found))


def draw_main(layout, context):
    """The list of heads, and of the active one its target, weights, and how far its gaze is off."""
    if native.module is None:
        ui.draw_native_status(layout)
        return
    rig = context.object
    settings = rig.motus.look_at
    if not settings.is_active:
        layout.operator("motus.look_at_add", icon='HIDE_OFF')
        return
    _draw_list(layout, settings)
    ui.draw_problem(layout, context, system(), rig)
    entry = active_entry(rig)
    if entry:
        _draw_entry(layout, context, rig, entry)
    column = layout.column(align=True)  # a row would be too narrow in a narrow editor
    column.prop(settings, "influence", slider=True)
    ui.draw_bake(layout, system(), rig)
    layout.operator("motus.look_at_refresh", icon='FILE_REFRESH')


def _draw_list(layout, settings):
    row = layout.row()
    row.template_list("MOTUS_UL_look_at_entries", "", settings, "entries", settings, "active_entry", rows=2)
    buttons = row.column(align=True)
    buttons.operator("motus.look_at_add", text="", icon='ADD')
    remove = buttons.operator("motus.look_at_remove", text="", icon='REMOVE')
    remove.object = settings.id_data.name
    entry = active_entry(settings.id_data)
    remove.bone = entry.name if entry else ""


def _draw_entry(layout, context, rig, entry):
    told = outputs_of(context, rig, entry.name)
    column = ui.split(layout)
    column.prop(entry, "target")
    if entry.target and entry.target.type == 'ARMATURE':
        column.prop_search(entry, "target_bone", entry.target.data, "bones")
    column.separator()
    column.prop(entry, "weight", text="Weight", text_ctxt=OWN_SENSE, slider=True)
    column.prop(entry, "body_weight", slider=True)
    column.prop(entry, "head_weight", slider=True)
    eyes = column.column()
    eyes.active = len(entry.eyes) > 0
    eyes.prop(entry, "eyes_weight", slider=True)
    if told:
        _draw_told(layout, told)
    elif entry.name not in rig.pose.bones:
        words = tr("{object} has no bone {bone}").format(object=rig.name, bone=entry.name)
        ui.draw_message(layout, words, 'ERROR')
    elif shared_bone(rig, entry):
        words = tr("{bone} is turned by another head already: take fewer spine bones").format(
            bone=shared_bone(rig, entry))
        ui.draw_message(layout, words, 'ERROR')


def _draw_told(layout, told):
    words = reasons.sentence(told["reason"], told["angle"])
    if words:
        ui.draw_message(layout, words, 'ERROR' if told["reason"] in reasons.UNWANTED else 'INFO')
    if told["reason"] in reasons.UNWANTED or told["reason"] == reasons.MUTED:
        return
    grid = layout.box().grid_flow(columns=2, row_major=True, align=True)
    grid.label(text="Target Left" if told["yaw"] >= 0.0 else "Target Right")
    grid.label(text=_degrees(told["yaw"]), translate=False)
    grid.label(text="Target Up" if told["pitch"] >= 0.0 else "Target Down")
    grid.label(text=_degrees(told["pitch"]), translate=False)
    grid.label(text="Off By")
    grid.label(text=_degrees(told["angle"]), translate=False)


def _degrees(angle):
    return f"{abs(math.degrees(angle)):.1f}°"


def draw_limits(layout, context):
    """How far the parts may turn."""
    entry = active_entry(context.object)
    if entry is None:
        return
    column = ui.split(layout)
    column.prop(entry, "clamp", slider=True)
    column.prop(entry, "body_limit", text="Body")
    column.prop(entry, "head_limit", text="Head")
    column.prop(entry, "eyes_limit", text="Eyes")


def draw_bones(layout, context):
    """Which bones turn, and where they look at rest."""
    rig = context.object
    entry = active_entry(rig)
    if entry is None:
        return
    column = ui.split(layout)
    column.prop(entry, "body_length")
    column.prop(entry, "head_forward")
    column.prop(entry, "eyes_forward")
    box = layout.box().column(align=True)
    box.label(text="Eyes", icon='HIDE_OFF')
    for eye in entry.eyes:
        row = box.row(align=True)
        row.label(text=eye.name, icon='BONE_DATA', translate=False)
        _for_entry(row.operator("motus.look_at_eye_remove", text="", icon='X'), rig, entry).eye = eye.name
    _for_entry(box.operator("motus.look_at_eye_add", icon='ADD'), rig, entry)


def _for_entry(button, rig, entry):
    button.object, button.bone = rig.name, entry.name
    return button


class MOTUS_UL_look_at_entries(bpy.types.UIList):
    def draw_item(self, _context, layout, _settings, entry, _icon, _active, _name, _index):
        row = layout.row(align=True)
        row.active = not entry.is_muted
        row.label(text=entry.name, icon='BONE_DATA', translate=False)
        row.prop(entry, "is_muted", text="", icon='HIDE_ON' if entry.is_muted else 'HIDE_OFF', emboss=False)


class _Main:
    bl_label = "Look At"
    bl_translation_context = OWN_SENSE

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == 'ARMATURE'

    def draw_header_preset(self, context):
        if _is_looking(context):
            presets.PANEL.draw_panel_header(self.layout)

    def draw(self, context):
        draw_main(self.layout, context)


class _Part:
    bl_options = {'DEFAULT_CLOSED'}

    @classmethod
    def poll(cls, context):
        return _is_looking(context)


class _Limits(_Part):
    bl_label = "Limits"

    def draw(self, context):
        draw_limits(self.layout, context)


class _Bones(_Part):
    bl_label = "Bones"

    def draw(self, context):
        draw_bones(self.layout, context)


class MOTUS_PT_look_at(_Main, ui.Sidebar, bpy.types.Panel):
    pass


class MOTUS_PT_look_at_limits(_Limits, ui.Sidebar, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_look_at"


class MOTUS_PT_look_at_bones(_Bones, ui.Sidebar, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_look_at"


class MOTUS_PT_look_at_constraint(_Main, ui.BoneConstraints, bpy.types.Panel):
    pass


class MOTUS_PT_look_at_constraint_limits(_Limits, ui.BoneConstraints, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_look_at_constraint"


class MOTUS_PT_look_at_constraint_bones(_Bones, ui.BoneConstraints, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_look_at_constraint"


classes = (
    MOTUS_UL_look_at_entries,
    # Panels before their sub-panels.
    MOTUS_PT_look_at, MOTUS_PT_look_at_limits, MOTUS_PT_look_at_bones,
    MOTUS_PT_look_at_constraint, MOTUS_PT_look_at_constraint_limits, MOTUS_PT_look_at_constraint_bones,
)
