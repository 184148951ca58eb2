"""How a pin finds its root again: a number that the mesh keeps at the vertex, or else the place in the mesh.

The number stands in an attribute of the user's mesh, which Blender carries along through edits of the topology. Where it is
not found (a linked mesh cannot be marked), the vertex at the stored place is the root. Where that is not exactly one vertex,
the binding is broken: the pin does nothing until somebody binds it again.
"""

import zlib

from ...core.lazy import numpy as np

ATTRIBUTE = "motus_pin"
TOLERANCE = 1e-5
"""Of the mesh's size: how far from the stored place a vertex may stand."""
SHAPE = "motus_pin_shape"
"""Attributes by this name, and numbers behind it, say how far pins that were made of strokes move each vertex."""
FIRST_ANCHOR, LAST_ANCHOR = 1 << 20, 1 << 24
"""Blender interpolates the numbers of vertices for new ones between them, in single precision: what is halfway
between none and one of these is none of them."""

OK, LOST, AMBIGUOUS = 0, 1, 2


def root(row, positions, anchors, size):
    """(vertex or None, OK, LOST or AMBIGUOUS) of a pin.

    anchors: {number: indices of the vertices that have it}; size: diagonal of the mesh's bounding box.
    """
    marked = anchors.get(row.anchor, ()) if row.anchor else ()
    if len(marked) == 1:
        return int(marked[0]), OK  # type: ignore[misc]
    candidates = np.asarray(marked) if len(marked) else np.arange(len(positions))
    near = candidates[_distances(positions[candidates], row.place) <= TOLERANCE * size]
    if len(near) == 1:
        return int(near[0]), OK
    if row.vertex in near:
        return row.vertex, OK  # several stand at the very place: the one that was it before
    return None, AMBIGUOUS if len(near) or len(marked) else LOST


def diagonal(positions):
    """Length of the diagonal of the bounding box."""
    if len(positions) == 0:
        return 0.0
    return float(np.linalg.norm((positions.max(axis=0) - positions.min(axis=0)).astype(float)))


def anchors(mesh):
    """The numbers of a mesh's vertices, int32 (n,); None where it has none."""
    attribute = mesh.attributes.get(ATTRIBUTE)
    if attribute is None or (attribute.data_type, attribute.domain) != ('INT', 'POINT'):
        return None
    if len(attribute.data) != len(mesh.vertices):
        return None
    found = np.empty(len(mesh.vertices), np.int32)
    attribute.data.foreach_get("value", found)
    return found


def by_number(numbers):
    """{number: indices of the vertices that have it} of anchors()."""
    if numbers is None:
        return {}
    marked = np.flatnonzero(numbers)
    found = {}
    for vertex, number in zip(marked.tolist(), numbers[marked].tolist()):
        found.setdefault(number, []).append(vertex)
    return found


def mark(mesh, vertex, used):
    """The number of a vertex, which is given one where it has none. 0: the mesh is not ours to mark.

    used: numbers that pins of other roots have.
    """
    if mesh.library or mesh.override_library:
        return 0
    numbers = anchors(mesh)
    if numbers is None:
        if ATTRIBUTE in mesh.attributes:  # of another kind
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
    """Take back the numbers that no pin has any more, and with the last one the attribute."""
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
    """How far a pin that was made of a stroke moves each vertex, float32 (n, 3); None where the mesh does not say it."""
    attribute = mesh.attributes.get(name)
    if attribute is None or (attribute.data_type, attribute.domain) != ('FLOAT_VECTOR', 'POINT'):
        return None
    if len(attribute.data) != len(mesh.vertices):
        return None
    found = np.empty(3 * len(mesh.vertices), np.float32)
    attribute.data.foreach_get("vector", found)
    return found.reshape(-1, 3)


def keep_shape(mesh, offsets):
    """Let the mesh keep what shape() gives; returns its name."""
    name = _new_attribute(mesh, SHAPE, 'FLOAT_VECTOR')
    mesh.attributes[name].data.foreach_set("vector", np.ascontiguousarray(offsets, np.float32).ravel())
    return name


def drop_shapes(mesh, used):
    """Take back the shapes that no pin has any more. used: names of those that pins have."""
    if mesh.library or mesh.override_library:
        return
    for name in [name for name in mesh.attributes.keys() if name.startswith(SHAPE) and name not in used]:
        _remove_attribute(mesh, name)


def _new_attribute(mesh, name, kind):
    """Its name, which Blender makes another one where that name is taken; the user's active attribute stays so."""
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
