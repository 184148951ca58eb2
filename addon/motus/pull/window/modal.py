"""Modal part of the operator motus.pick_pull: a session that the menu starts, or one stroke of the tool."""

import bpy

from ...core.interface.dragging.number_entry import CONFIRMING
from ...core.interface.view import viewports
from ...core.refusals import Refused
from ...core.translations import tr
from .. import fitting
from ..properties import KEYWORDS
from . import hover, status
from .adjusting import MOVES
from .pulling import Pulling

GIVEN_PLACE = ("location", "vertex", "dabs")
"""Keywords that say where to pull: if one of them is given, the operator runs without the mouse."""

VIEWING = {
    'MIDDLEMOUSE',
    'WHEELUPMOUSE',
    'WHEELDOWNMOUSE',
    'TRACKPADPAN',
    'TRACKPADZOOM',
    'MOUSEROTATE',
    'MOUSESMARTZOOM',
    'HOME',
    'ACCENT_GRAVE',
    'NUMPAD_PLUS',
    'NUMPAD_MINUS',
    'NUMPAD_PERIOD',
    *(f'NUMPAD_{digit}' for digit in range(10)),
}
"""Types of events that navigate the view; the operator passes them on."""
ALWAYS_PASSED = {'TIMER', 'TIMER0', 'TIMER1', 'TIMER2', 'TIMER_REPORT', 'TIMERREGION', 'WINDOW_DEACTIVATE', 'NONE'}
BUTTONS = {'LEFTMOUSE': 1.0, 'RIGHTMOUSE': -1.0}


