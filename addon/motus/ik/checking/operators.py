"""Operator that finds the frames on which chains do not reach their targets."""

import bpy

from ...core.blender.frames import Kept, go_to, ranges
from ...core.refusals import Refused, check_local
from ...core.translations import tr
from .. import status, targets
from ..frame_walk import OverFrames, active_rig
from ..goals import controls
from . import results


class _Finding:
    """Collects the results of checking one entry, one for each frame on which the entry is not muted."""

    def __init__(self):
        self._checked, self._short, self._unsolved, self._animated = [], [], [], []
        self._worst, self._reason = 0.0, 'NONE'

    def add(self, frame, left, reason):
        """Note the result of one frame. left: distance left to the target. reason: an item of results.WHY."""
        if reason == 'ANIMATED':
            self._animated.append(frame)
            return
        self._checked.append(frame)
        if reason == 'UNSOLVED':
            self._unsolved.append(frame)
        elif reason != 'NONE':
            self._short.append(frame)
            if left > self._worst:
                self._worst, self._reason = left, reason

    def store(self, entry, step):
        """Store the collected result in the settings of an entry. step: frames from one check to the next."""
        if self._unsolved:
            results.store(entry, self._checked, step, self._unsolved, reason='UNSOLVED')
        elif self._animated and not self._checked:
            results.store(entry, self._animated, step, reason='ANIMATED')
        else:
            results.store(entry, self._checked, step, self._short, self._worst, self._reason)


class MOTUS_OT_ik_check(OverFrames, bpy.types.Operator):
    bl_idname = "motus.ik_check"
    bl_label = "Check Reach"
    bl_description = "Look for the frames on which chains do not come to their targets"

    def steps(self, context, frames):
        rig = active_rig(context, self.object)
        check_local(rig)
        if rig.motus.ik.is_baked:
            raise Refused(tr("{object} is baked: unbake it first").format(object=rig.name))
        entries = rig.motus.ik.entries
        chosen = [entries[targets.entry_for(rig, self.bone)]] if self.bone else entries
        self._rig, self._range = rig, ranges(frames, self.step)
        self._findings = {entry.name: _Finding() for entry in chosen}
        return self._walk(context, rig, frames)

    def result(self, context):
        chosen = self._chosen(self._rig)
        for entry in chosen:
            self._findings[entry.name].store(entry, self.step)
        told = [entry for entry in chosen if entry.check_range]
        if not told:
            self.report({'INFO'}, tr("Muted chains are not checked"))
        told = self._without_good(told)
        # Blender shows the last report, so chains that miss their targets are reported last.
        for entry in sorted(told, key=lambda entry: bool(entry.check_frames)):
            self.report(
                {'WARNING' if entry.check_frames else 'INFO'},
                f"{entry.name}: " + results.sentence(entry, lambda value: status.length(context, value)),
            )

    def _chosen(self, rig):
        """IK entries of the rig that the operator checks. They are looked up by name each time, since a script may change the list."""
        return [rig.motus.ik.entries[name] for name in self._findings]

    def _without_good(self, told):
        """Entries that need a sentence of their own. Entries that reach their targets on all frames are reported here, in one sentence."""
        good = [entry for entry in told if entry.check_reason == 'NONE' and entry.check_range == self._range]
        if len(good) < 2:
            return told
        self.report({'INFO'}, tr("{chains} chains reach their targets on all frames {range}").format(chains=len(good), range=self._range))
        return [entry for entry in told if entry not in good]

    def _walk(self, context, rig, frames):
        kept = Kept(context.scene, controls.animated_with(rig, self._chosen(rig)))
        try:
            for index, frame in enumerate(frames):
                go_to(context.scene, frame)
                depsgraph = context.view_layer.depsgraph
                for now in self._chosen(rig.evaluated_get(depsgraph)):
                    found = status.report(rig, now.name, depsgraph)
                    if not now.is_muted:
                        self._findings[now.name].add(frame, *status.fault(found, now))
                yield index + 1
        finally:
            kept.restore()


classes = (MOTUS_OT_ik_check,)
