"""The panel of a chroma key: in the sidebars of the viewport and of the compositor."""

import bpy

from ..core import panels, ui
from ..core.translations import tr
from . import analysis, compositor, settings, viewing


def draw_main(layout, context):
    """The view, the colour, and the levels of the matte."""
    key = compositor.key_of(context.scene)
    column = ui.split(layout)
    column.prop(context.scene.motus.chroma, "view")
    column.prop(context.scene.motus.chroma, "underneath")
    _draw_background(layout, context)
    column = ui.split(layout)
    _draw_input(column, key, settings.COLOR)
    _draw_settings(column, key, ("black", "white", "balance", "smooth"))


def _draw_background(layout, context):
    node = compositor.node_of(context.scene, compositor.BACKGROUND)
    if node is None:
        return
    if node.image is None:
        ui.draw_message(layout, tr("Choose the clip or image that lies underneath"), 'INFO')
    layout.template_ID(node, "image", open="image.open")


def draw_edge(layout, context):
    """What is done with the edge, and with the light on it."""
    key = compositor.key_of(context.scene)
    column = ui.split(layout)
    _draw_settings(column, key, ("grow", "feather", "despill"))
    _draw_input(column, key, settings.WRAP)


def draw_pictures(layout, context):
    """The footage and the mask."""
    for role, name in ((compositor.FOREGROUND, "image"), (compositor.MASK, "mask")):
        node = compositor.node_of(context.scene, role)
        if node is not None:
            column = layout.column(align=True)
            column.label(text=role)
            column.template_ID(node, name, **({} if name == "mask" else {"open": "image.open"}))


def draw_readouts(layout, context):
    """What was measured of the screen."""
    noted = context.scene.motus.chroma
    ui.draw_readouts(layout, [
        ui.Readout("Screen", _percent(noted.share)), ui.Readout("Unevenness", _percent(noted.luminance_spread)),
        ui.Readout("Color Noise", _percent(noted.chroma_spread)), ui.Readout("Spill", _percent(noted.spill))])
    for sentence in analysis.sentences(noted):
        ui.draw_message(layout, sentence, 'INFO')


def draw_actions(layout, context):
    """Showing it, measuring again, and removing."""
    column = layout.column(align=True)
    if context.space_data is not None and context.space_data.type == 'VIEW_3D':
        column.operator("motus.chroma_key_show", icon='HIDE_OFF', depress=viewing.is_shown(context))
    row = column.row(align=True)
    row.operator("motus.chroma_key_measure", icon='EYEDROPPER').keep_color = False
    row.operator("motus.chroma_key_measure", text="Find Levels").keep_color = True
    column.operator("motus.chroma_key_remove", text="Remove", icon='X')


def _percent(share):
    return f"{100.0 * share:.1f} %"


def _draw_settings(layout, key, keywords):
    for one in settings.OF_KEYING:
        place = settings.place(key, one) if one.keyword in keywords else None
        if place is not None:
            layout.prop(*place, text=one.label)


def _draw_input(layout, key, name):
    place = settings.place_of_input(key, name)
    if place is not None:
        layout.prop(*place, text=name)


PANEL = panels.SystemPanel(
    name="chroma", prefix="MOTUS_PT_chroma", label="Chroma Key",
    editors={"": ui.Sidebar, "_compositor": ui.CompositorSidebar},
    owner=lambda context: context.scene,
    suits=lambda owner: isinstance(owner, bpy.types.Scene),
    is_used=lambda scene: compositor.key_of(scene) is not None,
    draw=draw_main,
    parts=(panels.Part("edge", "Edge and Light", draw_edge, is_open=True), panels.Part("pictures", "Pictures", draw_pictures)),
    readouts=draw_readouts, actions=draw_actions, adders=("motus.chroma_key_setup",))

classes = panels.classes(PANEL)
