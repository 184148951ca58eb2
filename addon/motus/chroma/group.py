"""Node group that computes a chroma key. Inputs are picture and background; outputs are the chosen view and the matte.

Let g be the screen's channel (green or blue), S the screen's colour, and m(C) = C_g - mix(larger, smaller of the two remaining channels).
The key is alpha = clamp(1 - gain m(C) / m(S)), and the premultiplied foreground is C - (1 - alpha) S. The native function screen_matte()
computes the alpha by this formula too.
"""

import bpy

from ..core.blender import capabilities, node_groups
from ..core.file import stored
from . import settings
from .sheet import Sheet

KEY = "motus_chroma"
"""Custom property that marks the key's node group, the nodes that were added around it, and images that were loaded for it."""
COMPOSITE, MATTE, STATUS, SOURCE = VIEWS = 'COMPOSITE', 'MATTE', 'STATUS', 'SOURCE'
"""Names of the nodes whose first outputs are the views: composite, matte, status (a check of the matte) and source footage."""
_CLEAR, _OPAQUE = 0.002, 0.998
"""The status view shows a pixel black if its matte is at most the first value, white above the second, and grey between."""
_CORE, _WRAP = 0.01, 0.05
"""Shares of the picture's width: by how much the core matte is inset from the edge, and the width of the light wrap."""
_GREEN, _BLUE = 0.7152, 0.0722
"""Luminance of green and of blue (Rec. 709)."""
_LEAST = 1e-6
"""Least difference between the white and the black clip level, which avoids a division by 0."""


def build(width):
    """Create the node group of a key for pictures of this width in pixels; returns the group."""
    group = bpy.data.node_groups.new("Chroma Key", 'CompositorNodeTree')
    group[KEY] = True
    _add_sockets(group)
    sheet = Sheet(group)
    straight, smooth, covered = _picture(sheet)
    is_green, is_blue, difference, screen_difference = _differences(sheet, smooth)
    alpha = _key(sheet, difference, screen_difference)
    inside = _masks(sheet, _edge(sheet, _levels(sheet, alpha)), _core(sheet, alpha, width))
    picture, share = _foreground(sheet, straight, alpha, inside)
    parts = _despill(sheet, picture, is_green, is_blue)
    sheet.frame("Premultiplied Foreground")
    matte = sheet.math("Matte", 'MULTIPLY', inside, covered)
    factor = sheet.math("Factor", 'MULTIPLY', share, covered)
    scaled = [sheet.math(label, 'MULTIPLY', part, factor) for label, part in zip(("Red", "Green", "Blue"), parts)]
    foreground = sheet.combine("Foreground", *scaled, matte)
    _views(sheet, _light_wrap(sheet, foreground, matte, width), matte)
    sheet.finish()
    show(group, COMPOSITE)
    return group


def is_group(tree):
    """Whether a node tree is the node group of a chroma key."""
    return tree is not None and KEY in tree


def role(node):
    """Role of a node that was added around a key's node; "" for a node of the user."""
    try:
        return stored.text(node.get(KEY))
    except stored.Damaged:
        return ""


def is_of_older_version(tree):
    """Whether a key's node group uses Blender's Keying node, as groups of older Motus versions do."""
    return any(node.bl_idname == "CompositorNodeKeying" for node in tree.nodes)


def view(group):
    """Name of the view, one of VIEWS, that a node group outputs as its image; None if the user has connected a different node."""
    link = next((link for link in group.links if link.to_node.bl_idname == "NodeGroupOutput" and link.to_socket.name == "Image"), None)
    return link.from_node.name if link is not None and link.from_node.name in VIEWS else None


def show(group, wanted):
    """Connect a view (one of VIEWS) with the image output of a key's node group."""
    end = next((node for node in group.nodes if node.bl_idname == "NodeGroupOutput"), None)
    source = group.nodes.get(wanted)
    if end is not None and source is not None and "Image" in end.inputs:
        node_groups.link(group, source.outputs[0], end.inputs["Image"])


