"""What linked data and library overrides do not let one do."""

from __future__ import annotations

from typing import Any

import bpy


def count_from_library(owner: Any, path: str) -> int:
    """How many items of a list of the owner, the first ones, are its library's, which Blender does not let it remove."""
    reference = owner.override_library and owner.override_library.reference
    if not reference:
        return 0
    try:
        return len(reference.path_resolve(path))
    except ValueError:  # the library has no such list, as with the list of an item that was added
        return 0


def is_free_or_of(obj: bpy.types.ID, named: bpy.types.ID | None, owner: bpy.types.ID) -> bool:
    """Whether an object that names another one as its owner, or None, may be this owner's.

    Of such a pointer Blender saves no override: after loading, the override of an object names the library's owner.
    """
    if named is None or named == owner:
        return True
    reference = owner.override_library and owner.override_library.reference
    return named == reference and not obj.library


def collection_for(context: Any, obj: bpy.types.Object) -> bpy.types.Collection:
    """Where to put a new object beside another one: the first of its collections that can be changed, else the scene's."""
    own = (one for one in obj.users_collection if not one.library and not one.override_library)
    return next(own, context.scene.collection)
