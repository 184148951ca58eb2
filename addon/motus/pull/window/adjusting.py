"""Change the brush's radius or strength by dragging the mouse or typing a number; a click confirms."""

from ...core.interface.dragging.number_entry import CONFIRMING, NumberEntry
from . import status

MOVES = {'MOUSEMOVE', 'INBETWEEN_MOUSEMOVE'}
FINE = 0.1
STRENGTH_SHARE = 0.25
"""Ratio of the change of the strength to the distance that the mouse travels, both in the world."""
EDGE_PIXELS = 20.0
"""Distance that the mouse travels, in pixels, to change a radius in edges by 1."""
LEAST = 1e-4
NOTCH = 1.1
"""Factor on the radius or strength for one press of a bracket key."""
MOST_NOTCHES = 2000
"""Largest number of presses of a bracket key in one call, enough to go from the least value to the largest."""


def notched(brush, name, notches):
    """New value of the brush's radius or strength after presses of a bracket key.

    name: of the property. notches: number of presses; negative numbers make the value smaller.
    """
    now = getattr(brush, name)
    if name == status.RADIUS and brush.distance == 'EDGES':
        return max(round(now) + notches, 1.0)
    factor = NOTCH ** min(abs(notches), MOST_NOTCHES)
    return now * factor if notches > 0 else now / factor


def typed(context, brush, name, number):
    """Convert a number that the user has typed for the radius or strength from the scene's unit to the brush's unit."""
    if name == status.RADIUS and brush.distance == 'EDGES':
        return max(round(number), 1.0)
    number /= context.scene.unit_settings.scale_length
    return max(number, LEAST) if name == status.RADIUS else number


class Adjustment:
    """Change of the brush's radius or strength by a drag of the mouse.

    pixels: number of pixels for a length of 1 at the brush. hit: dab.Hit under the brush, or None.
    """

    def __init__(self, name, brush, x, pixels, view, hit):
        self.name, self.view, self.hit = name, view, hit
        self.entry = NumberEntry(takes_numpad=True)
        self.before = getattr(brush, name)
        self._counts_edges = name == status.RADIUS and brush.distance == 'EDGES'
        self._value, self._x = self.before, x
        self._pixels = max(pixels, 1e-6)

    def drag(self, x, is_fine):
        """Return the new radius or strength after the mouse has moved to x, in pixels. is_fine: change the value more slowly."""
        way = (x - self._x) * (FINE if is_fine else 1.0)
        self._x = x
        if self._counts_edges:
            self._value = max(self._value + way / EDGE_PIXELS, 1.0)
            return round(self._value)
        if self.name == status.STRENGTH:
            self._value += STRENGTH_SHARE * way / self._pixels
        else:
            self._value = max(self._value + way / self._pixels, LEAST)
        return self._value

    def handle(self, context, brush, event):
        """Interpret an event while the radius or strength is being changed.

        Returns ('SET', number), ('KEEP', None) to end, ('CANCEL', number before the change), or (None, None) if the event means nothing.
        """
        if event.type in MOVES and not self.entry.is_open:
            return 'SET', self.drag(event.mouse_x, event.shift)
        if event.value != 'PRESS':
            return None, None
        if event.type == 'LEFTMOUSE' or event.type in CONFIRMING:
            return 'KEEP', None
        if event.type in {'ESC', 'RIGHTMOUSE'}:
            return 'CANCEL', self.before
        if self.entry.key(event.type) and self.entry.value is not None:
            return 'SET', typed(context, brush, self.name, self.entry.value)
        return None, None
