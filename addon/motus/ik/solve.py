"""Solver of inverse kinematics: one call of the native module for all chains of a group."""

from ..core.declare import Problem
from ..core.file.stored import Damaged
from ..core.lazy import numpy as np
from . import reading
from .groups import OUTPUTS
from .reasons import MUTED

SOME_ARE_OFF = Problem("Some chains have no target that they could reach for: the list says why", blocking=False)
NOT_WIRED = Problem("The rig's bones have changed: press Refresh")
ASTRAY = Problem("A target that Blend needs is missing: the one before it counts instead", blocking=False)
STIFF = Problem("Stretch or Length was keyed or driven after the chain was made: press Refresh", blocking=False)
REASON = OUTPUTS.index("reason")
PROBLEMS = (SOME_ARE_OFF, NOT_WIRED, STIFF, ASTRAY)


def solve(context):
    """Compute the turns and stretches of a group's bones at the present frame, on top of their animation.

    They are written into context.rotations and context.scales, and the report into context.outputs. Returns a Problem, or None if
    there is none. A user's error never raises an exception.
    """
    try:
        found = reading.gather_wired(context)
    except reading.RigChanged:
        return NOT_WIRED
    wired = found.wired
    if (wired.members, wired.told_numbers) != (len(context.rotations), len(context.outputs)):
        raise Damaged("another number of members or outputs")
    report = wired.plan.solve(
        found.bones,
        *found.posed,
        found.settings,
        found.targets,
        found.poles,
        limits=found.limits,
        rotations=context.rotations,
        scales=context.scales,
    )
    table = context.outputs.reshape(-1, len(OUTPUTS))
    report.take(wired.told, axis=1, out=table, mode='clip')  # mode 'raise' would copy the array first
    reasons = table[:, REASON]
    if found.off:
        reasons[list(found.off)] = list(found.off.values())
    # All reasons below 0 are faults except MUTED, which is the lowest. argmin() is the fastest way to the lowest number.
    if reasons[reasons.argmin()] < 0.0 and np.any((reasons < 0.0) & (reasons > MUTED)):
        return SOME_ARE_OFF
    if found.is_astray:
        return ASTRAY
    return STIFF if found.is_stiff else None
