"""Distribution of dabs along the path of the mouse, and pressure of the pen; this module uses no data of Blender."""

import math
from typing import Any

SPACING = 0.1
"""Distance between dabs, as a share of the brush's radius."""
NEAREST = 2.0
"""Least distance between dabs, in pixels."""
MOST = 32
"""Largest number of dabs for one movement of the mouse; on a longer path the dabs are further apart."""
RATE = 20.0
"""Dabs per second while the mouse rests with its button held."""


def pressure(event):
    """Pressure of the pen at an event, 0 to 1; 1.0 for a mouse."""
    return min(max(event.pressure, 0.0), 1.0) if event.is_tablet else 1.0


def shares(length, left, spacing):
    """Distribute dabs along one movement of the mouse: (shares (0 to 1) of the path with a dab, distance to the next dab).

    length: of the path. left: distance from the start of the path to the next dab. spacing: distance between dabs, > 0. The returned
    distance counts from the end of the path.
    """
    if length <= 0.0 or length < left:
        return [], left - length
    count = math.floor((length - left) / spacing) + 1
    if count > MOST:
        return [(index + 1) / MOST for index in range(MOST)], spacing
    places = [left + index * spacing for index in range(count)]
    # Rounding must not give a share above 1.
    return [min(place / length, 1.0) for place in places], spacing - (length - places[-1])


class Way:
    """Path of the mouse during one stroke, in pixels of the screen; the depth of the surface does not count.

    find(x, y): function that returns what lies under a position on the screen, or None. radius_of(found): function that returns the brush's
    radius there, in pixels.
    """

    def __init__(self, find, radius_of):
        self._find, self._radius_of = find, radius_of
        self._place: Any = None
        self._found: Any = None
        self._left = 0.0
        self._is_idle = False

    @property
    def found(self):
        """What was under the mouse at its last movement; None if nothing was."""
        return self._found

    def move(self, x, y):
        """Continue the path to (x, y), at the press of the button or a movement of the mouse.

        Returns what find() has found at the positions of the dabs that are due, in order.
        """
        found = self._find(x, y)
        if found is None or self._found is None:
            return self._cross_border(x, y, found)
        (x0, y0), (self._place, self._found) = self._place, ((x, y), found)
        due, self._left = shares(math.hypot(x - x0, y - y0), self._left, self._spacing(found))
        self._is_idle = self._is_idle and not due
        between = (found if share >= 1.0 else self._find(x0 + share * (x - x0), y0 + share * (y - y0)) for share in due)
        return [one for one in between if one is not None]

    def wait(self):
        """Note a timer event; returns [what lies under the mouse] if no dab was made since the last timer event, otherwise []."""
        was_idle, self._is_idle = self._is_idle, True
        return [self._found] if was_idle and self._found is not None else []

    def _cross_border(self, x, y, found):
        """Handle a mouse that has come onto the surface, has left it, or stays beside it; returns what is found for a dab."""
        self._place, self._found = (x, y), found
        if found is None:
            return []
        self._left, self._is_idle = self._spacing(found), False
        return [found]

    def _spacing(self, found):
        return max(SPACING * self._radius_of(found), NEAREST)
