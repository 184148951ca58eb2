"""Strips of the NLA: what editing a layer and turning layers into strips share."""

from ..core.blender import capabilities
from ..core.measures import scene_time

MARGIN = 1000.0
"""Frames beyond the scene and an action for which a strip plays the action as it plays by itself."""


def new_strip(animation, name, action, slot, start):
    """Add a track on top of all tracks, with one strip. slot: of the action; None without slots. start: whole frame. Returns the strip."""
    track = animation.nla_tracks.new()
    track.name = name
    strip = track.strips.new(name, int(start), action)
    if capabilities.has_slotted_actions() and slot:
        strip.action_slot = slot
    strip.use_auto_blend = strip.use_sync_length = False
    strip.blend_in = strip.blend_out = 0.0
    return strip


def fit(strip, frames, times):
    """Let a strip play frames (first, last) of its action at times (first, last) of the scene; last is after first.

    The end is set before the start, which Blender keeps before the end.
    """
    strip.action_frame_end, strip.action_frame_start = max(frames[1], frames[0] + 1.0), frames[0]
    strip.scale = (times[1] - times[0]) / (frames[1] - frames[0]) if frames[1] > frames[0] else 1.0
    strip.frame_end, strip.frame_start = max(times[1], times[0] + 1.0), times[0]


def play_own(scene, animation, name):
    """Add a track in which a datablock's own action plays as it does by itself. Returns the strip."""
    action, slot = animation.action, getattr(animation, "action_slot", None)
    first = float(round(min(scene_time.first(scene), action.frame_range[0]) - MARGIN))
    last = float(round(max(scene_time.last(scene), action.frame_range[1]) + MARGIN))
    strip = new_strip(animation, name, action, slot, first)
    fit(strip, (first, last), (first, last))
    strip.extrapolation, strip.blend_type, strip.influence = 'HOLD', animation.action_blend_type, animation.action_influence
    return strip
