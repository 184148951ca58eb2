"""Distribution of dabs along the mouse's way, and pressure of the pen; independent of Blender's data."""

import math
from typing import Any

SPACING = 0.1
"""Distance between dabs, as a share of the radius."""
NEAREST = 2.0
"""Least distance between dabs, in pixels."""
MOST = 32
"""Most dabs for one movement of the mouse; on a longer way the dabs are further apart."""
RATE = 20.0
"""Dabs per second while the mouse is held still."""


def pressure(event):
    """Pressure of a pen, 0 to 1; 1 for a mouse."""
    return min(max(event.pressure, 0.0), 1.0) if event.is_tablet else 1.0


def shares(length, left, spacing):
    """Shares (0 to 1) of a way at which dabs are due, and the distance from its end to the next dab.

    length: of the way. left: distance from the start of the way to the next dab. spacing: distance between dabs, > 0.
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
    """Way of the mouse during one stroke, in pixels; heights of the pulled surface do not count.

    find(x, y): what lies under a place of the screen, or None. radius_of(found): radius there in pixels.
    """

    def __init__(self, find, radius_of):
        self._find, self._radius_of = find, radius_of
        self._place: Any = None
        self._found: Any = None
        self._left = 0.0
        self._is_idle = False

    @property
    def found(self):
        """What was under the mouse at its last movement."""
        return self._found

    def move(self, x, y):
        """Record the press of the mouse, or a movement of it; returns what was found at the places of dabs, in order."""
        found = self._find(x, y)
        if found is None or self._found is None:
            return self._cross_border(x, y, found)
        (x0, y0), (self._place, self._found) = self._place, ((x, y), found)
        due, self._left = shares(math.hypot(x - x0, y - y0), self._left, self._spacing(found))
        self._is_idle = self._is_idle and not due
        between = (found if share >= 1.0 else self._find(x0 + share * (x - x0), y0 + share * (y - y0)) for share in due)
        return [one for one in between if one is not None]

    def wait(self):
        """Record a timer event; returns what lies under the mouse, if no dab was made since the last event."""
        was_idle, self._is_idle = self._is_idle, True
        return [self._found] if was_idle and self._found is not None else []

    def _cross_border(self, x, y, found):
        """Handle a mouse that has entered the surface, has left it, or stays beside it."""
        self._place, self._found = (x, y), found
        if found is None:
            return []
        self._left, self._is_idle = self._spacing(found), False
        return [found]

    def _spacing(self, found):
        return max(SPACING * self._radius_of(found), NEAREST)
