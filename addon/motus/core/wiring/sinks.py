"""Finding sinks again, by what they read: names can be changed, and copies carry sinks that nobody listed."""

import re

import bpy

from ..system import groups_of, of_owner
from . import attribute_sink, drivers, limit_sink, outbox, proxy_sink

_DIRECT = re.compile(r'motus_direct\(self,"(?P<system>\w+)\.?(?P<key>\w*)",(?P<slot>\d{1,9}),')
_DRIVEN = (".influence", ".to_min_x_rot", ".to_min_x_scale")
"""A sink is known by the driver of one of these: the influence, or what a relative one has instead."""


def on_object(system, obj):
    """Yields (Object or PoseBone, constraint, carrier, group's key) of every sink of the system, whoever drives it."""
    pattern, undriven = outbox.slot_pattern(system), set()
    for thing in (obj, *(obj.pose.bones if obj.pose else ())):
        for constraint in thing.constraints:
            key = attribute_sink.undriven_key(system, constraint)
            if key is not None:
                undriven.add(constraint)
                yield thing, constraint, constraint.target.data, key
            proxy = proxy_sink.proxy_of(constraint)
            read = proxy and _read_first(system, pattern, proxy)
            if read:
                # The copy of a rig hangs on the first one's proxies, but the sinks are its own.
                yield thing, constraint, outbox.carrier_of(system, obj, read[1]), read[1]
    animation, seen = obj.animation_data, set()
    for curve in animation.drivers if animation else ():
        path = curve.data_path
        if not path.endswith(_DRIVEN):
            continue
        path = path.rpartition(".")[0]
        read = path not in seen and _read_by_sink(system, pattern, curve, obj)
        constraint = _resolve(obj, path) if read else None
        if constraint and constraint not in undriven and _is_sure(system, constraint, read):
            seen.add(path)
            yield _holder(obj, path), constraint, *read
    if obj.override_library and not obj.library:
        yield from _bereft(system, obj, _driven_constraints(obj))


def _is_sure(system, constraint, read):
    """Whether a constraint that reads a slot of an outbox is a sink: where nobody knows what the slots are, by its name."""
    if system.groups is None or outbox.info(system, *read) is not None:
        return True
    return constraint.type == 'GEOMETRY_ATTRIBUTE' or limit_sink.is_named(system, constraint)


def _bereft(system, obj, driven):
    """The same for constraints that are called like sinks and work no more: of an override, where Blender has not saved their
    drivers, copies, and those whose hub is gone. driven: data paths of constraints that have drivers.
    """
    for thing in (obj, *(obj.pose.bones if obj.pose else ())):
        for constraint in thing.constraints:
            is_ours = (limit_sink.is_named(system, constraint) or attribute_sink.needs_driver(system, constraint)
                       or attribute_sink.is_bereft(system, constraint))
            if is_ours and constraint.path_from_id() not in driven:
                yield thing, constraint, obj, ""


def sinks(system, owner):
    """(Object or PoseBone, constraint) of every sink that the owner drives."""
    driven = _driven_objects(system, owner)
    # Where somebody has deleted a hub's object, outbox.carrier_of() gives the owner itself.
    carriers = {owner, *(carrier for _, carrier in outbox.carriers(system, owner)), *outbox.lost_hubs(system, owner)}
    # Overrides may have lost outbox and drivers, or been given sinks of their library again.
    overridden = [obj for obj in driven if obj.override_library]
    carriers.update(overridden)
    for obj in overridden:
        carriers.update(carrier for _, carrier in outbox.carriers(system, obj.override_library.reference))
    return [(thing, constraint) for obj in driven
            for thing, constraint, carrier, _ in on_object(system, obj) if carrier in carriers]


def has_sinks(system, obj):
    """Whether an object carries sinks of the system: its own, its leader's, or those it was copied with."""
    return any(True for _ in on_object(system, obj))


