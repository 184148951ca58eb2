"""Sinks for every Blender: constraints that read the outbox, Limit Location and Limit Rotation with min = max, or
Transformation where there are many.

Their drivers only copy slots of the outbox, which takes no Python.
"""

import bpy

from .. import capabilities
from ..system import Variable
from . import drivers, outbox

AXES = "xyz"
LIMITS = ("min_{}", "max_{}")


def add(system, target, carrier, member, channels, direct=None, hub=None):
    """Drive `target` (Object or PoseBone) by slot block `member` of the carrier's outbox.

    direct: (expression, variables) drives the sinks without the outbox (see motus_direct). hub: object of the carrier,
    where it is one for many members.
    """
    base = outbox.pose_base(system, member)
    # Drivers are what many members cost, and Transformation needs half as many; but it loses a negative scale,
    # which Limit Location alone keeps.
    mapped = hub is not None and "rotation" in channels
    made = []
    if "location" in channels:
        made.append((*(_mapped(target, system, hub, 'LOCATION') if mapped else _limit_location(target, system)), base))
    if "rotation" in channels:
        made.append((*(_mapped(target, system, hub, 'ROTATION') if mapped else _limit_rotation(target, system)), base + 3))
    for constraint, paths, first in made:
        for axis, letter in enumerate(AXES):
            for path in paths:
                _drive(constraint, path.format(letter), system, carrier, first + axis, direct)
        _drive(constraint, "influence", system, carrier, outbox.WEIGHT, direct)


def _mapped(target, system, hub, channel):
    """A Transformation constraint that maps an empty range of the hub's location, so that its least value counts."""
    constraint = target.constraints.new('TRANSFORM')
    constraint.name = f"Motus {system.label} {channel.title()}"
    constraint.target = hub
    constraint.owner_space = system.space
    constraint.map_from = 'LOCATION'
    constraint.map_to = channel
    if channel == 'LOCATION':
        constraint.mix_mode = 'REPLACE'
        return constraint, ("to_min_{}",)
    constraint.mix_mode_rot = 'REPLACE'
    constraint.to_euler_order = 'XYZ'
    return constraint, ("to_min_{}_rot",)


def _limit_location(target, system):
    constraint = target.constraints.new('LIMIT_LOCATION')
    constraint.name = f"Motus {system.label} Location"
    constraint.owner_space = system.space
    for letter in AXES:
        setattr(constraint, "use_min_" + letter, True)
        setattr(constraint, "use_max_" + letter, True)
    return constraint, LIMITS


def _limit_rotation(target, system):
    constraint = target.constraints.new('LIMIT_ROTATION')
    constraint.name = f"Motus {system.label} Rotation"
    constraint.owner_space = system.space
    constraint.euler_order = 'XYZ'
    if capabilities.has_limit_rotation_legacy_flag():
        # The old behaviour is a plain clamp: exact where min = max.
        constraint.use_legacy_behavior = True
    for letter in AXES:
        setattr(constraint, "use_limit_" + letter, True)
    return constraint, LIMITS


def _slot(system, carrier, index):
    id_type = 'OBJECT' if isinstance(carrier, bpy.types.Object) else 'MESH'
    return Variable(id_type, carrier, outbox.out_path(system, index))


def _drive(constraint, path, system, carrier, index, direct):
    if direct is None:
        drivers.copy_value(constraint, path, _slot(system, carrier, index))
    else:
        expression, variables = direct
        drivers.add(constraint, path, expression.format(slot=index), variables, use_self=True)
