"""Points for exporters: none of Blender's writes the points and instances that nodes make as they move.

Point clouds stand in for them where a format has points, and meshes of all instances where it has but meshes.
"""

from typing import Any, NamedTuple

import bpy

from ..core.blender import node_groups
from ..core.declare import of_owner
from . import found

NOTHING, CLOUDS, MESHES = 'NOTHING', 'CLOUDS', 'MESHES'
"""What a format gets of points: nothing, point clouds with radius and velocity, or the mesh of what stands on each point."""


class Handed(NamedTuple):
    """Points that were handed over. owner: object whose modifier, by this name, shows them. points: object that has them as its vertices."""

    owner: Any
    modifier: str
    points: Any


def want_velocities():
    """Let all owners make the velocities of their points too, which Blender itself needs for motion blur of bare points alone."""
    for system, owner in found.owners():
        settings = of_owner(system, owner)
        if hasattr(settings, "all_attributes"):
            settings.all_attributes = True


class Shown:
    """Shows points as a format wants them. scene: that is exported. handed: list of Handed."""

    def __init__(self, scene, handed):
        self._scene, self._handed = scene, handed
        self._added = []

    def show(self, way):
        """Show the points by NOTHING, CLOUDS or MESHES, and in no other way."""
        for obj, modifier in self._added:
            obj.modifiers.remove(modifier)
            if obj.type == 'POINTCLOUD':
                bpy.data.objects.remove(obj)
        self._added = []
        for one in self._handed:
            modifier = one.owner.modifiers[one.modifier]
            modifier.show_viewport = modifier.show_render = way == MESHES
            if way == MESHES:
                self._added += [_only_living(one.points), _realized(one.owner)]
            elif way == CLOUDS:
                self._added.append(self._cloud(one))

    def _cloud(self, one):
        name = f"{one.owner.name} Cloud"
        cloud = bpy.data.objects.new(name, bpy.data.pointclouds.new(name))
        self._scene.collection.objects.link(cloud)
        added, group, _, end = _new_group(cloud)
        info, made = (node_groups.add_node(group, f"GeometryNode{kind}") for kind in ("ObjectInfo", "MeshToPoints"))
        info.inputs["Object"].default_value = one.points
        # The first point stays even if it is not there: USD's importer in Blender 4.5 crashes at a frame without points.
        least = node_groups.add_node(group, "ShaderNodeMath", operation='MULTIPLY')
        index = node_groups.add_node(group, "GeometryNodeInputIndex")
        group.links.new(_is_missing(group), least.inputs[0])
        group.links.new(index.outputs[0], least.inputs[1])
        stays = node_groups.add_node(group, "ShaderNodeMath", operation='LESS_THAN')
        stays.inputs[1].default_value = 0.5
        group.links.new(least.outputs[0], stays.inputs[0])
        group.links.new(stays.outputs[0], made.inputs["Selection"])
        group.links.new(node_groups.named_attribute(group, "radius", 'FLOAT'), made.inputs["Radius"])
        group.links.new(info.outputs["Geometry"], made.inputs["Mesh"])
        group.links.new(made.outputs[0], end.inputs[0])
        return added


def _only_living(points):
    """Remove the points that are not there. Returns (object, modifier that was added)."""
    added, group, start, end = _new_group(points)
    delete = node_groups.add_node(group, "GeometryNodeDeleteGeometry")
    group.links.new(start.outputs[0], delete.inputs["Geometry"])
    group.links.new(_is_missing(group), delete.inputs["Selection"])
    group.links.new(delete.outputs[0], end.inputs[0])
    return added


def _is_missing(group):
    """Add the nodes that say whether a point is not there: it has no size. Returns the socket, 1 or 0."""
    compare = node_groups.add_node(group, "ShaderNodeMath", operation='LESS_THAN')
    compare.inputs[1].default_value = 1e-12
    group.links.new(node_groups.named_attribute(group, "radius", 'FLOAT'), compare.inputs[0])
    return compare.outputs[0]


def _realized(owner):
    """Make one mesh of what an owner shows, instances included. Returns (object, modifier that was added)."""
    added, group, start, end = _new_group(owner)
    node = node_groups.add_node(group, "GeometryNodeRealizeInstances")
    group.links.new(start.outputs[0], node.inputs[0])
    group.links.new(node.outputs[0], end.inputs[0])
    return added


def _new_group(obj):
    """Give an object a modifier of nodes. Returns ((object, modifier), node group, its input node, its output node)."""
    group = bpy.data.node_groups.new("Exchange", 'GeometryNodeTree')
    node_groups.add_sockets(group, (("Geometry", 'INPUT', "NodeSocketGeometry"), ("Geometry", 'OUTPUT', "NodeSocketGeometry")))
    start, end = (node_groups.add_node(group, kind) for kind in ("NodeGroupInput", "NodeGroupOutput"))
    modifier = obj.modifiers.new("Exchange", 'NODES')
    modifier.node_group = group
    return (obj, modifier), group, start, end