def _add_sockets(group):
    """Add the sockets of the group. Their order must not change: the data paths of keyed inputs contain the index of the socket."""
    has_whole = capabilities.has_compositor_sockets()
    shown = [one for one in settings.OF_KEYING if has_whole or one.keyword != "grow"]
    node_groups.add_sockets(
        group,
        (
            ("Image", 'INPUT', "NodeSocketColor"),
            ("Background", 'INPUT', "NodeSocketColor"),
            (settings.COLOR, 'INPUT', "NodeSocketColor"),
            (settings.MASK, 'INPUT', "NodeSocketFloat"),
            (settings.WRAP, 'INPUT', "NodeSocketFloat"),
            *((one.label, 'INPUT', "NodeSocketInt" if one.is_whole and has_whole else "NodeSocketFloat") for one in shown),
            (settings.CORE_MASK, 'INPUT', "NodeSocketFloat"),
            ("Image", 'OUTPUT', "NodeSocketColor"),
            ("Matte", 'OUTPUT', "NodeSocketFloat"),
        ),
    )
    inputs = node_groups.input_items(group)
    inputs["Background"].default_value = (0.0, 0.0, 0.0, 0.0)
    for name in (settings.MASK, settings.WRAP, settings.CORE_MASK):
        _limit(inputs[name], 0.0, 0.0, 1.0)
    for one in shown:
        _limit(inputs[one.label], one.default, one.least, one.most)


def _limit(socket, default, least, most):
    socket.min_value, socket.max_value = least, most
    socket.default_value = default


def _picture(sheet):
    """Add the nodes that prepare the picture; returns sockets: (straight colours, colours smoothed for keying, alpha of the picture)."""
    sheet.frame("Picture, Straight")
    image = sheet.kept(sheet.input("Image"))
    covered = sheet.separate("Own Alpha", image)[3]
    straight = sheet.mix("Color / Alpha", 'DIVIDE', 1.0, image, covered)
    return straight, sheet.blur("Smooth Color", straight, sheet.input("Smooth Color")), covered


def _differences(sheet, picture):
    """Add nodes that compute the colour difference m: the screen's channel minus a mix of the other two channels.

    Returns four sockets: 1 for a green screen, 1 for a blue screen, m of the picture, m of the screen color.
    """
    sheet.frame("Screen's Channel")
    screen = sheet.separate("Screen Color", sheet.input(settings.COLOR))
    is_blue = sheet.math("Is Blue", 'GREATER_THAN', screen[2], screen[1])
    is_green = sheet.math("Is Green", 'SUBTRACT', 1.0, is_blue)
    found = []
    for label, parts in (("Difference of Picture", None), ("Difference of Screen", screen)):
        sheet.frame(label)
        parts = parts or sheet.separate("Picture", picture)
        own, limit = _channels(sheet, parts, is_green, is_blue, sheet.input("Balance"))
        found.append(sheet.math("m = Own - Others", 'SUBTRACT', own, limit))
    return is_green, is_blue, *found


def _channels(sheet, parts, is_green, is_blue, balance):
    """Add nodes that split a colour: (the screen's channel, a mixture of the two remaining channels by `balance`), as sockets."""
    red, green, blue, _ = parts
    own = _either(sheet, "Own Channel", green, is_green, blue, is_blue)
    other = _either(sheet, "Other Channel", blue, is_green, green, is_blue)
    larger, smaller = (sheet.math(label, operation, red, other) for label, operation in (("Larger", 'MAXIMUM'), ("Smaller", 'MINIMUM')))
    between = sheet.math("Smaller - Larger", 'SUBTRACT', smaller, larger)
    return own, sheet.math("Others Mixed", 'MULTIPLY_ADD', balance, between, larger)


def _either(sheet, label, first, is_first, second, is_second):
    """Add nodes that choose one of two values; is_first and is_second are 0 or 1. Returns the socket of the chosen value."""
    return sheet.math(label, 'MULTIPLY_ADD', second, is_second, sheet.math("", 'MULTIPLY', first, is_first))


