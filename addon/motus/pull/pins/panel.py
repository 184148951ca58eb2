"""Panels with the list of pins, in the sidebar and in the modifier tab of the object."""

import bpy

from ...core import wiring
from ...core.declare import Problem
from ...core.interface import panels, ui
from ...core.interface.rows import Row, Rows
from ...core.translations import OWN_SENSE
from .. import rows
from . import solve
from .overlay import RESTING
from .setup import system

NO_MODIFIER = Problem("The modifier of the pins was removed or applied: remove the pins, or put it back")
NOT_FIRST = Problem("The modifier of the pins has to stand before those that make other vertices", blocking=False)
LOST = Problem("This pin has lost its place: bind it to another vertex, or remove it")
AMBIGUOUS = Problem("Several vertices may be the root of this pin: bind it to one of them")
NOT_USABLE = Problem("A setting of this pin is not a usable number")
WITHOUT_GROUP = Problem("The vertex group of this pin is gone")
WITHOUT_SHAPE = Problem("The shape of this pin is gone from the mesh: remove the pin")
SENTENCES = {
    solve.LOST: LOST,
    solve.AMBIGUOUS: AMBIGUOUS,
    solve.NOT_USABLE: NOT_USABLE,
    solve.WITHOUT_GROUP: WITHOUT_GROUP,
    solve.WITHOUT_SHAPE: WITHOUT_SHAPE,
}


def state_of(context, obj, index):
    """Status number of a pin at the last evaluation, such as solve.LOST; solve.OK if the status is unknown."""
    found = wiring.output(system(), obj, f"pin{index}", context.view_layer.depsgraph)
    return int(found) if found in solve.PROBLEM_OF else solve.OK


def draw_list(layout, context):
    """Draw the list of pins, the problems of its pins, and the influence of all pins."""
    obj = context.object
    settings = obj.motus.pull
    _, _, buttons = ui.draw_list(layout, "MOTUS_UL_pins", settings, "pins", "active_pin", "motus.pin_add", "motus.pin_remove", rows=4)
    buttons.separator()
    for direction in ('UP', 'DOWN'):
        buttons.operator("motus.pin_move", text="", icon=f'TRIA_{direction}').direction = direction
    if obj.mode == 'EDIT':
        ui.draw_message(layout, RESTING.sentence, 'INFO')
    _draw_problems(layout, context, obj)
    ui.split(layout).prop(settings, "influence", slider=True)


def draw_add(layout, context):
    """Draw the buttons that add a pin."""
    column = layout.column(align=True)
    column.operator("motus.pin_add", icon='PINNED')
    _draw_pin_last(column, context)


def draw_actions(layout, context):
    """Draw the buttons that apply, bind and remove pins."""
    column = layout.column(align=True)
    _draw_pin_last(column, context)
    column.operator_menu_enum("motus.pin_apply", "to", text="Apply Pins", icon='CHECKMARK')
    column.operator("motus.pin_remove", text="Remove All", icon='X').all = True


def _draw_pin_last(layout, context):
    row = layout.row()
    row.active = bool(context.scene.motus.pull.last.object)
    row.operator("motus.pin_add", text="Pin Last Pull", icon='PINNED').from_last = True


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
            layout.operator("motus.pin_restore", icon='LOOP_BACK')
    elif not 0 <= settings.active_pin < len(states) or states[settings.active_pin] == solve.OK:
        worst = next(state for state in states if state != solve.OK)
        ui.draw_message(layout, solve.PROBLEM_OF[worst].sentence, 'ERROR')


def draw_pin(layout, context):
    """Draw the settings of the active pin."""
    obj = context.object
    settings = obj.motus.pull
    pin = settings.pins[settings.active_pin]
    sentence = SENTENCES.get(state_of(context, obj, settings.active_pin))
    if sentence:
        ui.draw_message(layout, sentence.sentence, 'ERROR')
    column = ui.split(layout)
    if pin.shape:
        column.prop(pin, "strength")
        return
    _FORM.draw(column, pin)
    column = layout.column(align=True)
    column.operator("motus.pin_rebind", icon='SNAP_VERTEX')
    column.operator_menu_enum("motus.pin_mirror", "axis", icon='MOD_MIRROR')


# "Displacement" is longer than the space for labels
_FORM = Rows(
    ("strength", "radius", *rows.FORM, Row("displacement", text="Offset", text_ctxt=OWN_SENSE), *rows.EXTENT, *rows.LIMITS, rows.CLAMPED)
)

_KEEP_VERTICES = {
    'ARMATURE',
    'CAST',
    'CURVE',
    'DISPLACE',
    'HOOK',
    'LAPLACIANDEFORM',
    'LATTICE',
    'MESH_DEFORM',
    'SHRINKWRAP',
    'SIMPLE_DEFORM',
    'SMOOTH',
    'CORRECTIVE_SMOOTH',
    'LAPLACIANSMOOTH',
    'SURFACE_DEFORM',
    'WARP',
    'WAVE',
    'CLOTH',
    'COLLISION',
    'SOFT_BODY',
    'DATA_TRANSFER',
    'NORMAL_EDIT',
    'WEIGHTED_NORMAL',
    'UV_PROJECT',
    'UV_WARP',
    'VERTEX_WEIGHT_EDIT',
    'VERTEX_WEIGHT_MIX',
    'VERTEX_WEIGHT_PROXIMITY',
}
"""Types of modifiers that keep the number and the order of the vertices."""


class MOTUS_UL_pins(bpy.types.UIList):
    def draw_item(self, context, layout, settings, pin, _icon, _active, _name, index):
        row = layout.row(align=True)
        is_well = state_of(context, settings.id_data, index) == solve.OK
        columns = row.split(factor=0.65, align=True)  # even a narrow sidebar has room for the name
        columns.prop(pin, "name", text="", emboss=False, icon='PINNED' if is_well else 'ERROR')
        columns.prop(pin, "strength", text="", emboss=False)
        row.prop(pin, "is_muted", text="", emboss=False, icon='HIDE_ON' if pin.is_muted else 'HIDE_OFF')


def _has_active_pin(context):
    settings = context.object.motus.pull
    return 0 <= settings.active_pin < len(settings.pins)


class ObjectModifiers:
    """Mixin of panels in the modifier tab of the properties editor."""

    bl_space_type = 'PROPERTIES'
    bl_region_type = 'WINDOW'
    bl_context = "modifier"


PANEL = panels.SystemPanel(
    name="pull",
    prefix="MOTUS_PT_pins",
    label="Pins",
    editors={"": ui.Sidebar, "_modifier": ObjectModifiers},
    labels={"_modifier": "Motus Pins"},
    suits=lambda obj: obj.type == 'MESH',
    is_used=lambda obj: obj.motus.pull.is_active,
    draw=draw_list,
    parts=(panels.Part("pin", "Pin", draw_pin, is_open=True, is_shown=_has_active_pin),),
    actions=draw_actions,
    refresh="motus.pin_restore",
    draw_add=draw_add,
)

classes = (MOTUS_UL_pins, *panels.classes(PANEL))
