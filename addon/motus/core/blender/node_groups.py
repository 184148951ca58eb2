"""Node groups and Geometry Nodes modifiers, with one interface for all Blender versions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import bpy

from . import capabilities


def add_sockets(group: Any, sockets: Iterable[tuple[str, str, str]]) -> None:
    """Add inputs and outputs to a new node group. sockets: (name, 'INPUT' or 'OUTPUT', type of socket) each."""
    for name, way, kind in sockets:
        if capabilities.has_tree_interface():
            group.interface.new_socket(name, in_out=way, socket_type=kind)
        else:
            (group.inputs if way == 'INPUT' else group.outputs).new(kind, name)


def has_inputs(group: Any, names: Iterable[str]) -> bool:
    """Whether a node group has inputs of all these names; the user may have removed some."""
    return {socket.name for socket in _inputs(group)}.issuperset(names)


def set_input(modifier: Any, name: str, value: Any) -> None:
    """Set the value that a Geometry Nodes modifier has for an input of its node group. name: of the input."""
    _assign(modifier, _identifier(modifier, name), value)


def input_of(modifier: Any, name: str) -> Any:
    """The value that a Geometry Nodes modifier has for an input of its node group. name: of the input."""
    return _values(modifier)[_identifier(modifier, name)]


def _identifier(modifier: Any, name: str) -> str:
    return next(socket.identifier for socket in _inputs(modifier.node_group) if socket.name == name)


def _assign(modifier: Any, identifier: str, value: Any) -> None:
    if capabilities.has_modifier_inputs():
        getattr(modifier.properties.inputs, identifier).value = value
    else:
        modifier[identifier] = value
    modifier.id_data.update_tag()


def inputs_of(modifier: Any) -> list[Any]:
    """List of the values that a Geometry Nodes modifier has for the inputs of its node group.

    The value is None for an input that has none on the modifier, such as the geometry.
    """
    return list(_values(modifier).values())


def let_go(modifier: Any) -> None:
    """Clear those inputs of a Geometry Nodes modifier that point to datablocks.

    Otherwise Blender 5 counts the modifier as a user of the datablocks even after the modifier was removed or was given a different node
    group.
    """
    for identifier, value in _values(modifier).items():
        if isinstance(value, bpy.types.ID):
            _assign(modifier, identifier, None)


def _values(modifier: Any) -> dict[str, Any]:
    found = [socket.identifier for socket in _inputs(modifier.node_group)]
    if capabilities.has_modifier_inputs():
        inputs = modifier.properties.inputs
        return {identifier: getattr(getattr(inputs, identifier, None), "value", None) for identifier in found}
    return {identifier: modifier.get(identifier) for identifier in found}


def link(group: Any, source: Any, target: Any) -> None:
    """Connect two sockets of a node group. source: an output socket, or a value for the default_value of the target socket."""
    if isinstance(source, bpy.types.NodeSocket):
        group.links.new(source, target)
    else:
        target.default_value = source


def input_items(group: Any) -> dict[str, Any]:
    """{name: interface socket} of a node group's inputs. Interface sockets have default_value, min_value and max_value."""
    return {socket.name: socket for socket in _inputs(group)}


def add_node(group: Any, kind: str, **settings: Any) -> Any:
    """Add a node of type `kind` to a node group, to the right of the existing nodes. settings: attributes of the node and values."""
    node = group.nodes.new(kind)
    node.location = (200.0 * (len(group.nodes) - 1), 0.0)
    for name, value in settings.items():
        setattr(node, name, value)
    return node


def named_attribute(group: Any, name: str, data_type: str) -> Any:
    """Add a Named Attribute node for this attribute to a node group; returns the node's output socket."""
    node = add_node(group, "GeometryNodeInputNamedAttribute", data_type=data_type)
    node.inputs["Name"].default_value = name
    return enabled(node.outputs)


def enabled(sockets: Any, name: str | None = None) -> Any:
    """The first enabled socket of a list; with a name, the first enabled socket of this name.

    Before Blender 4 a node has one socket for each data type, and only the socket of the chosen data type is enabled.
    """
    return next(socket for socket in sockets if socket.enabled and name in (None, socket.name))


def _inputs(group: Any) -> list[Any]:
    if not capabilities.has_tree_interface():
        return list(group.inputs)
    return [item for item in group.interface.items_tree if item.item_type == 'SOCKET' and item.in_out == 'INPUT']
