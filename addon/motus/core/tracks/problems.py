"""Problems of systems that follow motions over time and drive bones: sentences that several of them say."""

from ..declare import Problem

NEEDS_RECORDING = Problem("Some of the followed motion cannot be read from keys: record it", blocking=False)
NOT_KNOWN = Problem("Some of what is followed is not known on other frames, and cannot be recorded", blocking=False)
BAD_NUMBERS = Problem("Some numbers are outside of what a motion can be computed from", blocking=False)
MISSING_BONES = Problem("Some bones that follow are not there any more: remove them from the list", blocking=False)
LOOPED_BONES = Problem("Some bones move with what they follow, and are left out", blocking=False)
BONES_CHANGED = Problem("The rig's bones have changed: press Refresh")


def of_unknown(source):
    """Return the Problem of an input (core/tracks/inputs.py) that is not known."""
    return NOT_KNOWN if source.reason else NEEDS_RECORDING
