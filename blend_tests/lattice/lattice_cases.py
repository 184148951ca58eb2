"""Shared by the tests of lattices: objects of all kinds, and their points as evaluated."""

import bpy
import numpy as np

import support
from support import link


def shapes():
    return support.addon("lattice.shapes")


def ball(name="Ball", size=1.0, place=(0.0, 0.0, 0.0), points=300):
    """A mesh object of triangles on a sphere, a little uneven."""
    index = np.arange(points)
    z = 2.0 * (index + 0.5) / points - 1.0
    turn, radius = 2.4 * index, np.sqrt(1.0 - z * z)
    vertices = np.column_stack((radius * np.cos(turn), radius * np.sin(turn), z))
    vertices *= size * (1.0 + 0.1 * np.sin(5 * turn))[:, None]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices.tolist(), [], [(i, i + 8, i + 13) for i in range(points - 13)])
    obj = link(name, mesh)
    obj.location = place
    bpy.context.view_layer.update()
    return obj


def grid(name="Sheet", count=20, size=2.0):
    """A flat square mesh, count x count vertices, in the plane z = 0."""
    steps = np.linspace(-0.5 * size, 0.5 * size, count)
    vertices = [(x, y, 0.0) for y in steps for x in steps]
    faces = [
        (i + j * count, i + 1 + j * count, i + 1 + (j + 1) * count, i + (j + 1) * count) for j in range(count - 1) for i in range(count - 1)
    ]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    return link(name, mesh)


def curve(name="Curve"):
    """A Bezier curve with a bevel."""
    data = bpy.data.curves.new(name, 'CURVE')
    data.dimensions = '3D'
    data.bevel_depth = 0.05
    spline = data.splines.new('BEZIER')
    spline.bezier_points.add(2)
    for point, place in zip(spline.bezier_points, ((-1, 0, 0), (0, 1, 0.5), (1, 0, 0))):
        point.co = place
        point.handle_left_type = point.handle_right_type = 'AUTO'
    return link(name, data)


def surface(name="Surface"):
    """A NURBS patch, by Blender's own operator."""
    bpy.ops.surface.primitive_nurbs_surface_surface_add()
    bpy.context.object.name = name
    return bpy.context.object


def text(name="Text"):
    data = bpy.data.curves.new(name, 'FONT')
    data.body = "Motus"
    data.extrude = 0.1
    return link(name, data)


def lattice(name="Grid", resolution=(3, 3, 3)):
    obj = link(name, bpy.data.lattices.new(name))
    for axis, points in zip("uvw", resolution):
        setattr(obj.data, f"points_{axis}", points)
    return obj


def only(*objects):
    """Select these, the first one active."""
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in objects)
    bpy.context.view_layer.objects.active = objects[0] if objects else None


def evaluated(obj):
    """(m, 3) float32 of the object's points in the world, with all modifiers."""
    bpy.context.view_layer.update()
    return shapes().world_points(obj, bpy.context.evaluated_depsgraph_get())


def points_of(obj):
    """(n, 3) float32 of a lattice object's points."""
    return shapes().lattice_points(obj.data)


def displace(obj, amount=0.3, seed=1):
    """Move a lattice's points about."""
    moved = points_of(obj) + np.random.default_rng(seed).normal(scale=amount, size=(len(obj.data.points), 3))
    obj.data.points.foreach_set("co_deform", moved.astype(np.float32).ravel())
    obj.data.update_tag()
    bpy.context.view_layer.update()
