"""Attaching a system to an owner and taking it away again."""

import bpy

from ...blender import actions, drivers
from ...declare import groups_of, is_owner, of_owner, systems
from ...declare.forgetting import drop_dead_copy
from ...evaluated import copies
from ..hubs import hub_lookup, outbox, outputs
from ..sinks import attribute_sink, geometry_sink, property_sink, proxy_sink, transform_sink
from ..sinks.finding import has_strays, led_by, remove, remove_orphans, renamed_bones, sinks
from . import override_drivers, overrides, readers, sharing, signature, solver_driver, waiting

AIMING = {'TRACK_TO', 'DAMPED_TRACK', 'LOCKED_TRACK'}


def attach(system, owner):
    """Wire `system` on `owner`: hubs with solvers and outboxes, and sinks on all members. What was wired before is replaced."""
    _attach(system, owner, {})
    refresh_others(system, owner)


def _attach(system, owner, before):
    """before: what _stacks() said of the owner's last wiring; things that had sinks then have them at these places again."""
    followers = readers.of(system, owner)
    _detach(system, owner)
    settings = of_owner(system, owner)
    settings.is_active = True
    if settings.is_released:
        settings.is_released = False
    waiting.set_proxy(system, settings)
    copies.prepare(owner)
    copies.mark(*solver_driver.curves_for(system, owner))
    groups = groups_of(system, owner)
    partner = _wire_row(system, owner, groups[0]) if sharing.can_share(system, owner) else owner
    for group in groups if partner == owner else ():
        _wire(system, owner, group)
    readers.point(system, owner, followers)
    settings.wired = signature.signature(system, owner, groups)
    overrides.mark(system, owner, groups)
    _order_sinks(system, owner, groups, before)
    _tag(system, owner)
    if partner not in {None, owner}:
        _refresh(system, partner)


def _wire(system, owner, group):
    hub = hub_lookup.make_hub(system, owner, group)
    uses_attribute = signature.uses_attribute(system)
    if uses_attribute:
        attribute_sink.prepare(system, hub.data, owner, group)
    elif system.has_modifier:
        geometry_sink.prepare(system, hub.data, of_owner(system, owner))
    outbox.create(system, hub.data, group, uses_attribute)
    copies.mark(hub.data)
    if signature.wants_outlet(system, owner):
        outputs.create_outlet(system, owner, hub.data)
    solver_driver.add(system, owner, group, hub)
    property_sink.add(system, owner, group, hub, is_off=of_owner(system, owner).is_baked)
    for one in group.properties:
        _lead(system, owner, one.object)
    if system.has_modifier:
        geometry_sink.add(system, owner, hub)
        return
    driven = drivers.driven_bones(owner)
    for index, member in enumerate(group.members):
        active = member.thing.constraints.active
        if uses_attribute:
            attribute_sink.add(system, group, index, hub)
        elif proxy_sink.is_needed(system, member, driven):
            proxy_sink.add(system, of_owner(system, owner), group, index, hub)
        else:
            transform_sink.add(system, group, index, hub)
        member.thing.constraints.active = active
        _lead(system, owner, member.thing.id_data)


def _order_sinks(system, owner, groups, before):
    """Move sinks, which were added behind all other constraints, to where they were, or to where new ones belong."""
    aimed = {member.thing for group in groups for member in group.members if _is_aimed_afterwards(member)}
    for thing, places in _stacks(system, owner).items():
        old = before.get(thing)
        first = old[0][0] if old else 0 if system.lays_pose else _first_aiming(thing, places[0][0]) if thing in aimed else None
        for offset, (index, _) in enumerate(places):
            if old:
                thing.constraints[index].mute = old[min(offset, len(old) - 1)][1]
            if first is not None:
                thing.constraints.move(index, min(first + offset, len(thing.constraints) - 1))


def _is_aimed_afterwards(member):
    """Whether constraints that turn a member towards something are to act where its sinks have put it."""
    return "location" in member.channels and not (member.is_relative and "rotation" in member.channels)


def _first_aiming(thing, end):
    """Where the constraints before `end` begin that all aim at something."""
    while end and thing.constraints[end - 1].type in AIMING:
        end -= 1
    return end


def _lead(system, owner, obj):
    if obj != owner:
        of_owner(system, obj).leader = owner


