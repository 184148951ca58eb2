"""Operators that add, remove and select walkers, and set the rest positions of their feet."""

import bpy

from ..core import wiring
from ..core.declare import is_owner
from ..core.file.pointers import pointed
from ..core.interface.operators import OBJECT_OR_POSE_MODE, FindsValues, OfAnObject, Operator, object_keyword, select_only
from ..core.refusals import check_finite, named_collection
from ..core.translations import tr
from . import legs, rows, setup, targets
from .properties import KEYWORDS, WalkerKeywords


class GroundKeywords:
    """Mixin of operators that add a walker: properties that name the ground, which its feet stand on."""

    ground: bpy.props.StringProperty(name="Ground", description="Name of a mesh object that the feet stand on", options={'SKIP_SAVE'})
    grounds: bpy.props.StringProperty(
        name="Collection", description="Name of a collection whose mesh objects the feet stand on", options={'SKIP_SAVE'}
    )
    carrier: bpy.props.StringProperty(
        name="Carrier", description="Name of an object that carries body and ground, such as a ship", options={'SKIP_SAVE'}
    )


def ground_of(operator, owner=None):
    """Return {name: value} of the walker settings for the ground that an operator's properties name; {} if they name none.

    owner: object that walks, which cannot be its own ground; None if it does not exist yet.
    """
    found = {}
    if operator.ground:
        found["ground"] = targets.ground_for(operator.ground, owner)
    if operator.grounds:
        found["grounds"] = named_collection(operator.grounds)
    if operator.carrier:
        found["carrier"] = targets.carrier_for(operator.carrier, owner)
    return found


class MOTUS_OT_walker_add(FindsValues, WalkerKeywords, GroundKeywords, bpy.types.Operator):
    bl_idname = "motus.walker_add"
    bl_label = "Add Walker"
    bl_description = "Let the feet of a body step by themselves while the body moves; where they stand now become their rest positions"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    object: object_keyword("Name of the body that is moved, such as the armature; empty takes the active object")
    feet: bpy.props.StringProperty(
        name="Feet",
        description="Names of the feet with commas between: bones of the armature, or objects; empty takes the targets of "
        "its chains, or the other selected objects",
        options={'SKIP_SAVE'},
    )
    body: bpy.props.StringProperty(
        name="Body",
        description="Name of the bone, or of the child object, that rises and leans with the feet; empty leaves the one that is there, or takes "
        "the bone that all chains hang on",
        options={'SKIP_SAVE'},
    )

    modes = OBJECT_OR_POSE_MODE
    needs_native = True
    redo = rows.ALL

    @classmethod
    def check_offer(cls, context):
        owner = targets.owner_for(context, "")
        targets.legs_for(context, owner, "")

    def run(self, context):
        check_finite(self, KEYWORDS)
        owner = targets.owner_for(context, self.object)
        changes = self.given(KEYWORDS) | ground_of(self, owner)
        is_there = is_owner(setup.system(), owner) and not self.feet
        found = targets.legs_again(context, owner, bool(self.object)) if is_there else targets.legs_for(context, owner, self.feet)
        if found is None:
            setup.change(owner, changes | self._body(owner))
        else:
            body = targets.body_for(owner, self.body, [leg.bone or leg.foot for leg in found])
            setup.attach(context, owner, found, body, changes)
        self.show_used(owner.motus.walker, KEYWORDS)
        self.report({'INFO'}, tr("{object} walks on {count} legs").format(object=owner.name, count=len(owner.motus.walker.legs)))
        wiring.report_problems(self, context, setup.system(), [owner])

    def _body(self, owner):
        """Return {setting: value} for the body that the operator's property names; {} if it is empty."""
        feet = [legs.bone(leg) or pointed(leg, "foot") for leg in owner.motus.walker.legs]
        return {"body_bone" if owner.pose else "body": targets.body_for(owner, self.body, feet)} if self.body else {}


class _OfAWalker(OfAnObject):
    """Base of operators that change one walker: the one that `object` names, or the active object's."""

    object: object_keyword("Name of the body that walks; empty takes the active object")
    modes = OBJECT_OR_POSE_MODE
    found = staticmethod(targets.editable_walker)


class MOTUS_OT_walker_remove(_OfAWalker, bpy.types.Operator):
    bl_idname = "motus.walker_remove"
    bl_label = "Remove Walker"
    bl_description = "Remove the walker, so that feet and body have their own animation again"

    def run(self, context):
        owner = self.found(context, self.object)
        setup.remove(owner)
        self.report({'INFO'}, tr("Removed from {objects}").format(objects=owner.name))


class MOTUS_OT_walker_rest(_OfAWalker, bpy.types.Operator):
    bl_idname = "motus.walker_rest"
    bl_label = "Set Rest Positions from Pose"
    bl_description = "Set the rest positions of the feet to where their own transforms have them on this frame"

    def run(self, context):
        owner = self.found(context, self.object)
        count = setup.take_rests(context, owner)
        self.report({'INFO'}, tr("Rest positions of {count} feet updated").format(count=count))


class MOTUS_OT_walker_select(Operator, bpy.types.Operator):
    bl_idname = "motus.walker_select"
    bl_label = "Select Walker"
    bl_description = "Select the body whose settings drive this one"

    modes = OBJECT_OR_POSE_MODE

    @classmethod
    def check_offer(cls, context):
        targets.walker_for(context, "")

    def run(self, context):
        select_only(context, targets.walker_for(context, ""))


classes = (MOTUS_OT_walker_add, MOTUS_OT_walker_remove, MOTUS_OT_walker_rest, MOTUS_OT_walker_select)
