"""Remove owners that were deleted, with their helpers.

An owner is an object whose settings Motus solves; its helpers are hidden objects. Blender removes a deleted object when nothing uses the
object any more. An owner and its hub (the helper with the solver's driver) use each other: without this module, both would stay in the file
and in Blender's pickers for good. Objects that something else uses stay, as they do in Blender.

Hubs whose owner a script has removed at once are not saved either, although their meshes have a fake user (hubs/hub_lookup.py).
"""

import bpy

from ...blender import helpers, node_groups
from ...declare import is_owner, leader_of, systems
from ...file import deleted
from ..attaching import attach
from ..hubs import hub_lookup, outbox, sharing
from ..sinks import finding, property_sink


def remove_soon():
    """Schedule remove_deleted() for when the running script has ended, if any owners were deleted.

    The wait is for scripts that take an owner out of one collection in order to put the owner into a different one. In background mode
    nothing is scheduled, since a script runs to the end there; owners are then removed when the script saves the file.
    """
    if not bpy.app.background and not bpy.app.timers.is_registered(remove_deleted) and _deleted_owners():
        bpy.app.timers.register(remove_deleted, first_interval=0.0)


def stop():
    """Cancel a scheduled call of remove_deleted()."""
    if bpy.app.timers.is_registered(remove_deleted):
        bpy.app.timers.unregister(remove_deleted)


def remove_deleted():
    """Remove the owners of this file that were deleted, and the objects that only these owners and their helpers use.

    The properties that they drove get their own values back. A different owner that is set up to drive such a property, as a copy of the
    deleted owner is, drives the property from now on.
    """
    owners = _deleted_owners()
    unneeded = _unneeded(owners) if owners else set()
    others = [obj for obj in unneeded if not _is_hub(obj)]
    hubs = {obj.data for obj in unneeded if _is_hub(obj)}
    abandoned = {mesh for mesh in bpy.data.meshes if not mesh.library and outbox.is_hub(mesh) and sharing.is_abandoned(mesh)} - hubs
    is_free = _free_properties([*hubs, *abandoned])
    for obj in others:
        bpy.data.objects.remove(obj)
    for mesh in hubs:
        hub_lookup.remove(mesh)
    for mesh in abandoned:
        hub_lookup.unprotect(mesh)
    for system in systems():
        sharing.tidy(system)
    if is_free:
        _drive_free_properties()


def _is_hub(obj):
    return obj.type == 'MESH' and outbox.is_hub(obj.data)


def _free_properties(meshes):
    """Remove the drivers of properties that read these hubs; returns whether there were any. meshes: meshes of the hubs."""
    by_system = [(system, [mesh for mesh in meshes if outbox.key_on_hub(system, mesh) is not None]) for system in systems()]
    found = [property_sink.remove(system, ours) for system, ours in by_system if ours]
    return any(found)


def _drive_free_properties():
    """Wire the owners again that do not drive all of their properties, since a property may be free now."""
    for system in systems():
        for owner in [obj for obj in bpy.data.objects if not obj.library and is_owner(system, obj) and not deleted.is_deleted(obj)]:
            if not all(property_sink.are_driven(system, owner, mesh) for _, mesh in hub_lookup.carriers_of(system, owner)):
                attach.refresh(system, owner)


def _deleted_owners():
    return {
        obj
        for obj in bpy.data.objects
        if not obj.library
        and obj.is_property_set("motus")
        and any(is_owner(system, obj) for system in systems())
        and deleted.is_deleted(obj)
    }


def _unneeded(owners):
    """Return the objects to remove from the file, in a set. owners: the owners that were deleted.

    Candidates are the deleted owners, all helpers of the file (objects that Motus has made for its own use, such as hubs), and the objects
    that these drive or point to. A candidate is left out if it has a fake user, or if an object that is no candidate uses it. This is
    repeated until no candidate is left out.

    An object of which an owner drives no transforms but properties alone, such as a face whose shape keys blink, does not keep the owner.
    """
    found = _reached(owners | {obj for obj in bpy.data.objects if helpers.is_helper(obj) and not obj.library})
    set_only = [(obj, leader) for obj, leader in _led() if leader in found]
    while True:
        counts = _uses_within(found)
        for obj, leader in set_only:
            if obj not in found:
                counts[leader] = counts.get(leader, 0) + 1
        left = {obj for obj in found if not obj.use_fake_user and obj.users == counts.get(obj, 0)}
        if left == found:
            return found
        found = left


def _led():
    """Return (object, owner) for each object that is led by an owner which drives properties of the object, but no transforms."""
    led = [
        (system, obj, leader_of(system, obj))
        for obj in bpy.data.objects
        if obj.is_property_set("motus") and not obj.library
        for system in systems()
    ]
    return [(obj, leader) for system, obj, leader in led if leader is not None and not finding.has_sinks(system, obj)]


def _reached(objects):
    """Return a set of objects, extended by all local objects that these drive or point to, directly or through further objects."""
    found, new = set(), objects
    while new:
        found |= new
        led = {
            obj for obj in bpy.data.objects if obj.is_property_set("motus") and any(leader_of(system, obj) in new for system in systems())
        }
        reached = led | {used for obj in new for used in _pointed_by(obj)}
        new = {obj for obj in reached - found if not obj.library}
    return found


def _uses_within(objects):
    """Return {object: number of pointers to the object} for the pointers that a set of objects contains.

    Pointers in the objects' settings and custom properties, and in those of their hubs' meshes, are counted.
    """
    counts = {}
    for obj in objects:
        holders = (obj, obj.data) if obj.type == 'MESH' and outbox.is_hub(obj.data) else (obj,)
        for used in [one for holder in holders for one in _pointed_by(holder)]:
            counts[used] = counts.get(used, 0) + 1
    return counts


def _pointed_by(datablock):
    values = list(datablock.values())
    if isinstance(datablock, bpy.types.Object):
        for modifier in datablock.modifiers:
            if modifier.type == 'NODES' and modifier.node_group:
                values += node_groups.inputs_of(modifier)
        if datablock.is_property_set("motus"):
            values += _pointed_in(datablock.motus)
    return [value for value in values if isinstance(value, bpy.types.Object)]


def _pointed_in(group):
    for prop in group.bl_rna.properties:
        name = prop.identifier
        if name == "rna_type" or prop.type not in {'POINTER', 'COLLECTION'} or not group.is_property_set(name):
            continue
        value = getattr(group, name)
        for one in value if prop.type == 'COLLECTION' else (value,):
            if isinstance(one, bpy.types.PropertyGroup):
                yield from _pointed_in(one)
            else:
                yield one
