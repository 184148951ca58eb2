"""The panel of chains in the sidebar and in the constraint properties of bones and objects."""

import bpy

from ..core.interface import bone_entries, panels, ui
from ..core.interface.tracks import panel as track_panel
from ..core.settings import drawn_curves
from ..core.settings.entries import active
from ..core.translations import OWN_SENSE, counted, tr
from . import colliders, making, pins, presets, rows, setup, steps, told

MOST_SHOWN = 3
"""Largest number of colliders that have buttons to record them at a time."""


def draw_main(layout, context):
    """Draw the list of chains, the problem if there is one, and how much and how stiffly the shown chain acts."""
    rig = context.object
    settings = rig.motus.chains
    if rig.type == 'ARMATURE':
        ui.draw_rig_influence(layout, settings)
    else:
        ui.split(layout).prop(settings, "influence", slider=True)
    _, remove, beside = ui.draw_list(
        layout, "MOTUS_UL_chains_entries", settings, "entries", "active_entry", "motus.chains_add", "motus.chains_remove", rows=2
    )
    remove.object, remove.only_active = rig.name, True
    if rig.type == 'ARMATURE':
        beside.operator("motus.chains_mirror", text="", icon='MOD_MIRROR')
    ui.draw_problem(layout, context, setup.system(), rig, lambda problem: told.sentence(rig, problem, context.scene))
    done = steps.done(rig)
    if done is not None:
        ui.draw_readouts(layout, [ui.Readout(text="Motion Solved", value=f"{100.0 * done:.0f} %")])
    entry = active(rig, "chains")
    if entry:
        bone_entries.draw_shown(layout, setup.system(), entry.name, _icon_of(entry))
        column = ui.split(layout)
        rows.AMOUNT.draw(column, entry)
        rows.SPRING.draw(column, entry)


def _icon_of(entry):
    return 'CURVE_DATA' if entry.spline >= 0 else 'OBJECT_DATA' if entry.links else 'BONE_DATA'


def draw_limits(layout, context):
    """Draw how the shown chain stretches, bends, and is kept from others."""
    entry = active(context.object, "chains")
    if entry:
        rows.LIMITS.draw(ui.split(layout), entry)


def draw_forces(layout, context):
    """Draw what pulls the shown chain, how that changes along it, and the widget of the curve that was drawn for this."""
    entry = active(context.object, "chains")
    if not entry:
        return
    rows.FORCES.draw(ui.split(layout), entry)
    node = drawn_curves.node(entry) if entry.use_curve else None
    if node:
        layout.template_curve_mapping(node, "mapping")
    elif entry.use_curve:
        ui.draw_message(layout, tr("The curve's widget is missing: press Refresh"), 'INFO')


def draw_world(layout, context):
    """Draw the wind and the colliders, with buttons that record colliders whose motion is not known."""
    settings = context.object.motus.chains
    rows.WORLD.draw(ui.split(layout), settings)
    if any(obj.type == 'MESH' and colliders.is_skinned(obj) for obj in colliders.members(settings)):
        ui.draw_message(layout, making.DEFORMED_COLLIDER.sentence, 'INFO')
    touched = colliders.over_time(settings, colliders.objects(settings), context.scene)
    for track, keywords in [found for solid in touched for found in solid.unknown][:MOST_SHOWN]:
        track_panel.draw(layout, track, **keywords)


def draw_time(layout, context):
    """Draw how chains begin, loop and start anew, and whether what the shown chain follows is known."""
    rig = context.object
    rows.TIME.draw(ui.split(layout), rig.motus.chains)
    entry = active(rig, "chains")
    source = entry and told.input_of(rig, entry.name, context.scene)
    for track, keywords in source.unknown if source else ():
        track_panel.draw(layout, track, **keywords)


