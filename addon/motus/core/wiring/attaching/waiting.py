"""How a solver waits for what it reads: for many transforms at the price of one driver variable, and for final geometry.

A muted constraint moves nothing and computes nothing, but its target, an object of any type or a bone, is evaluated before
the transform of the object that carries the constraint; a driver that declares that transform is evaluated later still.
A Follow Path or Shrinkwrap constraint at influence 0 also moves nothing, but makes Blender evaluate its target's geometry
before the transform of the empty that carries it, the *order proxy*.
"""

import bpy

from ...blender import helpers
from ...declare import Deformed, Variable
from ...file.pointers import pointed

_WAITING = {'CURVE': 'FOLLOW_PATH', 'MESH': 'SHRINKWRAP', 'EMPTY': 'COPY_LOCATION'}
"""Type of an object -> of the constraint that waits for its geometry, or, where it has none, for its transform."""
_WAIT = frozenset(_WAITING.values())


def geometries(system, settings):
    """The objects whose geometry the system reads as it is evaluated."""
    named = (obj for declared in system.inputs if isinstance(declared, Deformed) for obj in declared.objects(settings))
    return list(dict.fromkeys(obj for obj in named if obj and obj.type in _WAITING))


def waited_for(settings):
    """{original: evaluated} of the objects that come before a solver, of the evaluated settings that it was called with."""
    proxy = pointed(settings, "order_proxy")
    return {one.original: one for one in _waits_for(proxy) if one} if proxy else {}


def is_stale(system, settings):
    """Whether the proxy waits for other objects than it would have to now."""
    proxy = pointed(settings, "order_proxy")
    return (_waits_for(proxy) if proxy else []) != geometries(system, settings)


def set_proxy(system, settings):
    """Note the proxy that waits for the geometries, if there are any: all who read the same share one."""
    targets = geometries(system, settings)
    if targets:
        settings.order_proxy = _proxy_for(targets)


def _proxy_for(targets):
    for candidate in bpy.data.objects:
        if helpers.is_helper(candidate) and candidate.library is None and _waits_for(candidate) == targets:
            return candidate
    proxy = helpers.make(f"Motus Order {targets[0].name}")
    for target in targets:
        constraint = proxy.constraints.new(_WAITING[target.type])
        constraint.target = target
        constraint.influence = 0.0
    return proxy


def release_proxy(settings):
    """Unset the order proxy in the settings, and remove its object from the file if nothing else uses it."""
    proxy = pointed(settings, "order_proxy")
    settings.property_unset("order_proxy")
    if proxy and proxy.users == 0:
        bpy.data.objects.remove(proxy)


def _waits_for(candidate):
    return [one.target for one in candidate.constraints if one.type in _WAIT and one.influence == 0.0]


def wait_for(hub, transforms):
    """Let the hub's transform come after those of (object, bone or "") pairs. Returns the Variable that waits for it."""
    for thing, bone in transforms:
        constraint = hub.constraints.new('COPY_LOCATION')
        constraint.mute = True
        constraint.target = thing
        constraint.subtarget = bone
    return Variable('OBJECT', hub)


def waits(hub):
    """The pairs that it waits for."""
    return [
        (constraint.target, constraint.subtarget)
        for constraint in hub.constraints
        if constraint.mute and constraint.type == 'COPY_LOCATION'
    ]
