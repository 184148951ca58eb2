"""Welding: vertices within a distance of each other move as one, such as the corners of a scan's loose triangles."""

from ...core import native
from ...core.lazy import numpy as np


class Welding:
    """Groups of vertices that move as one. The leader of a group is its vertex of the lowest index.

    leaders: leader of each vertex, int32 (n,); a vertex that is not welded leads itself. count: number of vertices that follow another.
    """

    def __init__(self, positions, distance, metric):
        """Group the vertices at positions (n, 3).

        distance: largest distance of a vertex from its leader. metric: 3x3 matrix that measures lengths.
        """
        self.leaders = native.module.weld(positions, distance, metric)
        self.count = int(np.count_nonzero(self.leaders != np.arange(len(self.leaders))))
        self._sizes = np.bincount(self.leaders, minlength=len(self.leaders))
        self._members = np.argsort(self.leaders, kind="stable").astype(np.int32)
        self._firsts = np.cumsum(self._sizes) - self._sizes

    def spread(self, indices, distances):
        """Return (indices, distances) of all vertices that move along with the leaders among some vertices, which decide alone.

        indices: of the vertices, rising. distances: of each.
        """
        is_leader = self.leaders[indices] == indices
        leaders, distances = indices[is_leader], distances[is_leader]
        sizes = self._sizes[leaders]
        within = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        found = self._members[np.repeat(self._firsts[leaders], sizes) + within]
        order = np.argsort(found)
        return found[order], np.repeat(distances, sizes)[order]

    def least(self, weights, vertices):
        """Return weights (m,) with which groups stay together: each vertex has the least weight of its group. weights: of `vertices`."""
        groups = self.leaders[vertices]
        order = np.argsort(groups, kind="stable")
        firsts = np.flatnonzero(np.diff(groups[order], prepend=-1))
        found = np.empty_like(weights)
        found[order] = np.repeat(np.minimum.reduceat(weights[order], firsts), np.diff(firsts, append=len(order)))
        return found

    def edges(self, edges, face_counts):
        """Return (edges (e, 2), number of faces at each) of the welded mesh. edges, face_counts: of the mesh itself."""
        ends = np.sort(self.leaders[edges], axis=1)
        is_long = ends[:, 0] != ends[:, 1]
        found, place = np.unique(ends[is_long], axis=0, return_inverse=True)
        return found, np.bincount(place.ravel(), face_counts[is_long], len(found)).astype(int)


def weld(positions, distance, metric):
    """Return the Welding of vertices at positions (n, 3); None if the distance is 0, which welds nothing."""
    return Welding(positions, distance, metric) if distance > 0.0 else None


def leaders_of(welding, vertices):
    """Return the leader of each vertex of an array, or of one index; without a Welding (None) the vertices themselves."""
    return vertices if welding is None else welding.leaders[vertices]


def reach(picker, positions, welding, vertex, bits, radius, distance, metric):
    """Return (indices, distances) of the vertices that a pull at a vertex reaches.

    picker: native Picker whose triangles join leaders_of() their corners. positions: those of the picker. bits: axes that are reversed for
    a mirror image of the pull, 0 for the pull itself. distance: as the Picker names it. metric: 3x3 matrix that measures lengths.
    """
    signs = np.array([-1.0 if bits >> axis & 1 else 1.0 for axis in range(3)])
    root = int(leaders_of(welding, vertex))
    if bits:
        root = positions[root] * signs
        if distance != "straight":
            root = int(leaders_of(welding, picker.nearest(root)))
    # Reversing the metric too makes mirror images alike in a sheared object.
    found = picker.reach(root, radius, distance, metric * signs)
    return found if welding is None else welding.spread(*found)
