"""Panels of Follow Path: the sidebar's tab and the object's constraint properties draw the same parts."""

import bpy

from ..core import native, ui, wiring
from ..core.system import Problem
from ..core.translations import OWN_SENSE
from . import members, presets
from .properties import DEFAULT_GAP
from .setup import is_stray, system

COPY_OF_A_WAGON = Problem("A copy of a wagon: it stands where the wagon stands", blocking=False)
LEADER_GONE = Problem("The leader of this wagon is gone")


def _is_follower(context):
    return native.module is not None and context.object is not None and context.object.motus.path.is_active


def draw_main(layout, context):
    """Curve, buttons, problem and read-outs."""
    if native.module is None:
        ui.draw_native_status(layout)
        return
    obj = context.object
    settings = obj.motus.path
    if members.is_wagon(obj):
        _draw_wagon(layout, obj, settings.leader)
        return
    if is_stray(obj):
        _draw_stray(layout, obj, settings.leader)
        return
    if obj.type == 'CURVE':
        layout.operator("motus.path_edit_views", icon='VIEW_ORTHO')
        if not settings.is_active:
            return
    column = ui.split(layout)
    column.prop(settings, "curve")
    if not settings.is_active:
        column.prop(settings, "timing")
        button = column.column()
        button.enabled = settings.curve is not None
        add = button.operator("motus.path_follow_add", icon='CON_FOLLOWPATH')
        add.object = obj.name
        add.curve = settings.curve.name if settings.curve else ""
        return
    ui.draw_problem(layout, context, system(), obj)
    column.prop(settings, "spline", text="Spline", text_ctxt=OWN_SENSE)
    column.prop(settings, "influence", slider=True)
    column.prop(settings, "extend")
    _draw_readouts(layout, context, obj)
    ui.draw_bake(layout, system(), obj)
    column = layout.column(align=True)  # a row would be too narrow in a narrow editor
    column.operator("motus.path_edit_views", text="Edit Views", icon='VIEW_ORTHO')
    column.operator("motus.path_refresh", icon='FILE_REFRESH')
    column.operator("motus.path_follow_remove", text="Remove", icon='X').object = obj.name


def _draw_wagon(layout, wagon, leader):
    box = layout.box().column()
    box.label(text=f"{bpy.app.translations.pgettext_iface('Driven by')} {leader.name}", icon='LINKED', translate=False)
    box.operator("motus.path_select_leader", icon='RESTRICT_SELECT_OFF')
    box.operator("motus.path_follow_remove", text="Take Out", icon='X').object = wagon.name


def _draw_stray(layout, stray, leader):
    if leader:
        ui.draw_message(layout, COPY_OF_A_WAGON.sentence, 'INFO')
        couple = layout.operator("motus.path_wagon_add", text="Add to the Train", icon='ADD')
        couple.object, couple.wagon, couple.gap = leader.name, stray.name, DEFAULT_GAP
    else:
        ui.draw_message(layout, LEADER_GONE.sentence, 'ERROR')
    layout.operator("motus.path_follow_remove", text="Remove", icon='X').object = stray.name


def _draw_readouts(layout, context, owner):
    depsgraph = context.view_layer.depsgraph
    values = {name: wiring.output(system(), owner, name, depsgraph)
              for name in ("length", "distance", "speed", "fraction")}
    if None in values.values():
        return
    grid = layout.box().grid_flow(columns=2, row_major=True, align=True)
    for label, text in (
            ("Length", _length_text(context, values["length"])),
            ("Distance", _length_text(context, values["distance"])),
            ("Speed", _length_text(context, values["speed"]) + "/s"),
            ("Fraction", f"{values['fraction']:.4f}")):
        grid.label(text=label)
        grid.label(text=text, translate=False)


def _length_text(context, value):
    units = context.scene.unit_settings
    system_name = 'METRIC' if units.system == 'NONE' else units.system
    return bpy.utils.units.to_string(system_name, 'LENGTH', value * units.scale_length, precision=4)


def draw_timing(layout, context):
    """What sets the place at a time."""
    settings = context.object.motus.path
    column = ui.split(layout)
    column.prop(settings, "timing")
    if settings.timing == 'DURATION':
        column.prop(settings, "start_frame")
        column.prop(settings, "duration")
        column.prop(settings, "ease_in", slider=True)
        column.prop(settings, "ease_out", slider=True)
    elif settings.timing == 'SPEED':
        column.prop(settings, "start_frame")
        column.prop(settings, "speed")
    elif settings.timing == 'MANUAL':
        column.prop(settings, "distance_factor", slider=True)
    else:
        _draw_pins(layout, settings)
    ui.split(layout).prop(settings, "offset", text="Offset", text_ctxt=OWN_SENSE)


