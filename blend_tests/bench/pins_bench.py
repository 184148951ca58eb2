"""What pins cost a frame, beside the same in plain numpy: ./motus bench, or with ./motus blender -b --python this file."""

import statistics
import sys
import time
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from table import Column, Table  # noqa: E402

import support  # noqa: E402  (found by the line above)

FRAMES = 12


def new_mesh(side):
    """A flat grid of side x side vertices, 2 m wide."""
    import numpy as np

    line = np.linspace(-1.0, 1.0, side, dtype=np.float32)
    x, y = np.meshgrid(line, line)
    places = np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3)
    index = np.arange(side * side, dtype=np.int32).reshape(side, side)
    corners = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).ravel()
    mesh = bpy.data.meshes.new("Bench")
    mesh.vertices.add(len(places))
    mesh.vertices.foreach_set("co", places.ravel())
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(len(corners) // 4)
    mesh.polygons.foreach_set("loop_start", np.arange(0, len(corners), 4, dtype=np.int32))
    if not mesh.polygons[0].is_property_readonly("loop_total"):  # since 4.0 it is told by loop_start
        mesh.polygons.foreach_set("loop_total", np.full(len(corners) // 4, 4, np.int32))
    mesh.update(calc_edges=True)
    return mesh, places


def pinned(side, count, radius, distance):
    """An object with so many pins whose strengths are keyed, spread over it; (object, positions, roots)."""
    import numpy as np

    support.empty_scene()
    mesh, places = new_mesh(side)
    obj = bpy.data.objects.new("Bench", mesh)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    roots = np.random.default_rng(1).integers(0, len(places), count)
    setup = support.addon("pull.pins.setup")
    wiring, rewire = support.addon("core.wiring"), setup.rewire
    setup.rewire = lambda owner: None  # once, at the end
    for root in roots.tolist():
        setup.add(obj, root, "Pin", {"radius": radius, "displacement": (0.0, 0.0, 0.1), "distance": distance})
    setup.rewire = rewire
    wiring.attach(setup.system(), obj)
    for pin in obj.motus.pull.pins:
        for frame, value in ((1, 0.0), (50, 1.0)):
            pin.strength = value
            pin.keyframe_insert("strength", frame=frame)
    return obj, places, roots


def frame_times():
    """Median milliseconds of going to a frame."""
    scene, times = bpy.context.scene, []
    scene.frame_set(1)
    for frame in range(2, 2 + FRAMES):
        start = time.perf_counter()
        scene.frame_set(frame)
        times.append(time.perf_counter() - start)
    return 1e3 * statistics.median(times)


def solve_time(obj):
    """Median milliseconds of the solve alone, with what is reached known, and of the first one."""
    import numpy as np

    solve, table = support.addon("pull.pins.solve"), support.addon("pull.pins.table")
    support.addon("pull.pins.shapes")._shapes.clear()
    offsets, times = np.zeros((len(obj.data.vertices), 3), np.float32), []
    for _ in range(FRAMES):
        start = time.perf_counter()
        offsets.fill(0.0)
        solve.displace(obj, obj.data, table.read(obj.motus.pull.pins), offsets)
        times.append(1e3 * (time.perf_counter() - start))
    return statistics.median(times[1:]), times[0]


def numpy_time(places, roots, radius, frames=3):
    """Median milliseconds of the same with numpy, which measures all distances on every frame."""
    import numpy as np

    times = []
    for _ in range(frames):
        start = time.perf_counter()
        out = places.copy()
        for root in roots:
            away = places - places[root]
            t = np.clip(1.0 - np.sqrt(np.einsum("ij,ij->i", away, away)) / radius, 0.0, 1.0)
            out[:, 2] += 0.1 * (3.0 * t * t - 2.0 * t * t * t)
        times.append(1e3 * (time.perf_counter() - start))
    return statistics.median(times)


def report(table, what, side, count, radius, distance):
    with table.guarded(what):
        obj, places, roots = pinned(side, count, radius, distance)
        solve, first = solve_time(obj)
        naive = numpy_time(places, roots, radius)
        table.row(what, frame_times(), solve, first, naive, naive / solve)


if __name__ == "__main__":
    support.enable()
    times = [Column(name, "ms", "9.2f") for name in ("frame", "solve", "first", "numpy")]
    table = Table("A frame with pins", *times, Column("numpy of solve", "x", "9.0f"), width=48)
    report(table, "100 pins, 100 k vertices, radius 5 %, straight", 316, 100, 0.1, 'STRAIGHT')
    report(table, "100 pins, 100 k vertices, radius 5 %, surface", 316, 100, 0.1, 'SURFACE')
    report(table, "4 pins, 1 M vertices, radius 5 %, straight", 1000, 4, 0.1, 'STRAIGHT')
    report(table, "4 pins, 1 M vertices, radius 20 %, straight", 1000, 4, 0.4, 'STRAIGHT')
