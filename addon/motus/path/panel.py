"""Panels of Follow Path, in the sidebar and in the object's constraint properties."""

import bpy

from ..core import wiring
from ..core.blender import actions
from ..core.declare import Problem
from ..core.file.pointers import pointed
from ..core.interface import panels, ui
from ..core.translations import tr
from . import edit_views, members, presets, rows, targets
from .setup import is_stray, system

MOST_SHOWN = 6  # most followers of a curve that the panel lists
COPY_OF_A_WAGON = Problem("A copy of a wagon: it stands where the wagon stands", blocking=False)
LEADER_GONE = Problem("The leader of this wagon is gone")
REPLACED = Problem(
    "While Influence is 1, keys and drivers of what the path sets have no effect: animate a child of this object", blocking=False
)


def draw_main(layout, context):
    """Draw the solver's error message and the curve field; for a wagon draw its train."""
    obj = context.object
    settings = obj.motus.path
    if members.is_wagon(obj):
        _draw_wagon(layout, obj, pointed(settings, "leader"))
    elif is_stray(obj):
        _draw_stray(layout, obj, pointed(settings, "leader"))
    else:
        ui.draw_problem(layout, context, system(), obj)
        if replaces_animation(obj):
            ui.draw_message(layout, REPLACED.sentence, 'INFO')
        column = ui.split(layout)
        column.prop(settings, "curve")
        rows.PATH.draw(column, settings)


def replaces_animation(follower):
    """Whether the follower's transform has keys or drivers that have no effect, since the path overrides the transform."""
    settings, animation = follower.motus.path, follower.animation_data
    if animation is None or settings.influence < 1.0:
        return False
    replaced = tuple(members.channels(settings))
    return any(curve.data_path.startswith(replaced) for curve in (*actions.fcurves(follower), *animation.drivers))


def draw_add(layout, context):
    """Draw the curve field, the buttons that make a curve or a follower, and the button for the edit views."""
    obj = context.object
    column = layout.column(align=True)
    column.operator("motus.path_new_bezier", icon='CURVE_BEZCURVE')
    if obj is None or obj.type == 'CURVE':
        row = column.row()
        row.enabled = False
        row.label(text=obj.name if obj else "", icon='CURVE_DATA' if obj else 'BLANK1', translate=False)
    else:
        column.prop(obj.motus.path, "curve", text="", icon='CURVE_DATA')
    column.operator("motus.path_follow_add", icon='CON_FOLLOWPATH')
    column.operator("motus.path_train_add", icon='LINKED')
    edit_views.draw_buttons(column, context)


def draw_about(layout, context):
    """Draw the list of objects that follow the active curve."""
    curve = context.object
    if curve.type != 'CURVE':
        return
    followers = targets.followers_of(curve)
    if followers:
        column = layout.column(align=True)
        column.label(text="Followed by")
        for follower in followers[:MOST_SHOWN]:
            column.operator(
                "motus.path_select_follower", text=follower.name, icon='RESTRICT_SELECT_OFF', translate=False
            ).object = follower.name
        if len(followers) > MOST_SHOWN:
            column.label(text=tr("and {count} more").format(count=len(followers) - MOST_SHOWN), translate=False)


def draw_actions(layout, context):
    """Draw the buttons that bake the follower, show the edit views, and remove the follower."""
    column = layout.column(align=True)  # as a row the buttons would be cut off in a narrow editor
    ui.draw_bake(column)
    edit_views.draw_buttons(column, context)
    column.operator("motus.path_follow_remove", text="Remove", icon='X').object = context.object.name


def _draw_wagon(layout, wagon, leader):
    box = layout.box().column()
    box.label(text=f"{bpy.app.translations.pgettext_iface('Driven by')} {leader.name}", icon='LINKED', translate=False)
    box.operator("motus.path_select_leader", icon='RESTRICT_SELECT_OFF')
    box.operator("motus.path_follow_remove", text="Take Out", icon='X').object = wagon.name


def _draw_stray(layout, stray, leader):
    if leader:
        ui.draw_message(layout, COPY_OF_A_WAGON.sentence, 'INFO')
        couple = layout.operator("motus.path_wagon_add", text="Add to the Train", icon='ADD')
        couple.object, couple.wagon = leader.name, stray.name
    else:
        ui.draw_message(layout, LEADER_GONE.sentence, 'ERROR')
    layout.operator("motus.path_follow_remove", text="Remove", icon='X').object = stray.name


