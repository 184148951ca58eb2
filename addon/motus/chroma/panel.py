"""Panel of a chroma key, in the sidebars of the 3D viewport and of the compositor."""

import bpy

from ..core.file.pointers import pointed
from ..core.interface import panels, ui
from ..core.translations import tr
from . import analysis, compositor, group, operators, scene_settings, settings, setup, viewing


def draw_main(layout, context):
    """Draw the keys of the scene, the shown view, the screen's colour, and the clip levels of the matte."""
    noted = context.scene.motus.chroma
    key = compositor.active_key(context.scene)
    if any(group.is_of_older_version(node.node_tree) for node in compositor.keys_of(context.scene)):
        ui.draw_message(layout, tr("This key is of an older version, and goes on as it was"), 'INFO')
        layout.operator("motus.chroma_key_refresh", icon='FILE_REFRESH')
    column = ui.split(layout)
    column.prop(noted, "view")
    column.prop(noted, "underneath")
    _draw_background(layout, context)
    _draw_keys(layout, context, key)
    column = ui.split(layout)
    _draw_input(column, key, settings.COLOR)
    color = setup.color_of(key)
    if color and not analysis.is_keyable(color, settings.value(key, "balance")):
        ui.draw_message(layout, tr("A screen is green or blue: nothing is keyed by this colour"), 'ERROR')
    _draw_settings(column, key, ("black", "white", "balance", "gain", "smooth"))


def _draw_keys(layout, context, active):
    """Draw a button for each key of the scene, and the buttons that add and remove a key."""
    keys = compositor.keys_of(context.scene)
    row = layout.row(align=True)
    for index, node in enumerate(keys if len(keys) > 1 else ()):
        row.operator("motus.chroma_key_choose", text=str(index + 1), depress=node == active).index = index
    row.operator("motus.chroma_key_add", icon='ADD', text="" if len(keys) > 1 else None)
    if len(keys) > 1:
        row.operator("motus.chroma_key_drop", icon='REMOVE', text="")


def _draw_background(layout, context):
    node = compositor.node_of(context.scene, compositor.BACKGROUND)
    if node is None:
        return
    noted = context.scene.motus.chroma
    # Keys of older Motus versions store the background only in the node, not in the scene's settings.
    holder = (noted, "background") if node.image == pointed(noted, "background") else (node, "image")
    if node.image is None:
        ui.draw_message(layout, tr("Choose the clip or image that lies underneath"), 'INFO')
    layout.template_ID(*holder, open="image.open")


def draw_edge(layout, context):
    """Draw the settings of the matte's edge and of the core matte, which fills holes inside the subject."""
    key = compositor.active_key(context.scene)
    _draw_settings(ui.split(layout), key, ("grow", "feather", "core"))


def draw_light(layout, context):
    """Draw the settings of despill (removal of the screen's light from the subject) and light wrap."""
    key = compositor.active_key(context.scene)
    column = ui.split(layout)
    _draw_settings(column, key, ("despill",))
    if settings.place(key, settings.BY_KEYWORD["limit"]):
        column.prop(context.scene.motus.chroma, "despill_limit")
    _draw_settings(column, key, ("luminance",))
    _draw_input(column, key, settings.WRAP)


def draw_pictures(layout, context):
    """Draw the key's footage, its background and its masks."""
    scene = context.scene
    key, node = compositor.active_key(scene), compositor.node_of(scene, compositor.FOREGROUND)
    if node is not None:
        column = layout.column(align=True)
        column.label(text=compositor.FOREGROUND)
        column.template_ID(node, "image", open="image.open")
    for kind, name, _ in operators.MASKS:
        if settings.place_of_input(key, name) is not None:
            _draw_mask(layout.column(align=True), kind, name, compositor.mask_of(scene, key, name))


def _draw_mask(column, kind, name, node):
    if node is None:
        column.operator("motus.chroma_mask_add", text=name, icon='ADD').kind = kind
        return
    row = column.row(align=True)
    row.label(text=name)
    row.operator("motus.chroma_mask_remove", text="", icon='X').kind = kind
    if hasattr(node, "mask"):
        column.template_ID(node, "mask")
    else:
        column.template_ID(node, "image", open="image.open")


def draw_readouts(layout, context):
    """Draw the measurements of the green or blue screen, the advice that follows from them, and changes of the color management."""
    noted = context.scene.motus.chroma
    ui.draw_readouts(
        layout,
        [
            ui.Readout("Screen", _percent(noted.share)),
            ui.Readout("Unevenness", _percent(noted.luminance_spread)),
            ui.Readout("Color Noise", _percent(noted.chroma_spread)),
            ui.Readout("Spill", _percent(noted.spill)),
        ],
    )
    for sentence in (*analysis.sentences(noted), *([noted.gap] if noted.gap else ())):
        ui.draw_message(layout, sentence, 'INFO')
    changed = scene_settings.changes(context.scene) if noted.is_scene_set else ()
    if changed:
        names = ", ".join(bpy.app.translations.pgettext_iface(label) for label in changed)
        ui.draw_message(layout, tr("The scene's color management changes the footage's colours: {names}").format(names=names), 'INFO')


def draw_actions(layout, context):
    """Draw the buttons that show the key, measure the screen again, and remove the key."""
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
    name="chroma",
    prefix="MOTUS_PT_chroma",
    label="Chroma Key",
    editors={"": ui.Sidebar, "_compositor": ui.CompositorSidebar},
    owner=lambda context: context.scene,
    suits=lambda owner: isinstance(owner, bpy.types.Scene),
    is_used=lambda scene: compositor.key_of(scene) is not None,
    draw=draw_main,
    parts=(
        panels.Part("edge", "Edge", draw_edge, is_open=True),
        panels.Part("light", "Light", draw_light, is_open=True),
        panels.Part("pictures", "Pictures and Masks", draw_pictures),
    ),
    readouts=draw_readouts,
    actions=draw_actions,
    adders=("motus.chroma_key_setup",),
)

classes = panels.classes(PANEL)
