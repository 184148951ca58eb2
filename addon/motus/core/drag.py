"""What operators share that take hold of a point in the 3D viewport and drag it."""

from bpy_extras.view3d_utils import region_2d_to_location_3d
from mathutils import Vector

from .refusals import Refused
from .viewports import view_at


class PointDrag:
    """Mixin of a modal operator: press on something, drag, release; Esc or the right button restores what was.

    The operator is one of core's (operators.py), and has: _hold(context, region, view, mouse) -> (point in the world, the
    same in the region) of what lies there and is kept as self._held, whose restore() puts all back, or None; _move(place),
    called with where the point goes; _finish(context), called when it was let go after a move; _show_keys(context). It may
    have _press(event): whether a key has changed a setting before anything is held.
    """

    def _begin(self, context, event):
        """The answer of invoke()."""
        self._held = None
        if event.type == 'LEFTMOUSE' and event.value == 'PRESS' and not self._take(context, event):
            return {'CANCELLED', 'PASS_THROUGH'}
        self._show_keys(context)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        if event.type in {'ESC', 'RIGHTMOUSE'} and event.value == 'PRESS':
            self.cancel(context)
            return {'CANCELLED'}
        if self._held is None:
            return self._wait(context, event)
        if event.type == 'MOUSEMOVE':
            self._follow(event)
        elif event.type == 'LEFTMOUSE' and event.value == 'RELEASE':
            context.workspace.status_text_set(None)
            if not self._has_moved:
                return {'CANCELLED'}
            self._finish(context)
            return {'FINISHED'}
        return {'RUNNING_MODAL'}

    def cancel(self, context):
        context.workspace.status_text_set(None)
        if self._held:
            self._held.restore()

    def _press(self, _event):
        return False

    def _finish(self, context):
        pass

    def _wait(self, context, event):
        if self._press(event):
            self._show_keys(context)
            return {'RUNNING_MODAL'}
        if event.type != 'LEFTMOUSE' or event.value != 'PRESS':
            return {'PASS_THROUGH'}  # the view can be turned in the meantime
        try:
            self._take(context, event)
        except Refused as refusal:
            self.cancel(context)
            return self.refuse(refusal)
        # A press beside it is meant for what lies there.
        return {'RUNNING_MODAL'} if self._held else {'PASS_THROUGH'}

    def _take(self, context, event):
        """Take hold of what lies under the mouse; returns whether there is anything."""
        found = view_at(context.window, event.mouse_x, event.mouse_y)
        if found is None:
            return False
        region, view = found.region, found.data
        mouse = Vector((event.mouse_x - region.x, event.mouse_y - region.y))
        held = self._hold(context, region, view, mouse)
        if held is None:
            return False
        self._point, seen = held
        self._has_moved = False
        self._region, self._view = region, view
        # The mouse keeps its distance from the point, so that nothing jumps.
        self._offset = seen - mouse
        self._pressed = event.mouse_x, event.mouse_y
        return True

    def _follow(self, event):
        if not self._has_moved and (event.mouse_x, event.mouse_y) == self._pressed:
            return
        self._has_moved = True
        mouse = Vector((event.mouse_x - self._region.x, event.mouse_y - self._region.y))
        self._move(region_2d_to_location_3d(self._region, self._view, mouse + self._offset, self._point))
