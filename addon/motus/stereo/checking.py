"""The operator that looks through the frames for what an audience would suffer from."""

import bpy

from ..core.frames import Kept, go_to, ranges
from ..core.operators import OBJECT_MODE, object_keyword
from ..core.over_frames import OverFrames
from ..core.translations import tr
from . import judging, results, rig, samples, screens, targets


class MOTUS_OT_stereo_check(OverFrames, bpy.types.Operator):
    bl_idname = "motus.stereo_check"
    bl_label = "Check Stereo"
    bl_description = (
        "Look for the frames on which the audience's eyes would have to turn apart, or something is cut off in one of them")
    bl_options = {'REGISTER'}
    modes = OBJECT_MODE
    needs_native = True

    object: object_keyword("Name of the camera; empty takes the active one, or the scene's")

    @classmethod
    def check_offer(cls, context):
        targets.rig_for(context, "")

    def steps(self, context, frames):
        camera = targets.rig_for(context, self.object)
        targets.check_solved(context, camera)
        self._camera, self._faults, self._parallax = camera, {}, []
        return self._walk(context, camera, frames)

    def _walk(self, context, camera, frames):
        scene, screen = context.scene, screens.of(camera.motus.stereo)
        pixels = rig.width_in_pixels(scene.render)
        kept = Kept(scene, (camera,))
        try:
            for index, frame in enumerate(frames):
                go_to(scene, frame)
                depsgraph = context.view_layer.depsgraph
                eyes, lens = rig.eyes(scene, camera, depsgraph)
                if eyes is not None:
                    found = judging.judge(eyes, lens, screen, pixels, *samples.take(scene, camera, depsgraph))
                    self._parallax.append(found.parallax)
                    for kind, value in found.faults.items():
                        self._faults.setdefault(kind, []).append((frame, value))
                yield index + 1
        finally:
            kept.restore()

    def result(self, context):
        screen = screens.of(self._camera.motus.stereo)
        pixels = rig.width_in_pixels(context.scene.render)
        told = []
        for kind, faults in self._faults.items():
            frames, values = zip(*faults)
            told.append(judging.sentence(kind, max(values), ranges(frames, self.step), screen, pixels))
        results.keep(self._camera, told, self._parallax)
        for sentence in told:
            self.report({'WARNING'}, sentence)
        if not told:
            self.report({'INFO'}, tr("All is well on a {width} m screen").format(width=f"{screen['width']:g}"))


classes = (MOTUS_OT_stereo_check,)
