"""Lets read-outs move while the animation plays.

Blender draws no sidebar anew during playback, unless its own *Playback* options name the property editors.
"""

import threading
import time

import bpy

from ...blender import handlers

INTERVAL = 0.1
"""Seconds between two redraws: more often than that nobody reads numbers, and panels cost time."""
REGIONS = {'VIEW_3D': 'UI', 'PROPERTIES': 'WINDOW'}
"""Where panels with read-outs stand."""


class _Drawn:
    """Whether read-outs were drawn since the last redraw that was asked for here, and when that was."""

    is_new = False
    time = 0.0


def note():
    """Called where read-outs are drawn: without any, playback costs nothing."""
    _Drawn.is_new = True
    # Not a persistent handler: a file in which nobody has looked at read-outs costs nothing.
    if _frame_changed not in bpy.app.handlers.frame_change_post:
        handlers.add(_PAIRS)


def _frame_changed(*_):
    # A render goes through frames in a thread of its own, where windows must not be touched.
    if not _Drawn.is_new or bpy.app.background or threading.current_thread() is not threading.main_thread():
        return
    now = time.monotonic()
    if now < _Drawn.time + INTERVAL:
        return
    screens = [window.screen for window in bpy.context.window_manager.windows]
    if not any(screen.is_animation_playing for screen in screens):
        return
    _Drawn.is_new, _Drawn.time = False, now
    for area in (area for screen in screens for area in screen.areas if area.type in REGIONS):
        for region in area.regions:
            if region.type == REGIONS[area.type]:
                region.tag_redraw()


_PAIRS = ((bpy.app.handlers.frame_change_post, _frame_changed),)


def unregister():
    """Follow playback no more."""
    handlers.remove(_PAIRS)
