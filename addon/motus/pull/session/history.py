"""History of a session, stroke by stroke: for undo, for Redo, and for making the last stroke a pin."""

from typing import Any, NamedTuple

from ...core.lazy import numpy as np

last_shapes: tuple[Any, ...] | None = None
"""Last session that changed a mesh: (object's name, shape before the last stroke, shape after it); None without one."""


class Done(NamedTuple):
    """One dab. displacement: of the root, in the object. radius: in the brush's unit. strength: of smoothing.

    A dab of the kind DRAG makes up its whole stroke: it pulls the shape from the start of the stroke.
    """

    kind: str
    vertex: int
    displacement: tuple
    radius: float
    strength: float = 0.0
    is_first: bool = False


class Pulled(NamedTuple):
    """The last stroke that pulled.

    dab: its only dab, where several dabs at one root count as one; otherwise its last dab. place: of the root before the stroke. before:
    the
    shape (n, 3) before the stroke, which the session does not change. is_alone: whether the dab has made the whole stroke.
    """

    dab: Done
    brush: Any
    place: tuple
    before: Any
    is_alone: bool


class History:
    """Strokes of a session, each with the shape before it."""

    def __init__(self):
        self.dabs = []
        self.last = None
        self._strokes = []
        self._open = None
        self._before = None

    @property
    def has_begun(self):
        """Whether the present stroke has a dab."""
        return self._open is not None and len(self.dabs) > self._open[0]

    def begin_stroke(self, before, current, base):
        """Begin a stroke at the shape `before`, which equals `current`. base: shape that pop_stroke() returns."""
        self._close(current)
        self._open = len(self.dabs), before, base

    def add(self, dab, brush, place, before):
        """Add a dab that was made; Pulled explains the arguments. before: one array for all dabs that build on each other."""
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
        """Remove the last stroke that changed anything; returns (shape, base) before it, or None if there is no stroke."""
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
            # Only vertices that differ are stored, since a large mesh may have many strokes.
            indices = np.flatnonzero((before.view(np.uint32) != current.view(np.uint32)).any(axis=1))
            self._strokes.append((first, indices, before[indices], base))


def _is_like(dab, brush, last):
    return last.brush == brush and (last.dab.vertex, last.dab.radius) == (dab.vertex, dab.radius)
