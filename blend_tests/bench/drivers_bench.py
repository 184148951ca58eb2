"""A thousand properties driven by functions of Motus's, beside the same number by other expressions. Run by ./motus bench.

The scenes take turns in one process (costs.py). "rest" is a function of Python's that gives back the frame: what
Blender takes for a call before anything is computed.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from costs import frame_times  # noqa: E402
from sample_scenes import new_object  # noqa: E402
from table import Column, Table  # noqa: E402

import support  # noqa: E402  (found by the line above)

COUNT, ROUNDS = 1000, 9
KEYED = 45
EXPRESSIONS = {
    "none": None,
    "Blender's sin(frame*0.1)": "sin(frame*0.1)",
    "rest": "motus_bench_rest(frame)",
    "motus_pendulum": "motus_pendulum(frame, 0.5, {length})",
    "motus_double_pendulum": "motus_double_pendulum(frame, 0, 1, 2)",
    "motus_ease": "motus_ease(frame, 1, {length}*20)",
    "motus_noise": "motus_noise(frame, {length}, 3)",
    "motus_noise, looped": "motus_noise(frame, {length}, 3, 100)",
    "motus_steps": "motus_steps(frame, {length}, 3)",
    "motus_sine": "motus_sine(frame, {length})",
    "motus_sine, written out": "sin(2 * pi * (frame * {length} / 24))",
    "motus_second_order": 'motus_second_order(self, "location", 0, frame, {length}, 0.5, 1)',
}


def new_scene(expression):
    """A scene of its own with COUNT objects, one property each driven by the expression."""
    scene = bpy.data.scenes.new("Bench")
    bpy.context.window.scene = scene
    for index in range(COUNT):
        obj = new_object("Driven")
        if expression is None:
            continue
        driver = obj.driver_add("location", 2).driver
        driver.use_self = "self" in expression
        driver.expression = expression.format(length=1.0 + index % 50 / 50)
        if "self" in expression:
            for frame, place in ((1, 0.0), (KEYED, 3.0)):
                obj.location.x = place
                obj.keyframe_insert("location", index=0, frame=frame)
    return scene


def report(wanted):
    names = [name for name in EXPRESSIONS if not wanted or name == "none" or any(part in name for part in wanted)]
    support.empty_scene()
    bpy.app.driver_namespace["motus_bench_rest"] = lambda frame: frame
    scenes = [new_scene(EXPRESSIONS[name]) for name in names]
    rounds = np.array([[frame_times(scene) for scene in scenes] for _ in range(ROUNDS)]) / COUNT
    table = Table(f"One of {COUNT} driven properties, a frame", Column("each", "us", "9.2f", True), Column("each CPU", "us", "9.2f"))
    table.row("without any", rounds[:, 0, 0], np.median(rounds[:, 0, 1]))
    for index, name in enumerate(names[1:], start=1):
        added = rounds[:, index] - rounds[:, 0]
        table.row(name, added[:, 0], np.median(added[:, 1]))


if __name__ == "__main__":
    support.enable()
    bpy.context.preferences.filepaths.use_scripts_auto_execute = True
    report(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
