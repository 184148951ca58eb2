"""The library's bone spaces against Blender's own: convert_local_to_pose, and poses that Blender evaluates."""

import random
import unittest

import bpy
from mathutils import Euler, Matrix, Vector

import support

native = support.addon("core.native")
MODES = ('FULL', 'FIX_SHEAR', 'ALIGNED', 'AVERAGE', 'NONE', 'NONE_LEGACY')
# Single precision, and near a threshold of shear (1e-4) either of two results is right.
TOLERANCE = 2e-4


def random_vector(rng, size=1.0):
    return Vector([rng.uniform(-size, size) for _ in range(3)])


def random_scale(rng):
    sign = -1.0 if rng.random() < 0.3 else 1.0
    return Vector([sign * rng.uniform(0.4, 2.0), rng.uniform(0.4, 2.0), rng.uniform(0.4, 2.0)])


def random_transform(rng):
    rotation = Euler(random_vector(rng, 3.0)).to_matrix().to_4x4()
    return Matrix.Translation(random_vector(rng)) @ rotation @ Matrix.Diagonal(random_scale(rng)).to_4x4()


def rows(matrix):
    return [list(row) for row in matrix]


def new_rig(rng, bones):
    """A chain with branches; every other bone that can be is connected; modes and switches at random."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    for index in range(bones):
        bone = rig.data.edit_bones.new(f"Bone {index}")
        parent = rig.data.edit_bones[rng.randrange(max(0, index - 3), index)] if index else None
        connected = parent is not None and rng.random() < 0.5
        bone.head = parent.tail if connected else random_vector(rng)
        bone.tail = bone.head + random_vector(rng).normalized() * rng.uniform(0.3, 1.5)
        bone.roll = rng.uniform(-3.0, 3.0)
        bone.parent = parent
        bone.use_connect = connected
        bone.inherit_scale = rng.choice(MODES)
        bone.use_inherit_rotation = rng.random() < 0.7
        bone.use_local_location = rng.random() < 0.7
    bpy.ops.object.mode_set(mode='OBJECT')
    for bone in rig.pose.bones:
        bone.rotation_mode = 'XYZ'
        bone.location = random_vector(rng)
        bone.rotation_euler = Euler(random_vector(rng, 3.0))
        bone.scale = random_scale(rng) if rng.random() < 0.7 else Vector((1.0, 1.0, 1.0))
    return rig


class BoneSpaceTest(unittest.TestCase):
    def setUp(self):
        support.empty_scene()

    def assert_same(self, ours, blenders, message):
        size = max(1.0, *(abs(value) for row in blenders for value in row))
        worst = max(abs(a - b) for row, other in zip(ours, blenders) for a, b in zip(row, other))
        self.assertLess(worst, TOLERANCE * size, message)

    def test_convert_local_to_pose(self):
        rng = random.Random(3)
        rig = new_rig(rng, 2)
        bone = rig.data.bones[1]
        rest, parent_rest = bone.matrix_local, bone.parent.matrix_local
        for mode in MODES:
            for inherit_rotation in (True, False):
                for local_location in (True, False):
                    bone.inherit_scale = mode
                    bone.use_inherit_rotation = inherit_rotation
                    bone.use_local_location = local_location
                    for _ in range(20):
                        parent_pose = random_transform(rng) @ random_transform(rng)  # sheared
                        basis = random_transform(rng)
                        message = (mode, inherit_rotation, local_location)
                        wanted = bone.convert_local_to_pose(basis, rest, parent_matrix=parent_pose, parent_matrix_local=parent_rest)
                        pose = native.module.bone_to_pose(rows(rest), rows(parent_rest), rows(parent_pose), rows(basis), *message)
                        self.assert_same(pose, wanted, message)
                        back = native.module.pose_to_bone(rows(rest), rows(parent_rest), rows(parent_pose), pose, *message)
                        self.assert_same(back, basis, message)

    def test_evaluated_poses(self):
        rng = random.Random(5)
        checked = set()
        for _ in range(12):
            rig = new_rig(rng, 12)
            bpy.context.view_layer.update()
            for bone in rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones:
                rest, parent = bone.bone.matrix_local, bone.parent
                message = (bone.bone.inherit_scale, bone.bone.use_inherit_rotation, bone.bone.use_local_location)
                pose = native.module.bone_to_pose(
                    rows(rest), parent and rows(parent.bone.matrix_local), parent and rows(parent.matrix), rows(bone.matrix_basis), *message
                )
                self.assert_same(pose, bone.matrix, (*message, bone.bone.use_connect))
                checked.add((*message, bone.bone.use_connect))
        self.assertGreater(len(checked), 24)
        self.assertEqual({case[0] for case in checked}, set(MODES))
