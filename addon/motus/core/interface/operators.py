"""What all operators share: where they work and why not, refusals that are reported, and the redo panel."""

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import bpy

from .. import native
from ..refusals import Refused, check_local
from ..translations import tr

OFFER = "motus_offer"
"""Member of the context of a button that offers an operator for what is selected: the RNA type of that operator.

Whatever runs below a pressed button has the button's context. An operator that the offered one calls, and a user's own operator
in a menu of Motus, must not count as offered, so a button's offer names its operator.
"""


@dataclass(frozen=True)
class Modes:
    """Modes of the context in which an operator works, and what is said in the other ones."""

    sentence: str
    names: frozenset


# tr() looks the sentences up when they are said.
OBJECT_MODE = Modes("Go to Object Mode first", frozenset({'OBJECT'}))
OBJECT_OR_POSE_MODE = Modes("Go to Object Mode or Pose Mode first", frozenset({'OBJECT', 'POSE'}))
OBJECT_OR_EDIT_MODE = Modes("Go to Object Mode, or to Edit Mode of a mesh", frozenset({'OBJECT', 'EDIT_MESH'}))


def offer(layout):
    """The layout, with buttons that are grey if their operators would refuse what is selected, and whose tooltips say why.

    Scripts name what they mean, so that nothing but the mode counts for them.
    """
    _pressed.clear()
    return _OfferingLayout(layout)


class _OfferingLayout:
    """A layout whose operator buttons, and those of the layouts made in it, have an offer each."""

    def __init__(self, layout):
        self.__dict__["_layout"] = layout

    def __setattr__(self, name, value):
        setattr(self._layout, name, value)

    def __getattr__(self, name):
        found = getattr(self._layout, name)
        return _offering(found) if name in _INNER else found

    def operator(self, operator, *arguments, **keywords):
        return self._offered(operator).operator(operator, *arguments, **keywords)

    def operator_menu_enum(self, operator, *arguments, **keywords):
        return self._offered(operator).operator_menu_enum(operator, *arguments, **keywords)

    def _offered(self, identifier):
        """A row of its own, since what is set in a layout holds for all buttons that follow in it."""
        row = self._layout.row(align=True)
        module, name = identifier.split(".")
        row.context_pointer_set(OFFER, getattr(getattr(bpy.ops, module), name).get_rna_type())
        return row


_INNER = {"box", "column", "column_flow", "grid_flow", "row", "split"}
"""Functions of a layout that make one in it."""


def _offering(make):
    def made(*arguments, **keywords):
        return _OfferingLayout(make(*arguments, **keywords))

    return made


_pressed = set()
"""Operators whose buttons were pressed since buttons were drawn. Blender asks them once more, whether there shall be a redo panel:
that works on what was selected before, and not on what the operator has made of it."""


def is_offered(context, cls):
    """Whether a button offers the operator of this class for what is selected, and not a script."""
    offered = getattr(context, OFFER, None)
    return offered is not None and offered.identifier == _rna_name(cls.bl_idname)


def _rna_name(identifier):
    """Name of the RNA type of the operator with this bl_idname."""
    module, name = identifier.split(".")
    return f"{module.upper()}_OT_{name}"


def select_only(context, *objects):
    """Select these objects alone; the first is the active one."""
    for obj in context.selected_objects:
        obj.select_set(False)
    for obj in objects:
        obj.select_set(True)
    context.view_layer.objects.active = objects[0]


def object_keyword(description):
    """The property by which scripts name an object."""
    return bpy.props.StringProperty(name="Object", description=description, options={'SKIP_SAVE'})


def named_or_active(context, name):
    """The object of this name in the scene; the active object if the name is empty."""
    if not name:
        if context.object is None:
            raise Refused(tr("Select an object, or name one"))
        return context.object
    found = context.scene.objects.get(name)
    if found is None:
        raise Refused(tr("There is no object {object} in the scene").format(object=name))
    return found


