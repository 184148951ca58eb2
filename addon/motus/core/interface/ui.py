"""Panel parts that all systems share."""

from typing import Any, NamedTuple

import bpy

from .. import native, wiring
from .view import playback, widths

TAB = "Motus"
FEWEST = 16
"""Characters in a line, however narrow the region."""


class Sidebar:
    """Mixin of panels in the 3D view's sidebar."""

    bl_space_type: Any = 'VIEW_3D'
    bl_region_type: Any = 'UI'
    bl_category = TAB


class CompositorSidebar:
    """Mixin of panels in the compositor's sidebar."""

    bl_space_type = 'NODE_EDITOR'
    bl_region_type = 'UI'
    bl_category = TAB


class _Properties:
    """Mixin of panels in the properties editor."""

    bl_space_type = 'PROPERTIES'
    bl_region_type = 'WINDOW'


class ObjectConstraints(_Properties):
    """Mixin of panels among the constraints of an object."""

    bl_context = "constraint"


class CameraData(_Properties):
    """Mixin of panels in the properties of a camera."""

    bl_context = "data"


class ArmatureData(_Properties):
    """Mixin of panels in the properties of an armature."""

    bl_context = "data"


class BoneConstraints(_Properties):
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


def draw_native_status(layout):
    """Say what is wrong with the native module, with a copy button; True where all is well."""
    if native.module is not None:
        return True
    draw_message(layout, native.status.sentence, 'ERROR')
    layout.operator(MOTUS_OT_copy_text.bl_idname, icon='COPYDOWN').text = native.status.sentence
    return False


def draw_problem(layout, context, system, owner, tell=None):
    """Draw the message of the system's current Problem with an owner, if there is one; returns the Problem or None.

    tell(problem): sentence that replaces the Problem's own one.
    """
    problem = wiring.problem(system, owner, context.view_layer.depsgraph)
    if problem:
        draw_message(layout, tell(problem) if tell else problem.sentence, 'ERROR' if problem.blocking else 'INFO')
    return problem


def draw_bake(layout):
    """The button that bakes all that Motus does to the object; what is baked has a box with the one that unbakes (panels.py).

    A system that stayed live would act once more on top of the keyframes, which hold what all systems together do.
    """
    layout.operator("motus.bake", icon='KEYFRAME').system = ""


def draw_list(layout, kind, settings, name, active, add, remove, rows=3):
    """Draw a UIList with an add and a remove button; returns (add button's properties, remove button's properties, column of the buttons).

    kind: class name of the UIList. name, active: properties of `settings` with the items and the active index.
    add, remove: names of the operators.
    """
    row = layout.row()
    row.use_property_split = row.use_property_decorate = False  # dots for keys would leave no room for names
    row.template_list(kind, "", settings, name, settings, active, rows=rows)
    column = row.column(align=True)
    return column.operator(add, text="", icon='ADD'), column.operator(remove, text="", icon='REMOVE'), column


class Readout(NamedTuple):
    """A number that a system has computed. text: its label. value: as it is shown."""

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
    """A length in the scene's units, as text."""
    units = context.scene.unit_settings
    name = 'METRIC' if units.system == 'NONE' else units.system
    return bpy.utils.units.to_string(name, 'LENGTH', value * units.scale_length, precision=4)


def split(layout, longest=""):
    """A column with its labels on the left of the fields; in a narrow region within the fields, or as near as can be.

    longest: a label that needs more room than most.
    """
    layout.use_property_split = widths.label_fits(longest)
    return layout.column()


def draw_rig_influence(layout, settings):
    """Draw the slider "Rig Influence", by which the influence of each entry of a rig is multiplied."""
    text = bpy.app.translations.pgettext_iface("Rig Influence")
    row = layout.row()  # apart: what is split stays so
    split(row, text).prop(settings, "influence", text=text, translate=False, slider=True)


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
    return max(FEWEST, int((context.region.width / scale - 90.0) / widths.CHARACTER_WIDTH))


classes = (MOTUS_OT_copy_text,)
