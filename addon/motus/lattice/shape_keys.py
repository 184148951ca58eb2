"""Keep what a lattice does to meshes as a shape key of each."""

import bpy

from ..core.refusals import Refused, check_local
from ..core.translations import tr
from . import pulling, removal, resting, targets


def uses_of(context, object_name, modifier_name):
    """Return (lattice, [(object, modifier name)]) of the lattice that an operator's keywords name, with all that the lattice deforms.

    object_name: of a deformed object, or of the lattice; "" takes the active object. modifier_name: of the Lattice modifier; "" takes the last.
    """
    obj = targets.named_or_active(context, object_name)
    lattice = obj if obj.type == 'LATTICE' and not modifier_name else pulling.modifier_of(obj, modifier_name).object
    found = [
        (user, modifier.name)
        for user in removal.deformed_by(lattice)
        for modifier in user.modifiers
        if modifier.type == 'LATTICE' and modifier.object == lattice
    ]
    if not found:
        raise Refused(tr("{object} deforms nothing that is shown").format(object=lattice.name))
    return lattice, found


def check(lattice, uses):
    """Refuse, before anything is changed, if what the lattice does to one of the objects cannot be kept."""
    if resting.is_made(lattice):
        raise Refused(tr("{object} has a rest made by hand: take the regular one first").format(object=lattice.name))
    check_meshes(uses)
    check_first(uses)
    for obj, name in uses:
        removal.check_shown(obj, name)


def check_meshes(uses):
    """Refuse, before anything is changed, if one of the objects cannot be given a shape key."""
    for obj, _ in uses:
        check_local(obj)
        if obj.type != 'MESH':
            raise Refused(tr("{object} is not a mesh").format(object=obj.name))
        removal.check_own_shape(obj)


def check_first(uses):
    """Refuse, before anything is changed, if modifiers that change the shape act before the lattice."""
    for obj, name in uses:
        for other in removal.acting_before(obj, name):
            raise Refused(
                tr("{other} of {object} acts before {modifier}: move {modifier} above it first").format(
                    object=obj.name, modifier=name, other=other.name
                )
            )


def keep(context, uses, name, value):
    """Give each mesh a shape key of what its Lattice modifier makes of it; returns the keys. value: of the keys."""
    found = []
    for obj, modifier in uses:
        active = obj.active_shape_key_index
        had_keys = obj.data.shape_keys is not None
        with context.temp_override(object=obj, active_object=obj, selected_objects=[obj], selected_editable_objects=[obj]):
            try:
                bpy.ops.object.modifier_apply_as_shapekey(modifier=modifier, keep_modifier=True)
            except RuntimeError as error:
                raise removal.not_applicable(obj, modifier, error) from error
        key = obj.data.shape_keys.key_blocks[-1]
        key.name, key.value = name, value
        if had_keys:
            obj.active_shape_key_index = active
        found.append(key)
    return found
