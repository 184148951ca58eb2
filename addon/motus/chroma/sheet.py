"""Layout of a node group: labelled frames from left to right with nodes in columns, and one input node for each frame."""

from ..core.blender import capabilities, node_groups

_ROWS, _COLUMN, _ROW, _GAP = 7, 220.0, 70.0, 90.0
MOST_BLUR = 100
"""Largest width of a blur, in pixels."""


class Sheet:
    """Adds nodes to a group, into the frame that was begun last."""

    def __init__(self, group):
        self.group = group
        self._frame, self._inputs, self._count, self._left = None, None, 0, 0.0

    def frame(self, label):
        """Begin a frame to the right of the present nodes."""
        self._tidy()
        self._left += _COLUMN * -(-self._count // _ROWS) + (_GAP if self._count else 0.0)
        self._frame, self._inputs, self._count = self.group.nodes.new("NodeFrame"), None, 0
        self._frame.label = label

    def input(self, name):
        """Socket of one of the group's inputs, on the input node of the present frame."""
        if self._inputs is None:
            self._inputs = self.node("NodeGroupInput")
            self._count += 2  # the input node is higher than other nodes
        return self._inputs.outputs[name]

    def output(self):
        """The group's output node."""
        return self.node("NodeGroupOutput")

    def finish(self):
        """Hide the unused sockets of the last frame's input node."""
        self._tidy()

    def node(self, kind, label="", name="", **settings):
        """Add a node to the present frame."""
        node = node_groups.add_node(self.group, kind, label=label, **settings)
        if name:
            node.name = name
        node.parent = self._frame
        node.location = (self._left + _COLUMN * (self._count // _ROWS), -_ROW * (self._count % _ROWS))
        self._count += 1
        return node

    def math(self, label, operation, *values, clamp=False):
        """Add a Math node; returns its output. values: sockets or numbers."""
        kind = "ShaderNodeMath" if capabilities.has_shader_nodes_in_compositor() else "CompositorNodeMath"
        node = self.node(kind, label, operation=operation, use_clamp=clamp)
        node.hide = True
        for socket, value in zip(node.inputs, values):
            node_groups.link(self.group, value, socket)
        return node.outputs[0]

    def mix(self, label, blending, factor, first, second):
        """Add a Mix node for colours; returns its output. Alpha is that of the first colour."""
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
        """Sockets of red, green, blue and alpha of a colour."""
        node = self.node("CompositorNodeSeparateColor", label)
        node.hide = True
        node_groups.link(self.group, color, node.inputs[0])
        return tuple(node.outputs[name] for name in ("Red", "Green", "Blue", "Alpha"))

    def combine(self, label, *parts):
        """Colour from red, green, blue and alpha."""
        node = self.node("CompositorNodeCombineColor", label)
        node.hide = True
        for socket, part in zip(node.inputs, parts):
            node_groups.link(self.group, part, socket)
        return node.outputs[0]

    def blur(self, label, source, pixels):
        """Blur a picture or matte by a number of pixels, which may be a socket; 0 leaves it as it is."""
        if pixels is None:
            node = self.node("CompositorNodeBlur", label)
        elif capabilities.has_compositor_sockets():
            node = self.node("CompositorNodeBlur", label)
            node_groups.link(self.group, pixels if hasattr(pixels, "node") else (pixels, pixels), node.inputs["Size"])
        else:
            share = self.math("", 'DIVIDE', pixels, MOST_BLUR)
            node = self.node("CompositorNodeBlur", label, size_x=MOST_BLUR, size_y=MOST_BLUR)
            node_groups.link(self.group, share, node.inputs["Size"])
        node.hide = True
        node_groups.link(self.group, source, node.inputs["Image"])
        return node.outputs[0]

    def dilate(self, label, source, pixels, name=""):
        """Grow a matte by a number of pixels, or shrink it if the number is below 0. pixels: number; from 4.5 on a socket too."""
        node = self.node("CompositorNodeDilateErode", label, name)
        node_groups.link(self.group, source, node.inputs["Mask"])
        if capabilities.has_compositor_sockets():
            node_groups.link(self.group, pixels, node.inputs["Size"])
        else:
            node.distance = pixels
        return node.outputs[0]

    def kept(self, source):
        """Output of a node that caches a socket's value for all nodes that read it.

        Before 4.0 Blender computes a pixel anew along every path through the nodes, except for nodes that read several pixels.
        """
        if capabilities.computes_nodes_once():
            return source
        return self.blur("Kept", source, None) if source.type == 'RGBA' else self.dilate("Kept", source, 0)

    def _tidy(self):
        if self._inputs is not None:
            for socket in self._inputs.outputs:
                socket.hide = not socket.is_linked
