"""Settings of the key: where each stands in a set-up, and what scripts call it.

The settings are Blender's own properties, which are keyed, driven and saved without Motus: inputs of the node group, or where
the node Keying has no sockets for them (before 4.5) properties of that node.
"""

from typing import NamedTuple

from ..core import capabilities

KEYING = "Key"
"""Name of the node Keying within the group."""


class Setting(NamedTuple):
    """One setting of the node Keying. keyword: of the operator, too. socket: identifier of the node's input. property: of the node."""

    keyword: str
    label: str
    description: str
    socket: str
    property: str
    default: float
    least: float
    most: float

    @property
    def is_whole(self):
        """Whether it counts pixels."""
        return isinstance(self.default, int)


OF_KEYING = (
    Setting("black", "Clip Black", "Level of the matte below which all is transparent", "Black Level", "clip_black", 0.0, 0.0, 1.0),
    Setting("white", "Clip White", "Level of the matte above which all is opaque", "White Level", "clip_white", 1.0, 0.0, 1.0),
    Setting("balance", "Balance", "Which of the two other channels the screen's channel is compared with: 0 the larger, 1 the smaller",
            "Key Balance", "screen_balance", 0.5, 0.0, 1.0),
    Setting("smooth", "Smooth Color", "Pixels over which colour is smoothed before it is keyed, for noise and compressed colour",
            "Preprocess Blur Size", "blur_pre", 0, 0, 64),
    Setting("grow", "Grow Matte", "Pixels by which the matte grows; below 0 it is choked", "Postprocess Dilate Size", "dilate_distance",
            0, -100, 100),
    Setting("feather", "Feather", "Pixels over which the matte's edge is made soft", "Postprocess Blur Size", "blur_post", 0, 0, 100),
    Setting("despill", "Despill", "How much of the screen's light is taken from the subject", "Despill Strength", "despill_factor",
            1.0, 0.0, 1.0),
)
COLOR, MASK, WRAP = "Screen Color", "Garbage Mask", "Light Wrap"
"""Inputs that the group has in every Blender."""


def place(key, setting):
    """(what holds the setting, name of the property there) of a set-up; None where somebody has taken it away.

    key: the node in the compositor.
    """
    if capabilities.has_compositor_sockets():
        return _input(key, setting.label)
    node = key.node_tree.nodes.get(KEYING)
    return (node, setting.property) if node is not None and hasattr(node, setting.property) else None


def place_of_input(key, name):
    """The same of one of the inputs that the group has in every Blender."""
    return _input(key, name)


def assign(key, setting, value):
    """Set one, if it is there."""
    found = place(key, setting)
    if found is not None:
        setattr(*found, value)


def _input(key, name):
    socket = key.inputs.get(name)
    return None if socket is None else (socket, "default_value")
