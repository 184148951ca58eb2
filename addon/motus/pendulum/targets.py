"""Find the pendulum that an operator works on, and the objects from which a pendulum can be made.

Errors are raised as Refused, with a sentence for the user.
"""

import math

from mathutils import Vector

from ..core.refusals import Refused, check_local, check_unbaked, named
from ..core.translations import tr
from . import build, parts

FLAT = 1e-3
"""Greatest distance of bobs from the plane in which the pendulum swings, as a share of the rods' lengths."""


def pivot_for(context, name):
    """Return the pivot of the pendulum to which an object belongs; refuses if there is none or if it must not be changed.

    name: of the object; "" takes the active object.
    """
    obj = named(name) if name else context.object
    pivot = obj and parts.pivot_of(obj)
    if pivot is None:
        raise Refused(tr("Nothing here is part of a pendulum"))
    check_editable(pivot)
    return pivot


def check_editable(obj):
    """Refuse an object whose pendulum must not be changed, because it is linked or its pendulum is baked."""
    check_local(obj)
    check_unbaked(obj, obj.motus.pendulum)


def check_free(obj):
    """Refuse an object that cannot become a pivot, because it is linked, baked, or belongs to a pendulum already."""
    check_local(obj)
    if obj.motus.bake.is_baked:
        check_unbaked(obj, obj.motus.pendulum)
    if obj.motus.pendulum.is_active:
        raise Refused(tr("{object} has a pendulum: remove that first").format(object=obj.name))
    if parts.pivot_of(obj):
        raise Refused(tr("{object} is part of a pendulum").format(object=obj.name))


def placed_objects(context, pivot_name, bob_names):
    """Return (pivot, bobs) by their names; without names, the active object is the pivot and the other selected objects are the bobs.

    Selected bobs are sorted by their distance from the pivot. Refuses more than two bobs, or none.
    """
    pivot = named(pivot_name) if pivot_name else context.object
    if pivot is None:
        raise Refused(tr("Select the bobs, and the pivot as the active object"))
    if bob_names:
        bobs = [named(name.strip()) for name in bob_names.split(",") if name.strip()]
    else:
        bobs = [obj for obj in context.selected_objects if obj != pivot]
        bobs.sort(key=lambda bob: ((_place(bob) - _place(pivot)).length, bob.name))
    if not 1 <= len(set(bobs)) == len(bobs) <= 2 or pivot in bobs:
        raise Refused(tr("A pendulum has one bob or two beside its pivot: select or name those"))
    return pivot, bobs


def check_bobs(bobs):
    """Refuse objects that cannot become bobs, because they are linked, have a parent, or belong to a pendulum already."""
    for bob in bobs:
        check_local(bob)
        if bob.parent:
            raise Refused(tr("{object} has a parent: clear that first").format(object=bob.name))
        if parts.pivot_of(bob):
            raise Refused(tr("{object} is part of a pendulum").format(object=bob.name))


def measured(pivot, bobs, is_spherical):
    """Return {"length1": ..., "angle1": ...} and so on, measured from the places of the pivot and the bobs.

    is_spherical: whether the pendulum swings to all sides. Refuses a rod of length 0 and, if it does not, bobs that lie beside the plane of
    the pivot's X and Z axes.
    """
    place, found, scale = Vector(), {}, 0.0
    inverse = pivot.matrix_world.inverted_safe()
    for number, bob in enumerate(bobs, 1):
        rod = inverse @ _place(bob) - place
        scale = max(scale, rod.length)
        if rod.length == 0.0:
            raise Refused(tr("{object} lies on what it shall hang on").format(object=bob.name))
        if is_spherical:
            level = Vector((math.hypot(rod.x, rod.y), 0.0, rod.z))
            return {"length1": rod.length, "angle1": build.angle_of(level), "heading": math.atan2(rod.y, rod.x)}
        if abs(rod.y) > FLAT * scale:
            raise Refused(tr("{object} lies beside the plane of the pivot's X and Z axes: turn the pivot").format(object=bob.name))
        flat = Vector((rod.x, 0.0, rod.z))
        found |= {f"length{number}": flat.length, f"angle{number}": build.angle_of(flat)}
        place = place + flat
    return found


def _place(obj):
    return obj.matrix_world.translation


def removable(obj):
    """Return the object by which the pendulum that an object is or was part of can be removed; None if there is none.

    It is the pivot, a rod without a pendulum, or a trail whose pivot was deleted.
    """
    return parts.pivot_of(obj) or parts.stray_rod_of(obj) or (obj if parts.is_stray_trail(obj) else None)


def set_up(context):
    """List what removable() returns for the selected objects, or for the active object if none is selected."""
    objects = context.selected_objects or [obj for obj in [context.object] if obj]
    found = [removable(obj) for obj in objects]
    return list(dict.fromkeys(one for one in found if one))
