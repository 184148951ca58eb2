"""Make points on the owner: the evaluated mesh of the hub has the points, and a Geometry Nodes modifier of the owner brings them in.

The hub is a hidden object that belongs to the owner. In the file, its mesh has attributes but no points. At each solve, the evaluated mesh
is emptied to this form and given the required number of points. The memory of these points is new, and shared with neither the original
mesh nor earlier evaluated copies. The solver therefore writes into it directly.

The weight is the influence of the results; no points are shown if it is 0.
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
"""Whether the modifier is put before the owner's modifiers: no, so that those shape only the owner's own geometry."""
MATERIAL, OBJECT, COLLECTION = "Material", "Object", "Collection"
FORMS = {name: ((name, 'INPUT', f"NodeSocket{name}"),) for name in (MATERIAL, OBJECT, COLLECTION)}
"""Variants of the node group -> additional input sockets; each variant is named by the input that determines what is made of the points.

MATERIAL: the shape that the system declares, with a material. OBJECT: instances of an object. COLLECTION: instances of objects of a
collection. Each variant has its own nodes, and no more inputs than it needs, to keep files small.
"""
TUBE_SIDES = 8
RADIUS = "radius"

_forms = keeping.OfProcess(
    "empty BMeshes with the attributes of the points that a system makes", "name of the system, and (name, kind) of each attribute", most=64
)
_TYPES = {
    'FLOAT': 'FLOAT',
    'INT': 'INT',
    'VECTOR': 'FLOAT_VECTOR',
    'COLOR': 'FLOAT_COLOR',
    'QUATERNION': 'QUATERNION',
    'EULER': 'FLOAT_VECTOR',
}
"""Kind of an attribute -> Blender's data type of the attribute.

EULER: Euler angles in place of quaternions, for Blender versions without quaternion attributes.
"""


class Room:
    """Memory for the points that a solver makes in one call. The solver requests the memory by calling context.points.

    is_full: whether the solver has requested more points than the system allows.
    """

    def __init__(self, system, carrier, _inputs, context):
        self._system, self._made, self._carrier, self._context = system, system.makes_points, carrier, context
        self._found: dict[str, Any] | None = None
        self._staged: list[Any] = []
        self.is_full = False
        context.points = self._points

    def _points(self, count, edges=0, triangles=0):
        self.is_full = count > self._made.capacity
        if self.is_full and self._made.shape == 'FACES':
            count = edges = triangles = 0  # no points at all: a part of a surface would be a different surface
        count = min(count, self._made.capacity)
        present = _resize(self._system, self._carrier, int(count), self._context)
        self._staged = []
        self._found = {"position": self._positions(count)}
        if self._made.shape == 'FACES':
            self._found |= _faces(self._carrier, int(edges), int(triangles))
        for name, kind in present:
            self._found[name] = (
                self._rotations(name, count) if kind == 'EULER' else attributes.made(self._carrier, name, _TYPES[kind], count)
            )
        return self._found

    def _positions(self, count):
        if "position" in self._carrier.attributes:
            return attributes.made(self._carrier, "position", 'FLOAT_VECTOR', count)
        # Before Blender 3.5 a vertex is a struct that begins with its position.
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
        """Whether the positions, radii and rotations of the points are finite, so that they may reach Blender."""
        placing = (
            name
            for name, kind in (("position", 'VECTOR'), *self._made.attributes)
            if name == "position" or name == RADIUS or kind == 'QUATERNION'
        )
        return self._found is None or finite.is_finite(*(self._found[name] for name in placing if name in self._found))

    def write(self, weight):
        """Finish the points that the solver has filled in: store what could not be filled in place, and join points of curves by edges.

        Remove all points from the evaluated hub's mesh if the weight (influence of the results) is 0 or if the solver has requested none.
        Any other weight is ignored: points are not blended.
        """
        if weight == 0.0 or self._found is None:
            _clear(self._carrier)
            return
        for write in self._staged:
            write()
        if self._made.shape in {'CURVES', 'TUBES'}:
            _join(self._carrier, self._found["curve"])


def prepare(system, mesh, settings):
    """Add the attributes of the points to a hub's mesh, except those that the system does not need with these settings of the owner."""
    unneeded = system.makes_points.unneeded(settings)
    for name, kind in system.makes_points.attributes:
        if name not in unneeded:
            mesh.attributes.new(name, _TYPES[_made_as(kind)], 'POINT')


def write_nothing(_system, carrier):
    """Remove all points from the evaluated hub's mesh (carrier)."""
    _clear(carrier)


def add_nodes(system, group, start, form):
    """Add to the modifier's node group the nodes that read the points from the hub's mesh and turn them into geometry.

    start: Group Input node of the node group. form: variant of the node group, a key of FORMS. Returns the output socket that has the
    owner's own geometry and the geometry made of the points.
    """
    made = system.makes_points
    hub = node_groups.add_node(group, "GeometryNodeObjectInfo", transform_space='RELATIVE' if made.space == 'WORLD' else 'ORIGINAL')
    # As an instance, the geometry keeps its place in the world, with all attributes whatever they mean. A surface has only positions,
    # and modifiers behind this one, which do not reach into instances, have to get its geometry.
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
    # Blender chooses the object of a collection for each instance by the attribute "id" if no socket is linked to the instance index.
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
        # Versions of Blender without this input apply the radius by themselves.
        _link_radius(made, group, node, "Scale")
    return node.outputs["Mesh"]


