"""What a stereo rig adds to a frame: cameras with keyed lenses and budgets, beside the same cameras alone. Run by ./motus bench.

The scenes take turns in one process (costs.py).
"""

import sys
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import costs  # noqa: E402  (found by the line above)
from sample_scenes import new_object  # noqa: E402
from table import Table  # noqa: E402

import support  # noqa: E402

COUNT = 50


def new_cameras(count=COUNT):
    """Cameras that move and zoom, and what they look at."""
    target = new_object("Target")
    found = []
    for index in range(count):
        camera = new_object("Camera", bpy.data.cameras.new("Camera"))
        for frame, place, lens in ((1, 0.0, 35.0), (50, 3.0, 70.0)):
            camera.location.x, camera.data.lens = place + index, lens
            camera.keyframe_insert("location", frame=frame)
            camera.data.keyframe_insert("lens", frame=frame)
        found.append((camera, target))
    return found


def by_object(pairs):
    for camera, target in pairs:
        target.location.z = -5.0
        bpy.ops.motus.stereo_rig_add(object=camera.name, focus=target.name)


def by_budget(pairs):
    for camera, _ in pairs:
        bpy.ops.motus.stereo_rig_add(object=camera.name, convergence='BUDGET')
        for frame, far in ((1, 10.0), (50, 30.0)):
            camera.motus.stereo.far = far
            camera.keyframe_insert("motus.stereo.far", frame=frame)


if __name__ == "__main__":
    support.enable()
    bpy.context.preferences.filepaths.use_scripts_auto_execute = True
    table = Table(f"Cost added to a frame by {COUNT} stereo rigs", *costs.COLUMNS)
    costs.report(table, (("an object's convergence", new_cameras, by_object, None), ("a keyed budget", new_cameras, by_budget, None)))
