"""The driver that calls the solver, and the variables by which it waits for what it reads."""

import bpy

from ..system import BonesOwn, Setting, Transform, Variable, input_variables, of_owner
from . import drivers, outbox, waiting


def add(system, owner, group, carrier):
    """Give the carrier the driver on its outbox."""
    hub = None if carrier == owner else outbox.hub_of(system, owner, group.key)
    expression, variables = _call(system, owner, group, hub)
    call = f'motus_solve(self,"{_name(system, group)}",frame,depsgraph{expression})'
    if system.moves_points:
        # Blender takes any expression with a call or the frame in it for one that changes with time. Where it does not,
        # meshes are not evaluated anew on every frame; nothing but a subscript is neither.
        call = f'motus_points[self,"{_name(system, group)}"{expression}]'
    drivers.add(carrier, outbox.out_path(system, group=group.key), call, variables, index=outbox.STATUS, use_self=True)


def direct(system, owner, group):
    """(expression with {slot}, variables) where the sinks of an owner are to compute for themselves; else None."""
    settings = of_owner(system, owner)
    if not settings.use_direct_drivers and (system.groups or not drivers.has_driven_settings(owner, settings)):
        return None
    expression, variables = _call(system, owner, group, with_settings=True)
    return f'motus_direct(self,"{_name(system, group)}",{{slot}},frame,depsgraph{expression})', variables


def waits(system, owner, key):
    """(object, bone or "") of a group's reads, as it waits for them: where a bone is renamed Blender renames it here too."""
    hub = outbox.hub_of(system, owner, key)
    if hub:
        return waiting.waits(hub)
    animation = owner.animation_data
    curve = animation and animation.drivers.find(outbox.out_path(system, group=key), index=outbox.STATUS)
    targets = [variable.targets[0] for variable in curve.driver.variables if variable.type == 'TRANSFORMS'] if curve else ()
    return [(target.id if isinstance(target.id, bpy.types.Object) else None, target.bone_target) for target in targets]


def renamed_reads(system, owner):
    """(rig, old name, new name) of bones that the owner reads and that were renamed since it was wired."""
    found = {}
    for key, carrier in outbox.carriers(system, owner):
        known, first = outbox.info(system, carrier, key), carrier.get(outbox.OWNER_KEY)
        for old, (rig, new) in zip(known.reads if known else (), waits(system, owner, key)):
            if old != new and rig and rig.pose and new in rig.pose.bones:
                # A copy shares the hubs of the first one, and means itself where that meant itself.
                found[owner if rig == first else rig, old] = new
    return [(rig, old, new) for (rig, old), new in found.items()]


def _awaited(group):
    """The inputs that there is anything to wait for.

    To Blender a bone's channels and its constraints' values are one thing: a solver cannot wait for a bone that its own
    sinks set a value of, as they do where they are absolute. Others let it (see proxy_sink and attribute_sink).
    """
    kept = {member.thing for member in group.members if not member.is_relative}
    driven = {}
    for declared in group.inputs:
        if isinstance(declared, BonesOwn):
            rig, bone = declared.object, declared.bone
            if rig not in driven:
                driven[rig] = drivers.driven_bones(rig)
            if bone not in driven[rig] or rig.pose.bones[bone] in kept:
                continue
        yield declared


def _name(system, group):
    return f"{system.name}.{group.key}" if group.key else system.name


def _call(system, owner, group, hub=None, with_settings=False):
    """Further arguments of a solver call, with its driver variables; what has no variable is passed as 0.

    hub: the object that carries the solver, which then waits for the owner's settings, as it does `with_settings`. A driver
    on the owner's own custom property cannot: to Blender's dependency graph all of an object's plain properties are one
    node, which waits for that driver in turn. It still sees keyed and edited settings, for an object's animation comes
    before its drivers. Where a setting is driven, a hub carries the solver, which can wait, or the sinks compute for
    themselves, since drivers of constraints can wait.
    """
    with_settings = with_settings or hub is not None
    arguments, variables = [""], {}
    for index, (declared, variable) in enumerate(input_variables(system, owner)):
        if variable is None or (isinstance(declared, Setting) and not with_settings):
            arguments.append("0")
            continue
        arguments.append(f"v{index}")
        variables[f"v{index}"] = variable
    awaited = list(dict.fromkeys(_awaited(group)))
    if hub and group.inputs:
        awaited = [one for one in awaited if not isinstance(one, Transform)]
        variables["waits"] = waiting.wait_for(hub, group.reads)
    for index, one in enumerate(awaited):
        variables[f"w{index}"] = one.variable()
    if with_settings:
        # Read by the solver itself; declared so that it comes first.
        variables["influence"] = Variable('OBJECT', owner, f"{of_owner(system, owner).path_from_id()}.influence")
    return ",".join(arguments), variables
