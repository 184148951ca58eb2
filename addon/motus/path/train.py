"""The operator that couples several objects: exact gaps along the arc."""

import bpy
from mathutils import Vector

from ..core.operators import OBJECT_MODE, Operator
from ..core.refusals import Refused, check_finite
from ..core.rows import Rows
from ..core.translations import tr
from . import rows, setup, targets
from .operators import report_problems
from .properties import DEFAULT_GAP, KEYWORDS, FollowKeywords

DIRECTIONS = {
    identifier: sign * Vector((axis == 'X', axis == 'Y', axis == 'Z'))
    for axis in "XYZ" for identifier, sign in ((f"POS_{axis}", 1.0), (f"NEG_{axis}", -1.0))}


class MOTUS_OT_path_train_add(Operator, FollowKeywords, bpy.types.Operator):
    bl_idname = "motus.path_train_add"
    bl_label = "Follow Path as a Train"
    bl_description = "Let the selected objects follow a curve one behind the other, the active one first"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    objects: bpy.props.StringProperty(
        name="Objects", description="Names with commas between, or a collection's name; empty takes the selected ones",
        options={'SKIP_SAVE'})
    curve: bpy.props.StringProperty(
        name="Curve", description="Name of the curve object; empty takes the selected one", options={'SKIP_SAVE'})
    gap: bpy.props.FloatProperty(
        name="Gap", description="Distance along the path from one to the next; 0 takes the lengths of the objects",
        default=DEFAULT_GAP, min=0.0, subtype='DISTANCE')

    modes = OBJECT_MODE
    redo = (Rows(("gap",)), *rows.ALL)

    @classmethod
    def check_offer(cls, context):
        train = targets.selected_followers(context)
        _check_long_enough(train)
        curve = targets.curve_for(context, "", train[0])
        for obj in train:
            targets.check_free(obj, curve, train[0])

    def run(self, context):
        train = self._add(context)
        self.report({'INFO'}, tr("{count} objects follow {curve}").format(count=len(train), curve=self.curve))
        report_problems(self, context, train[:1])

    def _add(self, context):
        train = targets.named_list(self.objects) if self.objects else targets.selected_followers(context)
        _check_long_enough(train)
        if len(set(train)) < len(train):
            raise Refused(tr("An object can be in the train only once"))
        leader, *wagons = train
        curve = targets.curve_for(context, self.curve, leader)
        keywords = self.given(KEYWORDS)
        check_finite(self, (*keywords, "gap"))
        targets.check_settings(leader, curve, keywords)
        targets.check_free(leader, curve)
        for wagon in wagons:
            targets.check_wagon(wagon, curve, leader)
        if self.gap:
            gaps = [self.gap] * len(wagons)
        else:
            gaps = touching_gaps(train, self.forward_axis)
        setup.attach(leader, curve, keywords, list(zip(wagons, gaps)))
        self.curve = curve.name
        return train


def _check_long_enough(train):
    if len(train) < 2:
        raise Refused(tr("A train needs two objects at least"))


def touching_gaps(train, forward_axis):
    """Distances of the objects' origins from one to the next where each touches the one in front."""
    extents = [_extent(obj, DIRECTIONS[forward_axis]) for obj in train]
    return [front - rear for (rear, _), (_, front) in zip(extents, extents[1:])]


def _extent(obj, direction):
    """Rear and front end of the object along its own axis, from its origin, m."""
    scale = abs(obj.matrix_world.to_scale().dot(direction))
    along = [Vector(corner).dot(direction) * scale for corner in obj.bound_box]
    return min(along), max(along)


classes = (MOTUS_OT_path_train_add,)
