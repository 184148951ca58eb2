"""The node group that keys: source and background in, the view that is chosen and the matte out.

With g the screen's channel, S the screen's colour and m(C) = C_g - mix(larger, smaller of the others), the key is
alpha = clamp(1 - gain m(C) / m(S)), and the foreground C - (1 - alpha) S, premultiplied: what native.screen_matte computes, in nodes.
"""

import bpy

from ..core.blender import capabilities, node_groups
from . import settings
from .sheet import Sheet

KEY = "motus_chroma"
"""Custom property of the group, of the nodes around it, and of images that were loaded for it."""
COMPOSITE, MATTE, STATUS, SOURCE = VIEWS = 'COMPOSITE', 'MATTE', 'STATUS', 'SOURCE'
"""Names of the nodes whose first output is a view."""
_CLEAR, _OPAQUE = 0.002, 0.998
"""Mattes beyond which a pixel counts as clear or opaque in the status."""
_CORE, _WRAP = 0.01, 0.05
"""Shares of the picture's width: how far inside the edge the core lies, and how far light wraps around it."""
_GREEN, _BLUE = 0.7152, 0.0722
"""Luminance of green and of blue (Rec. 709)."""
_LEAST = 1e-6
"""Least distance of two levels."""


def build(width):
    """A new group for pictures of so many pixels across."""
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
    """Whether a node tree is such a group."""
    return tree is not None and KEY in tree


def is_of_older_version(tree):
    """Whether it keys by Blender's node Keying, as groups did before they had a formula of their own."""
    return any(node.bl_idname == "CompositorNodeKeying" for node in tree.nodes)


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
    """The order stays: keys of inputs name them by their places."""
    has_whole = capabilities.has_compositor_sockets()
    shown = [one for one in settings.OF_KEYING if has_whole or one.keyword != "grow"]
    node_groups.add_sockets(group, (
        ("Image", 'INPUT', "NodeSocketColor"), ("Background", 'INPUT', "NodeSocketColor"),
        (settings.COLOR, 'INPUT', "NodeSocketColor"), (settings.MASK, 'INPUT', "NodeSocketFloat"),
        (settings.WRAP, 'INPUT', "NodeSocketFloat"),
        *((one.label, 'INPUT', "NodeSocketInt" if one.is_whole and has_whole else "NodeSocketFloat") for one in shown),
        (settings.CORE_MASK, 'INPUT', "NodeSocketFloat"),
        ("Image", 'OUTPUT', "NodeSocketColor"), ("Matte", 'OUTPUT', "NodeSocketFloat")))
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
    """(straight colours, these smoothed for the key, alpha that the picture has already)."""
    sheet.frame("Picture, Straight")
    image = sheet.kept(sheet.input("Image"))
    covered = sheet.separate("Own Alpha", image)[3]
    straight = sheet.mix("Color / Alpha", 'DIVIDE', 1.0, image, covered)
    return straight, sheet.blur("Smooth Color", straight, sheet.input("Smooth Color")), covered


def _differences(sheet, picture):
    """(1 for a green screen, 1 for a blue one, m of the picture, m of the screen)."""
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
    """(the screen's channel, the mixture of the two others) of a colour."""
    red, green, blue, _ = parts
    own = _either(sheet, "Own Channel", green, is_green, blue, is_blue)
    other = _either(sheet, "Other Channel", blue, is_green, green, is_blue)
    larger, smaller = (sheet.math(label, operation, red, other) for label, operation in (("Larger", 'MAXIMUM'), ("Smaller", 'MINIMUM')))
    between = sheet.math("Smaller - Larger", 'SUBTRACT', smaller, larger)
    return own, sheet.math("Others Mixed", 'MULTIPLY_ADD', balance, between, larger)


def _either(sheet, label, first, is_first, second, is_second):
    """The first value or the second."""
    return sheet.math(label, 'MULTIPLY_ADD', second, is_second, sheet.math("", 'MULTIPLY', first, is_first))


def _key(sheet, difference, screen_difference):
    """Alpha by the colour difference; 1 everywhere, if the colour is neither green nor blue."""
    sheet.frame("Key: 1 - Gain m(Picture) / m(Screen)")
    share = sheet.math("m / m(Screen)", 'DIVIDE', difference, screen_difference)
    is_keyable = sheet.math("Is Green or Blue", 'GREATER_THAN', screen_difference, 0.0)
    gain = sheet.math("Gain", 'MULTIPLY', sheet.input("Screen Gain"), is_keyable)
    return sheet.kept(sheet.math("Alpha", 'SUBTRACT', 1.0, sheet.math("Gained", 'MULTIPLY', share, gain), clamp=True))


def _levels(sheet, alpha):
    sheet.frame("Levels")
    return _between(sheet, alpha, sheet.input("Clip Black"), sheet.input("Clip White"))


