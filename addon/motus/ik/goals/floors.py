"""Floors that the targets of chains do not go below: the plane through an object's origin, along its X and Y axes."""

from mathutils import Matrix

from ...core import native
from ...core.file import deleted
from ...core.file.pointers import pointed


def lift(targets, entries, rows):
    """Lift the targets of chains above their floors. targets: world matrices (C, 16), changed in place. rows: of the chains with a floor.

    A floor that was deleted lifts nothing.
    """
    for row in rows:
        entry = entries[row]
        floor = pointed(entry, "floor")
        if floor is not None and not deleted.is_deleted(floor):
            targets[row, 12:15] = above(targets[row, 12:15], floor.matrix_world, entry.floor_height, entry.floor_margin)


def above(place, matrix, height, margin):
    """World position of a target, or the one above the floor that takes its stead. matrix: of the floor's object."""
    axes = matrix.to_3x3()
    normal = axes.col[0].cross(axes.col[1])
    if normal.dot(axes.col[2]) < 0.0:  # a mirrored object: its Z axis still points away from the floor
        normal = -normal
    return native.module.above_floor(place, tuple(matrix.translation), tuple(normal.normalized()), height, margin)


def above_all(places, matrices, heights, margins):
    """above() at n times. places: (n, 3), changed in place. matrices: (n, 16), column by column. heights, margins: (n,)."""
    for index, matrix in enumerate(matrices):
        places[index] = above(places[index], Matrix(matrix.reshape(4, 4).T), heights[index], margins[index])
