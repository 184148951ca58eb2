"""Panel of the pull brush in the viewport's sidebar."""

from ..core.interface import panels, ui
from ..core.interface.rows import Row, Rows
from . import falloff_curve, presets, rows
from .mesh import object_mesh

PRESSURE_ICON = 'STYLUS_PRESSURE'


def draw_number(layout, brush, name, pressure):
    """Draw a number of the brush, with the switch that lets the pen's pressure scale the number."""
    row = layout.row(align=True)
    row.prop(brush, name)
    row.prop(brush, pressure, text="", icon=PRESSURE_ICON)


def draw_radius(layout, brush):
    """Draw the radius of the brush: a length, or a number of edges if distances are measured in edges."""
    draw_number(layout, brush, "edge_count" if brush.distance == 'EDGES' else "radius", "use_pressure_size")


def draw_strength(layout, brush):
    """Draw the strength of the brush; greyed out if the direction is Cursor, since the drag then gives the displacement."""
    row = layout.row(align=True)
    row.active = brush.direction != 'CURSOR'
    draw_number(row, brush, "strength", "use_pressure_strength")


def draw_accumulate(layout, brush):
    """Draw the brush's switch *Accumulate*; greyed out if the direction is Cursor."""
    row = layout.row(align=True)
    row.active = brush.direction != 'CURSOR'
    row.prop(brush, "accumulate")


def draw_main(layout, context):
    """Draw the settings of the brush; above them the reason if the active object cannot be pulled."""
    brush = context.scene.motus.pull
    problem = object_mesh.problem(context.object)
    if problem:
        ui.draw_message(layout, problem, 'ERROR')
    column = _split(layout)
    draw_radius(column, brush)
    draw_strength(column, brush)
    column.prop(brush, "unit")
    column = _split(layout)
    column.prop(brush, "falloff")
    if brush.falloff == 'CLASSIC':
        column.prop(brush, "scale_factor")
    if brush.falloff == 'CURVE':
        _draw_curve(layout, brush)
    column = _split(layout)
    column.prop(brush, "distance")
    column.prop(brush, "weld")
    _draw_welded(layout, context.object, brush)
    column = _split(layout)
    column.prop(brush, "direction")
    draw_accumulate(column, brush)
    column.prop(brush, "show_inset")


def _draw_welded(layout, obj, brush):
    """Draw how many vertices of the object the last pull has welded; nothing if the weld distance was a different one."""
    last = brush.last
    if brush.weld > 0.0 and obj and (last.object, last.weld) == (obj.name, brush.weld):
        ui.draw_readouts(layout, [ui.Readout(text="Welded", value=str(last.welded))])


def draw_actions(layout, context):
    """Draw the button that starts pulling with the mouse."""
    start = layout.row()
    start.scale_y = 1.3
    start.enabled = not object_mesh.problem(context.object)
    start.operator_context = 'INVOKE_DEFAULT'
    start.operator("motus.pick_pull", icon='SCULPTMODE_HLT')


def _draw_rows(*found):
    """Return a function that draws these rows of brush settings in the panel."""
    return lambda layout, context: Rows(found).draw(_split(layout), context.scene.motus.pull)


def _draw_curve(layout, brush):
    node = falloff_curve.node(brush)
    if node is not None:
        layout.template_curve_mapping(node, "mapping")


def _split(layout):
    layout.use_property_split = True
    layout.use_property_decorate = False
    return layout.column(align=True)


# The brush belongs to the scene, so that no object counts as its user.
PANEL = panels.SystemPanel(
    name="pull",
    prefix="MOTUS_PT_pull",
    label="Pick & Pull",
    editors={"": ui.Sidebar},
    suits=lambda obj: obj.type == 'MESH',
    draw=draw_main,
    parts=(
        panels.Part("extent", "Mirror & Mask", _draw_rows(*rows.EXTENT), is_open=True),
        panels.Part("limits", "Limits", _draw_rows(Row("clamp_axis", expand=True), *rows.LIMITS)),
    ),
    actions=draw_actions,
    presets=presets.PANEL,
    adders=("motus.pick_pull",),
)

classes = panels.classes(PANEL)