def _between(sheet, matte, black, white):
    """A matte that is 0 up to one level, and 1 from another one on."""
    width = sheet.math("Width", 'MAXIMUM', sheet.math("White - Black", 'SUBTRACT', white, black), _LEAST)
    return sheet.math("Leveled", 'DIVIDE', sheet.math("- Black", 'SUBTRACT', matte, black), width, clamp=True)


def _edge(sheet, matte):
    sheet.frame("Edge: Grow and Feather")
    # Before 4.5 the node has no socket for it.
    pixels = sheet.input("Grow Matte") if capabilities.has_compositor_sockets() else 0
    grown = sheet.dilate("Grow Matte", matte, pixels, settings.GROW)
    return sheet.blur("Feather", grown, sheet.input("Feather"))


def _core(sheet, alpha, width):
    """A matte of what lies inside, where holes are filled up to a level; 0 everywhere, if none are."""
    sheet.frame("Core: Holes Inside Are Filled")
    fill, black = sheet.input("Core Fill"), sheet.input("Clip Black")
    filled = _between(sheet, alpha, black, sheet.math("1 - Fill", 'SUBTRACT', 1.0, fill))
    inset = max(1, round(_CORE * width))
    soft = sheet.blur("Soften", sheet.dilate("Inset", filled, -2 * inset), inset)
    return sheet.math("If Filled", 'MULTIPLY', soft, sheet.math("Is Filled", 'GREATER_THAN', fill, 0.0))


def _masks(sheet, edge, core):
    """The edge's matte and the core's, with what masks keep and take."""
    sheet.frame("Masks")
    kept = sheet.math("Edge or Core", 'MAXIMUM', edge, core)
    kept = sheet.math("Or Core Mask", 'MAXIMUM', kept, sheet.input(settings.CORE_MASK))
    return sheet.math("Inside", 'MULTIPLY', kept, sheet.math("1 - Garbage", 'SUBTRACT', 1.0, sheet.input(settings.MASK), clamp=True))


def _foreground(sheet, straight, alpha, inside):
    """(picture without the screen's share, factor of it).

    Where the matte is above alpha more of the picture stays, and where it is below, what stays is scaled with it.
    """
    sheet.frame("Foreground: Picture - (1 - Alpha) Screen")
    greater = sheet.math("Alpha or Matte", 'MAXIMUM', alpha, inside)
    rest = sheet.math("1 - Alpha", 'SUBTRACT', 1.0, greater)
    taken = sheet.mix("- Screen", 'SUBTRACT', rest, straight, sheet.input(settings.COLOR))
    least = sheet.mix("Not below 0", 'DARKEN', 1.0, straight, (0.0, 0.0, 0.0, 1.0))
    return sheet.kept(sheet.mix("At Least", 'LIGHTEN', 1.0, taken, least)), sheet.math("Matte / Alpha", 'DIVIDE', inside, greater)


def _despill(sheet, picture, is_green, is_blue):
    """Red, green and blue, of which the screen's is limited by the others; what is taken goes back as grey of the same luminance."""
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
    """The foreground with the light of the background around its edge."""
    sheet.frame("Light Wrap")
    size = min(100, max(1, round(_WRAP * width)))
    light = sheet.blur("Background's Light", sheet.input("Background"), size)
    around = sheet.blur("Around", sheet.math("1 - Matte", 'SUBTRACT', 1.0, matte), size)
    edge = sheet.math("Edge", 'MULTIPLY', around, matte)
    return sheet.mix("+ Light", 'ADD', sheet.math("Amount", 'MULTIPLY', edge, sheet.input(settings.WRAP)), foreground, light)


def _views(sheet, foreground, matte):
    """The nodes whose first output is a view, and the group's outputs."""
    sheet.frame("Views")
    over = sheet.node("CompositorNodeAlphaOver", "Over")
    background, above = _layers(over)
    node_groups.link(sheet.group, sheet.input("Background"), background)
    node_groups.link(sheet.group, foreground, above)
    for name, label, source in ((COMPOSITE, "Composite", over.outputs[0]), (MATTE, "Matte", matte),
                                (STATUS, "Status", _status(sheet, matte)), (SOURCE, "Source", sheet.input("Image"))):
        node_groups.link(sheet.group, source, sheet.node("NodeReroute", label, name).inputs[0])
    node_groups.link(sheet.group, matte, sheet.output().inputs["Matte"])


def _status(sheet, matte):
    """Black where the picture is clear, white where it is opaque, grey between."""
    is_not_clear = sheet.math("Not Clear", 'GREATER_THAN', matte, _CLEAR)
    is_opaque = sheet.math("Opaque", 'GREATER_THAN', matte, _OPAQUE)
    return sheet.math("Half", 'MULTIPLY', sheet.math("Sum", 'ADD', is_not_clear, is_opaque), 0.5)


def _layers(over):
    """Sockets of the background and of the foreground of a node Alpha Over."""
    if "Background" in over.inputs:
        return over.inputs["Background"], over.inputs["Foreground"]
    return over.inputs[1], over.inputs[2]
