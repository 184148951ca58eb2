"""What checking a chain over a range of frames found: kept with its entry, and said in words."""

import re

import bpy

from ...core.blender.frames import ranges, spoken
from ...core.translations import tr

_RUN = re.compile(r"(-?[\d.]+)(?:-(-?[\d.]+))?")
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
    """Mixin for an entry: the last result of motus.ik_check."""

    check_range: bpy.props.StringProperty(
        name="Checked", description="Frames that were checked; empty before any check", options=set(), override=OVERRIDABLE
    )
    check_step: bpy.props.FloatProperty(
        name="Step", description="Frames from one that was checked to the next", default=1.0, options=set(), override=OVERRIDABLE
    )
    check_frames: bpy.props.StringProperty(
        name="Frames",
        description="Frames on which the chain does not come to its target, such as 12-40, 77",
        options=set(),
        override=OVERRIDABLE,
    )
    check_worst: bpy.props.FloatProperty(
        name="Short By",
        description="The largest distance that is left to the target",
        subtype='DISTANCE',
        min=0.0,
        options=set(),
        override=OVERRIDABLE,
    )
    check_reason: bpy.props.EnumProperty(
        name="Reason", description="Reason on the frame on which the chain falls shortest", items=WHY, options=set(), override=OVERRIDABLE
    )


def store(entry, checked, step, frames=(), worst=0.0, reason='NONE'):
    """Keep a result. checked: frames, of a walk by steps. frames: the bad ones among them. reason: of WHY."""
    entry.check_range = ranges(checked, step)
    entry.check_step = step
    entry.check_frames = ranges(frames, step)
    entry.check_worst = worst
    entry.check_reason = reason


def contradicts(entry, frame, why):
    """Whether a frame that was checked is otherwise now: something has been changed since. why: what is now, of WHY."""
    if not _was_checked(entry, frame):
        return False
    is_noted = entry.check_reason == 'ANIMATED' or _lies_in(entry.check_frames, frame)
    before = entry.check_reason if is_noted else 'NONE'
    if entry.check_reason == 'UNSOLVED':  # of the other frames it is not known whether the target was reached
        return (before == 'UNSOLVED') != (why == 'UNSOLVED')
    return _kind(before) != _kind(why)


def _kind(why):
    return why if why in ('NONE', 'UNSOLVED', 'ANIMATED') else 'SHORT'


def _was_checked(entry, frame):
    if not _lies_in(entry.check_range, frame):
        return False
    steps = (frame - float(_RUN.match(entry.check_range)[1])) / entry.check_step  # type: ignore[index]
    return abs(steps - round(steps)) * entry.check_step < _SAME_FRAME


def _lies_in(frames, frame):
    return any(float(first) <= frame <= float(last or first) for first, last in _RUN.findall(frames))


def sentence(entry, length):
    """The result in the user's language; "" before any check. length: how a number of world units is written."""
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
    return templates[entry.check_reason].format(
        frames=spoken(entry.check_frames), length=length(entry.check_worst), range=entry.check_range
    )
