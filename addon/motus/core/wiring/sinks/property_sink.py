"""Drivers as sinks of properties: each sets one number of any datablock to an output of a solver.

A driver takes precedence over keyframes, so the property's own value and keyframes are kept. The own value of the property, which the
influence blends with the output, is computed from its keyframes. If it has no keyframes, it is the value that the property had when it
was wired, because Blender also writes a driver's result to the original.

In a file the driver is *at rest*: muted, and its data path is that of a placeholder custom property. A Blender without the add-on then
animates the property by its keyframes. Drivers are put to rest before a file is saved. They are woken after saving, after loading, and
by the first call of the solver if they were linked or appended.

The owner is the object whose settings are solved. Its hub is a hidden object whose mesh has the outbox, the array with the solver's
results.
"""

import functools
import json
import math
import re
from typing import Any, NamedTuple

import bpy

from ... import keeping
from ...animation import channel
from ...blender import datablocks, drivers
from ...declare import Variable
from ...evaluated import copies
from ...file import stored
from ...refusals import INFINITE, Refused, check_local
from ...translations import tr
from ..hubs import hub_lookup, outbox

VARIABLE = "motus"
"""Name of the variable in drivers that are sinks. When an owner is wired again, these drivers are removed and added again."""
KEY = "motus_properties"
"""Custom property of a hub's mesh: the Notes of all properties that the hub's solver drives, as text."""
REST_KEY = "motus_resting"
"""Custom property of a hub's mesh whose property drivers are at rest (muted), and of the datablocks with these drivers.

On these datablocks it is the placeholder that the drivers at rest drive instead of their own properties.
"""
_OF_BONE = re.compile(r'pose\.bones\["((?:[^"\\]|\\.)*)"\]')

_known = keeping.OfProcess("parsed lists of driven properties, stored on hubs' meshes (Note), or Damaged", "text of the list", most=256)


class Note(NamedTuple):
    """Record of one driven property, stored as text on the hub's mesh.

    slot: index of the property's value in the outbox, the float array of the solver's results. path: data path of the property from its
    object. index: index of the array's item, -1 if the property is no array. base: own value of the property, which applies if it has no
    keyframes.
    """

    slot: int
    path: str
    index: int  # type: ignore[assignment]  # a tuple has a method of this name
    base: float


class Place(NamedTuple):
    """Where a property is.

    id_data: its datablock. data_path: its path from the datablock. number: animation.channel.Number, the description of the float, or of
    the item of a float array, that is animated.
    """

    id_data: Any
    data_path: str
    number: Any

    @property
    def driver(self):
        """F-curve of the driver on the property; None if the property has no driver."""
        found = self.id_data.animation_data
        return found and found.drivers.find(self.data_path, index=max(self.number.index, 0))


def property_place(obj, path, index=-1):
    """Return the Place of a property, given by its data path from an object; the path may lead through datablocks that the object uses.

    index: index of the array's item; -1 if the property is no array. Raises Refused if there is no such property or if it is not of type
    FLOAT.
    """
    try:
        found = obj.path_resolve(path, False)
        id_data, data_path = found.id_data, found.path_from_id()
    except (AttributeError, ValueError):
        raise Refused(tr("{object} has no number {path}").format(object=obj.name, path=path)) from None
    number = channel.number(id_data, data_path, index)
    if number.type != 'FLOAT':
        raise Refused(tr("{path} of {object} is no decimal number").format(object=id_data.name, path=data_path))
    return Place(id_data, data_path, number)


def check_property(obj, path, index=-1):
    """Return the Place of a property that may be driven.

    Raises Refused if there is no such float property, if its datablock is linked, or if the property has a driver or cannot be animated.
    """
    found = property_place(obj, path, index)
    check_local(found.id_data)
    declared = found.number.holder.bl_rna.properties.get(found.number.name)
    if declared and not declared.is_animatable:
        raise Refused(tr("{path} is no number that can be driven").format(path=found.data_path))
    if found.driver:
        raise Refused(
            tr("{path} of {object} has a driver already: remove it first").format(object=found.id_data.name, path=found.data_path)
        )
    return found


