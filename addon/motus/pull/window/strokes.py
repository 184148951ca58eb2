"""Where along the mouse's way the dabs of a stroke fall, and how strong a pen makes them. Without Blender's data."""

import math
from typing import Any

SPACING = 0.1
"""Of the radius: from one dab to the next."""
NEAREST = 2.0
"""Pixels from one dab to the next, at least."""
MOST = 32
"""Dabs for one movement of the mouse; a longer way has them further apart."""
RATE = 20.0
"""Dabs a second while the mouse is held still."""


def pressure(event):
    """How hard a pen is pressed, 0 to 1; 1 for a mouse, which has no pressure."""
    return min(max(event.pressure, 0.0), 1.0) if event.is_tablet else 1.0


def shares(length, left, spacing):
    """Shares, 0 to 1, of a way of some length at which dabs are due, and how far it is to the next one from its end.

    left: how far it was to the next dab when the way began. spacing: > 0.
    """
    if length <= 0.0 or length < left:
        return [], left - length
    count = math.floor((length - left) / spacing) + 1
    if count > MOST:
        return [(index + 1) / MOST for index in range(MOST)], spacing
    places = [left + index * spacing for index in range(count)]
    # Rounding must not lead past the end.
    return [min(place / length, 1.0) for place in places], spacing - (length - places[-1])


class Way:
    """The mouse's way during one stroke, in pixels: the height of what is pulled up is no way.

    find(x, y): what lies under a place of the screen, or None. radius_of(found): the radius there, pixels.
    """

    def __init__(self, find, radius_of):
        self._find, self._radius_of = find, radius_of
        self._place: Any = None
        self._found: Any = None
        self._left = 0.0
        self._is_idle = False

    @property
    def found(self):
        """What was under the mouse when it moved last."""
        return self._found

    def move(self, x, y):
        """The mouse is pressed, or has moved, to there; gives what dabs are done at, in order."""
        found = self._find(x, y)
        if found is None or self._found is None:
            return self._cross_border(x, y, found)
        (x0, y0), (self._place, self._found) = self._place, ((x, y), found)
        due, self._left = shares(math.hypot(x - x0, y - y0), self._left, self._spacing(found))
        self._is_idle = self._is_idle and not due
        between = (found if share >= 1.0 else self._find(x0 + share * (x - x0), y0 + share * (y - y0)) for share in due)
        return [one for one in between if one is not None]

    def wait(self):
        """A tick of the clock; gives what is done at where there was no dab since the last one."""
        was_idle, self._is_idle = self._is_idle, True
        return [self._found] if was_idle and self._found is not None else []

    def _cross_border(self, x, y, found):
        """The mouse has come onto the surface, or left it, or is still beside it."""
        self._place, self._found = (x, y), found
        if found is None:
            return []
        self._left, self._is_idle = self._spacing(found), False
        return [found]

    def _spacing(self, found):
        return max(SPACING * self._radius_of(found), NEAREST)
