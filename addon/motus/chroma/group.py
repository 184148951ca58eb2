"""The node group that keys: source and background in, the view that is chosen and the matte out."""

import bpy

from ..core import capabilities, node_groups
from . import settings

KEY = "motus_chroma"
"""Custom property of the group, of the nodes around it, and of images that were loaded for it."""
COMPOSITE, MATTE, STATUS, SOURCE = VIEWS = 'COMPOSITE', 'MATTE', 'STATUS', 'SOURCE'
"""Names of the nodes whose first output is a view."""
_CLEAR, _OPAQUE = 0.002, 0.998
"""Mattes beyond which a pixel counts as clear or opaque in the status."""


def build(width):
    """A new group for pictures of so many pixels across."""
    group = bpy.data.node_groups.new("Chroma Key", 'CompositorNodeTree')
    group[KEY] = True
    _add_sockets(group)
    start, end = (node_groups.add_node(group, kind) for kind in ("NodeGroupInput", "NodeGroupOutput"))
    keying = node_groups.add_node(group, "CompositorNodeKeying", name=settings.KEYING, label="Key")
    node_groups.link(group, start.outputs["Image"], keying.inputs["Image"])
    node_groups.link(group, start.outputs[settings.COLOR], keying.inputs["Key Color"])
    node_groups.link(group, start.outputs[settings.MASK], keying.inputs["Garbage Matte"])
    # Keying does not clip what it takes for an edge, and any noise is one to it.
    if capabilities.has_compositor_sockets():
        sockets = {socket.identifier: socket for socket in keying.inputs}
        sockets["Edge Tolerance"].default_value = 1.0
        for one in settings.OF_KEYING:
            node_groups.link(group, start.outputs[one.label], sockets[one.socket])
    else:
        keying.edge_kernel_tolerance = 1.0

    # The subject's alpha, and not the matte alone: the source may have been transparent before.
    alpha = node_groups.add_node(group, "CompositorNodeSeparateColor", label="Alpha")
    node_groups.link(group, keying.outputs["Image"], alpha.inputs[0])
    matte = alpha.outputs["Alpha"]
    wrapped = _light_wrap(group, start, keying.outputs["Image"], matte, max(1, round(0.05 * width)))
    over = node_groups.add_node(group, "CompositorNodeAlphaOver", label="Over")
    background, foreground = _layers(over)
    node_groups.link(group, start.outputs["Background"], background)
    node_groups.link(group, wrapped, foreground)

    for name, label, source in ((COMPOSITE, "Composite", over.outputs[0]), (MATTE, "Matte", matte),
                                (STATUS, "Status", _status(group, matte)), (SOURCE, "Source", start.outputs["Image"])):
        node_groups.link(group, source, node_groups.add_node(group, "NodeReroute", name=name, label=label).inputs[0])
    node_groups.link(group, matte, end.inputs["Matte"])
    show(group, COMPOSITE)
    end.location.x = 200.0 * len(group.nodes)
    return group


def is_group(tree):
    """Whether a node tree is such a group."""
    return tree is not None and KEY in tree


def view(group):
    """Which view comes out of a group; None where somebody has connected something else."""
    link = next((link for link in group.links if link.to_node.bl_idname == "NodeGroupOutput" and link.to_socket.name == "Image"), None)
    return link.from_node.name if link is not None and link.from_node.name in VIEWS else None


def show(group, wanted):
    """Let a view come out."""
    end = next((node for node in group.nodes if node.bl_idname == "NodeGroupOutput"), None)
    source = group.nodes.get(wanted)
    if end is not None and source is not None and "Image" in end.inputs:
        node_groups.link(group, source.outputs[0], end.inputs["Image"])


def _add_sockets(group):
    node_groups.add_sockets(group, (
        ("Image", 'INPUT', "NodeSocketColor"), ("Background", 'INPUT', "NodeSocketColor"),
        (settings.COLOR, 'INPUT', "NodeSocketColor"), (settings.MASK, 'INPUT', "NodeSocketFloat"),
        (settings.WRAP, 'INPUT', "NodeSocketFloat"),
        ("Image", 'OUTPUT', "NodeSocketColor"), ("Matte", 'OUTPUT', "NodeSocketFloat")))
    inputs = node_groups.input_items(group)
    inputs["Background"].default_value = (0.0, 0.0, 0.0, 0.0)
    for name in (settings.MASK, settings.WRAP):
        _limit(inputs[name], 0.0, 0.0, 1.0)
    if capabilities.has_compositor_sockets():
        node_groups.add_sockets(group, [
            (one.label, 'INPUT', "NodeSocketInt" if one.is_whole else "NodeSocketFloat") for one in settings.OF_KEYING])
        inputs = node_groups.input_items(group)
        for one in settings.OF_KEYING:
            _limit(inputs[one.label], one.default, one.least, one.most)


def _limit(socket, default, least, most):
    socket.min_value, socket.max_value = least, most
    socket.default_value = default


def _light_wrap(group, start, keyed, matte, size):
    """The keyed picture with the light of the background around its edge."""
    light = _blur(group, start.outputs["Background"], size)
    around = _blur(group, _math(group, 'SUBTRACT', 1.0, matte), size)
    edge = _math(group, 'MULTIPLY', around, matte)
    amount = _math(group, 'MULTIPLY', edge, start.outputs[settings.WRAP])
    return _add(group, amount, keyed, light)


def _status(group, matte):
    """Black where the picture is clear, white where it is opaque, grey between."""
    is_not_clear = _math(group, 'GREATER_THAN', matte, _CLEAR)
    is_opaque = _math(group, 'GREATER_THAN', matte, _OPAQUE)
    return _math(group, 'MULTIPLY', _math(group, 'ADD', is_not_clear, is_opaque), 0.5)


def _math(group, operation, first, second):
    kind = "ShaderNodeMath" if capabilities.has_shader_nodes_in_compositor() else "CompositorNodeMath"
    node = node_groups.add_node(group, kind, operation=operation)
    node_groups.link(group, first, node.inputs[0])
    node_groups.link(group, second, node.inputs[1])
    return node.outputs[0]


def _add(group, factor, first, second):
    """The first colour, and of the second the factor's share; the alpha is the first one's."""
    if capabilities.has_shader_nodes_in_compositor():
        node = node_groups.add_node(group, "ShaderNodeMix", data_type='RGBA', blend_type='ADD')
    else:
        node = node_groups.add_node(group, "CompositorNodeMixRGB", blend_type='ADD')
    inputs = [socket for socket in node.inputs if socket.enabled]
    for socket, source in zip(inputs, (factor, first, second)):
        node_groups.link(group, source, socket)
    return node_groups.enabled(node.outputs)


def _blur(group, source, size):
    node = node_groups.add_node(group, "CompositorNodeBlur")
    if capabilities.has_compositor_sockets():
        node.inputs["Size"].default_value = (size, size)
    else:
        node.size_x = node.size_y = size
    node_groups.link(group, source, node.inputs["Image"])
    return node.outputs[0]


def _layers(over):
    """Sockets of the background and of the foreground of a node Alpha Over."""
    if "Background" in over.inputs:
        return over.inputs["Background"], over.inputs["Foreground"]
    return over.inputs[1], over.inputs[2]
