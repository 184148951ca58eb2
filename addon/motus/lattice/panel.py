"""Panels of lattices: the sidebar's tab and the object's properties draw the same parts."""

import bpy

from ..core import ui
from ..core.translations import tr
from . import removal, targets


class ObjectProperties:
    """Mixin of panels in the object's own tab of the properties editor."""

    bl_space_type = 'PROPERTIES'
    bl_region_type = 'WINDOW'
    bl_context = "object"


def draw_main(layout, context):
    """The lattices that deform the object, or what the lattice itself does."""
    if not ui.draw_native_status(layout):
        return
    obj = context.object
    if obj.type == 'LATTICE':
        _draw_lattice(layout, obj)
    for modifier in obj.modifiers:
        if modifier.type == 'LATTICE' and modifier.object:
            _draw_modifier(layout, obj, modifier)
    layout.operator("motus.lattice_fit", icon='OUTLINER_OB_LATTICE')


def _draw_modifier(layout, obj, modifier):
    box = layout.box().column()
    row = box.row(align=True)
    row.label(text=modifier.object.name, icon='LATTICE_DATA', translate=False)
    row.prop(modifier, "show_viewport", text="")
    if removal.fitted(modifier):
        remove = row.operator("motus.lattice_remove", text="", icon='X')
        remove.objects, remove.modifier = obj.name, modifier.name
    pull = box.operator("motus.lattice_pull", icon='VIEW_PAN')
    pull.object, pull.modifier = obj.name, modifier.name
    column = box.column()
    column.use_property_split = True
    column.prop(modifier, "strength", slider=True)
    if obj.type == 'MESH':
        column.prop_search(modifier, "vertex_group", obj, "vertex_groups", text="Group")
    _draw_points(column, modifier.object.data)
    row = box.row(align=True)
    row.operator("motus.lattice_reset", icon='LOOP_BACK').object = modifier.object.name
    if removal.fitted(modifier):
        apply = row.operator("motus.lattice_remove", text="Apply", icon='CHECKMARK')
        apply.objects, apply.modifier, apply.use_apply = obj.name, modifier.name, True


def _draw_lattice(layout, obj):
    users = removal.deformed_by(obj)
    if not users:
        ui.draw_message(layout, tr("This lattice deforms nothing"), 'INFO')
        return
    layout.operator("motus.lattice_pull", icon='VIEW_PAN').object = obj.name
    column = layout.column(align=True)
    for user in users:
        column.label(text=user.name, icon='MODIFIER', translate=False)
    column = layout.column()
    column.use_property_split = True
    _draw_points(column, obj.data)
    row = layout.row(align=True)
    row.operator("motus.lattice_reset", icon='LOOP_BACK').object = obj.name
    if obj.motus.lattice.is_fitted:
        row.operator("motus.lattice_remove", icon='X').objects = obj.name


def _draw_points(layout, data):
    """Resolution and interpolation."""
    layout.use_property_decorate = False
    for name in ("points", "interpolation_type"):
        column = layout.column(align=True)
        column.label(text="Resolution" if name == "points" else "Interpolation")
        column.enabled = not data.is_editmode
        for axis in "uvw":
            column.prop(data, f"{name}_{axis}", text=axis.upper(), translate=False)
    layout.prop(data, "use_outside")


class _Main:
    bl_label = "Lattice"
    bl_options = {'DEFAULT_CLOSED'}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type in targets.KINDS

    def draw(self, context):
        draw_main(self.layout, context)


class MOTUS_PT_lattice(_Main, ui.Sidebar, bpy.types.Panel):
    pass


class MOTUS_PT_lattice_object(_Main, ObjectProperties, bpy.types.Panel):
    bl_label = "Motus Lattice"


classes = (MOTUS_PT_lattice, MOTUS_PT_lattice_object)
