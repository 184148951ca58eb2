"""A stroke that takes the root along with the mouse, as Blender's own transforms move what is selected."""

from mathutils import Vector

from ...core.interface.dragging.travel import Travel
from ..brush import AXIS_INDEX


class Dragging(Travel):
    """The root goes as the mouse does; axes and lengths are of the world or of the object, as the brush's unit says."""

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
        """The mouse is pressed, or has moved."""
        if self.hit is not None:
            self.follow(event)
            self._pull()

    def tick(self, _event):
        """The clock ticks, which means nothing to a drag."""

    def key(self, context, event):
        """A key is pressed: an axis, or a part of a number."""
        if self.hit is not None and self.take_key(context, event):
            self._pull()

    def is_cancelled_by(self, event):
        """Whether an event takes this drag back, and no other stroke of the session."""
        return event.value == 'PRESS' and event.type in {'ESC', 'RIGHTMOUSE'} - {self._button}

    def cancel(self):
        """The shape is what it was at the press."""
        if self.hit is not None:
            self._session.drag(self.hit.vertex, (0.0, 0.0, 0.0))

    def cursor(self, _session, _view, _place):
        """(what the cursor lies on, how far the root goes there)."""
        return self.hit, self.displacement

    def axis_line(self, length):
        """World ends of a line along the axis through where the root was; None without an axis."""
        if self.axis is None or self.hit is None:
            return None
        along = length * self.axis_vector().normalized()
        return self.point - along, self.point + along

    def end(self):
        """The stroke is over."""

    def axis_vector(self):
        """World vector along the axis; its length in the brush's unit is 1."""
        unit = Vector()
        unit[AXIS_INDEX[self.axis]] = 1.0  # type: ignore[index]
        return self._session.to_world_vector(unit)

    def length_of(self, way):
        """Length of a world vector in the brush's unit."""
        return self._session.length(way)

    def _pull(self):
        self._session.drag(self.hit.vertex, self.displacement)
