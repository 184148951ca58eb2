"""Radius or strength by the mouse, as the F key does for Blender's brushes: drag or type, click to keep it."""

from ...core.interface.dragging.number_entry import CONFIRMING, NumberEntry
from . import status

MOVES = {'MOUSEMOVE', 'INBETWEEN_MOUSEMOVE'}
FINE = 0.1
STRENGTH_SHARE = 0.25
"""Of the mouse's way: so far a dab then moves the root."""
EDGE_PIXELS = 20.0
"""Mouse's way for one edge more."""
LEAST = 1e-4
NOTCH = 1.1
"""Factor for one step of a bracket key."""
MOST_NOTCHES = 2000
"""So many take the least number to the largest."""


def notched(brush, name, notches):
    """The number after so many steps of a bracket key, downward for less than 0."""
    now = getattr(brush, name)
    if name == status.RADIUS and brush.distance == 'EDGES':
        return max(round(now) + notches, 1.0)
    factor = NOTCH ** min(abs(notches), MOST_NOTCHES)
    return now * factor if notches > 0 else now / factor


def typed(context, brush, name, number):
    """A typed number, which is in the scene's unit, as the brush has it."""
    if name == status.RADIUS and brush.distance == 'EDGES':
        return max(round(number), 1.0)
    number /= context.scene.unit_settings.scale_length
    return max(number, LEAST) if name == status.RADIUS else number


class Adjustment:
    """A drag of the mouse that changes one number.

    pixels: how many a length of 1 is where the brush lies. hit: where it lies, or None.
    """

    def __init__(self, name, brush, x, pixels, view, hit):
        self.name, self.view, self.hit = name, view, hit
        self.entry = NumberEntry(takes_numpad=True)
        self.before = getattr(brush, name)
        self._counts_edges = name == status.RADIUS and brush.distance == 'EDGES'
        self._value, self._x = self.before, x
        self._pixels = max(pixels, 1e-6)

    def drag(self, x, is_fine):
        """The mouse has moved; gives the number."""
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
        """What an event means: ('SET', number), ('KEEP', None), ('CANCEL', number before), or (None, None)."""
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
