"""Base of the modal operators that take hold of a point in the 3D viewport and drag it."""

from mathutils import Vector

from ...refusals import Refused
from ...translations import tr
from ..view.viewports import view_at
from .travel import Travel


class PointDrag:
    """Mixin of a modal operator: press on something, drag, release. Esc or the right mouse button restores the state before.

    During the drag, X, Y and Z lock the point's movement to an axis of the world, Shift slows it down, and a number may be typed.

    The operator is also an Operator (core/interface/operators.py), and has these methods:
    _hold(context, region, view, mouse): finds what is under the mouse and keeps it as self._held; returns (its point in the world, the
    point in pixels of the region), or None if nothing is there. view is a RegionView3D.
    _move(place): called whenever the point moves, with its new place in the world.
    _finish(context): called when the mouse button is released after a movement.
    _show_keys(context): shows which keys can be pressed.
    _press(event), optional: returns whether a key has changed a setting before anything is held.
    _click(context), optional: returns the operator's result if the mouse button is released without a movement.

    self._held has a method restore(), which restores the state before. It keeps references to objects only, not to their bones or settings:
    a script may remove any of them during the drag, and only for objects Blender then raises ReferenceError.
    """

    def _begin(self, context, event):
        """Start the modal operator, and hold what is under the mouse if the button was pressed; returns the result of invoke()."""
        self._held = None
        if event.type == 'LEFTMOUSE' and event.value == 'PRESS' and not self._take(context, event):
            return {'CANCELLED', 'PASS_THROUGH'}
        self._show(context)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        try:
            if event.type in {'ESC', 'RIGHTMOUSE'} and event.value == 'PRESS':
                self.cancel(context)
                return {'CANCELLED'}
            return self._wait(context, event) if self._held is None else self._drag(context, event)
        except Refused as refusal:
            self.cancel(context)
            # Reporting an error would open a popup under the mouse.
            self.report({'WARNING'}, str(refusal))
            return {'CANCELLED'}
        except ReferenceError:
            # A script has removed the object that is held, or the part of the object.
            self._hide(context)
            self.report({'ERROR'}, tr("The object that was pulled is gone"))
            return {'CANCELLED'}

    def cancel(self, context):
        self._hide(context)
        if self._held:
            self._held.restore()

    def _press(self, _event):
        return False

    def _click(self, _context):
        return {'CANCELLED'}

    def _finish(self, context):
        pass

    def _wait(self, context, event):
        if self._press(event):
            self._show_keys(context)
            return {'RUNNING_MODAL'}
        if event.type != 'LEFTMOUSE' or event.value != 'PRESS':
            return {'PASS_THROUGH'}  # the user can turn the view before the drag
        # A press beside everything that can be held is left to Blender.
        if not self._take(context, event):
            return {'PASS_THROUGH'}
        self._show(context)
        return {'RUNNING_MODAL'}

    def _take(self, context, event):
        """Take hold of what is under the mouse; returns whether anything is there."""
        found = view_at(context.window, event.mouse_x, event.mouse_y)
        if found is None:
            return False
        region = found.region
        mouse = Vector((event.mouse_x - region.x, event.mouse_y - region.y))
        held = self._hold(context, region, found.data, mouse)
        if held is None:
            return False
        self._point, seen = held
        self._has_moved = False
        self._travel = Travel(found)
        self._travel.begin(event, self._point, seen - mouse)
        self._pressed = event.mouse_x, event.mouse_y
        return True

    def _drag(self, context, event):
        """Handle an event while something is held; returns the result of modal()."""
        if (event.type == 'LEFTMOUSE' and event.value == 'RELEASE') or self._travel.is_confirmed_by(event):
            self._hide(context)
            if not self._has_moved:
                return self._click(context)
            self._finish(context)
            return {'FINISHED'}
        if event.type == 'MOUSEMOVE':
            self._follow(context, event)
        elif event.value == 'PRESS' and self._travel.take_key(context, event):
            self._go(context)
        return {'RUNNING_MODAL'}

    def _follow(self, context, event):
        if not self._has_moved and (event.mouse_x, event.mouse_y) == self._pressed:
            return
        self._travel.follow(event)
        self._go(context)

    def _go(self, context):
        self._has_moved = True
        self._move(self._point + self._travel.displacement)
        self._show(context)

    def _show(self, context):
        """Show in the viewport's header how far the point has moved; if nothing is held, show which keys can be pressed."""
        if self._held is None:
            self._show_keys(context)
            return
        self._travel.view.tell(self._travel.header(context))
        context.workspace.status_text_set(
            tr("X, Y or Z locks an axis, Shift is precise, a number sets the length; Esc or the right button cancels")
        )

    def _hide(self, context):
        context.workspace.status_text_set(None)
        if self._held:
            self._travel.view.tell(None)
