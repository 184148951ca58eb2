"""Copy Transforms constraints with proxies as sinks, for Blender versions without the Geometry Attribute constraint.

These sinks serve relative objects, and relative bones whose own channels have drivers. Relative means that the result is applied on top
of the member's own transform, not in place of it.

In Blender's dependency graph, a bone's channels and the values of its constraints are one node. A driver that brings the solver's
result to a constraint would have to come before the bone's own drivers, and also after the solver, which reads what they set. So a
hidden empty, the *proxy*, is moved, rotated and scaled by drivers, and the bone copies the proxy's transform on top of its own. A
relative object has a proxy whether or not its channels have drivers, unless the system requires equal matrices in all versions of
Blender (same_bits): Copy Transforms keeps a negative scale, which a Transformation constraint does not.

A constraint does not count as a user of its target, so the owner's settings also point to the proxies.

A member is an object or bone that is driven. The results are in the outbox, an array on the mesh of a hidden object, the hub.
"""

import bpy

from ...blender import drivers, helpers
from ...declare import Variable
from ...file.pointers import pointed
from ..hubs import marks, outbox, traits


def is_needed(system, member, driven_bones):
    """Whether a member needs a proxy as sink: a hidden empty that drivers move and whose transform the member copies.

    A relative bone (result applied on top of its own transform) needs one if its own location, rotation or scale has a driver. A relative
    object needs one unless the system requires equal matrices in all versions of Blender (same_bits). driven_bones: names of the owner's
    bones whose own channels have drivers.
    """
    if isinstance(member.thing, bpy.types.PoseBone):
        return member.is_relative and member.thing.name in driven_bones
    return member.is_relative and traits.may_use_proxies(system)


def add(system, settings, group, index, hub):
    """Drive a relative member (result applied on top of its own transform) by a proxy, a hidden empty whose transform it copies.

    Drivers of the proxy read the member's slots of the hub's outbox. index: index of the member in the group. settings: settings of the
    owner, which get a pointer that keeps the proxy in the file.
    """
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
    # The item gets a name because library overrides identify items by it.
    entry = settings.targets.add()
    entry.name, entry.object = name, proxy
    if settings.id_data.override_library:
        # Blender does not save this pointer of an override, so the proxy gets a fake user.
        proxy.use_fake_user = True


def release(settings):
    """Remove the pointers to proxies from an owner's settings, and remove from the file each proxy that nothing else uses.

    Proxies are hidden empties that bring a result to a member.
    """
    kept = {pointed(entry, "object") for entry in settings.targets} - {None}
    settings.targets.clear()
    for one in kept:
        if one.users == int(one.use_fake_user) and one.library is None:
            bpy.data.objects.remove(one)


def proxy_of(constraint):
    """Return the proxy, a hidden empty moved by drivers, whose transform a member's constraint copies; None if it copies none."""
    if constraint.type != 'COPY_TRANSFORMS' or constraint.target is None or marks.PROXY_KEY not in constraint.target:
        return None
    return constraint.target


def has_strange_proxies(obj):
    """Whether constraints on an object, or on its bones, copy proxies that were made for a different object.

    A proxy is a hidden empty that brings a result to a member. Such constraints were copied with this object from the different one.
    """
    things = (obj, *(obj.pose.bones if obj.pose else ()))
    proxies = (proxy_of(constraint) for thing in things for constraint in thing.constraints)
    return any(proxy.get(marks.PROXY_KEY) != obj for proxy in proxies if proxy)
