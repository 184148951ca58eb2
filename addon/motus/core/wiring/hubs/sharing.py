"""Parts: what one owner has of a hub, either the whole hub, or one *row* of a hub that several owners share.

A hub is a hidden object whose mesh carries a solver's driver and an array of results, the outbox. An owner is an object whose settings
a system solves. Owners share a hub if their solvers read the same objects and their settings are not animated. Only this module tells a
row from a whole hub: all other modules ask for the Parts of an owner. A whole hub is the Part with row 0 and slot 0.

The solver of a shared hub reads the settings of its owners from a text on the mesh for each row (rows.py). Each owner points to its hub
and row. The hub points to no owner, so that appending one owner does not append the others. The outbox of a shared hub consists of the
rows, one after the other.
"""

from contextlib import suppress
from typing import Any, NamedTuple

import bpy

from ...declare import groups_of, input_variables, is_owner, of_owner
from ...evaluated import copies
from ...file.pointers import pointed
from ...file.stored import Damaged
from ...measures.handedness import is_mirrored
from . import hub_lookup, outbox, rows, traits


class Part(NamedTuple):
    """What one owner has of one hub: the whole hub, or one row of a hub that several owners share.

    key: key of the owner's group that is computed there. hub: hub object; None if it was deleted and only its mesh is left. mesh: the hub's
    mesh. row: index of the owner's row, which is also the index of its first member; 0 in a whole hub. first: index of the owner's first
    slot in the outbox. maker: object for which the hub or row was made: the owner, or, if the owner is a copy that still uses the hub of
    the object from which it was copied, that object; in a damaged file None or a value that is not an object. is_own: whether the part
    computes for this owner, in a hub that is not overridden and in the same file as the owner. reads_owner: whether the solver reads the
    settings of the evaluated owner; if not, the solver reads the text that store_settings() writes. partner: different owner that has to be
    wired again in order to share the hub; else None.
    """

    key: str
    hub: Any
    mesh: Any
    row: int
    first: int
    maker: Any
    is_own: bool
    reads_owner: bool
    partner: Any = None


def parts(system, owner):
    """Return a list with the Part of each hub to which an owner's settings point, in the order of the groups."""
    return [_part(system, owner, key, hub.data, hub) for key, hub in hub_lookup.hubs(system, owner)]


def all_parts(system, owner):
    """Return the Parts of an owner, including those of hubs whose hub object was deleted and of which only the mesh is left."""
    lost = hub_lookup.lost_hubs(system, owner)
    return parts(system, owner) + [_part(system, owner, outbox.key_on_hub(system, mesh), mesh, None) for mesh in lost]


def part_of(system, owner, key=""):
    """Return the Part in which the group with this key is computed for an owner; None if the hub is gone."""
    return next((part for part in parts(system, owner) if part.key == key), None)


def _part(system, owner, key, mesh, hub, partner=None):
    is_whole, row, first = not outbox.is_shared(system, mesh), 0, 0
    if is_whole:
        maker = mesh.get(outbox.OWNER_KEY)
    else:
        row = of_owner(system, owner).row
        maker = _holder(system, owner, mesh)
        with suppress(Damaged):
            first = row * outbox.row_layout(system, mesh).size
    is_own = maker == owner and not mesh.override_library and mesh.library == owner.library
    return Part(key, hub, mesh, row, first, maker, is_own, is_whole, partner)


def opened(system, part, evaluated):
    """Return the checked Outbox of an owner's Part. evaluated: the hub's mesh, original or evaluated.

    Raises Damaged if the data on the mesh is invalid.
    """
    return outbox.opened(system, evaluated, part.key, None if part.reads_owner else part.row)


def status_of(system, part, evaluated):
    """Return the status that the solver has written for an owner's Part. Raises Damaged if the hub's data is invalid.

    evaluated: evaluated mesh of the hub.
    """
    if part.reads_owner:
        outbox.owner_of(system, evaluated)
    return opened(system, part, evaluated).slots[outbox.STATUS]


def has_rows(mesh):
    """Whether a hub is shared: its one solver computes a row for each of several owners. mesh: the hub's mesh.

    The solver reads the stored texts of the rows, not the owners themselves.
    """
    return outbox.SHARED_KEY in mesh


def is_abandoned(mesh):
    """Whether the owner for which a hub computes is gone. mesh: the hub's mesh. False for a shared hub, which points to no owner."""
    return not has_rows(mesh) and mesh.get(outbox.OWNER_KEY) is None


