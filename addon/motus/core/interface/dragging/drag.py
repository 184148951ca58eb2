"""What operators share that take hold of a point in the 3D viewport and drag it."""

from mathutils import Vector

from ...refusals import Refused
from ...translations import tr
from ..view.viewports import view_at
from .travel import Travel


class PointDrag:
    """Mixin of a modal operator: press on something, drag, release; Esc or the right button restores what was.

    While it is dragged, X, Y and Z hold the point to an axis of the world, Shift slows it down, and a number may be typed.

    The operator is one of core's (operators.py), and has: _hold(context, region, view, mouse) -> (point in the world, the
    same in the region) of what lies there and is kept as self._held, or None; _move(place),
    called with where the point goes; _finish(context), called when it was let go after a move; _show_keys(context). It may
    have _press(event): whether a key has changed a setting before anything is held; _click(context): the answer where
    it was let go without a move.

    What is held has restore(), which puts all back. It refers to objects alone, not to bones or settings of theirs: a script may
    remove them meanwhile, and only of objects Blender says so, by a ReferenceError.
    """

    def _begin(self, context, event):
        """The answer of invoke()."""
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
            # An error would open a popup under the mouse.
            self.report({'WARNING'}, str(refusal))
            return {'CANCELLED'}
        except ReferenceError:
            # A script has removed it meanwhile, or the part of it that is held.
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
            return {'PASS_THROUGH'}  # the view can be turned in the meantime
        # A press beside it is meant for what lies there.
        if not self._take(context, event):
            return {'PASS_THROUGH'}
        self._show(context)
        return {'RUNNING_MODAL'}

    def _take(self, context, event):
        """Take hold of what lies under the mouse; returns whether there is anything."""
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
        """An event while something is held."""
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
        """Say what can be done, or how far it went."""
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
