"""Objects that were made along with something, and whether anything else needs them."""

from __future__ import annotations

import bpy

HOLDERS = (bpy.types.Collection, bpy.types.Scene, bpy.types.Action, bpy.types.Screen, bpy.types.WindowManager, bpy.types.WorkSpace)
"""Types of datablocks for which an object does nothing. ID.id_type, which would name them, is not there in 3.4."""


def is_needed(obj: bpy.types.Object) -> bool:
    """Whether another datablock uses an object for more than holding it."""
    users = bpy.data.user_map(subset=[obj])[obj]
    return any(not isinstance(user, HOLDERS) and user != obj for user in users)
