"""Whole frames of snow at several numbers of flakes, a jump to a far frame, and covers of several sizes. Run by ./motus bench.

The cost is what the snow adds to a frame of an empty scene, and a cover to one of the same scene without it; the scenes take
turns in one process, as in costs.py.
"""

import sys
import time
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from table import Column, Table  # noqa: E402

import support  # noqa: E402  (found by the line above)

COUNTS = (5_000, 100_000, 1_000_000)
KINDS = (  # name, settings
    ("points", {"look": 'POINTS'}),
    ("points, own ways", {"look": 'POINTS', "steering_per_flake": True}),
    ("flake", {"look": 'FLAKE'}),
)
LIFETIME = 5.0
FIRST, FRAMES, ROUNDS = 200, 12, 7
FAR = 5000
# Snow steering and wind; flakes that have no lifetimes of their own, so that their number is exact.
KEYWORDS = {"use_steering": True, "random_size": True, "tumble": 2.0, "drag": 0.5, "wind": (1.0, 0.0, -1.0), "gusts": 0.3}
FIELD = 40.0
RESOLUTIONS = 0.5, 0.15
"""m: of a square field, and of the layers that lie on it."""
LANDING = {"rate": 500.0, "lifetime": 3.0, "start_speed": 3.0, "emitter_radius": 0.5 * FIELD, "location": (0.0, 0.0, 3.0)}


def new_scene():
    bpy.context.window.scene = bpy.data.scenes.new("Bench")
    return bpy.context.scene


def snowing(count, settings):
    scene = new_scene()
    bpy.ops.motus.snow_add(rate=count / LIFETIME, lifetime=LIFETIME, emitter_radius=20.0, **KEYWORDS, **settings)
    return scene


def field(resolution=None):
    """A scene where flakes land on a field; with the resolution of a layer the snow lies there."""
    scene = new_scene()
    bpy.ops.mesh.primitive_plane_add(size=FIELD)
    ground = bpy.context.object.name
    bpy.ops.motus.snow_add(collider=ground, **LANDING)
    if resolution:
        bpy.ops.motus.snow_cover_add(surfaces=ground, resolution=resolution)
    return scene


def vertex_count(scene):
    """Of the cover that was added last."""
    bpy.context.window.scene = scene
    scene.frame_set(FIRST)
    return len(bpy.context.object.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices)


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


def added(bare, other):
    """Milliseconds that a scene's frame costs more than a bare one's, a number a round."""
    rounds = np.array([[milliseconds(one, FIRST) for one in (bare, other)] for _ in range(ROUNDS)])
    return rounds[:, 1] - rounds[:, 0]


def report(wanted):
    def is_wanted(name):
        return not wanted or any(part in name for part in wanted)

    added_column = Column("added", "ms", has_rounds=True)
    title = f"Cost that snow adds to a frame; a jump to frame {FAR} beside one to frame {1 + FIRST}"
    table = Table(title, added_column, Column("far", "ms"), Column("near", "ms"))
    for kind, settings in KINDS:
        for count in COUNTS:
            name = f"{count:,} flakes, {kind}"
            if is_wanted(name):
                with table.guarded(name):
                    support.empty_scene()
                    bare, other = new_scene(), snowing(count, settings)
                    table.row(name, added(bare, other), *jump(other))
    table = Table("Cost that a cover adds to a frame", added_column, Column("vertices", "", "9.0f"))
    for resolution in RESOLUTIONS:
        name = f"cover, resolution {resolution:g} m"
        if is_wanted(name):
            with table.guarded(name):
                support.empty_scene()
                bare, other = field(), field(resolution)
                vertices = vertex_count(other)
                table.row(name, added(bare, other), vertices)


if __name__ == "__main__":
    support.enable()
    report(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
