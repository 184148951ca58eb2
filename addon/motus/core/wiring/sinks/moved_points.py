"""How the points of the owner's mesh are moved: each by a vector that the hub holds for the point of the same index."""

from ...blender import node_groups
from ...declare import Vertices
from ...evaluated.per_thread import scratch
from ...lazy import numpy as np
from ...measures import finite
from . import attributes

ATTRIBUTE = "motus_offset"
IS_FIRST = True
"""The modifier is the first of the stack: the vectors are those of the mesh's own points."""
FORMS = {"": ()}
"""One, which has no inputs of its own."""


class Room:
    """What the solver fills: a vector for each point of the evaluated mesh that the system moves, zero to begin with."""

    is_full = False

    def __init__(self, system, carrier, inputs, context):
        mesh = next((inputs[declared.name] for declared in system.inputs if isinstance(declared, Vertices)), None)
        count = len(mesh.vertices) if mesh else 0
        self._carrier, self._offsets = carrier, _zeros(carrier, count)
        context.offsets = self._offsets[:count]

    def is_finite(self):
        """Whether the vectors may reach the owner's points; else these stay where they are."""
        if finite.is_finite(self._offsets):
            return True
        self._offsets.fill(0.0)
        return False

    def write(self, weight):
        """Let the evaluated hub hold the vectors, times the weight."""
        if weight != 1.0:
            self._offsets *= np.float32(weight)
        _write(self._carrier, self._offsets)


def prepare(_system, mesh, _settings):
    """Give a hub's mesh the attribute that the solver fills."""
    mesh.attributes.new(ATTRIBUTE, 'FLOAT_VECTOR', 'POINT')


def write_nothing(_system, carrier):
    """Let the owner's points be where they are by themselves."""
    _write(carrier, _zeros(carrier, 0))


def add_nodes(_system, group, start, _form):
    """The nodes of the modifier; returns the socket of the owner's geometry, moved."""
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
    # Points can be added to an evaluated mesh, but not taken away one by one.
    offsets = scratch("offsets", (max(count, len(carrier.vertices)), 3), np.float32)
    offsets.fill(0.0)
    return offsets


def _write(carrier, offsets):
    missing = len(offsets) - len(carrier.vertices)
    if missing > 0:
        carrier.vertices.add(missing)
    attributes.write(carrier, ATTRIBUTE, 'FLOAT_VECTOR', offsets)
