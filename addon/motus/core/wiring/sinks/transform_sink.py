"""Transformation constraints as sinks, for Blender versions without the Geometry Attribute constraint.

A sink brings a solver's result to a member, an object or bone that the owner drives. Drivers copy the numbers from the outbox, the array of
results on a hub's mesh, to the constraint; they need no Python. An absolute member (result applied in place of its own transform) without
rotation has a Limit Location constraint with min = max instead: this keeps a negative scale and shear, which a Transformation constraint
loses. A relative member is one whose result is applied on top of its own transform.
"""

from ...blender import drivers
from ...declare import Variable
from ..hubs import marks, outbox

AXES = "xyz"
LIMITS = ("min_{}", "max_{}")


def add(system, group, index, part):
    """Add the constraints that drive a member of a group, with drivers that read the member's slots of the hub's outbox.

    index: index of the member. part: Part of the owner in the hub.
    """
    member, hub, first = group.members[index], part.hub, part.first
    pose, scale = first + outbox.pose_slot(group, index), first + outbox.scale_slot(group, index)
    for channel, slot in (("location", pose), ("rotation", pose + 3), ("scale", scale)):
        if channel not in member.channels:
            continue
        is_limit = not member.is_relative and "rotation" not in member.channels and channel == "location"
        constraint, paths = _limit(member) if is_limit else _mapped(member, channel, hub)
        constraint.name = marks.name(system, channel)
        marks.put(constraint, hub, part.row + index)
        for axis, letter in enumerate(AXES):
            for path in paths:
                _drive(constraint, path.format(letter), system, group, hub, slot + axis)
        # Relative sinks do without a driver on their influence: neutral values change nothing.
        if not member.is_relative:
            _drive(constraint, "influence", system, group, hub, first + outbox.WEIGHT)


def _mapped(member, channel, hub):
    """Add to a member a Transformation constraint for one channel: "location", "rotation" or "scale".

    Its input range is empty, so that the minimum of its output range is always applied. Returns (constraint, data paths of this minimum,
    with {} in place of the axis).
    """
    constraint = member.thing.constraints.new('TRANSFORM')
    constraint.target = hub
    constraint.owner_space = member.owner_space
    constraint.map_from = 'LOCATION'
    constraint.map_to = channel.upper()
    if channel == "location":
        constraint.mix_mode = 'ADD' if member.is_relative else 'REPLACE'
        return constraint, ("to_min_{}",)
    if channel == "scale":
        constraint.mix_mode_scale = 'MULTIPLY' if member.is_relative else 'REPLACE'
        return constraint, ("to_min_{}_scale",)
    constraint.mix_mode_rot = 'AFTER' if member.is_relative else 'REPLACE'
    constraint.to_euler_order = 'XYZ'
    return constraint, ("to_min_{}_rot",)


def _limit(member):
    constraint = member.thing.constraints.new('LIMIT_LOCATION')
    constraint.owner_space = member.owner_space
    for letter in AXES:
        for switch in ("use_min_{}", "use_max_{}"):
            setattr(constraint, switch.format(letter), True)
    return constraint, LIMITS


def _drive(constraint, path, system, group, hub, slot):
    drivers.copy_value(constraint, path, Variable('MESH', hub.data, outbox.out_path(system, slot, group.key)))
