"""Points of objects as arrays: as modelled, and as evaluated with all modifiers."""

import contextlib

from ..core.lazy import numpy as np


@contextlib.contextmanager
def evaluated_mesh(obj, depsgraph):
    """The mesh that an object is drawn with; None where it has none."""
    evaluated = obj.evaluated_get(depsgraph)
    try:
        yield evaluated.to_mesh()
    except RuntimeError:  # an object without geometry of that kind
        yield None
    finally:
        evaluated.to_mesh_clear()


def positions(mesh):
    """(v, 3) float32 of a mesh's vertices."""
    result = np.empty(3 * len(mesh.vertices), np.float32)
    if "position" in mesh.attributes:  # faster; not there before 3.5
        mesh.attributes["position"].data.foreach_get("vector", result)
    else:
        mesh.vertices.foreach_get("co", result)
    return result.reshape(-1, 3)


def triangles(mesh):
    """(t, 3) int32 of a mesh's faces."""
    mesh.calc_loop_triangles()
    result = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", result)
    return result.reshape(-1, 3)


def lattice_points(lattice, name="co_deform"):
    """(n, 3) float32 of a lattice's points: "co_deform" as they stand, "co" at rest."""
    result = np.empty(3 * len(lattice.points), np.float32)
    lattice.points.foreach_get(name, result)
    return result.reshape(-1, 3)


def in_world(points, matrix):
    """(m, 3) float32 by a 4 x 4 matrix."""
    rows = np.array(matrix, np.float64)
    return (points @ rows[:3, :3].T + rows[:3, 3]).astype(np.float32)


def world_points(obj, depsgraph):
    """(m, 3) float32: where the points of an evaluated object stand in the world; none where it has no shape."""
    evaluated = obj.evaluated_get(depsgraph)
    if obj.type == 'LATTICE':
        return in_world(lattice_points(evaluated.data), evaluated.matrix_world)
    with evaluated_mesh(obj, depsgraph) as mesh:
        found = positions(mesh) if mesh else np.empty((0, 3), np.float32)
    return in_world(found, evaluated.matrix_world)


def set_lattice_points(data, points):
    """Move a lattice's points to (p, 3) float32, in its own space."""
    data.points.foreach_set("co_deform", points.ravel())
    # Unlike foreach_set and update_tag(), a single assignment also tells the editors that show the lattice to draw.
    data.points[0].co_deform = data.points[0].co_deform
