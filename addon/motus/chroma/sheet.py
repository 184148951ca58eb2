"""A node group as a sheet of arithmetic: labelled frames from left to right, nodes in columns, and the group's inputs in each frame."""

from ..core.blender import capabilities, node_groups

_ROWS, _COLUMN, _ROW, _GAP = 7, 220.0, 70.0, 90.0
MOST_BLUR = 100
"""Pixels of the widest blur."""


class Sheet:
    """Adds nodes to a group, into the frame that was begun last."""

    def __init__(self, group):
        self.group = group
        self._frame, self._inputs, self._count, self._left = None, None, 0, 0.0

    def frame(self, label):
        """Begin a frame, to the right of what is there."""
        self._tidy()
        self._left += _COLUMN * -(-self._count // _ROWS) + (_GAP if self._count else 0.0)
        self._frame, self._inputs, self._count = self.group.nodes.new("NodeFrame"), None, 0
        self._frame.label = label

    def input(self, name):
        """The socket of one of the group's inputs, on a node of this frame."""
        if self._inputs is None:
            self._inputs = self.node("NodeGroupInput")
            self._count += 2  # the node is higher than others
        return self._inputs.outputs[name]

    def output(self):
        """The node of the group's outputs."""
        return self.node("NodeGroupOutput")

    def finish(self):
        """Hide the inputs that the last frame does not use."""
        self._tidy()

    def node(self, kind, label="", name="", **settings):
        """A node in the frame."""
        node = node_groups.add_node(self.group, kind, label=label, **settings)
        if name:
            node.name = name
        node.parent = self._frame
        node.location = (self._left + _COLUMN * (self._count // _ROWS), -_ROW * (self._count % _ROWS))
        self._count += 1
        return node

    def math(self, label, operation, *values, clamp=False):
        """The result of a node Math. values: sockets or numbers."""
        kind = "ShaderNodeMath" if capabilities.has_shader_nodes_in_compositor() else "CompositorNodeMath"
        node = self.node(kind, label, operation=operation, use_clamp=clamp)
        node.hide = True
        for socket, value in zip(node.inputs, values):
            node_groups.link(self.group, value, socket)
        return node.outputs[0]

    def mix(self, label, blending, factor, first, second):
        """A colour of two, by a node Mix; the alpha is the first one's."""
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
        """Sockets of red, green, blue and alpha."""
        node = self.node("CompositorNodeSeparateColor", label)
        node.hide = True
        node_groups.link(self.group, color, node.inputs[0])
        return tuple(node.outputs[name] for name in ("Red", "Green", "Blue", "Alpha"))

    def combine(self, label, *parts):
        """The colour of red, green, blue and alpha."""
        node = self.node("CompositorNodeCombineColor", label)
        node.hide = True
        for socket, part in zip(node.inputs, parts):
            node_groups.link(self.group, part, socket)
        return node.outputs[0]

    def blur(self, label, source, pixels):
        """A picture or matte, blurred by a socket's or a number's pixels; by none without."""
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
        """A matte that is grown, or shrunk by less than no pixels. pixels: a number, from 4.5 on a socket too."""
        node = self.node("CompositorNodeDilateErode", label, name)
        node_groups.link(self.group, source, node.inputs["Mask"])
        if capabilities.has_compositor_sockets():
            node_groups.link(self.group, pixels, node.inputs["Size"])
        else:
            node.distance = pixels
        return node.outputs[0]

    def kept(self, source):
        """What comes out of a socket, computed once for all nodes that read it.

        Before 4.0 Blender computes a pixel anew along every way through the nodes, but for what nodes make that look at more pixels.
        """
        if capabilities.computes_nodes_once():
            return source
        return self.blur("Kept", source, None) if source.type == 'RGBA' else self.dilate("Kept", source, 0)

    def _tidy(self):
        if self._inputs is not None:
            for socket in self._inputs.outputs:
                socket.hide = not socket.is_linked