def _key(sheet, difference, screen_difference):
    """Add the nodes that compute alpha from the colour differences; alpha is 1 everywhere if the screen is neither green nor blue."""
    sheet.frame("Key: 1 - Gain m(Picture) / m(Screen)")
    share = sheet.math("m / m(Screen)", 'DIVIDE', difference, screen_difference)
    is_keyable = sheet.math("Is Green or Blue", 'GREATER_THAN', screen_difference, 0.0)
    gain = sheet.math("Gain", 'MULTIPLY', sheet.input("Screen Gain"), is_keyable)
    return sheet.kept(sheet.math("Alpha", 'SUBTRACT', 1.0, sheet.math("Gained", 'MULTIPLY', share, gain), clamp=True))


def _levels(sheet, alpha):
    sheet.frame("Levels")
    return _between(sheet, alpha, sheet.input("Clip Black"), sheet.input("Clip White"))


def _between(sheet, matte, black, white):
    """Add the nodes that remap a matte: 0 at the level `black`, 1 at the level `white`, clamped. Returns the output socket."""
    width = sheet.math("Width", 'MAXIMUM', sheet.math("White - Black", 'SUBTRACT', white, black), _LEAST)
    return sheet.math("Leveled", 'DIVIDE', sheet.math("- Black", 'SUBTRACT', matte, black), width, clamp=True)


def _edge(sheet, matte):
    sheet.frame("Edge: Grow and Feather")
    # Before Blender 4.5 the Dilate/Erode node has a property instead of a socket.
    pixels = sheet.input("Grow Matte") if capabilities.has_compositor_sockets() else 0
    grown = sheet.dilate("Grow Matte", matte, pixels, settings.GROW)
    return sheet.blur("Feather", grown, sheet.input("Feather"))


def _core(sheet, alpha, width):
    """Add the nodes of the core matte, which fills holes inside the subject; returns its socket.

    The setting *Core Fill* says up to which level holes are filled; if it is 0, the core matte is 0 everywhere. width: of the picture, in
    pixels.
    """
    sheet.frame("Core: Holes Inside Are Filled")
    fill, black = sheet.input("Core Fill"), sheet.input("Clip Black")
    filled = _between(sheet, alpha, black, sheet.math("1 - Fill", 'SUBTRACT', 1.0, fill))
    inset = max(1, round(_CORE * width))
    soft = sheet.blur("Soften", sheet.dilate("Inset", filled, -2 * inset), inset)
    return sheet.math("If Filled", 'MULTIPLY', soft, sheet.math("Is Filled", 'GREATER_THAN', fill, 0.0))


def _masks(sheet, edge, core):
    """Add the nodes that combine the edge matte and the core matte with the garbage mask and the core mask; returns the matte."""
    sheet.frame("Masks")
    kept = sheet.math("Edge or Core", 'MAXIMUM', edge, core)
    kept = sheet.math("Or Core Mask", 'MAXIMUM', kept, sheet.input(settings.CORE_MASK))
    return sheet.math("Inside", 'MULTIPLY', kept, sheet.math("1 - Garbage", 'SUBTRACT', 1.0, sheet.input(settings.MASK), clamp=True))


def _foreground(sheet, straight, alpha, inside):
    """Add the nodes of the foreground; returns sockets: (picture without the screen's light, factor on it).

    If the matte `inside` is greater than alpha, more of the picture stays. If it is less than alpha, the factor scales the foreground.
    """
    sheet.frame("Foreground: Picture - (1 - Alpha) Screen")
    greater = sheet.math("Alpha or Matte", 'MAXIMUM', alpha, inside)
    rest = sheet.math("1 - Alpha", 'SUBTRACT', 1.0, greater)
    taken = sheet.mix("- Screen", 'SUBTRACT', rest, straight, sheet.input(settings.COLOR))
    least = sheet.mix("Not below 0", 'DARKEN', 1.0, straight, (0.0, 0.0, 0.0, 1.0))
    return sheet.kept(sheet.mix("At Least", 'LIGHTEN', 1.0, taken, least)), sheet.math("Matte / Alpha", 'DIVIDE', inside, greater)


