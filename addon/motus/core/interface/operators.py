"""Base classes of operators: modes in which they work, tooltips that say why not, reports of refusals, and the redo panel."""

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import bpy

from .. import native
from ..file import stored
from ..refusals import Refused, check_local
from ..translations import tr
from .view import first_steps
from .view.offering import is_offered, pressed


@dataclass(frozen=True)
class Modes:
    """Context modes in which an operator works. names: of the modes. sentence: reported in all different modes."""

    sentence: str
    names: frozenset


# The sentences are translated when they are reported.
OBJECT_MODE = Modes("Go to Object Mode first", frozenset({'OBJECT'}))
OBJECT_OR_POSE_MODE = Modes("Go to Object Mode or Pose Mode first", frozenset({'OBJECT', 'POSE'}))
OBJECT_OR_EDIT_MODE = Modes("Go to Object Mode, or to Edit Mode of a mesh", frozenset({'OBJECT', 'EDIT_MESH'}))


def select_only(context, *objects):
    """Select these objects and nothing else; the first one becomes the active object."""
    for obj in context.selected_objects:
        obj.select_set(False)
    for obj in objects:
        obj.select_set(True)
    context.view_layer.objects.active = objects[0]


def object_keyword(description):
    """Declare the StringProperty of an operator by which scripts name an object."""
    return bpy.props.StringProperty(name="Object", description=description, options={'SKIP_SAVE'})


def named_or_active(context, name):
    """The object of this name in the scene; the active object if the name is empty. Raises Refused if there is none."""
    if not name:
        if context.object is None:
            raise Refused(tr("Select an object, or name one"))
        return context.object
    found = context.scene.objects.get(name)
    if found is None:
        raise Refused(tr("There is no object {object} in the scene").format(object=name))
    return found


class Operator:
    """Mixin of operators. run(context) does the work, and raises Refused with a sentence if it cannot.

    modes: the Modes in which the operator works; None for all modes. needs_native: whether it needs the native module. redo: groups of rows
    that the redo panel draws (core/interface/rows.py). for_scripts: keywords that the redo panel does not draw, in addition to those for
    which is_for_scripts() is true. former_keywords: {former name of a keyword: present name}.
    """

    bl_options: Any = {'REGISTER', 'UNDO'}
    modes: Modes | None = None
    needs_native = False
    redo: tuple[Any, ...] = ()
    for_scripts: Iterable[str] = ()
    former_keywords: Mapping[str, str] = {}

    @classmethod
    def poll(cls, context):
        try:
            cls.check_place(context)
            if is_offered(context, cls) and cls not in pressed:
                cls.check_offer(context)
        except Refused as refusal:
            cls.poll_message_set(str(refusal))
            return False
        return True

    @classmethod
    def check_place(cls, context):
        """Raise Refused if the operator cannot work in the context: the native module is missing, or the mode is a wrong one."""
        if cls.needs_native and native.module is None:
            raise Refused(native.status.sentence)
        if cls.modes and context.mode not in cls.modes.names:
            raise Refused(tr(cls.modes.sentence))

    @classmethod
    def check_offer(cls, context):
        """Raise Refused if the operator, called without keywords, would refuse the selection. Operators override this method."""

    def execute(self, context):
        self._take_former_keywords()
        try:
            self.run(context)
        except Refused as refusal:
            return self.refuse(refusal)
        if is_offered(context, type(self)):
            pressed.add(type(self))
        first_steps.hide(context)
        return {'FINISHED'}

    def _take_former_keywords(self):
        """Set the keywords whose former names the caller has used. The former ones are unset, since the redo panel runs execute() again."""
        for former, name in self.former_keywords.items():
            if self.properties.is_property_set(former):
                setattr(self, name, getattr(self, former))
                self.properties.property_unset(former)

    def refuse(self, refusal):
        """Report the sentence of a Refused as an error; returns {'CANCELLED'}."""
        self.report({'ERROR'}, str(refusal))
        return {'CANCELLED'}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for group in self.redo:
            group.draw(layout, self, has_title=len(self.redo) > 1)
        self.draw_below(context)

    def draw_below(self, context):
        """Draw further content of the redo panel below the rows. Operators override this method."""

    def is_given(self, name):
        """Whether the caller of the operator has set a keyword. name: of the keyword."""
        return self.properties.is_property_set(name)

    def given(self, names):
        """{name: value} of the keywords among `names` that the caller of the operator has set."""
        return {name: getattr(self, name) for name in names if self.is_given(name)}


class FindsValues(Operator):
    """Mixin of operators that find values for keywords that the caller has not set; the redo panel shows the values used.

    A found value is set in the operator, because the redo panel shows only what is set. The value is also stored in `found_values`, and the
    keyword does not count as given until the user changes the value.
    """

    found_values: bpy.props.StringProperty(options={'HIDDEN'})

    def is_given(self, name):
        return super().is_given(name) and not self._is_found(name)

    def show_used(self, settings, names):
        """Copy the values of settings to those keywords among `names` that the caller has not set.

        settings: property group that the operator has just set up, with the values that were used.
        """
        found = {}
        for name in names:
            if not self.is_given(name):
                setattr(self, name, getattr(settings, name))
                found[name] = _plain(getattr(self, name))
        self.found_values = json.dumps(found)

    def _is_found(self, name):
        try:
            found = stored.parse(self.found_values or "{}", lambda value: isinstance(value, dict))
        except stored.Damaged:  # a script or a preset may have given any text
            return False
        return name in found and found[name] == _plain(getattr(self, name))


def _plain(value):
    """Value of a property in a form that JSON can store: a set becomes a sorted list, an array a list."""
    if isinstance(value, set):
        return sorted(value)
    return value if isinstance(value, (str, bool, int, float)) else list(value)


class OfAnObject(Operator):
    """Mixin of operators on an object on which a system is set up.

    found(context, name): the object of this name, or the active object if the name is empty. Raises Refused if the system is not set up on
    that object.
    """

    found: Callable[..., Any]

    @classmethod
    def check_offer(cls, context):
        cls.found(context, "")


class OfARig(Operator):
    """Mixin of operators on a rig on which a system is set up; they work in the modes in which constraints can be changed.

    rig_with(context, name): the rig of this name, or the active object if the name is empty. Raises Refused if the system is not set up on
    that rig.
    """

    object: object_keyword("Name of the armature; empty takes the active one")
    modes = OBJECT_OR_POSE_MODE
    rig_with: Callable[..., Any]

    @classmethod
    def check_offer(cls, context):
        check_local(cls.rig_with(context, ""))


def is_for_scripts(prop):
    """Whether an operator's keyword is only for scripts: a keyword that names things or places, which a user selects instead.

    prop: RNA property of the keyword.
    """
    if prop.is_hidden or prop.type in {'STRING', 'POINTER', 'COLLECTION'}:
        return True
    if prop.type == 'INT' and not prop.is_array:
        return prop.default == -1  # an index
    return prop.type == 'FLOAT' and prop.is_array and prop.unit == 'LENGTH' and not any(prop.default_array)
