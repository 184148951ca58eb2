"""Hubs that several owners of one system share, with one *row* for each owner.

A hub is a hidden object whose mesh carries a solver's driver and results. Owners share one if their solvers read the same objects and
their settings are not animated.

If the solver read the settings of the owners, it would have to wait for every owner. So each row holds, as a text in a custom property
of the mesh, the settings that solve() reads and the owner's name; the text is written whenever the settings are edited. Each owner
points to its hub and row. The hub points to no owner, so that appending one owner does not append the others. The array of results
(outbox) of a shared hub consists of the rows, one after the other.
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
    """Contents of a row: what the solver knows of one owner that shares a hub.

    name: the owner's name. settings: namespace with the settings that System.shared names. inputs: values of the inputs that are
    settings, by name. member_data: array of System.member_data, or None. memo: dictionary for Context.kept.
    """

    name: str
    settings: Any
    inputs: dict
    member_data: Any
    memo: dict


def key(system, row):
    """Return the name of the custom property of a shared hub's mesh that holds the text of a row, given by the row's index."""
    return f"motus_{system.name}_row_{row}"


def can_share(system, owner):
    """Whether an owner may share a hub with others of the system.

    It may if it drives only itself, its settings are not animated, all numbers in them are finite, and it is neither linked nor an
    override. It must not be mirrored: solve() does not see an owner that shares a hub, and so cannot find out that it is mirrored.
    """
    if not system.shared or owner.library or owner.override_library or copies.has_animated_settings(owner) or is_mirrored(owner):
        return False
    (group,) = groups_of(system, owner)
    return [member.thing for member in group.members] == [owner] and pack(system, owner) is not None


def pack(system, owner):
    """Return the text of an owner's row; None if a number in it is not finite."""
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
    """Return the Row with this index of a shared hub's mesh.

    Returns None if no owner has the row, or the class Damaged if the text differs in form from what pack() makes.
    """
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
    """Whether a parsed dictionary has exactly the named settings of a PropertyGroup, each with a value of the declared type."""
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
    """Return the name of the owner to which a row was given; "" if the row was given to no owner or is damaged."""
    found = _row(system, mesh.get(key(system, row)))
    return found.name if isinstance(found, Row) else ""


def is_own(system, owner, mesh):
    """Whether the row that an owner points to was given to this owner, and not to an owner from which it was copied.

    It is its own if the row has the owner's name or no name, or if no object of the row's name points to the row any more. The last
    case is that of a renamed owner.
    """
    row = of_owner(system, owner).row
    name = name_of(system, mesh, row)
    other = bpy.data.objects.get((name, None)) if name else None
    return name == owner.name or not (other and claims(system, other, mesh) and of_owner(system, other).row == row)


def claims(system, obj, mesh):
    """Whether an object is an owner of the system that points to a hub with this mesh."""
    if not is_owner(system, obj):
        return False
    hub = pointed(of_owner(system, obj), "hub")
    return hub is not None and hub.data == mesh


def holders(system, mesh):
    """Return {index of a row: local object that points to the row} for a shared hub's mesh."""
    return {of_owner(system, obj).row: obj for obj in bpy.data.objects if not obj.library and claims(system, obj, mesh)}


def write(system, owner):
    """Store an owner's settings in its row of a shared hub again; returns whether the owner may still share the hub."""
    text, settings = pack(system, owner), of_owner(system, owner)
    if text is None or copies.has_animated_settings(owner):
        return False
    mesh, name = pointed(settings, "hub").data, key(system, settings.row)
    if mesh.get(name) != text:
        mesh[name] = text
    return True


class Place(NamedTuple):
    """Hub and row that an owner was given by join().

    hub: the shared hub object. row: index of the owner's row. partner: if the hub is new, the second owner, which has to be wired again
    to join the hub; else None.
    """

    hub: Any
    row: int
    partner: Any


def join(system, owner, reads):
    """Give an owner a row of a shared hub; returns the Place, or None if the owner has to have a hub of its own.

    If no existing hub is suitable, a new one is created, provided that a different owner (the partner) can share it. reads: function
    that tells of a hub's mesh whether its solver reads the same objects as a solver for this owner would.
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
    """Free the row that an owner has in a shared hub; the hub is removed if no owner is left."""
    settings = of_owner(system, owner)
    mesh = pointed(settings, "hub").data
    settings.hub = None  # a row that no owner points to is free
    prune(system, mesh)


def _hub_for(system, owner, uses_attribute, reads):
    """Return a shared hub object that an owner may join; None if there is none.

    The hub has to be local and undamaged, and its solver has to read the same objects as a solver for this owner.
    """
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
    """Return a different owner with a hub of its own that may share one and whose solver reads the same objects; None if there is none."""
    for mesh in bpy.data.meshes:
        other = mesh.get(outbox.OWNER_KEY)
        if mesh.library or not isinstance(other, bpy.types.Object) or other == owner or not claims(system, other, mesh):
            continue
        if reads(mesh) and can_share(system, other):
            return other
    return None


def _take(system, owner, hub):
    """Give an owner a free or new row of a shared hub, and store its settings there; returns the row's index."""
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
    """In all shared hubs of a system, update the names of renamed owners, and remove the contents of rows that no owner points to."""
    for mesh in [mesh for mesh in bpy.data.meshes if not mesh.library and outbox.is_shared(system, mesh)]:
        for obj in holders(system, mesh).values():
            if is_own(system, obj, mesh):
                write(system, obj)
        prune(system, mesh)


def prune(system, mesh):
    """Remove the contents of the rows of a shared hub that no owner points to, and the whole hub if no owner is left."""
    taken = holders(system, mesh)
    for row in range(outbox.row_count(system, mesh)):
        if row not in taken and key(system, row) in mesh:
            del mesh[key(system, row)]
            mesh.update_tag()
    if not taken:
        bpy.data.meshes.remove(mesh)


def pointers(system, owner):
    """Return {name of the pointer setting: object} for the pointer settings of an owner that the system's inputs read, if they are set."""
    settings = of_owner(system, owner)
    found = {one.of: pointed(settings, one.of) for one in system.inputs if hasattr(one, "of")}
    return {name: target for name, target in found.items() if target}


def targets(system, mesh):
    """Return {name of the pointer setting: object or None} for the pointer settings that the inputs read, stored on a shared hub's mesh.

    On an evaluated mesh the objects are evaluated copies. Raises Damaged if a stored value is no object.
    """
    found = {one.of: mesh.get(target_key(one.of)) for one in system.inputs if hasattr(one, "of")}
    if not all(isinstance(target, (bpy.types.Object, type(None))) for target in found.values()):
        raise Damaged("no object")
    return found


def target_key(name):
    """Return the name of the custom property of a shared hub's mesh that holds the object named by a pointer setting."""
    return f"motus_of_{name}"
