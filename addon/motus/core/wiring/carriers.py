"""Which datablock carries a group's solver and outbox, and the hubs among them."""

import re

import bpy

from .. import capabilities
from ..system import groups_of, of_owner, systems
from . import drivers, outbox, proxy_sink

OWN, HUB, ATTRIBUTE, POINTS = "own", "hub", "attribute", "points"
OURS = "motus_"
_OF_OBJECT = re.compile(r'(?:\w+|\["(?:[^"\\]|\\.)*"\])(?:\[\d+\])?$')
FEW = 24
"""Up to so many members a carrier of the owner's own is cheap enough; it goes along with copies, which a hub does not."""


def kinds(system, owner, groups):
    """For each of the groups of a system, which kind of carrier it is to have.

    OWN: the owner itself. HUB: the mesh of a hidden object. ATTRIBUTE: that too, and sinks that sample its attribute.
    POINTS: that too, for a system that moves the points of the owner's mesh.
    """
    if system.moves_points:
        return [POINTS] * len(groups)
    hub = ATTRIBUTE if capabilities.has_geometry_attribute_constraint() else HUB
    if system.groups is not None and not of_owner(system, owner).use_direct_drivers and _want_hubs(system, owner, groups):
        return [hub] * len(groups)
    return [hub if any(member.thing.id_data != owner for member in group.members) else OWN for group in groups]


def _want_hubs(system, owner, groups):
    """Whether an owner's groups need hubs: all of them or none.

    A hub waits for all that is driven on the owner, the outboxes that the owner carries itself included: one of each would
    make a loop where they read each other's bones.
    """
    systems = [one for one in systems() if one.groups is not None and not one.moves_points]
    if _drives_itself(owner) or any(drivers.has_driven_settings(owner, of_owner(one, owner)) for one in systems):
        return True
    if not capabilities.has_geometry_attribute_constraint():
        return False
    attached = [one for one in systems if one is not system and of_owner(one, owner).is_active]
    every = [*groups, *(group for one in attached for group in groups_of(one, owner))]
    # Of driven sinks a bone's own drivers cannot come first (see proxy_sink), of those that sample an attribute they can.
    return any(len(group.members) > FEW or drives_driven(owner, group) for group in every)


def _drives_itself(owner):
    """Whether somebody's driver sets a property of the object itself, such as its location.

    Blender evaluates drivers of one struct one after the other, outboxes among them, in an order that needs not be theirs
    (5.2: two outboxes and a driven location).
    """
    animation = owner.animation_data
    return animation is not None and any(
        _OF_OBJECT.match(curve.data_path) and not curve.data_path.startswith(f'["{OURS}') for curve in animation.drivers)


def drives_driven(owner, group):
    """Whether drivers of the owner set the own channels of one of its bones that the group drives."""
    driven = drivers.driven_bones(owner)
    return any(member.thing.name in driven for member in group.members)


def has_strange_carriers(system, owner):
    """Whether the owner was copied from another one and still hangs on its hubs or proxies."""
    return outbox.has_strange_hubs(system, owner) or (
        system.groups is not None and proxy_sink.has_strange_proxies(owner))


def make_hub(system, owner, group):
    """A new hub; returns its mesh."""
    mesh = bpy.data.meshes.new(" ".join(filter(None, ("Motus", system.label, owner.name, group.key))))
    hub = bpy.data.objects.new(mesh.name, mesh)
    hub.hide_render = hub.hide_viewport = True
    mesh[outbox.OWNER_KEY] = owner
    settings = of_owner(system, owner)
    if group.key:
        entry = settings.more_hubs.add()
        entry.name, entry.object = group.key, hub
    else:
        settings.hub = hub
    return mesh


def signature(system, owner, groups):
    """A line that changes when the groups of a system that declares them, or their carriers, do."""
    if system.groups is None:
        return ""
    driven = drivers.driven_bones(owner)
    return repr([(group.key, kind, group.outputs, sorted(group.data.items()),
                  [(_name(member.thing.id_data, owner), member.thing.name, sorted(member.channels), member.space,
                    member.is_relative, member.thing.name in driven) for member in group.members],
                  [(type(one).__name__, _name(one.object, owner), one.bone) for one in group.inputs])
                 for group, kind in zip(groups, kinds(system, owner, groups))])


def _name(obj, owner):
    # A copy is wired as the one it was copied from.
    return "" if obj == owner else obj.name
