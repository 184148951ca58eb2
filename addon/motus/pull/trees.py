"""A picking tree that follows the vertices it is over."""

from ..core import native
from ..core.lazy import numpy as np


MOST_PARTS = 256
"""Lists of moved vertices that are kept until the tree is asked; more than that cost more than a whole refit."""


class Tree:
    """A native Picker that is built when it is first asked, and refitted where vertices have moved since."""

    def __init__(self):
        self._picker = None
        self._moved = []

    @property
    def is_built(self):
        """Whether asking it costs no more than what has moved."""
        return self._picker is not None

    def moved(self, indices):
        """These vertices are elsewhere now; None means any of them."""
        if self._picker is None:
            return
        if indices is None or self._moved is None:
            self._moved = None
        else:
            self._moved.append(indices)
            if len(self._moved) > MOST_PARTS:
                self._moved = None

    def picker(self, positions, triangles, edges):
        """The Picker over these positions, which differ from those of the last call only as moved() told."""
        if self._picker is None:
            self._picker = native.module.Picker(positions, triangles, edges=edges)
        elif self._moved is None:
            self._picker.refit(positions)
        elif self._moved:
            moved = self._moved[0] if len(self._moved) == 1 else np.unique(np.concatenate(self._moved))
            self._picker.refit(positions, moved)
        self._moved = []
        return self._picker
