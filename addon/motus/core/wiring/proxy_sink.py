"""Sinks for bones whose own channels are driven, where Blender has no Geometry Attribute constraint.

To Blender's dependency graph a bone's channels and the values of its constraints are one thing. A driver that brings the
solver's result to a constraint would have to come before the bone's own drivers, and after the solver, which needs what
those say. So the result takes a way round: a hidden empty, the *proxy*, is turned and scaled by drivers, and the bone
copies its transform on top of its own.
"""

import bpy

from ..system import Variable
from . import drivers, outbox

KEY = "motus_proxy"
"""Custom property of a proxy: the object whose bone copies it."""


def add(system, group, index, carrier):
    """Drive relative member `index` of the group by its slots of the carrier's outbox; returns the proxy."""
    member = group.members[index]
    bone = member.thing
    proxy = bpy.data.objects.new(f"Motus {system.label} {bone.name}", None)
    proxy[KEY] = bone.id_data
    slots = {"rotation": ("rotation_euler", outbox.pose_slot(group, index) + 3),
             "scale": ("scale", outbox.scale_slot(group, index))}
    id_type = 'OBJECT' if isinstance(carrier, bpy.types.Object) else 'MESH'
    for channel in sorted(member.channels):
        path, first = slots[channel]
        for axis in range(3):
            slot = Variable(id_type, carrier, outbox.out_path(system, first + axis, group.key))
            drivers.copy_value(proxy, path, slot, axis)
    constraint = bone.constraints.new('COPY_TRANSFORMS')
    constraint.name = f"Motus {system.label}"
    constraint.target = proxy
    constraint.owner_space = 'LOCAL'
    constraint.target_space = 'WORLD'
    constraint.mix_mode = 'AFTER_SPLIT'
    return proxy


def proxy_of(constraint):
    """The proxy that a constraint copies; None for any other constraint."""
    if constraint.type != 'COPY_TRANSFORMS' or constraint.target is None or KEY not in constraint.target:
        return None
    return constraint.target


def has_strange_proxies(obj):
    """Whether a rig was copied from another one and still hangs on its proxies."""
    proxies = (proxy_of(constraint) for bone in (obj.pose.bones if obj.pose else ()) for constraint in bone.constraints)
    return any(proxy.get(KEY) != obj for proxy in proxies if proxy)
