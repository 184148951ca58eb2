"""Users' own drivers that read a system's outputs: when the outbox moves, as to a hub or to another slot, they go along.

One whose output is no longer computed reads a property that is not there, named after the output: Blender marks such a
driver, and it is found again when the output comes back.
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
    """A target of a driver's variable, found again by what it is on. output: name of what it reads."""

    user: bpy.types.ID
    data_path: str
    array_index: int
    variable: str
    index: int  # type: ignore[assignment]  # a tuple has a method of this name
    output: str


def of(system, owner):
    """The Readers of what an owner's system computes, as it is wired now or was last.

    Those of a hub that computes for another owner, of which this one is a copy, are that owner's, but for the copy's own drivers.
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
    """What outputs can be read from, by the groups' keys: the owner's outlet before the hub."""
    outlet = [("", owner)] if hub_lookup.has_outlet(system, owner) else []
    return outlet + hub_lookup.carriers_of(system, owner)


def _is_borrowed(system, owner, carrier):
    """Whether a carrier computes for another owner of this file."""
    if carrier == owner or carrier.library or carrier.override_library:
        return False
    if outbox.is_shared(system, carrier):
        return not sharing.is_own(system, owner, carrier)
    first = carrier.get(outbox.OWNER_KEY)
    return isinstance(first, bpy.types.Object) and first != owner and is_owner(system, first)


def absent_path(system, output):
    """Data path of a property that is never there."""
    return f'["motus_{system.name}:{output}"]'


def _output(names, carrier, slot, first):
    """Name of the output in a slot; None where something else is. first: slot at which the owner's begin."""
    known = names.get((carrier, slot["key"] or ""), ())
    place = int(slot["slot"]) - first - outbox.FIRST_OUTPUT
    return known[place] if 0 <= place < len(known) else None


def point(system, owner, readers):
    """Let drivers read their outputs where these are now."""
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
