"""Mixins of operators that work in steps, most of them through a range of frames: with progress, cancelling by Esc, and clean-up."""

import math
import time
from typing import Any

import bpy

from ..refusals import Refused, check_finite
from ..translations import tr
from .operators import Operator
from .rows import Row, Rows, is_not, is_one_of
from .view import viewports

SLICE = 0.1
"""Seconds of work between two redraws. With more redraws, a heavy scene would take longer for drawing than for the work."""


def frame_range(start, end, step):
    """List of the frames from start to end inclusive, at distances of `step`. Raises Refused if end is before start.

    The frames are floats if `step` is a float.
    """
    if end < start:
        raise Refused(tr("The range is empty: the end frame comes before the start frame"))
    count = math.floor((end - start) / step + 1e-6) + 1
    return [start + step * index for index in range(count)]


def current(scene):
    """List that holds only the scene's current frame, with its fraction."""
    return [scene.frame_current + scene.frame_subframe]


RANGES = (
    ('GIVEN', "Start to End", "The frames that are given, or else the scene's"),
    ('PREVIEW', "Preview Range", "The scene's preview range; all frames of the scene where there is none"),
    ('SCENE', "Scene", "All frames of the scene"),
    ('CURRENT', "Current Frame", "The frame that is shown"),
)


def span(operator, scene):
    """(first, last) frame of the range that an operator's keywords choose in a scene."""
    if operator.range == 'CURRENT':
        return 2 * current(scene)
    if operator.range == 'PREVIEW' and scene.use_preview_range:
        return scene.frame_preview_start, scene.frame_preview_end
    given = operator.given(("frame_start", "frame_end")) if operator.range == 'GIVEN' else {}
    return given.get("frame_start", scene.frame_start), given.get("frame_end", scene.frame_end)


class Job(Operator):
    """Mixin of an operator that works in steps. If it was started in the window, Blender redraws between the steps.

    begin(context): returns (number of steps, generator of the number of steps done). If the generator is closed before its end, it must
    restore what it has changed. result(context): reports the outcome.
    """

    _steps: Any = None
    _timer: Any = None

    def execute(self, context):
        return self._guarded(context, self._run)

    def invoke(self, context, _event):
        return self._guarded(context, self._run if context.window is None else self._run_in_window)

    def modal(self, context, event):
        if event.type == 'ESC':
            self.cancel(context)
            self.report({'INFO'}, tr("Cancelled: nothing has changed"))
            return {'CANCELLED'}
        if event.type != 'TIMER':
            return {'RUNNING_MODAL'}
        return self._guarded(context, self._go_on)

    def cancel(self, context):
        if self._steps is None:
            return  # the first step was not begun
        self._steps.close()
        context.window_manager.progress_end()
        if self._timer:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None
            context.workspace.status_text_set(None)
            # Blender does not redraw by itself after a timer event.
            viewports.redraw(None)

    def _guarded(self, context, function):
        """Return function(context). If it raises, close the generator of steps and remove the timer.

        Refused is reported as an error of the operator. A different exception is raised again.
        """
        try:
            return function(context)
        except Refused as refusal:
            self.cancel(context)
            return self.refuse(refusal)
        except Exception:
            self.cancel(context)
            raise

    def _run(self, context):
        self._start(context)
        shown = time.perf_counter()
        for done in self._steps:
            if time.perf_counter() > shown + SLICE:
                context.window_manager.progress_update(done)
                shown = time.perf_counter()
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
        self.total, self._steps = self.begin(context)
        context.window_manager.progress_begin(0, self.total)

    def _show(self, context, done):
        context.window_manager.progress_update(done)
        context.workspace.status_text_set(tr("Step {done} of {all} (Esc cancels)").format(done=done, all=self.total))

    def _finish(self, context):
        self.cancel(context)
        self.result(context)
        return {'FINISHED'}


