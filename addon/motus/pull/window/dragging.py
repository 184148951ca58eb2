"""A stroke that drags one vertex with the mouse, as Blender's transform operators move the selection."""

from mathutils import Vector

from ...core.interface.dragging.travel import Travel
from ..brush import AXIS_INDEX


class Dragging(Travel):
    """A drag of the picked vertex (the root) with the mouse.

    Axes and lengths are measured in the world or in the object, as the brush's unit says.
    """

    def __init__(self, session, view, event):
        super().__init__(view)
        self._session, self._button = session, event.type
        session.begin_stroke(is_drag=True)
        self.hit = session.pick(*view.ray(event.mouse_x, event.mouse_y))
        if self.hit is None:
            return
        root = session.seen_place(self.hit.vertex)
        self.hit = self.hit._replace(point=root)
        self.begin(event, root)

    def move(self, event):
        """Pull the vertex along at the press of the mouse button or a movement of the mouse."""
        if self.hit is not None:
            self.follow(event)
            self._pull()

    def tick(self, _event):
        """Ignore a timer event: a drag has no timer."""

    def key(self, context, event):
        """Handle a key that chooses an axis or types a part of the length."""
        if self.hit is not None and self.take_key(context, event):
            self._pull()

    def is_cancelled_by(self, event):
        """Whether an event undoes this drag alone, without the session's earlier strokes."""
        return event.value == 'PRESS' and event.type in {'ESC', 'RIGHTMOUSE'} - {self._button}

    def cancel(self):
        """Restore the shape that the mesh had before the drag."""
        if self.hit is not None:
            self._session.drag(self.hit.vertex, (0.0, 0.0, 0.0))

    def cursor(self, _session, _view, _place):
        """Return (dab.Hit of the dragged vertex or None, displacement of the vertex) for drawing the cursor."""
        return self.hit, self.displacement

    def axis_line(self, length):
        """World positions of the ends of a line along the chosen axis, through the start of the dragged vertex.

        length: half the length of the line. None if no axis is chosen.
        """
        if self.axis is None or self.hit is None:
            return None
        along = length * self.axis_vector().normalized()
        return self.point - along, self.point + along

    def end(self):
        """End the drag; nothing is left to do."""

    def axis_vector(self):
        """World vector along the chosen axis, whose length is 1 in the brush's unit."""
        unit = Vector()
        unit[AXIS_INDEX[self.axis]] = 1.0  # type: ignore[index]
        return self._session.to_world_vector(unit)

    def length_of(self, way):
        """Length of a world vector, measured in the brush's unit."""
        return self._session.length(way)

    def _pull(self):
        self._session.drag(self.hit.vertex, self.displacement)
