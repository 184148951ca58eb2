"""Find the vertex that a pin pulls (its root) again after changes of the mesh, by a number stored at the vertex or by its position.

The number (anchor) is a vertex attribute of the user's mesh, which Blender keeps through changes of the topology. If the attribute is
missing, since the mesh is linked, the root is the vertex at the stored position. If not exactly one vertex fits, the binding is broken: the
pin does nothing until the user binds it again.
"""

import zlib

from ...core.lazy import numpy as np

ATTRIBUTE = "motus_pin"
TOLERANCE = 1e-5
"""Largest distance of a vertex from the stored position of a pin's root, as a share of the mesh's size."""
SHAPE = "motus_pin_shape"
"""Prefix of the names of vertex attributes that store, for a pin made of a stroke, how far the pin moves each vertex."""
FIRST_ANCHOR, LAST_ANCHOR = 1 << 20, 1 << 24
"""Range of the numbers that identify the roots of pins.

Blender interpolates the numbers for new vertices in single precision. The mean of a number and 0 (no number) is below the range.
"""

OK, LOST, AMBIGUOUS = 0, 1, 2


def root(row, positions, anchors, size):
    """Find the vertex that a pin pulls: (vertex, OK), or (None, LOST or AMBIGUOUS).

    row: table.Row of the pin. anchors: {number: indices of the vertices that have the number}. size: diagonal of the mesh's bounding box.
    """
    marked = anchors.get(row.anchor, ()) if row.anchor else ()
    if len(marked) == 1:
        return int(marked[0]), OK  # type: ignore[misc]
    candidates = np.asarray(marked) if len(marked) else np.arange(len(positions))
    near = candidates[_distances(positions[candidates], row.place) <= TOLERANCE * size]
    if len(near) == 1:
        return int(near[0]), OK
    if row.vertex in near:
        return row.vertex, OK  # several vertices are at this position: keep the previous root
    return None, AMBIGUOUS if len(near) or len(marked) else LOST


def diagonal(positions):
    """Length of the diagonal of the bounding box of positions (n, 3); 0.0 if there are none."""
    if len(positions) == 0:
        return 0.0
    return float(np.linalg.norm((positions.max(axis=0) - positions.min(axis=0)).astype(float)))


def anchors(mesh):
    """Number that pins have given each vertex of a mesh, int32 (n,), 0 for none; None if the mesh has no such attribute."""
    attribute = mesh.attributes.get(ATTRIBUTE)
    if attribute is None or (attribute.data_type, attribute.domain) != ('INT', 'POINT'):
        return None
    if len(attribute.data) != len(mesh.vertices):
        return None
    found = np.empty(len(mesh.vertices), np.int32)
    attribute.data.foreach_get("value", found)
    return found


def by_number(numbers):
    """Return {number: indices of the vertices that have the number}. numbers: array from anchors(), or None."""
    if numbers is None:
        return {}
    marked = np.flatnonzero(numbers)
    found = {}
    for vertex, number in zip(marked.tolist(), numbers[marked].tolist()):
        found.setdefault(number, []).append(vertex)
    return found


def mark(mesh, vertex, used):
    """Return the number of a vertex, and assign a new number if the vertex has none of its own.

    used: numbers of pins that pull different vertices. Returns 0 if the mesh must not be changed.
    """
    if mesh.library or mesh.override_library:
        return 0
    numbers = anchors(mesh)
    if numbers is None:
        if ATTRIBUTE in mesh.attributes:  # the user has an attribute of this name with a different type
            _remove_attribute(mesh, ATTRIBUTE)
        _new_attribute(mesh, ATTRIBUTE, 'INT')
        numbers = anchors(mesh)
    own = int(numbers[vertex])
    if own and own not in used and np.count_nonzero(numbers == own) == 1:
        return own
    taken = used | set(numbers[numbers != 0].tolist())
    own = FIRST_ANCHOR | 1 | (zlib.crc32(f"{mesh.name} {vertex}".encode()) % LAST_ANCHOR)
    while own in taken:
        own = own + 2 if own + 2 < LAST_ANCHOR else FIRST_ANCHOR | 1
    mesh.attributes[ATTRIBUTE].data[vertex].value = own
    return own


def unmark(mesh, used):
    """Remove the numbers that no pin uses from the vertices, and the attribute if no number is left. used: numbers of pins."""
    numbers = anchors(mesh)
    if numbers is None or mesh.library or mesh.override_library:
        return
    kept = np.isin(numbers, list(used)) & (numbers != 0)
    if not kept.any():
        _remove_attribute(mesh, ATTRIBUTE)
        return
    mesh.attributes[ATTRIBUTE].data.foreach_set("value", np.where(kept, numbers, 0).astype(np.int32))
    mesh.update()


def shape(mesh, name):
    """Displacement of each vertex by a pin made of a stroke, float32 (n, 3). name: of the attribute that stores it.

    None if the mesh has no such attribute.
    """
    attribute = mesh.attributes.get(name)
    if attribute is None or (attribute.data_type, attribute.domain) != ('FLOAT_VECTOR', 'POINT'):
        return None
    if len(attribute.data) != len(mesh.vertices):
        return None
    found = np.empty(3 * len(mesh.vertices), np.float32)
    attribute.data.foreach_get("vector", found)
    return found.reshape(-1, 3)


def keep_shape(mesh, offsets):
    """Store a displacement for each vertex, (n, 3), in a new attribute of the mesh; returns the name of the attribute."""
    name = _new_attribute(mesh, SHAPE, 'FLOAT_VECTOR')
    mesh.attributes[name].data.foreach_set("vector", np.ascontiguousarray(offsets, np.float32).ravel())
    return name


def drop_shapes(mesh, used):
    """Remove the attributes with displacements that no pin uses. used: names of the attributes that pins use."""
    if mesh.library or mesh.override_library:
        return
    for name in [name for name in mesh.attributes.keys() if name.startswith(SHAPE) and name not in used]:
        _remove_attribute(mesh, name)


def _new_attribute(mesh, name, kind):
    """Add a vertex attribute to a mesh without changing the active attribute; returns the name that Blender gave it."""
    active = mesh.attributes.active_index
    name = mesh.attributes.new(name, kind, 'POINT').name
    mesh.attributes.active_index = active
    return name


def _remove_attribute(mesh, name):
    active = mesh.attributes.active
    kept = active.name if active else ""
    mesh.attributes.remove(mesh.attributes[name])
    place = mesh.attributes.find(kept)
    if place >= 0:
        mesh.attributes.active_index = place


def _distances(positions, place):
    away = positions.astype(float) - np.asarray(place, float)
    return np.sqrt(np.einsum("ij,ij->i", away, away))
