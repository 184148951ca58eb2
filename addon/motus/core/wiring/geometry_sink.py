"""The sink of systems that move the points of a mesh: a Geometry Nodes modifier that adds what the hub holds.

The hub's mesh is empty in the file. The solver gives the *evaluated* one as many points as the owner's mesh has, and a vector
a point; the modifier, first in the owner's stack, adds to each point the vector of the same index. Without the add-on
there are no vectors, and the mesh stands as it is. In Edit Mode, where points come and go before the solver hears of
it, the modifier is switched off.
"""

import bpy

from .. import capabilities
from ..lazy import numpy as np
from . import attributes, outbox
from .scratch import scratch

ATTRIBUTE = "motus_offset"
KEY = "motus_system"
"""Custom property of the node group: name of the system whose sinks have it."""
HUB_SOCKET = "Hub"


def prepare(mesh):
    """Give a hub's mesh the attribute that the solver fills."""
    mesh.attributes.new(ATTRIBUTE, 'FLOAT_VECTOR', 'POINT')


def add(system, owner, hub):
    """Let the owner's points be moved by what the hub holds, by the modifier that is there already or a new one."""
    found = modifier(system, owner)
    if found is not None:
        if not _is_whole(found.node_group):
            found.node_group = _node_group(system)
        _set_hub(found, hub)
        return
    active = getattr(owner.modifiers, "active", None)
    found = owner.modifiers.new(f"Motus {system.label}", 'NODES')
    found.node_group = _node_group(system)
    found.show_in_editmode = found.show_on_cage = found.show_expanded = False
    # Before it is moved: where that is done by an operator, Blender evaluates, and takes no notice of the hub later.
    _set_hub(found, hub)
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
    hub = outbox.hub_of(system, owner)
    if hub is None or not hub.data.animation_data or owner.type != 'MESH':
        return False
    targets = [target for curve in hub.data.animation_data.drivers for variable in curve.driver.variables
               for target in variable.targets if target.id_type == 'MESH']
    return any(target.id != owner.data for target in targets)


def room(carrier, count):
    """Vectors for all points of the evaluated hub, all zero; the first `count` are the owner's."""
    # Points can be added to an evaluated mesh, but not taken away.
    offsets = scratch("offsets", (max(count, len(carrier.vertices)), 3), np.float32)
    offsets.fill(0.0)
    return offsets


def write(carrier, offsets):
    """Let the evaluated hub hold the vectors."""
    missing = len(offsets) - len(carrier.vertices)
    if missing > 0:
        carrier.vertices.add(missing)
    attributes.write(carrier, ATTRIBUTE, 'FLOAT_VECTOR', offsets)


def write_nothing(carrier):
    """Let the owner's points be where they are by themselves."""
    write(carrier, room(carrier, 0))


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


def _set_hub(found, hub):
    identifier = _socket_identifier(found.node_group)
    if capabilities.has_modifier_inputs():
        getattr(found.properties.inputs, identifier).value = hub
    else:
        found[identifier] = hub
    found.id_data.update_tag()


def _socket_identifier(group):
    return next(socket.identifier for socket in _sockets(group) if socket.name == HUB_SOCKET)


def _sockets(group):
    return group.interface.items_tree if capabilities.has_tree_interface() else group.inputs


def _is_whole(group):
    """Whether it has its input, which somebody may have removed."""
    return any(socket.name == HUB_SOCKET for socket in _sockets(group))


def _node_group(system):
    """The node group of all the system's sinks in this file."""
    for group in bpy.data.node_groups:
        if group.get(KEY) == system.name and group.library is None and _is_whole(group):
            return group
    group = bpy.data.node_groups.new(f"Motus {system.label}", 'GeometryNodeTree')
    group[KEY] = system.name
    _add_sockets(group)
    _add_nodes(group)
    return group


def _add_sockets(group):
    sockets = (("Geometry", 'INPUT', "NodeSocketGeometry"), (HUB_SOCKET, 'INPUT', "NodeSocketObject"),
               ("Geometry", 'OUTPUT', "NodeSocketGeometry"))
    for name, way, kind in sockets:
        if capabilities.has_tree_interface():
            group.interface.new_socket(name, in_out=way, socket_type=kind)
        else:
            (group.inputs if way == 'INPUT' else group.outputs).new(kind, name)


def _add_nodes(group):
    kinds = ("NodeGroupInput", "GeometryNodeObjectInfo", "GeometryNodeInputNamedAttribute", "GeometryNodeInputIndex",
             "GeometryNodeSampleIndex", "GeometryNodeSetPosition", "NodeGroupOutput")
    made = [group.nodes.new(kind) for kind in kinds]
    for place, node in enumerate(made):
        node.location = (200.0 * place, 0.0)
    start, info, named, index, sample, move, end = made
    named.data_type = sample.data_type = 'FLOAT_VECTOR'
    named.inputs["Name"].default_value = ATTRIBUTE
    sample.domain = 'POINT'
    for source, target in (
            (start.outputs["Geometry"], move.inputs["Geometry"]), (start.outputs[HUB_SOCKET], info.inputs["Object"]),
            (info.outputs["Geometry"], sample.inputs["Geometry"]), (_enabled(named.outputs), _value(sample.inputs)),
            (index.outputs["Index"], sample.inputs["Index"]), (_enabled(sample.outputs), move.inputs["Offset"]),
            (move.outputs["Geometry"], end.inputs["Geometry"])):
        group.links.new(source, target)


def _enabled(sockets):
    # Before 4.x such nodes have a socket a type, of which those of other types are off.
    return next(socket for socket in sockets if socket.enabled)


def _value(sockets):
    return next(socket for socket in sockets if socket.enabled and socket.name == "Value")
