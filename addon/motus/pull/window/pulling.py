"""Session of pulls in a window: applies events of mouse and keyboard to the mesh and to the brush."""

from ...core.interface.dragging.number_entry import NumberEntry
from ...core.interface.view import viewports
from ..brush import Brush
from . import stage, status
from .adjusting import Adjustment, notched, typed
from .dabbing import Dabbing
from .dragging import Dragging


class Pulling:
    """A dab.Session together with the state of the mouse.

    given: {keyword: value} of the operator, which replace values of the scene's brush.
    """

    def __init__(self, context, session, given):
        self.session = session
        self.settings = context.scene.motus.pull
        self.adjustment = None
        self.stroke = None
        self.entry = NumberEntry()
        self.button = None
        self.sign, self.is_smooth = 1.0, False
        self._given = dict(given)
        self._window = context.window
        stage.enter(self)

    @property
    def brush(self):
        """The brush of the session, as a Brush with its present values."""
        return self.session.brush

    @property
    def is_stroking(self):
        """Whether a stroke has begun, so that a mouse button is held."""
        return self.stroke is not None

    @property
    def is_dragging(self):
        """Whether the present stroke drags one vertex with the mouse (Dragging)."""
        return isinstance(self.stroke, Dragging)

    # --- The brush ------------------------------------------------------------------------------------------------

    def set(self, context, name, value):
        """Set a property of the brush, both for this session and in the scene."""
        self._given.pop(name, None)
        setattr(self.settings, name, value)
        self.session.brush = Brush.of(self.settings, self._given)
        self.show(context)

    def cycle(self, context, name):
        """Set an enum property of the brush to its next item."""
        items = [item.identifier for item in self.settings.bl_rna.properties[name].enum_items]
        self.set(context, name, items[(items.index(getattr(self.brush, name)) + 1) % len(items)])

    def toggle_mirror(self, context, axis):
        """Switch mirroring across an axis of the object on or off in the brush."""
        self.set(context, "mirror", set(self.brush.mirror) ^ {axis})

    def step(self, context, name, up):
        """Raise or lower the brush's radius or strength by one step."""
        self.set(context, name, notched(self.brush, name, 1 if up else -1))

    def type_strength(self, context, kind):
        """Handle a key as a part of a typed number for the strength; returns False if the key is no part of a number."""
        if not self.entry.key(kind):
            return False
        if self.entry.value is not None:
            self.set(context, status.STRENGTH, typed(context, self.brush, status.STRENGTH, self.entry.value))
        self.show(context)
        return True

    def adjust(self, context, name, view, event):
        """Begin to change the brush's radius or strength with the mouse. name: of the property."""
        hit = self.session.pick(*view.ray(event.mouse_x, event.mouse_y))
        place = hit.point if hit else view.data.view_location
        self.adjustment = Adjustment(name, self.brush, event.mouse_x, view.pixels_for(place, 1.0), view, hit)
        self.show(context)

    def handle_adjustment(self, context, event):
        """Handle an event while the mouse changes the brush's radius or strength."""
        meaning, value = self.adjustment.handle(context, self.brush, event)
        name = self.adjustment.name
        if meaning in {'KEEP', 'CANCEL'}:
            self.adjustment = None
        if value is not None:
            self.set(context, name, value)
        self.show(context)

    # --- Strokes --------------------------------------------------------------------------------------------------

    def press(self, context, view, event, sign, is_smooth):
        """Begin a stroke when a mouse button is pressed in a viewport; returns whether the mouse is on the mesh.

        sign: -1 pushes instead of pulling. is_smooth: whether the stroke smooths.
        """
        self.button, self.sign, self.is_smooth = event.type, sign, is_smooth
        if self.brush.direction == 'CURSOR' and not is_smooth:
            self.stroke = Dragging(self.session, view, event)
        else:
            self.stroke = Dabbing(context, self.session, view, sign, is_smooth)
        self.move(context, event)
        return self.stroke.hit is not None

    def move(self, context, event):
        """Continue the stroke at a movement of the mouse while its button is held."""
        self.stroke.move(event)
        self._show_stroke(context)

    def tick(self, event):
        """Continue the stroke at a timer event while its button is held."""
        self.stroke.tick(event)
        self._redraw()

    def key(self, context, event):
        """Pass a key to the stroke while its button is held."""
        self.stroke.key(context, event)
        self._show_stroke(context)

    def is_ended_by(self, event):
        """Whether an event ends the stroke and keeps its result."""
        is_let_go = event.type == self.button and event.value == 'RELEASE'
        return is_let_go or self.stroke.is_confirmed_by(event)

    def release(self, context):
        """End the stroke, and keep its result."""
        self._end_stroke()
        self.show(context)

    def cancel_stroke(self, context):
        """End the stroke, and undo its effect on the mesh."""
        self.stroke.cancel()
        self.release(context)

    def step_back(self, context):
        """Undo the last stroke of this session."""
        if self.session.step_back():
            self.show(context)

    def _show_stroke(self, context):
        # Texts in the headers depend on drags, but not on dabs.
        if self.is_dragging:
            self.show(context)
        else:
            self._redraw()

    def _end_stroke(self):
        if self.stroke is not None:
            self.stroke.end()
        self.stroke = self.button = None

    # --- Display --------------------------------------------------------------------------------------------------

    def show(self, context):
        """Show the state of the brush in the headers of the viewports and in the status bar, and redraw the viewports."""
        adjusted, entry = None, None
        if self.adjustment is not None:
            adjusted, entry = self.adjustment.name, self.adjustment.entry
        elif self.entry.is_open:
            adjusted, entry = status.STRENGTH, self.entry
        if self.is_dragging:
            text = status.drag_header(context, self.settings, self.session, self.stroke)
        else:
            text = status.header(context, self.settings, self.brush, entry, adjusted)
        for area in self._viewports():
            area.header_text_set(text)
        context.workspace.status_text_set(status.drawn(self._keys()))
        self._redraw()

    def _keys(self):
        if self.adjustment is not None:
            return status.ADJUSTING_KEYS
        if self.is_dragging:
            return status.DRAGGING_KEYS
        return status.GRABBING_KEYS if self.brush.direction == 'CURSOR' else status.SESSION_KEYS

    def close(self, context):
        """End the modal operation: the stroke with its timer, and the texts in the viewports' headers and the status bar."""
        self._end_stroke()
        stage.leave(self)
        for area in self._viewports():
            area.header_text_set(None)
        context.workspace.status_text_set(None)
        self._redraw()

    def view_under(self, event):
        """The viewport under the mouse at an event; None if the mouse is not over a viewport."""
        return viewports.view_at(self._window, event.mouse_x, event.mouse_y)

    def _viewports(self):
        return [area for area in self._window.screen.areas if area.type == 'VIEW_3D']

    def _redraw(self):
        for area in self._viewports():
            area.tag_redraw()
