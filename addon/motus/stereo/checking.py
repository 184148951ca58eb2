"""Operator that searches a range of frames for faults of a stereo rig that would strain an audience."""

import bpy

from ..core.blender.frames import Kept, go_to, ranges, spoken
from ..core.interface.operators import OBJECT_MODE, object_keyword
from ..core.interface.over_frames import OverFrames
from ..core.translations import tr
from . import judging, results, rig, samples, screens, targets


class _Found:
    """Faults and parallax of one camera, collected over the frames on which the camera is used."""

    def __init__(self, screen):
        self.screen = screen
        self.faults = {}
        """Frames with each kind of fault: {kind: [(frame, worst value on the frame)]}."""
        self.frames = []
        """Frames on which the camera was checked."""
        self.on_frames = []
        """results.OnFrame of each frame on which the camera's type let it be judged."""

    def add(self, scene, camera, depsgraph, frame):
        """Sample what the camera sees on the present frame, and add its parallax and its faults."""
        self.frames.append(frame)
        eyes, lens = rig.eyes(scene, camera, depsgraph)
        if eyes is None:
            return
        seen = judging.judge(
            eyes,
            lens,
            self.screen,
            rig.window(camera, depsgraph),
            rig.width_in_pixels(scene.render),
            *samples.take(scene, camera, depsgraph),
        )
        self.on_frames.append(results.OnFrame(frame, seen.parallax, eyes["convergence"], bool(seen.faults)))
        for kind, value in seen.faults.items():
            self.faults.setdefault(kind, []).append((frame, value))


class MOTUS_OT_stereo_check(OverFrames, bpy.types.Operator):
    bl_idname = "motus.stereo_check"
    bl_label = "Check Stereo"
    bl_description = (
        "Look for the frames on which the audience's eyes would have to turn apart, or something is cut off in one of them. If markers "
        "choose the scene's cameras, the camera of each frame is checked"
    )
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
        self._camera, self._found = camera, {camera: _Found(screens.of(camera.motus.stereo))}
        return self._walk(context, frames)

    def _walk(self, context, frames):
        scene = context.scene
        kept = Kept(scene, rig.all_rigs())
        try:
            for index, frame in enumerate(frames):
                go_to(scene, frame)
                camera = rig.shown(scene, self._camera)
                if camera not in self._found:
                    self._found[camera] = _Found(screens.of((camera if rig.has_rig(camera) else self._camera).motus.stereo))
                self._found[camera].add(scene, camera, context.view_layer.depsgraph, frame)
                yield index + 1
        finally:
            kept.restore()

    def result(self, context):
        told = []
        for camera, found in self._found.items():
            said = self._said(context.scene, found)
            told += said if len(self._found) == 1 else [f"{camera.name}: {sentence}" for sentence in said]
            results.keep(camera, said, "" if said else self._well(found.screen, found.frames), found.on_frames)
        for sentence in told:
            self.report({'WARNING'}, sentence)
        if not told:
            every = sorted(frame for found in self._found.values() for frame in found.frames)
            self.report({'INFO'}, self._well(screens.of(self._camera.motus.stereo), every))

    def _well(self, screen, frames):
        sentence = tr("No problems on a {width} m screen in {frames}")
        return sentence.format(width=f"{screen['width']:g}", frames=spoken(ranges(frames, self.step)))

    def _said(self, scene, found):
        pixels = rig.width_in_pixels(scene.render)
        return [
            judging.sentence(
                kind, max(value for _, value in faults), ranges([frame for frame, _ in faults], self.step), found.screen, pixels
            )
            for kind, faults in found.faults.items()
        ]


classes = (MOTUS_OT_stereo_check,)
