"""Find the constraints that are sinks of a system: on owners, on members, and on copies of both.

A sink brings a solver's result to a member, an object or bone that an owner drives.

The owner is the object whose settings are solved; it is the leader of the different objects that it drives. The results are in the
outbox, an array on the mesh of a hidden object, the hub. A proxy is a hidden empty that brings a result to a member.
"""

import bpy

from ...blender import drivers
from ...declare import groups_of, leader_of, of_owner
from ...file.stored import Damaged
from ..hubs import hub_lookup, marks, outbox, sharing
from . import property_sink, proxy_sink


def on_object(system, obj, has_bones=True):
    """Yield (Object or PoseBone, constraint, carrier, key of the group) for each sink of the system on an object.

    Sinks are yielded whichever owner drives them. carrier: mesh of the hub that the sink reads, or the object itself if the hub is gone.
    has_bones: whether sinks on the object's bones are included. A solver that waits only for the object must pass False, since other
    threads may be evaluating the hubs of its bones.
    """
    for thing in _things(obj) if has_bones else (obj,):
        for constraint in thing.constraints:
            found = marks.read(system, constraint)
            if found is None and marks.is_bereft(system, constraint):
                found = obj, ""
            if found is not None:
                yield thing, constraint, *found


def _things(obj):
    return (obj, *(obj.pose.bones if obj.pose else ()))


def sinks(system, owner):
    """Return (Object or PoseBone, constraint) for each constraint by which an owner drives a member."""
    return _sinks(system, owner, sharing.all_parts(system, owner))


def _sinks(system, owner, parts):
    driven, carriers = _driven_objects(system, owner, parts), {owner, *(part.mesh for part in parts)}
    # Blender may have given overrides the sinks of their library's object again.
    overridden = [obj for obj in driven if obj.override_library]
    carriers.update(overridden)
    for obj in overridden:
        carriers.update(carrier for _, carrier in hub_lookup.carriers_of(system, obj.override_library.reference))
    return [(thing, constraint) for obj in driven for thing, constraint, carrier, _ in on_object(system, obj) if carrier in carriers]


def is_sink(system, constraint):
    """Whether a constraint is a sink of the system, whichever owner drives it."""
    return marks.read(system, constraint) is not None


def has_sinks(system, obj):
    """Whether an object has sinks of the system, whichever owner drives them.

    The sinks may read the object's own hubs, or those of its leader (the owner to which the object's setting `leader` points), or may have
    been copied with the object.
    """
    return any(True for _ in on_object(system, obj))


def renamed_bones(system, owner):
    """Return (old name, new name) for each of an owner's own bones that the owner drives and that was renamed since it was wired."""
    if owner.pose is None:
        return []
    found, at_home = {}, set()
    for thing, old in _as_wired(system, owner):
        if old == thing.name:
            at_home.add(old)
        else:
            found.setdefault(old, thing.name)  # the first bone is the renamed one: copies of a bone come after it
    return [(old, new) for old, new in found.items() if old not in at_home]


def has_strays(system, owner):
    """Whether bones that the system does not drive have copies of its sinks, as made by Blender's tools that copy bones.

    A sink is a constraint that brings a solver's result to a bone.
    """
    if owner.pose is None or owner.override_library:
        return False
    return any(old != thing.name for thing, old in _as_wired(system, owner)) or bool(_strays(system, owner))


def _as_wired(system, owner):
    """Yield (PoseBone, name of the driven bone when the owner was wired) for each sink on the owner's bones.

    The names differ if the bone was renamed, or if the sink was copied to a different bone. Sinks for which no name is stored are left out.
    """
    old_names = {}
    for key, carrier in hub_lookup.carriers_of(system, owner):
        known = outbox.info(system, carrier, key)
        if known is not None:
            old_names[carrier] = known.members
    for thing, constraint, carrier, _ in on_object(system, owner) if old_names else ():
        names, index = old_names.get(carrier, ()), marks.index_of(constraint)
        if isinstance(thing, bpy.types.PoseBone) and index is not None and index < len(names):
            yield thing, names[index]


def abandoned(system, obj):
    """Return the objects with sinks of the same hub as this object, including this object, if the owner of that hub is gone.

    The list is empty if the owners of all sinks of this object exist.
    """
    hubs = {carrier for _, _, carrier, _ in on_object(system, obj) if _is_abandoned(carrier)}
    return [
        other
        for other in bpy.data.objects
        if hubs and not other.library and any(carrier in hubs for _, _, carrier, _ in on_object(system, other))
    ]


def _is_abandoned(carrier):
    return isinstance(carrier, bpy.types.Mesh) and sharing.is_abandoned(carrier) and not carrier.library


