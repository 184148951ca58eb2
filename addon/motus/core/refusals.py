"""Checks that operators of all systems share. Each check raises Refused with a sentence that says why."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NoReturn

import bpy

from .translations import tr

INFINITE = 3.4e38
"""Limit from which on a number counts as infinite. What Blender stores if a script sets an infinite number lies above the limit."""


class Refused(Exception):
    """Exception of an operator that cannot do what was asked. Its text is a sentence that says why, in the user's language."""


def named(name: str) -> bpy.types.Object:
    """Find the object of this name in the file. Raises Refused if there is none."""
    found = bpy.data.objects.get(name)
    if found is None:
        raise Refused(tr("There is no object {object}").format(object=name))
    return found


def named_collection(name: str) -> bpy.types.Collection:
    """Find the collection of this name in the file. Raises Refused if there is none."""
    found = bpy.data.collections.get(name)
    if found is None:
        raise Refused(tr("There is no collection {collection}").format(collection=name))
    return found


def named_mesh(name: str) -> Any:
    """Find the mesh object of this name in the file.

    Raises Refused if there is no such object, if the object is no mesh, or if the mesh has neither faces nor modifiers.
    """
    found: Any = named(name)
    if found.type != 'MESH':
        raise Refused(tr("{object} is no mesh").format(object=found.name))
    if not found.data.polygons and not found.modifiers:
        raise Refused(tr("{object} has no faces").format(object=found.name))
    return found


def check_bone(rig: bpy.types.Object, name: str) -> None:
    """Raise Refused if an object has no bone of this name, or is no armature."""
    if rig.pose is None or name not in rig.pose.bones:
        raise Refused(tr("{object} has no bone {bone}").format(object=rig.name, bone=name))


def check_local(obj: bpy.types.Object) -> None:
    """Raise Refused if an object is linked from a library file."""
    if obj.library:
        raise Refused(tr("{object} is linked from another file: make a library override of it first").format(object=obj.name))


def check_unbaked(owner: Any, settings: Any) -> None:
    """Raise Refused if an owner is baked, since the set-up of a baked owner must not change. settings: of a system on the owner."""
    if settings.is_baked or owner.motus.bake.is_baked:
        raise Refused(tr("{object} is baked: unbake it first").format(object=owner.name))


def check_finite(operator: Any, names: Iterable[str]) -> None:
    """Raise Refused if a keyword of an operator, or a component of an array keyword, is infinite or NaN. names: of the keywords."""
    for name in names:
        value = getattr(operator, name)
        parts = value if hasattr(value, "__len__") else (value,)
        if not all(abs(part) < INFINITE for part in parts if isinstance(part, float)):
            raise Refused(tr("{keyword} is not a finite number").format(keyword=name))


def check_no_tweak_mode(obj: bpy.types.Object) -> None:
    """Raise Refused if the object is in the tweak mode of the NLA editor.

    In tweak mode Blender does not let scripts exchange the object's action, and new keys go into an NLA strip.
    """
    if obj.animation_data and obj.animation_data.use_tweak_mode:
        raise Refused(tr("{object} is in the tweak mode of the NLA editor: leave it first").format(object=obj.name))


def check_evaluated(obj: bpy.types.Object, view_layer: bpy.types.ViewLayer) -> None:
    """Raise Refused if Blender does not evaluate an object in a view layer, since its motion over time cannot be read then."""
    view_layer.update()
    if not obj.evaluated_get(view_layer.depsgraph).is_evaluated:
        _refuse_hidden(obj)


def check_posed(rig: Any, view_layer: Any) -> None:
    """Raise Refused if a rig's bones are not evaluated in a view layer, or if the rig shows its rest pose."""
    check_evaluated(rig, view_layer)
    # Blender evaluates those bones of a hidden rig that something visible needs. Depsgraph.ids does not list such a rig.
    evaluated = rig.evaluated_get(view_layer.depsgraph)
    if all(one != evaluated for one in view_layer.depsgraph.ids):
        _refuse_hidden(rig)
    if rig.data.pose_position == 'REST':
        raise Refused(tr("{object} is in Rest Position: switch to Pose Position first").format(object=rig.name))


def _refuse_hidden(obj: bpy.types.Object) -> NoReturn:
    raise Refused(tr("{object} is not evaluated: show it in the viewport first").format(object=obj.name))