def add(system, owner, group, hub, is_off=False):
    """Add drivers to the properties of a group, so that the group's outputs set the properties.

    Properties that cannot be driven are skipped. hub: hub object, whose mesh gets the list of the properties. is_off: store the list, but
    add no drivers.
    """
    if not group.properties:
        return
    notes = []
    for order, one in enumerate(group.properties):
        slot = outbox.FIRST_OUTPUT + group.outputs.index(one.output)
        base = 0.0
        if one.object != owner:
            hub.data[_object_key(order)] = one.object
        try:
            found = check_property(one.object, one.path, one.index)
        except Refused:
            pass
        else:
            base = found.number.present
            if not is_off:
                _drive(system, group, found, hub.data, slot)
        hub.data[outbox.out_key(system, group.key)][slot] = base
        notes.append(Note(slot, one.path, one.index, base))
    hub.data[KEY] = json.dumps(notes)
    hub.data.pop(REST_KEY, None)


def _drive(system, group, found, mesh, slot):
    source = Variable('MESH', mesh, outbox.out_path(system, slot, group.key))
    index = found.number.index
    drivers.copy_value(found.id_data, found.data_path, source, None if index < 0 else index, VARIABLE)
    found.id_data.update_tag()


def waits(group):
    """Yield driver Variables that make the solver wait until Blender has copied the datablocks of a group's driven properties.

    The solver reads the properties' keyframes from these evaluated copies. The Variables do not read the driven properties: that would be a
    dependency cycle.
    """
    for id_data in dict.fromkeys(_datablocks(group)):
        copies.mark(id_data)
        holder, path = datablocks.named_by(id_data, f'["{copies.KEY}"][0]')
        yield Variable(datablocks.id_type(holder), holder, path.replace(".[", "["))


def _datablocks(group):
    for one in group.properties:
        try:
            yield check_property(one.object, one.path, one.index).id_data
        except Refused:
            continue


def remove(system, meshes):
    """Remove the drivers that read the hubs with these meshes from all properties, and set the properties to their own values.

    Returns whether there were any.
    """
    found = _sinks(meshes)
    for holder, curve, mesh in found:
        _restore(system, holder, curve, mesh)
        holder.animation_data.drivers.remove(curve)
        _tidy(holder)
    return bool(found)


def remove_copies(system, owner, groups, mesh):
    """Remove drivers that read the hub of a different owner and that were copied with this owner or with datablocks that it drives.

    If the owner is a library override, its drivers that read the overridden hub are removed. groups: Groups of this owner. mesh: mesh of
    that hub, whose own owner keeps its drivers.
    """
    notes = _notes_of(mesh)
    of_first = [_found(mesh.get(_object_key(order), mesh.get(outbox.OWNER_KEY)), note) for order, note in enumerate(notes)]
    kept = set() if mesh.override_library else {place.id_data for place in of_first if place}
    own = [(owner, note) for order, note in enumerate(notes) if _object_key(order) not in mesh]
    others = [(one.object, one) for group in groups for one in group.properties if one.object != owner]
    for obj, path_and_index in (*own, *others):
        mine = _found(obj, path_and_index)
        curve = mine and mine.driver
        if curve and mesh == _hub_of(curve) and mine.id_data not in kept:
            _restore(system, mine.id_data, curve, mesh)
            mine.id_data.animation_data.drivers.remove(curve)
            _tidy(mine.id_data)
            if mine.id_data != owner:
                copies.unmark(mine.id_data)  # the marker of the datablock was copied with it


def _tidy(holder):
    drivers.drop_empty_animation(holder)
    if not any(_hub_of(curve) for curve in (holder.animation_data.drivers if holder.animation_data else ())):
        holder.pop(REST_KEY, None)
    holder.update_tag()


def _restore(system, holder, curve, mesh):
    """Set a driven property back to the value that it had before it was driven, which the Note on the hub's mesh holds.

    Nothing happens if the driver has been pointed to a placeholder custom property, since the driven property then has that value already.
    holder: datablock of the property. curve: F-curve of the driver. mesh: mesh of the hub that the driver reads.
    """
    note = next((one for one in _notes_of(mesh) if _reads(system, curve, one)), None)
    if note is None or curve.data_path == _REST_PATH:
        return
    try:
        channel.number(holder, curve.data_path, note.index).write(note.base)
    except Refused:
        pass  # the property is gone


