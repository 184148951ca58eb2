"""Which kind of sink a member is given, and where in its stack of constraints the sinks stand."""

from ...blender import drivers
from ...declare import of_owner
from . import attribute_sink, finding, geometry_sink, property_sink, proxy_sink, transform_sink

AIMING = {'TRACK_TO', 'DAMPED_TRACK', 'LOCKED_TRACK'}


def prepare(system, owner, group, hub):
    """Give a hub's mesh what the sinks of a group will read there, besides the outbox. Called before there are sinks."""
    if attribute_sink.serves(system):
        attribute_sink.prepare(system, hub.data, owner, group)
    elif system.has_modifier:
        geometry_sink.prepare(system, hub.data, of_owner(system, owner))


def add(system, owner, group, hub):
    """Let all that a group drives follow the hub: properties, and the owner's points or the members."""
    property_sink.add(system, owner, group, hub, is_off=of_owner(system, owner).is_baked)
    led = [one.object for one in group.properties]
    if system.has_modifier:
        geometry_sink.add(system, owner, hub)
    else:
        add_constraints(system, owner, group, hub)
        led += [member.thing.id_data for member in group.members]
    for obj in led:
        if obj != owner:
            of_owner(system, obj).leader = owner


def add_constraints(system, owner, group, hub, row=None):
    """Give each member of a group its sinks; row: the owner's, if the hub is shared. The user's active constraints stay active."""
    driven = drivers.driven_bones(owner)
    for index, member in enumerate(group.members):
        active = member.thing.constraints.active
        if attribute_sink.serves(system):
            attribute_sink.add(system, group, index, hub, row)
        elif proxy_sink.is_needed(system, member, driven):
            proxy_sink.add(system, of_owner(system, owner), group, index, hub)
        else:
            transform_sink.add(system, group, index, hub, row)
        member.thing.constraints.active = active


def places(system, owner):
    """For each driven Object or PoseBone, (place in its constraint stack, whether muted) of its sinks, in their order."""
    ours = {}
    for thing, constraint in finding.sinks(system, owner):
        ours.setdefault(thing, []).append(constraint.name)
    return {
        thing: [(index, constraint.mute) for index, constraint in enumerate(thing.constraints) if constraint.name in names]
        for thing, names in ours.items()
    }


def order(system, owner, groups, before):
    """Move sinks, which were added behind all other constraints, to where they were, or to where new ones belong.

    before: what places() said when the owner was last wired.
    """
    aimed = {member.thing for group in groups for member in group.members if _is_aimed_afterwards(member)}
    for thing, found in places(system, owner).items():
        old = before.get(thing)
        first = old[0][0] if old else 0 if system.lays_pose else _first_aiming(thing, found[0][0]) if thing in aimed else None
        for offset, (index, _) in enumerate(found):
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
