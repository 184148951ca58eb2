"""Attaching a system to an owner and taking it away again."""

import bpy

from .. import capabilities
from ..system import Setting, Variable, input_variables, of_owner
from . import attribute_sink, drivers, limit_sink, order, outbox


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
    if own and (settings.use_direct_drivers or _has_driven_settings(owner, settings)):
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
        _remove_sink(member, constraint)
    for other in _led_by(system, owner):
        of_owner(system, other).leader = None
    if settings.hub:
        hub, settings.hub = settings.hub, None
        if hub.data.get(outbox.OWNER_KEY) == owner:
            bpy.data.meshes.remove(hub.data)
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
    places = {}
    for member, constraint in reversed(sinks(system, owner)):
        places[member] = (_index(member, constraint), constraint.mute)
    attach(system, owner)
    for member, constraint in sinks(system, owner):
        if member in places:
            index, constraint.mute = places[member]
            member.constraints.move(_index(member, constraint), index)
            places[member] = (index + 1, constraint.mute)


def is_attached(system, owner):
    """Whether the system is wired on this object as its owner (members of others' are not)."""
    return of_owner(system, owner).is_active


def touch(system, owner):
    """Let Blender evaluate the system again after a change of settings from Python."""
    owner.update_tag()
    hub = of_owner(system, owner).hub
    if hub is None or hub.data[outbox.OWNER_KEY] != owner:
        return
    hub.data.update_tag()
    if system.member_data:
        # Reading a list of settings item by item in every solve would be dear where there are many members.
        data = [float(value) for value in system.member_data(owner)]
        if len(data) != len(hub.data.get(outbox.MEMBER_DATA_KEY, data)):
            refresh(system, owner)  # a member was deleted since
            return
        hub.data[outbox.MEMBER_DATA_KEY] = data


def _index(member, constraint):
    return next(index for index, one in enumerate(member.constraints) if one == constraint)


def set_muted(system, owner, muted):
    """Switch the sinks off or on, leaving all else in place."""
    for _, constraint in sinks(system, owner):
        constraint.mute = muted


def sinks(system, owner):
    """(Object or PoseBone, constraint) of every sink of the system, found by what their drivers read."""
    carrier = outbox.carrier_of(system, owner)
    hub = of_owner(system, owner).hub
    objects = {owner}
    # The copy of an owner shares its hub, but the members are the first one's.
    if hub is None or hub.data[outbox.OWNER_KEY] == owner:
        objects.update(member.id_data for member in system.members(owner) if member)
        objects.update(_led_by(system, owner))
    found = []
    for candidate in objects:
        found += [(candidate, c) for c in candidate.constraints if attribute_sink.is_undriven(c, hub)]
        animation = candidate.animation_data
        for curve in animation.drivers if animation else ():
            if curve.data_path.endswith(".influence") and _is_sink_driver(system, curve.driver, carrier):
                constraint = _resolve(candidate, curve.data_path.removesuffix(".influence"))
                if constraint:
                    found.append((_holder(candidate, curve.data_path), constraint))
    return found


def _led_by(system, owner):
    if of_owner(system, owner).hub is None:
        return []
    return [other for other in bpy.data.objects if of_owner(system, other).leader == owner]


def _is_sink_driver(system, driver, carrier):
    if driver.expression.startswith(f'motus_direct(self,"{system.name}",{outbox.WEIGHT},'):
        return True
    weight = outbox.out_path(system, outbox.WEIGHT)
    targets = [target for variable in driver.variables for target in variable.targets]
    return any(target.id == carrier and target.data_path == weight for target in targets)


def _resolve(owner, path):
    try:
        return owner.path_resolve(path)
    except ValueError:
        return None


def _holder(owner, path):
    """The Object or PoseBone whose constraint a driver path names."""
    bone, separator, _ = path.rpartition(".constraints[")
    return owner.path_resolve(bone) if separator else owner


def _remove_sink(member, constraint):
    owner = member.id_data
    drivers.remove_under(owner, constraint.path_from_id() + ".")
    member.constraints.remove(constraint)
    drivers.drop_empty_animation(owner)
    owner.update_tag()


def _make_hub(system, owner, settings):
    mesh = bpy.data.meshes.new(f"Motus {system.label} {owner.name}")
    hub = bpy.data.objects.new(mesh.name, mesh)
    hub.hide_render = hub.hide_viewport = True
    mesh[outbox.OWNER_KEY] = owner
    settings.hub = hub
    return mesh


def _has_driven_settings(owner, settings):
    prefix = settings.path_from_id() + "."
    return any(curve.data_path.startswith(prefix) for curve in owner.animation_data.drivers)


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