class Operator:
    """Mixin of operators. run(context) does the work, and raises Refused with a sentence.

    modes: where it works; None everywhere. redo: groups of rows that the redo panel draws (core/interface/rows.py). for_scripts:
    keywords that it does not draw, beside those that are plainly for scripts (see is_for_scripts).
    """

    bl_options: Any = {'REGISTER', 'UNDO'}
    modes: Modes | None = None
    needs_native = False
    redo: tuple[Any, ...] = ()
    for_scripts: Iterable[str] = ()

    @classmethod
    def poll(cls, context):
        try:
            cls.check_place(context)
            if is_offered(context, cls) and cls not in _pressed:
                cls.check_offer(context)
        except Refused as refusal:
            cls.poll_message_set(str(refusal))
            return False
        return True

    @classmethod
    def check_place(cls, context):
        """Refuse a context in which the operator never works."""
        if cls.needs_native and native.module is None:
            raise Refused(native.status.sentence)
        if cls.modes and context.mode not in cls.modes.names:
            raise Refused(tr(cls.modes.sentence))

    @classmethod
    def check_offer(cls, context):
        """Refuse what is selected, where the operator without keywords would."""

    def execute(self, context):
        try:
            self.run(context)
        except Refused as refusal:
            return self.refuse(refusal)
        if is_offered(context, type(self)):
            _pressed.add(type(self))
        return {'FINISHED'}

    def refuse(self, refusal):
        """Report why nothing was done."""
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
        """Draw what is no row."""

    def is_given(self, name):
        """Whether the caller gave a keyword."""
        return self.properties.is_property_set(name)

    def given(self, names):
        """{name: value} of the keywords among `names` that the caller gave."""
        return {name: getattr(self, name) for name in names if self.is_given(name)}


class FindsValues(Operator):
    """Mixin of operators that find values which the caller did not give, so that the redo panel shows the values that were used.

    A found value is set in the operator, for the redo panel shows nothing else, and noted: it does not count as given until it
    is changed.
    """

    found_values: bpy.props.StringProperty(options={'HIDDEN'})

    def is_given(self, name):
        return super().is_given(name) and not self._is_found(name)

    def show_used(self, settings, names):
        """Copy from new settings the values of all keywords among `names` that the caller did not give."""
        found = {}
        for name in names:
            if not self.is_given(name):
                setattr(self, name, getattr(settings, name))
                found[name] = _plain(getattr(self, name))
        self.found_values = json.dumps(found)

    def _is_found(self, name):
        found = json.loads(self.found_values or "{}")
        return name in found and found[name] == _plain(getattr(self, name))


def _plain(value):
    """The value of a property as JSON has it."""
    if isinstance(value, set):
        return sorted(value)
    return value if isinstance(value, (str, bool, int, float)) else list(value)


class OfAnObject(Operator):
    """Mixin of operators on an object on which a system is set up.

    found(context, name): the object of this name, or the active object if the name is empty. Raises Refused if the system is not set
    up on that object.
    """

    found: Callable[..., Any]

    @classmethod
    def check_offer(cls, context):
        cls.found(context, "")


class OfARig(Operator):
    """Mixin of operators on a system's set-up of a rig, for the modes in which constraints can be changed.

    rig_with(context, name): the rig of this name, or the active one, where it has such a set-up; else raises Refused.
    """

    object: object_keyword("Name of the armature; empty takes the active one")
    modes = OBJECT_OR_POSE_MODE
    rig_with: Callable[..., Any]

    @classmethod
    def check_offer(cls, context):
        check_local(cls.rig_with(context, ""))


def is_for_scripts(prop):
    """Whether a keyword names things or places, which an artist selects: an RNA property of an operator."""
    if prop.is_hidden or prop.type in {'STRING', 'POINTER', 'COLLECTION'}:
        return True
    if prop.type == 'INT' and not prop.is_array:
        return prop.default == -1  # an index
    return prop.type == 'FLOAT' and prop.is_array and prop.unit == 'LENGTH' and not any(prop.default_array)