def rest(system, mesh):
    """Put all property drivers that read a hub to rest: mute them, and let them drive a placeholder custom property.

    mesh: mesh of the hub.
    """
    for holder, curve, _ in _sinks([mesh]):
        _restore(system, holder, curve, mesh)
        holder[REST_KEY] = [0.0]
        curve.mute = True
        curve.data_path, curve.array_index = _REST_PATH, 0
    mesh[REST_KEY] = 1


def wake(system, owner, mesh):
    """Unmute all property drivers at rest (muted, driving a placeholder) that read a hub, and let them drive their properties again.

    Linked drivers are changed in memory only. Drivers that Blender has copied from a library to its override are made to read the
    override's hub. mesh: mesh of the hub.
    """
    notes = list(_notes_of(mesh))
    for order, note in enumerate(notes):
        found = _found(mesh.get(_object_key(order), owner), note)
        resting = [
            curve
            for curve in (found.id_data.animation_data.drivers if found and found.id_data.animation_data else ())
            if curve.data_path == _REST_PATH and _is_of(curve, owner, mesh) and _reads(system, curve, note)
        ]
        for curve in resting:
            if _hub_of(curve) != mesh:
                curve.driver.variables[VARIABLE].targets[0].id = mesh
            notes[order] = note._replace(base=found.number.present)  # the value may have been edited while the driver was muted
            curve.data_path, curve.array_index, curve.mute = found.data_path, max(note.index, 0), False
            if not found.id_data.library:
                found.id_data.pop(REST_KEY, None)
            found.id_data.update_tag()
    mesh.pop(REST_KEY, None)
    if not mesh.library:
        mesh[KEY] = json.dumps(notes)
    mesh.update_tag()


def is_resting(mesh):
    """Whether the property drivers that read a hub are at rest: muted, and driving a placeholder custom property.

    mesh: the hub's mesh, original or evaluated.
    """
    return REST_KEY in mesh


def checked(mesh, box):
    """Return the Notes of all properties that a hub drives, as a tuple. Raises Damaged if they do not fit the outbox.

    mesh: mesh of the hub. box: numbers of the outbox.
    """
    found = _notes(mesh)
    if not all(outbox.FIRST_OUTPUT <= note.slot < len(box) for note in found):
        raise stored.Damaged("no such output")
    return found


def clear(notes, box):
    """Set the outputs of all driven properties to NaN, which means "do not set"; called before the solver.

    notes: result of checked(). box: numbers of the outbox.
    """
    for note in notes:
        box[note.slot] = math.nan


def blend(notes, mesh, owner, box, frame, weight):
    """Replace the output of each driven property by a blend of the property's own value and the output.

    weight: share of the output, 0 to 1. If an output is NaN or infinite, the own value replaces the output. notes: result of checked().
    mesh: mesh of the hub. owner: evaluated owner. box: numbers of the outbox.
    """
    for order, note in enumerate(notes):
        value = box[note.slot]
        is_set = weight != 0.0 and abs(value) < INFINITE
        if weight == 1.0 and is_set:
            continue
        own = _own(mesh.get(_object_key(order), owner), note, frame)
        box[note.slot] = own + weight * (value - own) if is_set else own


def blend_none(system, key, mesh, frame):
    """Set the outputs of all driven properties to the properties' own values; called when the hub's solver could not compute.

    key: key of the group. Raises Damaged if the data on the hub's mesh cannot be read.
    """
    box = stored.doubles(mesh.get(outbox.out_key(system, key)))
    blend(checked(mesh, box), mesh, mesh.get(outbox.OWNER_KEY), box, frame, 0.0)


def _own(obj, note, frame):
    """Return the own value of a driven property: that of its keyframes at the frame, or Note.base if there are no usable keyframes.

    obj: object from which the path in the Note starts.
    """
    found = _found(obj, note)
    if found:
        keys = channel.Channel(found.id_data, found.data_path, note.index, is_beneath_driver=True)
        if keys.reason is None and not keys.is_constant:
            return float(keys.values([frame])[0])
    return note.base


def driven_properties(system, owner):
    """Yield (object, function) for each property that an owner drives now.

    The function, called with the object or its evaluated copy, returns the Place of the property.
    """
    for _, mesh in hub_lookup.carriers_of(system, owner):
        for order, note in enumerate(_notes_of(mesh)):
            obj = mesh.get(_object_key(order), owner)
            found = _found(obj, note)
            if found and found.driver and _hub_of(found.driver) == mesh and _reads(system, found.driver, note):
                yield obj, functools.partial(property_place, path=note.path, index=note.index)


