"""Wires owners again where somebody has changed what Motus cannot be told of.

- Settings have become animated, which the owner's outlet cannot wait for, or channels of driven bones driven.
- An object was copied or overridden, and its sinks read the hubs or proxies of the first one.
- A file was loaded, or a library again, and Blender has not kept what was wired on an override (see overrides).
- An object was given another parent, constraint or driver, by which entries may come to wait for each other.
- The bones of an armature, the owner's or one that it reads, were renamed, removed, or given other parents.
- A rig was joined into another one: its sinks come along, but not its settings. They are removed.
- An object whose points are moved was given another mesh, or its system asks for a word after the evaluation.
- Objects came into a collection that a solver reads, or left it.
- An owner was deleted: its helpers go along.
- Helpers were put into the scene by Blender, along with what was appended or pasted.

Solvers and Blender's handlers notice; the wiring is done when Blender has finished the evaluation, which it then does once
more. Each happens once, and its result is the same whoever evaluates first.
"""

import logging

import bpy
from bpy.app.handlers import persistent

from ... import native
from ...blender import handlers, helpers
from ...declare import has_settings, is_owner, leader_of, of_owner, registered, systems
from ...evaluated import copies, read_keys
from ...file import deleted
from ...measures.handedness import is_mirrored
from ..attaching import attach, overrides, sharing, signature, waiting
from ..attaching.solver_driver import waits
from ..hubs import hub_lookup, outbox
from ..sinks import geometry_sink, property_sink, proxy_sink
from ..sinks.finding import has_sinks, makers, release
from . import relations, remains

log = logging.getLogger(__name__)

_in_use = [False]
"""Whether any solver was called since the file was opened. Until then there is nothing of Motus in it that could need help."""
_evaluations = [0]
"""How many have ended since a solver was called."""
_asked = set()
# Owners by their names, those of this file: what is linked is wired in its own.
_seen = {}
"""(system, owner) -> what check() saw of the owner when it was last looked through."""
_object_count = [-1]
"""How many objects the file had when they were last looked through."""
_orphans = set()
"""Names of hubs without an owner that were seen."""
_bone_counts = {}
"""key of an armature -> how many bones it had when the rigs with it were last looked through."""
_watched = set()
"""(system, owner) whose points are moved."""
_gathering = set()
"""(system, owner) whose solvers read objects that come and go with collections."""
_rows = {}
"""(system, hub that owners share) -> its rows."""
_unsettled = set()
"""(system, owner) that have asked to settle."""
_resting = set()
"""(system, name and library of a hub's mesh) whose drivers of properties are at rest."""
_given_up = set()
"""(system, owner) that could not be given carriers of their own."""


def note_use():
    """Called by every solver."""
    _in_use[0] = True


def note_state(place, state):
    """Called by an owner's solver, or after the evaluation if owners share one, with what tells changes.

    place: (system's name, owner's name). state: (number of the owner's drivers, whether animation moves settings that count).
    """
    if _seen.get(place) != state:
        _seen[place] = state
        _asked.add(place)


def note_properties(hub):
    """Called by the solver with an evaluated hub's mesh that drives properties."""
    if property_sink.is_resting(hub):
        _resting.add(_key(hub))


def watch_rows(system, name, found):
    """Called by the solver of a hub that owners share, with the name of its mesh and the rows that it has."""
    _rows[system.name, name] = found


def note_orphan(hub):
    """Called by the solver with an evaluated hub's mesh that has no owner any more: copies of that may hang on it."""
    if hub.name not in _orphans:
        _orphans.add(hub.name)
        _object_count[0] = -1


def watch(place):
    """Called by the solver with the names of the system and the owner whose points it moves."""
    _watched.add(place)


def watch_collections(place):
    """Called by the solver with the names of the system and the owner for which it reads what a collection holds."""
    _gathering.add(place)


def evaluation():
    """A number that is the same for all solvers of one evaluation, and another one for the next in the viewport."""
    return _evaluations[0]


def ask_to_settle(system, owner):
    """Have System.settle called with the original of an evaluated owner, after the evaluation."""
    if not owner.library:
        _unsettled.add((system.name, owner.name))


@persistent
def _heal_after_frame(_scene=None, depsgraph=None):
    _heal(depsgraph=depsgraph, is_edit=False)


@persistent
def _heal(_scene=None, depsgraph=None, is_edit=True):
    if not _in_use[0]:
        return
    _evaluations[0] += 1
    if bpy.app.is_job_running('RENDER'):
        return
    _try(lambda: _heal_all(depsgraph, is_edit))


