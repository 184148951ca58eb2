"""Operators that add and remove followers."""

import bpy

from ..core import wiring
from ..core.refusals import Refused, check_finite, check_local, named
from ..core.translations import tr
from . import members, setup, targets
from .properties import KEYWORDS, FollowKeywords


def given_keywords(operator):
    """The settings that the caller gave, by name."""
    return {name: getattr(operator, name) for name in KEYWORDS if operator.properties.is_property_set(name)}


def follower_of(operator, context):
    """The follower that the operator's `object` names, or the active one; None, reported, where there is none to change."""
    obj = bpy.data.objects.get(operator.object) if operator.object else context.object
    try:
        if obj is None or not obj.motus.path.is_active:
            raise Refused(tr("Nothing here follows a path"))
        check_local(obj)
    except Refused as refusal:
        operator.report({'ERROR'}, str(refusal))
        return None
    return obj


def in_object_mode(cls, context):
    """poll: Blender refuses changes of constraints and selection in the other modes."""
    if context.mode == 'OBJECT':
        return True
    cls.poll_message_set(tr("Go to Object Mode first"))
    return False


def report_problems(operator, context, owners):
    """Warn of what keeps the owners from following, as far as they are evaluated here."""
    context.view_layer.update()
    depsgraph = context.view_layer.depsgraph
    problems = {wiring.problem(setup.system(), owner, depsgraph) for owner in owners
                if owner.evaluated_get(depsgraph).is_evaluated}
    for sentence in sorted(problem.sentence for problem in problems if problem):
        operator.report({'WARNING'}, tr(sentence))


class MOTUS_OT_path_follow_add(FollowKeywords, bpy.types.Operator):
    bl_idname = "motus.path_follow_add"
    bl_label = "Follow Path"
    bl_description = "Let the selected objects follow a curve"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    object: bpy.props.StringProperty(
        name="Object", description="Name of the object; empty takes the selected ones", options={'SKIP_SAVE'})
    curve: bpy.props.StringProperty(
        name="Curve", description="Name of the curve object; empty takes the selected one", options={'SKIP_SAVE'})

    poll = classmethod(in_object_mode)

    def execute(self, context):
        try:
            owners = self._add(context)
        except Refused as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        if len(owners) == 1:
            self.report({'INFO'}, tr("{object} follows {curve}").format(object=owners[0].name, curve=self.curve))
        else:
            self.report({'INFO'}, tr("{count} objects follow {curve}").format(count=len(owners), curve=self.curve))
        report_problems(self, context, owners)
        return {'FINISHED'}

    def _add(self, context):
        owners = [named(self.object)] if self.object else targets.selected_followers(context)
        if not owners:
            raise Refused(tr("Select the object that shall follow"))
        curve = targets.curve_for(context, self.curve, *owners)
        keywords = given_keywords(self)
        check_finite(self, keywords)
        for owner in owners:
            targets.check_free(owner, curve)
            targets.check_settings(owner, curve, keywords)
        for owner in owners:
            setup.attach(owner, curve, keywords)
        self.curve = curve.name
        return owners


class MOTUS_OT_path_follow_remove(bpy.types.Operator):
    bl_idname = "motus.path_follow_remove"
    bl_label = "Remove Follow Path"
    bl_description = "Let the objects stand at their own transforms again"
    bl_options = {'REGISTER', 'UNDO'}

    object: bpy.props.StringProperty(
        name="Object", description="Name of the object; empty takes the selected ones", options={'SKIP_SAVE'})

    poll = classmethod(in_object_mode)

    def execute(self, context):
        try:
            objects = [named(self.object)] if self.object else targets.selected_followers(context)
            removed = [obj.name for obj in objects if _remove(obj)]
        except Refused as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        if not removed:
            self.report({'ERROR'}, tr("Nothing here follows a path"))
            return {'CANCELLED'}
        self.report({'INFO'}, tr("Removed from {objects}").format(objects=", ".join(removed)))
        return {'FINISHED'}


class MOTUS_OT_path_refresh(bpy.types.Operator):
    bl_idname = "motus.path_refresh"
    bl_label = "Refresh"
    bl_description = "Wire the object again, after its curve was given other data"
    bl_options = {'REGISTER', 'UNDO'}

    object: bpy.props.StringProperty(
        name="Object", description="Name of the object; empty takes the active one", options={'SKIP_SAVE'})

    poll = classmethod(in_object_mode)

    def execute(self, context):
        obj = follower_of(self, context)
        if obj is None:
            return {'CANCELLED'}
        wiring.refresh(setup.system(), obj)
        return {'FINISHED'}


def _remove(obj):
    """Remove the follower, take the wagon out of its train or free a stray one; False where it is none of them."""
    settings = obj.motus.path
    is_wagon = members.is_wagon(obj)
    if not (is_wagon or settings.is_active or setup.is_stray(obj)):
        return False
    targets.check_editable(obj)
    if is_wagon:
        index = members.index_of(settings.leader, obj)
        targets.check_uncouplable(settings.leader, index)
        setup.uncouple(settings.leader, index)
    elif settings.is_active:
        setup.clear(obj)
    else:
        setup.free(obj)
    return True


classes = (MOTUS_OT_path_follow_add, MOTUS_OT_path_follow_remove, MOTUS_OT_path_refresh)
