"""Checks that operators of all systems share; each raises Refused with a sentence that says why."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NoReturn

import bpy

from .translations import tr

INFINITE = 3.4e38
"""What Blender makes of an infinite number lies above."""


class Refused(Exception):
    """Raised if an operator cannot do what was asked; the sentence says why."""


def named(name: str) -> bpy.types.Object:
    """The object of this name."""
    found = bpy.data.objects.get(name)
    if found is None:
        raise Refused(tr("There is no object {object}").format(object=name))
    return found


def named_collection(name: str) -> bpy.types.Collection:
    """The collection of this name."""
    found = bpy.data.collections.get(name)
    if found is None:
        raise Refused(tr("There is no collection {collection}").format(collection=name))
    return found


def named_mesh(name: str) -> Any:
    """The mesh object of this name.

    Raises Refused if there is no such object, if the object is no mesh, or if the mesh has neither faces nor modifiers.
    """
    found: Any = named(name)
    if found.type != 'MESH':
        raise Refused(tr("{object} is no mesh").format(object=found.name))
    if not found.data.polygons and not found.modifiers:
        raise Refused(tr("{object} has no faces").format(object=found.name))
    return found


def check_bone(rig: bpy.types.Object, name: str) -> None:
    """Refuse a bone that the rig has not."""
    if rig.pose is None or name not in rig.pose.bones:
        raise Refused(tr("{object} has no bone {bone}").format(object=rig.name, bone=name))


def check_local(obj: bpy.types.Object) -> None:
    """Refuse an object that is another file's."""
    if obj.library:
        raise Refused(tr("{object} is linked from another file: make a library override of it first").format(object=obj.name))


def check_unbaked(owner: Any, settings: Any) -> None:
    """Refuse an owner whose set-up must not be changed. settings: of the system."""
    if settings.is_baked or owner.motus.bake.is_baked:
        raise Refused(tr("{object} is baked: unbake it first").format(object=owner.name))


def check_finite(operator: Any, names: Iterable[str]) -> None:
    """Raise Refused if one of these keywords of an operator, or a component of an array keyword, is infinite or NaN."""
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
    """Refuse an object that Blender does not evaluate: of what it does over time nothing is known."""
    view_layer.update()
    if not obj.evaluated_get(view_layer.depsgraph).is_evaluated:
        _refuse_hidden(obj)


def check_posed(rig: Any, view_layer: Any) -> None:
    """Refuse a rig whose bones are not evaluated in the view layer, or that shows its rest pose."""
    check_evaluated(rig, view_layer)
    # Of a hidden rig Blender evaluates those bones that something visible needs, and lists it nowhere.
    evaluated = rig.evaluated_get(view_layer.depsgraph)
    if all(one != evaluated for one in view_layer.depsgraph.ids):
        _refuse_hidden(rig)
    if rig.data.pose_position == 'REST':
        raise Refused(tr("{object} is in Rest Position: switch to Pose Position first").format(object=rig.name))


def _refuse_hidden(obj: bpy.types.Object) -> NoReturn:
    raise Refused(tr("{object} is not evaluated: show it in the viewport first").format(object=obj.name))
