"""A session in the window: what mouse and keys do to the mesh and to the brush."""

import time

from ...core import viewports
from ..brush import Brush
from . import stage, status, strokes
from .adjusting import Adjustment, notched, typed
from .entry import NumberEntry

SMOOTHING = 0.5
"""Share of the way to the neighbours' mean that one dab of smoothing goes."""


class Pulling:
    """A dab.Session with the mouse's state. given: keywords of the operator, which go before the scene's brush."""

    def __init__(self, context, session, given):
        self.session = session
        self.settings = context.scene.motus.pull
        self.view = self.hit = None
        self.adjustment = None
        self.entry = NumberEntry()
        self.button = None
        self.sign, self.is_smooth = 1.0, False
        self._given = dict(given)
        self._window = context.window
        self._way = self._timer = None
        self._ticked = 0.0
        self._areas = set()
        stage.enter(self)

    @property
    def brush(self):
        """The brush as it stands."""
        return self.session.brush

    @property
    def is_stroking(self):
        """Whether a button is held."""
        return self.button is not None

    # --- The brush ------------------------------------------------------------------------------------------------

    def set(self, context, name, value):
        """Change one of the brush's settings, for this session and for the scene."""
        self._given.pop(name, None)
        setattr(self.settings, name, value)
        self.session.brush = Brush.of(self.settings, self._given)
        self.show(context)

    def cycle(self, context, name):
        """Go on to the next item of an enum setting."""
        items = [item.identifier for item in self.settings.bl_rna.properties[name].enum_items]
        self.set(context, name, items[(items.index(getattr(self.brush, name)) + 1) % len(items)])

    def toggle_mirror(self, context, axis):
        """Switch the mirror about an axis on or off."""
        self.set(context, "mirror", set(self.brush.mirror) ^ {axis})

    def turn_wheel(self, context, name, up):
        """One notch of the wheel for radius or strength."""
        self.set(context, name, notched(self.brush, name, 1 if up else -1))

    def type_strength(self, context, kind):
        """A key for the number that is typed; False where it is none."""
        if not self.entry.key(kind):
            return False
        if self.entry.value is not None:
            self.set(context, status.STRENGTH, typed(context, self.brush, status.STRENGTH, self.entry.value))
        self.show(context)
        return True

    def adjust(self, context, name, view, event):
        """Let the mouse change radius or strength from here on."""
        self.hit = self._find(view, event.mouse_x, event.mouse_y)
        place = self.hit.point if self.hit else view.data.view_location
        self.adjustment = Adjustment(name, self.brush, event.mouse_x, view.pixels_for(place, 1.0), view, self.hit)
        self.show(context)

    def handle_adjustment(self, context, event):
        """An event while the mouse changes a number."""
        meaning, value = self.adjustment.handle(context, self.brush, event)
        name = self.adjustment.name
        if meaning in {'KEEP', 'CANCEL'}:
            self.adjustment = None
        if value is not None:
            self.set(context, name, value)
        self.show(context)

    # --- Strokes --------------------------------------------------------------------------------------------------

    def press(self, context, view, event, sign, is_smooth):
        """A button is pressed over the viewport: a stroke begins. Gives whether it is on the mesh."""
        self.view, self.button, self.sign, self.is_smooth = view, event.type, sign, is_smooth
        self.session.begin_stroke()
        self._way = strokes.Way(lambda x, y: self._find(view, x, y), self._pixels)
        self._timer = context.window_manager.event_timer_add(1.0 / strokes.RATE, window=self._window)
        self._ticked = time.monotonic()
        self.move(context, event)
        return self.hit is not None

    def move(self, context, event):
        """The mouse has moved while a button is held."""
        found = self._way.move(event.mouse_x, event.mouse_y)
        self.hit = self._way.found
        # Where nothing accumulates only the last place counts: the shape follows the mouse, however short its way.
        if not self.brush.accumulate and not self.is_smooth:
            found = [self.hit] if self.hit else []
        self._dabs(context, found, event)

    def tick(self, context, event):
        """The clock ticks while a button is held."""
        now = time.monotonic()
        if now - self._ticked < 0.8 / strokes.RATE:
            return  # somebody else's clock
        self._ticked = now
        if self.brush.accumulate or self.is_smooth:
            self._dabs(context, self._way.wait(), event)

    def release(self, context):
        """The button is let go."""
        self.button = self._way = None
        self._stop_timer(context)
        self._redraw()

    def step_back(self, context):
        """Undo the last stroke of this session."""
        if self.session.step_back():
            self.show(context)

    def _dabs(self, context, found, event):
        if not found:
            return
        pressure = strokes.pressure(event)
        try:
            for hit in found:
                self._dab(hit, pressure, write=hit is found[-1])
        finally:
            self.session.flush()
        self._redraw()

    def _dab(self, hit, pressure, write):
        if self.is_smooth:
            self.session.smooth(hit.vertex, SMOOTHING, pressure, write)
            return
        way = self.session.displacement(hit.vertex, self.sign, self.view.toward_viewer())
        self.session.pull(hit.vertex, way, pressure, write)

    def _find(self, view, x, y):
        return self.session.pick(*view.ray(x, y))

    def _pixels(self, hit):
        if self.brush.distance == 'EDGES':
            return 0.0  # a number of edges has no length
        return self.view.pixels_for(hit.point, self.brush.radius)

    # --- What is seen ---------------------------------------------------------------------------------------------

    def show(self, context):
        """Put the state into the headers of the viewports, and draw anew."""
        adjusted, entry = None, None
        if self.adjustment is not None:
            adjusted, entry = self.adjustment.name, self.adjustment.entry
        elif self.entry.is_open:
            adjusted, entry = status.STRENGTH, self.entry
        text = status.header(context, self.settings, self.brush, entry, adjusted)
        for area in self._viewports(context):
            area.header_text_set(text)
        keys = status.ADJUSTING_KEYS if self.adjustment is not None else status.SESSION_KEYS
        context.workspace.status_text_set(status.drawn(keys))
        self._redraw()

    def close(self, context):
        """Nothing is shown any more, and no clock ticks."""
        self._stop_timer(context)
        stage.leave(self)
        for area in self._viewports(context):
            area.header_text_set(None)
        context.workspace.status_text_set(None)
        self._redraw()

    def view_under(self, event):
        """The viewport under the mouse, or None."""
        return viewports.view_at(self._window, event.mouse_x, event.mouse_y)

    def _viewports(self, _context):
        return [area for area in self._window.screen.areas if area.type == 'VIEW_3D']

    def _redraw(self):
        for area in self._viewports(None):
            area.tag_redraw()

    def _stop_timer(self, context):
        if self._timer is not None:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None