def are_driven(system, owner, mesh):
    """Whether all properties that a hub is to drive exist and have their drivers. mesh: mesh of the hub."""
    for order, note in enumerate(_notes_of(mesh)):
        found = _found(mesh.get(_object_key(order), owner), note)
        if found is None or not found.driver or _hub_of(found.driver) != mesh or not _reads(system, found.driver, note):
            return False
    return True


def renamed_bones(system, owner):
    """Return (old name, new name) for each renamed bone of an owner if the owner drives properties of the bone.

    Blender has updated the name in the data paths of the drivers. The Notes on the hub's mesh have the old name.
    """
    found = {}
    for _, mesh in hub_lookup.carriers_of(system, owner):
        for holder, curve, _ in _sinks([mesh]):
            note = next((one for one in _notes_of(mesh) if _reads(system, curve, one)), None)
            old, new = note and _OF_BONE.match(note.path), _OF_BONE.match(curve.data_path)
            if holder == owner and old and new and old[1] != new[1]:
                found[bpy.utils.unescape_identifier(old[1])] = bpy.utils.unescape_identifier(new[1])
    return list(found.items())


def is_foreign(mesh):
    """Whether a hub drives properties whose data paths start from objects different from the owner. mesh: mesh of the hub."""
    return any(_object_key(order) in mesh for order, _ in enumerate(_notes_of(mesh)))


def _parsed(text):
    try:
        said = stored.parse(text, [(int, str, lambda value: type(value) is int and -1 <= value < 32, float)])
    except stored.Damaged:
        return stored.Damaged
    return tuple(Note(*one) for one in said)


def _notes(mesh):
    """Return the Notes of all properties that a hub drives, parsed from the text on the hub's mesh.

    A Note says which property is driven, and its own value. Raises Damaged if the text does not have the form in which add() writes it.
    """
    text = mesh.get(KEY)
    if text is None:
        return ()
    found = _known.made(text, lambda: _parsed(text)) if isinstance(text, str) else stored.Damaged
    if found is stored.Damaged:
        raise found("no properties")
    return found


def _notes_of(mesh):
    """Return the Notes of all properties that a hub's mesh drives, as a tuple; it is empty if the Notes are damaged."""
    try:
        return _notes(mesh)
    except stored.Damaged:
        return ()


def _found(obj, note):
    try:
        return property_place(obj, note.path, note.index) if isinstance(obj, bpy.types.Object) else None
    except Refused:
        return None


def _sinks(meshes):
    """Return (datablock, F-curve of the driver, mesh of the hub) for each property driver that reads the hub of one of these meshes."""
    with_notes = {mesh for mesh in meshes if KEY in mesh}
    found = drivers.targets_on(with_notes) if with_notes else ()
    return [(holder, curve, variable.targets[0].id) for holder, curve, variable, _ in found if variable.name == VARIABLE]


def _hub_of(curve):
    """Return the mesh of the hub that a property driver reads; None if the driver is no sink."""
    for variable in curve.driver.variables:
        if variable.name == VARIABLE and variable.type == 'SINGLE_PROP':
            hub = variable.targets[0].id
            return hub if isinstance(hub, bpy.types.Mesh) and KEY in hub else None
    return None


def _is_of(curve, owner, mesh):
    """Whether a property driver reads this hub's mesh, or, if the owner is a library override, the hub of the library's object.

    curve: F-curve of the driver. mesh: mesh of the hub.
    """
    hub = _hub_of(curve)
    if hub is None or hub == mesh:
        return hub is not None
    override = owner.override_library
    return override is not None and not owner.library and hub.get(outbox.OWNER_KEY) in (owner, override.reference)


def _reads(system, curve, note):
    """Whether a property driver reads the outbox slot whose index is Note.slot. curve: F-curve of the driver."""
    found = outbox.slot_pattern(system).match(curve.driver.variables[VARIABLE].targets[0].data_path)
    return found is not None and int(found["slot"]) == note.slot


def _object_key(order):
    return f"motus_property_{order}"


_REST_PATH = f'["{REST_KEY}"]'