def store_settings(system, owner, found):
    """Write on the hubs' meshes what their solvers read there of an owner's settings, and have owner and meshes evaluated again.

    Returns False if the owner has to be wired again, because the number of its members has changed or because the owner can no longer share
    its hub. found: Parts of the owner.
    """
    owner.update_tag()
    for part in found:
        part.mesh.update_tag()
    part = next((part for part in found if not part.key), None)
    if part is None:
        return True
    if not part.reads_owner:
        return part.mesh.library is not None or _write(system, owner, part.mesh)
    return system.member_data is None or _store_member_data(part.mesh, system.member_data(owner))


def _store_member_data(mesh, values):
    """Store on a hub's mesh the numbers that System.member_data has returned.

    Returns False, and stores nothing, if their count is not that of the array already stored there. The numbers are stored as an array,
    because reading a collection of settings item by item in every solve is slow if there are many members.
    """
    data = [float(value) for value in values]
    if not outbox.has_room(mesh, len(data)):
        return False
    mesh[outbox.MEMBER_DATA_KEY] = data
    return True


def can_share(system, owner):
    """Whether an owner may share a hub with other owners of the system.

    The owner may if it drives only itself, its settings are not animated, all numbers in them are finite, and it is neither linked nor an
    override. The owner must not be mirrored (by a negative scale of its own or of a parent object): solve() does not see an owner that
    shares a hub, and so cannot find out about mirroring.
    """
    if not system.shared or owner.library or owner.override_library or copies.has_animated_settings(owner) or is_mirrored(owner):
        return False
    (group,) = groups_of(system, owner)
    return [member.thing for member in group.members] == [owner] and rows.pack(system, owner) is not None


def _holder(system, owner, mesh):
    """Return the object for which the row to which an owner points was made: the owner, or the object from which it was copied.

    The row was made for the owner if the row has the owner's name or no name, or if no object of the row's name points to the row any more.
    In the last case the owner was renamed.
    """
    index = of_owner(system, owner).row
    found = rows.row(system, mesh, index)
    name = found.name if isinstance(found, rows.Row) else ""
    other = bpy.data.objects.get((name, None)) if name else None
    is_others = name != owner.name and other and claims(system, other, mesh) and of_owner(system, other).row == index
    return other if is_others else owner


def claims(system, obj, mesh):
    """Whether an object is an owner of the system and its settings point to the hub with this mesh."""
    if not is_owner(system, obj):
        return False
    hub = pointed(of_owner(system, obj), "hub")
    return hub is not None and hub.data == mesh


def holders(system, mesh):
    """Return {index of a row: local object that points to the row} for a shared hub's mesh."""
    return {of_owner(system, obj).row: obj for obj in bpy.data.objects if not obj.library and claims(system, obj, mesh)}


def _write(system, owner, mesh):
    """Store an owner's settings in its row of a shared hub; returns False, and stores nothing, if the owner can no longer share the hub.

    mesh: mesh of the hub.
    """
    text = rows.pack(system, owner)
    if text is None or copies.has_animated_settings(owner):
        return False
    name = rows.key(system, of_owner(system, owner).row)
    if mesh.get(name) != text:
        mesh[name] = text
    return True


def provide(system, owner, groups):
    """Give an owner a Part for each of its groups: a row of a shared hub if the owner may share one, else whole new hubs.

    Returns the Parts, in the order of the groups. New hubs have outboxes with neutral values, but neither solver drivers nor sinks.
    """
    copies.prepare(owner)
    shared = _join(system, owner)
    found = [shared] if shared else [_make_whole(system, owner, group) for group in groups]
    store_settings(system, owner, found)
    return found


def _make_whole(system, owner, group):
    """Create a hub that computes one group of one owner, and store it in the owner's settings; returns the Part."""
    hub = hub_lookup.new_hub(system.label, owner.name, group.key)
    hub.data[outbox.OWNER_KEY] = owner
    settings = of_owner(system, owner)
    if group.key:
        entry = settings.more_hubs.add()
        entry.name, entry.object = group.key, hub
    else:
        settings.hub = hub
    outbox.create(system, hub.data, group)
    copies.mark(hub.data)
    return _part(system, owner, group.key, hub.data, hub)


