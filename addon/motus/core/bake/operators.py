"""motus.bake and motus.unbake."""

import time

import bpy

from ..refusals import Refused, check_finite
from ..translations import tr
from . import job

SLICE = 0.05
"""Seconds of work between two redraws."""


def _named_object(context, name):
    if not name:
        if context.object is None:
            raise Refused(tr("Select an object, or name one"))
        return context.object
    found = context.scene.objects.get(name)
    if found is None:
        raise Refused(tr("There is no object {object} in the scene").format(object=name))
    return found


class MOTUS_OT_bake(bpy.types.Operator):
    bl_idname = "motus.bake"
    bl_label = "Bake"
    bl_description = "Turn what Motus computes into keyframes, in an action of their own"
    bl_options = {'REGISTER', 'UNDO'}

    object: bpy.props.StringProperty(
        name="Object", description="Object that is driven or drives others; empty means the active one",
        options={'SKIP_SAVE'})
    system: bpy.props.StringProperty(
        name="System", description="Name of the system to bake; empty means all of the object's", options={'SKIP_SAVE'})
    frame_start: bpy.props.IntProperty(
        name="Start", description="First frame; the scene's where it is not given", options={'SKIP_SAVE'})
    frame_end: bpy.props.IntProperty(
        name="End", description="Last frame; the scene's where it is not given", options={'SKIP_SAVE'})
    step: bpy.props.FloatProperty(
        name="Step", description="Frames from one keyframe to the next, less than one for sub-frames",
        default=1.0, min=0.001, soft_min=0.1, soft_max=10.0)

    def execute(self, context):
        try:
            self._start(context)
            for done in self._steps:
                context.window_manager.progress_update(done)
        except Refused as error:
            return self._refuse(context, error)
        return self._finish(context)

    def invoke(self, context, _event):
        if context.window is None:
            return self.execute(context)
        try:
            self._start(context)
            next(self._steps)
        except Refused as error:
            return self._refuse(context, error)
        self._timer = context.window_manager.event_timer_add(0.001, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        if event.type == 'ESC':
            self.cancel(context)
            self.report({'INFO'}, tr("Baking was cancelled: nothing has changed"))
            return {'CANCELLED'}
        if event.type != 'TIMER':
            return {'RUNNING_MODAL'}
        pause = time.perf_counter() + SLICE
        for done in self._steps:
            if time.perf_counter() > pause:
                self._show(context, done)
                return {'RUNNING_MODAL'}
        return self._finish(context)

    def cancel(self, context):
        self._steps.close()
        self._tidy(context)

    def _start(self, context):
        self._timer = None
        owner, systems = job.owner_and_systems(_named_object(context, self.object), self.system)
        for name in ("frame_start", "frame_end"):
            if not self.properties.is_property_set(name):
                setattr(self, name, getattr(context.scene, name))
        check_finite(self, ("step",))
        frames = job.frame_range(self.frame_start, self.frame_end, self.step)
        self._result = len(frames), len(job.objects_of(owner, systems))
        self._inexact = job.inexact(owner, systems)
        self._steps = job.bake(context.scene, context.view_layer, owner, systems, frames)
        context.window_manager.progress_begin(0, len(frames))

    def _show(self, context, done):
        context.window_manager.progress_update(done)
        context.workspace.status_text_set(
            tr("Baking frame {done} of {all} (Esc cancels)").format(done=done, all=self._result[0]))

    def _finish(self, context):
        self._tidy(context)
        frames, objects = self._result
        self.report({'INFO'}, tr("Baked {frames} frames of {objects} objects").format(frames=frames, objects=objects))
        if self._inexact:
            self.report({'WARNING'}, tr(
                "Keyframes cannot undo the stretch that these bones inherit from the chain: {bones}").format(
                    bones=", ".join(self._inexact)))
        return {'FINISHED'}

    def _refuse(self, context, error):
        self._tidy(context)
        self.report({'ERROR'}, str(error))
        return {'CANCELLED'}

    def _tidy(self, context):
        context.window_manager.progress_end()
        if self._timer:
            context.window_manager.event_timer_remove(self._timer)
            context.workspace.status_text_set(None)


class MOTUS_OT_unbake(bpy.types.Operator):
    bl_idname = "motus.unbake"
    bl_label = "Unbake"
    bl_description = "Take the baked keyframes away, put the object's own action back and switch the systems on again"
    bl_options = {'REGISTER', 'UNDO'}

    object: bpy.props.StringProperty(
        name="Object", description="Object that was baked; empty means the active one", options={'SKIP_SAVE'})
    system: bpy.props.StringProperty(
        name="System", description="Name of a system that was baked; empty means any", options={'SKIP_SAVE'})

    def execute(self, context):
        try:
            thing = _named_object(context, self.object)
            baked = job.unbake(thing, self.system)
        except Refused as error:
            self.report({'ERROR'}, str(error))
            return {'CANCELLED'}
        self.report({'INFO'}, tr("Unbaked {objects} objects").format(objects=len(baked)))
        return {'FINISHED'}
