"""Table of the changes that Blender does not report to add-ons: how each is detected, how it is repaired, and when it is looked for.

A change is detected by a cheap function, its sign, which returns what the repair needs: a list, a set, or True. A result that is false,
such as an empty list, means that there is nothing to repair. A repair is made once for each change, and its result does not depend on
which owner was evaluated first.

The owner is the object whose settings a system solves; a *place* is the pair (name of the system, name of the owner). Hubs are hidden
objects whose meshes carry a solver's driver and results; several owners can share one, with a row each. Sinks are constraints, drivers
and modifiers that apply the results. Proxies are hidden empties that bring a result to an object or bone.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import bpy

from ... import native, rigs
from ...blender import helpers
from ...declare import has_settings, is_owner, leader_of, of_owner, registered, systems
from ...evaluated import copies, read_keys
from ...file import deleted, former_names
from ...measures.handedness import is_mirrored
from ..attaching import attach, overrides, signature, waiting
from ..attaching.solver_driver import waits
from ..hubs import hub_lookup, outbox, sharing
from ..sinks import geometry_sink, property_sink, proxy_sink
from ..sinks.finding import has_sinks, makers, release
from . import relations, remains
from .watch import key, noticed

EDIT, FRAME, LOADED, ARRIVED, SAVING, SAVED = "edit", "frame", "loaded", "arrived", "saving", "saved"
"""Moments at which repairs are looked for.

