"""How points are made on the owner: the hub's evaluated mesh has them, and the modifier brings them in.

What the hub's mesh holds in the file is the form alone, attributes without points. At each solve the evaluated mesh is given
that form anew, and room for as many points as there are: fresh memory, which neither the original nor what Blender has
evaluated before shares, so that the solver can fill it where it lies.
"""

from typing import Any

import bmesh

from ... import keeping, native
from ...blender import capabilities, node_groups
from ...evaluated.per_thread import scratch
from ...file.stored import Damaged
from ...lazy import numpy as np
from ...measures import finite
from . import attributes

IS_FIRST = False
"""The modifier is added behind those that the owner has: these shape what the owner has by itself."""
MATERIAL, OBJECT, COLLECTION = "Material", "Object", "Collection"
FORMS = {name: ((name, 'INPUT', f"NodeSocket{name}"),) for name in (MATERIAL, OBJECT, COLLECTION)}
"""What is made of the points, by the input that says it: what the system's shape is, or instances of an object or collection.

Each has nodes of its own and no more inputs than it needs, for the file's sake.
"""
TUBE_SIDES = 8
RADIUS = "radius"

_forms = keeping.OfProcess(
    "empty BMeshes, of which meshes are made that have their attributes", "name of the system, (name, kind) of the attributes", most=64
)
_TYPES = {
    'FLOAT': 'FLOAT',
    'INT': 'INT',
    'VECTOR': 'FLOAT_VECTOR',
    'COLOR': 'FLOAT_COLOR',
    'QUATERNION': 'QUATERNION',
    'EULER': 'FLOAT_VECTOR',
}
"""Kind of an attribute -> its type. EULER: what quaternions are to Blenders without attributes of these."""


class Room:
    """What the solver asks for points. is_full: for more than there may be."""

    def __init__(self, system, carrier, _inputs, context):
        self._system, self._made, self._carrier, self._settings = system, system.makes_points, carrier, context.settings
        self._found: dict[str, Any] | None = None
        self._staged: list[Any] = []
        self.is_full = False
        context.points = self._points

    def _points(self, count, edges=0, triangles=0):
        self.is_full = count > self._made.capacity
        if self.is_full and self._made.shape == 'FACES':
            count = edges = triangles = 0  # a part of a surface is another surface
        count = min(count, self._made.capacity)
        present = _resize(self._system, self._carrier, int(count), self._settings)
        self._staged = []
        self._found = {"position": self._positions(count)}
        if self._made.shape == 'FACES':
            self._found |= _faces(self._carrier, int(edges), int(triangles))
        for name, kind in present:
            self._found[name] = self._rotations(name, count) if kind == 'EULER' else attributes.memory(self._carrier, name, _TYPES[kind])
        return self._found

    def _positions(self, count):
        if "position" in self._carrier.attributes:
            return attributes.memory(self._carrier, "position", 'FLOAT_VECTOR')
        # Before Blender 3.5 a vertex is a record that begins with its position.
        places = attributes.items(self._carrier.vertices, "<f4", (3,))
        positions = scratch("positions", (count, 3), np.float32)
        self._staged.append(lambda: np.copyto(places, positions))
        return positions

    def _rotations(self, name, count):
        angles = attributes.memory(self._carrier, name, 'FLOAT_VECTOR')
        rotations = scratch(f"rotations {name}", (count, 4), np.float32)
        self._staged.append(lambda: np.copyto(angles, native.module.euler_xyz(rotations.astype(float))))
        return rotations

    def is_finite(self):
        """Whether where the points are, how large, and how they are turned may reach Blender."""
        placing = (
            name
            for name, kind in (("position", 'VECTOR'), *self._made.attributes)
            if name == "position" or name == RADIUS or kind == 'QUATERNION'
        )
        return self._found is None or all(finite.is_finite(self._found[name]) for name in placing if name in self._found)

    def write(self, weight):
        """Let the evaluated hub have the points, or none where the weight is 0 or the solver has asked for none."""
        if weight == 0.0 or self._found is None:
            _clear(self._carrier)
            return
        for write in self._staged:
            write()
        if self._made.shape in {'CURVES', 'TUBES'}:
            _join(self._carrier, self._found["curve"])


