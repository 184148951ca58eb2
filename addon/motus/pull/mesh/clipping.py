"""Clipping of the Mirror modifier, as Blender's own tools respect it.

Vertices on a mirror plane stay on the plane, and no vertex crosses it.
"""

from typing import Any, NamedTuple

from ...core.lazy import numpy as np


class Planes(NamedTuple):
    """Mirror planes of one Mirror modifier.

    axes: indices of the axes that are mirrored. within: largest distance from a plane at which a vertex counts as on it. space: 4x4 matrix
    from the object's space to the space of the planes; None if the planes are in the object's space.
    """

    axes: tuple
    within: float
    space: Any | None


def planes(obj):
    """Return Planes for each Mirror modifier of an object that is shown in viewports and has Clipping switched on."""
    found = []
    for modifier in obj.modifiers:
        if modifier.type == 'MIRROR' and modifier.use_clip and modifier.show_viewport:
            axes, other = tuple(axis for axis in range(3) if modifier.use_axis[axis]), modifier.mirror_object
            space = None if other is None else np.array(other.matrix_world.inverted_safe() @ obj.matrix_world, float)
            found.append(Planes(axes, modifier.merge_threshold, space))
    return found


def clip(places, before, every):
    """Move positions (m, 3) back to the mirror planes that hold their vertices; returns the positions.

    before: positions of the vertices before they were moved. every: list of Planes.
    """
    for one in every:
        now, was = _moved(places, one.space), _moved(before, one.space)
        is_held = np.zeros(len(places), bool)
        for axis in one.axes:
            held = (np.abs(was[:, axis]) <= one.within) | (now[:, axis] * was[:, axis] < 0.0)
            now[held, axis] = 0.0
            is_held |= held
        if is_held.any():
            back = None if one.space is None else np.linalg.inv(one.space)
            places = np.where(is_held[:, None], _moved(now, back), places)
    return places.astype(np.float32)


def _moved(places, matrix):
    places = np.array(places, float)
    return places if matrix is None else places @ matrix[:3, :3].T + matrix[:3, 3]
