"""Operators that change a step: motus.walker_step drags, turns and locks it, motus.walker_step_time sets when it is.

motus.walker_step_remove lets it be planned again, and motus.walker_prints adds footprints.
"""

import math

import bpy
from mathutils import Vector

from ...core.interface.dragging.drag import PointDrag
from ...core.interface.operators import OBJECT_OR_POSE_MODE, OfAnObject, object_keyword
from ...core.interface.rows import Row, Rows, is_given
from ...core.interface.view.viewports import view_at
from ...core.measures import scene_time
from ...core.refusals import Refused, check_finite
from ...core.translations import tr
from .. import legs, targets
from . import chart, chosen, handles, prints

CHANGES = "location", "turn", "lock"
"""Keywords that say what is changed of a step."""


def _named_step(context, owner, operator):
    """The chosen.Step that an operator's keywords name: by index, or by foot and frame. Raises Refused if there is none."""
    if operator.is_given("index"):
        return chosen.step_of_entry(context, owner, operator.index)
    frame = scene_time.keys_time(context.scene, operator.frame) if operator.is_given("frame") else scene_time.present(context.scene)
    return chosen.step_at(context, owner, chosen.leg_named(owner, operator.foot), frame)


class Held:
    """A step of a walker while one of its handles is dragged: pull() moves or turns the foot, restore() takes that back."""

    def __init__(self, context, owner, handle):
        self._edit = chosen.Edit(context, owner, handle.step)
        self._owner, self._step, self.turns = owner, handle.step, handle.turns
        self._inverse = chosen.space(context, owner).inverted_safe()
        self._turn = owner.motus.walker.steps[handle.step.entry].turn if handle.step.entry >= 0 else 0.0
        self.turn = self._turn

    def pull(self, place):
        """Drag the handle to a place in the world."""
        place = self._inverse @ Vector(place)
        if self.turns:
            self.turn = self._turn + handles.angle(self._step, self._owner.motus.walker, place)
            self._edit.turn(self.turn)
        else:
            self._edit.move(place)

    def restore(self):
        """Take back all that was changed of the step."""
        self._edit.restore()


class MOTUS_OT_walker_step(PointDrag, OfAnObject, bpy.types.Operator):
    bl_idname = "motus.walker_step"
    bl_label = "Edit Step"
    bl_description = "Drag, turn or lock a step of a walker; the plan around it follows"

    object: object_keyword("Name of the body that walks; empty takes the active object")
    foot: bpy.props.StringProperty(name="Foot", description="Name of the foot: its bone, or its object", options={'SKIP_SAVE'})
    frame: bpy.props.FloatProperty(
        name="Frame",
        description="Frame on which the foot stands, or swings to its foothold; the present one if it is not given",
        options={'SKIP_SAVE'},
    )
    index: bpy.props.IntProperty(
        name="Index", description="Index of the step among the changed ones, in place of foot and frame", default=-1, options={'SKIP_SAVE'}
    )
    location: bpy.props.FloatVectorProperty(
        name="Location",
        description="Place in the world that the foot is dragged to; the ground there is what it stands on, unless the step is locked",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )
    turn: bpy.props.FloatProperty(
        name="Turn",
        description="Angle by which the foot is turned about the ground's normal",
        subtype='ANGLE',
        soft_min=-math.pi,
        soft_max=math.pi,
        options={'SKIP_SAVE'},
    )
    lock: bpy.props.BoolProperty(
        name="Lock", description="Have the foot stand where it stands now, whatever body and ground do", options={'SKIP_SAVE'}
    )
    modes = OBJECT_OR_POSE_MODE
    needs_native = True
    redo = (Rows(tuple(Row(name, when=is_given(name)) for name in CHANGES)),)
    for_scripts = ("frame", "index")
    found = staticmethod(targets.editable_walker)

    def run(self, context):
        owner = self.found(context, self.object)
        if not any(map(self.is_given, CHANGES)):
            raise Refused(tr("Say what to change of the step: location, turn or lock is missing"))
        check_finite(self, ("frame", "location", "turn"))
        chosen.plan_again(context, owner)
        edit = chosen.Edit(context, owner, _named_step(context, owner, self))
        if self.is_given("lock"):
            (edit.lock if self.lock else edit.unlock)()
        if self.is_given("location"):
            edit.move(chosen.space(context, owner).inverted_safe() @ Vector(self.location))
        if self.is_given("turn"):
            edit.turn(self.turn)

    def invoke(self, context, event):
        if context.window is None or any(map(self.is_given, CHANGES)):
            return self.execute(context)
        try:
            self.object = self.found(context, self.object).name
            return self._begin(context, event)
        except Refused as refusal:
            return self.refuse(refusal)

    def _show_keys(self, context):
        context.workspace.status_text_set(
            tr("Press the left mouse button on a foothold of the walker and drag it; Esc or the right button cancels")
        )

    def _hold(self, context, region, view, mouse):
        owner = self.found(context, self.object)  # the walker may have been removed while the operator waited for the mouse
        picked = handles.pick(context, owner, region, view.perspective_matrix, mouse)
        if picked is None:
            return None
        handle, place = picked
        self.foot = legs.label(owner.motus.walker.legs[handle.step.leg])
        self.frame = scene_time.time_line(context.scene, handle.step.middle * scene_time.fps(context.scene))
        self._held = Held(context, owner, handle)
        return Vector(handle.place), Vector(place)

    def _move(self, place):
        self._held.pull(place)
        if self._held.turns:
            self.turn = self._held.turn
        else:
            self.location = place