def renamed_bones(system, owner):
    """(old name, new name) of the driven bones of an owner that were renamed since they were wired."""
    if owner.pose is None:
        return []
    found, at_home = {}, set()
    for thing, old in _as_wired(system, owner):
        if old == thing.name:
            at_home.add(old)
        else:
            found.setdefault(old, thing.name)  # copies of the bone come after it
    return [(old, new) for old, new in found.items() if old not in at_home]


def has_strays(system, owner):
    """Whether bones that the system does not drive have got copies of its sinks, by tools of Blender's."""
    if owner.pose is None or owner.override_library:
        return False
    return any(old != thing.name for thing, old in _as_wired(system, owner)) or bool(_strays(system, owner))


def _as_wired(system, owner):
    """Yields (PoseBone, name that it had when it was wired) for every sink on the owner's bones of which that can be told."""
    old_names = {}
    for key, carrier in outbox.carriers(system, owner):
        known = outbox.info(system, carrier, key)
        if known is not None:
            old_names[carrier, key] = known.members, outbox.FIRST_OUTPUT + len(known.outputs)
    slots = _slots(system, owner, owner) if old_names else {}
    for thing, constraint, carrier, key in on_object(system, owner) if old_names else ():
        names, base = old_names.get((carrier, key), ((), 0))
        index = _member_index(system, owner, constraint, base, len(names), slots)
        if index is not None:
            yield thing, names[index]


def release(system, obj):
    """Free one object of all sinks of the system, whoever drives it. An owner of its own is detached instead."""
    found = list(on_object(system, obj))
    # One that was joined into the object has left the driver of its solver there.
    drivers.remove_under(obj, f'["{outbox.out_key(system)}')
    remove([(thing, constraint) for thing, constraint, _, _ in found])
    of_owner(system, obj).leader = None
    for mesh in {carrier for _, _, carrier, _ in found}:
        if isinstance(mesh, bpy.types.Mesh) and mesh.get(outbox.OWNER_KEY) is None and not _is_read(system, mesh):
            bpy.data.meshes.remove(mesh)


def makers(system, obj):
    """Owners of the hubs and proxies that the sinks on an object hang on."""
    found = {(proxy_sink.proxy_of(constraint) or carrier) for _, constraint, carrier, _ in on_object(system, obj)}
    owners = [one.get(proxy_sink.KEY) or one.get(outbox.OWNER_KEY) for one in found]
    return {owner for owner in owners if isinstance(owner, bpy.types.Object)}


def remove(found):
    """Remove sinks, given as (Object or PoseBone, constraint), with their drivers."""
    by_object = {}
    for thing, constraint in found:
        by_object.setdefault(thing.id_data, []).append((thing, constraint))
    for obj, ours in by_object.items():
        paths = {constraint.path_from_id() for _, constraint in ours}
        drivers.remove_where(obj, lambda path, paths=paths: path.rpartition(".")[0] in paths)
        for thing, constraint in ours:
            active = thing.constraints.active
            kept = None if active == constraint else active
            thing.constraints.remove(constraint)
            thing.constraints.active = kept  # which removing any other one forgets
        drivers.drop_empty_animation(obj)
        obj.update_tag()


def remove_orphans(system, owner):
    """Where the sinks are gone, remove what is left of some: drivers whose bone is gone, and constraints without drivers.

    Blender copies a bone in Edit Mode with its constraints, but not with the drivers of these.
    """
    pattern = outbox.slot_pattern(system)
    animation = owner.animation_data
    gone = {curve.data_path for curve in (animation.drivers if animation else ())
            if curve.data_path.startswith("pose.bones[") and _read(system, pattern, curve.driver, owner)
            and _resolve(owner, curve.data_path) is None}
    if gone:
        drivers.remove_where(owner, gone.__contains__)
    remove(_strays(system, owner))


def _strays(system, owner):
    """(PoseBone, constraint) of copies without drivers, and of sinks without a hub. Not of overrides, which have lost theirs."""
    if system.groups is None or owner.pose is None or owner.override_library:
        return []
    return [(thing, constraint) for thing, constraint, *_ in _bereft(system, owner, _driven_constraints(owner))
            if thing != owner]


