"""Finding sinks again, by what they read: names can be changed, and copies carry sinks that nobody listed."""

import bpy

from ..system import of_owner
from . import attribute_sink, drivers, outbox


def on_object(system, obj):
    """(Object or PoseBone, constraint, carrier) of every sink of the system on an object, whoever drives it."""
    found = [(obj, constraint, constraint.target.data) for constraint in obj.constraints
             if attribute_sink.is_undriven(system, constraint)]
    animation = obj.animation_data
    for curve in animation.drivers if animation else ():
        if curve.data_path.endswith(".influence"):
            carrier = _carrier_read(system, curve.driver, obj)
            constraint = carrier and _resolve(obj, curve.data_path.removesuffix(".influence"))
            if constraint:
                found.append((_holder(obj, curve.data_path), constraint, carrier))
    return found


def sinks(system, owner):
    """(Object or PoseBone, constraint) of every sink that the owner drives."""
    carrier = outbox.carrier_of(system, owner)
    return [(member, constraint) for obj in _driven_objects(system, owner)
            for member, constraint, read in on_object(system, obj) if read == carrier]


def has_sinks(system, obj):
    """Whether an object carries sinks of the system: its own, its leader's, or those it was copied with."""
    return bool(on_object(system, obj))


def release(system, obj):
    """Free one object of all sinks of the system, whoever drives it. An owner of its own is detached instead."""
    carriers = set()
    for member, constraint, carrier in on_object(system, obj):
        remove(member, constraint)
        carriers.add(carrier)
    of_owner(system, obj).leader = None
    for mesh in carriers:
        if isinstance(mesh, bpy.types.Mesh) and mesh.get(outbox.OWNER_KEY) is None and not _is_read(system, mesh):
            bpy.data.meshes.remove(mesh)


def remove(member, constraint):
    """Remove a sink with its drivers."""
    owner = member.id_data
    drivers.remove_under(owner, constraint.path_from_id() + ".")
    member.constraints.remove(constraint)
    drivers.drop_empty_animation(owner)
    owner.update_tag()


def set_muted(system, owner, muted):
    """Switch the sinks off or on, leaving all else in place."""
    for _, constraint in sinks(system, owner):
        constraint.mute = muted


def led_by(system, owner):
    """Objects whose leader the owner is."""
    if of_owner(system, owner).hub is None:
        return []
    return [other for other in bpy.data.objects if of_owner(system, other).leader == owner]


def _driven_objects(system, owner):
    objects = {owner, *led_by(system, owner)}
    if outbox.owns_hub(system, owner):
        objects.update(member.id_data for member in system.members(owner) if member)
    return objects


def _carrier_read(system, driver, obj):
    """The datablock whose outbox a driver takes its weight from; None for any other driver."""
    if driver.expression.startswith(f'motus_direct(self,"{system.name}",{outbox.WEIGHT},'):
        return obj
    weight = outbox.out_path(system, outbox.WEIGHT)
    targets = [target for variable in driver.variables for target in variable.targets]
    return next((target.id for target in targets if target.data_path == weight), None)


def _is_read(system, mesh):
    return any(carrier == mesh for obj in bpy.data.objects for _, _, carrier in on_object(system, obj))


def _resolve(owner, path):
    try:
        return owner.path_resolve(path)
    except ValueError:
        return None


def _holder(owner, path):
    """The Object or PoseBone whose constraint a driver path names."""
    bone, separator, _ = path.rpartition(".constraints[")
    return owner.path_resolve(bone) if separator else owner
