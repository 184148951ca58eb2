"""Smoothing: moves vertices towards the mean of their neighbours, and vertices on a border of the mesh only along the border."""

from ...core.lazy import numpy as np


class Neighbourhood:
    """Finds the neighbours of vertices. edges: (e, 2) vertex indices. face_counts: number of faces at each edge; 1 on a border."""

    def __init__(self, edges, face_counts):
        self._edges = edges
        self._is_border = face_counts == 1
        self._has_border = bool(self._is_border.any())

    def middles(self, positions, indices):
        """Mean position of the neighbours of each of these vertices, (m, 3).

        A vertex without neighbours gives its own position. A vertex on a border only has neighbours along the border.
        """
        slots = np.full(len(positions), -1, np.int32)
        slots[indices] = np.arange(len(indices), dtype=np.int32)
        near = np.flatnonzero((slots[self._edges] >= 0).any(axis=1))
        ends, is_border = self._edges[near], self._is_border[near]
        here = np.concatenate((ends[:, 0], ends[:, 1]))
        there = np.concatenate((ends[:, 1], ends[:, 0]))
        owners = slots[here]
        keep = owners >= 0
        if self._has_border:
            on_border = np.zeros(len(indices), bool)
            along = np.concatenate((is_border, is_border))
            on_border[owners[keep & along]] = True
            keep &= along | ~on_border[owners]
        owners, there = owners[keep], there[keep]
        counts = np.bincount(owners, minlength=len(indices))
        sums = np.stack([np.bincount(owners, positions[there, axis], len(indices)) for axis in range(3)], axis=1)
        alone = counts == 0
        sums[alone] = positions[indices[alone]]
        return sums / np.maximum(counts, 1)[:, None]
