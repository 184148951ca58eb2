"""Keep drivers that an artist or a script has made working if they read a system's outputs, and the owner is wired again.

Outputs may move to a different hub or slot. If an output is no longer computed, the driver is made to read a property that does not exist
and that is named after the output. Blender marks the driver as invalid. The driver reads the output again when the output comes back.

The owner is the object whose settings the system solves. Its outputs are numbers in the outbox, an array of results on the mesh of a hidden
object, the hub. The outlet is a custom property of the owner that repeats the outputs. A carrier is a datablock with outputs: the owner
with an outlet, or a hub's mesh.
"""

import re
from typing import NamedTuple

import bpy

from ...blender import drivers
from ...declare import is_owner
from ..hubs import outbox, outputs
from ..sinks import property_sink


class Reader(NamedTuple):
    """A target of a driver variable that reads an output of a system, identified by names so that it is found again later.

    user: datablock with the driver. data_path, array_index: those of the driver's F-curve. variable: name of the variable. index: index of
    the target in the variable. output: name of the output.
    """

    user: bpy.types.ID
    data_path: str
    array_index: int
    variable: str
    index: int  # type: ignore[assignment]  # a tuple has a method of this name
    output: str


def of(system, owner, parts):
    """Return a Reader for each target of a driver variable, anywhere in the file, that reads an output of an owner's system.

    The wiring's own drivers are left out. Drivers that read an output which is no longer computed are included (see absent_path()). If the
    owner is a copy that uses the hub of the object from which it was copied, only the copy's own drivers are taken: other drivers that read
    this hub belong to that object. parts: Parts of the owner.
    """
    carriers = _carriers(system, owner, parts)
    names = {(carrier, key): outputs.output_names(system, carrier, key) for key, carrier, _ in carriers}
    firsts = {carrier: first for _, carrier, first in carriers}
    read = {owner, *firsts}
    borrowed = {part.mesh for part in parts if _is_borrowed(system, owner, part)}
    slot, waiting = outbox.slot_pattern(system), re.compile(rf'\["motus_{system.name}:(.*)"\]$')
    found = []
    for holder, curve, variable, index in drivers.targets_on(read):
        target = variable.targets[index]
        is_outlet = slot.match(f"{curve.data_path}[{curve.array_index}]")
        if variable.name == property_sink.VARIABLE or is_outlet or (target.id in borrowed and holder != owner):
            continue
        at, absent = slot.match(target.data_path), waiting.match(target.data_path)
        output = _output(names, target.id, at, firsts.get(target.id, 0)) if at else absent and bpy.utils.unescape_identifier(absent[1])
        if output is not None:
            found.append(Reader(holder, curve.data_path, curve.array_index, variable.name, index, output))
    return found


def _carriers(system, owner, parts):
    """Return (key of the group, carrier, index of the owner's first slot) for each carrier: datablock with outputs of an owner.

    The carriers are the meshes of the owner's hubs. The owner itself is one if it has an outlet, a custom property that repeats the
    outputs.
    """
    outlet = [("", owner, 0)] if outputs.has_outlet(system, owner) else []
    return outlet + [(part.key, part.mesh, part.first) for part in parts]


def _is_borrowed(system, owner, part):
    """Whether the hub of a Part is in this file and computes for a different owner, such as the one from which this owner was copied."""
    if part.mesh.library or part.mesh.override_library:
        return False
    return isinstance(part.maker, bpy.types.Object) and part.maker != owner and is_owner(system, part.maker)


def absent_path(system, output):
    """Return the data path of a custom property that never exists and is named after an output.

    A driver whose output is no longer computed gets this path. Blender marks the driver as invalid, and the name tells which output the
    driver is to read if the output is computed again.
    """
    return f'["motus_{system.name}:{output}"]'


def _output(names, carrier, slot, first):
    """Return the name of the output in a slot of an outbox; None if the slot holds no output.

    names: {(carrier, key of the group): names of the outputs}; a carrier is a hub's mesh, or the owner with an outlet (custom property that
    repeats the outputs). slot: re.Match of outbox.slot_pattern() for the slot's data path. first: index of the owner's first slot.
    """
    known = names.get((carrier, slot["key"] or ""), ())
    place = int(slot["slot"]) - first - outbox.FIRST_OUTPUT
    return known[place] if 0 <= place < len(known) else None


def point(system, owner, parts, readers):
    """Make the drivers of Readers read their outputs from the present wiring. readers: result of of() for the earlier wiring.

    A driver whose output is no longer computed gets the path of a property that does not exist, absent_path(). parts: present Parts of the
    owner.
    """
    places = {}
    for key, carrier, first in _carriers(system, owner, parts):
        for slot, name in enumerate(outputs.output_names(system, carrier, key), first + outbox.FIRST_OUTPUT):
            places.setdefault(name, (carrier, outbox.out_path(system, slot, key)))
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
