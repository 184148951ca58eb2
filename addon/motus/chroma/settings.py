"""Settings of a chroma key: which node stores each setting, and its keyword in scripts.

The settings are inputs of the key's node group, so that Blender itself keys, drives and saves them. Before Blender 4.5 *Grow Matte* is a
property of a node in the group. Node groups of older Motus versions contain a Keying node, whose properties or inputs are the settings.
"""

from typing import NamedTuple

GROW = "Grow"
"""Name of the node, in the key's node group, that grows or shrinks the matte."""
_KEYING = "Key"
"""Name of the Keying node in node groups of older Motus versions."""


class Setting(NamedTuple):
    """One setting of a key, an input of its node group. keyword: name of the operator's property and of the argument in scripts.

    old_socket, old_property: where node groups of older versions keep the value: a socket of their Keying node, and the
    property of that node before Blender 4.5.
    """

    keyword: str
    label: str
    description: str
    default: float
    least: float
    most: float
    old_socket: str = ""
    old_property: str = ""

    @property
    def is_whole(self):
        """Whether the setting is an integer: a number of pixels. All other settings are floats."""
        return isinstance(self.default, int)


OF_KEYING = (
    Setting("black", "Clip Black", "Level of the matte below which all is transparent", 0.0, 0.0, 1.0, "Black Level", "clip_black"),
    Setting("white", "Clip White", "Level of the matte above which all is opaque", 1.0, 0.0, 1.0, "White Level", "clip_white"),
    Setting(
        "balance",
        "Balance",
        "Which of the two other channels the screen's channel is compared with: 0 the larger, 1 the smaller",
        0.0,
        0.0,
        1.0,
        "Key Balance",
        "screen_balance",
    ),
    Setting(
        "smooth",
        "Smooth Color",
        "Pixels over which colour is smoothed before it is keyed, for noise and compressed colour",
        0,
        0,
        64,
        "Preprocess Blur Size",
        "blur_pre",
    ),
    Setting(
        "grow",
        "Grow Matte",
        "Pixels by which the matte grows; below 0 it is choked",
        0,
        -100,
        100,
        "Postprocess Dilate Size",
        "dilate_distance",
    ),
    Setting("feather", "Feather", "Pixels over which the matte's edge is made soft", 0, 0, 100, "Postprocess Blur Size", "blur_post"),
    Setting(
        "despill",
        "Despill",
        "How much of the screen's light is taken from the subject",
        1.0,
        0.0,
        1.0,
        "Despill Strength",
        "despill_factor",
    ),
    Setting(
        "gain",
        "Screen Gain",
        "Factor on the amount of screen in a pixel: above 1 dark parts of the screen become transparent too",
        1.0,
        0.0,
        10.0,
    ),
    Setting(
        "core",
        "Core Fill",
        "Level up to which holes well inside the subject are filled; the subject's edge stays soft, and 0 fills no holes",
        0.0,
        0.0,
        1.0,
    ),
    Setting(
        "limit",
        "Despill Limit",
        "What limits the screen's green or blue on the subject, from the two other colors of each pixel",
        0.0,
        0.0,
        1.0,
    ),
    Setting("luminance", "Keep Light", "Share of the light removed by despill that is added again as grey", 1.0, 0.0, 1.0),
)
BY_KEYWORD = {one.keyword: one for one in OF_KEYING}
COLOR, MASK, CORE_MASK, WRAP = "Screen Color", "Garbage Mask", "Core Mask", "Light Wrap"
"""Names of inputs that the key's node group has in every Blender version."""
LIMITS = {'MAXIMUM': 0.0, 'DOUBLE': 1.0 / 3.0, 'AVERAGE': 0.5}
"""Values of the setting *Despill Limit* by name: which mixture of the remaining channels limits the screen's channel."""


def place(key, setting):
    """Where a setting is stored: (node or socket, name of its property); None if the user has removed it.

    key: the key's node in the compositor.
    """
    found = _input(key.inputs, setting.label)
    if found is None and setting.keyword == "grow":
        found = _of_node(key, GROW, "distance", "Size")
    return found or _of_node(key, _KEYING, setting.old_property, setting.old_socket)


def place_of_input(key, name):
    """Where an input of the key's node is stored: (socket, "default_value"); None if the user has removed the input.

    name: one of the inputs that the node group has in every Blender version.
    """
    return _input(key.inputs, name)


def value(key, keyword):
    """Value of a key's setting; the setting's default if the user has removed its input."""
    found = place(key, BY_KEYWORD[keyword])
    return getattr(*found) if found else BY_KEYWORD[keyword].default


def assign(key, setting, value):
    """Assign a value to a setting of a key; nothing happens if the key does not have the setting."""
    found = place(key, setting)
    if found is not None:
        owner, name = found
        setattr(owner, name, value)


def _of_node(key, name, property_name, identifier):
    """Where a setting is stored on the node `name` within the key's node group: (holder, name of its property), or None.

    identifier: of the node's socket. property_name: the node's property in Blender versions without that socket.
    """
    node = key.node_tree.nodes.get(name)
    if node is None or not property_name:
        return None
    if hasattr(node, property_name):
        return node, property_name
    socket = next((socket for socket in node.inputs if socket.identifier == identifier), None)
    return None if socket is None else (socket, "default_value")


def _input(inputs, name):
    socket = inputs.get(name)
    return None if socket is None else (socket, "default_value")
