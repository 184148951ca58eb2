"""Create the driver that calls a solver, with the driver variables by which it waits for everything the solver reads.

The owner is the object whose settings are solved. The driver is on the outbox, an array of results on the mesh of a hidden object, the hub.
Sinks are the constraints, drivers and modifiers that bring results to members, the objects or bones that the owner drives. The result of a
relative member is applied on top of its own transform, that of an absolute member in place of its own transform. The outlet is a custom
property of the owner that repeats outputs of the solver.
"""

import bpy

from ...blender import datablocks, drivers
from ...declare import BonesOwn, CopyOf, Transform, Variable, input_variables, laid_beneath, of_owner
from ...evaluated import copies
from ..hubs import hub_lookup, outbox, outputs, traits
from ..sinks import property_sink
from . import waiting

_OF_PROPERTY = "p"
"""Prefix of the names of variables that wait for the datablocks of driven properties."""
_OF_COPY = "c"
"""Prefix of the names of variables that wait for the copies of objects."""


def add(system, owner, group, part):
    """Add the driver that calls the solver of a group to the outbox on a hub's mesh.

    Nothing happens if a different owner that shares the hub has added the driver. part: Part of the owner. Each curve that the solver reads
    gets a custom property by which its evaluated copies are told apart, and so does each object whose copy it waits for.
    """
    path, animation = outbox.out_path(system, group=group.key), part.mesh.animation_data
    if animation and animation.drivers.find(path, index=outbox.STATUS):
        return
    expression, variables = _call(system, owner, group, part)
    call = f'motus_solve(self,"{_name(system, group)}",frame,depsgraph{expression})'
    if traits.is_read_by_subscript(system):
        call = f'motus_points[self,"{_name(system, group)}"{expression}]'
    drivers.add(part.mesh, path, call, variables, index=outbox.STATUS, use_self=True)
    copies.mark(*(one.id for name, one in variables.items() if one.id_type == 'CURVE' or name.startswith(_OF_COPY)))


def marked_by(mesh):
    """Return the datablocks to which the solver of a hub's mesh has given a custom property that tells their evaluated copies apart.

    These are the data of the curve objects that the solver reads, objects whose copies it waits for, and the datablocks of driven properties.
    """
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
        if name.startswith(_OF_COPY):
            found.add(target.id)
        if name.startswith(_OF_PROPERTY):
            found.add(target.id.node_tree if target.data_path.startswith("node_tree[") else target.id)
    return found - {None}


def waits(system, owner, key):
    """Return (object, name of a bone or "") for each transform for which the solver of a group waits.

    The solver waits by a muted constraint on the hub for each. Blender updates the name in the constraint if the bone is renamed.
    """
    hub = hub_lookup.hub_of(system, owner, key)
    return waiting.waits(hub) if hub else []


def renamed_reads(system, owner):
    """Return (armature object, old name, new name) for each bone that an owner's solvers read and that was renamed.

    Names are compared with those at the time when the owner was wired.
    """
    found = {}
    for key, carrier in hub_lookup.carriers_of(system, owner):
        known, first = outbox.info(system, carrier, key), carrier.get(outbox.OWNER_KEY)
        for old, (rig, new) in zip(known.reads if known else (), waits(system, owner, key)):
            if old != new and rig and rig.pose and new in rig.pose.bones:
                # An object's copy uses the hubs of the object from which it was copied. If that object's solver reads the object
                # itself, the renamed bone is one of the copy.
                found[owner if rig == first else rig, old] = new
    return [(rig, old, new) for (rig, old), new in found.items()]


