"""Matching the animated pose of chains to their solution, measured on evaluated poses."""

import math

import bpy
import numpy as np
from mathutils import Quaternion

import support
from ik.matching.ik_match_cases import FEW, MANY, MatchTestCase


class FkMatchesIk(MatchTestCase):
    def moving(self, **keywords):
        """An animated arm that reaches for a moving target."""
        rig = self.animated_arm()
        target = self.target()
        for frame, place in ((1, (0.6, 0.3, 1.4)), (15, (0.3, -0.7, 0.8)), (30, (-0.5, 0.4, 1.6))):
            target.location = place
            target.keyframe_insert("location", frame=frame)
        self.reach(keywords.pop("bone", "Bone 1"), **keywords)
        return rig

    def test_own_animation_is_the_solution(self):
        for mode in ('QUATERNION', 'YZX', 'AXIS_ANGLE'):
            with self.subTest(mode):
                self.setUp()
                rig = self.arm()
                for bone in rig.pose.bones:
                    bone.rotation_mode = mode
                self.animate(rig)
                self.target()
                self.reach("Hand", use_tail=False, rotation_weight=0.5)
                before = self.recorded(rig)
                self.match("fk_match_ik")
                bpy.ops.motus.ik_remove(object="Rig")
                self.assertRecorded(rig, before, 1e-5)

    def test_small_angles_about_an_axis(self):
        """An arc cosine would lose what is below 5e-4 rad."""
        values = support.addon("ik.keying").rotation_values
        bone = self.arm().pose.bones["Bone 0"]
        bone.rotation_mode = 'AXIS_ANGLE'
        for wanted in (1e-5, 1e-4, 2e-3, 1.0, 3.0):
            found = values(bone, Quaternion((0.0, 0.6, 0.8), wanted), (0.0, 0.0, 1.0, 0.0))
            self.assertAlmostEqual(found[0], wanted, delta=3e-7)
            self.assertNear(found[1:], (0.0, 0.6, 0.8), 1e-3)
        self.assertEqual(values(bone, Quaternion(), (0.0, 0.0, 1.0, 0.0)), (0.0, 0.0, 1.0, 0.0))
        turned = values(bone, Quaternion((0.0, 0.6, 0.8), 0.2), (6.3, 0.0, 0.6, 0.8))
        self.assertAlmostEqual(turned[0], 0.2 + 2.0 * math.pi, places=5)

    def test_continuous(self):
        rig = self.moving()
        self.match("fk_match_ik")
        actions = support.addon("core.blender.actions")
        for name in ("Bone 0", "Bone 1"):
            values = np.array(
                [
                    [actions.find(rig, f'pose.bones["{name}"].rotation_quaternion', index).evaluate(frame) for index in range(4)]
                    for frame in range(1, 31)
                ]
            )
            self.assertGreater((values[1:] * values[:-1]).sum(axis=1).min(), 0.5)

    def test_between_keys_before_the_range_too(self):
        """A key before the range has the same sign, so that nothing spins on the way."""
        rig = self.arm()
        bone = rig.pose.bones["Bone 0"]
        bone.rotation_quaternion = (-1.0, 0.0, 0.0, 0.0)
        bone.keyframe_insert("rotation_quaternion", frame=1)
        self.reach()
        self.match("fk_match_ik", frame_start=5, frame_end=10)
        curve = support.addon("core.blender.actions").find(rig, 'pose.bones["Bone 0"].rotation_quaternion', 0)
        self.assertLess(curve.evaluate(5), 0.0)

    def test_frames_between_kept_keys_stay(self):
        """Handles of the keys next to the range do not go by what is keyed there."""
        for keys, frames in ((FEW, (11, 30)), (FEW, (20, 25)), (FEW, (1, 5)), (MANY, (11, 30)), (MANY, (20, 25))):
            for handles in ('AUTO_CLAMPED', 'AUTO'):
                with self.subTest(f"{len(keys)} keys, {frames}, {handles}"):
                    self.setUp()
                    self.assertFramesStay(
                        "fk_match_ik", self.moving(), 'pose.bones["Bone 0"].rotation_quaternion', keys, frames, handles=handles
                    )

    def test_switch_leaves_the_pose(self):
        rig = self.moving(position_weight=0.6, rotation_weight=0.3)
        before = self.recorded(rig)
        self.match("fk_match_ik", switch=True)
        entry = rig.motus.ik.entries["Bone 1"]
        self.assertEqual((entry.position_weight, entry.rotation_weight), (0.0, 0.0))
        self.assertRecorded(rig, before, 1e-5)

    def test_stretched(self):
        rig = self.moving(stretch=1.0)
        bpy.data.objects["Target"].location = (3.0, 0.0, 1.0)
        bpy.data.objects["Target"].keyframe_insert("location", frame=30)
        names = ("Bone 0", "Bone 1", "Hand")
        before = {frame: [self.pose(rig, name, frame) for name in names] for frame in (1, 20, 30)}
        self.assertGreater(before[30][2].translation.x, 2.9)
        self.match("fk_match_ik")
        bpy.ops.motus.ik_remove(object="Rig")
        for frame, poses in before.items():
            for name, wanted in zip(names, poses):
                self.assertNear(self.pose(rig, name, frame), wanted, 1e-4)

    def test_there_and_back(self):
        rig = self.moving()
        before = self.recorded(rig)
        self.match("fk_match_ik", switch=True)
        for curve in list(support.addon("core.blender.actions").fcurves(bpy.data.objects["Target"])):
            support.addon("core.blender.actions").fcurves(bpy.data.objects["Target"]).remove(curve)
        bpy.data.objects["Target"].location = (0.0, 5.0, 0.0)
        self.match("ik_match_fk", switch=True)
        self.assertRecorded(rig, before, 1e-5)

    def test_refusals(self):
        rig = self.animated_arm()
        self.reach()
        rig.pose.bones["Bone 0"].driver_add("rotation_quaternion", 1)
        self.assertRefused("Bone 0 is moved by a driver", bpy.ops.motus.fk_match_ik, object="Rig")

    def test_driven_weight_cannot_be_switched(self):
        rig = self.animated_arm()
        self.reach()
        rig.driver_add("motus.ik.entries[0].position_weight").driver.expression = "1"
        for operator in (bpy.ops.motus.fk_match_ik, bpy.ops.motus.ik_match_fk):
            self.assertRefused("weights of Bone 1 are driven", operator, object="Rig", switch=True)