def prepare(system, mesh, settings):
    """Give a hub's mesh the attributes of the points."""
    unneeded = system.makes_points.unneeded(settings)
    for name, kind in system.makes_points.attributes:
        if name not in unneeded:
            mesh.attributes.new(name, _TYPES[_made_as(kind)], 'POINT')


def write_nothing(_system, carrier):
    """Let there be no points."""
    _clear(carrier)


def add_nodes(system, group, start, form):
    """The nodes of the modifier; returns the socket of what it makes, with the owner's own geometry."""
    made = system.makes_points
    hub = node_groups.add_node(group, "GeometryNodeObjectInfo", transform_space='RELATIVE' if made.space == 'WORLD' else 'ORIGINAL')
    # As an instance it stands still in the world with all that its attributes say, whatever that is. A surface says nothing
    # but where it is, and modifiers behind, which do not look into instances, are to have it.
    hub.inputs["As Instance"].default_value = made.space == 'WORLD' and made.shape != 'FACES'
    group.links.new(start.outputs["Hub"], hub.inputs["Object"])
    mesh = hub.outputs["Geometry"]
    if form == MATERIAL:
        found = _with_material(group, start, _SHAPES[made.shape](made, group, mesh))
    else:
        found = _as_instances(made, group, start, mesh, form)
    join = node_groups.add_node(group, "GeometryNodeJoinGeometry")
    for source in (found, start.outputs["Geometry"]):
        group.links.new(source, join.inputs["Geometry"])
    return join.outputs["Geometry"]


def _with_material(group, start, geometry):
    node = node_groups.add_node(group, "GeometryNodeSetMaterial")
    group.links.new(geometry, node.inputs["Geometry"])
    group.links.new(start.outputs[MATERIAL], node.inputs["Material"])
    return node.outputs["Geometry"]


def _as_instances(made, group, start, mesh, form):
    info = node_groups.add_node(group, f"GeometryNode{form}Info", transform_space='ORIGINAL')
    group.links.new(start.outputs[form], info.inputs[form])
    node = node_groups.add_node(group, "GeometryNodeInstanceOnPoints")
    # Which of a collection's objects an instance is follows from the attribute "id", where nothing else is linked.
    switches = (info.inputs["Separate Children"], info.inputs["Reset Children"]) if form == COLLECTION else (info.inputs["As Instance"],)
    for switch in (*switches, node.inputs["Pick Instance"]):
        switch.default_value = True
    group.links.new(mesh, node.inputs["Points"])
    group.links.new(info.outputs[-1], node.inputs["Instance"])
    for name, kind in made.attributes:
        if kind == 'QUATERNION':
            group.links.new(node_groups.named_attribute(group, name, _TYPES[_made_as(kind)]), node.inputs["Rotation"])
    _link_radius(made, group, node, "Scale")
    return node.outputs["Instances"]


def _as_points(made, group, mesh):
    node = node_groups.add_node(group, "GeometryNodeMeshToPoints")
    group.links.new(mesh, node.inputs["Mesh"])
    _link_radius(made, group, node, "Radius")
    return node.outputs[0]


def _as_curves(_made, group, mesh):
    node = node_groups.add_node(group, "GeometryNodeMeshToCurve")
    group.links.new(mesh, node.inputs["Mesh"])
    return node.outputs["Curve"]


def _as_faces(_made, group, mesh):
    node = node_groups.add_node(group, "GeometryNodeSetShadeSmooth")
    group.links.new(mesh, node.inputs[0])
    return node.outputs[0]


def _as_tubes(made, group, mesh):
    curves = _as_curves(made, group, mesh)
    circle = node_groups.add_node(group, "GeometryNodeCurvePrimitiveCircle")
    circle.inputs["Resolution"].default_value = TUBE_SIDES
    circle.inputs["Radius"].default_value = 1.0
    node = node_groups.add_node(group, "GeometryNodeCurveToMesh")
    group.links.new(curves, node.inputs["Curve"])
    group.links.new(circle.outputs["Curve"], node.inputs["Profile Curve"])
    if "Scale" in node.inputs:
        # Where there is no such input Blender takes the radius by itself.
        _link_radius(made, group, node, "Scale")
    return node.outputs["Mesh"]