class IntoFile(Job):
    """Mixin of a Job that writes a file.

    If it is started in the window without a path, it first shows Blender's file browser. suggested(context): returns the path that the
    browser begins with, and sets other keywords that it shows. chosen: names of the keywords that the artist can set there.
    """

    filepath: bpy.props.StringProperty(name="File Path", description="File that is written", subtype='FILE_PATH', options={'SKIP_SAVE'})
    check_existing: bpy.props.BoolProperty(name="Check Existing", default=True, options={'HIDDEN', 'SKIP_SAVE'})
    chosen: tuple[str, ...] = ("filepath",)
    _is_asked = False

    def invoke(self, context, event):
        if context.window is None or self.filepath:
            return super().invoke(context, event)
        self.filepath, self._is_asked = self.suggested(context), True
        context.window_manager.fileselect_add(self)
        return {'RUNNING_MODAL'}

    def execute(self, context):
        if not self._is_asked:
            return super().execute(context)
        # Blender frees the operator that its file browser has called, so another one shows the progress and takes Esc.
        group, _, name = type(self).bl_idname.partition(".")
        call = getattr(getattr(bpy.ops, group), name)
        try:
            call('INVOKE_DEFAULT', **{keyword: getattr(self, keyword) for keyword in self.chosen})
        except RuntimeError as error:
            self.report({'ERROR'}, str(error).removeprefix("Error: ").strip())
            return {'CANCELLED'}
        return {'FINISHED'}


class OverFrames(Job):
    """Mixin of an operator that steps through a range of frames, with a progress indicator and cancelling by Esc.

    steps(context, frames): returns a generator of the number of steps done. If the generator is closed before its end, it must restore what
    it has changed. It may set self.total, the number of all steps, which is the number of frames by default. result(context): reports the
    outcome.
    If the operator is started in the window without a range, it first shows a dialog that asks for the range.
    """

    range: bpy.props.EnumProperty(
        name="Frames", description="Frames that are gone through", items=RANGES, default='GIVEN', options={'SKIP_SAVE'}
    )
    frame_start: bpy.props.IntProperty(name="Start", description="First frame; the scene's where it is not given", options={'SKIP_SAVE'})
    frame_end: bpy.props.IntProperty(name="End", description="Last frame; the scene's where it is not given", options={'SKIP_SAVE'})
    step: bpy.props.FloatProperty(
        name="Step",
        description="Frames from one to the next, less than one for sub-frames",
        default=1.0,
        min=0.001,
        soft_min=0.1,
        soft_max=10.0,
    )
    redo: tuple[Any, ...] = (
        Rows(
            (
                "range",
                Row("frame_start", when=is_one_of("range", 'GIVEN')),
                Row("frame_end", when=is_one_of("range", 'GIVEN')),
                Row("step", when=is_not("range", 'CURRENT')),
            )
        ),
    )

    _is_asked = False

    def execute(self, context):
        is_asked, self._is_asked = self._is_asked, False
        return self._guarded(context, self._run_in_window if is_asked else self._run)

    def invoke(self, context, _event):
        if context.window is None:
            return self.execute(context)
        if any(self.is_given(name) for name in ("range", "frame_start", "frame_end", *self.for_scripts)):
            return self._guarded(context, self._run_in_window)
        self._suggest(context.scene)
        self._is_asked = True
        return context.window_manager.invoke_props_dialog(self)

    def draw_below(self, context):
        first, last = span(self, context.scene)
        text = bpy.app.translations.pgettext_iface("Frames {first}-{last}")
        self.layout.label(text=text.format(first=f"{first:g}", last=f"{last:g}"), icon='TIME', translate=False)

    def begin(self, context):
        frames = self.frames(context.scene)
        self.total = len(frames)
        return self.total, self.steps(context, frames)

    def frames(self, scene):
        """The frames to go through, in their order, as the operator's keywords choose. Raises Refused if there is none."""
        check_finite(self, ("step",))
        if self.range == 'CURRENT':
            return current(scene)
        first, last = span(self, scene)
        self.frame_start, self.frame_end = first, last
        return frame_range(first, last, self.step)

    def _suggest(self, scene):
        self.range = 'PREVIEW' if scene.use_preview_range else 'SCENE'
        self.frame_start, self.frame_end = span(self, scene)
