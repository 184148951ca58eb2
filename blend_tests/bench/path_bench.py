"""Follow Path against Blender's own: frame time of many followers, and exactness. Run by ./motus bench."""

import statistics
import sys
import time
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import truth  # noqa: E402
from table import Column, Table  # noqa: E402

import support  # noqa: E402  (found by the line above)

CURVES = {
    "S curve": [(0, 0, 0), (3, 0, 0), (1, 4, 0), (4, 4, 0)],
    "hairpin": [(0, 0, 0), (8, 0, 0), (8, 0.5, 0), (0, 0.5, 0)],
    "climbing bend": [(0, 0, 0), (6, 0, 2), (6, 6, 4), (0, 6, 1)],
}
FRACTIONS = np.linspace(0.0, 1.0, 101)
FOLLOWERS = 1000
FRAMES = 40
MOMENTS = np.arange(1.0, 251.0, 0.125)
"""Frames at which what hangs on a follower reads its motion."""


def empty_scene():
    support.empty_scene()
    return bpy.context.scene


def make_curve(points, resolution=12):
    curve = bpy.data.curves.new("Course", 'CURVE')
    curve.dimensions = '3D'
    curve.resolution_u = resolution
    curve.use_path = True
    spline = curve.splines.new('BEZIER')
    spline.bezier_points.add(1)
    for point, (before, co, after) in zip(spline.bezier_points, ((points[0], points[0], points[1]), (points[2], points[3], points[3]))):
        point.handle_left_type = point.handle_right_type = 'FREE'
        point.handle_left, point.co, point.handle_right = before, co, after
    obj = bpy.data.objects.new("Course", curve)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def make_objects(count):
    objects = [bpy.data.objects.new(f"Car {index:04}", None) for index in range(count)]
    for obj in objects:
        bpy.context.scene.collection.objects.link(obj)
    return objects


def add_blender_follow_path(obj, curve, fraction):
    constraint = obj.constraints.new('FOLLOW_PATH')
    constraint.target = curve
    constraint.use_fixed_location = True
    constraint.use_curve_follow = True
    constraint.offset_factor = fraction
    return constraint


def frame_milliseconds(scene):
    for frame in range(1, 6):
        scene.frame_set(frame)
    samples = []
    for frame in range(6, 6 + FRAMES):
        start = time.perf_counter()
        scene.frame_set(frame)
        samples.append(time.perf_counter() - start)
    return statistics.median(samples) * 1e3


def blender_frame_time():
    scene = empty_scene()
    curve = make_curve(CURVES["climbing bend"])
    for index, obj in enumerate(make_objects(FOLLOWERS)):
        curve_driver = add_blender_follow_path(obj, curve, 0.0).driver_add("offset_factor").driver
        curve_driver.expression = f"frame*0.002+{index}*0.0005"
    return frame_milliseconds(scene)


def blender_animated_path_time():
    """The cheapest set-up Blender has: the curve's evaluation time is keyed once for all, offsets are constant."""
    scene = empty_scene()
    curve = make_curve(CURVES["climbing bend"])
    curve.data.path_duration = 200
    curve.data.driver_add("eval_time").driver.expression = "frame"
    for index, obj in enumerate(make_objects(FOLLOWERS)):
        constraint = obj.constraints.new('FOLLOW_PATH')
        constraint.target = curve
        constraint.use_curve_follow = True
        constraint.offset = -0.1 * index
    return frame_milliseconds(scene)


def motus_frame_time():
    scene = empty_scene()
    curve = make_curve(CURVES["climbing bend"])
    names = ",".join(obj.name for obj in make_objects(FOLLOWERS))
    bpy.ops.motus.path_train_add(objects=names, curve=curve.name, gap=0.01, timing='SPEED', speed=1.0, extend='LOOP', orientation='BANKING')
    return frame_milliseconds(scene)


