"""Scenes as artists have them, a few of everything, beside Blender's own constraints. Run by ./motus bench.

Each row is one scene: the cost that the systems, or Blender's constraints in their place, add to a frame of the same objects
without any. The scenes of a row take turns in one process, as in ik_bench.py.
"""

import statistics
import sys
import time
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import support  # noqa: E402  (found by the line above)

FRAMES = 40
FEWEST_ROUNDS, SECONDS = 7, 5.0
FOLLOWERS, RIGS, LIMBS, PENDULUMS = 50, 10, 4, 10
LEAST_COST = 0.001
"""Ms: of less nothing is a multiple that says anything."""


def new_object(name, data=None):
    obj = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def new_curve(place=0.0):
    """A bend of 18 m whose path is evaluated along with the frames."""
    data = bpy.data.curves.new("Course", 'CURVE')
    data.dimensions = '3D'
    spline = data.splines.new('BEZIER')
    spline.bezier_points.add(1)
    for point, x in zip(spline.bezier_points, (0.0, 12.0)):
        point.handle_left_type = point.handle_right_type = 'FREE'
        point.co = (x, place, 0.25 * x)
        point.handle_left, point.handle_right = (x - 4.0, place - 6.0, 0.25 * x), (x + 4.0, place + 6.0, 0.25 * x)
    data.path_duration = 200
    data.driver_add("eval_time").driver.expression = "frame"
    return new_object("Course", data)


def new_followers(count, curves):
    """(follower, curve) pairs; each follower takes the next of the curves, in turns."""
    courses = [new_curve(2.0 * index) for index in range(curves)]
    return [(new_object("Car"), courses[index % curves]) for index in range(count)]


def follow_by_motus(pairs):
    for index, (obj, curve) in enumerate(pairs):
        bpy.ops.motus.path_follow_add(
            object=obj.name,
            curve=curve.name,
            timing='SPEED',
            speed=1.0 + 0.05 * index,
            offset=0.1 * index,
            extend='LOOP',
            orientation=('BANKING', 'WORLD_UP')[index % 2],
        )


def follow_by_blender(pairs):
    for index, (obj, curve) in enumerate(pairs):
        constraint = obj.constraints.new('FOLLOW_PATH')
        constraint.target, constraint.use_curve_follow, constraint.offset = curve, True, -1.0 * index


