"""Values of the solver's output "reason", which says why a head does not look at its target, and sentences about them for the user."""

import math

from ..core.translations import tr

REACHED, TOO_FAR, TOO_NEAR, LIMIT = 0.0, 1.0, 2.0, 3.0
"""Values of native.Reason that the solver of Look At reports."""
NOT_FINITE, NO_TARGET, TARGET_DELETED, NO_TARGET_BONE, MUTED = -1.0, -2.0, -3.0, -4.0, -5.0
UNWANTED = (NOT_FINITE, NO_TARGET, TARGET_DELETED, NO_TARGET_BONE)

SLIGHT = math.radians(0.5)
"""Angle in radians: a head or eye that misses its target by less counts as looking at it, since nobody sees the difference."""


def sentence(reason, angle):
    """Sentence in the user's language that says why a head does not look at its target; "" if it does, or if it is muted.

    angle: angle in radians that is left to turn.
    """
    if reason == NOT_FINITE:
        return tr("A setting is not a finite number")
    if reason == NO_TARGET:
        return tr("Choose a target to look at")
    if reason == TARGET_DELETED:
        return tr("The target is in no collection any more: choose another one")
    if reason == NO_TARGET_BONE:
        return tr("The target has no bone of this name")
    if reason == MUTED or angle < SLIGHT:
        return ""
    degrees = f"{math.degrees(angle):.0f}" if angle > math.radians(9.5) else f"{math.degrees(angle):.1f}"
    if reason == LIMIT:
        return tr("The target is {degrees} degrees beyond the limits").format(degrees=degrees)
    return tr("The weights leave {degrees} degrees to the target").format(degrees=degrees)
