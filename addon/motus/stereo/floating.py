"""Floating window: edges of the picture that stand in front of the screen, so that they cut nothing off in one eye alone.

The left eye's picture is black along its left edge, and the right eye's along its right edge, as wide as the parallax of what the edge
would cut off: the edge then has this parallax itself. Mendiburu, "3D Movie Making" (2009), ch. 5.
"""

import bpy

from ..core import native
from ..core.animation import fitted_keys
from ..core.blender import actions
from ..core.blender.frames import Kept, go_to, ranges, spoken
from ..core.interface.operators import OBJECT_MODE, object_keyword
from ..core.interface.over_frames import OverFrames
from ..core.interface.rows import Row, Rows, is_not
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import Refused
from ..core.tracks import moving_numbers
from ..core.translations import tr
from . import keying, rig, samples, targets
from .judging import HIDDEN_PIXELS
from .solve import PERCENT

NAMES = "window_left", "window_right"
ACCURACY = 0.02
"""Largest distance of the keyed curves from the smooth ones, in percent of the image's width."""


def at(context, camera, frame):
    """Parallax (left, right) of the edges of a camera's floating window at a frame of the scene, as fractions of the image's width."""
    paths = [rig.PREFIX + name for name in NAMES]
    moving = moving_numbers(camera, tuple(paths), scene_time.keys_time(context.scene, frame))
    return [PERCENT * moving.get(path, getattr(camera.motus.stereo, name)) for path, name in zip(paths, NAMES)]


def masked(left, right, left_edge, right_edge):
    """Pictures of both eyes, (height, width, 3), with the floating window in black.

    left_edge, right_edge: parallax of the window's edges, fractions of the width. A column that is masked in part is darkened in part.
    """
    width = left.shape[1]
    column = np.arange(width)[:, None]
    return (
        left * np.clip(column + 1.0 - left_edge * width, 0.0, 1.0),
        right * np.clip(width - column - right_edge * width, 0.0, 1.0),
    )


class MOTUS_OT_stereo_window(OverFrames, bpy.types.Operator):
    bl_idname = "motus.stereo_window"
    bl_label = "Float Window"
    bl_description = (
        "Move the left and right edge of the picture in front of what they would cut off in one eye alone; over several frames by few keys. "
        "Combine Pair masks both eyes by it"
    )
    modes = OBJECT_MODE
    needs_native = True

    object: object_keyword("Name of the camera; empty takes the active one, or the scene's")
    ahead: keying.ahead_keyword("Least number of samples by which the window moves ahead of its cause")
    redo = (*OverFrames.redo, Rows((Row("ahead", when=is_not("range", 'CURRENT')),)))

    @classmethod
    def check_offer(cls, context):
        targets.check_removable(targets.rig_for(context, ""))

    def steps(self, context, frames):
        camera = targets.rig_for(context, self.object)
        targets.check_removable(camera)
        targets.check_solved(context, camera)
        self._camera, self._frames, self._found = camera, frames, []
        return self._walk(context, camera, frames)

    def _walk(self, context, camera, frames):
        scene, depsgraph = context.scene, context.view_layer.depsgraph
        tolerance = HIDDEN_PIXELS / rig.width_in_pixels(scene.render)
        kept = Kept(scene, (camera,))
        try:
            for index, frame in enumerate(frames):
                go_to(scene, frame)
                eyes, _ = rig.eyes(scene, camera, depsgraph)
                x, depths = samples.take(scene, camera, depsgraph)
                self._found.append(native.module.window_violations(x, depths, **eyes, tolerance=tolerance))
                yield index + 1
        finally:
            kept.restore()

    def result(self, context):
        settings, edges = self._camera.motus.stereo, np.array(self._found).T / PERCENT
        if edges.max() > settings.bl_rna.properties[NAMES[0]].hard_max:
            raise Refused(tr("Something is so near that the window would hide the picture: lessen the parallax first"))
        if self.total == 1:
            settings.window_left, settings.window_right = edges[:, 0]
            return
        actions.make_local(self._camera)
        times = [scene_time.keys_time(context.scene, frame) for frame in self._frames]
        count = 0
        for name, values in zip(NAMES, edges):
            smooth = native.module.smooth_ahead(values, self.ahead, "above")
            count += keying.write(self._camera, name, times, smooth, ACCURACY, fitted_keys.ABOVE)
        keying.show(context.scene)
        self.report({'INFO'}, tr("{count} keys for {frames}").format(count=count, frames=spoken(ranges(self._frames, self.step))))


classes = (MOTUS_OT_stereo_window,)
