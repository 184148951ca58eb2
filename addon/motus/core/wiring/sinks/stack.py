"""Choose the kind of sink for each member, and the position of the sinks among the member's constraints.

A sink is a constraint that brings a solver's result to a member, an object or bone that the owner drives.

The results come from the hub, a hidden object whose mesh carries the solver's driver.
"""

from ...blender import drivers
from ...declare import laying_systems, of_owner
from ..hubs import traits
from . import attribute_sink, finding, geometry_sink, property_sink, proxy_sink, transform_sink

AIMING = {'TRACK_TO', 'DAMPED_TRACK', 'LOCKED_TRACK'}


def add(system, owner, group, part):
    """Add the sinks of a group: drivers of its properties, and the modifier of the owner or the constraints of the members.

    Each driven object that is not the owner gets, in its settings, a pointer to the owner, named `leader`. part: Part of the owner in the
    hub that computes the group.
    """
    settings = of_owner(system, owner)
    property_sink.add(system, owner, group, part.hub, is_off=settings.is_baked)
    led = [one.object for one in group.properties]
    if system.has_modifier:
        geometry_sink.prepare(system, part.mesh, settings)
        geometry_sink.add(system, owner, part.hub)
    else:
        _add_constraints(system, owner, group, part)
        led += [member.thing.id_data for member in group.members]
    for obj in led:
        if obj != owner:
            of_owner(system, obj).leader = owner


def _add_constraints(system, owner, group, part):
    """Add the constraints that drive the members of a group. The active constraint of each member stays active."""
    uses_attribute, driven = traits.uses_attribute(system), drivers.driven_bones(owner)
    if uses_attribute:
        attribute_sink.prepare(system, group, part)
    for index, member in enumerate(group.members):
        active = member.thing.constraints.active
        if uses_attribute:
            attribute_sink.add(system, group, index, part)
        elif proxy_sink.is_needed(system, member, driven):
            proxy_sink.add(system, of_owner(system, owner), group, index, part.hub)
        else:
            transform_sink.add(system, group, index, part)
        member.thing.constraints.active = active


def places(system, owner):
    """Return {Object or PoseBone: [(index among its constraints, whether muted) for each sink]} for all members of an owner.

    The sinks of a member are in the order of its constraints.
    """
    ours = {}
    for thing, constraint in finding.sinks(system, owner):
        ours.setdefault(thing, []).append(constraint.name)
    return {
        thing: [(index, constraint.mute) for index, constraint in enumerate(thing.constraints) if constraint.name in names]
        for thing, names in ours.items()
    }


def order(system, owner, groups, before):
    """Move new sinks, which were added behind all other constraints, to the right positions among the constraints of each member.

    before: result of places() for the earlier wiring, from which sinks get their earlier indices and mute states. If a member had no sinks,
    its new sinks stay last, with two exceptions. Sinks of a system that lays poses (sets the bones' own transforms, as keys do) come first.
    Sinks that change the member's location come before the constraints at the end of its stack that aim the member at something.
    """
    aimed = {member.thing for group in groups for member in group.members if _is_aimed_afterwards(member)}
    for thing, found in places(system, owner).items():
        old = before.get(thing)
        first = old[0][0] if old else 0 if system in laying_systems() else _first_aiming(thing, found[0][0]) if thing in aimed else None
        for offset, (index, _) in enumerate(found):
            if old:
                thing.constraints[index].mute = old[min(offset, len(old) - 1)][1]
            if first is not None:
                thing.constraints.move(index, min(first + offset, len(thing.constraints) - 1))


def _is_aimed_afterwards(member):
    """Whether constraints that aim a member at something have to act after the member's sinks, because the sinks move the member."""
    return "location" in member.channels and not (member.is_relative and "rotation" in member.channels)


def _first_aiming(thing, end):
    """Return the index of the first of the consecutive aiming constraints (AIMING) that stand directly before the index `end`.

    thing: object or pose bone with the constraints. The result is `end` if no aiming constraint stands there.
    """
    while end and thing.constraints[end - 1].type in AIMING:
        end -= 1
    return end
