"""Keep users' own drivers that read a system's outputs working when the owner is wired again and its outputs move.

Outputs may move to a different hub or slot. If an output is no longer computed, the driver is made to read a property that does not
exist and that is named after the output: Blender marks the driver as invalid, and it is pointed to the output again when the output
comes back.

The owner is the object whose settings the system solves. Its outputs are numbers in the outbox, an array of results on the mesh of a
hidden object, the hub. The outlet is a custom property of the owner that repeats them. A carrier is a datablock with outputs: the owner
with an outlet, or a hub's mesh.
"""

import re
from typing import NamedTuple

import bpy

from ...blender import drivers
from ...declare import is_owner
from ..hubs import hub_lookup, outbox, outputs
from ..sinks import property_sink
from . import sharing


class Reader(NamedTuple):
    """A target of a driver variable that reads an output of a system, identified by names so that it is found again later.

    user, data_path, array_index: datablock and F-curve of the driver. variable: name of the variable. index: index of the target in the
    variable. output: name of the output.
    """

    user: bpy.types.ID
    data_path: str
    array_index: int
    variable: str
    index: int  # type: ignore[assignment]  # a tuple has a method of this name
    output: str


def of(system, owner):
    """Return the Readers of all outputs that an owner's system computes, or computed when it was last wired (set up).

    If the owner is a copy that uses a hub of its original owner, readers of that hub belong to the original owner, except for the
    copy's own drivers.
    """
    carriers = _carriers(system, owner)
    names = {(carrier, key): outputs.output_names(system, carrier, key) for key, carrier in carriers}
    read = {owner, *(carrier for _, carrier in carriers)}
    borrowed = {carrier for _, carrier in carriers if _is_borrowed(system, owner, carrier)}
    slot, waiting = outbox.slot_pattern(system), re.compile(rf'\["motus_{system.name}:(.*)"\]$')
    found = []
    for holder, curve, variable, index in drivers.targets_on(read):
        target = variable.targets[index]
        is_outlet = slot.match(f"{curve.data_path}[{curve.array_index}]")
        if variable.name == property_sink.VARIABLE or is_outlet or (target.id in borrowed and holder != owner):
            continue
        at, absent = slot.match(target.data_path), waiting.match(target.data_path)
        first = 0 if target.id == owner else hub_lookup.first_slot(system, owner)
        output = _output(names, target.id, at, first) if at else absent and bpy.utils.unescape_identifier(absent[1])
        if output is not None:
            found.append(Reader(holder, curve.data_path, curve.array_index, variable.name, index, output))
    return found


def _carriers(system, owner):
    """Return (key of the group, datablock) for each datablock with outputs: the owner if it has an outlet, then the meshes of its hubs."""
    outlet = [("", owner)] if hub_lookup.has_outlet(system, owner) else []
    return outlet + hub_lookup.carriers_of(system, owner)


def _is_borrowed(system, owner, carrier):
    """Whether a datablock with outputs (carrier) computes for a different owner of this file."""
    if carrier == owner or carrier.library or carrier.override_library:
        return False
    if outbox.is_shared(system, carrier):
        return not sharing.is_own(system, owner, carrier)
    first = carrier.get(outbox.OWNER_KEY)
    return isinstance(first, bpy.types.Object) and first != owner and is_owner(system, first)


def absent_path(system, output):
    """Return the data path, named after an output, of a custom property that never exists."""
    return f'["motus_{system.name}:{output}"]'


def _output(names, carrier, slot, first):
    """Return the name of the output in the slot that a data path names; None if the slot holds no output.

    names: {(carrier, key of the group): names of its outputs}. slot: match of outbox.slot_pattern(). first: index at which the owner's
    slots begin.
    """
    known = names.get((carrier, slot["key"] or ""), ())
    place = int(slot["slot"]) - first - outbox.FIRST_OUTPUT
    return known[place] if 0 <= place < len(known) else None


def point(system, owner, readers):
    """Make the drivers of these Readers read their outputs from the present data paths.

    A driver whose output is no longer computed reads a property that does not exist (see absent_path).
    """
    places = {}
    for key, carrier in _carriers(system, owner):
        for name in outputs.output_names(system, carrier, key):
            path = outputs.output_path(system, name, *(() if carrier == owner and not system.groups else (owner, key)))
            places.setdefault(name, (carrier, path))
    for reader in readers:
        animation = reader.user.animation_data
        curve = animation and animation.drivers.find(reader.data_path, index=reader.array_index)
        variable = curve and curve.driver.variables.get(reader.variable)
        if variable:
            absent = owner, absent_path(system, bpy.utils.escape_identifier(reader.output))
            _let_read(variable, variable.targets[reader.index], *places.get(reader.output, absent))


def _let_read(variable, target, carrier, path):
    if target.id != carrier:
        if variable.type == 'SINGLE_PROP':
            target.id_type = 'MESH' if isinstance(carrier, bpy.types.Mesh) else 'OBJECT'
        target.id = carrier
    target.data_path = path
