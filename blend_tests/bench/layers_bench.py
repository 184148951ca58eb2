"""Animation layers: what they add to a frame of a rig that its own action animates. Run by ./motus bench.

The scenes take turns in one process, as in ik_bench.py.
"""

import statistics
import sys
import time
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from table import Column, Table  # noqa: E402

import support  # noqa: E402  (found by the line above)

BONES, KEYS, FRAMES, ROUNDS = 200, 10, 60, 7


def new_rig():
    """A rig of chains of ten bones."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    parent = None
    for index in range(BONES):
        bone = rig.data.edit_bones.new(f"b{index}")
        bone.head, bone.tail = (index // 10, index % 10, 0.0), (index // 10, index % 10 + 0.9, 0.0)
        bone.parent = parent if index % 10 else None
        parent = bone
    bpy.ops.object.mode_set(mode='OBJECT')
    for bone in rig.pose.bones:
        bone.rotation_mode = 'QUATERNION'
    return rig


def key(rig, name, seed):
    """Give the rig an action with keys of location and rotation on all bones; returns it."""
    generator = np.random.default_rng(seed)
    rig.animation_data_clear()
    rig.pose.bones[0].keyframe_insert("location", frame=1)
    bag = support.addon("core.blender.actions").assign_copy(rig, name)
    for curve in list(bag.fcurves):
        bag.fcurves.remove(curve)
    for bone in rig.pose.bones:
        for path, size in (("location", 3), ("rotation_quaternion", 4)):
            for index in range(size):
                curve = bag.fcurves.new(f'{bone.path_from_id()}.{path}', index=index)
                curve.keyframe_points.add(KEYS)
                points = np.column_stack((np.linspace(1.0, 61.0, KEYS), generator.uniform(-0.5, 0.5, KEYS)))
                points[:, 1] += path == "rotation_quaternion" and index == 0
                curve.keyframe_points.foreach_set("co", points.astype(np.float32).ravel())
                curve.update()
    action = rig.animation_data.action
    action.name, action.use_fake_user = name, True
    return action


def build(layers, **keywords):
    """A scene with so many layers on a rig."""
    scene = bpy.data.scenes.new("Bench")
    bpy.context.window.scene = scene
    rig = new_rig()
    actions = [key(rig, f"Layer {seed}", seed) for seed in range(layers)]
    key(rig, "Own", 99)
    for action in actions:
        bpy.ops.motus.layer_add(object=rig.name, action=action.name, mask='ALL', start=1.0, after='REPEAT', weight=0.7, **keywords)
    return scene


def milliseconds(scene):
    """Of a frame, the median of one round."""
    bpy.context.window.scene = scene
    found = []
    for frame in range(1, FRAMES):
        start = time.perf_counter()
        scene.frame_set(frame)
        found.append(1e3 * (time.perf_counter() - start))
    return statistics.median(found)


def main():
    support.enable()
    rows = (
        ("none", 0, {}),
        ("1 layer", 1, {}),
        ("3 layers", 3, {}),
        ("8 layers", 8, {}),
        ("3 additive layers", 3, {"mode": 'ADDITIVE'}),
        ("3 layers, steady", 3, {"in_armature": True}),
    )
    scenes = [(name, build(count, **keywords)) for name, count, keywords in rows]
    taken = {name: [] for name, _ in scenes}
    for _ in range(ROUNDS):
        for name, scene in scenes:
            taken[name].append(milliseconds(scene))
    title = f"A frame of a rig of {BONES} bones: the median frame of the best of {ROUNDS} rounds"
    table = Table(title, Column("frame", "ms", "9.2f"), Column("added", "ms", "9.2f"), rows="layers")
    bare = min(taken["none"])
    for name, found in taken.items():
        table.row(name, min(found), None if name == "none" else min(found) - bare)


if __name__ == "__main__":
    main()
