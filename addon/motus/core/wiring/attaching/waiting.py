"""Make Blender evaluate what a solver reads before the solver: many transforms by one driver variable, and final geometry.

Transforms: the hub, the hidden object with the solver's driver, gets a muted constraint for each. A muted constraint moves and computes
nothing, but Blender evaluates its target, an object or bone, before the transform of the object that carries the constraint. The
solver's driver has a variable that reads the hub's transform.

Geometry: a Follow Path or Shrinkwrap constraint at influence 0 also moves nothing, but makes Blender evaluate its target's geometry
before the transform of the hidden empty that carries the constraint, the *order proxy*.

The settings are those of an owner, the object for which a system is solved.
"""

import bpy

from ...blender import helpers
from ...declare import Deformed, Variable
from ...file.pointers import pointed

_WAITING = {'CURVE': 'FOLLOW_PATH', 'MESH': 'SHRINKWRAP', 'EMPTY': 'COPY_LOCATION', 'ARMATURE': 'COPY_LOCATION'}
"""Type of an object -> type of the constraint that waits for the object's geometry, or for its transform if it has no geometry."""
_WAIT = frozenset(_WAITING.values())


def geometries(system, settings):
    """Return the objects whose evaluated geometry a system reads, each once. settings: the owner's settings, which name the objects."""
    named = (obj for declared in system.inputs if isinstance(declared, Deformed) for obj in declared.objects(settings))
    return list(dict.fromkeys(obj for obj in named if obj and obj.type in _WAITING))


def waited_for(settings):
    """Return {original object: evaluated object} for the objects whose geometry Blender evaluates before a solver.

    These are the targets of the owner's order proxy (hidden object that makes Blender evaluate geometries before the solver). settings:
    evaluated settings of the owner, with which the solver was called.
    """
    proxy = pointed(settings, "order_proxy")
    return {one.original: one for one in _waits_for(proxy) if one} if proxy else {}


def is_stale(system, settings):
    """Whether the order proxy of an owner waits for objects different from those whose geometry the system reads now.

    The order proxy is the hidden object that makes Blender evaluate geometries before the solver. settings: settings of the owner.
    """
    proxy = pointed(settings, "order_proxy")
    return (_waits_for(proxy) if proxy else []) != geometries(system, settings)


def set_proxy(system, settings):
    """Store in an owner's settings a pointer to an order proxy for the geometries that the system reads, if it reads any.

    An order proxy is a hidden object that makes Blender evaluate the geometries before the solver. Owners that read the same objects share
    one order proxy.
    """
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
    """Clear an owner's pointer to its order proxy, and remove the proxy from the file if nothing else uses it.

    The order proxy is the hidden object that makes Blender evaluate geometries before the solver. settings: settings of the owner.
    """
    proxy = pointed(settings, "order_proxy")
    settings.property_unset("order_proxy")
    if proxy and proxy.users == 0:
        bpy.data.objects.remove(proxy)


def _waits_for(candidate):
    return [one.target for one in candidate.constraints if one.type in _WAIT and one.influence == 0.0]


def wait_for(hub, transforms):
    """Make Blender evaluate objects and bones before the transform of a hub object, by muted constraints on the hub.

    transforms: pairs (object, name of a bone or ""). Returns the Variable with which a driver waits for the hub's transform.
    """
    for thing, bone in transforms:
        constraint = hub.constraints.new('COPY_LOCATION')
        constraint.mute = True
        constraint.target = thing
        constraint.subtarget = bone
    return Variable('OBJECT', hub)


def waits(hub):
    """Return the pairs (object, name of a bone or "") that Blender evaluates before the transform of a hub object.

    They are the targets of the hub's muted constraints.
    """
    return [
        (constraint.target, constraint.subtarget)
        for constraint in hub.constraints
        if constraint.mute and constraint.type == 'COPY_LOCATION'
    ]
