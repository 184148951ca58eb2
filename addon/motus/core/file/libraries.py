"""Limits of linked datablocks and library overrides, and what to do instead."""

from __future__ import annotations

from typing import Any

import bpy


def count_from_library(owner: Any, path: str) -> int:
    """Number of items that a collection property of a library override has from its library; these items come first.

    path: data path of the collection property. Blender does not let an override remove items that its library has.
    """
    reference = owner.override_library and owner.override_library.reference
    if not reference:
        return 0
    try:
        return len(reference.path_resolve(path))
    except ValueError:  # the library has no such property: `path` lies within an item that the override has added
        return 0


def is_free_or_of(obj: bpy.types.ID, named: bpy.types.ID | None, owner: bpy.types.ID) -> bool:
    """Whether an object may belong to `owner`. named: the owner that the object's pointer names, or None.

    The pointer may be None, name `owner`, or name the library's datablock that `owner` overrides. In the last case, the object is
    an override too: Blender saves no override of such a pointer, which names the library's owner after loading.
    """
    if named is None or named == owner:
        return True
    reference = owner.override_library and owner.override_library.reference
    return named == reference and not obj.library


def collection_for(context: Any, obj: bpy.types.Object) -> bpy.types.Collection:
    """Collection for a new object beside `obj`: the first of its collections that can be edited, or else the scene's own collection."""
    own = (one for one in obj.users_collection if not one.library and not one.override_library)
    return next(own, context.scene.collection)
