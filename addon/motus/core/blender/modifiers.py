"""Order of an object's modifiers."""

from __future__ import annotations

from typing import Any

import bpy

from . import capabilities


def move(owner: Any, modifier: Any, place: int) -> None:
    """Move a modifier of an object to a place in the stack. Nothing is called if it stands there."""
    now = owner.modifiers.find(modifier.name)
    if now == place:
        return  # in Blender 3.4 the operator refuses overrides
    if capabilities.has_modifier_order():
        owner.modifiers.move(now, place)
        return
    override: Any = bpy.context.temp_override(object=owner, active_object=owner)
    with override:
        bpy.ops.object.modifier_move_to_index(modifier=modifier.name, index=place)
