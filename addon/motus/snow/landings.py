"""Search for the places where flakes land, in parts, so that Blender's interface does not freeze.

The search takes about 10 microseconds for each flake, once. In the viewport the solver searches a part at each evaluation; a timer
continues the search and lets Blender evaluate again. In background mode there is no timer: each evaluation searches as much as a frame
has time for. Renders search for all landing places at once.
"""

import time

import bpy

from ..core import keeping, wiring
from ..core.declare import is_owner, registered
from ..core.evaluated.shares import share_of
from ..core.interface.view import viewports
from ..core.measures import bounds

AT_ONCE = 48
"""Number of blocks, of 256 flakes each, that one evaluation or one call of the timer searches at most."""
BLOCK = 2560
"""Price of searching one block: about the microseconds that it takes (see core/measures/bounds.py)."""
PAUSE = 0.01
"""Seconds between two calls of the timer, in which Blender handles the interface."""
SHOWN = 0.3
"""Seconds between two updates of the viewport while the search goes on."""

_searches = keeping.OfFile(
    "unfinished searches for the landing places of flakes (Search)",
    "name of the emitter object",
    most=1024,
    until="all landing places are found, or a different file is opened",
)


class Search:
    """Search for the landing places of a native Snow's flakes at some Moments, block by block. left: number of blocks that remain."""

    def __init__(self, snow, when, left):
        self._snow, self._when, self._first, self._left = snow, when, left, left
        self._shown = time.monotonic()
        self.has_no_room = False
        """Whether the memory for landing places is full: then each evaluation searches for all landing places anew, at once."""

    def is_for(self, snow, when):
        """Whether the search looks for the landing places of this native Snow's flakes at these Moments."""
        return self._snow is snow and self._when == when

    @property
    def done(self):
        """Share of the search that is completed, from 0 to 1."""
        return 1.0 - self._left / self._first

    def go_on(self, most):
        """Search the next blocks of flakes, `most` at most, for their landing places.

        Returns (whether blocks remain to be searched, whether the viewport has to show the landing places found so far).
        """
        before, self._left = self._left, _found(self._snow, self._when, most)
        self.has_no_room = 0 < self._left == before
        is_over = self._left == 0 or self.has_no_room
        is_shown = is_over or time.monotonic() - self._shown > SHOWN
        if is_shown:
            self._shown = time.monotonic()
        return not is_over, is_shown


def _found(snow, when, most):
    """Search up to `most` blocks of a native Snow's flakes at some Moments for their landing places; returns how many blocks remain."""
    if len(when) == 1:
        return snow.find_landings(when[0].seconds, most)
    remaining = 0
    for one in when:
        before = snow.find_landings(one.seconds, 0)
        left = snow.find_landings(one.seconds, most) if before and most else before
        most -= before - left
        remaining += left
    return remaining


def are_left(context, snow, when, has_barrier):
    """Whether the landing places of some flakes at some Moments are still unknown, after a first part of the search.

    If the result is true, a timer continues the search after the evaluation; in background mode, the next evaluation does.
    has_barrier: whether there is anything to land on.
    """
    if context.owner.library:  # a timer cannot let Blender evaluate a linked object again
        return False
    before = _found(snow, when, 0) if has_barrier else 0
    if before == 0:
        if _searches:
            _searches.drop(context.owner.name)
        return False
    at_once = max(1, bounds.times(BLOCK, share_of(registered["snow"], context.owner, context.depsgraph)))
    if bpy.app.background:
        # If the memory for landing places is full, the number of remaining blocks stays.
        return 0 < _found(snow, when, at_once) < before
    name = context.owner.name
    search = _searches.get(name)
    if search is not None and search.has_no_room and search.is_for(snow, when):
        return False
    left = _found(snow, when, min(AT_ONCE, at_once))
    if left == 0:
        _searches.drop(name)
        return False
    if search is None or not search.is_for(snow, when):
        _searches.add(name, Search(snow, when, left))
        context.wants_to_settle = True
    return True


def done(emitter):
    """Share of an emitter's search for landing places that is completed, from 0 to 1; None if no search is going on."""
    search = _searches.get(emitter.name)
    return search.done if search and not search.has_no_room else None


def settle():
    """Start the timer that continues the searches which solvers have begun, if there are any and it is not running."""
    if _searches and not bpy.app.timers.is_registered(_go_on):
        bpy.app.timers.register(_go_on, first_interval=PAUSE)


def _go_on():
    most = max(1, AT_ONCE // max(1, len(_searches)))
    for name, search in _searches.items():
        emitter = bpy.data.objects.get((name, None))
        if emitter is None or not is_owner(registered["snow"], emitter):
            _searches.drop(name)
            continue
        if search.has_no_room:
            continue
        goes_on, is_shown = search.go_on(most)
        if not goes_on and not search.has_no_room:
            _searches.drop(name)
        if is_shown:
            wiring.touch(registered["snow"], emitter)
            viewports.redraw(('VIEW_3D', 'PROPERTIES'))
    return None if all(search.has_no_room for _, search in _searches.items()) else PAUSE


def register():
    """Do nothing: the timer of the search is registered by settle(), once a solver leaves landing places unknown."""


def unregister():
    """Stop the timer that continues the searches for landing places."""
    if bpy.app.timers.is_registered(_go_on):  # the timer ends when a different file is opened
        bpy.app.timers.unregister(_go_on)
