"""Panel of Look At, in the 3D Viewport's sidebar and in the Bone Constraints tab of the Properties editor."""

import math

import bpy

from ..core import wiring
from ..core.file.pointers import pointed
from ..core.interface import bone_entries, panels, ui
from ..core.interface.tracks import panel as track_panel
from ..core.translations import OWN_SENSE, tr
from . import blinks, names, presets, reasons, rows
from .groups import OUTPUTS, driven_bones, shared_bone
from .setup import system


def active_entry(rig):
    """Entry that is selected in the rig's list of heads; None if there is none."""
    settings = rig.motus.look_at
    return settings.entries[settings.active_entry] if 0 <= settings.active_entry < len(settings.entries) else None


def outputs_of(context, rig, head):
    """Numbers that the solver has reported for a head at the present frame, {name: value}; None if the head was not solved."""
    found = wiring.outputs_of(system(), rig, head, OUTPUTS, context.view_layer.depsgraph)
    return None if found is None else dict(zip(OUTPUTS, found))


def draw_main(layout, context):
    """Draw the list of heads, a message about what is wrong, and the target and weights of the selected head."""
    rig = context.object
    settings = rig.motus.look_at
    entry = active_entry(rig)
    ui.draw_rig_influence(layout, settings)
    _, remove, _ = ui.draw_list(
        layout, "MOTUS_UL_look_at_entries", settings, "entries", "active_entry", "motus.look_at_add", "motus.look_at_remove", rows=2
    )
    remove.object, remove.bone = rig.name, entry.name if entry else ""
    ui.draw_problem(layout, context, system(), rig)
    if entry:
        bone_entries.draw_shown(layout, system(), entry.name)
        _draw_fault(layout, context, rig, entry)
        _draw_entry(layout, rig, entry)


def draw_add(layout, context):
    """Draw the buttons that set up Look At on the active head bone, or on all selected bones."""
    rig = context.object
    column = layout.column(align=True)
    bone_entries.draw_add(column, "motus.look_at_add", 'HIDE_OFF', _words(context, rig))
    heads = bone_entries.posed(context)
    words = tr("Look At with {count} Bones").format(count=len(heads)) if len(heads) > 1 else ""
    bone_entries.draw_add(column, "motus.look_at_add", 'GROUP_BONE', words, heads if words else (), tr("Look At with All Selected Bones"))


def _words(context, rig):
    """Text of the button that sets up Look At on one head bone; "" if there is no bone on which it could be set up."""
    if rig is None or rig.type != 'ARMATURE':
        return ""
    active = context.active_pose_bone if context.mode == 'POSE' else None
    head = active.name if active else names.head_of(rig)
    others = [found for found in context.selected_objects if found != rig]
    if head and len(others) == 1:
        return tr("{bone} Looks at {target}").format(bone=head, target=others[0].name)
    if bone_entries.has_entry(rig, "look_at", head):
        return ""
    return tr("Look At with {bone}").format(bone=head) if head else ""


def _draw_entry(layout, rig, entry):
    column = ui.split(layout)
    column.prop(entry, "target")
    target = pointed(entry, "target")
    if target and target.type == 'ARMATURE':
        column.prop_search(entry, "target_bone", target.data, "bones")
    row = ui.split(layout).row(align=True)
    row.prop(entry, "forward")
    _for_entry(row.operator("motus.look_at_turn", text="", icon='FILE_REFRESH'), rig, entry)
    ui.split(layout).prop(entry, "up")
    rows.WEIGHTS.draw(ui.split(layout), entry)


def _draw_fault(layout, context, rig, entry):
    """Draw a message that says why the head does not look at its target, if it does not."""
    told = outputs_of(context, rig, entry.name)
    if told:
        words = reasons.sentence(told["reason"], told["angle"])
        icon = 'ERROR' if told["reason"] in reasons.UNWANTED else 'INFO'
    else:
        words, icon = _unwired(rig, entry), 'ERROR'
    if words:
        ui.draw_message(layout, words, icon)


def _unwired(rig, entry):
    if entry.name not in rig.pose.bones:
        return tr("{object} has no bone {bone}").format(object=rig.name, bone=entry.name)
    if bone := shared_bone(rig, entry):
        return tr("{bone} is turned by another head already: take fewer spine bones").format(bone=bone)
    return ""


def draw_readouts(layout, context):
    """Draw the angles at which the head sees its target, and the angle that is left to turn. Draw nothing if the head is not solved."""
    entry = active_entry(context.object)
    told = entry and outputs_of(context, context.object, entry.name)
    if not told or told["reason"] in reasons.UNWANTED or told["reason"] == reasons.MUTED:
        return
    ui.draw_readouts(
        layout,
        (
            ui.Readout(text="Target Left" if told["yaw"] >= 0.0 else "Target Right", value=_degrees(told["yaw"])),
            ui.Readout(text="Target Up" if told["pitch"] >= 0.0 else "Target Down", value=_degrees(told["pitch"])),
            ui.Readout(text="Still to Turn", value=_degrees(told["angle"])),
        ),
    )


