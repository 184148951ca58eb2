"""Scenes as artists have them, a few of everything, beside Blender's own constraints. Run by ./motus bench.

Each row is one scene: the cost that the systems, or Blender's constraints in their place, add to a frame of the same objects
without any. The scenes of a row take turns in one process (costs.py).
"""

import sys
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import dynamics_bench  # noqa: E402  (found by the line above)
import stereo_bench  # noqa: E402
import walker_bench  # noqa: E402
from costs import FRAMES, costs, nothing  # noqa: E402
from sample_scenes import new_curve, new_object  # noqa: E402
from table import Column, Table  # noqa: E402

import support  # noqa: E402

FOLLOWERS, RIGS, LIMBS, OWNERS = 50, 10, 4, 10
LEAST_COST = 0.001
"""Ms: of less nothing is a multiple that says anything."""


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
        "characters": new_characters(3),
    }


def mixed_by_motus(parts):
    follow_by_motus(parts["singles"])
    names, curve = ",".join(obj.name for obj, _ in parts["train"]), parts["train"][0][1]
    bpy.ops.motus.path_train_add(objects=names, curve=curve.name, gap=0.5, timing='SPEED', speed=1.0, extend='LOOP', orientation='BANKING')
    reach_by_motus(parts["characters"])
    look_by_motus(parts["characters"])


def mixed_by_blender(parts):
    follow_by_blender(parts["singles"])
    follow_by_blender(parts["train"])
    reach_by_blender(parts["characters"])
    look_by_blender(parts["characters"])


def pendulums_by_motus(_made):
    for index in range(OWNERS):
        bpy.ops.motus.pendulum_add(kind='SINGLE', location=(index, 0.0, 0.0), angle1=0.3 + 0.1 * index)


def new_characters(count):
    return [new_character(3.0 * index) for index in range(count)]


def look_by_motus(characters):
    for rig, goals in characters:
        bpy.ops.motus.look_at_add(object=rig.name, bone="head", target=goals[LIMBS].name, body_length=2)


def look_by_blender(characters):
    for rig, goals in characters:
        for name, share in (("chest", 0.15), ("neck", 0.15), ("head", 1.0)):
            constraint = rig.pose.bones[name].constraints.new('DAMPED_TRACK')
            constraint.target, constraint.track_axis, constraint.influence = goals[LIMBS], 'TRACK_Z', share


def layer(characters):
    """A layer each, of a copy of the rig's own action."""
    for rig, _ in characters:
        action = rig.animation_data.action.copy()
        bpy.ops.motus.layer_add(object=rig.name, action=action.name, mask='ALL', start=1.0, after='REPEAT', weight=0.7)


def snow(_made):
    for index in range(OWNERS):
        bpy.ops.motus.snow_add(rate=200.0, lifetime=5.0, location=(3.0 * index, 0.0, 5.0), use_steering=True)


MIXED = "12 followers, train, 3 characters"
SCENES = {  # what is there, what Motus and Blender add to it, and the wanted ms of Motus
    "one follower": (lambda: new_followers(1, 1), follow_by_motus, follow_by_blender, 0.06),
    f"{FOLLOWERS} followers, one curve": (lambda: new_followers(FOLLOWERS, 1), follow_by_motus, follow_by_blender, 0.5),
    f"{FOLLOWERS} followers, {FOLLOWERS} curves": (
        lambda: new_followers(FOLLOWERS, FOLLOWERS),
        follow_by_motus,
        follow_by_blender,
        2.0,
    ),
    "one rig, four limbs": (lambda: new_characters(1), reach_by_motus, reach_by_blender, 0.15),
    f"{RIGS} rigs, four limbs each": (lambda: new_characters(RIGS), reach_by_motus, reach_by_blender, 1.3),
    f"{OWNERS} pendulums": (lambda: None, pendulums_by_motus, nothing, 0.3),
    MIXED: (new_mixed, mixed_by_motus, mixed_by_blender, 1.5),
    f"{OWNERS} look-ats": (lambda: new_characters(OWNERS), look_by_motus, look_by_blender, 1.2),
    f"{OWNERS} rigs with a layer": (lambda: new_characters(OWNERS), layer, nothing, 1.0),
    f"{OWNERS} objects with dynamics": (lambda: dynamics_bench.new_objects(OWNERS), dynamics_bench.follow, nothing, 0.9),
    f"{OWNERS} walkers": (lambda: walker_bench.new_spiders(OWNERS), walker_bench.walk, nothing, 4.5),
    f"{OWNERS} emitters of 1000 flakes": (lambda: None, snow, nothing, 1.8),
    f"{OWNERS} stereo rigs": (lambda: stereo_bench.new_cameras(OWNERS), stereo_bench.by_object, nothing, 0.28),
}


def report(wanted):
    table = Table(
        "Cost added to a frame: medians of rounds in which the scenes take turns",
        Column("bare", "ms", "9.2f"),
        Column("Blender", "ms"),
        Column("Blender CPU", "ms"),
        Column("Motus", "ms", has_rounds=True),
        Column("Motus CPU", "ms"),
        Column("of Blender", "x", "9.2f"),
        Column("goal", ""),
        rows="scene",
    )
    for name, (make, motus, blender, goal) in SCENES.items():
        if wanted and not any(part in name for part in wanted):
            continue
        with table.guarded(name):
            bare, (ours, by_blender) = costs(make, motus, blender)
            wall, cpu = (None, None) if blender is nothing else np.median(by_blender, axis=0)
            ratio = np.median(ours[:, 0]) / wall if wall is not None and wall >= LEAST_COST else None
            table.row(name, np.median(bare[:, 0]), wall, cpu, ours[:, 0], np.median(ours[:, 1]), ratio, goal)


if __name__ == "__main__":
    support.enable()
    report(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