class MOTUS_OT_walker_step_time(OfAnObject, bpy.types.Operator):
    bl_idname = "motus.walker_step_time"
    bl_label = "Time Step"
    bl_description = "Set when a foot of a walker touches the ground, and until when it stands; its steps before and after make room"

    object: object_keyword("Name of the body that walks; empty takes the active object")
    foot: bpy.props.StringProperty(name="Foot", description="Name of the foot: its bone, or its object", options={'SKIP_SAVE'})
    frame: bpy.props.FloatProperty(
        name="Frame",
        description="Frame on which the foot stands, or swings to its foothold; the present one if it is not given",
        options={'SKIP_SAVE'},
    )
    index: bpy.props.IntProperty(
        name="Index", description="Index of the step among the changed ones, in place of foot and frame", default=-1, options={'SKIP_SAVE'}
    )
    touch: bpy.props.FloatProperty(name="Lands", description="Frame on which the foot touches the ground", options={'SKIP_SAVE'})
    lift: bpy.props.FloatProperty(name="Lifts", description="Frame until which the foot stands", options={'SKIP_SAVE'})
    modes = OBJECT_OR_POSE_MODE
    needs_native = True
    redo = (Rows(tuple(Row(name, when=is_given(name)) for name in chart.MOMENTS)),)
    for_scripts = ("frame", "index")
    found = staticmethod(targets.editable_walker)

    def run(self, context):
        owner = self.found(context, self.object)
        given = self.given(chart.MOMENTS)
        if not given:
            raise Refused(tr("Say when the step is: touch or lift is missing"))
        check_finite(self, ("frame", *chart.MOMENTS))
        chosen.plan_again(context, owner)
        edit = chosen.Edit(context, owner, _named_step(context, owner, self))
        for name, frame in given.items():
            edit.time(name, scene_time.keys_time(context.scene, frame))

    def invoke(self, context, event):
        if context.window is None or self.given(chart.MOMENTS):
            return self.execute(context)
        try:
            return self._begin(context, event)
        except Refused as refusal:
            return self.refuse(refusal)

    def _begin(self, context, event):
        owner = self.found(context, self.object)
        self._view = view_at(context.window, event.mouse_x, event.mouse_y)
        drawn = self._view and chart.Chart.of(context, owner, self._view.region)
        self._end = drawn and drawn.pick((event.mouse_x - self._view.region.x, event.mouse_y - self._view.region.y))
        if not self._end:
            raise Refused(tr("Drag an end of a bar in the chart of steps, which the panel Steps shows in the viewport"))
        step = self._end.step
        self.object, self.foot = owner.name, legs.label(owner.motus.walker.legs[step.leg])
        self.frame = scene_time.time_line(context.scene, step.planned * scene_time.fps(context.scene))
        self._edit, self._chart, self._pressed = chosen.Edit(context, owner, step), drawn, event.mouse_x
        context.workspace.status_text_set(tr("Whole frames; Shift is precise; Esc or the right button cancels"))
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        try:
            if event.type in {'ESC', 'RIGHTMOUSE'} and event.value == 'PRESS':
                self.cancel(context)
                return {'CANCELLED'}
            if event.type == 'LEFTMOUSE' and event.value == 'RELEASE':
                self._hide(context)
                return {'FINISHED'} if self.given(chart.MOMENTS) else {'CANCELLED'}
            if event.type == 'MOUSEMOVE':
                self._follow(context, event)
        except ReferenceError:
            # A script has removed the walker, or its step.
            self._hide(context)
            self.report({'ERROR'}, tr("The object that was pulled is gone"))
            return {'CANCELLED'}
        return {'RUNNING_MODAL'}

    def cancel(self, context):
        self._hide(context)
        self._edit.restore()

    def _follow(self, context, event):
        seconds = self._end.seconds + self._chart.seconds(event.mouse_x - self._pressed)
        frame = scene_time.time_line(context.scene, seconds * scene_time.fps(context.scene))
        frame = frame if event.shift else round(frame)
        setattr(self, self._end.moment, frame)
        self._edit.time(self._end.moment, scene_time.keys_time(context.scene, frame))
        self._view.tell(tr("{foot}, frame {frame}").format(foot=self.foot, frame=f"{frame:g}"))

    def _hide(self, context):
        context.workspace.status_text_set(None)
        self._view.tell(None)