_SHAPES = {'POINTS': _as_points, 'CURVES': _as_curves, 'TUBES': _as_tubes, 'FACES': _as_faces}
"""Points.shape -> what adds the nodes that make it of the hub's mesh."""


def _link_radius(made, group, node, name):
    if (RADIUS, 'FLOAT') in made.attributes:
        group.links.new(node_groups.add_node(group, "GeometryNodeInputRadius").outputs[0], node.inputs[name])


def _made_as(kind):
    """The kind as which this Blender is given an attribute."""
    return 'EULER' if kind == 'QUATERNION' and not capabilities.has_quaternion_attributes() else kind


def _found_as(mesh, name, kind):
    """The kind as which the hub's mesh has an attribute: rotations are Euler angles still if an older Blender has saved the file."""
    return 'EULER' if kind == 'QUATERNION' and mesh.attributes[name].data_type == _TYPES['EULER'] else kind


def _resize(system, carrier, count, settings):
    """Give an evaluated mesh the attributes of the points, and so many of these, whose content is undefined.

    Returns which attributes these are: pairs of name and kind.
    """
    mesh, made = carrier.original, system.makes_points
    names = mesh.attributes.keys()
    present = tuple((name, _found_as(mesh, name, kind)) for name, kind in made.attributes if name in names)
    if len(present) < len(made.attributes):
        missing = {name for name, _ in made.attributes}.difference(names)
        if not missing.issubset(made.unneeded(settings)):
            raise Damaged("another form than that of the points")
    form = _forms.made((system.name, present), lambda: _form_of(mesh, present))
    # Of all that empties a mesh this alone leaves it the driver that is being evaluated.
    form.to_mesh(carrier)
    carrier.vertices.add(count)
    return present


def _form_of(mesh, present):
    declared = dict(present)
    own = {"position", *(one.name for one in mesh.attributes if one.name.startswith("."))}
    if len(mesh.vertices) or not own.union(declared).issuperset(mesh.attributes.keys()):
        raise Damaged("another form than that of the points")
    for name, kind in declared.items():
        attributes.memory(mesh, name, _TYPES[kind])
    form = bmesh.new()
    form.from_mesh(mesh)
    return form


def _clear(carrier):
    form = bmesh.new()
    form.to_mesh(carrier)
    form.free()


def _faces(carrier, edges, triangles):
    """Room for edges and triangles in an evaluated mesh: which points they join, and which edges leave a triangle's corners."""
    found = {"edges": _edges(carrier, edges)}
    if triangles == 0:
        return found | {"triangles": np.empty((0, 3), np.int32), "sides": np.empty((0, 3), np.int32)}
    carrier.loops.add(3 * triangles)
    carrier.polygons.add(triangles)
    if ".corner_vert" in carrier.attributes:
        starts = attributes.items(carrier.polygons, "<i4", ())
        corners, sides = (attributes.memory(carrier, name, 'INT', 'CORNER') for name in (".corner_vert", ".corner_edge"))
    else:
        # Before Blender 3.6 a polygon is a record that begins with its first corner and how many it has, and a corner one
        # of a vertex and an edge.
        polygons, records = attributes.items(carrier.polygons, "<i4", (2,)), attributes.items(carrier.loops, "<i4", (2,))
        polygons[:, 1] = 3
        starts, corners, sides = polygons[:, 0], records[:, 0], records[:, 1]
    starts[:] = np.arange(0, 3 * triangles, 3)
    return found | {"triangles": corners.reshape(-1, 3), "sides": sides.reshape(-1, 3)}


def _edges(carrier, count):
    """Room for edges in an evaluated mesh: the points that each of them joins."""
    carrier.edges.add(count)
    if count == 0:
        return np.empty((0, 2), np.int32)
    if ".edge_verts" in carrier.attributes:
        return attributes.memory(carrier, ".edge_verts", 'INT32_2D', 'EDGE')
    # Before Blender 3.6 an edge is a record that begins with its ends.
    return attributes.items(carrier.edges, "<i4", (2,))


def _join(carrier, curves):
    """Join points that follow each other and are of the same curve by edges."""
    starts = np.flatnonzero(curves[1:] == curves[:-1])
    ends = _edges(carrier, len(starts))
    ends[:, 0] = starts
    ends[:, 1] = starts + 1
