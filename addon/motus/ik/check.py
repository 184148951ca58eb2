"""The operator that looks for frames on which chains do not come to their targets."""

import bpy

from ..core.translations import tr
from . import check_results, controls, status, targets
from .frame_walk import Kept, OverFrames, active_rig, go_to

class _Finding:
    """What was found of one entry."""

    def __init__(self):
        self.frames = []
        self.worst = 0.0
        self.reason = 'NONE'

    def add(self, frame, left, reason):
        """Note a frame on which something is left."""
        self.frames.append(frame)
        if left > self.worst:
            self.worst, self.reason = left, reason


class MOTUS_OT_ik_check(OverFrames, bpy.types.Operator):
    bl_idname = "motus.ik_check"
    bl_label = "Check Reach"
    bl_description = "Look for the frames on which chains do not come to their targets"

    def steps(self, context, frames):
        rig = active_rig(context, self.object)
        if rig.library:
            raise targets.Refused(
                tr("{object} is linked from another file: make a library override of it first").format(object=rig.name))
        if rig.motus.ik.is_baked:
            raise targets.Refused(tr("{object} is baked: unbake it first").format(object=rig.name))
        entries = rig.motus.ik.entries
        self._chosen = [entries[targets.entry_for(rig, self.bone)]] if self.bone else list(entries)
        self._range = frames[0], frames[-1], self.step
        self._findings = {entry.name: _Finding() for entry in self._chosen}
        return self._walk(context, rig, frames)

    def result(self, context):
        for entry in self._chosen:
            finding = self._findings[entry.name]
            check_results.store(entry, self._range, finding.frames, finding.worst, finding.reason)
        bad = [entry for entry in self._chosen if entry.check_frames]
        for entry in bad:
            self.report({'WARNING'}, f"{entry.name}: " + check_results.sentence(
                entry, lambda value: status.length(context, value)))
        if not bad:
            self.report({'INFO'}, tr("{chains} chains reach their targets on all {frames} frames").format(
                chains=len(self._chosen), frames=self.total))

    def _walk(self, context, rig, frames):
        kept = Kept(context.scene, controls.animated_with(rig, self._chosen))
        depsgraph = context.view_layer.depsgraph
        try:
            for index, frame in enumerate(frames):
                go_to(context.scene, frame)
                evaluated = rig.evaluated_get(context.view_layer.depsgraph).motus.ik
                for entry in self._chosen:
                    now = evaluated.entries[entry.name]
                    found = status.report(rig, entry.name, depsgraph)
                    if found is None or now.is_muted or now.position_weight * evaluated.influence == 0.0:
                        continue
                    left, reason = status.fault(found, now)
                    if reason != 'NONE':
                        self._findings[entry.name].add(frame, left, reason)
                yield index + 1
        finally:
            kept.restore()


classes = (MOTUS_OT_ik_check,)
