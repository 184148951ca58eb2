"""Displacement of a point that is dragged by the mouse: freely, along an axis, or of a typed length."""

import bpy
from mathutils import Vector

from .. import ui
from .number_entry import CONFIRMING, NumberEntry

AXES = {'X': 0, 'Y': 1, 'Z': 2}
FINE = 0.1
"""Share of the mouse's movement that counts while Shift is held, like in Blender's own transforms."""
STEEPEST = 1e-3
"""Squared sine of the angle between an axis and the line of sight, below which the mouse cannot choose places along the axis."""


class Travel:
    """Displacement of a dragged point: the point moves with the mouse on the plane through the point that faces the view.

    While Shift is held, the point moves a tenth as far. axis: name of the axis to which the movement is locked; None for free movement.
    displacement: of the point, in world space. A typed number sets the displacement's length. Axes and lengths are those of the world
    unless a subclass overrides axis_vector() and length_of().
    """

    def __init__(self, view):
        self.axis, self.displacement = None, Vector()
        self.entry = NumberEntry(takes_numpad=True)
        self.view = view
        self._way, self._number = Vector(), None

    def begin(self, event, point, offset=(0.0, 0.0)):
        """Start the drag of a world point. offset: from the mouse to where the point is on the screen, in pixels."""
        self.point, self._offset = point, offset
        self._mouse = self._pointed = Vector((event.mouse_x, event.mouse_y))
        # The offset between mouse and point is kept during the drag, so that the point does not jump.
        self._grabbed = self._under()

    def follow(self, event):
        """Handle a mouse move: update the displacement of the dragged point, unless the user is typing a number."""
        mouse = Vector((event.mouse_x, event.mouse_y))
        self._pointed = self._pointed + (mouse - self._mouse) * (FINE if event.shift else 1.0)
        self._mouse = mouse
        if not self.entry.is_open:
            self._way = self._under() - self._grabbed
            self.displacement = self._displacement()

    def take_key(self, context, event):
        """Handle a pressed key: an axis, or a character of a number. Returns whether the key has changed either of them."""
        if event.type in AXES:
            if event.is_repeat:
                return False
            self.axis = None if self.axis == event.type else event.type
        elif self.entry.key(event.type):
            number = self.entry.value
            self._number = None if number is None else number / context.scene.unit_settings.scale_length
        else:
            return False
        self.displacement = self._displacement()
        return True

    def is_confirmed_by(self, event):
        """Whether a key event ends the drag, as a release of the mouse button does."""
        return event.type in CONFIRMING and event.value == 'PRESS'

    def axis_vector(self):
        """World vector along the axis of the movement, with the length that the typed number 1 means."""
        found = Vector()
        found[AXES[self.axis]] = 1.0  # type: ignore[index]
        return found

    def length_of(self, way):
        """Length of a world vector as the number that a user would type for it, in Blender's units of the world."""
        return way.length

    def header(self, context, space="", length=ui.length):
        """Text for the viewport's header: length of the displacement, and its axis. space: name of the axis's space, may be "".

        length(context, value): function that writes a length as text.
        """
        label = bpy.app.translations.pgettext_iface
        typed = f"{self.entry.text}|" if self.entry.is_open else length(context, self.length_of(self.displacement))
        parts = [f"{label('Displacement')} {typed}"]
        if self.axis is not None:
            parts.append(f"{label('Axis')} {self.axis}" + (f" ({space})" if space else ""))
        return "    ".join(parts)

    def _under(self):
        """World point under the mouse on the plane through the dragged point that faces the view."""
        return self.view.place_at(self._pointed[0] + self._offset[0], self._pointed[1] + self._offset[1], self.point)

    def _displacement(self):
        number = self._number
        if self.axis is not None:
            axis = self.axis_vector()
            return axis * (self._share_of(axis) if number is None else number)
        if number is None:
            return self._way.copy()
        length = self.length_of(self._way)
        return self._way * (number / length) if length > 0.0 else Vector()

    def _share_of(self, axis):
        """Factor by which an axis vector is multiplied so that the point is as near to the cursor on the screen as possible."""
        length = axis.length
        along = axis / length
        sight = self.view.sight(self.point + self._way)
        slant = along.dot(sight)
        if 1.0 - slant * slant < STEEPEST:
            # The axis is along the line of sight: a drag upwards moves the point towards the viewer.
            share = self._way.dot(self.view.up()) * (-1.0 if slant > 0.0 else 1.0)
        else:
            share = (along.dot(self._way) - slant * sight.dot(self._way)) / (1.0 - slant * slant)
        return share / length
