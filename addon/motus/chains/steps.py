"""A motion that takes long is solved in steps, so that Blender's interface does not freeze.

An evaluation for a window solves for a moment; if that was not enough, a chain stays where its former motion has it, and a timer goes on and
has Blender evaluate again. Renders, operators that read frames, and Blenders without a window wait until a motion is solved.
"""

import math
import time
from typing import Any, NamedTuple

import bpy

from ..core import keeping, wiring
from ..core.blender import frames
from ..core.declare import is_owner, registered
from ..core.evaluated.shares import waits_for_all
from ..core.interface.view import viewports
from . import motion

AT_FIRST = 0.3
"""Seconds for which an evaluation solves."""
SLICE = 0.05
"""Seconds for which the timer solves at a time."""
PAUSE = 0.01
"""Seconds between two calls of the timer, in which Blender handles the interface."""
MOST = 1024

_unfinished = keeping.OfFile(
    "motions of chains that are being solved in steps (Unfinished)",
    "name of the owner, whether it is linked, and name of the entry of the first chain",
    most=MOST,
    until="they are solved, or a different file is opened",
)
_former = keeping.OfFile(
    "motions of chains that were shown last (Motion)",
    "name of the owner, whether it is linked, and name of the entry of the first chain",
    most_size=motion.LARGEST_MEMORY,
    size=lambda _, moved: moved.size,
    unit="bytes",
)


class Unfinished(NamedTuple):
    """A motion.Motion that is not solved up to the time that is shown. seconds: that time."""

    moved: Any
    seconds: float


def places(context, entry, moved, seconds):
    """Return where the particles of a motion are shown: (n, 3), or None for where the animation has them.

    entry: index of the entry of its first chain. moved: the motion.Motion. seconds: the time.
    """
    key = context.owner.name, context.owner.library is not None, context.settings.entries[entry].name
    found = moved.places(seconds, _patience(context))
    if found is not None:
        if _unfinished:
            _unfinished.drop(key)
        if _former.get(key) is not moved:
            _former.add(key, moved)
        return found
    _unfinished.add(key, Unfinished(moved, seconds))
    context.wants_to_settle = True
    former = _former.get(key)
    found = former.places(seconds, 0.0) if former else None
    return found if found is not None and len(found) == len(moved) else None


def _patience(context):
    """Seconds for which an evaluation may solve a motion."""
    is_linked = context.owner.library is not None  # a timer cannot let Blender evaluate a linked object again
    if is_linked or bpy.app.background or frames.is_read() or waits_for_all(context.depsgraph):
        return math.inf
    return 0.0 if _unfinished else AT_FIRST


def done(rig):
    """Which part of what is shown of a rig's chains is solved, from 0 to 1; None if all of it is."""
    parts = [one.moved.done(one.seconds) for (name, *_), one in _unfinished.items() if name == rig.name]
    return min(parts, default=None)


def settle(_rig=None):
    """Start the timer that goes on with unfinished motions, if there are any and it is not running."""
    if _unfinished and not bpy.app.timers.is_registered(_go_on):
        bpy.app.timers.register(_go_on, first_interval=PAUSE)


def _go_on():
    end = time.perf_counter() + SLICE
    for key, one in _unfinished.items():
        rig = bpy.data.objects.get((key[0], None))
        if rig is None or not is_owner(registered["chains"], rig):
            _unfinished.drop(key)
        elif one.moved.places(one.seconds, end - time.perf_counter()) is not None:
            _unfinished.drop(key)
            wiring.touch(registered["chains"], rig)
    viewports.redraw(('VIEW_3D', 'PROPERTIES'))
    return PAUSE if _unfinished else None


def register():
    """Do nothing: the timer is registered by settle(), once an evaluation leaves a motion unfinished."""


def unregister():
    """Stop the timer that goes on with unfinished motions."""
    if bpy.app.timers.is_registered(_go_on):  # the timer ends when a different file is opened
        bpy.app.timers.unregister(_go_on)
