"""A lattice's rest made by hand: the points as they stand deform nothing from then on.

Blender's Lattice modifier knows regular rests alone. So a shape key of each mesh holds the places that the lattice, as it stands, brings to
where the vertices are modelled.
"""

import hashlib

from ..core.file import stored
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import pulling, shapes

STORED = "motus_rest"
"""Name of a custom property. A lattice's data hold the points of a rest made by hand in it, a mesh the name of the shape key.

A mesh has one such key at most: the lattice has to act before all other modifiers.
"""
PLACES = "motus_rest_places"
"""Name of a mesh's custom property: a digest of the places that the shape key holds, by which a key is found that was renamed."""
ROUNDS = 40
"""Most steps of Newton's method for a vertex."""
NEAR = 1e-6
"""Share of the lattice's size: a vertex that the lattice brings nearer to its place counts as brought there."""
FAR = 1e-4
"""Share of the lattice's size: no vertex may stay further away from its place."""
STEP = 1e-3
"""Share of the lattice's size over which the deformation's change is measured."""


def key_of(obj):
    """Return the shape key of a mesh object that a rest made by hand has brought; None if there is none."""
    keys = obj.data.shape_keys if obj.type == 'MESH' else None
    if keys is None or STORED not in obj.data:
        return None
    try:
        found = keys.key_blocks.get(stored.text(obj.data[STORED]))
    except stored.Damaged:
        return None
    digest = obj.data.get(PLACES)
    if found is None and isinstance(digest, str):
        return next((key for key in keys.key_blocks if _digest(key) == digest), None)
    return found


def _digest(key):
    flat = np.empty(3 * len(key.data), np.float32)
    key.data.foreach_get("co", flat)
    return hashlib.blake2b(flat.tobytes(), digest_size=16).hexdigest()


def is_made(lattice):
    """Whether a lattice has a rest made by hand."""
    return STORED in lattice.data


def is_lost(lattice, objects):
    """Whether the rest made by hand of a lattice, or the shape key of one of the objects that it deforms, is not what make() has left."""
    return is_made(lattice) and (_made(lattice.data) is None or any(STORED in obj.data and key_of(obj) is None for obj in objects))


def points(data):
    """Points of a lattice at rest, (n, 3) float32: as made by hand, or the regular grid."""
    made = _made(data)
    return shapes.lattice_points(data, "co") if made is None else made


def _made(data):
    """Points of a rest made by hand, (n, 3) float32; None if there is none, it is damaged, or it is of another resolution."""
    count = 3 * len(data.points)
    try:
        return np.array(stored.finite_doubles(data.get(STORED), count), np.float32).reshape(-1, 3)
    except stored.Damaged:
        return None


def make(lattice, uses):
    """Make the present points of a lattice its rest. uses: [(mesh object, name of the Lattice modifier)] of all that it deforms.

    Raises Refused, before anything is changed, if the lattice folds over itself at a vertex.
    """
    found = [(obj, _undeformed(obj, obj.modifiers[name], lattice)) for obj, name in uses]
    for obj, places in found:
        key = key_of(obj)
        if key is None:
            if obj.data.shape_keys is None:
                obj.shape_key_add(name="Basis", from_mix=False)
            active = obj.active_shape_key_index
            key = obj.shape_key_add(name=f"{lattice.name} Rest", from_mix=False)
            obj.active_shape_key_index = active
        key.data.foreach_set("co", places.ravel())
        obj.data[STORED], obj.data[PLACES] = key.name, _digest(key)
        key.value = 1.0
        obj.data.update()
    lattice.data[STORED] = shapes.lattice_points(lattice.data).ravel().tolist()


def clear(lattice, uses):
    """Take the regular grid as the rest again: remove what make() has added, and set the points to the grid."""
    for obj, _ in uses:
        release(obj)
    lattice.data.pop(STORED, None)
    shapes.set_lattice_points(lattice.data, shapes.lattice_points(lattice.data, "co"))


