"""A stroke that takes the root along with the mouse, as Blender's own transforms move what is selected."""

from mathutils import Vector

from ..brush import AXIS_INDEX
from . import status
from .adjusting import typed
from .entry import CONFIRMING, NumberEntry

STEEPEST = 1e-3
"""Square of the sine between an axis and the line of sight, below which the mouse cannot point at places along the axis."""


class Dragging:
    """The root goes as the mouse does, on the plane through the root that faces the view.

    axis: name of the one that the root is held to, of the world or of the object as the brush's unit says; None for none.
    displacement: of the root, in the world. The number that is typed is its length.
    """

    def __init__(self, session, view, event):
        self.axis, self.displacement = None, Vector()
        self.entry = NumberEntry(takes_numpad=True)
        self._session, self._view, self._button = session, view, event.type
        self._way, self._number = Vector(), None
        session.begin_stroke(is_drag=True)
        self.hit = session.pick(*view.ray(event.mouse_x, event.mouse_y))
        if self.hit is None:
            return
        self._root = session.seen_place(self.hit.vertex)
        self.hit = self.hit._replace(point=self._root)
        # The cursor keeps its distance from the root, so that nothing leaps.
        self._grabbed = self._under(event)

    def move(self, event):
        """The mouse is pressed, or has moved."""
        if self.hit is not None and not self.entry.is_open:
            self._way = self._under(event) - self._grabbed
            self._follow()

    def tick(self, _event):
        """The clock ticks, which means nothing to a drag."""

    def key(self, context, event):
        """A key is pressed: an axis, or a part of a number."""
        if self.hit is None:
            return
        if event.type in AXIS_INDEX:
            if not event.is_repeat:
                self.axis = None if self.axis == event.type else event.type
                self._follow()
        elif self.entry.key(event.type):
            number = self.entry.value
            self._number = None if number is None else typed(context, self._session.brush, status.STRENGTH, number)
            self._follow()

    def is_confirmed_by(self, event):
        """Whether an event ends the drag, apart from the button."""
        return event.type in CONFIRMING and event.value == 'PRESS'

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
        along = length * self._axis_vector().normalized()
        return self._root - along, self._root + along

    def end(self):
        """The stroke is over."""

    def _under(self, event):
        """What of the plane lies under the mouse."""
        return self._view.place_at(event.mouse_x, event.mouse_y, self._root)

    def _follow(self):
        self.displacement = self._displacement()
        self._session.drag(self.hit.vertex, self.displacement)

    def _displacement(self):
        number = self._number
        if self.axis is not None:
            axis = self._axis_vector()
            return axis * (self._share_of(axis) if number is None else number)
        if number is None:
            return self._way.copy()
        length = self._session.length(self._way)
        return self._way * (number / length) if length > 0.0 else Vector()

    def _axis_vector(self):
        """World vector along the axis; its length in the brush's unit is 1."""
        unit = Vector()
        unit[AXIS_INDEX[self.axis]] = 1.0
        return self._session.to_world_vector(unit)

    def _share_of(self, axis):
        """How many times an axis the root goes, so that on the screen it is as near to the cursor as can be."""
        length = axis.length
        along = axis / length
        sight = self._view.sight(self._root + self._way)
        slant = along.dot(sight)
        if 1.0 - slant * slant < STEEPEST:
            # Towards the viewer by a drag upwards.
            share = self._way.dot(self._view.up()) * (-1.0 if slant > 0.0 else 1.0)
        else:
            share = (along.dot(self._way) - slant * sight.dot(self._way)) / (1.0 - slant * slant)
        return share / length