_SHAPES = {'POINTS': _as_points, 'CURVES': _as_curves, 'TUBES': _as_tubes, 'FACES': _as_faces}
"""Points.shape -> function that adds the nodes which make this shape of the hub's mesh."""


def _link_radius(made, group, node, name):
    if (RADIUS, 'FLOAT') in made.attributes:
        group.links.new(node_groups.add_node(group, "GeometryNodeInputRadius").outputs[0], node.inputs[name])


def _made_as(kind):
    """Return the kind with which an attribute is made in this version of Blender.

    The kind stays as declared, except that 'QUATERNION' becomes 'EULER' in versions without quaternion attributes.
    """
    return 'EULER' if kind == 'QUATERNION' and not capabilities.has_quaternion_attributes() else kind


def _found_as(mesh, name, kind):
    """Return the kind that an attribute declared as `kind` has on a hub's mesh.

    The kind is the declared one, except that 'QUATERNION' is 'EULER' if a version of Blender without quaternion attributes has made the
    mesh.
    """
    return 'EULER' if kind == 'QUATERNION' and mesh.attributes[name].data_type == _TYPES['EULER'] else kind


def _resize(system, carrier, count, context):
    """Give an evaluated hub's mesh (carrier) the attributes of the points, and `count` points with undefined contents.

    Returns (name, kind) of each attribute, as a tuple. Raises Damaged if the original mesh lacks attributes that the settings need.
    """
    mesh = carrier.original
    names = tuple(mesh.attributes.keys())
    form, present = context.kept("form", names, lambda: _form(system, mesh, names, context.settings))
    # BMesh.to_mesh() is the only way to empty the mesh that keeps the driver that is being evaluated.
    form.to_mesh(carrier)
    carrier.vertices.add(count)
    return present


def _form(system, mesh, names, settings):
    """Return (empty BMesh, (name, kind) of each attribute) of a hub's original mesh; names: of its attributes.

    Raises Damaged if the mesh lacks attributes that the settings need.
    """
    made = system.makes_points
    present = tuple((name, _found_as(mesh, name, kind)) for name, kind in made.attributes if name in names)
    if len(present) < len(made.attributes):
        missing = {name for name, _ in made.attributes}.difference(names)
        if not missing.issubset(made.unneeded(settings)):
            raise Damaged("another form than that of the points")
    return _forms.made((system.name, present), lambda: _form_of(mesh, present)), present


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
    """Add edges and triangles to an evaluated mesh; returns a dictionary of index arrays, which the solver has to fill.

    "edges": (n, 2), the points that an edge joins. "triangles": (m, 3), the points of each triangle. "sides": (m, 3), the edge that starts
    at each corner of a triangle.
    """
    found = {"edges": _edges(carrier, edges)}
    if triangles == 0:
        return found | {"triangles": np.empty((0, 3), np.int32), "sides": np.empty((0, 3), np.int32)}
    carrier.loops.add(3 * triangles)
    carrier.polygons.add(triangles)
    if ".corner_vert" in carrier.attributes:
        starts = attributes.items(carrier.polygons, "<i4", ())
        corners, sides = (attributes.memory(carrier, name, 'INT', 'CORNER') for name in (".corner_vert", ".corner_edge"))
    else:
        # Before Blender 3.6 a polygon is a struct that begins with its first corner and its number of corners, and a corner is a struct
        # of a vertex and an edge.
        polygons, records = attributes.items(carrier.polygons, "<i4", (2,)), attributes.items(carrier.loops, "<i4", (2,))
        polygons[:, 1] = 3
        starts, corners, sides = polygons[:, 0], records[:, 0], records[:, 1]
    starts[:] = np.arange(0, 3 * triangles, 3)
    return found | {"triangles": corners.reshape(-1, 3), "sides": sides.reshape(-1, 3)}


def _edges(carrier, count):
    """Add edges to an evaluated mesh; returns an array (count, 2), which has to be filled with the indices of each edge's points."""
    carrier.edges.add(count)
    if count == 0:
        return np.empty((0, 2), np.int32)
    if ".edge_verts" in carrier.attributes:
        return attributes.memory(carrier, ".edge_verts", 'INT32_2D', 'EDGE')
    # Before Blender 3.6 an edge is a struct that begins with its two vertices.
    return attributes.items(carrier.edges, "<i4", (2,))


def _join(carrier, curves):
    """Add an edge between each two consecutive points of the same curve to an evaluated mesh.

    curves: array with the number of the curve for each point.
    """
    starts = np.flatnonzero(curves[1:] == curves[:-1])
    ends = _edges(carrier, len(starts))
    ends[:, 0] = starts
    ends[:, 1] = starts + 1