def release(obj):
    """Remove the shape key that a rest made by hand has brought to an object, and the reference key if nothing else is left."""
    key = key_of(obj)
    if key is None:
        return
    for name in (STORED, PLACES):
        obj.data.pop(name, None)
    obj.shape_key_remove(key)
    if len(obj.data.shape_keys.key_blocks) == 1:
        obj.shape_key_clear()


def _undeformed(obj, modifier, lattice):
    """Places (n, 3) float32 in the object's space that the lattice brings to where the mesh's vertices are modelled."""
    matrix = np.array(lattice.matrix_world, np.float64)
    model, _ = pulling.native_lattice(lattice.data, matrix)
    moves = (shapes.lattice_points(lattice.data) - shapes.lattice_points(lattice.data, "co")) @ matrix[:3, :3].T
    influence = _influence(obj, modifier)
    weights = pulling.point_weights(lattice)
    size = float(np.linalg.norm(matrix[:3, :3], axis=0).max())

    def deformed(places, rows):
        return model.deform(places.astype(np.float32), moves.astype(np.float32), influence[rows], weights).astype(np.float64)

    wanted = shapes.in_world(_modelled(obj), obj.matrix_world).astype(np.float64)
    found = inverse(deformed, wanted, size)
    return shapes.in_world(found.astype(np.float32), obj.matrix_world.inverted())


def inverse(deformed, wanted, size):
    """Places (n, 3) that a deformation brings to wanted places (n, 3), by Newton's method.

    deformed(places, rows): where places of these rows come to. size: of what deforms. Raises Refused if a place is not found.
    """
    found, rows = wanted.copy(), np.arange(len(wanted))
    best, least = wanted.copy(), np.full(len(wanted), np.inf)
    axes = STEP * size * np.eye(3)
    for _ in range(ROUNDS):
        left = wanted[rows] - deformed(found[rows], rows)
        distances = np.linalg.norm(left, axis=1)
        is_better = distances < least[rows]
        best[rows[is_better]], least[rows[is_better]] = found[rows[is_better]], distances[is_better]
        # A step that has not come nearer was too long: half of it from the best place so far.
        found[rows[~is_better]] = 0.5 * (found[rows[~is_better]] + best[rows[~is_better]])
        is_left = is_better & (distances > NEAR * size)
        halved = rows[~is_better]
        rows, left = rows[is_left], left[is_left]
        if len(rows):
            slopes = np.stack([deformed(found[rows] + axis, rows) - deformed(found[rows] - axis, rows) for axis in axes], axis=2)
            slopes /= 2.0 * STEP * size
            is_flat = np.abs(np.linalg.det(slopes)) < 1e-6
            slopes[is_flat] = np.eye(3)
            steps = np.linalg.solve(slopes, left[..., None])[..., 0]
            found[rows] += steps * np.minimum(1.0, 0.25 * size / np.maximum(np.linalg.norm(steps, axis=1), 1e-30))[:, None]
        rows = np.union1d(rows, halved)
        if not len(rows):
            break
    folded = int((least > FAR * size).sum())
    if folded:
        raise Refused(tr("The lattice folds over itself: {count} vertices have no place at rest").format(count=folded))
    return best


def _modelled(obj):
    keys = obj.data.shape_keys
    if keys is None:
        return shapes.positions(obj.data)
    found = np.empty(3 * len(obj.data.vertices), np.float32)
    keys.reference_key.data.foreach_get("co", found)
    return found.reshape(-1, 3)


def _influence(obj, modifier):
    found = np.full(len(obj.data.vertices), modifier.strength, np.float32)
    group = obj.vertex_groups.get(modifier.vertex_group)
    if group is not None:
        weights = np.array([pulling.weight(vertex, group.index) for vertex in obj.data.vertices], np.float32)
        found *= 1.0 - weights if modifier.invert_vertex_group else weights
    return found
