"""The sink of systems that move or make points: a Geometry Nodes modifier of the owner that brings in what the hub holds.

The hub's mesh is empty in the file. The solver gives the *evaluated* one points and attributes, of which moved_points and
made_points say what they are, and what the nodes do with them. Without the add-on there are none, and the owner stands as
it is. In Edit Mode, where the points of a mesh come and go before the solver hears of it, the modifier is switched off.
"""

import bpy

from .. import capabilities, node_groups
from . import hub_lookup, made_points, moved_points

KEY = "motus_system"
"""Custom property of the node group: name of the system whose sinks have it."""
HUB = "Hub"


def prepare(system, mesh, settings):
    """Give a hub's mesh the attributes that the solver fills for an owner with these settings."""
    _kind(system).prepare(system, mesh, settings)


def add(system, owner, hub):
    """Let the owner's points be moved by what the hub holds, by the modifier that is there already or a new one."""
    found = modifier(system, owner)
    if found is not None:
        if not _is_whole(system, found.node_group):
            found.node_group = _node_group(system)
        node_groups.set_input(found, HUB, hub)
        return
    active = getattr(owner.modifiers, "active", None)
    found = owner.modifiers.new(f"Motus {system.label}", 'NODES')
    found.node_group = _node_group(system)
    found.show_in_editmode = found.show_on_cage = found.show_expanded = False
    # Before it is moved: where that is done by an operator, Blender evaluates, and takes no notice of the hub later.
    node_groups.set_input(found, HUB, hub)
    if _kind(system).IS_FIRST:
        _move_first(owner, found)
    if active:
        owner.modifiers.active = active  # the user's, which stays so


def modifier(system, owner):
    """The owner's sink of the system; None where it has none."""
    return next((one for one in owner.modifiers if _is_sink(system, one)), None)


def place(system, owner):
    """Place of the sink in the owner's stack of modifiers; None where it has none."""
    return next((index for index, one in enumerate(owner.modifiers) if _is_sink(system, one)), None)


def remove(system, owner):
    """Take the sink away, and what it was made of where nobody else needs that."""
    for found in [one for one in owner.modifiers if _is_sink(system, one)]:
        group = found.node_group
        owner.modifiers.remove(found)
        if group.users == 0:
            bpy.data.node_groups.remove(group)


def is_stale(system, owner):
    """Whether the hub waits for another mesh than the owner has now."""
    hub = hub_lookup.hub_of(system, owner)
    if hub is None or not hub.data.animation_data or owner.type != 'MESH':
        return False
    targets = [target for curve in hub.data.animation_data.drivers for variable in curve.driver.variables
               for target in variable.targets if target.id_type == 'MESH']
    return any(target.id != owner.data for target in targets)


def room(system, carrier, inputs, context):
    """What the solver fills, in the context too. Its write(weight) lets the evaluated hub hold that."""
    return _kind(system).Room(system, carrier, inputs, context)


def write_nothing(system, carrier):
    """Let the owner be what it is by itself."""
    _kind(system).write_nothing(system, carrier)


def set_material(system, owner, material):
    """Give what the system makes on an owner a material."""
    node_groups.set_input(modifier(system, owner), made_points.MATERIAL, material)


def _kind(system):
    return moved_points if system.moves_points else made_points


def _is_sink(system, one):
    return one.type == 'NODES' and one.node_group is not None and one.node_group.get(KEY) == system.name


def _move_first(owner, found):
    if len(owner.modifiers) == 1:
        return  # in 3.4 the operator refuses overrides
    if capabilities.has_modifier_order():
        owner.modifiers.move(len(owner.modifiers) - 1, 0)
        return
    with bpy.context.temp_override(object=owner, active_object=owner):
        bpy.ops.object.modifier_move_to_index(modifier=found.name, index=0)


def _is_whole(system, group):
    """Whether it has its inputs, which somebody may have removed."""
    return node_groups.has_inputs(group, {name for name, way, _ in _sockets(system) if way == 'INPUT'})


def _sockets(system):
    return (("Geometry", 'INPUT', "NodeSocketGeometry"), (HUB, 'INPUT', "NodeSocketObject"), *_kind(system).MORE_INPUTS,
            ("Geometry", 'OUTPUT', "NodeSocketGeometry"))


def _node_group(system):
    """The node group of all the system's sinks in this file."""
    for group in bpy.data.node_groups:
        if group.get(KEY) == system.name and group.library is None and _is_whole(system, group):
            return group
    group = bpy.data.node_groups.new(f"Motus {system.label}", 'GeometryNodeTree')
    group[KEY] = system.name
    node_groups.add_sockets(group, _sockets(system))
    start, end = (node_groups.add_node(group, kind) for kind in ("NodeGroupInput", "NodeGroupOutput"))
    _kind(system).add_nodes(system, group, start, end)
    end.location.x = 200.0 * len(group.nodes)
    return group
