"""Whole frames of snow at several numbers of flakes, and a jump to a far frame. Run by ./motus bench.

The cost is what the snow adds to a frame of an empty scene; the scenes take turns in one process, as in typical_bench.py.
"""

import sys
import time
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import support  # noqa: E402  (found by the line above)

COUNTS = (5_000, 100_000, 1_000_000)
KINDS = (  # name, settings
    ("points", {"look": 'POINTS'}), ("points, own ways", {"look": 'POINTS', "snow_offsets": True}), ("flake", {"look": 'FLAKE'}))
LIFETIME = 5.0
FIRST, FRAMES, ROUNDS = 200, 12, 7
FAR = 5000
# Snow steering and wind; flakes that have no lifetimes of their own, so that their number is exact.
KEYWORDS = {"snow": True, "random_size": True, "tumble": 2.0, "drag": 0.5, "wind": (1.0, 0.0, -1.0),
            "gusts": 0.3}


def new_scene(count, settings):
    scene = bpy.data.scenes.new("Bench")
    bpy.context.window.scene = scene
    if count:
        bpy.ops.motus.snow_add(rate=count / LIFETIME, lifetime=LIFETIME, cone_radius=20.0, **KEYWORDS, **settings)
    return scene


def milliseconds(scene, first):
    samples = []
    bpy.context.window.scene = scene
    scene.frame_set(first - 1)
    for frame in range(first, first + FRAMES):
        begin = time.perf_counter()
        scene.frame_set(frame)
        samples.append(time.perf_counter() - begin)
    return 1e3 * float(np.quantile(samples, 0.1))


def jump(scene):
    """Milliseconds of a jump to a far frame and of one back, each the least of some."""
    bpy.context.window.scene = scene
    found = {FAR: [], 1 + FIRST: []}
    for _ in range(ROUNDS):
        for frame, samples in found.items():
            begin = time.perf_counter()
            scene.frame_set(frame)
            samples.append(time.perf_counter() - begin)
    return [1e3 * min(samples) for samples in found.values()]


def report(wanted):
    print(f"| Cost that snow adds to a frame, ms, Blender {bpy.app.version_string}: medians of rounds in which the scenes take")
    print(f"| turns, the least of them, and a jump to frame {FAR} beside one to frame {1 + FIRST}.")
    print(f"| {'scene':30} {'median':>8} {'least':>8} {'far':>8} {'near':>8}")
    for kind, settings in KINDS:
        for count in COUNTS:
            name = f"{count:,} flakes, {kind}"
            if wanted and not any(part in name for part in wanted):
                continue
            support.empty_scene()
            bare, snowing = new_scene(0, settings), new_scene(count, settings)
            rounds = np.array([[milliseconds(one, FIRST) for one in (bare, snowing)] for _ in range(ROUNDS)])
            extra = rounds[:, 1] - rounds[:, 0]
            far, near = jump(snowing)
            print(f"| {name:30} {np.median(extra):8.3f} {extra.min():8.3f} {far:8.3f} {near:8.3f}")


if __name__ == "__main__":
    support.enable()
    report(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