def _join(system, owner):
    """Give an owner a row of a shared hub; returns the Part, or None if the owner has to have hubs of its own.

    If no existing hub is suitable, a new one is created, provided that there is a partner: a different owner that can share the new hub.
    """
    if not can_share(system, owner):
        return None
    hub, partner = _hub_for(system, owner), None
    if hub is None:
        partner = _partner_for(system, owner)
        if partner is None:
            return None
        hub = hub_lookup.new_hub(system.label)
        outbox.create_shared(system, hub.data)
        for name, target in rows.pointers(system, owner).items():
            hub.data[rows.target_key(name)] = target
        copies.mark(hub.data)
    settings = of_owner(system, owner)
    settings.hub, settings.row = hub, _free_row(system, hub.data)
    return _part(system, owner, "", hub.data, hub, partner)


def held_meshes(found):
    """Return the meshes of those hubs that an owner has to leave when it is unwired, each mesh once. found: Parts of the owner.

    These are the hubs that compute for the owner, the hubs whose object was deleted, and the local shared hubs to which the owner's
    settings point. A damaged file may name the same hub twice.
    """
    return list(dict.fromkeys(part.mesh for part in found if _is_held(part)))


def _is_held(part):
    return part.is_own or part.hub is None or not (part.reads_owner or part.mesh.library)


def leave(system, mesh):
    """Remove a hub when an owner stops using it. Of a shared hub, only the rows are removed to which no owner points any more.

    mesh: the hub's mesh.
    """
    if outbox.is_shared(system, mesh):
        prune(system, mesh)
    else:
        hub_lookup.remove(mesh)


def _hub_for(system, owner):
    """Return a shared hub object that an owner may join; None if there is none.

    The hub has to be local and undamaged, and its solver has to read the same objects as a solver for this owner.
    """
    for mesh in bpy.data.meshes:
        if mesh.library or mesh.override_library or not outbox.is_shared(system, mesh):
            continue
        named = {name: mesh.get(rows.target_key(name)) for name in rows.pointers(system, owner)}
        if (
            outbox.is_whole(system, mesh)
            and outbox.has_attribute(mesh) == traits.uses_attribute(system)
            and named == rows.pointers(system, owner)
            and _reads_the_same(system, owner, mesh)
        ):
            found = holders(system, mesh)
            if found:
                return pointed(of_owner(system, next(iter(found.values()))), "hub")
    return None


def _partner_for(system, owner):
    """Return a different owner that may share a new hub with this owner; None if there is none.

    Such an owner has a hub of its own, and its solver reads the same objects.
    """
    for mesh in bpy.data.meshes:
        other = mesh.get(outbox.OWNER_KEY)
        if mesh.library or not isinstance(other, bpy.types.Object) or other == owner or not claims(system, other, mesh):
            continue
        if _reads_the_same(system, owner, mesh) and can_share(system, other):
            return other
    return None


def _reads_the_same(system, owner, mesh):
    """Whether the solver driver on a hub's mesh reads the same datablocks and data paths as a solver driver for this owner would."""
    wanted = [variable and (variable.id, variable.data_path) for _, variable in input_variables(system, owner)]
    animation = mesh.animation_data
    curve = animation and animation.drivers.find(outbox.out_path(system), index=outbox.STATUS)
    if not curve:
        return False
    found = {variable.name: (variable.targets[0].id, variable.targets[0].data_path) for variable in curve.driver.variables}
    return [found.get(f"v{index}") for index in range(len(wanted))] == wanted


def _free_row(system, mesh):
    """Return the index of a row of a shared hub to which no owner points; a new row is added if there is none."""
    count, taken = outbox.row_count(system, mesh), holders(system, mesh)
    free = next((index for index in range(count) if index not in taken), count)
    if free == count:
        outbox.add_row(system, mesh)
    return free


def tidy(system):
    """Update the names of renamed owners in all shared hubs of a system, and remove the texts of rows to which no owner points."""
    for mesh in [mesh for mesh in bpy.data.meshes if not mesh.library and outbox.is_shared(system, mesh)]:
        for obj in holders(system, mesh).values():
            if _holder(system, obj, mesh) == obj:
                _write(system, obj, mesh)
        prune(system, mesh)


def prune(system, mesh):
    """Remove the texts of those rows of a shared hub to which no owner points, and the whole hub if no owner is left."""
    taken = holders(system, mesh)
    for row in range(outbox.row_count(system, mesh)):
        if row not in taken and rows.key(system, row) in mesh:
            del mesh[rows.key(system, row)]
            mesh.update_tag()
    if not taken:
        hub_lookup.remove(mesh)