def _wire_row(system, owner, group):
    """Give an owner a row of a shared hub, a new one if another owner is there to join it.

    Returns that other one, None where the hub was there, the owner itself where it is alone and was not wired.
    """
    uses_attribute = signature.uses_attribute(system)

    def reads_the_same(mesh):
        return solver_driver.reads_the_same(system, owner, mesh)

    hub = sharing.hub_for(system, owner, uses_attribute, reads_the_same)
    partner = None if hub else sharing.partner_for(system, owner, reads_the_same)
    is_new = hub is None
    if is_new and partner is None:
        return owner
    if is_new:
        hub = hub_lookup.new_hub(system.label)
        outbox.create_shared(system, hub.data, uses_attribute)
        for name, target in sharing.pointers(system, owner).items():
            hub.data[sharing.target_key(name)] = target
        copies.mark(hub.data)
    row = sharing.take(system, owner, hub)
    outputs.create_outlet(system, owner, hub.data)
    if is_new:
        solver_driver.add(system, owner, group, hub)
    active = owner.constraints.active
    sink = attribute_sink if uses_attribute else transform_sink
    sink.add(system, group, 0, hub, row)
    owner.constraints.active = active
    return partner


def detach(system, owner):
    """Remove everything attach() made; the owner's and members' own transforms, keys and constraints stay."""
    followers = readers.of(system, owner)
    _detach(system, owner)
    readers.point(system, owner, followers)
    if system.has_modifier:
        geometry_sink.remove(system, owner)
    override_drivers.align(owner)
    refresh_others(system, owner)


def _detach(system, owner):
    settings = of_owner(system, owner)
    drop_dead_copy(owner)
    override_drivers.drop_stand_ins(owner)
    remove(sinks(system, owner))
    remove_orphans(system, owner)
    for other in led_by(system, owner):
        of_owner(system, other).leader = None
        overrides.unmark(system, other)
    hubs = [hub for _, hub in hub_lookup.hubs(system, owner)]
    # A file may name one hub twice.
    own = list(dict.fromkeys([hub.data for hub in hubs if hub_lookup.is_own_hub(hub, owner)] + hub_lookup.lost_hubs(system, owner)))
    property_sink.remove(system, own)
    for mesh in [hub.data for hub in hubs if hub.data not in own]:
        property_sink.remove_copies(system, owner, mesh)
    read = set()
    for mesh in own:
        read.update(solver_driver.marked_by(mesh))
        bpy.data.meshes.remove(mesh)
    shared = hub_lookup.hub_of(system, owner)
    if shared and not shared.library and outbox.is_shared(system, shared.data):
        read.update(solver_driver.marked_by(shared.data))
        settings.hub = None  # by which the row is free
        sharing.prune(system, shared.data)
    for datablock in read:
        is_read = any(datablock in solver_driver.marked_by(mesh) for mesh in bpy.data.meshes if outbox.is_hub(mesh))
        if not is_read and not _is_wired(datablock):
            copies.unmark(datablock)
    settings.hub = None
    settings.more_hubs.clear()
    proxy_sink.release(settings)
    wait_key = signature.wait_key(system)
    drivers.remove_where(owner, lambda path: path.startswith((f'["{outbox.out_key(system)}', f'["{wait_key}"]')))
    owner.pop(wait_key, None)
    owner.pop(outbox.out_key(system), None)
    overrides.unmark(system, owner)
    waiting.release_proxy(settings)
    settings.is_active = False
    settings.wired = ""
    if not any(is_owner(one, owner) for one in systems()):
        copies.release(owner)
    drivers.drop_empty_animation(owner)
    owner.update_tag()


def _is_wired(datablock):
    """Whether it is the owner of any system."""
    return isinstance(datablock, bpy.types.Object) and any(is_owner(one, datablock) for one in systems())


def refresh(system, owner):
    """Wire again after a change of what is driven or read: targets, members, channels. What is linked stays as it is."""
    if owner.library or not is_owner(system, owner):
        return
    _refresh(system, owner)
    refresh_others(system, owner)


def _refresh(system, owner):
    if system.groups is not None:
        _follow_renamed(system, owner)
    _attach(system, owner, _stacks(system, owner))


def refresh_others(system, owner):
    """Wire the owner's other systems again whose groups depend on what has changed in this one."""
    if system.entries is None:
        return
    for other in systems():
        if other is not system and other.entries is not None and is_owner(other, owner):
            # The solvers of all other systems wait for the hubs of one that lays poses, which are new ones now.
            (refresh if system.lays_pose else refresh_changed)(other, owner)