def release(system, *objects):
    """Remove all sinks of the system from these objects, whichever owner drives them.

    Not for owners of the system: detach() removes their wiring.
    """
    found = [one for obj in objects for one in on_object(system, obj)]
    for obj in objects:
        # When a rig is joined into a different one, Blender merges their drivers, including those of the joined rig's outlet (its outputs).
        drivers.remove_under(obj, f'["{outbox.out_key(system)}')
    remove([(thing, constraint) for thing, constraint, _, _ in found])
    for obj in objects:
        if leader_of(system, obj):
            of_owner(system, obj).leader = None
    for mesh in {carrier for _, _, carrier, _ in found}:
        if isinstance(mesh, bpy.types.Mesh) and mesh.get(outbox.OWNER_KEY) is None and not _is_read(system, mesh):
            hub_lookup.remove(mesh)


def makers(system, obj):
    """Return the set of owners for which the hubs and proxies were made that the sinks on an object read.

    A proxy is a hidden empty whose transform a sink copies.
    """
    found = {proxy_sink.proxy_of(constraint) or carrier for _, constraint, carrier, _ in on_object(system, obj)}
    owners = [one.get(marks.PROXY_KEY) or one.get(outbox.OWNER_KEY) for one in found]
    return {owner for owner in owners if isinstance(owner, bpy.types.Object)}


def remove(found):
    """Remove sinks from their objects and bones, together with the drivers on them. found: list of (Object or PoseBone, constraint)."""
    by_object = {}
    for thing, constraint in found:
        by_object.setdefault(thing.id_data, []).append((thing, constraint))
    for obj, ours in by_object.items():
        paths = {constraint.path_from_id() for _, constraint in ours}
        drivers.remove_where(obj, lambda path, paths=paths: path.rpartition(".")[0] in paths)  # type: ignore[misc]
        for thing, constraint in ours:
            active = thing.constraints.active
            kept = None if active == constraint else active
            thing.constraints.remove(constraint)
            thing.constraints.active = kept  # removing a constraint clears the active one
        drivers.drop_empty_animation(obj)
        obj.update_tag()


def remove_all(system, owner, parts):
    """Remove the sinks of an owner from all objects, and what broken sinks have left on the owner.

    The latter are drivers of constraints whose bone is gone, and sinks on bones whose hub is gone. Returns the objects, other than the
    owner itself, that the owner drove. parts: all Parts of the owner, also those whose hub object was deleted.
    """
    remove(_sinks(system, owner, parts))
    _remove_orphans(system, owner)
    led = _led_by(system, owner, parts)
    for other in led:
        of_owner(system, other).leader = None
    return led


def _remove_orphans(system, owner):
    """Remove from an owner the drivers of constraints whose bone is gone, and the sinks on bones whose hub is gone.

    Removing a bone in Edit Mode leaves the drivers of its constraints behind.
    """
    animation = owner.animation_data
    gone = {
        curve.data_path
        for curve in (animation.drivers if animation else ())
        if curve.data_path.startswith("pose.bones[") and _slot(system, curve.driver) and _resolve(owner, curve.data_path) is None
    }
    if gone:
        drivers.remove_where(owner, gone.__contains__)
    remove(_strays(system, owner))


def _strays(system, owner):
    """Return (PoseBone, constraint) for each sink on an owner's bones whose hub is gone.

    The list is empty for a library override: its sinks may be valid although Blender has lost the pointers to their hubs.
    """
    if system.groups is None or owner.pose is None or owner.override_library:
        return []
    return [(bone, constraint) for bone in owner.pose.bones for constraint in bone.constraints if marks.is_bereft(system, constraint)]


def _led_by(system, owner, parts):
    """Return the objects that an owner drives for this system: those in whose settings the pointer `leader` leads to the owner."""
    if _drives_itself_alone(system, owner, parts):
        return []
    return [other for other in bpy.data.objects if leader_of(system, other) == owner]


def _drives_itself_alone(system, owner, parts):
    """Whether an owner drives no objects but itself and its bones. parts: Parts of the owner."""
    if any(_may_lead(system, part) for part in parts):
        return False
    return system.groups is not None or has_sinks(system, owner)


def _may_lead(system, part):
    try:
        found = sharing.opened(system, part, part.mesh)
    except Damaged:
        return True
    if found.info is None:
        return found.layout.members != 1
    return outbox.OTHER in found.info.members or property_sink.is_foreign(part.mesh)


def _driven_objects(system, owner, parts):
    objects = {owner, *_led_by(system, owner, parts)}
    if any(part.is_own for part in parts):
        objects.update(member.thing.id_data for group in groups_of(system, owner) for member in group.members if member.thing)
    return objects


def _slot(system, driver):
    """Return (hub's mesh, key of the group, index of the slot) for the slot of an outbox that a driver reads; None if there is none."""
    pattern = outbox.slot_pattern(system)
    for variable in driver.variables:
        target = variable.targets[0]
        found = pattern.match(target.data_path)
        if found and target.id:
            return target.id, found["key"] or "", int(found["slot"])
    return None


def _is_read(system, mesh):
    return any(carrier == mesh for obj in bpy.data.objects for _, _, carrier, _ in on_object(system, obj))


def _resolve(owner, path):
    try:
        return owner.path_resolve(path)
    except ValueError:
        return None
