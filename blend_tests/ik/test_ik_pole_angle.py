"""Pole Angle from Pose: a pole that is chosen moves nothing, wherever it stands."""

import math
import random

import bpy
from mathutils import Vector

from ik.ik_cases import ARM, IkTestCase, tentacle

EXACT = 1e-6
PLACES = ((0.5, -2.0, 1.5), (0.6, 2.0, 0.2), (-1.0, 0.4, 3.0), (0.9, 0.1, -2.0))


class PoleAngle(IkTestCase):
    def pole(self, place, name="Pole"):
        return bpy.data.objects.get(name) or self.link(name, None, place)

    def find(self, **keywords):
        return bpy.ops.motus.ik_pole_angle(object="Rig", bone="Bone 1", **keywords)

    def test_a_new_pole_moves_nothing(self):
        generator = random.Random(3)
        for joints in (ARM, [(0.0, 0.0, 1.0), (0.6, 0.4, 1.1), (1.0, 0.0, 1.5)]):
            for place in PLACES:
                with self.subTest(joints=joints, place=place):
                    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
                    self.scene = bpy.context.scene
                    rig = self.arm(joints)
                    rig.location = [generator.uniform(-1.0, 1.0) for _ in range(3)]
                    rig.rotation_euler = [generator.uniform(-2.0, 2.0) for _ in range(3)]
                    rig.pose.bones["Bone 0"].rotation_quaternion = (0.9, 0.1, 0.3, -0.2)
                    self.target(rig.matrix_world @ Vector((0.6, 0.3, 1.4)))
                    self.reach()
                    before = self.poses(rig)
                    self.pole(rig.matrix_world @ Vector(place))
                    self.assertEqual(self.find(pole="Pole"), {'FINISHED'})
                    entry = rig.motus.ik.entries[0]
                    self.assertEqual(entry.pole, bpy.data.objects["Pole"])
                    self.assertSamePose(rig, before, EXACT)

    def test_one_pole_after_another_moves_nothing(self):
        rig = self.arm()
        self.reach(pole=self.pole(PLACES[0]).name, bend='AWAY', pole_angle=0.4)
        before = self.poses(rig)
        self.pole(PLACES[2], "Other")
        self.assertEqual(self.find(pole="Other"), {'FINISHED'})
        self.assertSamePose(rig, before, EXACT)

    def test_the_present_pole_is_turned_to_the_animated_plane(self):
        rig = self.arm()
        entry = self.reach()
        plain = self.poses(rig)
        for place in PLACES:
            for bend in ('TOWARDS', 'AWAY'):
                with self.subTest(place=place, bend=bend):
                    self.pole(place).location = place
                    entry.pole, entry.bend, entry.pole_angle = bpy.data.objects["Pole"], bend, 0.2
                    self.assertGreater(abs(self.poses(rig) - plain).max(), 1e-3)
                    self.assertEqual(self.find(), {'FINISHED'})
                    self.assertSamePose(rig, plain, EXACT)
                    self.assertLessEqual(abs(entry.pole_angle), math.pi)

    def test_long_chains_scaled_and_mirrored_rigs(self):
        for scale in ((1.0, 1.0, 1.0), (2.0, 2.0, 2.0), (-1.0, 1.0, 1.0)):
            with self.subTest(scale):
                bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
                self.scene = bpy.context.scene
                rig = self.arm(tentacle(8, 0.2), hand=False)
                rig.scale = scale
                self.target(rig.matrix_world @ Vector((0.5, 0.3, 1.0)))
                bpy.context.view_layer.update()
                self.reach("Bone 6", chain_length=6)
                before = self.poses(rig)
                self.pole(PLACES[1])
                self.assertEqual(bpy.ops.motus.ik_pole_angle(object="Rig", bone="Bone 6", pole="Pole"), {'FINISHED'})
                self.assertSamePose(rig, before, 5.0 * EXACT)

    def test_what_is_selected_becomes_the_pole(self):
        rig = self.arm()
        self.reach()
        before = self.poses(rig)
        pole = self.pole(PLACES[0])
        rig.select_set(True)
        pole.select_set(True)
        bpy.context.view_layer.objects.active = rig
        rig.data.bones.active = rig.data.bones["Bone 1"]
        self.assertEqual(bpy.ops.motus.ik_pole_angle(), {'FINISHED'})
        self.assertEqual(rig.motus.ik.entries[0].pole, pole)
        self.assertSamePose(rig, before, EXACT)

    def test_refusals(self):
        rig = self.arm()
        self.reach()
        with self.assertRaisesRegex(RuntimeError, "has no pole"):
            self.find()
        with self.assertRaisesRegex(RuntimeError, "moves with the chain"):
            self.find(pole="Rig", pole_bone="Hand")
        pole = self.pole(PLACES[0])
        target = bpy.data.objects["Target"]
        target.parent, target.parent_type, target.parent_bone = rig, 'BONE', "Hand"
        bpy.ops.motus.refresh(object="Rig", system="ik")
        with self.assertRaisesRegex(RuntimeError, "moves with the chain itself"):
            self.find(pole=pole.name)
        self.assertIsNone(rig.motus.ik.entries[0].pole)
