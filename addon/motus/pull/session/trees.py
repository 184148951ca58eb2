"""Search tree over the triangles and vertices of a mesh, kept up to date when vertices move."""

import math
from typing import Any

from ...core import native
from ...core.lazy import numpy as np

MOST_PARTS = 256
"""Largest number of lists of moved vertices that are collected; with more lists a refit of the whole tree is cheaper."""
LOOSE = 0.03
"""Share of the mesh's size: as long as no vertex has moved further since the last refit, rays use the old tree with enlarged boxes."""
ROUNDING = 1e-4
"""Share of the largest coordinate that exceeds the rounding errors of MOST_PARTS dabs."""


class Tree:
    """A native Picker (search tree) that is built at the first query, and refitted at vertices that have moved since."""

    def __init__(self):
        self._picker = None
        self._moved: list[Any] | None = []
        self._drift = 0.0  # no vertex has moved further than this since the last refit

    @property
    def is_built(self):
        """Whether the tree exists, so that a query needs at most a refit."""
        return self._picker is not None

    def moved(self, indices, at_most=math.inf):
        """Note that vertices have moved. indices: of the vertices; None for any vertices.

        at_most: largest distance that a vertex has moved.
        """
        if self._picker is None:
            return
        self._drift += at_most
        if indices is None or self._moved is None:
            self._moved = None
        elif len(indices):
            self._moved.append(indices)
            if len(self._moved) > MOST_PARTS:
                self._moved = None

    def picker(self, positions, triangles, edges):
        """Return the native Picker over these positions, built or refitted if necessary.

        moved() must have been called for all positions that differ from the previous call.
        """
        if self._picker is None:
            self._picker = native.module.Picker(positions, triangles, edges=edges)
            self._size = float(np.ptp(positions, axis=0).max(initial=0.0))
            self._largest = float(np.abs(positions).max(initial=0.0))
        elif self._moved is None:
            self._picker.refit(positions)
        elif self._moved:
            moved = self._moved[0] if len(self._moved) == 1 else np.unique(np.concatenate(self._moved))
            self._picker.refit(positions, moved)
        self._moved, self._drift = [], 0.0
        return self._picker

    def pick(self, positions, triangles, edges, *ray):
        """Result of the native Picker.pick() for these positions; after a few short moves the tree is not refitted.

        ray: origin, direction, metric (3x3 matrix that measures lengths), and which vertices are hidden.
        """
        if self._picker is not None and 0.0 < self._drift <= LOOSE * self._size:
            return self._picker.pick(*ray, positions, 1.001 * self._drift + ROUNDING * self._largest)
        return self.picker(positions, triangles, edges).pick(*ray)
