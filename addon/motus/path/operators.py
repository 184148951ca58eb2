"""Operators that let objects follow a path, and that remove followers."""

import bpy

from ..core import wiring
from ..core.file.pointers import pointed
from ..core.interface.operators import OBJECT_MODE, FindsValues, Operator, object_keyword
from ..core.measures import scene_time, units
from ..core.refusals import Refused, check_finite, check_local, named
from ..core.translations import tr
from . import members, rows, setup, targets
from .properties import KEYWORDS, NewFollowKeywords


def follower_for(context, name=""):
    """Return the object of this name, or the active object, which must follow a path.

    Raises Refused if the object follows no path, or must not be changed.
    """
    obj = bpy.data.objects.get(name) if name else context.object
    if obj is None or not obj.motus.path.is_active:
        raise Refused(tr("Nothing here follows a path"))
    check_local(obj)
    return obj


def for_new(context, owner, curve, keywords, is_train=False):
    """Complete the keywords of an operator that lets `owner` follow a curve; returns the keywords.

    For an object that is no follower yet, missing keywords whose values depend on the curve or the scene are added.
    """
    settings = owner.motus.path
    if settings.is_active:
        return keywords
    free = [name for name in KEYWORDS if name not in keywords and not settings.is_property_set(name)]
    found = units.defaults(context.scene, settings, free)
    if "start_frame" in free:
        found["start_frame"] = scene_time.beginning(context.scene)
    if "extend" not in keywords:
        found["extend"] = targets.ends_for(curve, keywords.get("spline", 0), is_train)
    return keywords | found


def make_active(context, obj):
    """Make an object the active object, so that the panels show the new follower instead of the curve."""
    if obj.name in context.view_layer.objects:
        context.view_layer.objects.active = obj


class MOTUS_OT_path_follow_add(FindsValues, NewFollowKeywords, bpy.types.Operator):
    bl_idname = "motus.path_follow_add"
    bl_label = "Follow Path"
    bl_description = "Let the selected objects follow a curve"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    object: object_keyword("Name of the object; empty takes the selected ones")
    curve: bpy.props.StringProperty(
        name="Curve", description="Name of the curve object; empty takes the selected curve", options={'SKIP_SAVE'}
    )

    modes = OBJECT_MODE
    redo = rows.ALL

    @classmethod
    def check_offer(cls, context):
        owners = targets.selected_followers(context)
        _check_any(owners)
        curve = targets.curve_for(context, "", *owners)
        for owner in owners:
            targets.check_free(owner, curve)

    def run(self, context):
        owners = self._add(context)
        if len(owners) == 1:
            self.report({'INFO'}, tr("{object} follows {curve}").format(object=owners[0].name, curve=self.curve))
        else:
            self.report({'INFO'}, tr("{count} objects follow {curve}").format(count=len(owners), curve=self.curve))
        wiring.report_problems(self, context, setup.system(), owners)

    def _add(self, context):
        owners = [named(self.object)] if self.object else targets.selected_followers(context)
        _check_any(owners)
        curve = targets.curve_for(context, self.curve, *owners)
        keywords = self.given(KEYWORDS)
        check_finite(self, keywords)
        rail = targets.rail_for(self.rail, owners)
        for owner in owners:
            targets.check_free(owner, curve)
            targets.check_settings(owner, curve, keywords)
        for owner in owners:
            setup.attach(owner, curve, for_new(context, owner, curve, keywords) | rail)
        self.show_used(owners[0].motus.path, KEYWORDS)
        self.curve = curve.name
        if not self.object:
            make_active(context, owners[0])
        return owners


def _check_any(owners):
    if not owners:
        raise Refused(tr("Select the object that shall follow"))


class MOTUS_OT_path_follow_remove(Operator, bpy.types.Operator):
    bl_idname = "motus.path_follow_remove"
    bl_label = "Remove Follow Path"
    bl_description = "Remove Follow Path, so that the objects stand at their own transforms again"

    object: object_keyword("Name of the object; empty takes the selected ones")

    modes = OBJECT_MODE

    @classmethod
    def check_offer(cls, context):
        if not any(map(_is_set_up, targets.selected_followers(context))):
            raise Refused(tr("Nothing here follows a path"))

    def run(self, context):
        objects = [named(self.object)] if self.object else targets.selected_followers(context)
        removed = [obj.name for obj in objects if _remove(obj)]
        if not removed:
            raise Refused(tr("Nothing here follows a path"))
        self.report({'INFO'}, tr("Removed from {objects}").format(objects=", ".join(removed)))


def _is_set_up(obj):
    return members.is_wagon(obj) or obj.motus.path.is_active or setup.is_stray(obj)


def _remove(obj):
    """Remove the follower settings of an object, uncouple a wagon, or free a stray wagon; returns False if the object is none of these."""
    settings = obj.motus.path
    if not _is_set_up(obj):
        return False
    targets.check_editable(obj)
    if members.is_wagon(obj):
        index = members.index_of(pointed(settings, "leader"), obj)
        targets.check_uncouplable(pointed(settings, "leader"), index)
        setup.uncouple(pointed(settings, "leader"), index)
    elif settings.is_active:
        setup.clear(obj)
    else:
        setup.free(obj)
    return True


classes = (MOTUS_OT_path_follow_add, MOTUS_OT_path_follow_remove)
