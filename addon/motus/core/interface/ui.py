"""Parts of panels that all systems share: base classes for each editor, messages, lists and read-outs."""

from typing import Any, NamedTuple

import bpy

from .. import native, wiring
from ..file.pointers import pointed
from .view import playback, widths

TAB = "Motus"
FEWEST = 16
"""Smallest number of characters in a line of a message, however narrow the region is."""
BUTTON = 24.0
"""Pixels, at a scale of 1, that a button with an icon alone takes in a row."""


class Sidebar:
    """Mixin of panels in the tab Motus of the 3D viewport's sidebar."""

    bl_space_type: Any = 'VIEW_3D'
    bl_region_type: Any = 'UI'
    bl_category = TAB


class CompositorSidebar:
    """Mixin of panels in the tab Motus of the node editor's sidebar, for the compositor."""

    bl_space_type = 'NODE_EDITOR'
    bl_region_type = 'UI'
    bl_category = TAB


class _Properties:
    """Mixin of panels in the properties editor."""

    bl_space_type = 'PROPERTIES'
    bl_region_type = 'WINDOW'


class ObjectConstraints(_Properties):
    """Mixin of panels in the tab of object constraints of the properties editor."""

    bl_context = "constraint"


class CameraData(_Properties):
    """Mixin of panels in the data tab of the properties editor, for a camera."""

    bl_context = "data"


class ArmatureData(_Properties):
    """Mixin of panels in the data tab of the properties editor, for an armature."""

    bl_context = "data"


class BoneConstraints(_Properties):
    """Mixin of panels in the tab of bone constraints of the properties editor."""

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


def draw_native_status(layout):
    """If the native module cannot be used, draw an error and a button that copies the error. Returns whether the module can be used."""
    if native.module is not None:
        return True
    draw_message(layout, native.status.sentence, 'ERROR')
    layout.operator(MOTUS_OT_copy_text.bl_idname, icon='COPYDOWN').text = native.status.sentence
    return False


def draw_problem(layout, context, system, owner, tell=None):
    """Draw the message of the Problem that a system has with an owner at present, if there is one; returns the Problem or None.

    A Problem says why a solver computes nothing, or not everything. owner: object whose settings the system solves. tell(problem): returns
    a sentence that is drawn instead of the Problem's own sentence.
    """
    problem = wiring.problem(system, owner, context.view_layer.depsgraph)
    if problem:
        draw_message(layout, tell(problem) if tell else problem.sentence, 'ERROR' if problem.blocking else 'INFO')
    return problem


def draw_bake(layout):
    """Draw the button that bakes all systems of the active object. The button that unbakes is in the box of baked frames (panels.py).

    The keyframes hold the result of all systems together. A system that stayed live would act again on top of the keyframes.
    """
    layout.operator("motus.bake", icon='KEYFRAME').system = ""


def draw_list(layout, kind, settings, name, active, add, remove, rows=3):
    """Draw a UIList with an Add and a Remove button beside it.

    Returns (properties of the Add button, properties of the Remove button, column of the buttons). kind: class name of the UIList. name,
    active: properties of `settings` that hold the items and the active index. add, remove: identifiers of the operators. rows: height of
    the list.
    """
    row = layout.row()
    row.use_property_split = row.use_property_decorate = False  # the dots that insert keyframes would leave no room for names
    row.template_list(kind, "", settings, name, settings, active, rows=rows)
    column = row.column(align=True)
    return column.operator(add, text="", icon='ADD'), column.operator(remove, text="", icon='REMOVE'), column


class Readout(NamedTuple):
    """A result that a system has computed, to be shown in a panel. text: its label, in English. value: the number as text."""

    text: str
    value: str


def draw_readouts(layout, readouts):
    """Draw a box with a line for each Readout: its label and its value."""
    playback.note()
    labels = [bpy.app.translations.pgettext_iface(readout.text) for readout in readouts]
    texts, values = (max(map(len, words), default=1) for words in (labels, [readout.value for readout in readouts]))
    column = layout.box().column(align=True)
    for label, readout in zip(labels, readouts):
        row = column.split(factor=texts / (texts + values))
        row.label(text=label, translate=False)
        row.label(text=readout.value, translate=False)


def length(context, value):
    """Text of a length with its unit, in the unit system of the context's scene. value: the length in Blender's units."""
    units = context.scene.unit_settings
    name = 'METRIC' if units.system == 'NONE' else units.system
    return bpy.utils.units.to_string(name, 'LENGTH', value * units.scale_length, precision=4)


def split(layout, longest=""):
    """Create a column with the labels left of the fields, or in a narrow region inside the fields, or as near as possible.

    longest: a label that needs more room than most.
    """
    layout.use_property_split = widths.label_fits(longest)
    return layout.column()


def draw_rig_influence(layout, settings):
    """Draw the slider "Rig Influence", by which the influence of each entry of a rig is multiplied."""
    text = bpy.app.translations.pgettext_iface("Rig Influence")
    row = layout.row()  # a row of its own, since split() changes a layout for good
    split(row, text).prop(settings, "influence", text=text, translate=False, slider=True)


def draw_goal(column, settings, pointer, bone):
    """Draw the choice of an object, and of its bone if the object is an armature.

    pointer, bone: names of the settings that hold the object and the bone's name.
    """
    column.prop(settings, pointer, text="")  # a label would leave no room for the name in a narrow sidebar
    goal = pointed(settings, pointer)
    if goal and goal.type == 'ARMATURE':
        column.prop_search(settings, bone, goal.data, "bones", text="")


def draw_message(layout, sentence, icon, beside=0.0):
    """Draw a box with a sentence, wrapped to the width of the region that is drawn.

    icon: before the first line. beside: width in pixels, at a scale of 1, that something beside the box takes.
    """
    import textwrap

    box, most = layout.box().column(align=True), _characters(bpy.context, beside)
    for index, line in enumerate(textwrap.wrap(bpy.app.translations.pgettext_tip(sentence), most)):
        box.label(text=line, icon=icon if index == 0 else 'BLANK1', translate=False)


def _characters(context, beside):
    """Number of characters that fit into a line of the region, beside an icon, the margins and what else takes width."""
    if context.region is None:
        return FEWEST
    scale = context.preferences.system.ui_scale
    return max(FEWEST, int((context.region.width / scale - 90.0 - beside) / widths.CHARACTER_WIDTH))


classes = (MOTUS_OT_copy_text,)
