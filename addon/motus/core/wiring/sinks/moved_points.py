"""Move the points of the owner's mesh: each by the vector that the hub, a hidden mesh object, holds for the point of equal index.

The hub's mesh, also called carrier, has the results of a solver. The weight is the influence of the results.
"""

from ...blender import node_groups
from ...declare import Vertices
from ...evaluated.per_thread import scratch
from ...lazy import numpy as np
from ...measures import finite
from . import attributes

ATTRIBUTE = "motus_offset"
IS_FIRST = True
"""Whether the modifier is put before the owner's modifiers: yes, so that its points are those of the mesh, in the same order."""
FORMS = {"": ()}
"""Variants of the node group -> additional input sockets. There is one variant, without additional inputs."""


class Room:
    """Memory that the solver fills in one call: a vector for each point of the mesh whose points the system moves, initially 0."""

    is_full = False

    def __init__(self, system, carrier, inputs, context):
        mesh = next((inputs[declared.name] for declared in system.inputs if isinstance(declared, Vertices)), None)
        count = len(mesh.vertices) if mesh else 0
        self._carrier, self._offsets = carrier, _zeros(carrier, count)
        context.offsets = self._offsets[:count]

    def is_finite(self):
        """Whether all vectors are finite. If not, all vectors are set to 0, so that the owner's points are not moved."""
        if finite.is_finite(self._offsets):
            return True
        self._offsets.fill(0.0)
        return False

    def write(self, weight):
        """Store the vectors by which the solver moves the points in the attribute of the evaluated hub's mesh.

        weight: influence of the results, 0 to 1, by which the vectors are multiplied.
        """
        if weight != 1.0:
            self._offsets *= np.float32(weight)
        _write(self._carrier, self._offsets)


def prepare(_system, mesh, _settings):
    """Add to a hub's mesh the attribute that holds a vector for each point."""
    mesh.attributes.new(ATTRIBUTE, 'FLOAT_VECTOR', 'POINT')


def write_nothing(_system, carrier):
    """Store zero vectors in the evaluated hub's mesh (carrier), so that the owner's points are not moved."""
    _write(carrier, _zeros(carrier, 0))


def add_nodes(_system, group, start, _form):
    """Add to a node group of the modifier the nodes that move the points; start: its Group Input node.

    Returns the output socket with the owner's moved geometry.
    """
    hub = node_groups.add_node(group, "GeometryNodeObjectInfo")
    index = node_groups.add_node(group, "GeometryNodeInputIndex")
    sample = node_groups.add_node(group, "GeometryNodeSampleIndex", data_type='FLOAT_VECTOR', domain='POINT')
    move = node_groups.add_node(group, "GeometryNodeSetPosition")
    offset = node_groups.named_attribute(group, ATTRIBUTE, 'FLOAT_VECTOR')
    for source, target in (
        (start.outputs["Geometry"], move.inputs["Geometry"]),
        (start.outputs["Hub"], hub.inputs["Object"]),
        (hub.outputs["Geometry"], sample.inputs["Geometry"]),
        (offset, node_groups.enabled(sample.inputs, "Value")),
        (index.outputs["Index"], sample.inputs["Index"]),
        (node_groups.enabled(sample.outputs), move.inputs["Offset"]),
    ):
        group.links.new(source, target)
    return move.outputs["Geometry"]


def _zeros(carrier, count):
    # At least as many vectors as the mesh has points: points of an evaluated mesh can be added, but not removed one by one.
    offsets = scratch("offsets", (max(count, len(carrier.vertices)), 3), np.float32)
    offsets.fill(0.0)
    return offsets


def _write(carrier, offsets):
    missing = len(offsets) - len(carrier.vertices)
    if missing > 0:
        carrier.vertices.add(missing)
    attributes.write(carrier, ATTRIBUTE, 'FLOAT_VECTOR', offsets)
