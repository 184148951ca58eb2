"""The sink of a property: a driver that lets one number of any datablock be what an output of the group is.

A driver wins over keys, so the property's own value and keys stay where they are. What it is by itself is told by its keys, which are
read below the driver, or else by its value as it was wired, since Blender lets what a driver says reach the original.

In a file the driver is *at rest*: muted, and aimed at a custom property, so that without the add-on the keys animate the
property again. It is put to rest before a file is saved, and woken after that, when the file is loaded, and by the first
solver of what was linked or appended.
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
"""Name of the variable of drivers that are sinks, which the wiring makes anew."""
KEY = "motus_properties"
"""Custom property of a hub's mesh: a Note of each property, as text."""
REST_KEY = "motus_resting"
"""Custom property of a hub's mesh whose drivers are at rest, and of what they are on: they are aimed at it."""
_OF_BONE = re.compile(r'pose\.bones\["((?:[^"\\]|\\.)*)"\]')

_known = keeping.OfProcess("what a hub's mesh notes of driven properties, or Damaged", "the text", most=256)


class Note(NamedTuple):
    """Record of one driven property, stored in the hub.

    slot: index of its value in the outbox, the float array of the solver's results. path, index: as those of a Property.
    base: value of the property without keys.
    """

    slot: int
    path: str
    index: int  # type: ignore[assignment]  # a tuple has a method of this name
    base: float


class Place(NamedTuple):
    """Where a property lies: its datablock, and the animation.Number there."""

    id_data: Any
    data_path: str
    number: Any

    @property
    def driver(self):
        """F-curve of the driver on the property; None if it has no driver."""
        found = self.id_data.animation_data
        return found and found.drivers.find(self.data_path, index=max(self.number.index, 0))


def property_place(obj, path, index=-1):
    """The Place of a property by its path from an object, through datablocks that the object uses. Refuses what is no decimal number."""
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
    """The Place of a property that may be driven; refuses any other."""
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
    """Add drivers to the properties of a group, so that the group's outputs set them; properties that cannot be driven are skipped.

    is_off: store the list of properties in the hub, but add no drivers.
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
    """Yields driver Variables that make the solver wait until Blender has copied the datablocks of a group's driven properties.

    The solver reads the properties' keys from these evaluated copies. It does not wait for the properties themselves: that would be
    a dependency cycle.
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
    """Remove the sinks of these hubs, wherever they are; the properties are what they were."""
    for holder, curve, mesh in _sinks(meshes):
        _restore(system, holder, curve, mesh)
        holder.animation_data.drivers.remove(curve)
        _tidy(holder)


def remove_copies(system, owner, mesh):
    """Remove what a copied owner, or what it uses, has of the sinks of the first one's hub; an override of those of the overridden hub."""
    for order, note in enumerate(_notes_of(mesh)):
        if _object_key(order) in mesh:
            continue
        mine, first = _found(owner, note), _found(mesh.get(outbox.OWNER_KEY), note)
        if mine is None:
            continue
        curve = mine.driver
        is_copy = first is None or first.id_data != mine.id_data or bool(mesh.override_library)
        if curve and mesh == _hub_of(curve) and is_copy:
            _restore(system, mine.id_data, curve, mesh)
            mine.id_data.animation_data.drivers.remove(curve)
            _tidy(mine.id_data)
            if mine.id_data != owner:
                copies.unmark(mine.id_data)  # which it was copied with


def _tidy(holder):
    drivers.drop_empty_animation(holder)
    if not any(_hub_of(curve) for curve in (holder.animation_data.drivers if holder.animation_data else ())):
        holder.pop(REST_KEY, None)
    holder.update_tag()


def _restore(system, holder, curve, mesh):
    """Let a property have its own value again."""
    note = next((one for one in _notes_of(mesh) if _reads(system, curve, one)), None)
    if note is None or curve.data_path == _REST_PATH:
        return
    try:
        channel.number(holder, curve.data_path, note.index).write(note.base)
    except Refused:
        pass  # it is gone


def rest(system, mesh):
    """Put the drivers of a hub to rest."""
    for holder, curve, _ in _sinks([mesh]):
        _restore(system, holder, curve, mesh)
        holder[REST_KEY] = [0.0]
        curve.mute = True
        curve.data_path, curve.array_index = _REST_PATH, 0
    mesh[REST_KEY] = 1


def wake(system, owner, mesh):
    """Let the drivers of a hub act again; linked ones too, in memory. Those that Blender has given an override anew are aimed at its hub."""
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
            notes[order] = note._replace(base=found.number.present)  # which somebody may have edited since
            curve.data_path, curve.array_index, curve.mute = found.data_path, max(note.index, 0), False
            if not found.id_data.library:
                found.id_data.pop(REST_KEY, None)
            found.id_data.update_tag()
    mesh.pop(REST_KEY, None)
    if not mesh.library:
        mesh[KEY] = json.dumps(notes)
    mesh.update_tag()


def is_resting(mesh):
    """Whether the drivers of a hub, original or evaluated, are at rest."""
    return REST_KEY in mesh


def clear(mesh, box):
    """Before a solver is called: let no property be set."""
    for note in _checked(mesh, box):
        box[note.slot] = math.nan


