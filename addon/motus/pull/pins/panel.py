"""The list of pins: in the sidebar's tab and among the modifiers of the object, drawn by the same functions."""

import bpy

from ...core import native, ui, wiring
from ...core.system import Problem
from ...core.translations import OWN_SENSE
from . import solve
from .setup import system

NO_MODIFIER = Problem("The modifier of the pins was removed or applied: remove the pins, or put it back")
NOT_FIRST = Problem("The modifier of the pins has to stand before those that make other vertices", blocking=False)
LOST = Problem("This pin has lost its place: bind it to another vertex, or remove it")
AMBIGUOUS = Problem("Several vertices may be the root of this pin: bind it to one of them")
NOT_USABLE = Problem("A setting of this pin is not a usable number")
WITHOUT_GROUP = Problem("The vertex group of this pin is gone")
WITHOUT_SHAPE = Problem("The shape of this pin is gone from the mesh: remove the pin")
SENTENCES = {solve.LOST: LOST, solve.AMBIGUOUS: AMBIGUOUS, solve.NOT_USABLE: NOT_USABLE, solve.WITHOUT_GROUP: WITHOUT_GROUP,
             solve.WITHOUT_SHAPE: WITHOUT_SHAPE}


def state_of(context, obj, index):
    """How a pin is, as last evaluated: solve.OK where that is not known."""
    found = wiring.output(system(), obj, f"pin{index}", context.view_layer.depsgraph)
    return int(found) if found in solve.PROBLEM_OF else solve.OK


def draw_list(layout, context):
    """The list, its buttons, and what is wrong."""
    if native.module is None:
        ui.draw_native_status(layout)
        return
    obj = context.object
    settings = obj.motus.pull
    row = layout.row()
    row.template_list("MOTUS_UL_pins", "", settings, "pins", settings, "active_pin", rows=4)
    buttons = row.column(align=True)
    buttons.operator("motus.pin_add", text="", icon='ADD')
    buttons.operator("motus.pin_remove", text="", icon='REMOVE')
    buttons.separator()
    buttons.operator("motus.pin_move", text="", icon='TRIA_UP').direction = 'UP'
    buttons.operator("motus.pin_move", text="", icon='TRIA_DOWN').direction = 'DOWN'
    last = layout.row()
    last.active = bool(context.scene.motus.pull.last.object)
    last.operator("motus.pin_add", text="Pin Last Pull", icon='PINNED').from_last = True
    if not settings.is_active:
        return
    _draw_problems(layout, context, obj)
    column = layout.column()
    column.use_property_split = True
    column.prop(settings, "influence", slider=True)
    column = layout.column(align=True)
    column.operator_menu_enum("motus.pin_apply", "to", text="Apply Pins", icon='CHECKMARK')
    column.operator("motus.pin_remove", text="Remove All", icon='X').all = True


def _draw_problems(layout, context, obj):
    settings = obj.motus.pull
    place = wiring.points_place(system(), obj)
    if place is None:
        ui.draw_message(layout, NO_MODIFIER.sentence, 'ERROR')
        layout.operator("motus.pin_restore", icon='LOOP_BACK')
        return
    if any(modifier.type not in _KEEP_VERTICES for modifier in obj.modifiers[:place]):
        ui.draw_message(layout, NOT_FIRST.sentence, 'ERROR')
    states = [state_of(context, obj, index) for index in range(len(settings.pins))]
    if not any(states):
        problem = ui.draw_problem(layout, context, system(), obj)
        if problem and problem.blocking and problem not in solve.PROBLEMS:
            layout.operator("motus.pin_restore", text="Refresh", icon='FILE_REFRESH')
    elif settings.active_pin >= len(states) or states[settings.active_pin] == solve.OK:
        worst = next(state for state in states if state != solve.OK)
        ui.draw_message(layout, solve.PROBLEM_OF[worst].sentence, 'ERROR')


