"""Operator that lets a chain pass from its present target to a different one, over frames or when a number passes a value."""

import math

import bpy

from ...core.file.pointers import pointed
from ...core.interface.rows import Row, Rows
from ...core.measures import scene_time
from ...core.refusals import Refused, named
from ...core.translations import tr
from .. import targets
from ..operators import OfABone
from . import blend_keys, blend_trigger

LASTS = 12
"""Number of frames that a switch lasts if its end is not given."""

EASES = (
    ('BEZIER', "Smooth", "The chain starts and ends slowly"),
    ('LINEAR', "Linear", "The chain moves at an even speed"),
    ('CONSTANT', "At Once", "The chain jumps to the new target"),
)


def _named(name):
    """Row that draws the operator's keyword `name` as a choice among the scene's objects."""
    return Row(name, search=lambda _operator: (bpy.context.scene, "objects"))


def _is_armature(operator):
    goal = bpy.data.objects.get(operator.target)
    return goal is not None and goal.type == 'ARMATURE'


def _bones(operator):
    return bpy.data.objects[operator.target].data, "bones"


def _is_by_frames(operator):
    return not operator.trigger_object


def _is_by_trigger(operator):
    return bool(operator.trigger_object)


def _is_by_output(operator):
    return bool(operator.trigger_object) and not operator.trigger_data_path


class MOTUS_OT_ik_switch_target(OfABone, bpy.types.Operator):
    bl_idname = "motus.ik_switch_target"
    bl_label = "Switch Target"
    bl_description = "Let the chain pass from its present target to another one, over frames or when something happens"

    target: bpy.props.StringProperty(
        name="Target", description="Name of the object to go to; empty takes what is selected along with the bone", options={'SKIP_SAVE'}
    )
    target_bone: bpy.props.StringProperty(name="Target Bone", description="Name of a bone of the target", options={'SKIP_SAVE'})
    frame_start: bpy.props.IntProperty(
        name="Start",
        description="Frame at which the chain leaves its present target; the current frame if it is not given",
        options={'SKIP_SAVE'},
    )
    frame_end: bpy.props.IntProperty(
        name="End",
        options={'SKIP_SAVE'},
        description="Frame at which the chain is at the other target; 12 after the start where it is not given",
    )
    interpolation: bpy.props.EnumProperty(
        name="Interpolation", description="How the chain moves from one target to the other", items=EASES, default='BEZIER'
    )
    trigger_object: bpy.props.StringProperty(
        name="Trigger",
        options={'SKIP_SAVE'},
        description="Name of an object, one of whose numbers, instead of the frame, says how far the chain has come",
    )
    trigger_system: bpy.props.StringProperty(name="System", description="Name of the system whose output triggers", default="path")
    trigger_output: bpy.props.StringProperty(
        name="Output",
        default="parameter",
        description="Name of the system's output: parameter, fraction, distance or speed of a follower, and what others compute",
    )
    trigger_data_path: bpy.props.StringProperty(
        name="Data Path", description="Data path of a number of the trigger, instead of an output of a system", options={'SKIP_SAVE'}
    )
    trigger_start: bpy.props.FloatProperty(
        name="From", description="Value of the trigger at which the chain leaves its present target", default=0.05, options={'SKIP_SAVE'}
    )
    trigger_end: bpy.props.FloatProperty(
        name="To", description="Value of the trigger at which the chain is at the other target", default=0.1, options={'SKIP_SAVE'}
    )

    redo = (
        Rows((_named("target"), Row("target_bone", when=_is_armature, search=_bones, text="Bone"), "interpolation")),
        Rows(
            (
                _named("trigger_object"),
                Row("frame_start", when=_is_by_frames),
                Row("frame_end", when=_is_by_frames),
                Row("trigger_data_path", when=_is_by_trigger),
                Row("trigger_system", when=_is_by_output),
                Row("trigger_output", when=_is_by_output),
                Row("trigger_start", when=_is_by_trigger),
                Row("trigger_end", when=_is_by_trigger),
            )
        ),
    )

    def run(self, context):
        rig, entry, number = self._switch(context)
        extra = entry.extra_targets[number]
        name = pointed(extra, "object").name
        if extra.bone:
            name = f"{name}: {extra.bone}"
        self.report({'INFO'}, tr("{bone} of {object} passes on to {target}").format(bone=entry.name, object=rig.name, target=name))

    def invoke(self, context, _event):
        if context.window is None:
            return self.execute(context)
        if not self.target:
            goal = targets.selected_goal(context, context.object) if context.object else None
            if goal:
                self.target, self.target_bone = goal[0].name, goal[1]
        self._take_frames(context)
        return context.window_manager.invoke_props_dialog(self)

    def _switch(self, context):
        rig = targets.rig_with_ik(context, self.object)
        targets.check_editable(rig)
        entry = rig.motus.ik.entries[targets.entry_for(rig, self.bone)]
        goal = targets.goal_for(context, self.target, self.target_bone, rig)
        if goal is None:
            raise Refused(tr("Name the target, or select it along with the bone"))
        targets.check_no_loop(rig, entry.name, {"target": goal[0], "target_bone": goal[1]}, goal)
        if self.trigger_object:
            number = self._by_trigger(rig, entry, goal)
        else:
            number = self._by_frames(context, rig, entry, goal)
        context.view_layer.update()
        return rig, entry, number

    def _by_frames(self, context, rig, entry, goal):
        self._take_frames(context)
        if self.frame_end <= self.frame_start:
            raise Refused(tr("The range is empty: the end frame has to come after the start frame"))
        times = [scene_time.keys_time(context.scene, frame) for frame in (self.frame_start, self.frame_end)]
        if blend_trigger.driver_of(rig, entry):
            return blend_trigger.switch(rig, entry, goal, None, *times, self.interpolation)  # type: ignore[call-arg]
        return blend_keys.switch(rig, entry, goal, *times, self.interpolation)  # type: ignore[call-arg]

    def _by_trigger(self, rig, entry, goal):
        values = self.trigger_start, self.trigger_end
        if not all(map(math.isfinite, values)) or values[0] == values[1]:
            raise Refused(tr("The trigger's two values have to be different"))
        owner = named(self.trigger_object)
        if self.trigger_data_path:
            source = blend_trigger.property_source(owner, self.trigger_data_path)
        else:
            blend_trigger.check_elsewhere(rig, owner, self.trigger_system)
            source = blend_trigger.output_source(owner, self.trigger_system, self.trigger_output)
        return blend_trigger.switch(rig, entry, goal, source, *values, self.interpolation)

    def _take_frames(self, context):
        if not self.is_given("frame_start"):
            self.frame_start = context.scene.frame_current
        if not self.is_given("frame_end"):
            self.frame_end = self.frame_start + LASTS


classes = (MOTUS_OT_ik_switch_target,)
