"""The way of a point that goes along with the mouse: freely, along an axis, or as far as a typed number says."""

import bpy
from mathutils import Vector

from .. import ui
from .number_entry import CONFIRMING, NumberEntry

AXES = {'X': 0, 'Y': 1, 'Z': 2}
FINE = 0.1
"""Of the mouse's way counts while Shift is held, as in Blender's own transforms."""
STEEPEST = 1e-3
"""Square of the sine between an axis and the line of sight, below which the mouse cannot point at places along the axis."""


class Travel:
    """The point goes as the mouse does, on the plane through it that faces the view; a tenth as far while Shift is held.

    axis: name of the one that it is held to; None for none. displacement: of the point, in the world. The number that is typed is
    its length. Of the world, where axis_vector() and length_of() do not say otherwise.
    """

    def __init__(self, view):
        self.axis, self.displacement = None, Vector()
        self.entry = NumberEntry(takes_numpad=True)
        self.view = view
        self._way, self._number = Vector(), None

    def begin(self, event, point, offset=(0.0, 0.0)):
        """The mouse takes hold of a point of the world. offset: from the mouse to where the point is seen, pixels."""
        self.point, self._offset = point, offset
        self._mouse = self._pointed = Vector((event.mouse_x, event.mouse_y))
        # The mouse keeps its distance from the point, so that nothing leaps.
        self._grabbed = self._under()

    def follow(self, event):
        """Update the displacement of the dragged point after a mouse move; a number that is being typed keeps it fixed."""
        mouse = Vector((event.mouse_x, event.mouse_y))
        self._pointed = self._pointed + (mouse - self._mouse) * (FINE if event.shift else 1.0)
        self._mouse = mouse
        if not self.entry.is_open:
            self._way = self._under() - self._grabbed
            self.displacement = self._displacement()

    def take_key(self, context, event):
        """A key is pressed: an axis, or a part of a number. Gives whether the point goes elsewhere now."""
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
        """Whether an event ends the drag, apart from the button."""
        return event.type in CONFIRMING and event.value == 'PRESS'

    def axis_vector(self):
        """World vector along the axis, as long as the number 1 says."""
        found = Vector()
        found[AXES[self.axis]] = 1.0  # type: ignore[index]
        return found

    def length_of(self, way):
        """Length of a world vector, as numbers say it."""
        return way.length

    def header(self, context, space="", length=ui.length):
        """The line in the viewport's header: how far the point goes, and along which axis. space: of the axes, as text."""
        label = bpy.app.translations.pgettext_iface
        typed = f"{self.entry.text}|" if self.entry.is_open else length(context, self.length_of(self.displacement))
        parts = [f"{label('Displacement')} {typed}"]
        if self.axis is not None:
            parts.append(f"{label('Axis')} {self.axis}" + (f" ({space})" if space else ""))
        return "    ".join(parts)

    def _under(self):
        """The point of the plane that the mouse points at."""
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
        """How many times an axis the point goes, so that on the screen it is as near to the cursor as can be."""
        length = axis.length
        along = axis / length
        sight = self.view.sight(self.point + self._way)
        slant = along.dot(sight)
        if 1.0 - slant * slant < STEEPEST:
            # Towards the viewer by a drag upwards.
            share = self._way.dot(self.view.up()) * (-1.0 if slant > 0.0 else 1.0)
        else:
            share = (along.dot(self._way) - slant * sight.dot(self._way)) / (1.0 - slant * slant)
        return share / length
