"""Sinks for every Blender: constraints that read the outbox.

Absolute ones are Limit constraints with min = max, or Transformation where there are many; relative ones Transformation.
Their drivers only copy slots of the outbox, which takes no Python.
"""

import re

import bpy

from .. import capabilities
from ..system import Variable
from . import drivers, outbox

AXES = "xyz"
LIMITS = ("min_{}", "max_{}")
_KINDS = {'LIMIT_LOCATION', 'LIMIT_ROTATION', 'LIMIT_SCALE', 'TRANSFORM'}


def add(system, group, index, carrier, target=None, direct=None):
    """Drive member `index` of the group by its slots of the carrier's outbox.

    target: the hub object or the anchor, for Transformation constraints. direct: (expression, variables) drives the sinks
    without the outbox (see motus_direct).
    """
    member = group.members[index]
    pose, scale = outbox.pose_slot(group, index), outbox.scale_slot(group, index)
    make = _relative if member.is_relative else _absolute
    # Influence costs a driver, and relative sinks need none: neutral values do nothing. But an expression that cannot be
    # evaluated is 0, which is no neutral scale.
    for channel, slot in (("location", pose), ("rotation", pose + 3), ("scale", scale)):
        if channel not in member.channels:
            continue
        constraint, paths = make(system, member, channel, target)
        for axis, letter in enumerate(AXES):
            for path in paths:
                _drive(constraint, path.format(letter), system, group, carrier, slot + axis, direct)
        if not member.is_relative or direct:
            _drive(constraint, "influence", system, group, carrier, outbox.WEIGHT, direct)


def _absolute(system, member, channel, target):
    # Drivers are what many members cost, and Transformation needs half as many; but it loses a negative scale, which Limit
    # Location alone keeps.
    if target is not None and "rotation" in member.channels:
        return _mapped(system, member, channel, target, 'REPLACE')
    return _LIMITS[channel](system, member)


def _relative(system, member, channel, target):
    return _mapped(system, member, channel, target, {"rotation": 'AFTER', "scale": 'MULTIPLY'}[channel])


def _mapped(system, member, channel, target, mode):
    """A Transformation constraint that maps an empty range of the target's location, so that its least value counts."""
    constraint = _new(system, member, 'TRANSFORM', channel)
    constraint.target = target
    constraint.owner_space = 'LOCAL' if member.is_relative else member.space
    constraint.map_from = 'LOCATION'
    constraint.map_to = channel.upper()
    if channel == "location":
        constraint.mix_mode = mode
        return constraint, ("to_min_{}",)
    if channel == "scale":
        constraint.mix_mode_scale = mode
        return constraint, ("to_min_{}_scale",)
    constraint.mix_mode_rot = mode
    constraint.to_euler_order = 'XYZ'
    return constraint, ("to_min_{}_rot",)


def _limit_location(system, member):
    constraint = _new(system, member, 'LIMIT_LOCATION', "location")
    _switch_on(constraint, ("use_min_{}", "use_max_{}"))
    return constraint, LIMITS


def _limit_rotation(system, member):
    constraint = _new(system, member, 'LIMIT_ROTATION', "rotation")
    constraint.euler_order = 'XYZ'
    if capabilities.has_limit_rotation_legacy_flag():
        # The old behaviour is a plain clamp: exact where min = max.
        constraint.use_legacy_behavior = True
    _switch_on(constraint, ("use_limit_{}",))
    return constraint, LIMITS


def _limit_scale(system, member):
    constraint = _new(system, member, 'LIMIT_SCALE', "scale")
    _switch_on(constraint, ("use_min_{}", "use_max_{}"))
    return constraint, LIMITS


_LIMITS = {"location": _limit_location, "rotation": _limit_rotation, "scale": _limit_scale}


def is_called(constraint, name):
    """Whether a constraint has a name, or that with a number after it, as Blender gives."""
    return re.fullmatch(re.escape(name) + r"(\.\d{3,})?", constraint.name) is not None


def is_named(system, constraint):
    """Whether a constraint is called and made like one of these."""
    return constraint.type in _KINDS and any(
        is_called(constraint, _name(system, channel)) for channel in _LIMITS)


def _name(system, channel):
    return f"Motus {system.label} {channel.title()}"


def _new(system, member, kind, channel):
    constraint = member.thing.constraints.new(kind)
    constraint.name = _name(system, channel)
    constraint.owner_space = member.space
    return constraint


def _switch_on(constraint, switches):
    for letter in AXES:
        for switch in switches:
            setattr(constraint, switch.format(letter), True)


def _drive(constraint, path, system, group, carrier, slot, direct):
    if direct is None:
        id_type = 'OBJECT' if isinstance(carrier, bpy.types.Object) else 'MESH'
        drivers.copy_value(constraint, path, Variable(id_type, carrier, outbox.out_path(system, slot, group.key)))
    else:
        expression, variables = direct
        drivers.add(constraint, path, expression.format(slot=slot), variables, use_self=True)