def draw_readouts(layout, context):
    """Draw the path's length, and the follower's distance, speed and fraction of the path at the present frame."""
    depsgraph, owner = context.view_layer.depsgraph, context.object
    values = {name: wiring.output(system(), owner, name, depsgraph) for name in ("length", "distance", "speed", "fraction")}
    if None in values.values():
        return
    ui.draw_readouts(
        layout,
        (
            ui.Readout(text="Length", value=ui.length(context, values["length"])),
            ui.Readout(text="Distance", value=ui.length(context, values["distance"])),
            ui.Readout(text="Speed", value=ui.length(context, values["speed"]) + "/s"),
            ui.Readout(text="Fraction", value=f"{values['fraction']:.4f}"),
        ),
    )


def draw_timing(layout, context):
    """Draw the settings that determine the place on the path at a time."""
    settings = context.object.motus.path
    rows.TIMING.draw(ui.split(layout), settings)
    if settings.timing == 'PINS':
        ui.draw_list(layout, "MOTUS_UL_path_pins", settings, "pins", "active_pin", "motus.path_pin_add", "motus.path_pin_remove")
    if settings.timing == 'PLACES':
        ui.draw_list(layout, "MOTUS_UL_path_speeds", settings, "speeds", "active_speed", "motus.path_speed_add", "motus.path_speed_remove")
        layout.operator("motus.path_speeds_from_bends", icon='CURVE_PATH')


def draw_orientation(layout, context):
    """Draw the settings of the follower's orientation along the path."""
    column, settings = ui.split(layout), context.object.motus.path
    if settings.orientation == 'RAIL':
        column.prop(settings, "rail")
    rows.ORIENTATION.draw(column, settings)


def draw_placement(layout, context):
    """Draw the settings of what stands between the path and the follower: its bogies, and the distance beside the path."""
    rows.PLACEMENT.draw(ui.split(layout), context.object.motus.path)


def draw_train(layout, context):
    """Draw the list of a train's wagons with their gaps."""
    settings = context.object.motus.path
    _, _, buttons = ui.draw_list(
        layout, "MOTUS_UL_path_wagons", settings, "wagons", "active_wagon", "motus.path_wagon_add", "motus.path_wagon_remove", rows=4
    )
    buttons.separator()
    for direction in ('UP', 'DOWN'):
        buttons.operator("motus.path_wagon_move", text="", icon=f'TRIA_{direction}').direction = direction
    if not settings.wagons:
        return
    column = ui.split(layout)
    column.prop(settings, "gaps_by")
    by_time = settings.gaps_by == 'TIME'
    if 0 <= settings.active_wagon < len(settings.wagons):
        wagon = settings.wagons[settings.active_wagon]
        column.prop(wagon, "delay" if by_time else "gap")
        column.prop(wagon, "wheelbase")
    column.prop(settings, "delay_of_all" if by_time else "gap_of_all")
    column.prop(settings, "wheelbase_of_all")
    if not by_time:
        layout.operator("motus.path_wagons_touch", icon='FIXED_SIZE')


class MOTUS_UL_path_pins(bpy.types.UIList):
    def draw_item(self, _context, layout, settings, pin, _icon, _active, _name, _index):
        row = layout.row(align=True)
        row.prop(pin, "frame", text="", emboss=False)
        row.prop(pin, "fraction" if settings.pins_by == 'FRACTION' else "distance", text="", emboss=False)


class MOTUS_UL_path_speeds(bpy.types.UIList):
    def draw_item(self, _context, layout, _settings, place, _icon, _active, _name, _index):
        row = layout.row(align=True)
        row.prop(place, "distance", text="", emboss=False)
        row.prop(place, "speed", text="", emboss=False)


class MOTUS_UL_path_wagons(bpy.types.UIList):
    def draw_item(self, _context, layout, _settings, wagon, _icon, _active, _name, _index):
        layout.prop(wagon, "object", text="", emboss=False)


def _is_used(obj):
    return obj.motus.path.is_active or members.is_wagon(obj) or is_stray(obj)


PANEL = panels.SystemPanel(
    name="path",
    prefix="MOTUS_PT_path",
    label="Follow Path",
    editors={"": ui.Sidebar, "_constraint": ui.ObjectConstraints},
    suits=lambda obj: True,
    is_used=_is_used,
    has_settings=lambda obj: obj.motus.path.is_active,
    draw=draw_main,
    parts=(
        panels.Part("timing", "Timing", draw_timing, is_open=True),
        panels.Part("orientation", "Orientation", draw_orientation, is_open=True),
        panels.Part("placement", "Placement", draw_placement),
        panels.Part("train", "Train", draw_train, is_open=True),
    ),
    readouts=draw_readouts,
    actions=draw_actions,
    refresh=panels.REFRESH,
    presets=presets.PANEL,
    draw_add=draw_add,
    draw_about=draw_about,
)

classes = (MOTUS_UL_path_pins, MOTUS_UL_path_speeds, MOTUS_UL_path_wagons, *panels.classes(PANEL))