def _heal_all(depsgraph, is_edit):
    while _resting:
        _wake(_mesh(_resting.pop()))
    if depsgraph is not None:
        _check_rows(depsgraph, is_edit)
    _heal_asked()
    # To count the objects takes 0.1 ms where there are 5000. What is new stands in a collection, or it is not evaluated.
    if is_edit or depsgraph is None or _object_count[0] < 0 or deleted.have_collections_changed(depsgraph):
        _heal_copies()
    _heal_meshes()
    if _gathering and depsgraph is not None and deleted.have_collections_changed(depsgraph):
        _heal_gathered()
    if depsgraph is not None and depsgraph.id_type_updated('ARMATURE'):
        _heal_edited(depsgraph)
    if depsgraph is not None and deleted.have_collections_changed(depsgraph):
        remains.remove_soon()


def _try(heal):
    try:
        heal()
    except Exception:
        # A handler that raises would say so after every change.
        log.exception("Motus: something that was copied, edited or loaded could not be wired again")


def _check_rows(depsgraph, is_edit):
    """Look whether owners that share a hub may go on to.

    They may not if settings, which the hub's solver does not read, have become animated, or if scales have come to mirror an
    owner, which is looked at after an edit.
    """
    for place, found in list(_rows.items()):
        name, _ = place
        for owner_name in [row.name for row in found if isinstance(row, sharing.Row)]:
            owner = bpy.data.objects.get((owner_name, None))
            if owner is None:  # it has another name now, or is gone: all rows are looked through
                _rows.pop(place, None)
                _object_count[0] = -1
                continue
            if is_edit and is_mirrored(owner):
                _asked.add((name, owner_name))
            animation, seen = owner.animation_data, _seen.get((name, owner_name))
            if animation and (animation.action or animation.nla_tracks or seen is None or seen[0] != len(animation.drivers)):
                evaluated = owner.evaluated_get(depsgraph)
                moves = bool(registered[name].outputs) and copies.has_moving_settings(evaluated)
                note_state((name, owner_name), (copies.drivers_on(evaluated), moves))


def _heal_asked():
    while _asked:
        system, owner = _find(*_asked.pop())
        if owner is not None:
            attach.refresh_changed(system, owner)


def _heal_meshes():
    for place in list(_watched):
        system, owner = _find(*place)
        if owner is None:
            _watched.discard(place)
        elif geometry_sink.is_stale(system, owner):
            attach.refresh(system, owner)
    while _unsettled:
        system, owner = _find(*_unsettled.pop())
        if owner is not None:
            system.settle(owner)


def _heal_gathered():
    for place in list(_gathering):
        system, owner = _find(*place)
        if owner is None:
            _gathering.discard(place)
        elif waiting.is_stale(system, of_owner(system, owner)):
            attach.refresh(system, owner)


def _find(name, owner_name):
    """The system and the owner of these names; (None, None) where they are not there or not wired in this file."""
    system, owner = registered.get(name), bpy.data.objects.get((owner_name, None))
    if not system or not owner or not is_owner(system, owner):
        return None, None
    return system, owner


def _heal_copies():
    count = len(bpy.data.objects)
    if count == _object_count[0]:
        return
    helpers.put_away()
    relations.look()
    for system in systems():
        sharing.tidy(system)
    attached = _attached()
    deleted.watch(dict.fromkeys(owner for _, owner in attached))
    for system, owner in attached:
        place = system.name, owner.name
        if place in _given_up or not signature.has_strange_carriers(system, owner):
            continue
        attach.refresh(system, owner)
        if signature.has_strange_carriers(system, owner):
            _given_up.add(place)
    _object_count[0] = len(bpy.data.objects)


def _attached():
    """(system, owner) of all that is wired in this file."""
    owners = [obj for obj in bpy.data.objects if not obj.library and obj.is_property_set("motus")]
    return [(system, owner) for owner in owners for system in systems() if is_owner(system, owner)]


def _heal_overrides():
    overrides.forget()
    if native.module is None or not any(obj.override_library and not obj.library for obj in bpy.data.objects):
        return
    _release_overrides()
    for system, owner in _attached():
        if overrides.is_lost(system, owner) or geometry_sink.is_cut_off(system, owner):
            attach.refresh(system, owner)
            if system.dress is not None:
                system.dress(owner)


def _release_overrides():
    """Take off overrides again what was taken off them, and came back from their library."""
    found = [obj for obj in bpy.data.objects if obj.override_library and not obj.library and obj.is_property_set("motus")]
    for obj in found:
        for system in [one for one in systems() if has_settings(one, obj)]:
            settings = of_owner(system, obj)
            if settings.is_released and not settings.is_active:
                release(system, obj)
                overrides.unmark(system, obj)


def _heal_edited(depsgraph):
    edited = [
        copies.original_of(update.id, bpy.data.armatures, depsgraph)
        for update in depsgraph.updates
        if isinstance(update.id, bpy.types.Armature)
    ]
    edited = {armature for armature in edited if armature is not None and not armature.is_editmode}  # type: ignore[assignment]
    _heal_joined({armature for armature in edited if _bone_counts.get(_key(armature)) != len(armature.bones)})
    touched = [
        (system, owner)
        for system, owner in (_attached() if edited else ())
        if system.groups is not None and not edited.isdisjoint(_armatures(system, owner))
    ]
    for system, owner in touched:
        attach.refresh_edited(system, owner)
    # Once more, now that all of an owner's systems know the names: by them their entries wait for each other.
    for system, owner in touched:
        if system.entries is not None:
            attach.refresh_changed(system, owner)


