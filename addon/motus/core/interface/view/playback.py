"""Redraw panels with read-outs while the animation plays.

During playback Blender does not redraw sidebars, unless its own *Playback* options name the property editors.
"""

import threading
import time

import bpy

from ...blender import handlers

INTERVAL = 0.1
"""Seconds between two redraws of panels. Nobody reads numbers that change faster, and drawing panels takes time."""
REGIONS = {'VIEW_3D': 'UI', 'PROPERTIES': 'WINDOW'}
"""{type of area: type of its region that has panels with read-outs}."""


class _Drawn:
    """State of the redraws. is_new: whether read-outs were drawn since the last redraw that this module has requested.

    time: of that redraw, by time.monotonic().
    """

    is_new = False
    time = 0.0


def note():
    """Note that read-outs were drawn, and add the handler that redraws them. Without read-outs, playback costs nothing."""
    _Drawn.is_new = True
    # The handler is not persistent: it costs nothing in a file whose read-outs nobody has looked at.
    if _frame_changed not in bpy.app.handlers.frame_change_post:
        handlers.add(_PAIRS)


def _frame_changed(*_):
    # A render changes frames in a separate thread, in which windows must not be touched.
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
    """Remove the handler that redraws panels during playback."""
    handlers.remove(_PAIRS)
