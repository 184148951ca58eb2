"""The panel of lattices, in the sidebar's tab and in the object's own properties."""

from ..core.interface import panels, ui
from ..core.translations import tr
from . import removal, resting, targets


class ObjectProperties:
    """Mixin of panels in the Object tab of the properties editor."""

    bl_space_type = 'PROPERTIES'
    bl_region_type = 'WINDOW'
    bl_context = "object"


def draw_main(layout, context):
    """Draw the lattices that deform the object, or the settings of the lattice itself."""
    obj = context.object
    if obj.type == 'LATTICE':
        _draw_lattice(layout, obj)
    for modifier in _modifiers(obj):
        _draw_modifier(layout, obj, modifier)


def _modifiers(obj):
    return [modifier for modifier in obj.modifiers if modifier.type == 'LATTICE' and modifier.object]


def draw_actions(layout, _context):
    """Draw the button that fits another lattice."""
    layout.operator("motus.lattice_fit", icon='OUTLINER_OB_LATTICE')


def _draw_modifier(layout, obj, modifier):
    box = layout.box().column()
    row = box.row(align=True)
    row.label(text=modifier.object.name, icon='LATTICE_DATA', translate=False)
    row.prop(modifier, "show_viewport", text="")
    if removal.fitted(modifier):
        remove = row.operator("motus.lattice_remove", text="", icon='X')
        remove.objects, remove.modifier = obj.name, modifier.name
    column = ui.split(box)
    column.prop(modifier, "strength", slider=True)
    if obj.type == 'MESH':
        column.prop_search(modifier, "vertex_group", obj, "vertex_groups", text="Group")
    _draw_points(column, modifier.object.data)
    column = box.column(align=True)  # as a row the buttons would be cut off in a narrow editor
    pull = column.operator("motus.lattice_pull", icon='VIEW_PAN')
    pull.object, pull.modifier = obj.name, modifier.name
    column.operator("motus.lattice_reset", icon='LOOP_BACK').object = modifier.object.name
    if obj.type == 'MESH':
        _draw_rest(column, modifier.object, obj.name, modifier.name)
        keep = column.operator("motus.lattice_keep", icon='SHAPEKEY_DATA')
        keep.object, keep.modifier = obj.name, modifier.name
    if removal.fitted(modifier):
        apply = column.operator("motus.lattice_remove", text="Apply", icon='CHECKMARK')
        apply.objects, apply.modifier, apply.use_apply = obj.name, modifier.name, True


def _draw_lattice(layout, obj):
    users = removal.deformed_by(obj)
    if not users:
        ui.draw_message(layout, tr("This lattice deforms nothing"), 'INFO')
        return
    column = layout.column(align=True)
    for user in users:
        column.label(text=user.name, icon='MODIFIER', translate=False)
    column = ui.split(layout)
    _draw_points(column, obj.data)
    column = layout.column(align=True)
    column.operator("motus.lattice_pull", icon='VIEW_PAN').object = obj.name
    column.operator("motus.lattice_reset", icon='LOOP_BACK').object = obj.name
    _draw_rest(column, obj, obj.name)
    column.operator("motus.lattice_keep", icon='SHAPEKEY_DATA').object = obj.name
    if obj.motus.lattice.is_fitted:
        column.operator("motus.lattice_remove", icon='X').objects = obj.name


def _draw_rest(column, lattice, name, modifier=""):
    """Draw the buttons that make the lattice's points its rest, and that take the regular rest again."""
    row = column.row(align=True)
    buttons = [row.operator("motus.lattice_rest", icon='MESH_GRID')]
    if resting.is_made(lattice):
        buttons.append(row.operator("motus.lattice_rest", text="Regular Rest", icon='X'))
        buttons[-1].use_regular = True
    for button in buttons:
        button.object, button.modifier = name, modifier
    if resting.is_lost(lattice, removal.deformed_by(lattice)):
        said = tr("The rest made by hand does not fit any more, as after a change of the resolution: take it anew, or take the regular one")
        ui.draw_message(column, said, 'ERROR')


def _draw_points(layout, data):
    """Draw resolution and interpolation of a lattice."""
    layout.use_property_decorate = False
    for name in ("points", "interpolation_type"):
        column = layout.column(align=True)
        column.label(text="Resolution" if name == "points" else "Interpolation")
        column.enabled = not data.is_editmode
        for axis in "uvw":
            column.prop(data, f"{name}_{axis}", text=axis.upper(), translate=False)
    layout.prop(data, "use_outside")


PANEL = panels.SystemPanel(
    name="lattice",
    prefix="MOTUS_PT_lattice",
    label="Lattice",
    editors={"": ui.Sidebar, "_object": ObjectProperties},
    labels={"_object": "Motus Lattice"},
    suits=lambda obj: obj.type in targets.KINDS,
    is_used=lambda obj: obj.type == 'LATTICE' or bool(_modifiers(obj)),
    draw=draw_main,
    actions=draw_actions,
    adders=("motus.lattice_fit",),
)

classes = panels.classes(PANEL)
