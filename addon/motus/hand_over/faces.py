"""What is recorded of surfaces that systems make, with other vertices and faces on each frame, and how it becomes plain meshes.

The file gets a mesh for each sample, in a collection of its own, of which nodes show the one whose time is nearest.
"""

import bpy

from ..core.blender import node_groups
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import points

LARGE, LARGEST = 400_000_000, 2_000_000_000
"""Bytes of the meshes of one owner, in the file and in memory: up to the first, parts of frames have meshes too; more than the second is
refused.
"""


class Faces(points.Points):
    """Samples of the surface of one owner."""

    def record(self, depsgraph, _frame):
        """Append the surface to the samples, with the attributes of its points; frames have to come in their order."""
        super().record(depsgraph, _frame)
        mesh = self._hub.evaluated_get(depsgraph).data
        corners = np.empty(len(mesh.loops), np.int32)
        mesh.loops.foreach_get("vertex_index", corners)
        self._samples[-1]["corners"] = corners

    def plain(self, _folder, times, per_frame):
        """Make the object that takes the hub's place. times: of the samples, in the keys' time. per_frame: number of samples in a frame."""
        stride = self._stride(per_frame)
        samples, times = self._samples[::stride], times[::stride]
        name = f"{self.owner.name} Shapes"
        shapes = bpy.data.collections.new(name)
        last, mesh = None, None
        for index, sample in enumerate(samples):
            if last is None or any(not np.array_equal(sample[key], last[key]) for key in sample):
                mesh = self._mesh(name, sample)
            # A collection's objects are numbered in the order of their names.
            shapes.objects.link(bpy.data.objects.new(f"{name} {index:05}", mesh))
            last = sample
        obj = bpy.data.objects.new(name, bpy.data.meshes.new(name))
        obj.modifiers.new("Shapes", 'NODES').node_group = _picking(name, shapes, times)
        return obj

    def _stride(self, per_frame):
        size = sum(value.nbytes for sample in self._samples for value in sample.values()) * 3  # edges and corners besides
        for stride in (one for one in range(1, per_frame + 1) if per_frame % one == 0):
            if size / stride < (LARGEST if stride == per_frame else LARGE):
                return stride
        raise Refused(tr("The snow of {object} would be too large a file: make its resolution coarser").format(object=self.owner.name))

    def _mesh(self, name, sample):
        mesh = bpy.data.meshes.new(name)
        corners = sample["corners"]
        mesh.vertices.add(len(sample["position"]))
        mesh.vertices.foreach_set("co", sample["position"].ravel())
        mesh.loops.add(len(corners))
        mesh.loops.foreach_set("vertex_index", corners)
        mesh.polygons.add(len(corners) // 3)
        mesh.polygons.foreach_set("loop_start", np.arange(0, len(corners), 3, dtype=np.int32))
        mesh.polygons.foreach_set("loop_total", np.full(len(corners) // 3, 3, np.int32))
        mesh.update(calc_edges=True)
        for one in points.own_attributes(self._hub.data):
            points.store(mesh, one.name, one.data_type, sample[one.name])
        return mesh


def _picking(name, shapes, times):
    """The node group that gives the shape whose time is nearest. shapes: collection with one for each time."""
    group = bpy.data.node_groups.new(name, 'GeometryNodeTree')
    node_groups.add_sockets(group, (("Geometry", 'INPUT', "NodeSocketGeometry"), ("Geometry", 'OUTPUT', "NodeSocketGeometry")))
    _, end = (node_groups.add_node(group, kind) for kind in ("NodeGroupInput", "NodeGroupOutput"))
    info = node_groups.add_node(group, "GeometryNodeCollectionInfo")
    info.inputs["Collection"].default_value = shapes
    info.inputs["Separate Children"].default_value = True
    frame = node_groups.add_node(group, "GeometryNodeInputSceneTime").outputs["Frame"]
    step = times[1] - times[0]
    place = _computed(group, 'MULTIPLY_ADD', frame, 1.0 / step, 0.5 - times[0] / step)
    place = _computed(group, 'MINIMUM', _computed(group, 'MAXIMUM', _computed(group, 'FLOOR', place), 0.0), len(times) - 1.0)
    one = node_groups.add_node(group, "GeometryNodeMeshLine")
    one.inputs["Count"].default_value = 1
    shown = node_groups.add_node(group, "GeometryNodeInstanceOnPoints")
    shown.inputs["Pick Instance"].default_value = True
    whole = node_groups.add_node(group, "GeometryNodeRealizeInstances")
    for source, target in (
        (one.outputs["Mesh"], shown.inputs["Points"]),
        (node_groups.enabled(info.outputs), shown.inputs["Instance"]),
        (place, shown.inputs["Instance Index"]),
        (shown.outputs["Instances"], whole.inputs["Geometry"]),
        (whole.outputs["Geometry"], end.inputs["Geometry"]),
    ):
        group.links.new(source, target)
    return group


def _computed(group, operation, *operands):
    node = node_groups.add_node(group, "ShaderNodeMath", operation=operation)
    for operand, socket in zip(operands, node.inputs):
        node_groups.link(group, operand, socket)
    return node.outputs[0]