def over_time():
    """Seconds in which the motion of a follower is computed at all MOMENTS, the median of five."""
    scene = empty_scene()
    curve = make_curve(CURVES["climbing bend"])
    (obj,) = make_objects(1)
    bpy.ops.motus.path_follow_add(object=obj.name, curve=curve.name, orientation='BANKING')
    samples = []
    for _ in range(5):
        track, start = support.addon("core.tracks").world_track(obj, scene), time.perf_counter()
        track.values(MOMENTS)
        samples.append(time.perf_counter() - start)
    return statistics.median(samples)


def evaluated_positions(obj, set_fraction):
    found = []
    for fraction in FRACTIONS:
        set_fraction(float(fraction))
        obj.update_tag()
        graph = bpy.context.evaluated_depsgraph_get()
        graph.update()
        found.append(obj.evaluated_get(graph).matrix_world.translation[:])
    return np.array(found)


def blender_positions(points, resolution):
    empty_scene()
    curve = make_curve(points, resolution)
    (obj,) = make_objects(1)
    constraint = add_blender_follow_path(obj, curve, 0.0)
    return evaluated_positions(obj, lambda fraction: setattr(constraint, "offset_factor", fraction))


def motus_positions(points):
    empty_scene()
    curve = make_curve(points)
    (obj,) = make_objects(1)
    bpy.ops.motus.path_follow_add(object=obj.name, curve=curve.name, timing='MANUAL', extend='CLAMP')
    return evaluated_positions(obj, lambda fraction: setattr(obj.motus.path, "distance_factor", fraction))


def errors(found, exact, length):
    """(largest position error, largest deviation of a step) as fractions of the length and of the mean step."""
    steps = np.linalg.norm(np.diff(found, axis=0), axis=1)
    exact_steps = np.linalg.norm(np.diff(exact, axis=0), axis=1)
    return (np.linalg.norm(found - exact, axis=1).max() / length, np.abs(steps / exact_steps - 1.0).max())


def native_positions(points):
    curve = support.addon("core.native").module.Bezier(np.array(points, float))
    return curve.position_at_length(FRACTIONS * curve.length())


def report_exactness():
    table = Table(
        "Exactness at 101 equal distances, largest errors",
        Column("position / length", "", "9.1e"),
        Column("step / step", "", "9.1e"),
        Column("of the largest coordinate", "", "9.1e"),
        Column("better than Blender's default", "x", "9.2g"),
        width=52,
    )
    for name, points in CURVES.items():
        exact, length = truth.positions_at_fractions(points, FRACTIONS)
        rows = {
            "Motus library (double)": native_positions(points),
            "Motus on the object (float32)": motus_positions(points),
            "Blender Follow Path, resolution 12": blender_positions(points, 12),
            "Blender Follow Path, resolution 64": blender_positions(points, 64),
        }
        reference = errors(rows["Blender Follow Path, resolution 12"], exact, length)[0]
        for what, found in rows.items():
            position_error, step_error = errors(found, exact, length)
            off = np.abs(found - exact).max() / np.abs(exact).max()
            table.row(f"{name}: {what}", position_error, step_error, off, reference / max(position_error, 1e-17))


def report_frame_time():
    rows = {
        f"Blender Follow Path x {FOLLOWERS}, one keyed path": blender_animated_path_time(),
        f"Blender Follow Path x {FOLLOWERS}, driven one by one": blender_frame_time(),
        f"Motus train x {FOLLOWERS}, banking": motus_frame_time(),
    }
    reference = next(iter(rows.values()))
    table = Table(
        f"Frame time, {FOLLOWERS} followers on one curve", Column("frame", "ms", "9.2f"), Column("of Blender", "x", "9.2f"), width=52
    )
    for what, value in rows.items():
        table.row(what, value, value / reference)


def report_over_time():
    table = Table(f"Motion of one follower at {len(MOMENTS)} moments, for what hangs on it", Column("all", "ms", "9.2f"), width=52)
    table.row("Motus follower, banking", over_time() * 1e3)


if __name__ == "__main__":
    support.enable()
    report_frame_time()
    report_over_time()
    report_exactness()
