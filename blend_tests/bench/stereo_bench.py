"""What a stereo rig adds to a frame: cameras with keyed lenses and budgets, beside the same cameras alone. Run by ./motus bench.

The scenes take turns in one process, as in typical_bench.py.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from typical_bench import costs, new_object  # noqa: E402

import support  # noqa: E402  (found by the line above)

COUNT = 50


def new_cameras():
    """Cameras that move and zoom, and what they look at."""
    target = new_object("Target")
    found = []
    for index in range(COUNT):
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


def report():
    rounds = costs(new_cameras, by_object, by_budget)
    print(f"| {COUNT} stereo rigs, us each a frame, Blender {bpy.app.version_string}")
    for name, column in zip(("an object's convergence", "a keyed budget"), (rounds[:, 1:] - rounds[:, :1]).T / COUNT):
        print(f"| {name:24} {np.median(column):7.2f}  least {column.min():6.2f}")


if __name__ == "__main__":
    support.enable()
    bpy.context.preferences.filepaths.use_scripts_auto_execute = True
    report()
