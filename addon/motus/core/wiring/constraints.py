"""Constraints added and removed while the user's active one stays active."""


def add(thing, kind):
    """A new constraint of an Object or PoseBone."""
    active = thing.constraints.active
    constraint = thing.constraints.new(kind)
    thing.constraints.active = active
    return constraint


def remove(thing, constraint):
    """Remove one of them."""
    active = thing.constraints.active
    is_active = active == constraint
    thing.constraints.remove(constraint)
    thing.constraints.active = None if is_active else active
