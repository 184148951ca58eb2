"""How a hub's solver waits for many transforms at the price of one driver variable.

A muted constraint moves nothing and computes nothing, but its target, an object of any type or a bone, is evaluated
before the hub's transform; a driver that declares that transform is evaluated later still.
"""

from ...declare import Variable


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
    return [(constraint.target, constraint.subtarget) for constraint in hub.constraints
            if constraint.mute and constraint.type == 'COPY_LOCATION']
