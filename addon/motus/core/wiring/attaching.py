"""Attaching a system to an owner and taking it away again."""

import bpy

from .. import capabilities
from ..system import Setting, Variable, input_variables, of_owner
from . import attribute_sink, drivers, healing, limit_sink, order, outbox
from .sinks import led_by, remove, sinks


def attach(system, owner):
    """Wire `system` on `owner`: solver, outbox, and sinks on all its members. What was wired before is replaced."""
    detach(system, owner)
    settings = of_owner(system, owner)
    settings.is_active = True
    settings.order_proxy = order.proxy_for(system, settings)
    members = system.members(owner)
    # An outbox on the owner goes along with its copies, so a hub is made only for members that are other objects.
    own = all(member.id_data == owner for member in members)
    carrier = owner if own else _make_hub(system, owner, settings)
    uses_attribute = not own and capabilities.has_geometry_attribute_constraint()
    if uses_attribute:
        attribute_sink.prepare(carrier, members)
    outbox.create(system, carrier, 0 if uses_attribute else len(members))
    expression, variables = _call(system, owner, with_settings=not own)
    drivers.add(carrier, outbox.out_path(system), f'motus_solve(self,"{system.name}",{expression}', variables,
                index=outbox.STATUS, use_self=True)
    direct = None
    if own and (settings.use_direct_drivers or healing.has_driven_settings(owner, settings)):
        expression, variables = _call(system, owner)
        direct = (f'motus_direct(self,"{system.name}",{{slot}},{expression}', variables)
    channels = system.channels(settings)
    for index, member in enumerate(members):
        if uses_attribute:
            attribute_sink.add(system, member, settings.hub, index, channels)
        else:
            limit_sink.add(system, member, carrier, index, channels, direct, settings.hub)
        if member.id_data != owner:
            of_owner(system, member.id_data).leader = owner
    touch(system, owner)


def detach(system, owner):
    """Remove everything attach() made; the owner's and members' own transforms, keys and constraints stay."""
    settings = of_owner(system, owner)
    for member, constraint in sinks(system, owner):
        remove(member, constraint)
    for other in led_by(system, owner):
        of_owner(system, other).leader = None
    if outbox.owns_hub(system, owner):
        bpy.data.meshes.remove(settings.hub.data)
    settings.hub = None
    drivers.remove_under(owner, outbox.out_path(system))
    outbox.remove(system, owner)
    order.release(settings)
    settings.is_active = False
    drivers.drop_empty_animation(owner)
    owner.update_tag()


def refresh(system, owner):
    """Wire again after a change of what is driven or read: targets, members, channels."""
    if not is_attached(system, owner):
        return
    before = _stacks(system, owner)
    attach(system, owner)
    for member, places in _stacks(system, owner).items():
        old = before.get(member)
        for offset, (index, _) in enumerate(places if old else ()):
            constraint = member.constraints[index]
            constraint.mute = old[min(offset, len(old) - 1)][1]
            member.constraints.move(index, old[0][0] + offset)


def is_attached(system, owner):
    """Whether the system is wired on this object as its owner (members of others' are not)."""
    return of_owner(system, owner).is_active


def touch(system, owner):
    """Let Blender evaluate the system again after a change of settings from Python."""
    owner.update_tag()
    hub = of_owner(system, owner).hub
    if hub is None:
        return
    if not outbox.owns_hub(system, owner):
        refresh(system, owner)  # a copy, which was driven along with the first one until now
        return
    hub.data.update_tag()
    if system.member_data:
        # Reading a list of settings item by item in every solve would be dear where there are many members.
        data = [float(value) for value in system.member_data(owner)]
        if len(data) != len(hub.data.get(outbox.MEMBER_DATA_KEY, data)):
            refresh(system, owner)  # a member was deleted since
            return
        hub.data[outbox.MEMBER_DATA_KEY] = data


def _stacks(system, owner):
    """For each driven Object or PoseBone, (place in its constraint stack, whether muted) of its sinks, in their order."""
    ours = {}
    for member, constraint in sinks(system, owner):
        ours.setdefault(member, []).append(constraint.name)
    return {member: [(index, constraint.mute) for index, constraint in enumerate(member.constraints)
                     if constraint.name in names] for member, names in ours.items()}


def _make_hub(system, owner, settings):
    mesh = bpy.data.meshes.new(f"Motus {system.label} {owner.name}")
    hub = bpy.data.objects.new(mesh.name, mesh)
    hub.hide_render = hub.hide_viewport = True
    mesh[outbox.OWNER_KEY] = owner
    settings.hub = hub
    return mesh


def _call(system, owner, with_settings=True):
    """Argument list of a solver call, with its driver variables; what has no variable is passed as 0.

    with_settings: whether the solver waits for the owner's settings. A driver on the owner's own custom property cannot:
    to Blender's dependency graph all of an object's plain properties are one node, which waits for that driver in turn.
    It still sees keyed and edited settings, for an object's animation comes before its drivers; where a setting is driven, the
    sinks compute for themselves, since drivers of constraints can wait.
    """
    arguments, variables = ["frame", "depsgraph"], {}
    for index, (declared, variable) in enumerate(input_variables(system, owner)):
        if variable is None or (isinstance(declared, Setting) and not with_settings):
            arguments.append("0")
            continue
        arguments.append(f"v{index}")
        variables[f"v{index}"] = variable
    if with_settings:
        # Read by the solver itself; declared so that it comes first.
        variables["influence"] = Variable('OBJECT', owner, f"{of_owner(system, owner).path_from_id()}.influence")
    return ",".join(arguments) + ")", variables
