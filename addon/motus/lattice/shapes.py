"""Positions of objects' points as arrays, as modelled or evaluated with all modifiers."""

import contextlib

from ..core.lazy import numpy as np


@contextlib.contextmanager
def evaluated_mesh(obj, depsgraph):
    """Evaluated mesh of an object; None for an object that has no mesh."""
    evaluated = obj.evaluated_get(depsgraph)
    try:
        yield evaluated.to_mesh()
    except RuntimeError:  # to_mesh() raises this for objects without geometry
        yield None
    finally:
        evaluated.to_mesh_clear()


def positions(mesh):
    """Positions of a mesh's vertices, (v, 3) float32."""
    result = np.empty(3 * len(mesh.vertices), np.float32)
    if "position" in mesh.attributes:  # the attribute is faster, but exists only from Blender 3.5 on
        mesh.attributes["position"].data.foreach_get("vector", result)
    else:
        mesh.vertices.foreach_get("co", result)
    return result.reshape(-1, 3)


def triangles(mesh):
    """Triangles of a mesh's faces, (t, 3) int32."""
    mesh.calc_loop_triangles()
    result = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", result)
    return result.reshape(-1, 3)


def lattice_points(lattice, name="co_deform"):
    """Points of a lattice, (n, 3) float32. name: "co_deform" as they stand, "co" at rest."""
    result = np.empty(3 * len(lattice.points), np.float32)
    lattice.points.foreach_get(name, result)
    return result.reshape(-1, 3)


def in_world(points, matrix):
    """Points transformed by a 4 x 4 matrix, (m, 3) float32."""
    rows = np.array(matrix, np.float64)
    return (points @ rows[:3, :3].T + rows[:3, 3]).astype(np.float32)


def world_points(obj, depsgraph):
    """World positions of the points of an evaluated object, (m, 3) float32; empty if the object has no shape."""
    evaluated = obj.evaluated_get(depsgraph)
    if obj.type == 'LATTICE':
        return in_world(lattice_points(evaluated.data), evaluated.matrix_world)
    with evaluated_mesh(obj, depsgraph) as mesh:
        found = positions(mesh) if mesh else np.empty((0, 3), np.float32)
    return in_world(found, evaluated.matrix_world)


def set_lattice_points(data, points):
    """Set a lattice's points in its own space, (p, 3) float32."""
    data.points.foreach_set("co_deform", points.ravel())
    # Unlike foreach_set and update_tag(), assigning a single point also redraws the editors that show the lattice.
    data.points[0].co_deform = data.points[0].co_deform