def refresh_changed(system, owner):
    """Wire again where the groups are others than those wired, or their sinks have copies; returns whether they were."""
    is_same = of_owner(system, owner).wired == signature.signature(system, owner, groups_of(system, owner))
    if is_same and not has_strays(system, owner):
        return False
    _refresh(system, owner)
    return True


def refresh_edited(system, owner):
    """Wire again where bones have other names now, which the system is told, or more has changed."""
    if _renamed(system, owner):
        _refresh(system, owner)
    else:
        refresh_changed(system, owner)


def _renamed(system, owner):
    """(rig, old name, new name) of bones that were renamed since the owner was wired."""
    driven = [(owner, *names) for names in (*renamed_bones(system, owner), *property_sink.renamed_bones(system, owner))]
    return list(dict.fromkeys(driven + solver_driver.renamed_reads(system, owner)))


def _follow_renamed(system, owner):
    """Tell the system, as _refresh() does before it wires: until then the bones go on to count as renamed."""
    renamed = _renamed(system, owner) if system.bone_renamed else ()
    # By way of names that no bone has: bones may have exchanged theirs.
    steps = [(rig, old, f"\n{number}") for number, (rig, old, _) in enumerate(renamed)]
    steps += [(rig, f"\n{number}", new) for number, (rig, _, new) in enumerate(renamed)]
    if not steps:
        return
    settings = of_owner(system, owner)
    settings.is_active = False  # or settings that are given other names would have it wired in between
    try:
        for step in steps:
            system.bone_renamed(owner, *step)
    finally:
        settings.is_active = True
    for rig, old, new in steps:
        if rig == owner:
            _rename_paths(system, owner, old, new)


def _rename_paths(system, owner, old, new):
    """Let keys, in NLA strips too, and drivers of the settings of an entry, which is named like a bone, go on to animate it."""
    old, new = (f'["{bpy.utils.escape_identifier(name)}"]' for name in (old, new))
    prefix = of_owner(system, owner).path_from_id() + "."

    def names_it(path):
        return path.startswith(prefix) and old in path

    animation = owner.animation_data
    for curves in (*actions.own_curves(owner, names_it), animation.drivers if animation else ()):
        for curve in curves:
            if names_it(curve.data_path):
                curve.data_path = curve.data_path.replace(old, new)


def set_muted(system, owner, muted):
    """Switch the sinks off or on, leaving all else in place."""
    for _, constraint in sinks(system, owner):
        constraint.mute = muted
    for group in groups_of(system, owner) if system.groups is not None else ():
        hub = hub_lookup.hub_of(system, owner, group.key)
        if hub and hub_lookup.is_own_hub(hub, owner):
            property_sink.remove(system, [hub.data])
            property_sink.add(system, owner, group, hub, is_off=muted)


def touch(system, owner):
    """Let Blender evaluate the system again after a change of settings from Python."""
    if signature.has_strange_carriers(system, owner):
        refresh(system, owner)  # a copy, which was driven along with the first one until now
    elif not _tag(system, owner):
        refresh(system, owner)  # a member was deleted since


def _tag(system, owner):
    """Let Blender evaluate the owner and its hubs again; returns whether there are as many members as were wired."""
    owner.update_tag()
    for _, hub in hub_lookup.hubs(system, owner):
        hub.data.update_tag()
    hub = hub_lookup.hub_of(system, owner)
    if hub and outbox.is_shared(system, hub.data):
        return sharing.write(system, owner)
    if hub and system.member_data:
        # Reading a list of settings item by item in every solve would be dear where there are many members.
        data = [float(value) for value in system.member_data(owner)]
        if not outbox.has_room(hub.data, len(data)):
            return False
        hub.data[outbox.MEMBER_DATA_KEY] = data
    return True


def _stacks(system, owner):
    """For each driven Object or PoseBone, (place in its constraint stack, whether muted) of its sinks, in their order."""
    ours = {}
    for thing, constraint in sinks(system, owner):
        ours.setdefault(thing, []).append(constraint.name)
    return {
        thing: [(index, constraint.mute) for index, constraint in enumerate(thing.constraints) if constraint.name in names]
        for thing, names in ours.items()
    }
