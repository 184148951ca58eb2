"""Owners that share a hub, each a *row* of it: those of one system that read the same, and whose settings stay as they are.

Were the solver to read their settings, it would have to wait for every owner. So a row holds what solve() reads of the
settings, packed when they are edited, and the owner's name. The owner points to hub and row, the hub to none of its owners:
one that is appended does not bring the others. The shared outbox is one row's after the other's.
"""

import json
from types import SimpleNamespace
from typing import Any, NamedTuple

import bpy

from ... import keeping
from ...declare import Setting, groups_of, is_owner, of_owner
from ...evaluated import copies
from ...file import stored
from ...file.pointers import pointed
from ...file.stored import Damaged
from ...lazy import numpy as np
from ...measures.handedness import is_mirrored
from ..hubs import hub_lookup, outbox
from ..sinks import attribute_sink

_known = keeping.OfFile("rows of hubs that owners share (Row), or Damaged", "name of the system, the text of the row", most=4096)


class Row(NamedTuple):
    """What a row says. settings: has those that System.shared names. memo: see Context.kept."""

    name: str
    settings: Any
    inputs: dict
    member_data: Any
    memo: dict


def key(system, row):
    """Name of the property that holds a row."""
    return f"motus_{system.name}_row_{row}"


def can_share(system, owner):
    """Whether an owner may share a hub: nothing but itself is driven, by settings that do not change in time.

    Of who shares one solve() does not see the owner, by which it knows what is mirrored.
    """
    if not system.shared or owner.library or owner.override_library or copies.has_animated_settings(owner) or is_mirrored(owner):
        return False
    (group,) = groups_of(system, owner)
    return [member.thing for member in group.members] == [owner] and pack(system, owner) is not None


def pack(system, owner):
    """The text of an owner's row; None where a number in it is not finite."""
    settings = of_owner(system, owner)
    said = {
        "name": owner.name,
        "settings": _values(settings, system.shared),
        "inputs": {one.name: one.read(0.0, settings) for one in system.inputs if isinstance(one, Setting)},
        "member_data": None if system.member_data is None else list(map(float, system.member_data(owner))),
    }
    try:
        return json.dumps(said, allow_nan=False)
    except ValueError:
        return None


def _values(group, names):
    found = {}
    for name in names:
        value = getattr(group, name)
        if group.bl_rna.properties[name].type == 'COLLECTION':
            value = [_values(item, _plain(item)) for item in value]
        found[name] = value
    return found


def _plain(group):
    return [prop.identifier for prop in group.bl_rna.properties if prop.type in _FORMS or prop.type == 'ENUM']


def row(system, mesh, index):
    """The Row of a hub's row, None where nobody has it, Damaged where it is not what pack() makes."""
    return _row(system, mesh.get(key(system, index)))


def _row(system, text):
    if text is None:
        return None
    return _known.made((system.name, text), lambda: _parsed(system, text)) if isinstance(text, str) else Damaged


def _parsed(system, text):
    form = {
        "name": str,
        "settings": lambda value: _fits(system.settings.bl_rna, system.shared, value),
        "inputs": lambda value: _fits(system.settings.bl_rna, [one.name for one in system.inputs if isinstance(one, Setting)], value),
        "member_data": lambda value: value is None or stored.fits(value, [float]),
    }
    try:
        said = stored.parse(text, form)
    except Damaged:
        return Damaged
    data = said["member_data"]
    return Row(said["name"], _namespace(said["settings"]), said["inputs"], None if data is None else np.array(data), {})


_FORMS = {'FLOAT': float, 'INT': lambda value: type(value) is int and abs(value) <= stored.LARGEST_NUMBER, 'BOOLEAN': bool, 'STRING': str}


def _fits(rna, names, value):
    """Whether parsed values may be those of a group of settings."""
    return (
        isinstance(value, dict)
        and value.keys() == set(names)
        and all(_fits_property(rna.properties[name], one) for name, one in value.items())
    )


def _fits_property(prop, value):
    if prop.type == 'ENUM':
        return value in prop.enum_items.keys()
    if prop.type == 'COLLECTION':
        names = [one.identifier for one in prop.fixed_type.properties if one.type in _FORMS or one.type == 'ENUM']
        return isinstance(value, list) and all(_fits(prop.fixed_type, names, one) for one in value)
    return stored.fits(value, _FORMS[prop.type])


def _namespace(values):
    return SimpleNamespace(
        **{name: [_namespace(one) for one in value] if isinstance(value, list) else value for name, value in values.items()}
    )


def name_of(system, mesh, row):
    """Name of the owner that a row was given to; "" where it was given to none, or is damaged."""
    found = _row(system, mesh.get(key(system, row)))
    return found.name if isinstance(found, Row) else ""


def is_own(system, owner, mesh):
    """Whether the row that an owner points to was given to it, or to one that is gone, as before it was given another name."""
    row = of_owner(system, owner).row
    name = name_of(system, mesh, row)
    other = bpy.data.objects.get((name, None)) if name else None
    return name == owner.name or not (other and claims(system, other, mesh) and of_owner(system, other).row == row)


