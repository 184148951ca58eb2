"""Node groups, and the modifiers that have them, in every Blender."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import bpy

from . import capabilities


def add_sockets(group: Any, sockets: Iterable[tuple[str, str, str]]) -> None:
    """Give a new group sockets: (name, 'INPUT' or 'OUTPUT', type) each."""
    for name, way, kind in sockets:
        if capabilities.has_tree_interface():
            group.interface.new_socket(name, in_out=way, socket_type=kind)
        else:
            (group.inputs if way == 'INPUT' else group.outputs).new(kind, name)


def has_inputs(group: Any, names: Iterable[str]) -> bool:
    """Whether a group has them all, which somebody may have removed."""
    return {socket.name for socket in _inputs(group)}.issuperset(names)


def set_input(modifier: Any, name: str, value: Any) -> None:
    """Give the modifier's group a value for one of its inputs."""
    _assign(modifier, _identifier(modifier, name), value)


def input_of(modifier: Any, name: str) -> Any:
    """The modifier's value for one of its group's inputs."""
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
    """Empty the inputs that name datablocks: Blender 5 goes on to count what a modifier had that is removed, or has another group."""
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
    """Connect two sockets; a value stands for a source that is none."""
    if isinstance(source, bpy.types.NodeSocket):
        group.links.new(source, target)
    else:
        target.default_value = source


def input_items(group: Any) -> dict[str, Any]:
    """Inputs of a group as its interface has them, by name: with default_value, min_value and max_value."""
    return {socket.name: socket for socket in _inputs(group)}


def add_node(group: Any, kind: str, **settings: Any) -> Any:
    """A new node, to the right of the others."""
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
