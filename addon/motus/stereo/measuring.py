"""Operator that measures the nearest and farthest depth that a camera sees.

Over several frames it keys both, by the fewest keys, as smooth curves that change before the depths do.
"""

import bpy

from ..core import native
from ..core.animation import fitted_keys
from ..core.blender import actions
from ..core.blender.frames import Kept, go_to, ranges, spoken
from ..core.interface.operators import OBJECT_MODE
from ..core.interface.over_frames import OverFrames
from ..core.interface.rows import Row, Rows, is_not
from ..core.measures import scene_time
from ..core.refusals import Refused
from ..core.translations import tr
from . import keying, samples, targets
from .operators import LEFT_OUT, OfARig

SIDES = {"near": fitted_keys.BELOW, "far": fitted_keys.ABOVE}
"""On which side of the measured depths the curves of the settings stay."""


class MOTUS_OT_stereo_measure(OfARig, OverFrames, bpy.types.Operator):
    bl_idname = "motus.stereo_measure"
    bl_label = "Measure Depth"
    bl_description = "Set near and far of the depth budget to what the camera sees; over several frames as few keys"
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
    ahead: keying.ahead_keyword("Least number of samples by which near and far change ahead of their cause")
    tolerance: bpy.props.FloatProperty(
        name="Tolerance",
        description="Largest distance of the keyed curves from near and far, in percent of the least depth; more needs fewer keys",
        default=1.0,
        min=0.0,
        max=100.0,
        soft_max=10.0,
        subtype='PERCENTAGE',
    )
    redo = (
        *OverFrames.redo,
        Rows(("left_out", *(Row(name, when=is_not("range", 'CURRENT')) for name in ("ahead", "tolerance")))),
    )

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
        times = [scene_time.keys_time(context.scene, frame) for frame in frames]
        count = 0
        for (name, side), values in zip(SIDES.items(), (near, list(map(samples.beyond, near, far)))):
            count += keying.write(self._camera, name, times, values, 0.01 * self.tolerance * min(values), side)
        keying.show(context.scene)
        self.report({'INFO'}, tr("{count} keys for {frames}").format(count=count, frames=spoken(ranges(frames, self.step))))


classes = (MOTUS_OT_stereo_measure,)