class MOTUS_OT_walker_step_remove(OfAnObject, bpy.types.Operator):
    bl_idname = "motus.walker_step_remove"
    bl_label = "Plan Step Again"
    bl_description = "Let a step that was dragged, turned or locked be planned again"

    object: object_keyword("Name of the body that walks; empty takes the active object")
    index: bpy.props.IntProperty(name="Index", description="Index of the step in the list", default=-1, options={'SKIP_SAVE'})
    modes = OBJECT_OR_POSE_MODE

    @staticmethod
    def found(context, name):
        """Return the walker of this name, or of the active object. Raises Refused if none of its steps is chosen, or it is baked."""
        owner = targets.editable_walker(context, name)
        if not owner.motus.walker.steps:
            raise Refused(tr("No step of {object} was changed").format(object=owner.name))
        return owner

    def run(self, context):
        owner = self.found(context, self.object)
        index = self.index if self.is_given("index") else len(owner.motus.walker.steps) - 1
        chosen.entry_at(owner, index)
        chosen.remove(owner, index)


class MOTUS_OT_walker_prints(OfAnObject, bpy.types.Operator):
    bl_idname = "motus.walker_prints"
    bl_label = "Add Footprints"
    bl_description = "Add an object with a mark for each step of a walker, as it is planned now; each mark shows from when the foot touches the ground on"

    object: object_keyword("Name of the body that walks; empty takes the active object")
    length: bpy.props.FloatProperty(
        name="Length",
        description="Length of a mark; 0 takes that of the soles, or a part of the stride",
        min=0.0,
        soft_max=1.0,
        subtype='DISTANCE',
    )
    width: bpy.props.FloatProperty(
        name="Width", description="Width of a mark; 0 takes a part of the length", min=0.0, soft_max=1.0, subtype='DISTANCE'
    )
    modes = OBJECT_OR_POSE_MODE
    needs_native = True
    redo = (Rows(("length", "width")),)
    found = staticmethod(targets.walker_for)

    def run(self, context):
        owner = self.found(context, self.object)
        check_finite(self, ("length", "width"))
        context.view_layer.update()
        made = prints.add(context, owner, self.length, self.width)
        self.report({'INFO'}, tr("{object} added").format(object=made.name))


classes = (MOTUS_OT_walker_step, MOTUS_OT_walker_step_time, MOTUS_OT_walker_step_remove, MOTUS_OT_walker_prints)
