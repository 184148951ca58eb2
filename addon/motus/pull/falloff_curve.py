"""The brush's falloff curve, as the user has drawn it.

The curve is stored in a Float Curve node of a hidden node group, since no property type of Blender holds a curve.
"""

import bpy

from ..core.file.pointers import pointed
from ..core.lazy import numpy as np

CURVE_SAMPLES = 32
"""Number of forces that are sampled from the falloff curve, at equal steps from the radius to the pulled vertex."""

GROUP_NAME = ".Motus Falloff"
NODE_TYPE = 'ShaderNodeFloatCurve'


def ensure(brush):
    """Return the brush's Float Curve node; create it with the falloff Smooth if there is none. Must not be called from draw()."""
    found = node(brush)
    if found is not None:
        return found
    if pointed(brush, "curve_nodes") is None:
        brush.curve_nodes = bpy.data.node_groups.new(GROUP_NAME, 'ShaderNodeTree')
    made = pointed(brush, "curve_nodes").nodes.new(NODE_TYPE)
    points = made.mapping.curves[0].points
    for t in (0.25, 0.5, 0.75):
        points.new(t, _smooth(t))
    made.mapping.update()
    return made


def node(brush):
    """Float Curve node of the brush, for template_curve_mapping(node, "mapping"); None if no curve was created yet."""
    nodes = pointed(brush, "curve_nodes")
    if nodes is None:
        return None
    return next((found for found in nodes.nodes if found.bl_idname == NODE_TYPE), None)


def samples(brush, count=CURVE_SAMPLES):
    """Forces of the falloff curve at equal steps from the radius to the pulled vertex, float32 (count,).

    If no curve was created yet, the forces are those of the falloff Smooth, with which ensure() begins.
    """
    steps = np.linspace(0.0, 1.0, count)
    found = node(brush)
    if found is None:
        return _smooth(steps).astype(np.float32)
    mapping = found.mapping
    mapping.initialize()
    curve = mapping.curves[0]
    return np.array([mapping.evaluate(curve, step) for step in steps], np.float32)


def _smooth(t):
    return t * t * (3.0 - 2.0 * t)