EDIT: an evaluation after an edit has ended. FRAME: an evaluation after a change of the frame has ended. LOADED: a file was loaded.
ARRIVED: undo, redo or an import has brought datablocks. SAVING: a file is about to be saved. SAVED: a file was saved.
"""
AFTER_EVALUATION = EDIT, FRAME


class Event:
    """Call of a Blender handler, in which changes are looked for.

    moment: EDIT or FRAME when the evaluation after an edit or after a change of the frame has ended; LOADED after a file was loaded;
    ARRIVED after undo, redo or an import; SAVING before a file is saved, and SAVED after that. depsgraph: dependency graph, or None if
    Blender passes none to the handler. have_collections_changed: whether objects may have been linked to collections or unlinked from them
    in this evaluation; False without a depsgraph. has_armatures: whether armatures were updated in this evaluation; False without a
    depsgraph.
    """

    def __init__(self, moment, depsgraph=None):
        self.moment, self.depsgraph = moment, depsgraph
        self.have_collections_changed = depsgraph is not None and deleted.have_collections_changed(depsgraph)
        self.has_armatures = depsgraph is not None and depsgraph.id_type_updated('ARMATURE')

    def has_updated(self, kind):
        """Whether a datablock of a type, such as 'OBJECT', was updated in this evaluation; False without a depsgraph."""
        return self.depsgraph is not None and self.depsgraph.id_type_updated(kind)


class Repair(NamedTuple):
    """One kind of change that Blender does not report to add-ons, with its detection and its repair.

    change: description of the change, for the log. moments: moments, such as EDIT or LOADED, at which the change is looked for. sign:
    function of the Event that detects the change; returns the first argument for `repair`, or something false if there is no change.
    repair: function (result of sign, Event) that repairs the wiring. needs_use: whether the change is looked for only after a solver was
    called in the open file.
    """

    change: str
    moments: tuple
    sign: Callable[[Event], Any]
    repair: Callable[[Any, Event], None]
    needs_use: bool = True


def _attached():
    """Return (system, owner) for each system that is set up on a local object."""
    owners = [obj for obj in bpy.data.objects if not obj.library and obj.is_property_set("motus")]
    return [(system, owner) for owner in owners for system in systems() if is_owner(system, owner)]


def _find(name, owner_name):
    """Return (system, owner) for their names.

    Returns (None, None) if one of them is gone, or if the system is not set up on a local object of this name.
    """
    system, owner = registered.get(name), bpy.data.objects.get((owner_name, None))
    if not system or not owner or not is_owner(system, owner):
        return None, None
    return system, owner


def _found_at(places):
    """Return (system, owner) for each pair (name of the system, name of the owner) in a set.

    A pair whose system or owner is gone is removed from the set.
    """
    found = []
    for place in list(places):
        system, owner = _find(*place)
        if owner is None:
            places.discard(place)
        else:
            found.append((system, owner))
    return found


def _pop_each(places):
    """Yield (system, owner) for each pair (name of the system, name of the owner) in a set, and remove the pair from the set.

    Pairs that are added to the set meanwhile are yielded too. Pairs whose system or owner is gone are only removed.
    """
    while places:
        system, owner = _find(*places.pop())
        if owner is not None:
            yield system, owner


def _refresh_each(found, _event):
    for system, owner in found:
        attach.refresh(system, owner)


# --- Drivers of properties, which are at rest (muted, and aimed at a placeholder property) in a file ---------------------------------


def _resting(_event):
    return noticed.resting


def _wake_resting(keys, _event):
    while keys:
        wanted = keys.pop()
        _wake(next((mesh for mesh in bpy.data.meshes if key(mesh) == wanted), None))


def _wake(mesh):
    owner = mesh and mesh.get(outbox.OWNER_KEY)
    for system in systems() if isinstance(owner, bpy.types.Object) else ():
        if outbox.key_on_hub(system, mesh) is not None:
            property_sink.wake(system, owner, mesh)


def _asleep(_event):
    return [mesh for mesh in bpy.data.meshes if property_sink.KEY in mesh and property_sink.is_resting(mesh)] if native.module else []


def _wake_each(meshes, _event):
    for mesh in meshes:
        _wake(mesh)


def _awake(_event):
    return [mesh for mesh in bpy.data.meshes if property_sink.KEY in mesh and not mesh.library]


def _rest_each(meshes, _event):
    for mesh in meshes:
        for system in systems():
            if outbox.key_on_hub(system, mesh) is not None:
                property_sink.rest(system, mesh)


# --- Owners whose signature may have changed -----------------------------------------------------------------------------------------


def _changed(event):
    if noticed.rows and event.depsgraph is not None:
        _check_rows(event)
    return noticed.changed


def _check_rows(event):
    """Detect owners that must leave a shared hub; the hub's solver cannot, because it does not read the owners.

    An owner must leave the hub if its settings have become animated, or if it has become mirrored by a negative scale. Mirroring is looked
    for only after an edit. Changed owners are stored in `noticed.changed`.
    """
    states, is_edit = noticed.states, event.moment == EDIT
    for hub, known in list(noticed.rows.items()):
        for place, owner in noticed.holders_of(hub, known):
            try:
                is_there = owner is not None and owner.name == place[1]
            except ReferenceError:
                is_there = False
            if not is_there:  # the owner was renamed or removed: all rows are looked through
                noticed.rows.pop(hub, None)
                noticed.holders.pop(hub, None)
                noticed.object_count = -1
                continue
            if is_edit and is_mirrored(owner):
                noticed.changed.add(place)
            animation = owner.animation_data
            if animation and (
                animation.action or animation.nla_tracks or place not in states or states[place][0] != len(animation.drivers)
            ):
                evaluated = owner.evaluated_get(event.depsgraph)
                moves = bool(registered[place[0]].outputs) and copies.has_moving_settings(evaluated)
                noticed.note_state(place, (copies.drivers_on(evaluated), moves))


def _refresh_changed(places, _event):
    for system, owner in _pop_each(places):
        attach.refresh_changed(system, owner)


# --- Copies --------------------------------------------------------------------------------------------------------------------------


def _has_new_objects(event):
    # Counting the objects takes 0.1 ms for 5000 objects. New objects are in a collection, otherwise they are not evaluated.
    may_have = event.moment == EDIT or event.depsgraph is None or noticed.object_count < 0 or event.have_collections_changed
    return may_have and len(bpy.data.objects) != noticed.object_count


def _renamed_settings(event):
    if event.depsgraph is None or _has_new_objects(event) or overrides.has_new_marks():
        return [system for system in systems() if system.former_names]
    return []


def _move_renamed(found, _event):
    """Move settings that an earlier version of Motus has saved under old names to their present names.

    found: systems whose settings were renamed. Settings of linked objects are included.
    """
    for system in found:
        for obj in [one for one in bpy.data.objects if has_settings(system, one)]:
            if former_names.move(of_owner(system, obj), system.former_names):
                obj.update_tag()


def _part_copies(_found, event):
    helpers.put_away()
    _protect_each(_unprotected(event), event)
    relations.look()
    for system in systems():
        sharing.tidy(system)
    attached = _attached()
    deleted.watch(dict.fromkeys(owner for _, owner in attached))
    for place in [(system.name, owner.name) for system, owner in attached]:
        system, owner = _find(*place)  # to wire one owner anew may remove another, if a script has made it a helper
        if owner is None or place in noticed.given_up or not _is_borrowing(system, owner):
            continue
        attach.refresh(system, owner)
        if _is_borrowing(system, owner):
            noticed.given_up.add(place)
    noticed.object_count = len(bpy.data.objects)


def _is_borrowing(system, owner):
    """Whether an owner is a copy that still uses hubs or proxies (hidden helper objects) of the object from which it was copied."""
    return signature.has_strange_carriers(system, owner, sharing.parts(system, owner))


# --- Points and collections ----------------------------------------------------------------------------------------------------------


def _with_other_mesh(_event):
    if not noticed.moved_points:
        return []
    return [(system, owner) for system, owner in _found_at(noticed.moved_points) if geometry_sink.is_stale(system, owner)]


def _unsettled(_event):
    return noticed.unsettled


def _settle(places, _event):
    for system, owner in _pop_each(places):
        system.settle(owner)


def _with_drawn_curves(event):
    if event.moment == EDIT and not event.has_updated('NODETREE'):
        return []
    return [(system, owner) for system, owner in _attached() if system.take_over is not None]


def _unprotected(_event):
    # Hubs that Blender has overridden along with their owner are nobody's: the override gets a hub of its own.
    ours = [mesh for mesh in bpy.data.meshes if outbox.is_hub(mesh) and not mesh.library and not mesh.override_library]
    return [mesh for mesh in ours if not hub_lookup.is_protected(mesh) and not sharing.is_abandoned(mesh)]


def _protect_each(meshes, _event):
    for mesh in meshes:
        hub_lookup.protect(mesh)


def _take_over(found, _event):
    for system, owner in found:
        system.take_over(owner)


def _with_other_collection(event):
    if not noticed.gathering or not event.have_collections_changed:
        return []
    return [(system, owner) for system, owner in _found_at(noticed.gathering) if waiting.is_stale(system, of_owner(system, owner))]


# --- Bones ---------------------------------------------------------------------------------------------------------------------------


def _edited_armatures(event):
    """Return the armatures that were updated in this evaluation and are not in Edit Mode, as a set of original datablocks."""
    if not event.has_armatures:
        return set()
    edited = [
        copies.original_of(update.id, bpy.data.armatures, event.depsgraph)
        for update in event.depsgraph.updates
        if isinstance(update.id, bpy.types.Armature)
    ]
    return {armature for armature in edited if armature is not None and not armature.is_editmode}


def _grown_armatures(event):
    if not event.has_armatures:
        return set()
    return {armature for armature in _edited_armatures(event) if noticed.bone_counts.get(key(armature)) != len(armature.bones)}


def _release_joined(grown, _event):
    """Remove the sinks that came into a rig when a different rig was joined into it, and remove what is left of the joined rig.

    A sink is a constraint or driver that brings a solver's result to a bone. grown: armatures whose number of bones has changed.
    """
    noticed.bone_counts.update((key(armature), len(armature.bones)) for armature in grown)
    # The objects are collected first: release() removes objects from the file, which is not allowed while bpy.data.objects is iterated.
    joined, found = {}, [obj for obj in bpy.data.objects if obj.data in grown and not (obj.library or obj.override_library)]
    for obj in found:
        for system in systems():
            is_driven = is_owner(system, obj) or leader_of(system, obj)
            if system.groups is not None and not is_driven and has_sinks(system, obj):
                joined |= dict.fromkeys(rig for rig in makers(system, obj) if not rig.users_collection)
                release(system, obj)
    for rig in joined:
        _discard(rig)


def _discard(rig):
    """Remove a rig that is in no collection, together with its hubs and proxies (hidden helper objects that only the rig uses)."""
    for system in systems():
        for part in [part for part in sharing.parts(system, rig) if part.is_own]:
            hub_lookup.remove(part.mesh)
        proxy_sink.release(of_owner(system, rig))
    bpy.data.objects.remove(rig)


def _restructured_armatures(event):
    """Return the edited armatures whose bones are not as they were when the owners were last looked at.

    Blender reports an armature as updated whenever a property of its rig is edited, a setting of Motus included.
    """
    return {armature for armature in _edited_armatures(event) if noticed.bones.get(key(armature)) != _structure(armature)}


def _structure(armature):
    """Return a hash of all of an armature that wiring depends on: names, parents, inheritance and order of its bones.

    It covers how many constraints each bone has in the rigs with the armature too, since Blender's tools copy sinks from bone to bone.
    """
    bones = armature.bones
    rigs_with_it = [obj for obj in bpy.data.objects if obj.data == armature and obj.pose]
    return hash(
        (
            *((bone.name, bone.parent and bone.parent.name, bone.use_connect) for bone in bones),
            *map(rigs.inheritance, bones),
            *(len(bone.constraints) for rig in rigs_with_it for bone in rig.pose.bones),
        )
    )


def _follow_bones(edited, _event):
    noticed.bones.update((key(armature), _structure(armature)) for armature in edited)
    touched = [
        (system, owner) for system, owner in _attached() if system.groups is not None and not edited.isdisjoint(_armatures(system, owner))
    ]
    wired = [attach.refresh_edited(system, owner) for system, owner in touched]
    # A second pass: only now do all systems of an owner know the new names, by which their entries depend on each other.
    for system, owner in touched if any(wired) else ():
        if system.entries is not None:
            attach.refresh_changed(system, owner)


def _armatures(system, owner):
    """Return the armatures of an owner and of all rigs that the owner's solvers read, in a set.

    If the owner, or an object that its solvers read, is not a rig, the set contains that object's data (such as a mesh) instead. This is
    harmless: the caller only asks which armatures are in the set.
    """
    read = [pair[0] for group_key, _ in hub_lookup.carriers_of(system, owner) for pair in waits(system, owner, group_key)]
    return {owner.data, *(obj.data for obj in read if obj)}


# --- Deleted owners, and helpers -----------------------------------------------------------------------------------------------------


def _may_be_deleted(event):
    return event.have_collections_changed


def _always(_event):
    return True


def _remove_soon(_found, _event):
    remains.remove_soon()


def _remove_deleted(_found, _event):
    remains.remove_deleted()


def _put_away(_found, _event):
    helpers.put_away()


# --- Edited actions, overrides, and the order of evaluation --------------------------------------------------------------------------


def _has_readings(event):
    return bool(read_keys.readings) and event.depsgraph is not None


def _call_again(_found, event):
    read_keys.call_again(event.depsgraph)


def _complete_references(_found, _event):
    overrides.complete_references()


def _has_new_marks(_event):
    return overrides.has_new_marks()


def _wire_overrides(_found, _event):
    overrides.forget()
    if native.module is None or not any(obj.override_library and not obj.library for obj in bpy.data.objects):
        return
    helpers.remove_overridden()
    _release_overrides()
    for system, owner in _attached():
        if overrides.is_lost(system, owner) or geometry_sink.is_cut_off(system, owner):
            attach.refresh(system, owner)
            if system.dress is not None:
                system.dress(owner)


def _release_overrides():
    """Remove sinks again that had been removed from library overrides and that reloading the library has brought back."""
    found = [obj for obj in bpy.data.objects if obj.override_library and not obj.library and obj.is_property_set("motus")]
    for obj in found:
        for system in [one for one in systems() if has_settings(one, obj)]:
            settings = of_owner(system, obj)
            if settings.is_released and not settings.is_active:
                release(system, obj)
                overrides.unmark(system, obj)


def _have_relations_changed(event):
    return event.has_updated('OBJECT') and relations.have_changed(event.depsgraph)


def _refresh_order(_found, _event):
    for system, owner in _attached():
        if system.groups is not None:
            attach.refresh_changed(system, owner)


TABLE = (
    Repair(
        "Settings came into the file that an earlier version has saved under other names",
        (LOADED, ARRIVED, *AFTER_EVALUATION),
        _renamed_settings,
        _move_renamed,
        needs_use=False,
    ),
    Repair(
        "Hubs came into the file that the purge of unused data would delete: appended, or made by an earlier version",
        (LOADED, ARRIVED),
        _unprotected,
        _protect_each,
        needs_use=False,
    ),
    Repair("What was linked or appended has drivers of properties that are at rest", AFTER_EVALUATION, _resting, _wake_resting),
    Repair(
        "Settings have become animated, which the owner's outlet cannot wait for, or channels of driven bones driven",
        AFTER_EVALUATION,
        _changed,
        _refresh_changed,
    ),
    Repair(
        "An object was copied or overridden, and its sinks read the hubs or proxies of the first one",
        AFTER_EVALUATION,
        _has_new_objects,
        _part_copies,
    ),
    Repair("An object whose points are moved was given another mesh", AFTER_EVALUATION, _with_other_mesh, _refresh_each),
    Repair("A solver has asked for its system to settle the owner after the evaluation", AFTER_EVALUATION, _unsettled, _settle),
    Repair("A curve was drawn in a node group, or undone", (EDIT, LOADED, ARRIVED), _with_drawn_curves, _take_over, needs_use=False),
    Repair("Objects came into a collection that a solver reads, or left it", AFTER_EVALUATION, _with_other_collection, _refresh_each),
    Repair(
        "A rig was joined into another one: its sinks came along, but not its settings", AFTER_EVALUATION, _grown_armatures, _release_joined
    ),
    Repair(
        "Bones of an owner, or of a rig that it reads, were renamed, removed, or given other parents",
        AFTER_EVALUATION,
        _restructured_armatures,
        _follow_bones,
    ),
    Repair("An owner was deleted, whose helpers go along", AFTER_EVALUATION, _may_be_deleted, _remove_soon),
    Repair("Keys were edited that a solver has read", (EDIT,), _has_readings, _call_again, needs_use=False),
    Repair(
        "Blender takes a group of settings that only an override has for one that it cannot read",
        (LOADED, SAVING),
        _always,
        _complete_references,
        needs_use=False,
    ),
    Repair(
        "Blender has put helpers into the scene, along with what came into the file", (LOADED, ARRIVED), _always, _put_away, needs_use=False
    ),
    Repair(
        "A file was loaded, and Blender has not kept what was wired on its overrides", (LOADED,), _always, _wire_overrides, needs_use=False
    ),
    Repair(
        "A library was loaded again, or an override undone, and Blender has not kept what was wired",
        (EDIT,),
        _has_new_marks,
        _wire_overrides,
        needs_use=False,
    ),
    Repair(
        "An object was given another parent, constraint or driver, by which entries may come to wait for each other",
        (EDIT,),
        _have_relations_changed,
        _refresh_order,
    ),
    Repair("An owner that was deleted would be saved", (SAVING,), _always, _remove_deleted, needs_use=False),
    Repair("Drivers of properties are to be at rest in the file that is saved", (SAVING,), _awake, _rest_each, needs_use=False),
    Repair("Drivers of properties are at rest since the file was saved", (LOADED, SAVED), _asleep, _wake_each, needs_use=False),
)
"""All repairs of changes that Blender does not report to add-ons, in the order in which they are made."""

AT = {moment: tuple(one for one in TABLE if moment in one.moments) for moment in (EDIT, FRAME, LOADED, ARRIVED, SAVING, SAVED)}
"""Moment, such as LOADED or SAVING -> Repairs whose changes are looked for at this moment, in the order in which they are made."""
