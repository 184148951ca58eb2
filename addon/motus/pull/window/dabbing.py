"""A stroke of dabs along the path of the mouse; a timer makes dabs while the mouse rests."""

import time

from . import strokes

SMOOTHING = 0.5
"""Share of the way to the mean of its neighbours by which one dab of smoothing moves a vertex."""


class Dabbing:
    """A stroke of dabs with the mouse.

    sign: -1 pushes down instead of pulling. is_smooth: whether the dabs smooth instead of pulling.
    """

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
        """Make the dabs that are due at the press of the mouse button or a movement of the mouse."""
        found = self._way.move(event.mouse_x, event.mouse_y)
        self.hit = self._way.found
        # If `accumulate` is off, only the last position counts: the shape follows the mouse even over less than the spacing.
        if not self._session.brush.accumulate and not self._is_smooth:
            found = [self.hit] if self.hit else []
        self._dabs(found, event)

    def tick(self, event):
        """Make a dab at an event of the timer, if the mouse has rested."""
        now = time.monotonic()
        if now - self._ticked < 0.8 / strokes.RATE:
            return  # the event is from a different timer
        self._ticked = now
        if self._session.brush.accumulate or self._is_smooth:
            self._dabs(self._way.wait(), event)

    def key(self, _context, _event):
        """Ignore a key: a stroke of dabs has no keys."""

    def is_confirmed_by(self, _event):
        """Return False: only the release of the mouse button ends a stroke of dabs."""
        return False

    def is_cancelled_by(self, _event):
        """Return False: no event undoes a stroke of dabs alone, without the session's earlier strokes."""
        return False

    def cursor(self, session, view, place):
        """Return (dab.Hit under the cursor or None, None).

        The second value is a displacement for the cursor's bump; None takes the brush's own.
        """
        return session.pick(*view.ray(*place)), None

    def end(self):
        """End the stroke of dabs: remove its timer."""
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
