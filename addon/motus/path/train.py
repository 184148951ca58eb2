"""Operator that sets up a train: wagons follow a leader on the same curve at constant distances along the arc."""

import bpy

from ..core import wiring
from ..core.interface.operators import OBJECT_MODE, FindsValues
from ..core.interface.rows import Row, Rows, is_one_of
from ..core.refusals import Refused, check_finite
from ..core.settings.declared import choice
from ..core.translations import tr
from . import members, rows, setup, targets
from .gaps import touching_gaps
from .operators import for_new, make_active
from .properties import DEFAULT_DELAY, GAP_UNITS, KEYWORDS, NewFollowKeywords


class MOTUS_OT_path_train_add(FindsValues, NewFollowKeywords, bpy.types.Operator):
    bl_idname = "motus.path_train_add"
    bl_label = "Follow Path as a Train"
    bl_description = "Let the selected objects follow a curve as a train, the active object first"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    objects: bpy.props.StringProperty(
        name="Objects",
        description="Names of objects with commas between, or a collection's name; empty takes the selected objects",
        options={'SKIP_SAVE'},
    )
    curve: bpy.props.StringProperty(
        name="Curve", description="Name of the curve object; empty takes the selected curve", options={'SKIP_SAVE'}
    )
    gap: bpy.props.FloatProperty(
        name="Gap",
        description="Distance along the path from each object to the next; 0 takes the lengths of the objects",
        default=0.0,
        min=0.0,
        subtype='DISTANCE',
    )

    gaps_by: choice("Gaps By", "Whether the wagons of a train keep a distance or a time to the object in front", GAP_UNITS, 'DISTANCE')
    delay: bpy.props.FloatProperty(
        name="Delay", description="Seconds from each object to the next", default=DEFAULT_DELAY, min=0.0, subtype='TIME_ABSOLUTE'
    )

    modes = OBJECT_MODE
    redo = (
        Rows(("gaps_by", Row("gap", when=is_one_of("gaps_by", 'DISTANCE')), Row("delay", when=is_one_of("gaps_by", 'TIME')))),
        *rows.ALL,
    )

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
        wiring.report_problems(self, context, setup.system(), train[:1])

    def _add(self, context):
        train = targets.named_list(self.objects) if self.objects else targets.selected_followers(context)
        _check_long_enough(train)
        if len(set(train)) < len(train):
            raise Refused(tr("An object can be in the train only once"))
        leader, *wagons = train
        curve = targets.curve_for(context, self.curve, leader)
        keywords = self.given(KEYWORDS)
        check_finite(self, (*keywords, "gap", "delay"))
        targets.check_settings(leader, curve, keywords)
        targets.check_free(leader, curve)
        for wagon in wagons:
            targets.check_wagon(wagon, curve, leader)
        rail = targets.rail_for(self.rail, train)
        if self.gap:
            gaps = [self.gap] * len(wagons)
        else:
            gaps = touching_gaps(train, self.forward_axis)
        entries = [members.Wagon(wagon, gap, self.delay, self.wheelbase) for wagon, gap in zip(wagons, gaps)]
        keywords = for_new(context, leader, curve, keywords, is_train=True) | self.given(("gaps_by",)) | rail
        setup.attach(leader, curve, keywords, entries)
        self.show_used(leader.motus.path, KEYWORDS)
        if not self.objects:
            make_active(context, leader)
        self.curve = curve.name
        return train


def _check_long_enough(train):
    if len(train) < 2:
        raise Refused(tr("A train needs two objects at least"))


classes = (MOTUS_OT_path_train_add,)
