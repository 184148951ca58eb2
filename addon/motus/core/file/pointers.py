"""Pointer properties of settings: which datablocks they may point to, and which datablock they point to.

Blender returns any datablock that a file has in place of the expected one, of any type. An object may also have changed its type since
it was chosen (operator *Convert*). Therefore pointers are read only by pointed(), which checks the type.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy

from .. import keeping

_DECLARED = keeping.OfProcess(
    "object types that a pointer property of the settings accepts", "PropertyGroup class, and name of the property", most=1024
)


def to_object(*types: str, also: Callable[[Any, Any], bool] = lambda _settings, _obj: True, **options: Any) -> Any:
    """A PointerProperty to objects, for annotations of property groups. types: allowed object types; none allows all.

    The property's search field offers neither Motus's helper objects nor deleted objects: both are in no collection.
    also(settings, obj): additional condition for an object that is offered. options: further keywords of PointerProperty.
    """

    def poll(settings: Any, obj: Any) -> bool:
        return (not types or obj.type in types) and _stands(obj) and also(settings, obj)

    poll.types = frozenset(types)  # type: ignore[attr-defined]
    return bpy.props.PointerProperty(type=bpy.types.Object, poll=poll, **options)


def _stands(obj: bpy.types.Object) -> bool:
    """Whether an object is in a collection. Costly: Blender goes through all collections, and a search field asks for each object."""
    return obj.visible_get() or obj.hide_get() or bool(obj.users_collection)


def to_node_tree(**options: Any) -> Any:
    """A PointerProperty to node trees, for annotations of property groups.

    The declared type is bpy.types.ID, and a poll function allows node trees only: Blender 3.4 and 4.3 crash if a pointer that is
    declared for node trees holds a datablock of another type.
    """

    def poll(_settings: Any, datablock: Any) -> bool:
        return isinstance(datablock, bpy.types.NodeTree)

    poll.kind = bpy.types.NodeTree  # type: ignore[attr-defined]
    return bpy.props.PointerProperty(type=bpy.types.ID, poll=poll, **options)


def pointed(settings: Any, name: str) -> Any:
    """The datablock that a pointer property of settings points to; None if it is unset or the datablock is not of the declared type.

    A pointer that is unset is not read, since reading it would store an empty pointer in the file.
    """
    if not settings.is_property_set(name):
        return None
    value = getattr(settings, name)
    if value is None:
        return None
    group = type(settings)
    kind, types = _DECLARED.get((group, name)) or _DECLARED.add((group, name), _declared(group, name))
    return value if isinstance(value, kind) and (not types or value.type in types) else None


def _declared(group: Any, name: str) -> tuple[Any, frozenset[str]]:
    """(datablock class, allowed object types) of a pointer property of a property group; no object types means all are allowed.

    The class is NodeTree for a property that to_node_tree() has declared.
    """
    kind = getattr(bpy.types, group.bl_rna.properties[name].fixed_type.identifier)
    declared = next(base.__annotations__[name] for base in group.__mro__ if name in getattr(base, "__annotations__", ()))
    poll = declared.keywords.get("poll")
    return getattr(poll, "kind", kind), getattr(poll, "types", frozenset())