def new_character(place):
    """A rig of four limbs of two bones with hands, a spine of three and a head, keyed; a target a limb and one to look at."""
    rig = new_object("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')

    def bone(name, head, tail, parent=None):
        made = rig.data.edit_bones.new(name)
        made.head, made.tail = head, tail
        made.parent = rig.data.edit_bones.get(parent) if parent else None

    bone("hips", (place, 0.0, 1.0), (place, 0.0, 1.2))
    bone("chest", (place, 0.0, 1.2), (place, 0.0, 1.5), "hips")
    bone("neck", (place, 0.0, 1.5), (place, 0.0, 1.6), "chest")
    bone("head", (place, 0.0, 1.6), (place, 0.0, 1.8), "neck")
    for index in range(LIMBS):
        is_arm, side = index < 2, 1.0 - 2.0 * (index % 2)
        x, z = place + side * 0.2, 1.5 if is_arm else 1.0
        joints = [(x, 0.0, z), (x, 0.04, z - 0.45), (x, 0.0, z - 0.9), (x, -0.15, z - 0.9)]
        for part, parent in ((0, "chest" if is_arm else "hips"), (1, f"limb{index}.0"), (2, f"limb{index}.1")):
            bone(f"limb{index}.{part}", joints[part], joints[part + 1], parent)
    bpy.ops.object.mode_set(mode='OBJECT')
    for bone in rig.pose.bones:
        bone.rotation_mode = 'QUATERNION'
        for frame, turn in ((1, 0.0), (FRAMES + 5, 0.2)):
            bone.rotation_quaternion = (1.0, turn, 0.0, 0.0)
            bone.keyframe_insert("rotation_quaternion", frame=frame)
    goals = []
    for index in range(LIMBS + 1):
        goal = new_object("Goal")
        if index == LIMBS:
            goal.location = (place, -3.0, 1.7)
        else:
            goal.location = (place + 0.2 - 0.4 * (index % 2), -0.1, 0.8 if index < 2 else 0.25)
        for frame in (1, FRAMES + 5):
            goal.location.x += 0.1
            goal.keyframe_insert("location", frame=frame)
        goals.append(goal)
    return rig, goals


def reach_by_motus(characters):
    for rig, goals in characters:
        for index in range(LIMBS):
            bpy.ops.motus.ik_add(object=rig.name, bone=f"limb{index}.1", target=goals[index].name, chain_length=2)


def reach_by_blender(characters):
    for rig, goals in characters:
        for index in range(LIMBS):
            constraint = rig.pose.bones[f"limb{index}.1"].constraints.new('IK')
            constraint.target, constraint.chain_count = goals[index], 2


def new_mixed():
    """Twelve that follow two curves, a train of twenty, and three characters that reach and look."""
    return {
        "singles": new_followers(12, 2),
        "train": new_followers(20, 1),
        "characters": [new_character(3.0 * index) for index in range(3)],
    }


def mixed_by_motus(parts):
    follow_by_motus(parts["singles"])
    names, curve = ",".join(obj.name for obj, _ in parts["train"]), parts["train"][0][1]
    bpy.ops.motus.path_train_add(objects=names, curve=curve.name, gap=0.5, timing='SPEED', speed=1.0, extend='LOOP', orientation='BANKING')
    reach_by_motus(parts["characters"])
    for rig, goals in parts["characters"]:
        bpy.ops.motus.look_at_add(object=rig.name, bone="head", target=goals[LIMBS].name, body_length=2)


def mixed_by_blender(parts):
    follow_by_blender(parts["singles"])
    follow_by_blender(parts["train"])
    reach_by_blender(parts["characters"])
    for rig, goals in parts["characters"]:
        for name, share in (("chest", 0.15), ("neck", 0.15), ("head", 1.0)):
            constraint = rig.pose.bones[name].constraints.new('DAMPED_TRACK')
            constraint.target, constraint.track_axis, constraint.influence = goals[LIMBS], 'TRACK_Z', share


def pendulums_by_motus(_made):
    for index in range(PENDULUMS):
        bpy.ops.motus.pendulum_add(kind='SINGLE', location=(index, 0.0, 0.0), angle1=0.3 + 0.1 * index)


def nothing(_made):
    pass


SCENES = {
    "one follower": (lambda: new_followers(1, 1), follow_by_motus, follow_by_blender),
    f"{FOLLOWERS} followers, one curve": (lambda: new_followers(FOLLOWERS, 1), follow_by_motus, follow_by_blender),
    f"{FOLLOWERS} followers, {FOLLOWERS} curves": (lambda: new_followers(FOLLOWERS, FOLLOWERS), follow_by_motus, follow_by_blender),
    "one rig, four limbs": (lambda: [new_character(0.0)], reach_by_motus, reach_by_blender),
    f"{RIGS} rigs, four limbs each": (lambda: [new_character(3.0 * index) for index in range(RIGS)], reach_by_motus, reach_by_blender),
    f"{PENDULUMS} pendulums": (lambda: None, pendulums_by_motus, nothing),
    "12 followers, train, 3 characters": (new_mixed, mixed_by_motus, mixed_by_blender),
}


def frame_microseconds(scene):
    samples = []
    for frame in range(1, FRAMES + 6):
        begin = time.perf_counter()
        scene.frame_set(frame)
        samples.append(time.perf_counter() - begin)
    # Not the median: where other programs have the processor meanwhile, most frames of several threads are cut into.
    return statistics.quantiles(samples[5:], n=10)[0] * 1e6


def costs(make, *ways):
    """Frame times, us, each the first decile of a round, (rounds, 1 + ways): of what `make` makes as it is, and with what each of the ways adds to it."""
    support.empty_scene()
    scenes = []
    for add in (nothing, *ways):
        scenes.append(bpy.data.scenes.new("Bench"))
        bpy.context.window.scene = scenes[-1]
        add(make())
    begin, rounds = time.perf_counter(), []
    while len(rounds) < FEWEST_ROUNDS or time.perf_counter() - begin < SECONDS:
        rounds.append([frame_microseconds(scene) for scene in scenes])
    return np.array(rounds)


def report(wanted):
    print(f"| Cost added to a frame, ms, Blender {bpy.app.version_string}: medians of rounds in which the scenes take turns,")
    print("| the least of them, and their upper quartile. Bare: the same objects without either.")
    print(f"| {'scene':36} {'bare':>7} {'Blender':>9} {'Motus':>9} {'least':>7} {'upper':>7} {'of Blender':>11}")
    for name, (make, motus, blender) in SCENES.items():
        if wanted and not any(part in name for part in wanted):
            continue
        rounds = costs(make, motus, blender) / 1e3
        extra = rounds[:, 1:] - rounds[:, :1]
        low, median, high = np.percentile(extra[:, 0], (0, 50, 75))
        by_blender = np.median(extra[:, 1])
        ratio = f"{median / by_blender:10.2f}x" if by_blender >= LEAST_COST else f"{'-':>11}"
        print(f"| {name:36} {np.median(rounds[:, 0]):7.2f} {by_blender:9.3f} {median:9.3f} {low:7.3f} {high:7.3f} {ratio}")


if __name__ == "__main__":
    support.enable()
    report(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
