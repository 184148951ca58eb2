"""Owners wired as version 1 of the wiring did it where no hub was needed.

Solver and outbox on the owner itself, Limit and Transformation constraints on what it drives, an anchor. Files may still
hold such.
"""

import json

import bpy

import support

groups_of = support.addon("core.declare").groups_of
outbox = support.addon("core.wiring.hubs.outbox")
drivers = support.addon("core.blender.drivers")
wiring = support.addon("core.wiring")
system_module = support.addon("core.declare")
WEIGHT = 1


def rewire(system, owner):
    """Replace what is wired on an owner by what the old version made; its groups have to be one."""
    wiring.detach(system, owner)
    (group,) = groups_of(system, owner)
    settings = getattr(owner.motus, system.name)
    settings.is_active = True
    settings.wired = ""
    _add_outbox(system, owner, group)
    _add_solver(system, owner, group)
    anchor = _anchor(settings) if any(member.is_relative for member in group.members) else None
    for index, member in enumerate(group.members):
        for channel, slot in (
            ("location", outbox.pose_slot(group, index)),
            ("rotation", outbox.pose_slot(group, index) + 3),
            ("scale", outbox.scale_slot(group, index)),
        ):
            if channel in member.channels:
                _add_sink(system, owner, member, channel, slot, anchor)
    owner.update_tag()


def _add_outbox(system, owner, group):
    scales = 3 * len(group.members) if any("scale" in member.channels for member in group.members) else 0
    owner[f"motus_{system.name}_out"] = [-2.0] + [0.0] * (1 + len(group.outputs) + 6 * len(group.members)) + [1.0] * scales
    if system.groups is not None:
        noted = [
            group.outputs,
            [member.thing.name for member in group.members],
            bool(scales),
            any(member.is_relative for member in group.members),
            False,
            group.data,
            [bone for _, bone in group.reads],
        ]
        owner[f"motus_{system.name}_info"] = {"version": 1, "text": json.dumps(noted)}


def _add_solver(system, owner, group):
    arguments, variables = [""], {}
    for index, (_, variable) in enumerate(system_module.input_variables(system, owner)):
        arguments.append(f"v{index}" if variable else "0")
        if variable:
            variables[f"v{index}"] = variable
    for index, one in enumerate(dict.fromkeys(group.inputs)):
        if isinstance(one, system_module.Transform):
            variables[f"w{index}"] = one.variable()
    call = f'motus_solve(self,"{system.name}",frame,depsgraph{",".join(arguments)})'
    drivers.add(owner, f'["motus_{system.name}_out"]', call, variables, index=0, use_self=True)


def _anchor(settings):
    anchor = bpy.data.objects.new("Motus Anchor", None)
    anchor["motus_anchor"] = True
    entry = settings.targets.add()
    entry.name, entry.object = anchor.name, anchor
    return anchor


def _add_sink(system, owner, member, channel, slot, anchor):
    made = member.thing.constraints.new('TRANSFORM' if member.is_relative else f"LIMIT_{channel.upper()}")
    made.name = f"Motus {system.label} {channel.title()}"
    if member.is_relative:
        paths = _relative(made, channel, anchor)
    else:
        made.owner_space = member.space
        switches = ("use_limit_{}",) if channel == "rotation" else ("use_min_{}", "use_max_{}")
        if channel == "rotation":
            made.euler_order = 'XYZ'
        if hasattr(made, "use_legacy_behavior"):
            made.use_legacy_behavior = True
        for letter in "xyz":
            for switch in switches:
                setattr(made, switch.format(letter), True)
        paths = ("min_{}", "max_{}")
    for axis, letter in enumerate("xyz"):
        for path in paths:
            _copy(made, path.format(letter), system, owner, slot + axis)
    if not member.is_relative:
        _copy(made, "influence", system, owner, WEIGHT)


def _relative(made, channel, anchor):
    made.target, made.owner_space, made.map_from, made.map_to = anchor, 'LOCAL', 'LOCATION', channel.upper()
    if channel == "scale":
        made.mix_mode_scale = 'MULTIPLY'
        return ("to_min_{}_scale",)
    made.mix_mode_rot, made.to_euler_order = 'AFTER', 'XYZ'
    return ("to_min_{}_rot",)


def _copy(made, path, system, owner, slot):
    source = system_module.Variable('OBJECT', owner, f'["motus_{system.name}_out"][{slot}]')
    drivers.copy_value(made, path, source)
