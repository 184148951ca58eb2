"""Read and write data of a mesh as flat arrays, in the fastest way that this Blender version has.

Attributes are copied as a whole. Where older Blenders have no attributes, vertices, loops and points of shape keys are read item by item
through RNA.
"""

from ...core.lazy import numpy as np


def positions(mesh, found=None):
    """Positions of a mesh's vertices, float32 (n, 3). found: array (3 n,) that is filled and reused, or None."""
    if found is None:
        found = np.empty(3 * len(mesh.vertices), np.float32)
    attribute = mesh.attributes.get("position")
    if attribute is not None:
        attribute.data.foreach_get("vector", found)
    else:
        mesh.vertices.foreach_get("co", found)
    return found.reshape(-1, 3)


FEW = 8
"""If a mesh has at least FEW times as many vertices as were moved, only the moved vertices are written."""


def set_positions(mesh, flat, moved=None):
    """Set the positions of a mesh's vertices.

    flat: float32 (3 n,). moved: indices of vertices that may differ from the mesh, in any order; None for all.
    """
    attribute = mesh.attributes.get("position")
    if attribute is None:
        mesh.vertices.foreach_set("co", flat)
        return
    if not len(attribute.data):
        return
    places, found = flat.reshape(-1, 3), own_positions(mesh)
    if moved is None or FEW * len(moved) > len(found):
        np.copyto(found, places)
    elif len(moved):
        found[moved] = places[moved]


def own_positions(mesh):
    """Memory of the mesh's vertex positions, float32 (n, 3); writing into the array changes the mesh.

    None if this Blender gives no access to the memory, or if the mesh has no vertices.
    """
    attribute = mesh.attributes.get("position")
    if attribute is None or not len(attribute.data):
        return None
    import ctypes

    data = attribute.data
    # foreach_set would take twice as long. The array is shared with the evaluated mesh and undo steps until something is written
    # through RNA: setting one item to its own value gives this mesh its own array.
    data[0].vector = data[0].vector
    numbers = ctypes.cast(data[0].as_pointer(), ctypes.POINTER(ctypes.c_float))
    return np.ctypeslib.as_array(numbers, (len(data), 3))


def key_positions(key):
    """Positions of a shape key's points, float32 (n, 3)."""
    points = _key_points(key)
    found = np.empty(3 * len(points), np.float32)
    points.foreach_get("co", found)
    return found.reshape(-1, 3)


def set_key_positions(key, flat):
    """Set the positions of a shape key's points. flat: float32 (3 n,)."""
    _key_points(key).foreach_set("co", flat)


def _key_points(key):
    return key.points if hasattr(key, "points") else key.data


def triangles(mesh, visible_only=False):
    """Triangles of the mesh in Blender's triangulation, int32 (t, 3) vertex indices. visible_only: leave out hidden faces."""
    mesh.calc_loop_triangles()
    found = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", found)
    found = found.reshape(-1, 3)  # type: ignore[assignment]
    hidden = _hidden_faces(mesh) if visible_only else None
    if hidden is not None:
        faces = np.empty(len(found), np.int32)
        mesh.loop_triangles.foreach_get("polygon_index", faces)
        found = found[~hidden[faces]]
    return found


def edges(mesh):
    """Edges of a mesh, int32 (e, 2) vertex indices."""
    found = np.empty(2 * len(mesh.edges), np.int32)
    attribute = mesh.attributes.get(".edge_verts")
    if attribute is not None:
        attribute.data.foreach_get("value", found)
    else:
        mesh.edges.foreach_get("vertices", found)
    return found.reshape(-1, 2)


def corners(mesh):
    """Vertex index of each face corner of a mesh, int32 (c,)."""
    found = np.empty(len(mesh.loops), np.int32)
    attribute = mesh.attributes.get(".corner_vert")
    if attribute is not None:
        attribute.data.foreach_get("value", found)
    else:
        mesh.loops.foreach_get("vertex_index", found)
    return found


def faces_of_edges(mesh):
    """Number of faces at each edge of a mesh, int (e,)."""
    used = np.empty(len(mesh.loops), np.int32)
    attribute = mesh.attributes.get(".corner_edge")
    if attribute is not None:
        attribute.data.foreach_get("value", used)
    else:
        mesh.loops.foreach_get("edge_index", used)
    return np.bincount(used, minlength=len(mesh.edges))


def hidden_vertices(mesh):
    """Whether each vertex of a mesh is hidden, bool (n,); None if none is hidden."""
    return _flags(mesh, ".hide_vert", mesh.vertices)


def _hidden_faces(mesh):
    return _flags(mesh, ".hide_poly", mesh.polygons)


def _flags(mesh, name, items):
    found = np.zeros(len(items), bool)
    attribute = mesh.attributes.get(name)
    if attribute is not None:
        attribute.data.foreach_get("value", found)
    elif "position" not in mesh.attributes:
        items.foreach_get("hide", found)
    return found if found.any() else None


def sculpt_mask(mesh):
    """Sculpt mask of each vertex, float32 (n,), 1 for protected vertices; None if the mesh has no mask."""
    attribute = mesh.attributes.get(".sculpt_mask")
    layers = getattr(mesh, "vertex_paint_masks", None)
    data = attribute.data if attribute is not None else layers[0].data if layers else None
    if data is None or len(data) != len(mesh.vertices):
        return None
    found = np.empty(len(data), np.float32)
    data.foreach_get("value", found)
    return found


def group_weights(mesh, index):
    """Weights of a vertex group, float32 (n,); 0 for vertices outside the group."""
    found = (next((entry.weight for entry in vertex.groups if entry.group == index), 0.0) for vertex in mesh.vertices)
    return np.fromiter(found, np.float32, len(mesh.vertices))


def vertex_normal(mesh, corner_vertices, places, vertex):
    """Unit normal at a vertex, weighted by the angles of its faces like Blender's vertex normals; zero for a vertex without faces.

    corner_vertices: corners(mesh). places: positions (n, 3), which may differ from the mesh's positions.
    """
    total = np.zeros(3)
    for corner in np.flatnonzero(corner_vertices == vertex):
        first, count = _face_of_corner(mesh, int(corner))
        ring = places[corner_vertices[first : first + count]].astype(float)
        own = int(corner) - first
        before, after = ring[own - 1] - ring[own], ring[(own + 1) % count] - ring[own]
        area = np.cross(ring - ring[0], np.roll(ring, -1, axis=0) - ring[0]).sum(axis=0)
        lengths = np.linalg.norm(before) * np.linalg.norm(after)
        size = np.linalg.norm(area)
        if lengths > 0.0 and size > 0.0:
            total += area / size * np.arccos(np.clip(before @ after / lengths, -1.0, 1.0))
    size = np.linalg.norm(total)
    return total / size if size > 0.0 and np.isfinite(size) else np.zeros(3)


def _face_of_corner(mesh, corner):
    """Return (first corner, number of corners) of the face to which a corner belongs.

    The face is found by bisection, since reading all faces would take far longer.
    """
    low, high = 0, len(mesh.polygons) - 1
    while low < high:
        middle = (low + high + 1) // 2
        if mesh.polygons[middle].loop_start <= corner:
            low = middle
        else:
            high = middle - 1
    face = mesh.polygons[low]
    return face.loop_start, face.loop_total
