"""A stroke of dabs along the mouse's way, and by a timer while the mouse rests."""

import time

from . import strokes

SMOOTHING = 0.5
"""Share of the way to the mean of the neighbours that one dab of smoothing moves a vertex."""


class Dabbing:
    """A stroke of dabs. sign: -1 pulls down. is_smooth: the dabs smooth instead of pulling."""

    def __init__(self, context, session, view, sign, is_smooth):
        self.hit = None
        self._session, self._view = session, view
        self._sign, self._is_smooth = sign, is_smooth
        session.begin_stroke()
        self._way = strokes.Way(lambda x, y: session.pick(*view.ray(x, y)), self._pixels)
        self._manager = context.window_manager
        self._timer = self._manager.event_timer_add(1.0 / strokes.RATE, window=context.window)
        self._ticked = time.monotonic()

    def move(self, event):
        """Handle the press of the mouse, or a movement of it."""
        found = self._way.move(event.mouse_x, event.mouse_y)
        self.hit = self._way.found
        # Without `accumulate` only the last place counts: the shape follows the mouse even on ways shorter than the spacing.
        if not self._session.brush.accumulate and not self._is_smooth:
            found = [self.hit] if self.hit else []
        self._dabs(found, event)

    def tick(self, event):
        """Handle a timer event."""
        now = time.monotonic()
        if now - self._ticked < 0.8 / strokes.RATE:
            return  # the timer of another operator
        self._ticked = now
        if self._session.brush.accumulate or self._is_smooth:
            self._dabs(self._way.wait(), event)

    def key(self, _context, _event):
        """Ignore a key: dabs have no keys."""

    def is_confirmed_by(self, _event):
        """Whether an event other than the button's release ends the stroke."""
        return False

    def is_cancelled_by(self, _event):
        """Whether an event takes this stroke back, but not earlier ones of the session."""
        return False

    def cursor(self, session, view, place):
        """(what the cursor lies on, displacement of the root there, or None for the brush's own)."""
        return session.pick(*view.ray(*place)), None

    def end(self):
        """End the stroke."""
        self._manager.event_timer_remove(self._timer)

    def _dabs(self, found, event):
        if not found:
            return
        pressure = strokes.pressure(event)
        try:
            for hit in found:
                self._dab(hit, pressure, write=hit is found[-1])
        finally:
            self._session.flush()

    def _dab(self, hit, pressure, write):
        if self._is_smooth:
            self._session.smooth(hit.vertex, SMOOTHING, pressure, write)
            return
        way = self._session.displacement(hit.vertex, self._sign, self._view.toward_viewer())
        self._session.pull(hit.vertex, way, pressure, write)

    def _pixels(self, hit):
        brush = self._session.brush
        if brush.distance == 'EDGES':
            return 0.0  # the radius is a number of edges and has no length
        return self._view.pixels_for(hit.point, brush.radius)