def _despill(sheet, picture, is_green, is_blue):
    """Add the nodes that remove the screen's light from the subject; returns sockets for red, green and blue.

    The screen's channel is limited by the remaining channels. The removed light is added again as grey of equal luminance.
    """
    sheet.frame("Despill")
    red, green, blue, alpha = sheet.separate("Foreground", picture)
    own, limit = _channels(sheet, (red, green, blue, alpha), is_green, is_blue, sheet.input("Despill Limit"))
    spill = sheet.math("Not below 0", 'MAXIMUM', sheet.math("Own - Limit", 'SUBTRACT', own, limit), 0.0)
    spill = sheet.kept(sheet.math("Spill", 'MULTIPLY', spill, sheet.input("Despill")))
    sheet.frame("Keep Light")
    weight = sheet.math("Luminance of Channel", 'MULTIPLY_ADD', is_blue, _BLUE - _GREEN, _GREEN)
    grey = sheet.math("Grey", 'MULTIPLY', sheet.math("", 'MULTIPLY', spill, weight), sheet.input("Keep Light"))
    parts = [red]
    for label, part, is_own in (("Green", green, is_green), ("Blue", blue, is_blue)):
        parts.append(sheet.math(f"{label} - Spill", 'SUBTRACT', part, sheet.math("", 'MULTIPLY', spill, is_own)))
    return [sheet.math(f"{label} + Grey", 'ADD', part, grey) for label, part in zip(("Red", "Green", "Blue"), parts)]


def _light_wrap(sheet, foreground, matte, width):
    """Add the nodes that let the background shine on the edge of the foreground; returns the foreground's socket."""
    sheet.frame("Light Wrap")
    size = min(100, max(1, round(_WRAP * width)))
    light = sheet.blur("Background's Light", sheet.input("Background"), size)
    around = sheet.blur("Around", sheet.math("1 - Matte", 'SUBTRACT', 1.0, matte), size)
    edge = sheet.math("Edge", 'MULTIPLY', around, matte)
    return sheet.mix("+ Light", 'ADD', sheet.math("Amount", 'MULTIPLY', edge, sheet.input(settings.WRAP)), foreground, light)


def _views(sheet, foreground, matte):
    """Add the nodes whose first outputs are the views, and connect the outputs of the group."""
    sheet.frame("Views")
    over = sheet.node("CompositorNodeAlphaOver", "Over")
    background, above = _layers(over)
    node_groups.link(sheet.group, sheet.input("Background"), background)
    node_groups.link(sheet.group, foreground, above)
    for name, label, source in (
        (COMPOSITE, "Composite", over.outputs[0]),
        (MATTE, "Matte", matte),
        (STATUS, "Status", _status(sheet, matte)),
        (SOURCE, "Source", sheet.input("Image")),
    ):
        node_groups.link(sheet.group, source, sheet.node("NodeReroute", label, name).inputs[0])
    node_groups.link(sheet.group, matte, sheet.output().inputs["Matte"])


def _status(sheet, matte):
    """Add the nodes of the status view: black for transparent, white for opaque, grey between. Returns the output socket."""
    is_not_clear = sheet.math("Not Clear", 'GREATER_THAN', matte, _CLEAR)
    is_opaque = sheet.math("Opaque", 'GREATER_THAN', matte, _OPAQUE)
    return sheet.math("Half", 'MULTIPLY', sheet.math("Sum", 'ADD', is_not_clear, is_opaque), 0.5)


def _layers(over):
    """Return the input sockets (background, foreground) of an Alpha Over node, whose names differ between Blender versions."""
    if "Background" in over.inputs:
        return over.inputs["Background"], over.inputs["Foreground"]
    return over.inputs[1], over.inputs[2]