def draw_actions(layout, context):
    """Draw the buttons that bake and remove Look At."""
    column = layout.column(align=True)  # in a narrow editor, a row would leave the buttons too little room
    ui.draw_bake(column)
    column.operator("motus.look_at_remove", text="Remove", icon='X').object = context.object.name


def _degrees(angle):
    return f"{abs(math.degrees(angle)):.1f}°"


def draw_targets(layout, context):
    """Draw the list of the selected head's further targets, and the weights between which it looks."""
    rig = context.object
    entry = active_entry(rig)
    if entry is None:
        return
    layout.use_property_split = False
    add, remove, _ = ui.draw_list(
        layout,
        "MOTUS_UL_look_at_targets",
        entry,
        "extra_targets",
        "active_extra_target",
        "motus.look_at_target_add",
        "motus.look_at_target_remove",
        rows=2,
    )
    for button in (add, remove):
        _for_entry(button, rig, entry)
    if not entry.extra_targets:
        return
    extra = entry.extra_targets[min(entry.active_extra_target, len(entry.extra_targets) - 1)]
    ui.draw_goal(layout.column(), extra, "object", "bone")
    column = ui.split(layout)
    column.prop(entry, "target_weight")
    column.prop(extra, "weight", text_ctxt=OWN_SENSE)


def draw_limits(layout, context):
    """Draw the limits of how far spine, head and eyes may turn."""
    entry = active_entry(context.object)
    if entry:
        rows.LIMITS.draw(ui.split(layout), entry)
        rows.SIDES.draw(ui.split(layout), entry, has_title=True)


def draw_eyes(layout, context):
    """Draw the settings of what the eyes do by themselves, and what blinks move: eyelids and a shape key."""
    rig = context.object
    entry = active_entry(rig)
    if entry is None:
        return
    rows.EYES.draw(ui.split(layout), entry)
    if not entry.use_blinks:
        return
    for track, keywords in _gaze_unknown(context, entry):
        track_panel.draw(layout, track, **keywords)
    rows.SHUT.draw(ui.split(layout), entry)
    box = layout.box().column(align=True)
    box.label(text="Eyelids", icon='HIDE_ON')
    for lid in entry.lids:
        row = box.row(align=True)
        row.label(text=lid.name, icon='BONE_DATA', translate=False)
        row.prop(lid, "angle", text="")
        _for_entry(row.operator("motus.look_at_lid_remove", text="", icon='X'), rig, entry).lid = lid.name
    _for_entry(box.operator("motus.look_at_lid_add", icon='ADD'), rig, entry)


def _gaze_unknown(context, entry):
    """(track, keywords of motus.track_record) of each input of the gaze that needs recording, for blinks along with turns."""
    bones = driven_bones(context.object, entry)
    if not bones or entry.blink_angle >= math.pi:
        return ()
    index = context.object.motus.look_at.entries.find(entry.name)
    return blinks.Gaze(context.object, index, bones, context.scene).unknown


def draw_bones(layout, context):
    """Draw the settings of which bones turn along with the head, and of the axes along which head and eyes look at rest."""
    rig = context.object
    entry = active_entry(rig)
    if entry is None:
        return
    column = ui.split(layout)
    column.prop(entry, "body_length")
    rows.AXES.draw(column, entry)
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


class MOTUS_UL_look_at_targets(bpy.types.UIList):
    def draw_item(self, _context, layout, _entry, extra, _icon, _active, _name, index):
        named = pointed(extra, "object")
        row = layout.row(align=True)
        row.label(text=f"{index + 1}  {named.name if named else '-'}  {extra.bone}", translate=False)
        row.prop(extra, "weight", text="", emboss=False)


PANEL = panels.SystemPanel(
    name="look_at",
    prefix="MOTUS_PT_look_at",
    label="Look At",
    translation_context=OWN_SENSE,
    editors={"": ui.Sidebar, "_constraint": ui.BoneConstraints},
    suits=lambda obj: obj.type == 'ARMATURE',
    is_used=lambda rig: rig.motus.look_at.is_active,
    draw=draw_main,
    parts=(
        panels.Part("targets", "Further Targets", draw_targets),
        panels.Part("limits", "Limits", draw_limits),
        panels.Part("eyes", "Eyes by Themselves", draw_eyes),
        panels.Part("bones", "Bones", draw_bones),
    ),
    readouts=draw_readouts,
    actions=draw_actions,
    refresh=panels.REFRESH,
    presets=presets.PANEL,
    draw_add=draw_add,
)

classes = (MOTUS_UL_look_at_entries, MOTUS_UL_look_at_targets, *panels.classes(PANEL))
