"""History of a session of pulls, stroke by stroke: for undo, for Redo, and for making a pin from the last stroke."""

from typing import Any, NamedTuple

from ...core.lazy import numpy as np

last_shapes: tuple[Any, ...] | None = None
"""(Object's name, shape before the last stroke, shape after it) of the last session that has changed a mesh.

None if no session has changed a mesh.
"""


class Done(NamedTuple):
    """One dab of the brush.

    kind: 'PULL', 'SMOOTH' or 'DRAG'. vertex: index of the pulled vertex (the root). displacement: of that vertex, in the object's space.
    radius: in the brush's unit. strength: of smoothing. is_first: whether the dab begins a stroke.
    A DRAG is the only dab of its stroke, and pulls the shape that the stroke started from.
    """

    kind: str
    vertex: int
    displacement: tuple
    radius: float
    strength: float = 0.0
    is_first: bool = False


class Pulled(NamedTuple):
    """The last stroke of pulls.

    dab: the only dab of the stroke, in which several dabs at one vertex are added up; otherwise the last dab. brush: the Brush. place:
    position of the pulled vertex before the stroke. before: shape (n, 3) before the stroke, which the session does not change. is_alone:
    whether `dab` makes up the whole stroke.
    """

    dab: Done
    brush: Any
    place: tuple
    before: Any
    is_alone: bool


class History:
    """Strokes of a session of pulls, each with what is needed to undo it."""

    def __init__(self):
        self.dabs = []
        self.last = None
        self._strokes = []
        self._open = None
        self._before = None

    @property
    def has_begun(self):
        """Whether the present stroke contains a dab."""
        return self._open is not None and len(self.dabs) > self._open[0]

    def begin_stroke(self, before, current, base):
        """Begin a stroke.

        before: shape at the start of the stroke, equal to `current`. base: shape that pop_stroke() will return with it.
        """
        self._close(current)
        self._open = len(self.dabs), before, base

    def add(self, dab, brush, place, before):
        """Add a dab to the present stroke; a DRAG replaces the previous dab of the stroke.

        brush, place, before: see Pulled. `before` must be one array for all dabs that build on each other.
        """
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
        """Remove the last stroke that has a dab; returns the (shape, base) from before the stroke.

        current: the present shape. Returns None if there is no stroke.
        """
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