def claims(system, obj, mesh):
    """Whether an object points to a row of a hub."""
    if not is_owner(system, obj):
        return False
    hub = pointed(of_owner(system, obj), "hub")
    return hub is not None and hub.data == mesh


def holders(system, mesh):
    """{row: a local object that points to it}."""
    return {of_owner(system, obj).row: obj for obj in bpy.data.objects if not obj.library and claims(system, obj, mesh)}


def write(system, owner):
    """Pack an owner's settings again; returns whether it may go on to share its hub."""
    text, settings = pack(system, owner), of_owner(system, owner)
    if text is None or copies.has_animated_settings(owner):
        return False
    mesh, name = pointed(settings, "hub").data, key(system, settings.row)
    if mesh.get(name) != text:
        mesh[name] = text
    return True


class Place(NamedTuple):
    """Where an owner has joined others. partner: the other one that is to be wired anew to join, if the hub is new."""

    hub: Any
    row: int
    partner: Any


def join(system, owner, reads):
    """Give an owner a row of a shared hub, of a new one if another owner is there to join it; None if it stays alone.

    reads: whether the solver of a hub's mesh reads what one of this owner would.
    """
    if not can_share(system, owner):
        return None
    uses_attribute = attribute_sink.serves(system)
    hub = _hub_for(system, owner, uses_attribute, reads)
    partner = None if hub else _partner_for(system, owner, reads)
    if hub is None:
        if partner is None:
            return None
        hub = hub_lookup.new_hub(system.label)
        outbox.create_shared(system, hub.data, uses_attribute)
        for name, target in pointers(system, owner).items():
            hub.data[target_key(name)] = target
        copies.mark(hub.data)
    return Place(hub, _take(system, owner, hub), partner)


def leave(system, owner):
    """Let an owner's row go."""
    settings = of_owner(system, owner)
    mesh = pointed(settings, "hub").data
    settings.hub = None  # by which the row is free
    prune(system, mesh)


def _hub_for(system, owner, uses_attribute, reads):
    """The hub object that an owner may join: local, whole, and its solver reads the same; None without."""
    for mesh in bpy.data.meshes:
        if mesh.library or mesh.override_library or not outbox.is_shared(system, mesh):
            continue
        named = {name: mesh.get(target_key(name)) for name in pointers(system, owner)}
        if (
            outbox.is_whole(system, mesh)
            and outbox.has_attribute(mesh) == uses_attribute
            and named == pointers(system, owner)
            and reads(mesh)
        ):
            found = holders(system, mesh)
            if found:
                return pointed(of_owner(system, next(iter(found.values()))), "hub")
    return None


def _partner_for(system, owner, reads):
    """Another owner that has a hub of its own, reads the same and may share one; None without."""
    for mesh in bpy.data.meshes:
        other = mesh.get(outbox.OWNER_KEY)
        if mesh.library or not isinstance(other, bpy.types.Object) or other == owner or not claims(system, other, mesh):
            continue
        if reads(mesh) and can_share(system, other):
            return other
    return None


def _take(system, owner, hub):
    """Give an owner a row of a hub; returns it."""
    mesh, settings = hub.data, of_owner(system, owner)
    count, taken = outbox.row_count(system, mesh), holders(system, mesh)
    row = next((row for row in range(count) if row not in taken), count)
    if row == count:
        outbox.add_row(system, mesh)
        if outbox.has_attribute(mesh):
            attribute_sink.prepare_row(mesh)
    settings.hub, settings.row = hub, row
    write(system, owner)
    return row


def tidy(system):
    """Note new names of owners, and drop the rows that nobody has."""
    for mesh in [mesh for mesh in bpy.data.meshes if not mesh.library and outbox.is_shared(system, mesh)]:
        for obj in holders(system, mesh).values():
            if is_own(system, obj, mesh):
                write(system, obj)
        prune(system, mesh)


def prune(system, mesh):
    """Drop the rows that nobody has; a hub without any is removed."""
    taken = holders(system, mesh)
    for row in range(outbox.row_count(system, mesh)):
        if row not in taken and key(system, row) in mesh:
            del mesh[key(system, row)]
            mesh.update_tag()
    if not taken:
        bpy.data.meshes.remove(mesh)


def pointers(system, owner):
    """What the pointer settings name that a system's inputs are read of."""
    settings = of_owner(system, owner)
    found = {one.of: pointed(settings, one.of) for one in system.inputs if hasattr(one, "of")}
    return {name: target for name, target in found.items() if target}


def targets(system, mesh):
    """What the pointer settings of the owners name, on the same mesh evaluated."""
    found = {one.of: mesh.get(target_key(one.of)) for one in system.inputs if hasattr(one, "of")}
    if not all(isinstance(target, (bpy.types.Object, type(None))) for target in found.values()):
        raise Damaged("no object")
    return found


def target_key(name):
    """Name of the property of a shared hub's mesh that holds what a pointer setting names."""
    return f"motus_of_{name}"
