"""Where flakes land, found bit by bit in the viewport, so that Blender goes on answering.

It takes some 10 microseconds a flake, once. A solver finds a part of it at each evaluation; a timer goes on with the rest, and has
Blender evaluate again. Without a window there is no timer: an evaluation finds as much as a frame has time for, and the next one more.
Renders find all at once.
"""

import time

import bpy

from ..core import keeping, wiring
from ..core.declare import is_owner, registered
from ..core.interface.view import viewports
from ..core.measures import bounds

AT_ONCE = 48
"""Blocks of 256 flakes that an evaluation, or a call of the timer, looks at."""
BLOCK = 2560
"""The price (core/measures/bounds.py) of looking at a block."""
PAUSE = 0.01
"""Seconds that Blender has to itself between calls of the timer."""
SHOWN = 0.3
"""Seconds from one time to the next that what has been found is shown."""

_searches = keeping.OfFile(
    "which flakes' landings are still looked for (Search)",
    "name of the emitter",
    most=1024,
    until="all landings are found, or another file is opened",
)


class Search:
    """Search for the landings of a native Snow at a time, block by block; `left` blocks remain."""

    def __init__(self, snow, seconds, left):
        self._snow, self._seconds, self._first, self._left = snow, seconds, left, left
        self._shown = time.monotonic()
        self.has_no_room = False
        """Whether there is no room to keep more of what is found: then it is found anew at each evaluation, all at once."""

    def is_for(self, snow, seconds):
        """Whether the search is for this Snow and time."""
        return self._snow is snow and self._seconds == seconds

    @property
    def done(self):
        """Share of the search that is completed, from 0 to 1."""
        return 1.0 - self._left / self._first

    def go_on(self):
        """Search the next AT_ONCE blocks of flakes for their landing places.

        Returns (whether blocks remain to be searched, whether the viewport has to show the landing places found so far).
        """
        before, self._left = self._left, self._snow.find_landings(self._seconds, AT_ONCE)
        self.has_no_room = 0 < self._left == before
        is_over = self._left == 0 or self.has_no_room
        is_shown = is_over or time.monotonic() - self._shown > SHOWN
        if is_shown:
            self._shown = time.monotonic()
        return not is_over, is_shown


def are_left(context, snow, seconds):
    """Whether the landing places of some flakes at this time are still unknown, after a first part of the search.

    If the result is true, a timer continues the search after the evaluation; in background mode, the next evaluation does.
    """
    if context.owner.library:  # of which no local object can be evaluated again
        return False
    if bpy.app.background:
        before = snow.find_landings(seconds, 0)
        # Where there is no room to keep more, nothing goes on.
        return 0 < snow.find_landings(seconds, bounds.times(BLOCK)) < before
    name = context.owner.name
    search = _searches.get(name)
    if search is not None and search.has_no_room and search.is_for(snow, seconds):
        return False
    left = snow.find_landings(seconds, AT_ONCE)
    if left == 0:
        _searches.drop(name)
        return False
    if search is None or not search.is_for(snow, seconds):
        _searches.add(name, Search(snow, seconds, left))
        context.wants_to_settle = True
    return True


def done(emitter):
    """How much of an emitter's search is done, from 0 to 1; None where nothing is looked for."""
    search = _searches.get(emitter.name)
    return search.done if search and not search.has_no_room else None


def settle():
    """Go on with what solvers have left."""
    if _searches and not bpy.app.timers.is_registered(_go_on):
        bpy.app.timers.register(_go_on, first_interval=PAUSE)


def _go_on():
    for name, search in _searches.items():
        emitter = bpy.data.objects.get((name, None))
        if emitter is None or not is_owner(registered["snow"], emitter):
            _searches.drop(name)
            continue
        if search.has_no_room:
            continue
        goes_on, is_shown = search.go_on()
        if not goes_on and not search.has_no_room:
            _searches.drop(name)
        if is_shown:
            wiring.touch(registered["snow"], emitter)
            viewports.redraw(('VIEW_3D', 'PROPERTIES'))
    return None if all(search.has_no_room for _, search in _searches.items()) else PAUSE


def register():
    """Do nothing: the timer of the search is registered by settle(), once a solver leaves landing places unknown."""


def unregister():
    """Look for nothing more."""
    if bpy.app.timers.is_registered(_go_on):  # not after another file was opened, which ends it
        bpy.app.timers.unregister(_go_on)
