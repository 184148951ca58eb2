"""Things that follow their animation, for the tests of dynamics."""

import bpy
import numpy as np

import support

STEP = {1: (0.0, 0.0, 0.0), 10: (0.0, 0.0, 0.0), 20: (3.0, 1.0, -0.5)}
FRAMES = (1, 8, 13.5, 20, 26, 31.25, 90)


def system():
    return support.addon("dynamics").SYSTEM


def native():
    return support.addon("core.native").module


link = support.link


def key(thing, path, rows, prefix="", interpolation=None):
    """Keys of a property: frame -> value."""
    for frame, value in rows.items():
        setattr(thing, path, value)
        thing.keyframe_insert(path, frame=frame)
    if interpolation:
        curves = support.addon("core.blender.actions").fcurves(thing.id_data)
        for curve in (one for one in curves if one.data_path == prefix + path):
            for point in curve.keyframe_points:
                point.interpolation = interpolation


def moved(name="Ball", rows=None, **keywords):
    """An empty that keys move."""
    obj = link(name)
    key(obj, "location", rows or STEP, **keywords)
    return obj


def add(obj, **keywords):
    """The entries that motus.dynamics_add makes."""
    bpy.ops.motus.dynamics_add(object=obj.name, **keywords)
    bpy.context.view_layer.update()
    return obj.motus.dynamics.entries


def go_to(frame):
    whole = int(frame // 1)
    bpy.context.scene.frame_set(whole, subframe=frame - whole)
    return bpy.context.evaluated_depsgraph_get()


def matrix(obj, frame, bone=""):
    """World matrix of an object or bone on a frame."""
    evaluated = obj.evaluated_get(go_to(frame))
    found = evaluated.matrix_world
    return np.array(found @ evaluated.pose.bones[bone].matrix if bone else found)


def place(obj, frame, bone=""):
    return matrix(obj, frame, bone)[:3, 3]


def tail(rig, frame, bone):
    evaluated = rig.evaluated_get(go_to(frame))
    return np.array(evaluated.matrix_world @ evaluated.pose.bones[bone].tail)


def problem(owner):
    return support.addon("core.wiring").problem(system(), owner, bpy.context.evaluated_depsgraph_get())


def filtered(values, numbers, frame, first=1, last=90, parts=16):
    """What values(frames) becomes on a frame: the filter itself, at rest on the first frame."""
    fps = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
    frames = np.arange(first * parts, last * parts + 1) / parts
    track = native().Track(native().SecondOrder(*numbers), frames / fps, values(frames))
    return track.evaluate(frame / fps)


def own(thing):
    """The own Transforms at frames."""
    return support.addon("core.tracks").own_track(thing).values


def rope(count=6, chains=1, name="Rope"):
    """A rig: a root bone, and chains of bones 0.3 m long up from its tail; the root is moved by keys."""
    rig = link(name, bpy.data.armatures.new(name))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    bones = rig.data.edit_bones
    root = bones.new("Root")
    root.head, root.tail = (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)
    for chain in range(chains):
        parent = root
        for index in range(count):
            bone = bones.new(f"Tail {chain} {index}")
            bone.parent = parent
            bone.head, bone.tail = (0.0, 0.5 * chain, 1.0 + 0.3 * index), (0.0, 0.5 * chain, 1.3 + 0.3 * index)
            parent = bone
    bpy.ops.object.mode_set(mode='OBJECT')
    key(rig.pose.bones["Root"], "location", {1: (0.0, 0.0, 0.0), 10: (0.0, 0.0, 0.0), 20: (2.0, 0.0, 0.0)})
    return rig
