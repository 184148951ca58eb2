"""What the tests of inverse kinematics share: rigs of every make, and where their bones really stand."""

import itertools
import math

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

import support

ARM = ((0.0, 0.0, 1.0), (0.7, 0.15, 1.0), (1.3, 0.0, 1.0))
"""Joints of an arm that bends a little."""
REACHABLE = (0.6, 0.3, 1.4)


class IkTestCase(support.SceneTestCase):
    """An empty scene, and what one needs to reach for something in it."""

    def setUp(self):
        super().setUp()
        self.scene = bpy.context.scene
        self.system = support.addon("ik").SYSTEM
        self.wiring = support.addon("core.wiring")

    def rig(self, build, name="Rig"):
        """An armature whose bones `build(edit_bones)` makes; active, in Object Mode."""
        rig = self.link(name, bpy.data.armatures.new(name))
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        build(rig.data.edit_bones)
        bpy.ops.object.mode_set(mode='OBJECT')
        for bone in rig.pose.bones:
            bone.rotation_mode = 'QUATERNION'
        return rig

    def arm(self, joints=ARM, name="Rig", hand=True, **options):
        """Bones "Shoulder", "Bone 0", "Bone 1", ... through the joints, and "Hand" at their end."""

        def build(bones):
            shoulder = add_bone(bones, "Shoulder", (joints[0][0], joints[0][1], joints[0][2] - 0.5), joints[0])
            last = add_chain(bones, "Bone", joints, shoulder, **options)
            if hand:
                along = (Vector(joints[-1]) - Vector(joints[-2])).normalized() * 0.2
                add_bone(bones, "Hand", joints[-1], Vector(joints[-1]) + along, last)

        return self.rig(build, name)

    def target(self, place=REACHABLE, name="Target"):
        return self.link(name, None, place)

    def reach(self, bone="Bone 1", rig="Rig", target="Target", **keywords):
        """Adds the entry, with a target that is made where there is none of the name; gives it."""
        if target and target not in bpy.data.objects:
            self.target(name=target)
        self.assertEqual(bpy.ops.motus.ik_add(object=rig, bone=bone, target=target, **keywords), {'FINISHED'})
        return bpy.data.objects[rig].motus.ik.entries[bone]

    def evaluated(self, obj, frame=None):
        if frame is not None:
            self.go_to(frame)
        bpy.context.view_layer.update()
        return obj.evaluated_get(bpy.context.evaluated_depsgraph_get())

    def pose(self, rig, bone, frame=None):
        """Evaluated world matrix of a bone."""
        evaluated = self.evaluated(rig, frame)
        return evaluated.matrix_world @ evaluated.pose.bones[bone].matrix

    def poses(self, rig, frame=None):
        """Evaluated world matrices of all bones, as an array."""
        evaluated = self.evaluated(rig, frame)
        return np.array([evaluated.matrix_world @ bone.matrix for bone in evaluated.pose.bones])

    def local(self, rig, name):
        """A bone's own evaluated rotation."""
        bone = self.evaluated(rig).pose.bones[name]
        return rig.convert_space(pose_bone=bone, matrix=bone.matrix, from_space='POSE', to_space='LOCAL').to_quaternion()

    def tail(self, rig, bone="Bone 1", frame=None):
        evaluated = self.evaluated(rig, frame)
        return evaluated.matrix_world @ evaluated.pose.bones[bone].tail

    def head(self, rig, bone="Hand", frame=None):
        evaluated = self.evaluated(rig, frame)
        return evaluated.matrix_world @ evaluated.pose.bones[bone].head

    def output(self, rig, name, frame=None):
        self.evaluated(rig, frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        bone, _, output = name.rpartition(".")
        return getattr(support.addon("ik.status").report(rig, bone, depsgraph), output)

    def sentence(self, rig, bone="Bone 1", frame=None):
        """What the panel says of an entry."""
        self.evaluated(rig, frame)
        return support.addon("ik.status").sentence(bpy.context, rig, rig.motus.ik.entries[bone])[1]

    def assertNear(self, found, wanted, tolerance=2e-6):
        """Two places (or arrays), to a share of the largest number in them."""
        found, wanted = np.array(found), np.array(wanted)
        largest = max(1.0, np.abs(wanted).max())
        self.assertLessEqual(np.abs(found - wanted).max(), tolerance * largest, f"{found} instead of {wanted}")

    def assertSamePose(self, rig, wanted, tolerance=2e-6, frame=None):
        self.assertNear(self.poses(rig, frame), wanted, tolerance)

    def assertTurned(self, matrix, orientation, degrees=0.02):
        """A matrix has this orientation (single precision in degrees)."""
        angle = matrix.to_quaternion().rotation_difference(orientation).angle
        angle = min(angle, 2.0 * math.pi - angle)
        self.assertLessEqual(math.degrees(angle), degrees)


def add_bone(bones, name, head, tail, parent=None, connect=False, roll=0.0, **options):
    bone = bones.new(name)
    bone.head, bone.tail, bone.roll, bone.parent, bone.use_connect = head, tail, roll, parent, connect
    for option, value in options.items():
        setattr(bone, option, value)
    return bone


def add_chain(bones, name, joints, parent=None, connect=True, **options):
    """Bones from joint to joint; gives the last one."""
    for index, (head, tail) in enumerate(itertools.pairwise(joints)):
        parent = add_bone(bones, f"{name} {index}", head, tail, parent, connect and index > 0, **options)
    return parent


def tentacle(count=20, size=0.1):
    """Joints of a long chain that curves gently."""
    places = [Vector((0.0, 0.0, 0.0))]
    for index in range(count):
        angle = 0.04 * index
        places.append(places[-1] + size * Vector((math.sin(angle), 0.0, math.cos(angle))))
    return [tuple(place) for place in places]


def turn(bone, axis, angle):
    """Pose a bone by its own rotation."""
    bone.rotation_quaternion = Quaternion(axis, angle)


def state(obj):
    """All of a rig that a system could leave a trace in."""
    animation = obj.animation_data
    action = animation.action if animation else None
    curves = support.addon("core.blender.actions").fcurves(obj)
    return {
        "matrix": np.array(obj.matrix_world).tolist(),
        "bones": {
            bone.name: {
                "basis": np.array(bone.matrix_basis).tolist(),
                "mode": bone.rotation_mode,
                "constraints": [(one.type, one.name, one.influence, one.mute) for one in bone.constraints],
                "properties": sorted(bone.keys()),
                "limits": (bone.use_ik_limit_x, bone.ik_min_x, bone.lock_ik_x),
            }
            for bone in obj.pose.bones
        },
        "constraints": [(one.type, one.name) for one in obj.constraints],
        "properties": sorted(obj.keys()),
        "drivers": [curve.data_path for curve in animation.drivers] if animation else None,
        "action": action.name if action else None,
        "curves": [(curve.data_path, curve.array_index, len(curve.keyframe_points)) for curve in curves],
        "settings": obj.is_property_set("motus"),
    }


def counts():
    """How many datablocks there are of the kinds that a system makes."""
    return len(bpy.data.objects), len(bpy.data.meshes), len(bpy.data.actions)


def angle_between(first, second):
    """Degrees between two directions."""
    return math.degrees(Vector(first).angle(Vector(second)))


def rigid(place, axis=(0.0, 0.0, 1.0), angle=0.0, scale=(1.0, 1.0, 1.0)):
    """A world matrix."""
    return Matrix.LocRotScale(Vector(place), Quaternion(axis, angle), Vector(scale))
