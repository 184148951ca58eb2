"""Add nodes to a node group in a readable layout: labelled frames from left to right, nodes in columns, one input node per frame."""

from ..core.blender import capabilities, node_groups

_ROWS, _COLUMN, _ROW, _GAP = 7, 220.0, 70.0, 90.0
MOST_BLUR = 100
"""Largest width of a blur in pixels, in Blender versions whose Blur node has no socket for the size in pixels."""


class Sheet:
    """Adds nodes to a node group, inside the frame that was begun last."""

    def __init__(self, group):
        self.group = group
        self._frame, self._inputs, self._count, self._left = None, None, 0, 0.0

    def frame(self, label):
        """Begin a frame with this label, to the right of the present nodes."""
        self._tidy()
        self._left += _COLUMN * -(-self._count // _ROWS) + (_GAP if self._count else 0.0)
        self._frame, self._inputs, self._count = self.group.nodes.new("NodeFrame"), None, 0
        self._frame.label = label

    def input(self, name):
        """Socket of the group's input `name`, on the Group Input node in the node frame (labelled box) that was begun last."""
        if self._inputs is None:
            self._inputs = self.node("NodeGroupInput")
            self._count += 2  # the input node is higher than most nodes
        return self._inputs.outputs[name]

    def output(self):
        """Add the Group Output node to the node frame that was begun last; returns the node."""
        return self.node("NodeGroupOutput")

    def finish(self):
        """Hide the unused sockets of the Group Input node in the last node frame; called after the last node was added."""
        self._tidy()

    def node(self, kind, label="", name="", **settings):
        """Add a node of type `kind` to the present frame; returns the node.

        settings: values of the node's properties.
        """
        node = node_groups.add_node(self.group, kind, label=label, **settings)
        if name:
            node.name = name
        node.parent = self._frame
        node.location = (self._left + _COLUMN * (self._count // _ROWS), -_ROW * (self._count % _ROWS))
        self._count += 1
        return node

    def math(self, label, operation, *values, clamp=False):
        """Add a Math node; returns its output socket. values: sockets or numbers. clamp: limit the result to 0 to 1."""
        kind = "ShaderNodeMath" if capabilities.has_shader_nodes_in_compositor() else "CompositorNodeMath"
        node = self.node(kind, label, operation=operation, use_clamp=clamp)
        node.hide = True
        for socket, value in zip(node.inputs, values):
            node_groups.link(self.group, value, socket)
        return node.outputs[0]

    def mix(self, label, blending, factor, first, second):
        """Add a Mix node for colours; returns its output socket.

        blending: Blender's blend type. factor, first, second: sockets or values. The alpha is the first colour's alpha.
        """
        if capabilities.has_shader_nodes_in_compositor():
            node = self.node("ShaderNodeMix", label, data_type='RGBA', blend_type=blending)
        else:
            node = self.node("CompositorNodeMixRGB", label, blend_type=blending)
        node.hide = True
        inputs = [socket for socket in node.inputs if socket.enabled]
        for socket, value in zip(inputs, (factor, first, second)):
            node_groups.link(self.group, value, socket)
        return node_groups.enabled(node.outputs)

    def separate(self, label, color):
        """Add a Separate Color node; returns its sockets for red, green, blue and alpha."""
        node = self.node("CompositorNodeSeparateColor", label)
        node.hide = True
        node_groups.link(self.group, color, node.inputs[0])
        return tuple(node.outputs[name] for name in ("Red", "Green", "Blue", "Alpha"))

    def combine(self, label, *parts):
        """Add a Combine Color node; returns its output socket. parts: red, green, blue and optionally alpha."""
        node = self.node("CompositorNodeCombineColor", label)
        node.hide = True
        for socket, part in zip(node.inputs, parts):
            node_groups.link(self.group, part, socket)
        return node.outputs[0]

    def blur(self, label, source, pixels):
        """Add a Blur node for a picture or matte; returns its output socket.

        pixels: width of the blur, a number or a socket; 0 leaves the picture unchanged; None leaves the node's default.
        """
        if pixels is None:
            node = self.node("CompositorNodeBlur", label)
        elif capabilities.has_compositor_sockets():
            node = self.node("CompositorNodeBlur", label)
            size = node.inputs["Size"]
            node_groups.link(self.group, pixels if hasattr(pixels, "node") else (pixels,) * len(size.default_value), size)
        else:
            share = self.math("", 'DIVIDE', pixels, MOST_BLUR)
            node = self.node("CompositorNodeBlur", label, size_x=MOST_BLUR, size_y=MOST_BLUR)
            node_groups.link(self.group, share, node.inputs["Size"])
        node.hide = True
        node_groups.link(self.group, source, node.inputs["Image"])
        return node.outputs[0]

    def dilate(self, label, source, pixels, name=""):
        """Add a Dilate/Erode node that grows a matte by a number of pixels, or shrinks it if the number is negative.

        pixels: a number; from Blender 4.5 on also a socket. Returns the output socket.
        """
        node = self.node("CompositorNodeDilateErode", label, name)
        node_groups.link(self.group, source, node.inputs["Mask"])
        if capabilities.has_compositor_sockets():
            node_groups.link(self.group, pixels, node.inputs["Size"])
        else:
            node.distance = pixels
        return node.outputs[0]

    def kept(self, source):
        """Return a socket with the value of `source` that is computed once, however many nodes read it.

        Before Blender 4.0 the compositor computes a pixel anew along every path through the nodes, except behind nodes that read several
        pixels; such a node is added there.
        """
        if capabilities.computes_nodes_once():
            return source
        return self.blur("Kept", source, None) if source.type == 'RGBA' else self.dilate("Kept", source, 0)

    def _tidy(self):
        if self._inputs is not None:
            for socket in self._inputs.outputs:
                socket.hide = not socket.is_linked
