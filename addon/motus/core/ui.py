"""Panel parts that all systems share."""

import bpy

from . import native, wiring
from .system import of_owner

TAB = "Motus"
CHARACTER_WIDTH = 6.5  # pixels, of the interface's font at a scale of 1
FEWEST = 16
"""Characters in a line, however narrow the region."""
NARROW = 210.0
"""Pixels at a scale of 1: a region that is no wider has no room for labels beside fields."""


class Sidebar:
    """Mixin of panels in the 3D view's sidebar."""

    bl_space_type = 'VIEW_3D'
    bl_region_type = 'UI'
    bl_category = TAB


class ObjectConstraints:
    """Mixin of panels among the constraints of an object, in the properties editor."""

    bl_space_type = 'PROPERTIES'
    bl_region_type = 'WINDOW'
    bl_context = "constraint"


class BoneConstraints(ObjectConstraints):
    """Mixin of panels among the constraints of a bone."""

    bl_context = "bone_constraint"


class MOTUS_OT_copy_text(bpy.types.Operator):
    bl_idname = "motus.copy_text"
    bl_label = "Copy"
    bl_description = "Copy the message to the clipboard"
    bl_options = {'INTERNAL'}

    text: bpy.props.StringProperty()

    def execute(self, context):
        context.window_manager.clipboard = self.text
        return {'FINISHED'}


class MOTUS_PT_sidebar(Sidebar, bpy.types.Panel):
    bl_label = "Motus"

    def draw(self, context):
        layout = self.layout
        if not draw_native_status(layout):
            return
        if context.object is None:
            layout.label(text="Select an object", icon='INFO')
            return
        layout.label(text=context.object.name, icon='OBJECT_DATA', translate=False)


class MOTUS_PT_overlay(Sidebar, bpy.types.Panel):
    bl_label = "Overlay"
    bl_order = 100
    bl_options = {'DEFAULT_CLOSED'}

    def draw_header(self, context):
        self.layout.prop(context.scene.motus, "show_overlay", text="")

    def draw(self, context):
        settings = context.scene.motus
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.active = settings.show_overlay
        column = layout.column(heading="Show")
        for name in ("show_curve", "show_control_points", "show_tangents", "show_frames", "show_speed", "show_reach",
                     "show_pole", "show_residual"):
            column.prop(settings, name)


def draw_native_status(layout):
    """Say what is wrong with the native module, with a copy button; True where all is well."""
    if native.module is not None:
        return True
    draw_message(layout, native.status.sentence, 'ERROR')
    layout.operator(MOTUS_OT_copy_text.bl_idname, icon='COPYDOWN').text = native.status.sentence
    return False


def draw_problem(layout, context, system, owner):
    """The solver's sentence on this owner, if it has one; returns its Problem."""
    problem = wiring.problem(system, owner, context.view_layer.depsgraph)
    if problem:
        draw_message(layout, problem.sentence, 'ERROR' if problem.blocking else 'INFO')
    return problem


def draw_bake(layout, system, owner):
    """Bake and unbake buttons."""
    row = layout.row(align=True)
    if of_owner(system, owner).is_baked:
        row.operator("motus.unbake", icon='LOOP_BACK').system = system.name
    else:
        row.operator("motus.bake", icon='KEYFRAME').system = system.name


def split(layout):
    """A column with its labels on the left of the fields; in a narrow region within the fields, or as near as can be."""
    region = bpy.context.region
    layout.use_property_split = region is None or region.width / bpy.context.preferences.system.ui_scale > NARROW
    return layout.column()


def draw_message(layout, sentence, icon):
    """A sentence over as many lines as the region that is drawn needs."""
    import textwrap
    box, most = layout.box().column(align=True), _characters(bpy.context)
    for index, line in enumerate(textwrap.wrap(bpy.app.translations.pgettext_tip(sentence), most)):
        box.label(text=line, icon=icon if index == 0 else 'BLANK1', translate=False)


def _characters(context):
    """How many fit in a line of the region, beside an icon and the margins."""
    if context.region is None:
        return FEWEST
    scale = context.preferences.system.ui_scale
    return max(FEWEST, int((context.region.width / scale - 90.0) / CHARACTER_WIDTH))


classes = (MOTUS_OT_copy_text, MOTUS_PT_sidebar, MOTUS_PT_overlay)