def _driven_constraints(obj):
    """Data paths of the constraints of an object and its bones that have drivers."""
    animation = obj.animation_data
    return {curve.data_path.rpartition(".")[0] for curve in animation.drivers} if animation else set()


def set_muted(system, owner, muted):
    """Switch the sinks off or on, leaving all else in place."""
    for _, constraint in sinks(system, owner):
        constraint.mute = muted


def led_by(system, owner):
    """Objects whose leader the owner is."""
    if not outbox.hubs(system, owner):
        return []
    return [other for other in bpy.data.objects if of_owner(system, other).leader == owner]


def _driven_objects(system, owner):
    objects = {owner, *led_by(system, owner)}
    if any(outbox.is_own_hub(hub, owner) for _, hub in outbox.hubs(system, owner)):
        objects.update(member.thing.id_data for group in groups_of(system, owner) for member in group.members
                       if member.thing)
    return objects


def _read(system, pattern, driver, obj):
    """(carrier, group's key) of the outbox that a driver reads; None for any other driver."""
    direct = _DIRECT.match(driver.expression)
    if direct:
        return (obj, direct["key"]) if direct["system"] == system.name else None
    for variable in driver.variables:
        target = variable.targets[0]
        slot = pattern.match(target.data_path)
        if slot and target.id:
            return target.id, slot["key"] or ""
    return None


def _member_index(system, owner, constraint, base, count, slots):
    """Place of a sink's member in its group; None where that cannot be told. slots: _slots() of the owner's drivers."""
    if constraint.type == 'GEOMETRY_ATTRIBUTE':
        return constraint.sample_index if constraint.sample_index < count else None
    proxy = proxy_sink.proxy_of(constraint)
    slot = _slots(system, proxy, owner).get("") if proxy else slots.get(constraint.path_from_id())
    if slot is None:
        return None
    offset, poses = slot - base, outbox.POSE_SIZE * count
    index = offset // outbox.POSE_SIZE if offset < poses else (offset - poses) // outbox.SCALE_SIZE
    return index if 0 <= index < count else None


def _slots(system, holder, owner):
    """Path of each constraint, "" for the holder itself -> the first slot of an outbox that drives it, but for the influence."""
    found, pattern = {}, outbox.slot_pattern(system)
    for curve in holder.animation_data.drivers if holder.animation_data else ():
        path, _, name = curve.data_path.rpartition(".")
        if name != "influence" and path not in found and _read(system, pattern, curve.driver, owner):
            found[path] = _slot(pattern, curve.driver)
    return found


def _read_first(system, pattern, proxy):
    animation = proxy.animation_data
    return _read(system, pattern, animation.drivers[0].driver, proxy) if animation and animation.drivers else None


def _read_by_sink(system, pattern, curve, obj):
    """The same where the driver is that of a sink, not one by which the user reads an output."""
    read = _read(system, pattern, curve.driver, obj)
    if not read:
        return None
    slot = _slot(pattern, curve.driver)
    if curve.data_path.endswith(".influence"):
        return read if slot == outbox.WEIGHT else None
    return read if slot >= outbox.FIRST_OUTPUT + len(outbox.output_names(system, *read)) else None


def _slot(pattern, driver):
    """Which slot of the outbox a driver is known to read."""
    direct = _DIRECT.match(driver.expression)
    if direct:
        return int(direct["slot"])
    paths = [variable.targets[0].data_path for variable in driver.variables]
    return next(int(match["slot"]) for match in map(pattern.match, paths) if match)


def _is_read(system, mesh):
    return any(carrier == mesh for obj in bpy.data.objects for _, _, carrier, _ in on_object(system, obj))


def _resolve(owner, path):
    try:
        return owner.path_resolve(path)
    except ValueError:
        return None


def _holder(owner, path):
    """The Object or PoseBone whose constraint a path names."""
    bone, separator, _ = path.rpartition(".constraints[")
    return owner.path_resolve(bone) if separator and bone else owner
