"""What a session has done, stroke by stroke: to step back, to do it again, and to keep the last stroke as a pin."""

from typing import Any, NamedTuple

from ...core.lazy import numpy as np


last_shapes: tuple[Any, ...] | None = None
"""Of the last session that pulled anything: (object's name, shape before its last stroke, shape after it)."""


class Done(NamedTuple):
    """One dab. displacement: of the root, in the object. radius: in the brush's unit. strength: of smoothing.

    A DRAG is all of its stroke: it pulls the shape that the stroke began with.
    """

    kind: str
    vertex: int
    displacement: tuple
    radius: float
    strength: float = 0.0
    is_first: bool = False


class Pulled(NamedTuple):
    """The last stroke that pulled. dab: its only one, dabs at the same root counting as one; else the last one.

    place: of the root before it. before: the shape (n, 3) before the stroke, which the session leaves as it is. is_alone:
    whether the dab has done all that the stroke did.
    """

    dab: Done
    brush: Any
    place: tuple
    before: Any
    is_alone: bool


class History:
    """Strokes, each with the shape before it."""

    def __init__(self):
        self.dabs = []
        self.last = None
        self._strokes = []
        self._open = None
        self._before = None

    @property
    def has_begun(self):
        """Whether there is a dab of the stroke that is going on."""
        return self._open is not None and len(self.dabs) > self._open[0]

    def begin_stroke(self, before, current, base):
        """A stroke begins with the shape `before`, which `current` equals and will leave. base: for pop_stroke()."""
        self._close(current)
        self._open = len(self.dabs), before, base

    def add(self, dab, brush, place, before):
        """A dab that has been done; see Pulled. before: the same array for all dabs that build on one another."""
        if dab.kind == 'DRAG' and self.has_begun:
            del self.dabs[-1]
        is_first = not self.has_begun
        self.dabs.append(dab._replace(is_first=is_first))
        builds_on = dab.kind == 'PULL' and brush.accumulate and before is self._before
        self._before = before
        last = self.last
        if dab.kind == 'SMOOTH':
            self.last = None
        elif builds_on and last and last.is_alone and _is_like(dab, brush, last):
            total = tuple(one + more for one, more in zip(last.dab.displacement, dab.displacement))
            self.last = last._replace(dab=last.dab._replace(displacement=total))
        else:
            self.last = Pulled(dab, brush, place, before, is_alone=not builds_on)

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


def _is_like(dab, brush, last):
    return last.brush == brush and (last.dab.vertex, last.dab.radius) == (dab.vertex, dab.radius)