def _awaited(group):
    """Yield the inputs of a group for which the solver can wait, and has to wait.

    A bone's own transform (BonesOwn) is left out in either of two cases: the bone has no drivers (nothing to wait for), or the bone is an
    absolute member of the group (its result is applied in place of its own transform). Waiting for the drivers of an absolute member would
    be a cycle: its sinks set values of its constraints, and in Blender's dependency graph these values and the bone's channels are one
    node. Relative members (result applied on top of their own transform) have sinks without this problem (see proxy_sink and
    attribute_sink).
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


def _call(system, owner, group, part):
    """Return (text, {name: driver Variable}) for the driver expression that calls the solver of a group.

    The text lists the inputs, to be appended to the arguments of the call: names of variables, or 0 for an input that has no variable.
    Further variables are in the dictionary only: the solver's driver waits for what they read.
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
        copied = [one.object for one in awaited if isinstance(one, CopyOf)]
        awaited = [one for one in awaited if not isinstance(one, (Transform, CopyOf))]
        variables["waits"] = waiting.wait_for(part.hub, group.reads)
        # A custom property is evaluated after the copy is made, and before the transform.
        variables |= {
            f"{_OF_COPY}{index}": Variable(datablocks.id_type(one), one, f'["{copies.KEY}"][0]') for index, one in enumerate(copied)
        }
    for index, one in enumerate(awaited):
        variables[f"w{index}"] = one.variable()
    for index, one in enumerate(property_sink.waits(group)):
        variables[f"{_OF_PROPERTY}{index}"] = one
    for index, one in enumerate(_laid(system, owner, group)):
        variables[f"l{index}"] = one
    if part.reads_owner:
        variables["owner"] = Variable('OBJECT', owner, _settings_path(system, owner, group))
    return ",".join(arguments), variables


def _settings_path(system, owner, group):
    """Return the data path of the owner's property that a solver's driver reads, to be evaluated after the owner's settings.

    If the solver has to avoid waiting for the settings (waits_apart()), the path is chosen by way_to_wait(). If the owner has an outlet
    (custom property that repeats the outputs), the path is that of a custom property that nothing animates. Waiting for a setting would
    then be a cycle: all plain properties of an object are one node in Blender's dependency graph, which waits for the outlet, which waits
    for the solver. In all other cases it is the path of one of the settings.
    """
    way = way_to_wait(owner, [group])
    if way == "keys":
        return _wait_for_keys(system, owner)
    if outputs.has_outlet(system, owner) or (waits_apart(owner, [group]) and not way):
        return f'["{copies.KEY}"][0]'
    return f"{of_owner(system, owner).path_from_id()}.influence"


def waits_apart(owner, groups):
    """Whether solvers of the owner must avoid waiting for the one node of all plain (not custom) properties of the owner.

    In Blender's dependency graph these properties of an object, the settings among them, are one node. way_to_wait() tells how such solvers
    wait for the settings. If solvers drive some of the properties, waiting for the node would be a dependency cycle. On a camera, Blender
    evaluates the node after the camera's data, which may be driven by a solver that waits for the camera.
    """
    return owner.type == 'CAMERA' or any(group.properties for group in groups)


def way_to_wait(owner, groups):
    """Return by which dependency a solver is evaluated after the owner's animated settings, if waits_apart() is true.

    "keys": a custom property of the owner (wait_key()) that Blender evaluates after the keyframes of the settings. "settings": the settings
    themselves, because a driver sets one of them; the dependency graph may then have a cycle. "": none, because the settings are not
    animated, or because waits_apart() is false and the solver waits for all properties of the owner anyway.
    """
    if not waits_apart(owner, groups) or not copies.has_animated_settings(owner):
        return ""
    return "settings" if copies.has_driven_settings(owner) else "keys"


def _wait_for_keys(system, owner):
    """Give the owner a custom property by which a solver waits for the owner's F-curves; returns the data path of the property.

    A driver on the property makes Blender evaluate the property after the owner's keyframes, and after nothing else. The settings cannot be
    used for this: all plain (not custom) properties of an object are one node in Blender's dependency graph, and sinks may drive some of
    these properties.
    """
    key = wait_key(system)
    owner[key] = 0.0
    drivers.copy_value(owner, f'["{key}"]')
    return f'["{key}"]'


def wait_key(system):
    """Return the name of the custom property of an owner by which the system's solvers wait for the owner's F-curves."""
    return f"motus_{system.name}_wait"


def _laid(system, owner, group):
    """Return driver Variables by which a group's solver waits for the systems that lay poses (set bones' own transforms, as keys do).

    All other systems start from these poses. Each Variable reads the status in the outbox of such a system on the same owner. The list is
    empty if no member of the group is a bone.
    """
    if not any(isinstance(one.thing, bpy.types.PoseBone) for one in group.members):
        return []
    hubs = [(one, key, hub) for one in laid_beneath(system) for key, hub in hub_lookup.hubs(one, owner)]
    return [Variable('MESH', hub.data, outbox.out_path(one, outbox.STATUS, key)) for one, key, hub in hubs]
