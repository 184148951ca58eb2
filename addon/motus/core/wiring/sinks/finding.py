"""Finding sinks again: on owners, on members, and on copies of both."""

import bpy

from ...blender import drivers
from ...declare import groups_of, leader_of, of_owner
from ...file.stored import Damaged
from ..hubs import hub_lookup, marks, outbox
from . import property_sink, proxy_sink


def on_object(system, obj, has_bones=True):
    """Yields (Object or PoseBone, constraint, carrier, group's key) of every sink of the system, whoever drives it.

    has_bones: those of its bones too. A solver that waits for the object alone must not look at the hubs of its bones, which other
    threads may evaluate meanwhile.
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
    """(Object or PoseBone, constraint) of every sink that the owner drives."""
    driven = _driven_objects(system, owner)
    carriers = {owner, *(carrier for _, carrier in hub_lookup.carriers_of(system, owner)), *hub_lookup.lost_hubs(system, owner)}
    # Overrides may have been given sinks of their library again.
    overridden = [obj for obj in driven if obj.override_library]
    carriers.update(overridden)
    for obj in overridden:
        carriers.update(carrier for _, carrier in hub_lookup.carriers_of(system, obj.override_library.reference))
    return [(thing, constraint) for obj in driven for thing, constraint, carrier, _ in on_object(system, obj) if carrier in carriers]


def is_sink(system, constraint):
    """Whether a constraint is a sink of the system, whoever drives it."""
    return marks.read(system, constraint) is not None


def has_sinks(system, obj):
    """Whether an object carries sinks of the system: its own, its leader's, or those it was copied with."""
    return any(True for _ in on_object(system, obj))


def renamed_bones(system, owner):
    """(old name, new name) of the driven bones of an owner that were renamed since they were wired."""
    if owner.pose is None:
        return []
    found, at_home = {}, set()
    for thing, old in _as_wired(system, owner):
        if old == thing.name:
            at_home.add(old)
        else:
            found.setdefault(old, thing.name)  # copies of the bone come after it
    return [(old, new) for old, new in found.items() if old not in at_home]


def has_strays(system, owner):
    """Whether bones that the system does not drive have got copies of its sinks, by tools of Blender's."""
    if owner.pose is None or owner.override_library:
        return False
    return any(old != thing.name for thing, old in _as_wired(system, owner)) or bool(_strays(system, owner))


def _as_wired(system, owner):
    """Yields (PoseBone, name that it had when it was wired) for every sink on the owner's bones of which that can be told."""
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
    """Objects with sinks of the same hub as this one, itself among them, if the hub's owner is gone; else none."""
    hubs = {carrier for _, _, carrier, _ in on_object(system, obj) if _is_abandoned(system, carrier)}
    return [
        other
        for other in bpy.data.objects
        if hubs and not other.library and any(carrier in hubs for _, _, carrier, _ in on_object(system, other))
    ]


def _is_abandoned(system, carrier):
    return (
        isinstance(carrier, bpy.types.Mesh)
        and carrier.get(outbox.OWNER_KEY) is None
        and not carrier.library
        and not outbox.is_shared(system, carrier)
    )


def release(system, *objects):
    """Free objects of all sinks of the system, whoever drives them. An owner of its own is detached instead."""
    found = [one for obj in objects for one in on_object(system, obj)]
    for obj in objects:
        # Blender merges the drivers of a rig that is joined into another one, those of its outlet too.
        drivers.remove_under(obj, f'["{outbox.out_key(system)}')
    remove([(thing, constraint) for thing, constraint, _, _ in found])
    for obj in objects:
        if leader_of(system, obj):
            of_owner(system, obj).leader = None
    for mesh in {carrier for _, _, carrier, _ in found}:
        if isinstance(mesh, bpy.types.Mesh) and mesh.get(outbox.OWNER_KEY) is None and not _is_read(system, mesh):
            bpy.data.meshes.remove(mesh)


def makers(system, obj):
    """Owners of the hubs and proxies that the sinks on an object hang on."""
    found = {proxy_sink.proxy_of(constraint) or carrier for _, constraint, carrier, _ in on_object(system, obj)}
    owners = [one.get(marks.PROXY_KEY) or one.get(outbox.OWNER_KEY) for one in found]
    return {owner for owner in owners if isinstance(owner, bpy.types.Object)}


def remove(found):
    """Remove sinks, given as (Object or PoseBone, constraint), with their drivers."""
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
            thing.constraints.active = kept  # which removing any other one forgets
        drivers.drop_empty_animation(obj)
        obj.update_tag()


def remove_orphans(system, owner):
    """Where the sinks are gone, remove what is left of some: drivers whose bone is gone, and constraints whose hub is.

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
    """(PoseBone, constraint) of sinks without a hub. Not of overrides, which may have lost theirs."""
    if system.groups is None or owner.pose is None or owner.override_library:
        return []
    return [(bone, constraint) for bone in owner.pose.bones for constraint in bone.constraints if marks.is_bereft(system, constraint)]


def led_by(system, owner):
    """Objects whose leader the owner is."""
    if _drives_itself_alone(system, owner):
        return []
    return [other for other in bpy.data.objects if leader_of(system, other) == owner]


def _drives_itself_alone(system, owner):
    """Whether its hubs have no members that are neither the owner nor bones of it."""
    if any(_may_lead(system, mesh) for mesh in hub_lookup.hub_meshes(system, owner)):
        return False
    return system.groups is not None or has_sinks(system, owner)


def _may_lead(system, mesh):
    try:
        found = outbox.opened(system, mesh, outbox.key_on_hub(system, mesh))
    except Damaged:
        return True
    if found.info is None:
        return found.layout.members != 1
    return outbox.OTHER in found.info.members or property_sink.is_foreign(mesh)


def _driven_objects(system, owner):
    objects = {owner, *led_by(system, owner)}
    if any(hub_lookup.is_own_hub(hub, owner) for _, hub in hub_lookup.hubs(system, owner)):
        objects.update(member.thing.id_data for group in groups_of(system, owner) for member in group.members if member.thing)
    return objects


def _slot(system, driver):
    """(carrier, group's key, slot) of the outbox that a driver reads; None for any other driver."""
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