def _heal_joined(grown):
    if not grown:
        return
    _bone_counts.update((_key(armature), len(armature.bones)) for armature in grown)
    # What is released takes objects out of the file, which Blender must not be going through then.
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
    """Remove a rig that was joined into another one, but is kept alive by its hubs and proxies, and they by it."""
    for system in systems():
        for hub in [hub for _, hub in hub_lookup.hubs(system, rig) if hub_lookup.is_own_hub(hub, rig)]:
            bpy.data.meshes.remove(hub.data)
        proxy_sink.release(of_owner(system, rig))
    bpy.data.objects.remove(rig)


def _key(datablock):
    """What tells a datablock from others of its kind, linked ones of the same name among them."""
    return datablock.name, datablock.library and datablock.library.name


def _armatures(system, owner):
    """The data of the owner and of all objects that it reads."""
    read = [pair[0] for key, _ in hub_lookup.carriers(system, owner) for pair in waits(system, owner, key)]
    return {owner.data, *(obj.data for obj in read if obj)}


def _mesh(key):
    return next((mesh for mesh in bpy.data.meshes if _key(mesh) == key), None)


def _wake(mesh):
    owner = mesh and mesh.get(outbox.OWNER_KEY)
    for system in systems() if isinstance(owner, bpy.types.Object) else ():
        if outbox.key_on_hub(system, mesh) is not None:
            property_sink.wake(system, owner, mesh)


@persistent
def _wake_all(*_):
    """After a file was loaded or saved: let drivers of properties act."""
    for mesh in bpy.data.meshes if native.module is not None else ():
        if property_sink.KEY in mesh and property_sink.is_resting(mesh):
            _try(lambda mesh=mesh: _wake(mesh))


@persistent
def _rest_all(*_):
    """Before a file is saved: let keys animate the properties."""
    for mesh in bpy.data.meshes:
        if property_sink.KEY in mesh and not mesh.library:
            for system in systems():
                if outbox.key_on_hub(system, mesh) is not None:
                    property_sink.rest(system, mesh)


@persistent
def _forget(*_):
    _in_use[0] = False
    _asked.clear()
    _seen.clear()
    _orphans.clear()
    _bone_counts.clear()
    _watched.clear()
    _gathering.clear()
    _rows.clear()
    _unsettled.clear()
    _resting.clear()
    _given_up.clear()
    overrides.forget()
    relations.forget()
    _object_count[0] = -1


@persistent
def loaded(*_):
    """Before the first evaluation of a file."""
    _forget()
    _try(lambda: (overrides.complete_references(), helpers.put_away(), _heal_overrides()))
    _wake_all()


@persistent
def _remove_deleted(*_):
    _try(remains.remove_deleted)


@persistent
def _put_away(*_):
    # After undo the scene may be as it was when Blender had just put helpers there.
    _try(helpers.put_away)


@persistent
def _updated(_scene=None, depsgraph=None):
    # Not after every change of the frame: neither what Blender keeps of an override nor what an object hangs on changes then.
    if not (_in_use[0] or read_keys.readings or overrides.has_marks()) or bpy.app.is_job_running('RENDER'):
        return
    if read_keys.readings and depsgraph is not None:
        _try(lambda: read_keys.call_again(depsgraph))
    if overrides.has_new_marks():
        _try(_heal_overrides)
    if _in_use[0] and depsgraph is not None and depsgraph.id_type_updated('OBJECT'):
        _try(lambda: _heal_order(depsgraph))


def _heal_order(depsgraph):
    if not relations.have_changed(depsgraph):
        return
    for system, owner in _attached():
        if system.groups is not None:
            attach.refresh_changed(system, owner)


def _watched_handlers():
    found = bpy.app.handlers
    arriving = found.undo_post, found.redo_post, getattr(found, "blend_import_post", None)
    return (
        *((functions, _put_away) for functions in arriving if functions is not None),
        (found.depsgraph_update_post, _heal),
        (found.frame_change_post, _heal_after_frame),
        (found.depsgraph_update_post, _updated),
        (found.load_post, loaded),
        (found.save_pre, overrides.complete_references),
        (found.save_pre, _remove_deleted),
        (found.save_pre, _rest_all),
        (found.save_post, _wake_all),
        *((functions, _wake_all) for functions in (getattr(found, "save_post_fail", None),) if functions is not None),
    )


def register():
    """Watch for what was noticed."""
    handlers.add(_watched_handlers())


def unregister():
    """Stop watching."""
    handlers.remove(_watched_handlers())
    remains.stop()
    _forget()
