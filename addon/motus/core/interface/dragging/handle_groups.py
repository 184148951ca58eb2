"""Base of the gizmo groups for handles in the viewport: one gizmo draws and picks all handles of an object, and starts an operator."""

from typing import Any

from ... import native
from .. import overlay


class HandleGroup:
    """Mixin of a gizmo group that is shown for the active object in Object Mode.

    Subclasses have: gizmo and operator, the identifiers of their classes; system(), returns the system with whose overlay the handles are
    shown; is_owner(obj), returns whether an object has handles.
    """

    bl_space_type: Any = 'VIEW_3D'
    bl_region_type: Any = 'WINDOW'
    bl_options: Any = {'PERSISTENT', 'SHOW_MODAL_ALL'}

    @classmethod
    def poll(cls, context):
        obj, space = context.object, context.space_data
        if native.module is None or obj is None or context.mode != 'OBJECT' or not space.show_gizmo:
            return False
        # Reading Object.motus creates the property group on the object.
        if not obj.is_property_set("motus") or not cls.is_owner(obj):
            return False
        return overlay.is_shown(context, cls.system()) and obj.visible_get()

    def setup(self, _context):
        made = self.gizmos.new(self.gizmo)
        made.target_set_operator(self.operator)
        made.use_draw_modal = True
        made.use_tooltip = False  # a tooltip would cover the handle's name
