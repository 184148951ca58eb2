"""What the handles of systems in the viewport share: one gizmo of an owner's draws and picks all of them, and starts an operator."""

from typing import Any

from ... import native
from .. import overlay


class HandleGroup:
    """Mixin of a gizmo group that the active object has in Object Mode.

    has: gizmo and operator, identifiers of classes; system(), whose overlay they are a part of; is_owner(obj).
    """

    bl_space_type: Any = 'VIEW_3D'
    bl_region_type: Any = 'WINDOW'
    bl_options: Any = {'PERSISTENT', 'SHOW_MODAL_ALL'}

    @classmethod
    def poll(cls, context):
        obj, space = context.object, context.space_data
        if native.module is None or obj is None or context.mode != 'OBJECT' or not space.show_gizmo:
            return False
        # To ask an object for its settings gives it some.
        if not obj.is_property_set("motus") or not cls.is_owner(obj):
            return False
        return overlay.is_shown(context, cls.system()) and obj.visible_get()

    def setup(self, _context):
        made = self.gizmos.new(self.gizmo)
        made.target_set_operator(self.operator)
        made.use_draw_modal = True
        made.use_tooltip = False  # it would cover the handle's name
