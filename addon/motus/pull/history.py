"""What a session has done, stroke by stroke: to step back, to do it again, and to keep the last pull as a pin."""

from typing import Any, NamedTuple

from ..core.lazy import numpy as np


last_shapes = None
"""Of the last session that pulled anything: (object's name, shape before its last pull, shape after it)."""


class Done(NamedTuple):
    """One dab. displacement: of the root, in the object. radius: in the brush's unit. strength: of smoothing."""

    kind: str
    vertex: int
    displacement: tuple
    radius: float
    strength: float = 0.0
    is_first: bool = False


class Pulled(NamedTuple):
    """The last pull: dabs one after another at the same root count as one. place: of the root before it.

    moved, before: vertices that it may have moved, and where they were; all of them where moved is None. The session that
    pulled may use `before` for other things once it pulls again.
    """

    dab: Done
    brush: Any
    place: tuple
    moved: Any
    before: Any

    def shape_before(self, after):
        """The shape (n, 3) before the pull that made `after`."""
        if self.moved is None:
            return self.before.copy()
        shape = after.copy()
        shape[self.moved] = self.before
        return shape


class History:
    """Strokes, each with the shape before it."""

    def __init__(self):
        self.dabs = []
        self.last = None
        self._strokes = []
        self._open = None

    def begin_stroke(self, before, current, base):
        """A stroke begins with the shape `before`, which `current` equals and will leave. base: for pop_stroke()."""
        self._close(current)
        self._open = len(self.dabs), before, base

    def add(self, dab, brush, place, moved, before):
        """A dab that has been done; see Pulled."""
        is_first = self._open is None or len(self.dabs) == self._open[0]
        self.dabs.append(dab._replace(is_first=is_first))
        last = self.last
        if dab.kind != 'PULL':
            self.last = None
        elif last and _continues(dab, brush, last):
            total = tuple(one + more for one, more in zip(last.dab.displacement, dab.displacement))
            self.last = last._replace(dab=last.dab._replace(displacement=total))
        else:
            self.last = Pulled(dab, brush, place, moved, before)

    def pop_stroke(self, current):
        """(shape, base) before the last stroke that did anything, which is forgotten; None where there is none."""
        self._close(current)
        if not self._strokes:
            return None
        first, indices, places, base = self._strokes.pop()
        del self.dabs[first:]
        self.last = None
        shape = current.copy()
        shape[indices] = places
        return shape, base

    def _close(self, current):
        if self._open is None:
            return
        first, before, base = self._open
        self._open = None
        if len(self.dabs) > first:
            # Only what differs, as there may be many strokes on a large mesh.
            indices = np.flatnonzero((before.view(np.uint32) != current.view(np.uint32)).any(axis=1))
            self._strokes.append((first, indices, before[indices], base))


def _continues(dab, brush, last):
    return brush.accumulate and last.brush == brush and (last.dab.vertex, last.dab.radius) == (dab.vertex, dab.radius)
