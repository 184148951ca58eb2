"""Result of checking a chain over a range of frames: stored in the chain's entry, and told to the user in a sentence."""

import math
import re

import bpy

from ...core.blender.frames import ranges, spoken
from ...core.file.choices import chosen
from ...core.translations import tr

_NUMBER = r"-?\d+(?:\.\d+)?"
_RUN = re.compile(rf"({_NUMBER})(?:-({_NUMBER}))?", re.ASCII)
_SAME_FRAME = 1e-3

WHY = (
    ('NONE', "Nothing", "Every target is reached"),
    ('FAR', "Too Far", "The target is farther than the chain reaches"),
    ('NEAR', "Too Near", "The target is nearer than the chain can fold"),
    ('LIMIT', "Limit", "A joint limit is in the way"),
    ('ITERATIONS', "Iterations", "The iterations were used up"),
    ('TURN', "Orientation", "Turned as the target is, the last bone leaves the others too short"),
    ('UNSOLVED', "Not Solved", "The chain has no target, or cannot be solved"),
    ('ANIMATED', "Animation", "The weights leave the chain to its animation"),
)
OVERRIDABLE = {'LIBRARY_OVERRIDABLE'}


class CheckResults:
    """Mixin of an entry's settings with the last result of the operator motus.ik_check."""

    check_range: bpy.props.StringProperty(
        name="Checked", description="Frames that were checked; empty before any check", options={'HIDDEN'}, override=OVERRIDABLE
    )
    check_step: bpy.props.FloatProperty(
        name="Step", description="Frames from one that was checked to the next", default=1.0, options={'HIDDEN'}, override=OVERRIDABLE
    )
    check_frames: bpy.props.StringProperty(
        name="Frames",
        description="Frames on which the chain does not come to its target, such as 12-40, 77",
        options={'HIDDEN'},
        override=OVERRIDABLE,
    )
    check_worst: bpy.props.FloatProperty(
        name="Short By",
        description="The largest distance that is left to the target",
        subtype='DISTANCE',
        min=0.0,
        options={'HIDDEN'},
        override=OVERRIDABLE,
    )
    check_reason: bpy.props.EnumProperty(
        name="Reason",
        description="Reason on the frame on which the chain falls shortest",
        items=WHY,
        options={'HIDDEN'},
        override=OVERRIDABLE,
    )


def store(entry, checked, step, frames=(), worst=0.0, reason='NONE'):
    """Store the result of a check in an entry.

    checked: rising frames that were checked, `step` frames apart. frames: those of them on which the chain misses its target.
    worst: largest distance left to the target. reason: an item of WHY.
    """
    entry.check_range = ranges(checked, step)
    entry.check_step = step
    entry.check_frames = ranges(frames, step)
    entry.check_worst = worst
    entry.check_reason = reason


def contradicts(entry, frame, why):
    """Whether the present result at a frame is different from the result that the check has stored for it.

    It is then known that something was changed since the check. why: the present result, an item of WHY.
    """
    if not _was_checked(entry, frame):
        return False
    reason = chosen(entry, "check_reason")
    before = reason if reason == 'ANIMATED' or _lies_in(entry.check_frames, frame) else 'NONE'
    if reason == 'UNSOLVED':  # for all different frames it is not known whether the target was reached
        return (before == 'UNSOLVED') != (why == 'UNSOLVED')
    return _kind(before) != _kind(why)


def _kind(why):
    return why if why in ('NONE', 'UNSOLVED', 'ANIMATED') else 'SHORT'


def _was_checked(entry, frame):
    runs = _RUN.findall(entry.check_range)
    if not _lies_in(entry.check_range, frame) or not entry.check_step > 0.0:
        return False
    steps = (frame - float(runs[0][0])) / entry.check_step
    return math.isfinite(steps) and abs(steps - round(steps)) * entry.check_step < _SAME_FRAME


def _lies_in(frames, frame):
    return any(float(first) <= frame <= float(last or first) for first, last in _RUN.findall(frames))


def sentence(entry, length):
    """Result of an entry's last check in the user's language; "" if there was no check. length(value): text of a length in world units."""
    if not entry.check_range:
        return ""
    templates = {
        'NONE': tr("Reaches its target on all frames {range}"),
        'UNSOLVED': tr("Not solved on {frames}: the panel says why (checked {range})"),
        'ANIMATED': tr("The weights leave it to its animation on all frames {range}"),
        'FAR': tr("Out of reach on {frames}, at most {length} short (checked {range})"),
        'NEAR': tr("Too near on {frames}, at most {length} (checked {range})"),
        'LIMIT': tr("Held by joint limits on {frames}, at most {length} short (checked {range})"),
        'TURN': tr("Too far with the target's orientation on {frames}, at most {length} short (checked {range})"),
        'ITERATIONS': tr("Iterations used up on {frames}, at most {length} short (checked {range})"),
    }
    return templates[chosen(entry, "check_reason")].format(
        frames=spoken(entry.check_frames), length=length(entry.check_worst), range=entry.check_range
    )
