"""Panel of the brush, in the sidebar's tab."""

import bpy

from ..core import native, ui
from . import falloff_curve, presets
from .mesh import object_mesh

PRESSURE_ICON = 'STYLUS_PRESSURE'


def draw_number(layout, brush, name, pressure):
    """A number with the switch for the pen's pressure."""
    row = layout.row(align=True)
    row.prop(brush, name)
    row.prop(brush, pressure, text="", icon=PRESSURE_ICON)


def draw_radius(layout, brush):
    """The radius, a length or a number of edges."""
    draw_number(layout, brush, "edge_count" if brush.distance == 'EDGES' else "radius", "use_pressure_size")


def draw_main(layout, context):
    """What is pulled, and how."""
    brush = context.scene.motus.pull
    problem = object_mesh.problem(context.object)
    if problem:
        ui.draw_message(layout, problem, 'ERROR')
    start = layout.row()
    start.scale_y = 1.3
    start.enabled = not problem
    start.operator_context = 'INVOKE_DEFAULT'
    start.operator("motus.pick_pull", icon='SCULPTMODE_HLT')
    column = _split(layout)
    draw_radius(column, brush)
    draw_number(column, brush, "strength", "use_pressure_strength")
    column.prop(brush, "unit")
    column = _split(layout)
    column.prop(brush, "falloff")
    if brush.falloff == 'CLASSIC':
        column.prop(brush, "scale_factor")
    if brush.falloff == 'CURVE':
        _draw_curve(layout, brush)
    column = _split(layout)
    column.prop(brush, "distance")
    column.prop(brush, "direction")
    column.prop(brush, "accumulate")
    column.prop(brush, "show_inset")


def draw_extent(layout, context):
    """Where else it pulls, and what follows less."""
    brush = context.scene.motus.pull
    column = _split(layout)
    column.row(align=True).prop(brush, "mirror", expand=True)
    column.prop_search(brush, "vertex_group", context.object, "vertex_groups")


def draw_limits(layout, context):
    """Between which heights it stays."""
    brush = context.scene.motus.pull
    column = _split(layout)
    column.row(align=True).prop(brush, "clamp_axis", expand=True)
    for name, label in (("minimum", "Minimum"), ("maximum", "Maximum")):
        row = column.row(heading=label, align=True)
        row.prop(brush, f"use_{name}", text="")
        value = row.row(align=True)
        value.active = getattr(brush, f"use_{name}")
        value.prop(brush, name, text="")


def _draw_curve(layout, brush):
    node = falloff_curve.node(brush)
    if node is not None:
        layout.template_curve_mapping(node, "mapping")


def _split(layout):
    layout.use_property_split = True
    layout.use_property_decorate = False
    return layout.column(align=True)


class _Part:
    @classmethod
    def poll(cls, context):
        return native.module is not None and context.object is not None and context.object.type == 'MESH'


class MOTUS_PT_pull(_Part, ui.Sidebar, bpy.types.Panel):
    bl_label = "Pick & Pull"

    def draw_header_preset(self, _context):
        presets.PANEL.draw_panel_header(self.layout)

    def draw(self, context):
        draw_main(self.layout, context)


class MOTUS_PT_pull_extent(_Part, ui.Sidebar, bpy.types.Panel):
    bl_label = "Mirror & Mask"
    bl_parent_id = "MOTUS_PT_pull"

    def draw(self, context):
        draw_extent(self.layout, context)


class MOTUS_PT_pull_limits(_Part, ui.Sidebar, bpy.types.Panel):
    bl_label = "Limits"
    bl_parent_id = "MOTUS_PT_pull"
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        draw_limits(self.layout, context)


# Panels before their sub-panels.
classes = (MOTUS_PT_pull, MOTUS_PT_pull_extent, MOTUS_PT_pull_limits)
