"""The driver that calls the solver, and the variables by which it waits for what it reads."""

import bpy

from ...blender import drivers
from ...declare import BonesOwn, Transform, Variable, input_variables, laying, of_owner
from ...evaluated import copies
from ..hubs import hub_lookup, outbox
from ..sinks import property_sink
from . import sharing, signature, waiting

_OF_PROPERTY = "p"
"""How the names of variables begin that wait for what has driven properties."""


def add(system, owner, group, hub):
    """Give the hub's mesh, which may be one that owners share, the driver on its outbox."""
    expression, variables = _call(system, owner, group, hub)
    call = f'motus_solve(self,"{_name(system, group)}",frame,depsgraph{expression})'
    if system.moves_points:
        # Blender takes any expression with a call or the frame in it for one that changes with time. Where it does not,
        # meshes are not evaluated anew on every frame; nothing but a subscript is neither.
        call = f'motus_points[self,"{_name(system, group)}"{expression}]'
    drivers.add(hub.data, outbox.out_path(system, group=group.key), call, variables, index=outbox.STATUS, use_self=True)


def prepare(system, owner):
    """Before an owner is wired: let what its solvers read be there before them, and its evaluated copies be told apart."""
    waiting.set_proxy(system, of_owner(system, owner))
    copies.prepare(owner)
    copies.mark(*_curves_for(system, owner))


def call_again(system, owner):
    """Tag an owner, so that its solvers run again with the present settings.

    Returns False if the number of members has changed since the owner was set up, which has to be set up again then.
    """
    owner.update_tag()
    for _, hub in hub_lookup.hubs(system, owner):
        hub.data.update_tag()
    hub = hub_lookup.hub_of(system, owner)
    if hub and outbox.is_shared(system, hub.data):
        return sharing.write(system, owner)
    if hub and system.member_data:
        # Reading a list of settings item by item in every solve would be dear where there are many members.
        data = [float(value) for value in system.member_data(owner)]
        if not outbox.has_room(hub.data, len(data)):
            return False
        hub.data[outbox.MEMBER_DATA_KEY] = data
    return True


def _curves_for(system, owner):
    """The data of the curves that a system reads for an owner."""
    variables = (variable for _, variable in input_variables(system, owner))
    return [variable.id for variable in variables if variable and variable.id_type == 'CURVE']


def marked_by(mesh):
    """What the solver of a hub's mesh reads and tells copies apart of: the data of curves, and what has driven properties."""
    animation = mesh.animation_data
    targets = [
        (variable.name, target)
        for curve in (animation.drivers if animation else ())
        for variable in curve.driver.variables
        for target in variable.targets
        if target.id
    ]
    found = {target.id for _, target in targets if target.id_type == 'CURVE'}
    for name, target in targets:
        if name.startswith(_OF_PROPERTY):
            found.add(target.id.node_tree if target.data_path.startswith("node_tree[") else target.id)
    return found - {None}


def waits(system, owner, key):
    """(object, bone or "") of a group's reads, as it waits for them: where a bone is renamed Blender renames it here too."""
    hub = hub_lookup.hub_of(system, owner, key)
    return waiting.waits(hub) if hub else []


def renamed_reads(system, owner):
    """(rig, old name, new name) of bones that the owner reads and that were renamed since it was wired."""
    found = {}
    for key, carrier in hub_lookup.carriers_of(system, owner):
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


def _call(system, owner, group, hub):
    """Further arguments of a solver call, with its driver variables; what has no variable is passed as 0.

    The solver reads the settings of the evaluated owner. To Blender's dependency graph all plain properties of an object are
    one node, which comes after their animation and drivers, and after the owner's outlet, which waits for the solver. So an
    owner without an outlet is waited for by one of its settings, and one that has it, whose settings do not change in time,
    by a custom property that nothing writes. The solver of a shared hub does not read owners.
    """
    arguments, variables = [""], {}
    for index, (_, variable) in enumerate(input_variables(system, owner)):
        if variable is None:
            arguments.append("0")
            continue
        arguments.append(f"v{index}")
        variables[f"v{index}"] = variable
    awaited = list(dict.fromkeys(_awaited(group)))
    if group.inputs:
        awaited = [one for one in awaited if not isinstance(one, Transform)]
        variables["waits"] = waiting.wait_for(hub, group.reads)
    for index, one in enumerate(awaited):
        variables[f"w{index}"] = one.variable()
    for index, one in enumerate(property_sink.waits(group)):
        variables[f"{_OF_PROPERTY}{index}"] = one
    for index, one in enumerate(_laid(system, owner, group)):
        variables[f"l{index}"] = one
    if not outbox.is_shared(system, hub.data):
        path = f"{of_owner(system, owner).path_from_id()}.influence"
        way = signature.way_to_wait(owner, [group])
        if way == "keys":
            path = signature.wait_for_keys(system, owner)
        elif hub_lookup.has_outlet(system, owner) or (signature.waits_apart(owner, [group]) and not way):
            path = f'["{copies.KEY}"][0]'
        variables["owner"] = Variable('OBJECT', owner, path)
    return ",".join(arguments), variables


def _laid(system, owner, group):
    """Variables that wait for the systems that lay poses over the owner's bones, of a group that starts from these."""
    starts_there = system.entries and not system.lays_pose and any(isinstance(one.thing, bpy.types.PoseBone) for one in group.members)
    beneath = laying() if starts_there else ()
    return [
        Variable('MESH', hub.data, outbox.out_path(one, outbox.STATUS, key)) for one in beneath for key, hub in hub_lookup.hubs(one, owner)
    ]


def reads_the_same(system, owner, mesh):
    """Whether the solver of a hub reads what one for an owner would."""
    wanted = [variable and (variable.id, variable.data_path) for _, variable in input_variables(system, owner)]
    animation = mesh.animation_data
    curve = animation and animation.drivers.find(outbox.out_path(system), index=outbox.STATUS)
    if not curve:
        return False
    found = {variable.name: (variable.targets[0].id, variable.targets[0].data_path) for variable in curve.driver.variables}
    return [found.get(f"v{index}") for index in range(len(wanted))] == wanted
