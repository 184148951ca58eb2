"""Node groups, and the modifiers that have them, in every Blender."""

import bpy

from . import capabilities


def add_sockets(group, sockets):
    """Give a new group sockets: (name, 'INPUT' or 'OUTPUT', type) each."""
    for name, way, kind in sockets:
        if capabilities.has_tree_interface():
            group.interface.new_socket(name, in_out=way, socket_type=kind)
        else:
            (group.inputs if way == 'INPUT' else group.outputs).new(kind, name)


def has_inputs(group, names):
    """Whether a group has them all, which somebody may have removed."""
    return {socket.name for socket in _inputs(group)}.issuperset(names)


def set_input(modifier, name, value):
    """Give the modifier's group a value for one of its inputs."""
    _assign(modifier, _identifier(modifier, name), value)


def input_of(modifier, name):
    """What the modifier's group is given for one of its inputs."""
    return _values(modifier)[_identifier(modifier, name)]


def _identifier(modifier, name):
    return next(socket.identifier for socket in _inputs(modifier.node_group) if socket.name == name)


def _assign(modifier, identifier, value):
    if capabilities.has_modifier_inputs():
        getattr(modifier.properties.inputs, identifier).value = value
    else:
        modifier[identifier] = value
    modifier.id_data.update_tag()


def inputs_of(modifier):
    """What the modifier's group is given for its inputs: a list of values, without those that Blender keeps elsewhere."""
    return list(_values(modifier).values())


def let_go(modifier):
    """Empty the inputs that name datablocks: Blender 5 goes on to count what a modifier had that is removed, or has another group."""
    for identifier, value in _values(modifier).items():
        if isinstance(value, bpy.types.ID):
            _assign(modifier, identifier, None)


def _values(modifier):
    found = [socket.identifier for socket in _inputs(modifier.node_group)]
    if capabilities.has_modifier_inputs():
        inputs = modifier.properties.inputs
        return {identifier: getattr(getattr(inputs, identifier, None), "value", None) for identifier in found}
    return {identifier: modifier.get(identifier) for identifier in found}


def link(group, source, target):
    """Connect two sockets; a value stands for a source that is none."""
    if isinstance(source, bpy.types.NodeSocket):
        group.links.new(source, target)
    else:
        target.default_value = source


def input_items(group):
    """Inputs of a group as its interface has them, by name: with default_value, min_value and max_value."""
    return {socket.name: socket for socket in _inputs(group)}


def add_node(group, kind, **settings):
    """A new node, to the right of the others."""
    node = group.nodes.new(kind)
    node.location = (200.0 * (len(group.nodes) - 1), 0.0)
    for name, value in settings.items():
        setattr(node, name, value)
    return node


def named_attribute(group, name, data_type):
    """The socket that an attribute comes out of."""
    node = add_node(group, "GeometryNodeInputNamedAttribute", data_type=data_type)
    node.inputs["Name"].default_value = name
    return enabled(node.outputs)


def enabled(sockets, name=None):
    """The first socket, of this name where one is given. Before 4.x a node has one for each type, of which all but one are off."""
    return next(socket for socket in sockets if socket.enabled and name in (None, socket.name))


def _inputs(group):
    if not capabilities.has_tree_interface():
        return list(group.inputs)
    return [item for item in group.interface.items_tree if item.item_type == 'SOCKET' and item.in_out == 'INPUT']
