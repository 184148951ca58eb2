"""Operator that measures the nearest and farthest depth that a camera sees.

Over several frames it keys both as smooth curves that change before the depths do.
"""

import bpy

from ..core import native
from ..core.blender import actions
from ..core.blender.frames import Kept, go_to
from ..core.interface.operators import OBJECT_MODE
from ..core.interface.over_frames import OverFrames
from ..core.interface.rows import Row, Rows, is_not
from ..core.measures import scene_time
from ..core.refusals import Refused
from ..core.translations import tr
from . import samples, targets
from .operators import LEFT_OUT, OfARig
from .rig import PREFIX

NAMES = "near", "far"


class MOTUS_OT_stereo_measure(OfARig, OverFrames, bpy.types.Operator):
    bl_idname = "motus.stereo_measure"
    bl_label = "Measure Depth"
    bl_description = "Set near and far of the depth budget to what the camera sees; over several frames as keys"
    modes = OBJECT_MODE
    needs_native = True

    left_out: bpy.props.FloatProperty(
        name="Left Out",
        description="Share of the picture that does not count at either end: small things that are very near or very far",
        default=100.0 * LEFT_OUT,
        min=0.0,
        max=49.0,
        subtype='PERCENTAGE',
    )
    ahead: bpy.props.IntProperty(
        name="Look Ahead",
        description="Least number of samples by which near and far change ahead of their cause",
        default=12,
        min=0,
        max=10000,
        soft_max=100,
    )
    redo = (*OverFrames.redo, Rows(("left_out", Row("ahead", when=is_not("range", 'CURRENT')))))

    def steps(self, context, frames):
        camera = targets.rig_for(context, self.object)
        targets.check_removable(camera)
        share = 0.01 * self.left_out
        self._camera, self._found = camera, []
        return self._walk(context, camera, frames, share)

    def _walk(self, context, camera, frames, share):
        kept = Kept(context.scene, (camera,))
        try:
            for index, frame in enumerate(frames):
                go_to(context.scene, frame)
                found = samples.depth_range(context.scene, camera, context.view_layer.depsgraph, share)
                if found:
                    self._found.append((frame, *found))
                yield index + 1
        finally:
            kept.restore()

    def result(self, context):
        if not self._found:
            raise Refused(tr("The camera sees nothing that has a depth"))
        settings = self._camera.motus.stereo
        frames, near, far = zip(*self._found)
        if self.total == 1:
            settings.near, settings.far = near[0], samples.beyond(near[0], far[0])
            return
        actions.make_local(self._camera)
        near = native.module.smooth_ahead(near, self.ahead, "below")
        far = native.module.smooth_ahead(far, self.ahead, "above")
        for frame, *values in zip(frames, near, map(samples.beyond, near, far)):
            for name, value in zip(NAMES, values):
                setattr(settings, name, value)
                self._camera.keyframe_insert(PREFIX + name, frame=scene_time.keys_time(context.scene, frame))
        context.scene.frame_set(context.scene.frame_current, subframe=context.scene.frame_subframe)


classes = (MOTUS_OT_stereo_measure,)