class PickPullModal:
    """Mixin of motus.pick_pull with the methods invoke(), modal() and cancel().

    The operator itself has the methods execute(), start() and remember().
    """

    is_stroke: bpy.props.BoolProperty(
        name="Stroke", description="Make one stroke of the mouse, as with the tool's keys", default=False, options={'HIDDEN', 'SKIP_SAVE'}
    )
    is_down: bpy.props.BoolProperty(name="Down", description="The stroke pulls down", default=False, options={'HIDDEN', 'SKIP_SAVE'})
    is_smooth: bpy.props.BoolProperty(name="Smooth", description="The stroke smooths", default=False, options={'HIDDEN', 'SKIP_SAVE'})

    def invoke(self, context, event):
        if context.window is None or any(map(self.is_given, GIVEN_PLACE)):
            return self.execute(context)
        view = viewports.view_at(context.window, event.mouse_x, event.mouse_y)
        if self.is_stroke and (view is None or _selects(context, event)):
            return {'PASS_THROUGH', 'CANCELLED'}
        try:
            session = self._open(context)
        except Refused as refusal:
            return self.refuse(refusal)
        self._pulling = Pulling(context, session, self.given(KEYWORDS))
        if self.is_stroke and not self._press(context, view, event):
            self._pulling.close(context)
            self._keep(context)
            # A press beside the mesh is passed on to what lies there, except in Sculpt Mode, where Blender would use a brush.
            return {'CANCELLED'} if context.mode == 'SCULPT' else {'PASS_THROUGH', 'CANCELLED'}
        self._pulling.show(context)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        try:
            return self._stroke(context, event) if self.is_stroke else self._session(context, event)
        except Refused as refusal:
            self.report({'WARNING'}, str(refusal))
            self._pulling.release(context)
            return self._finish(context) if self.is_stroke else {'RUNNING_MODAL'}
        except ReferenceError:
            # A script has removed the object during the session.
            self._pulling.close(context)
            hover.drop()
            self.report({'ERROR'}, tr("The object that was pulled is gone"))
            return {'CANCELLED'}
        except Exception:
            self.cancel(context)
            raise

    def cancel(self, context):
        """Cancel the session, when Blender or the user asks for it, and restore the mesh to the start of the session."""
        self._pulling.close(context)
        self._pulling.session.restore()
        self._keep(context)

    def _press(self, context, view, event):
        """Begin a stroke of the tool at the press of its button; returns False if there is nothing to pull under the mouse."""
        try:
            return self._pulling.press(context, view, event, -1.0 if self.is_down else 1.0, self.is_smooth)
        except Refused as refusal:
            self.report({'WARNING'}, str(refusal))
            return False

    def _open(self, context):
        if not self.is_stroke:
            hover.drop()
        kept = hover.take(context) if self.is_stroke else None
        if kept is None and context.object is not None:
            fitting.fit(context.scene.motus.pull, context.object)
        return kept or self.start(context)

    def _finish(self, context):
        session = self._pulling.session
        self._pulling.close(context)
        has_changed = session.finish()
        if has_changed:
            self.remember(context, session)
        elif sentence := why_cancelled(session):
            self.report({'WARNING'}, sentence)
        self._keep(context)
        return {'FINISHED'} if has_changed else {'CANCELLED'}

    def _keep(self, context):
        if self.is_stroke:
            hover.keep(context, self._pulling.session)

    def _stroke(self, context, event):
        pulling = self._pulling
        if event.type in {'ESC', 'RIGHTMOUSE'} and event.value == 'PRESS':
            self.cancel(context)
            return {'CANCELLED'}
        if pulling.is_ended_by(event):
            pulling.release(context)
            return self._finish(context)
        return self._held(context, event)

    def _held(self, context, event):
        """Handle an event while the button of a stroke is held."""
        if event.type in MOVES:
            self._pulling.move(context, event)
            return {'PASS_THROUGH'}  # for drawing the cursor
        if event.type == 'TIMER':
            self._pulling.tick(event)
            return {'PASS_THROUGH'}
        if event.value == 'PRESS':
            self._pulling.key(context, event)
        return {'RUNNING_MODAL'}

    def _session(self, context, event):
        pulling = self._pulling
        if pulling.adjustment is not None:
            pulling.handle_adjustment(context, event)
            return {'PASS_THROUGH'} if event.type in MOVES else {'RUNNING_MODAL'}
        if pulling.is_stroking and pulling.stroke.is_cancelled_by(event):
            pulling.cancel_stroke(context)
            return {'RUNNING_MODAL'}
        if event.type == 'ESC' and event.value == 'PRESS' and not pulling.entry.is_open:
            self.cancel(context)
            return {'CANCELLED'}
        if pulling.is_stroking:
            if pulling.is_ended_by(event):
                pulling.release(context)
                return {'RUNNING_MODAL'}
            return self._held(context, event)
        if event.type in MOVES or event.type in ALWAYS_PASSED:
            return {'PASS_THROUGH'}
        if pulling.entry.is_open and self._number_key(context, event):
            return {'RUNNING_MODAL'}
        if event.type in CONFIRMING and event.value == 'PRESS':
            return self._finish(context)
        return self._command(context, event)

    def _number_key(self, context, event):
        """Handle an event while the user types a number; returns False if its key is no part of the number.

        A key that is no part of the number ends the typing.
        """
        pulling = self._pulling
        if event.value == 'PRESS':
            if pulling.type_strength(context, event.type):
                return True
            pulling.entry.clear()
            pulling.show(context)
        return event.type in CONFIRMING or event.type == 'ESC'

    def _command(self, context, event):
        """Handle an event of the session while no button is held."""
        pulling = self._pulling
        view = pulling.view_under(event)
        if _turns_view(context, event):
            return {'PASS_THROUGH'}
        if view is None or event.value != 'PRESS':
            # Other parts of the interface get no events: changes there would come between the session and its undo step.
            return {'RUNNING_MODAL'}
        if event.type in BUTTONS:
            sign = BUTTONS[event.type] * (-1.0 if event.ctrl else 1.0)
            pulling.press(context, view, event, sign, event.shift)
        elif event.type in {'LEFT_BRACKET', 'RIGHT_BRACKET'}:
            pulling.step(context, status.RADIUS, event.type == 'RIGHT_BRACKET')
        elif event.type == 'F':
            pulling.adjust(context, status.STRENGTH if event.shift else status.RADIUS, view, event)
        elif event.type == 'Z' and event.ctrl:
            pulling.step_back(context)
        elif event.type in {'X', 'Y', 'Z'}:
            pulling.toggle_mirror(context, event.type)
        elif event.type == 'D':
            pulling.cycle(context, "direction")
        elif event.type == 'O':
            pulling.cycle(context, "falloff")
        elif event.type == 'A':
            pulling.set(context, "accumulate", not pulling.brush.accumulate)
        elif event.type == 'I':
            pulling.set(context, "show_inset", not pulling.settings.show_inset)
        else:
            pulling.type_strength(context, event.type)
        return {'RUNNING_MODAL'}


def why_cancelled(session):
    """Sentence that says that the pull and its mirror images have cancelled each other.

    None if the pull moved nothing for a different reason.
    """
    if not session.is_cancelled:
        return None
    return tr(
        "Nothing moved: on the mirror plane this pull and its mirror image cancel each other out. Choose another "
        "direction or switch the mirror off"
    )


def _turns_view(context, event):
    """Whether an event navigates the view, so that the operator passes it on."""
    if event.type in VIEWING or event.type.startswith('NDOF_'):
        return True
    emulates = context.preferences.inputs.use_mouse_emulate_3_button
    return emulates and event.alt and event.type in BUTTONS


def _selects(context, event):
    """Whether the event is the right mouse button, and this button selects in the user's keymap."""
    if event.type != 'RIGHTMOUSE':
        return False
    keys = context.window_manager.keyconfigs.active.preferences
    return getattr(keys, "select_mouse", 'LEFT') == 'RIGHT'
