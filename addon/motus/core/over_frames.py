"""Operators that go through a range of frames: with progress, cancelled by Esc, and tidied up whatever happens."""

import math
import time

import bpy

from .refusals import Refused, check_finite
from .translations import tr

SLICE = 0.05
"""Seconds of work between two redraws."""


def frame_range(start, end, step):
    """The frames from start to end inclusive; floats where the step is not whole."""
    if end < start:
        raise Refused(tr("The range is empty: the end frame comes before the start frame"))
    count = int(math.floor((end - start) / step + 1e-6)) + 1
    return [start + step * index for index in range(count)]


class OverFrames:
    """Mixin of an operator that has a property `step`, and these functions.

    steps(context, frames): a generator of how many of self.total steps are done (as many as frames, unless it says
    otherwise), which puts everything back where it is closed before its end. result(context) reports what came of them.
    """

    frame_start: bpy.props.IntProperty(
        name="Start", description="First frame; the scene's where it is not given", options={'SKIP_SAVE'})
    frame_end: bpy.props.IntProperty(
        name="End", description="Last frame; the scene's where it is not given", options={'SKIP_SAVE'})

    def execute(self, context):
        return self._guarded(context, self._run)

    def invoke(self, context, _event):
        if context.window is None:
            return self.execute(context)
        return self._guarded(context, self._run_in_window)

    def modal(self, context, event):
        if event.type == 'ESC':
            self.cancel(context)
            self.report({'INFO'}, tr("Cancelled: nothing has changed"))
            return {'CANCELLED'}
        if event.type != 'TIMER':
            return {'RUNNING_MODAL'}
        return self._guarded(context, self._go_on)

    def cancel(self, context):
        if self._steps:
            self._steps.close()
        context.window_manager.progress_end()
        if self._timer:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None
            context.workspace.status_text_set(None)

    def _guarded(self, context, function):
        """What a function answers; where it raises, nothing of the operator is left running."""
        try:
            return function(context)
        except Refused as refusal:
            self.cancel(context)
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        except Exception:
            self.cancel(context)
            raise

    def _run(self, context):
        self._start(context)
        for done in self._steps:
            context.window_manager.progress_update(done)
        return self._finish(context)

    def _run_in_window(self, context):
        self._start(context)
        next(self._steps, None)
        self._timer = context.window_manager.event_timer_add(0.001, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def _go_on(self, context):
        pause = time.perf_counter() + SLICE
        for done in self._steps:
            if time.perf_counter() > pause:
                self._show(context, done)
                return {'RUNNING_MODAL'}
        return self._finish(context)

    def _start(self, context):
        self._timer = self._steps = None
        frames = self._frames(context.scene)
        self.total = len(frames)
        self._steps = self.steps(context, frames)
        context.window_manager.progress_begin(0, self.total)

    def _frames(self, scene):
        check_finite(self, ("step",))
        for name in ("frame_start", "frame_end"):
            if not self.properties.is_property_set(name):
                setattr(self, name, getattr(scene, name))
        return frame_range(self.frame_start, self.frame_end, self.step)

    def _show(self, context, done):
        context.window_manager.progress_update(done)
        context.workspace.status_text_set(
            tr("Step {done} of {all} (Esc cancels)").format(done=done, all=self.total))

    def _finish(self, context):
        self.cancel(context)
        self.result(context)
        return {'FINISHED'}
