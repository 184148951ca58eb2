"""Panel of a snow cover, in the sidebar and in the object's constraint properties; shown for covers."""

from ...core import wiring
from ...core.declare import is_owner
from ...core.interface import panels, ui
from ...core.interface.tracks import panel as track_panel
from .. import births
from . import rows, solve, sources
from .build import system
from .presets import PANEL as PRESETS


def _is_cover(obj):
    return is_owner(system(), obj)


def draw_main(layout, context):
    """Draw the cover's problem if there is one, the button that computes a waiting cover, and the settings of how snow lies."""
    cover = context.object
    problem = ui.draw_problem(layout, context, system(), cover)
    if problem == solve.WAITING:
        layout.operator("motus.snow_cover_work_out", icon='PLAY').object = cover.name
    rows.SNOW.draw(ui.split(layout), cover.motus.snow_cover)


def draw_layer(layout, context):
    """Draw the settings of the layer's mesh, and the material of the snow."""
    settings = context.object.motus.snow_cover
    column = ui.split(layout)
    rows.LAYER.draw(column, settings)
    column.prop(settings, "material")


def draw_surfaces(layout, context):
    """Draw the list of surfaces that snow lies on, and the collection of further surfaces."""
    _draw_list(layout, context.object, 'SURFACES')
    ui.split(layout).prop(context.object.motus.snow_cover, "collection")


def draw_emitters(layout, context):
    """Draw the list of emitters that snow falls from."""
    _draw_list(layout, context.object, 'EMITTERS')


def draw_marks(layout, context):
    """Draw the list of objects that leave marks, how their motion is known if it is not by keys, and how deep they press."""
    cover = context.object
    _draw_list(layout, cover, 'MOVERS')
    for mover in sources.movers(cover.motus.snow_cover):
        found = births.track(mover, context.scene)
        if found.reason is not None:
            track_panel.draw(layout, found, datablock=mover.name)
    rows.MARKS.draw(ui.split(layout), cover.motus.snow_cover)


def _draw_list(layout, cover, what):
    column = layout.column(align=True)
    for index, entry in enumerate(getattr(cover.motus.snow_cover, what.lower())):
        row = column.row(align=True)
        row.prop(entry, "object", text="")
        button = row.operator("motus.snow_cover_entry_remove", text="", icon='X')
        button.object, button.what, button.index = cover.name, what, index
    button = column.operator("motus.snow_cover_entry_add", text="Add Selected", icon='ADD')
    button.object, button.what = cover.name, what


def draw_readouts(layout, context):
    """Draw the volume of the lying snow and its largest depth, if they are known."""
    depsgraph = context.view_layer.depsgraph
    volume, deepest = (wiring.output(system(), context.object, name, depsgraph) for name in ("volume", "deepest"))
    if volume is None or deepest is None:
        return
    ui.draw_readouts(
        layout, [ui.Readout(text="Lying Snow", value=f"{volume:.4g} m³"), ui.Readout(text="Deepest", value=ui.length(context, deepest))]
    )


def draw_actions(layout, context):
    """Draw the button that removes the snow cover."""
    layout.operator("motus.snow_cover_remove", text="Remove", icon='X').object = context.object.name


def draw_add(layout, context):
    """Draw the button that adds a snow cover on the selected meshes."""
    layout.operator_context = 'INVOKE_DEFAULT'
    layout.operator("motus.snow_cover_add", icon='ADD')


PANEL = panels.SystemPanel(
    name="snow_cover",
    prefix="MOTUS_PT_snow_cover",
    label="Snow Cover",
    editors={"": ui.Sidebar, "_constraint": ui.ObjectConstraints},
    suits=sources.is_surface_or_cover,
    is_used=_is_cover,
    draw=draw_main,
    parts=(
        panels.Part("surfaces", "Surfaces", draw_surfaces, is_open=True),
        panels.Part("emitters", "Snow", draw_emitters, is_open=True),
        panels.Part("marks", "Marks", draw_marks),
        panels.Part("layer", "Snow Layer", draw_layer),
    ),
    readouts=draw_readouts,
    actions=draw_actions,
    refresh=panels.REFRESH,
    presets=PRESETS,
    draw_add=draw_add,
)

classes = panels.classes(PANEL)
