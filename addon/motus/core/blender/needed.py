"""Test whether anything still needs an object that was created along with something else."""

from __future__ import annotations

import bpy

HOLDERS = (bpy.types.Collection, bpy.types.Scene, bpy.types.Action, bpy.types.Screen, bpy.types.WindowManager, bpy.types.WorkSpace)
"""Types of datablocks that may hold an object without needing it. Blender 3.4 has no ID.id_type, by which to name the types."""


def is_needed(obj: bpy.types.Object) -> bool:
    """Whether a different datablock uses an object for more than holding it, as a collection or an action does."""
    users = bpy.data.user_map(subset=[obj])[obj]
    return any(not isinstance(user, HOLDERS) and user != obj for user in users)