def blend(mesh, owner, box, frame, weight):
    """Lay what the solver has found over the properties' own values. owner: evaluated."""
    for order, note in enumerate(_checked(mesh, box)):
        value = box[note.slot]
        is_set = weight != 0.0 and abs(value) < INFINITE
        if weight == 1.0 and is_set:
            continue
        own = _own(mesh.get(_object_key(order), owner), note, frame)
        box[note.slot] = own + weight * (value - own) if is_set else own


def blend_none(system, key, mesh, frame):
    """Let the properties of a hub that was not solved be what they are by themselves, as far as the hub still tells."""
    box = stored.doubles(mesh.get(outbox.out_key(system, key)))
    blend(mesh, mesh.get(outbox.OWNER_KEY), box, frame, 0.0)


def _own(obj, note, frame):
    """What a property is by its keys alone; its value where keys do not tell it."""
    found = _found(obj, note)
    if found:
        keys = channel.Channel(found.id_data, found.data_path, note.index, is_beneath_driver=True)
        if keys.reason is None and not keys.is_constant:
            return float(keys.values([frame])[0])
    return note.base


def driven_properties(system, owner):
    """(object, function that gives the Place from it, or from its evaluated copy) of all properties that an owner drives now."""
    for _, mesh in hub_lookup.carriers_of(system, owner):
        for order, note in enumerate(_notes_of(mesh)):
            obj = mesh.get(_object_key(order), owner)
            found = _found(obj, note)
            if found and found.driver and _hub_of(found.driver) == mesh and _reads(system, found.driver, note):
                yield obj, functools.partial(property_place, path=note.path, index=note.index)


def are_driven(system, owner, mesh):
    """Whether all properties of a hub are there and have their drivers."""
    for order, note in enumerate(_notes_of(mesh)):
        found = _found(mesh.get(_object_key(order), owner), note)
        if found is None or not found.driver or _hub_of(found.driver) != mesh or not _reads(system, found.driver, note):
            return False
    return True


def renamed_bones(system, owner):
    """(old name, new name) of bones whose properties an owner drives: Blender has renamed them in the drivers' own paths."""
    found = {}
    for _, mesh in hub_lookup.carriers_of(system, owner):
        for holder, curve, _ in _sinks([mesh]):
            note = next((one for one in _notes_of(mesh) if _reads(system, curve, one)), None)
            old, new = note and _OF_BONE.match(note.path), _OF_BONE.match(curve.data_path)
            if holder == owner and old and new and old[1] != new[1]:
                found[bpy.utils.unescape_identifier(old[1])] = bpy.utils.unescape_identifier(new[1])
    return list(found.items())


def is_foreign(mesh):
    """Whether a hub drives properties by way of objects that are not its owner."""
    return any(_object_key(order) in mesh for order, _ in enumerate(_notes_of(mesh)))


def _checked(mesh, box):
    for note in _notes(mesh):
        if not outbox.FIRST_OUTPUT <= note.slot < len(box):
            raise stored.Damaged("no such output")
        yield note


def _parsed(text):
    try:
        said = stored.parse(text, [(int, str, lambda value: type(value) is int and -1 <= value < 32, float)])
    except stored.Damaged:
        return stored.Damaged
    return tuple(Note(*one) for one in said)


def _notes(mesh):
    """The Notes of a hub's mesh. Raises Damaged where they are not what add() makes."""
    text = mesh.get(KEY)
    if text is None:
        return ()
    found = _known.made(text, lambda: _parsed(text)) if isinstance(text, str) else stored.Damaged
    if found is stored.Damaged:
        raise found("no properties")
    return found


def _notes_of(mesh):
    """The Notes of a hub's mesh; none if they are damaged."""
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
    """(datablock, driver, hub's mesh) of all sinks of these hubs."""
    with_notes = {mesh for mesh in meshes if KEY in mesh}
    found = drivers.targets_on(with_notes) if with_notes else ()
    return [(holder, curve, variable.targets[0].id) for holder, curve, variable, _ in found if variable.name == VARIABLE]


def _hub_of(curve):
    """The hub's mesh that a sink reads; None of any other driver."""
    for variable in curve.driver.variables:
        if variable.name == VARIABLE and variable.type == 'SINGLE_PROP':
            hub = variable.targets[0].id
            return hub if isinstance(hub, bpy.types.Mesh) and KEY in hub else None
    return None


def _is_of(curve, owner, mesh):
    """Whether a sink is a hub's, or was the hub's of the library's object that its owner overrides."""
    hub = _hub_of(curve)
    if hub is None or hub == mesh:
        return hub is not None
    override = owner.override_library
    return override is not None and not owner.library and hub.get(outbox.OWNER_KEY) in (owner, override.reference)


def _reads(system, curve, note):
    """Whether a sink reads the slot of a note."""
    found = outbox.slot_pattern(system).match(curve.driver.variables[VARIABLE].targets[0].data_path)
    return found is not None and int(found["slot"]) == note.slot


def _object_key(order):
    return f"motus_property_{order}"


_REST_PATH = f'["{REST_KEY}"]'
