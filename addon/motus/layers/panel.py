"""The panel of the animation layers in the sidebar and in the armature's properties."""

import bpy

from ..core.blender import capabilities
from ..core.declare import is_owner
from ..core.file.pointers import pointed
from ..core.interface import panels, ui
from ..core.settings.entries import active
from ..core.translations import tr
from . import live, mask, presets, rows
from .setup import system
from .solve import SOME_ARE_OFF, is_compared


def active_entry(rig):
    """Return the settings of the layer that is active in the rig's list of layers; None if there is none."""
    return active(rig, "layers")


def fault(rig, entry):
    """Return a sentence on what is missing for a layer: its action, or bones of its mask; "" if nothing is missing."""
    if pointed(entry, "action") is None:
        return tr("Choose an action for this layer")
    if is_compared(entry) and pointed(entry, "reference_action") is None:
        return tr("Choose the action that this layer is compared with")
    missing = [item.name for item in entry.mask if not mask.is_there(rig, item)]
    if missing:
        return tr("{object} lacks bones or collections of the mask: {names}").format(object=rig.name, names=", ".join(missing))
    return ""


def draw_main(layout, context):
    """Draw the list of layers, the problem of the rig's layers if there is one, and action and weight of the active layer."""
    rig = context.object
    settings = rig.motus.layers
    entry = active_entry(rig)
    ui.draw_rig_influence(layout, settings)
    add, remove, column = ui.draw_list(
        layout, "MOTUS_UL_layers_entries", settings, "entries", "active_entry", "motus.layer_add", "motus.layer_remove", rows=4
    )
    add.object = remove.object = rig.name
    column.separator()
    column.operator("motus.layer_new", text="", icon='FILE_NEW').object = rig.name
    column.operator("motus.layer_duplicate", text="", icon='DUPLICATE').object = rig.name
    column.operator("motus.layer_merge", text="", icon='TRIA_DOWN_BAR').object = rig.name
    for direction, icon in (('UP', 'TRIA_UP'), ('DOWN', 'TRIA_DOWN')):
        button = column.operator("motus.layer_move", text="", icon=icon)
        button.object, button.direction = rig.name, direction
    words = fault(rig, entry) if entry else ""
    told = ui.draw_problem(layout, context, system(), rig, lambda problem: words if words and problem is SOME_ARE_OFF else problem.sentence)
    if words and told is not SOME_ARE_OFF:
        ui.draw_message(layout, words, 'ERROR')
    if entry is None:
        return
    column = ui.split(layout)
    column.prop(entry, "action")
    action = pointed(entry, "action")
    if action and capabilities.has_slotted_actions() and len(action.slots) > 1:
        column.prop_search(entry, "slot", action, "slots")
    rows.BLENDING.draw(_settled(layout, entry), entry)
    if is_compared(entry):
        _settled(layout, entry).prop(entry, "reference_action")
    row = layout.row(align=True)
    row.operator("motus.layer_edit", icon='FCURVE', depress=entry.is_edited).object = rig.name
    row.operator("motus.layer_key", text="Key Pose", icon='KEY_HLT').object = rig.name
    if live.was_left(rig):
        ui.draw_message(layout, tr("The editing of a layer was left in the NLA editor: press Edit Layer to end it"), 'ERROR')


def _settled(layout, entry):
    """Return a column for settings that stay what they are while the layer is edited by its keys."""
    column = ui.split(layout)
    column.enabled = not entry.is_edited
    return column


def draw_timing(layout, context):
    """Draw the settings of when the active layer plays, and which frames of its action."""
    entry = active_entry(context.object)
    if entry:
        rows.TIMING.draw(_settled(layout, entry), entry)


def draw_mask(layout, context):
    """Draw the bones on which the active layer acts."""
    rig = context.object
    entry = active_entry(rig)
    if entry is None:
        return
    layout = layout.column()
    layout.enabled = not entry.is_edited
    add, remove, _ = ui.draw_list(
        layout, "MOTUS_UL_layers_mask", entry, "mask", "active_mask", "motus.layer_mask_add", "motus.layer_mask_remove", rows=2
    )
    for button in (add, remove):
        button.object = rig.name
    if not entry.mask:
        ui.draw_message(layout, tr("The layer acts on all bones: add some to keep it to these"), 'INFO')
    elif 0 <= entry.active_mask < len(entry.mask):
        item, column = entry.mask[entry.active_mask], ui.split(layout)
        column.prop(item, "kind")
        data, name = (rig.data, "bones") if item.kind == 'BONE' else mask.collection_names(rig)
        column.prop_search(item, "name", data, name)
        column.prop(item, "with_children")
        column.prop(item, "weight", slider=True)
    rows.BORDER.draw(ui.split(layout), entry)


def draw_actions(layout, context):
    """Draw the buttons that flatten, bake and remove layers."""
    name = context.object.name
    column = layout.column(align=True)  # the buttons would be too narrow side by side in a narrow editor
    column.operator("motus.layers_flatten", icon='NLA_PUSHDOWN').object = name
    column.operator("motus.layers_to_nla", icon='NLA').object = name
    ui.draw_bake(column)
    column.operator("motus.layer_remove", text="Remove", icon='X').object = name


def _icon_of(entry):
    if pointed(entry, "action") is None:
        return 'ERROR'
    return 'GREASEPENCIL' if entry.is_edited else 'ACTION'


class MOTUS_UL_layers_entries(bpy.types.UIList):
    def draw_item(self, _context, layout, settings, entry, _icon, _active, _name, _index):
        row = layout.row(align=True)
        row.active = not entry.is_muted and (entry.is_solo or not any(one.is_solo for one in settings.entries))
        row.prop(entry, "name", text="", emboss=False, icon=_icon_of(entry))
        field = row.row()
        field.scale_x = 0.8
        field.prop(entry, "weight", text="", slider=True)
        row.prop(entry, "is_solo", text="", icon='SOLO_ON' if entry.is_solo else 'SOLO_OFF', emboss=False)
        row.prop(entry, "is_muted", text="", icon='HIDE_ON' if entry.is_muted else 'HIDE_OFF', emboss=False)


class MOTUS_UL_layers_mask(bpy.types.UIList):
    def draw_item(self, context, layout, _entry, item, _icon, _active, _name, _index):
        row = layout.row(align=True)
        icon = 'ERROR' if not mask.is_there(context.object, item) else 'BONE_DATA' if item.kind == 'BONE' else 'GROUP_BONE'
        row.label(text=item.name, icon=icon, translate=False)
        row.prop(item, "with_children", text="", icon='OUTLINER', emboss=item.with_children)
        field = row.row()
        field.scale_x = 0.6
        field.prop(item, "weight", text="", slider=True)


PANEL = panels.SystemPanel(
    name="layers",
    prefix="MOTUS_PT_layers",
    label="Animation Layers",
    editors={"": ui.Sidebar, "_data": ui.ArmatureData},
    suits=lambda obj: obj.type == 'ARMATURE',
    is_used=lambda rig: is_owner(system(), rig),
    draw=draw_main,
    parts=(panels.Part("mask", "Mask", draw_mask, is_open=True), panels.Part("timing", "Timing", draw_timing, is_open=True)),
    actions=draw_actions,
    refresh=panels.REFRESH,
    presets=presets.PANEL,
    adders=("motus.layer_add",),
)

classes = (MOTUS_UL_layers_entries, MOTUS_UL_layers_mask, *panels.classes(PANEL))
