"""Operators that match the targets and poles of chains to the animated pose, and the animated pose to the solution."""

import math

import bpy

from ...core.interface.rows import Rows
from ...core.translations import tr
from ..frame_walk import OverFrames, active_rig
from .job import match_fk, match_ik

GOOD = 1e-3
"""Largest error, as a share of a chain's length, at which a chain counts as matched."""


class _Match(OverFrames):
    """Mixin of the operators that match in one direction. job: the generator in job.py that does the work."""

    redo = (*OverFrames.redo, Rows(("switch",)))

    def steps(self, context, frames):
        rig = active_rig(context, self.object)
        self._outcome, self._count = {}, len(frames)
        job = type(self).job(context, rig, self.bone, frames, self.switch, self._outcome)
        self.total = next(job)
        return job

    def result(self, context):
        error = self._outcome["error"]
        millimetres = 1000.0 * error.length * context.scene.unit_settings.scale_length
        sentence = tr("Matched {frames} frames of {chains} chains: largest error {length} mm, {angle} degrees").format(
            frames=self._count, chains=self._outcome["chains"], length=_number(millimetres), angle=_number(math.degrees(error.angle))
        )
        self.report({'INFO'} if error.share <= GOOD else {'WARNING'}, sentence)


def _number(value):
    """A number as text, rounded to a thousandth, without an exponent."""
    return f"{round(value, 3):.12g}"


class MOTUS_OT_ik_match_fk(_Match, bpy.types.Operator):
    bl_idname = "motus.ik_match_fk"
    bl_label = "Match IK to FK"
    bl_description = "Key the targets and poles so that the solution is the animated pose"

    switch: bpy.props.BoolProperty(name="Switch to IK", description="Set the position weight to 1 over these frames", default=False)
    job = staticmethod(match_fk)


class MOTUS_OT_fk_match_ik(_Match, bpy.types.Operator):
    bl_idname = "motus.fk_match_ik"
    bl_label = "Match FK to IK"
    bl_description = "Key the bones so that their own animation is the solution"

    switch: bpy.props.BoolProperty(name="Switch to FK", description="Set both weights to 0 over these frames", default=False)
    job = staticmethod(match_ik)


classes = (MOTUS_OT_ik_match_fk, MOTUS_OT_fk_match_ik)