def draw_pin(layout, context):
    """The settings of the active pin."""
    obj = context.object
    settings = obj.motus.pull
    pin = settings.pins[settings.active_pin]
    sentence = SENTENCES.get(state_of(context, obj, settings.active_pin))
    if sentence:
        ui.draw_message(layout, sentence.sentence, 'ERROR')
    column = layout.column()
    column.use_property_split = True
    if pin.shape:
        column.prop(pin, "strength")
        return
    for name in ("strength", "radius", "falloff"):
        column.prop(pin, name)
    if pin.falloff == 'CLASSIC':
        column.prop(pin, "scale_factor")
    column.prop(pin, "distance")
    column.prop(pin, "displacement", text="Offset", text_ctxt=OWN_SENSE)  # its name is longer than the space for labels
    column.row(heading="Mirror").prop(pin, "mirror", expand=True)
    column.prop_search(pin, "vertex_group", obj, "vertex_groups")
    for name in ("minimum", "maximum"):
        row = column.row(heading=pin.bl_rna.properties[name].name)
        row.prop(pin, f"use_{name}", text="")
        value = row.row()
        value.active = getattr(pin, f"use_{name}")
        value.prop(pin, name, text="")
    if pin.use_minimum or pin.use_maximum:
        column.prop(pin, "clamp_axis")
    column = layout.column(align=True)
    column.operator("motus.pin_rebind", icon='SNAP_VERTEX')
    column.operator_menu_enum("motus.pin_mirror", "axis", icon='MOD_MIRROR')


_KEEP_VERTICES = {
    'ARMATURE', 'CAST', 'CURVE', 'DISPLACE', 'HOOK', 'LAPLACIANDEFORM', 'LATTICE', 'MESH_DEFORM', 'SHRINKWRAP',
    'SIMPLE_DEFORM', 'SMOOTH', 'CORRECTIVE_SMOOTH', 'LAPLACIANSMOOTH', 'SURFACE_DEFORM', 'WARP', 'WAVE', 'CLOTH',
    'COLLISION', 'SOFT_BODY', 'DATA_TRANSFER', 'NORMAL_EDIT', 'WEIGHTED_NORMAL', 'UV_PROJECT', 'UV_WARP',
    'VERTEX_WEIGHT_EDIT', 'VERTEX_WEIGHT_MIX', 'VERTEX_WEIGHT_PROXIMITY'}
"""Types of modifiers that leave the vertices what they are."""


class MOTUS_UL_pins(bpy.types.UIList):
    def draw_item(self, context, layout, settings, pin, _icon, _active, _name, index):
        row = layout.row(align=True)
        is_well = state_of(context, settings.id_data, index) == solve.OK
        columns = row.split(factor=0.65, align=True)  # a narrow sidebar has room for the name all the same
        columns.prop(pin, "name", text="", emboss=False, icon='PINNED' if is_well else 'ERROR')
        columns.prop(pin, "strength", text="", emboss=False)
        row.prop(pin, "is_muted", text="", emboss=False, icon='HIDE_ON' if pin.is_muted else 'HIDE_OFF')


class _Pins:
    bl_label = "Pins"

    def draw(self, context):
        draw_list(self.layout, context)


class _Pin:
    bl_label = "Pin"

    @classmethod
    def poll(cls, context):
        if native.module is None or context.object is None or not context.object.motus.pull.is_active:
            return False
        return context.object.motus.pull.active_pin < len(context.object.motus.pull.pins)

    def draw(self, context):
        draw_pin(self.layout, context)


class _Modifiers:
    """Mixin of panels among the modifiers of an object, in the properties editor."""

    bl_space_type = 'PROPERTIES'
    bl_region_type = 'WINDOW'
    bl_context = "modifier"


class MOTUS_PT_pins(_Pins, ui.Sidebar, bpy.types.Panel):
    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == 'MESH'


class MOTUS_PT_pin(_Pin, ui.Sidebar, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_pins"


class MOTUS_PT_pins_modifier(_Pins, _Modifiers, bpy.types.Panel):
    bl_label = "Motus Pins"

    @classmethod
    def poll(cls, context):
        obj = context.object
        return obj is not None and obj.type == 'MESH' and obj.motus.pull.is_active


class MOTUS_PT_pin_modifier(_Pin, _Modifiers, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_pins_modifier"


classes = (
    MOTUS_UL_pins, MOTUS_PT_pins, MOTUS_PT_pin, MOTUS_PT_pins_modifier, MOTUS_PT_pin_modifier)
