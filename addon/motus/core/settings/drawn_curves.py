"""Curves that the user draws, as settings.

No property of Blender's holds a curve that its curve widget shows. That widget shows the mapping of a Float Curve node, which stands in a hidden
node group of the settings' own. `curve_nodes` of the settings points to the group; node(), make() and samples() need nothing else.

Settings with the properties of DrawnCurve keep the curve's points as a text as well, which is copied, overridden and stored in presets like any
other setting, and from which the group is made anew if a file lacks it, and the curve's values, which solvers read. show() brings a changed text
to the widget, take_over() brings what was drawn there back: no property tells that a point was moved, so that is looked for after an evaluation
in which node groups were updated (System.take_over).
"""

import re

import bpy

from ..file.pointers import pointed, to_node_tree
from ..lazy import numpy as np
from ..refusals import Refused
from ..translations import tr
from .declared import switch
from .system_settings import OVERRIDABLE, touch

NODE_TYPE = 'ShaderNodeFloatCurve'
HANDLES = "AUTO", "AUTO_CLAMPED", "VECTOR"
VALUES = 32
"""Number of values that are kept of a curve, at equal steps: as many as an array of Blender 3.4 has at most."""
STRAIGHT = (0.0, 0.0, "AUTO"), (1.0, 1.0, "AUTO")
"""Points of the curve whose values are its places."""
_POINT = re.compile(r"\s*(\S+)\s+(\S+)(?:\s+(\w+))?\s*")


def pointer(**options):
    """Declare the property `curve_nodes`. options: further keywords of a PointerProperty."""
    return to_node_tree(name="Curve Nodes", description="Hidden node group that holds the drawn curve", options={'HIDDEN'}, **options)


class DrawnCurve:
    """Mixin of settings that have a curve, beside the two properties `use_curve` and `curve`, which keywords() declares."""

    curve_values: bpy.props.FloatVectorProperty(
        name="Curve Values",
        description="Values of the drawn curve at equal steps",
        size=VALUES,
        options={'HIDDEN'},
        override=OVERRIDABLE,
        update=touch,
    )
    curve_nodes: pointer(override=OVERRIDABLE)


def keywords(name, description, show):
    """Declare two properties of a curve, which settings share with operators: (`use_curve`, whether there is one; `curve`, its points as a text).

    name, description: of the first one. show: function of the settings that calls show(); it is called when one of both was changed.
    """

    def update(item, context):
        if isinstance(item, bpy.types.PropertyGroup):  # an operator shows no curve
            show(item)
        touch(item, context)

    text = bpy.props.StringProperty(
        name="Curve",
        description="Points of the drawn curve, from left to right, with commas between: two numbers from 0 to 1 each, and AUTO, AUTO_CLAMPED or "
        "VECTOR for a handle",
        options={'HIDDEN'},
        override=OVERRIDABLE,
        update=update,
    )
    return switch(name, description, tells_no_keys=True, update=update), text


def node(settings):
    """Return the Float Curve node of settings, for template_curve_mapping(node, "mapping"); None if there is none."""
    tree = pointed(settings, "curve_nodes")
    return next((found for found in tree.nodes if found.bl_idname == NODE_TYPE), None) if tree else None


def make(settings, name, points):
    """Give settings a Float Curve node in a node group of this name; return the node. points: (x, y, handle) of each. Not for draw()."""
    tree = settings.curve_nodes = bpy.data.node_groups.new(name, 'ShaderNodeTree')
    made = tree.nodes.new(NODE_TYPE)
    _give(made, points)
    return made


def samples(found, places):
    """Return the values (n,) float32 of a Float Curve node at places (n,), from 0 to 1."""
    mapping = found.mapping
    mapping.initialize()
    return np.array([mapping.evaluate(mapping.curves[0], place) for place in places], np.float32)


def show(settings, name, beginning):
    """Bring the curve that the text of settings names to their widget, and keep its values; without a text the curve has the points `beginning`."""
    if not settings.use_curve:
        return
    found, points = _own(settings), points_in(settings.curve) or beginning
    if found is None:
        found = make(settings, name, points)
    elif text_of(found) != settings.curve:
        _give(found, points)
    _keep(settings, found)


def take_over(settings, name, beginning):
    """Keep the curve that the user has drawn in the widget of settings. Settings without a widget of their own are given one, as by show()."""
    found = _own(settings) if settings.use_curve else None
    if found is None:
        show(settings, name, beginning)
    else:
        _keep(settings, found)


def trees(settings):
    """List the node group of each of several settings that has one."""
    return list(dict.fromkeys(tree for one in settings for tree in [pointed(one, "curve_nodes")] if tree))


def remove_unused(found):
    """Remove those of node groups that nothing points to any more."""
    for tree in found:
        if not tree.users and not tree.library:
            bpy.data.node_groups.remove(tree)


def check(text):
    """Raise Refused if a text that an operator was given names no curve."""
    if text and points_in(text) is None:
        raise Refused(tr('{text} is no curve: name two points or more, such as "0 0, 0.5 0.2, 1 1"').format(text=text))


def points_in(text):
    """List the points (x, y, handle) that a text names; None if it names no curve."""
    named = text.split(",")
    found = [one for one in map(_POINT.fullmatch, named) if one]
    if not 2 <= len(found) == len(named):
        return None
    try:
        points = [(float(one[1]), float(one[2]), one[3] or "AUTO") for one in found]
    except ValueError:
        return None
    return points if all(0.0 <= x <= 1.0 and 0.0 <= y <= 1.0 and handle in HANDLES for x, y, handle in points) else None


def text_of(found):
    """Return the text that names the points of a Float Curve node."""
    points = [(*point.location, point.handle_type) for point in found.mapping.curves[0].points]
    return ", ".join(f"{x:.9g} {y:.9g}" + ("" if handle == "AUTO" else f" {handle}") for x, y, handle in points)


def _own(settings):
    """Return the node of settings, if no other settings, such as those of a copied object, have it too, and no library has it."""
    tree = pointed(settings, "curve_nodes")
    return node(settings) if tree and tree.users < 2 and not tree.library else None


def _give(found, points):
    curve = found.mapping.curves[0].points
    while len(curve) > max(len(points), 2):
        curve.remove(curve[-1])
    while len(curve) < len(points):
        curve.new(1.0, 1.0)
    for one, (x, y, handle) in zip(curve, points):
        one.location, one.handle_type = (x, y), handle
    found.mapping.update()


def _keep(settings, found):
    text = text_of(found)
    if settings.curve != text:
        settings.curve = text
    values = samples(found, np.linspace(0.0, 1.0, VALUES)).tolist()
    if list(settings.curve_values) != values:
        settings.curve_values = values
