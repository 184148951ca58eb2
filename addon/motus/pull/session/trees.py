"""A picking tree that follows the vertices it is over."""

import math
from typing import Any

from ...core import native
from ...core.lazy import numpy as np

MOST_PARTS = 256
"""Lists of moved vertices that are kept until the tree is asked; more than that cost more than a whole refit."""
LOOSE = 0.03
"""Of the mesh's size: while nothing has moved further since the last refit, a ray finds its way by the boxes as they are."""
ROUNDING = 1e-4
"""Of the largest coordinate: more than what rounding adds to the ways of MOST_PARTS dabs."""


class Tree:
    """A native Picker that is built when it is first asked, and refitted where vertices have moved since."""

    def __init__(self):
        self._picker = None
        self._moved: list[Any] | None = []
        self._drift = 0.0  # no vertex has moved further since the last refit

    @property
    def is_built(self):
        """Whether asking it costs no more than what has moved."""
        return self._picker is not None

    def moved(self, indices, at_most=math.inf):
        """These vertices are elsewhere now; None means any of them. at_most: how far they have moved."""
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
        """The Picker over these positions, which differ from those of the last call only as moved() told."""
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
        """What Picker.pick gives for these positions; for a few short ways the tree is not refitted.

        ray: origin, direction, metric, and which vertices are hidden.
        """
        if self._picker is not None and 0.0 < self._drift <= LOOSE * self._size:
            return self._picker.pick(*ray, positions, 1.001 * self._drift + ROUNDING * self._largest)
        return self.picker(positions, triangles, edges).pick(*ray)