def _draw_pins(layout, settings):
    ui.split(layout).prop(settings, "pins_by")
    row = layout.row()
    row.template_list("MOTUS_UL_path_pins", "", settings, "pins", settings, "active_pin", rows=3)
    buttons = row.column(align=True)
    buttons.operator("motus.path_pin_add", text="", icon='ADD')
    buttons.operator("motus.path_pin_remove", text="", icon='REMOVE')


def draw_orientation(layout, context):
    """Which way the object looks, and what is up."""
    settings = context.object.motus.path
    column = ui.split(layout)
    column.prop(settings, "orientation", text="Mode")
    if settings.orientation == 'NONE':
        return
    column.prop(settings, "forward_axis")
    column.prop(settings, "up_axis")
    if settings.orientation == 'CURVATURE':
        column.prop(settings, "curvature_outward")
        column.prop(settings, "bank_smoothing")
    if settings.orientation == 'BANKING':
        column.prop(settings, "bank_strength")
        column.prop(settings, "bank_limit")
        column.prop(settings, "bank_smoothing")
        column.prop(settings, "gravity")
    column.prop(settings, "lag_rate")
    lag = column.column()
    lag.active = settings.lag_rate > 0.0
    lag.prop(settings, "lag_by")


def draw_train(layout, context):
    """The wagons and their gaps."""
    settings = context.object.motus.path
    row = layout.row()
    row.template_list("MOTUS_UL_path_wagons", "", settings, "wagons", settings, "active_wagon", rows=3)
    buttons = row.column(align=True)
    buttons.operator("motus.path_wagon_add", text="", icon='ADD')
    buttons.operator("motus.path_wagon_remove", text="", icon='REMOVE')


class MOTUS_UL_path_pins(bpy.types.UIList):
    def draw_item(self, _context, layout, settings, pin, _icon, _active, _name, _index):
        row = layout.row(align=True)
        row.prop(pin, "frame", text="", emboss=False)
        row.prop(pin, "fraction" if settings.pins_by == 'FRACTION' else "distance", text="", emboss=False)


class MOTUS_UL_path_wagons(bpy.types.UIList):
    def draw_item(self, _context, layout, _settings, wagon, _icon, _active, _name, _index):
        row = layout.row(align=True)
        row.prop(wagon, "object", text="", emboss=False)
        row.prop(wagon, "gap", text="")


class _Main:
    bl_label = "Follow Path"

    @classmethod
    def poll(cls, context):
        return context.object is not None

    def draw_header_preset(self, context):
        if _is_follower(context):
            presets.PANEL.draw_panel_header(self.layout)

    def draw(self, context):
        draw_main(self.layout, context)


class _Part:
    bl_options = {'DEFAULT_CLOSED'}

    @classmethod
    def poll(cls, context):
        return _is_follower(context)


class _Timing(_Part):
    bl_label = "Timing"
    bl_options = set()

    def draw(self, context):
        draw_timing(self.layout, context)


class _Orientation(_Part):
    bl_label = "Orientation"
    bl_options = set()

    def draw(self, context):
        draw_orientation(self.layout, context)


class _Train(_Part):
    bl_label = "Train"

    def draw(self, context):
        draw_train(self.layout, context)


class MOTUS_PT_path(_Main, ui.Sidebar, bpy.types.Panel):
    pass


class MOTUS_PT_path_timing(_Timing, ui.Sidebar, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_path"


class MOTUS_PT_path_orientation(_Orientation, ui.Sidebar, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_path"


class MOTUS_PT_path_train(_Train, ui.Sidebar, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_path"


class MOTUS_PT_path_constraint(_Main, ui.ObjectConstraints, bpy.types.Panel):
    pass


class MOTUS_PT_path_constraint_timing(_Timing, ui.ObjectConstraints, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_path_constraint"


class MOTUS_PT_path_constraint_orientation(_Orientation, ui.ObjectConstraints, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_path_constraint"


class MOTUS_PT_path_constraint_train(_Train, ui.ObjectConstraints, bpy.types.Panel):
    bl_parent_id = "MOTUS_PT_path_constraint"


classes = (
    MOTUS_UL_path_pins, MOTUS_UL_path_wagons,
    # Panels before their sub-panels.
    MOTUS_PT_path, MOTUS_PT_path_timing, MOTUS_PT_path_orientation, MOTUS_PT_path_train,
    MOTUS_PT_path_constraint, MOTUS_PT_path_constraint_timing, MOTUS_PT_path_constraint_orientation,
    MOTUS_PT_path_constraint_train,
)
