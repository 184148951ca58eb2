"""Soft bodies: one smooth surface around many thick bones whose shapes flow into each other, and the share that each bone has of it.

The surface is where a smooth minimum of the distances to all bones is 0. A grid of quads is laid around it by surface nets
(Gibson, "Constrained Elastic Surface Nets", 1998), and then moved onto it.
"""

from typing import NamedTuple

import numpy as np

POLISHING = 4  # number of steps by which places are moved onto the surface


class Cone(NamedTuple):
    """A thick line with round ends. start, end: places. first, last: radii at the ends. owner: what the surface around it belongs to."""

    start: tuple
    end: tuple
    first: float
    last: float
    owner: str


class SoftBody:
    """Cones, and how sharply they are told apart: they flow into each other within about 2 / sharpness, in m."""

    def __init__(self, cones, sharpness):
        self._cones, self._sharpness = list(cones), sharpness

    def surface(self, step):
        """Return (vertices, quads) of the surface. step: length of the quads' sides, m."""
        ends = np.array([place for cone in self._cones for place in (cone.start, cone.end)])
        margin = max(max(cone.first, cone.last) for cone in self._cones) + 3.0 * step
        axes = [np.arange(low - margin, high + margin, step) for low, high in zip(ends.min(axis=0), ends.max(axis=0))]
        grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
        values = self._distance(grid.reshape(-1, 3)).reshape(grid.shape[:3])
        vertices, quads = _nets(grid, values)
        return self.onto(vertices), quads

    def onto(self, places):
        """Return places (n, 3) near the surface, moved onto it."""
        places = np.asarray(places, dtype=float)
        for _ in range(POLISHING):
            distance, slope = self._field(places)
            places = places - (distance / (slope**2).sum(axis=1))[:, None] * slope
        return places

    def shares(self, places, sharpness):
        """Return {owner: share of each place, (n,)}; the shares of a place sum to 1. sharpness: how sharply owners are told apart, in 1/m."""
        found = {}
        for cone in self._cones:
            distance, _ = _to_cone(cone, places)
            found[cone.owner] = found.get(cone.owner, 0.0) + np.exp(-sharpness * distance)
        total = sum(found.values())
        return {owner: near / total for owner, near in found.items()}

    def _distance(self, places):
        """Return the smooth distance to all cones at places (n, 3)."""
        return self._smooth(sum(self._nearness(_to_cone(cone, places)[0]) for cone in self._cones))

    def _field(self, places):
        """Return the smooth distance to all cones at places (n, 3), and its gradient (n, 3)."""
        total, slope = np.zeros(len(places)), np.zeros((len(places), 3))
        for cone in self._cones:
            distance, away = _to_cone(cone, places)
            near = self._nearness(distance)
            total += near
            slope += (near / np.maximum(np.linalg.norm(away, axis=1), 1e-9))[:, None] * away
        return self._smooth(total), slope / total[:, None]

    def _nearness(self, distance):
        return np.exp(np.clip(-self._sharpness * distance, -300.0, 300.0))

    def _smooth(self, total):
        return -np.log(total) / self._sharpness


def _to_cone(cone, places):
    """Return the distance of places (n, 3) to the surface of a cone, and the way to them from the cone's axis (n, 3)."""
    start, axis = np.array(cone.start), np.subtract(cone.end, cone.start)
    away = places - start
    along = np.clip(away @ axis / max(axis @ axis, 1e-12), 0.0, 1.0)
    away -= along[:, None] * axis
    return np.sqrt(np.einsum("ij,ij->i", away, away)) - cone.first - along * (cone.last - cone.first), away


def _nets(grid, values):
    """Return (vertices, quads) around the places of a grid, (i, j, k, 3), at which the values, (i, j, k), are negative."""
    inside = values < 0.0
    cells = tuple(count - 1 for count in values.shape)
    sums, crossings = np.zeros((*cells, 3)), np.zeros(cells, int)
    quads = []
    for axis in range(3):
        first, last = _ends(values, axis)
        crossed = _ends(inside, axis)[0] != _ends(inside, axis)[1]
        share = first / np.where(crossed, first - last, 1.0)
        places = _ends(grid, axis)[0] + share[..., None] * (_ends(grid, axis)[1] - _ends(grid, axis)[0])
        second, third = (axis + 1) % 3, (axis + 2) % 3
        for u in (0, 1):
            for v in (0, 1):
                part = [slice(None)] * 3
                part[second], part[third] = slice(u, u + cells[second]), slice(v, v + cells[third])
                corner = tuple(part)
                crossings += crossed[corner]
                sums += np.where(crossed[corner][..., None], places[corner], 0.0)
        quads.append(_around(np.argwhere(crossed), axis, inside, cells))
    used = crossings > 0
    numbers = np.cumsum(used).reshape(cells) - 1
    corners = np.concatenate(quads)
    return sums[used] / crossings[used][:, None], numbers[corners[..., 0], corners[..., 1], corners[..., 2]]


def _ends(array, axis):
    """Return views of an array at both ends of each edge of the grid along an axis."""
    ahead, behind = [slice(None)] * 3, [slice(None)] * 3
    ahead[axis], behind[axis] = slice(1, None), slice(None, -1)
    return array[tuple(behind)], array[tuple(ahead)]


def _around(edges, axis, inside, cells):
    """Return the four cells, (n, 4, 3), around edges (n, 3) of the grid along an axis, so that the quad of them faces outwards."""
    second, third = (axis + 1) % 3, (axis + 2) % 3
    within = [(edges[:, other] > 0) & (edges[:, other] < cells[other]) for other in (second, third)]
    edges = edges[within[0] & within[1]]
    found = np.repeat(edges[:, None, :], 4, axis=1)
    found[:, (1, 2), second] -= 1
    found[:, (2, 3), third] -= 1
    begins_outside = ~inside[edges[:, 0], edges[:, 1], edges[:, 2]]
    found[begins_outside] = found[begins_outside][:, ::-1]
    return found
