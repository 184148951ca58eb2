"""Sinks for relative objects, and for bones whose own channels are driven, where Blender has no Geometry Attribute constraint.

To Blender's dependency graph a bone's channels and the values of its constraints are one thing. A driver that brings the
solver's result to a constraint would have to come before the bone's own drivers, and after the solver, which needs what
those say. So the result takes a way round: a hidden empty, the *proxy*, is turned and scaled by drivers, and the bone
copies its transform on top of its own. An object does so whatever drives it: unlike Transformation, Copy Transforms keeps a
negative scale.

A constraint does not count as a user of its target, so the owner's settings point to the proxies too.
"""

import bpy

from ...blender import drivers, helpers
from ...declare import Variable
from ...file.pointers import pointed
from ..hubs import marks, outbox


def is_needed(system, member, driven_bones):
    """Whether a member has to have a proxy. driven_bones: names of the owner's bones whose own channels are driven."""
    if isinstance(member.thing, bpy.types.PoseBone):
        return member.is_relative and member.thing.name in driven_bones
    return member.is_relative and not system.same_bits


def add(system, settings, group, index, hub):
    """Drive relative member `index` of the group by its slots of the hub's outbox. settings: keep the proxy alive."""
    member = group.members[index]
    thing = member.thing
    proxy = helpers.make(f"{marks.name(system)} {thing.name}")
    proxy[marks.PROXY_KEY] = thing.id_data
    pose = outbox.pose_slot(group, index)
    slots = {"location": ("location", pose), "rotation": ("rotation_euler", pose + 3), "scale": ("scale", outbox.scale_slot(group, index))}
    for channel in sorted(member.channels):
        path, first = slots[channel]
        for axis in range(3):
            drivers.copy_value(proxy, path, Variable('MESH', hub.data, outbox.out_path(system, first + axis, group.key)), axis)
    constraint = thing.constraints.new('COPY_TRANSFORMS')
    constraint.name = marks.name(system)
    marks.put(constraint, hub, index)
    constraint.target = proxy
    constraint.owner_space = member.owner_space
    constraint.target_space = 'WORLD'
    constraint.mix_mode = 'AFTER_SPLIT'
    _keep(settings, thing.name, proxy)


def _keep(settings, name, proxy):
    # By the name overrides know the entry.
    entry = settings.targets.add()
    entry.name, entry.object = name, proxy
    if settings.id_data.override_library:
        # What an override points to from here, Blender does not save.
        proxy.use_fake_user = True


def release(settings):
    """Let go of the hidden objects; the last one to do so removes them."""
    kept = {pointed(entry, "object") for entry in settings.targets} - {None}
    settings.targets.clear()
    for one in kept:
        if one.users == int(one.use_fake_user) and one.library is None:
            bpy.data.objects.remove(one)


def proxy_of(constraint):
    """The proxy that a constraint copies; None for any other constraint."""
    if constraint.type != 'COPY_TRANSFORMS' or constraint.target is None or marks.PROXY_KEY not in constraint.target:
        return None
    return constraint.target


def has_strange_proxies(obj):
    """Whether an object was copied from another one and still hangs, or its bones do, on its proxies."""
    things = (obj, *(obj.pose.bones if obj.pose else ()))
    proxies = (proxy_of(constraint) for thing in things for constraint in thing.constraints)
    return any(proxy.get(marks.PROXY_KEY) != obj for proxy in proxies if proxy)