def draw_pins(layout, context):
    """Draw the list of pins, what the active one holds to, and buttons that record targets whose motion is not known."""
    rig = context.object
    settings = rig.motus.chains
    _, remove, _ = ui.draw_list(
        layout, "MOTUS_UL_chains_pins", settings, "pins", "active_pin", "motus.chains_pin", "motus.chains_unpin", rows=2
    )
    remove.object, remove.index = rig.name, settings.active_pin
    if not 0 <= settings.active_pin < len(settings.pins):
        return
    pin = settings.pins[settings.active_pin]
    column = layout.column()
    column.prop_search(pin, "name", rig.data, "bones", text="")
    ui.draw_goal(column, pin, "target", "target_bone")
    rows.PINNING.draw(ui.split(layout), pin)
    for held in pins.over_time(rig, (pin.name,), context.scene):
        if held.place.reason is not None:
            target, bone = held.goal
            track_panel.draw(layout, held.place, datablock=target.name, transform='WORLD', **({"bone": bone} if bone else {}))


def draw_actions(layout, context):
    """Draw the buttons that bake and remove the chains."""
    column = layout.column(align=True)  # the buttons would be too narrow side by side in a narrow editor
    ui.draw_bake(column)
    column.operator("motus.chains_remove", text="Remove All", icon='X').object = context.object.name


def draw_add(layout, context):
    """Draw the button that adds chains from the selected bones, or of the selected objects."""
    bone_entries.draw_add(layout, "motus.chains_add", 'LINKED', _words(context))


def _words(context):
    """Return the label of the button that adds chains; "" if no bones, no curve, and not several objects are selected."""
    if context.mode != 'POSE':
        count = len(context.selected_objects)
        if count == 1 and context.object and context.object.type == 'CURVE':
            return tr("Chain along {name}").format(name=context.object.name)
        return tr("Chain of {count} Objects").format(count=count) if count > 1 else ""
    names = bone_entries.posed(context)
    return counted(len(names), tr("Chain from {name}").format(name=names[0]), tr("Chains from {count} Bones")) if names else ""


class MOTUS_UL_chains_entries(bpy.types.UIList):
    def draw_item(self, _context, layout, _settings, entry, _icon, _active, _name, _index):
        row = layout.row(align=True)
        row.active = not entry.is_muted
        columns = row.split(factor=0.65, align=True)  # the factor leaves room for the name even in a narrow sidebar
        columns.label(text=entry.name, icon=_icon_of(entry), translate=False)
        columns.prop(entry, "weight", text="", slider=True, emboss=False, text_ctxt=OWN_SENSE)
        row.prop(entry, "is_muted", text="", icon='HIDE_ON' if entry.is_muted else 'HIDE_OFF', emboss=False)


class MOTUS_UL_chains_pins(bpy.types.UIList):
    def draw_item(self, _context, layout, _settings, pin, _icon, _active, _name, _index):
        row = layout.row(align=True)
        row.active = not pin.is_muted
        columns = row.split(factor=0.65, align=True)
        columns.label(text=pin.name, icon='PINNED', translate=False)
        columns.prop(pin, "weight", text="", slider=True, emboss=False, text_ctxt=OWN_SENSE)
        row.prop(pin, "is_muted", text="", icon='HIDE_ON' if pin.is_muted else 'HIDE_OFF', emboss=False)


PANEL = panels.SystemPanel(
    name="chains",
    prefix="MOTUS_PT_chains",
    label="Chains",
    editors={"": ui.Sidebar, "_constraint": ui.BoneConstraints, "_object_constraint": ui.ObjectConstraints},
    suits=lambda _obj: True,
    is_used=lambda obj: len(obj.motus.chains.entries) > 0,
    draw=draw_main,
    parts=(
        panels.Part("forces", "Forces", draw_forces, is_open=True),
        panels.Part("limits", "Limits", draw_limits),
        panels.Part("pins", "Pins", draw_pins, is_shown=lambda context: context.object.type == 'ARMATURE'),
        panels.Part("world", "Surroundings", draw_world),
        panels.Part("time", "Time", draw_time),
    ),
    actions=draw_actions,
    refresh=panels.REFRESH,
    presets=presets.PANEL,
    draw_add=draw_add,
)

classes = (MOTUS_UL_chains_entries, MOTUS_UL_chains_pins, *panels.classes(PANEL))
