"""Operators that go through a range of frames: with progress, cancelled by Esc, and everything put back afterwards."""

import math
import time

import bpy

from ..core import actions
from ..core.refusals import Refused, check_finite, check_posed
from ..core.translations import tr
from .operators import OfABone, in_a_mode_of_objects, refused
from .targets import rig_with_ik

SLICE = 0.05
"""Seconds of work between two redraws."""


class Kept:
    """The frame, and what animated properties of some objects stand at, keyed or not."""

    def __init__(self, scene, objects):
        self._scene = scene
        self._frame = scene.frame_current, scene.frame_subframe
        self._values = {(obj, path): value for obj in objects for path, value in _animated(obj).items()}

    def restore(self, written=()):
        """Go back to the frame, and to values that were changed there without a key.

        written: (object, path) of what has new keys, which count instead.
        """
        whole, part = self._frame
        self._scene.frame_set(whole, subframe=part)
        for obj in dict.fromkeys(obj for obj, _ in self._values):
            for path, now in _animated(obj).items():
                kept = self._values.get((obj, path), now)
                if kept != now and (obj, path) not in written:
                    _assign(obj, path, kept)


def _animated(obj):
    """{data path: value} of what F-curves of the object animate, as far as it is there."""
    found = {}
    for path in {curve.data_path for curve in actions.fcurves(obj)}:
        try:
            value = obj.path_resolve(path)
        except ValueError:
            continue  # of a bone that was removed or renamed
        found[path] = tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value
    return found


def _assign(obj, path, value):
    if path.endswith('"]'):
        holder, _, key = path[:-2].rpartition('["')
        (obj.path_resolve(holder) if holder else obj)[bpy.utils.unescape_identifier(key)] = value
    else:
        # Whole vectors: an item of rotation_euler would set the rotation mode back.
        holder, _, name = path.rpartition(".")
        setattr(obj.path_resolve(holder) if holder else obj, name, value)


def go_to(scene, frame):
    """Evaluate a frame, which may be a fraction."""
    whole = math.floor(frame)
    scene.frame_set(whole, subframe=frame - whole)


def active_rig(context, name):
    """The rig of this name, or the active one, that has inverse kinematics and shows its pose."""
    rig = rig_with_ik(context, name)
    check_posed(rig, context.view_layer)
    return rig


class OverFrames(OfABone):
    """Mixin. A subclass has steps(context, frames), a generator of how many of self.total steps are done.

    And result(context), which reports what came of them.
    """

    bl_options = {'REGISTER', 'UNDO'}

    bone: bpy.props.StringProperty(
        name="Bone", description="Name of the last bone of the chain; empty takes all chains of the object",
        options={'SKIP_SAVE'})
    use_range: bpy.props.BoolProperty(
        name="Frame Range", description="All frames from the start to the end; otherwise the current frame alone",
        default=True)
    frame_start: bpy.props.IntProperty(
        name="Start", description="First frame; the scene's where it is not given", options={'SKIP_SAVE'})
    frame_end: bpy.props.IntProperty(
        name="End", description="Last frame; the scene's where it is not given", options={'SKIP_SAVE'})
    step: bpy.props.FloatProperty(
        name="Step", description="Frames from one to the next, less than one for sub-frames", default=1.0, min=0.001,
        soft_min=0.1, soft_max=10.0)

    poll = classmethod(in_a_mode_of_objects)

    def execute(self, context):
        try:
            self._start(context)
            for done in self._steps:
                context.window_manager.progress_update(done)
        except Refused as refusal:
            return self._refuse(context, refusal)
        return self._finish(context)

    def invoke(self, context, _event):
        if context.window is None:
            return self.execute(context)
        try:
            self._start(context)
            next(self._steps, None)
        except Refused as refusal:
            return self._refuse(context, refusal)
        self._timer = context.window_manager.event_timer_add(0.001, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        if event.type == 'ESC':
            self.cancel(context)
            self.report({'INFO'}, tr("Cancelled: nothing has changed"))
            return {'CANCELLED'}
        if event.type != 'TIMER':
            return {'RUNNING_MODAL'}
        pause = time.perf_counter() + SLICE
        try:
            for done in self._steps:
                if time.perf_counter() > pause:
                    self._show(context, done)
                    return {'RUNNING_MODAL'}
        except Refused as refusal:
            return self._refuse(context, refusal)
        return self._finish(context)

    def cancel(self, context):
        self._steps.close()
        self._tidy(context)

    def _start(self, context):
        self._timer = self._steps = None
        frames = self._frames(context.scene)
        self.total = len(frames)
        self._steps = self.steps(context, frames)
        context.window_manager.progress_begin(0, self.total)

    def _frames(self, scene):
        check_finite(self, ("step",))
        if not self.use_range:
            return [scene.frame_current + scene.frame_subframe]
        for name in ("frame_start", "frame_end"):
            if not self.properties.is_property_set(name):
                setattr(self, name, getattr(scene, name))
        if self.frame_end < self.frame_start:
            raise Refused(tr("The range is empty: the end frame comes before the start frame"))
        count = int(math.floor((self.frame_end - self.frame_start) / self.step + 1e-6)) + 1
        return [self.frame_start + self.step * index for index in range(count)]

    def _show(self, context, done):
        context.window_manager.progress_update(done)
        context.workspace.status_text_set(
            tr("Step {done} of {all} (Esc cancels)").format(done=done, all=self.total))

    def _finish(self, context):
        self._tidy(context)
        self.result(context)
        return {'FINISHED'}

    def _refuse(self, context, refusal):
        if self._steps:
            self._steps.close()
        self._tidy(context)
        return refused(self, refusal)

    def _tidy(self, context):
        context.window_manager.progress_end()
        if self._timer:
            context.window_manager.event_timer_remove(self._timer)
            context.workspace.status_text_set(None)
