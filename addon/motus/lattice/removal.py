"""Remove fitted lattices, with or without keeping their deformation."""

import bpy

from ..core.refusals import Refused, check_local
from ..core.translations import tr
from . import resting, shapes

KEEP_SHAPES = {'NORMAL_EDIT', 'UV_PROJECT', 'UV_WARP', 'WEIGHTED_NORMAL'}
"""Types of modifiers that give the same result if the deformation is applied before them."""


def fitted(modifier):
    """Whether a modifier belongs to a lattice that Motus has fitted."""
    return modifier.type == 'LATTICE' and modifier.object is not None and modifier.object.motus.lattice.is_fitted


def deformed_by(lattice):
    """Objects that a lattice deforms, sorted by name."""
    return sorted(
        (obj for obj in bpy.data.objects if any(modifier.type == 'LATTICE' and modifier.object == lattice for modifier in obj.modifiers)),
        key=lambda obj: obj.name,
    )


def uses_for(objects):
    """(object, modifier name) for each fitted lattice of these objects; a lattice among the objects stands for what it deforms."""
    found = {}
    for obj in objects:
        own = [(obj, modifier.name) for modifier in obj.modifiers if fitted(modifier)]
        if obj.type == 'LATTICE' and obj.motus.lattice.is_fitted:
            own += [
                (one, modifier.name)
                for one in deformed_by(obj)
                for modifier in one.modifiers
                if modifier.type == 'LATTICE' and modifier.object == obj
            ]
        found.update(dict.fromkeys(own))
    return list(found)


def check_removable(uses, is_applied):
    """Refuse, before anything is changed, if one of the modifiers cannot be removed or applied."""
    for obj, name in uses:
        check_local(obj)
        if is_applied:
            _check_applicable(obj, name)
            _check_first(obj, name, {one for other, one in uses if other == obj})


def _check_applicable(obj, name):
    if obj.type == 'FONT':
        raise Refused(tr("{object} is a text, to which nothing can be applied: convert it to a mesh first").format(object=obj.name))
    check_own_shape(obj)
    if getattr(obj.data, "shape_keys", None):
        raise Refused(tr("{object} has shape keys, to which nothing can be applied").format(object=obj.name))
    check_shown(obj, name)


def check_own_shape(obj):
    """Refuse an object whose shape is linked or shared, so that it must not be changed."""
    if obj.data.library:
        raise Refused(tr("The shape of {object} is linked from another file: make it local first").format(object=obj.name))
    if obj.data.users > 1:
        raise Refused(tr("{object} shares its shape with other objects: make it a single user first").format(object=obj.name))


def check_shown(obj, name):
    """Refuse an object whose modifier of this name is switched off."""
    if not obj.modifiers[name].show_viewport:
        raise Refused(tr("The modifier {modifier} of {object} is switched off in the viewport").format(modifier=name, object=obj.name))


def _check_first(obj, name, applied):
    """Refuse to apply a modifier behind one that changes the shape and is not applied: an applied modifier acts before all others."""
    for other in acting_before(obj, name):
        if other.name not in applied:
            raise Refused(
                tr(
                    "{other} of {object} acts before {modifier}, and would act on the applied shape afterwards: apply {other} "
                    "first, or move {modifier} above it"
                ).format(object=obj.name, modifier=name, other=other.name)
            )


def acting_before(obj, name):
    """List the modifiers before the one of this name that change the shape."""
    before = obj.modifiers[: obj.modifiers.find(name)]
    return [other for other in before if other.type not in KEEP_SHAPES and (other.show_viewport or other.show_render)]


def remove(context, uses, is_applied):
    """Remove Lattice modifiers, applying them if asked, and the vertex groups and lattices that nothing else uses."""
    lattices = {obj.modifiers[name].object: None for obj, name in uses}
    for obj, name in uses:
        modifier = obj.modifiers[name]
        group, lattice = modifier.vertex_group, modifier.object
        if resting.is_made(lattice):
            resting.release(obj)
        if is_applied:
            _apply(context, obj, name)
        else:
            obj.modifiers.remove(modifier)
        if group and group == lattice.motus.lattice.vertex_group:
            _remove_group(obj, group)
    for lattice in lattices:
        if not deformed_by(lattice) and not lattice.library:
            _remove_lattice(context, lattice, uses[0][0])


def _apply(context, obj, name):
    with context.temp_override(object=obj, active_object=obj, selected_objects=[obj], selected_editable_objects=[obj]):
        try:
            bpy.ops.object.modifier_apply(modifier=name)
        except RuntimeError as error:
            raise not_applicable(obj, name, error) from error


def not_applicable(obj, name, error):
    """Return the Refused that reports that Blender cannot apply a modifier. error: what Blender has raised."""
    return Refused(tr("{modifier} of {object} cannot be applied: {error}").format(modifier=name, object=obj.name, error=str(error).strip()))


def _remove_group(obj, name):
    users = [modifier for modifier in obj.modifiers if getattr(modifier, "vertex_group", "") == name]
    group = obj.vertex_groups.get(name)
    if group is None or users or obj.data.library:
        return
    active = obj.vertex_groups.active_index
    before = active if active < group.index else active - 1
    obj.vertex_groups.remove(group)
    if obj.vertex_groups:
        obj.vertex_groups.active_index = max(before, 0)


def _remove_lattice(context, lattice, successor):
    data = lattice.data
    if context.view_layer.objects.active == lattice:
        context.view_layer.objects.active = successor
        successor.select_set(True)
    bpy.data.objects.remove(lattice)
    if not data.users and not data.library:
        bpy.data.lattices.remove(data)


def reset(lattice):
    """Set a lattice's points back to rest."""
    shapes.set_lattice_points(lattice.data, resting.points(lattice.data))
