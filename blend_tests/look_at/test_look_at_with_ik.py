"""Look At and inverse kinematics on one rig: each is solved after what it stands on or looks at."""

import math

import bpy

from look_at.look_at_cases import LookAtTestCase

REACHED = 2e-5  # m
HIT = 5e-3  # degrees
FRAMES = [1, 31, 16, 7.5, 24, 3, 29]


class WithIk(LookAtTestCase):
    def setUp(self):
        super().setUp()
        self.grip = self.link("Grip")
        for frame, place in ((1, (0.55, -0.25, 1.2)), (31, (0.35, -0.4, 1.5))):
            self.grip.location = place
            self.grip.keyframe_insert("location", frame=frame)
        for frame, yaw in ((1, -50), (31, 50)):
            self.aim(yaw, 5, 2.0)
            self.target.keyframe_insert("location", frame=frame)

    def reach(self, **keywords):
        status = bpy.ops.motus.ik_add(object="Rig", bone="LowerArm.L", target="Grip", chain_length=2, **keywords)
        self.assertEqual(status, {'FINISHED'})

    def tip(self):
        length = self.rig.data.bones["LowerArm.L"].length
        pose = self.pose("LowerArm.L")
        return pose.translation + length * pose.to_3x3().col[1]

    def left(self):
        """Metres between hand and grip."""
        return (self.tip() - self.grip.matrix_world.translation).length

    def assert_all_frames(self, check):
        played = {}
        for frame in range(1, 32):
            self.go_to(frame)
            check(frame)
            played[frame] = self.poses()
        for frame in FRAMES:
            self.go_to(frame)
            check(frame)
            if frame in played:
                self.assertSamePoses(self.poses(), played[frame], 2e-7)

    def test_an_arm_on_a_chest_that_turns(self):
        def check(frame):
            self.assertLess(self.left(), REACHED, f"frame {frame}")
            self.assertLess(self.off("Head"), HIT, f"frame {frame}")

        for first in ("look", "reach"):
            with self.subTest(first):
                self.look(body_weight=0.6) if first == "look" else self.reach()
                self.reach() if first == "look" else self.look(body_weight=0.6)
                self.assert_all_frames(check)
                bpy.ops.motus.look_at_remove(object="Rig", bone="Head")
                bpy.ops.motus.ik_remove(object="Rig", bone="LowerArm.L")
                self.assertFalse([bone.name for bone in self.rig.pose.bones if bone.constraints])

    def test_a_head_that_looks_at_the_hand(self):
        self.reach()
        self.look(target="Rig", target_bone="LowerArm.L", body_length=1, clamp=0.0, head_limit=math.pi)

        def check(frame):
            self.assertLess(self.left(), REACHED, f"frame {frame}")
            way = self.pose("LowerArm.L").translation - self.pose("Head").translation
            self.assertLess(math.degrees(self.gaze("Head").angle(way)), HIT, f"frame {frame}")

        self.assert_all_frames(check)

    def test_a_hand_cannot_be_looked_at_by_the_spine_that_carries_it(self):
        self.reach()
        self.assertRefused(
            "moves with Head", bpy.ops.motus.look_at_add, object="Rig", bone="Head", target="Rig", target_bone="LowerArm.L", body_length=3
        )

    def test_bones_of_a_chain_are_refused(self):
        self.reach()
        self.assertRefused(
            "UpperArm.L is driven by", bpy.ops.motus.look_at_add, object="Rig", bone="UpperArm.L", target="Target", body_length=0
        )
        self.look()
        self.assertRefused("Chest is driven by", bpy.ops.motus.ik_add, object="Rig", bone="LowerArm.L", target="Grip", chain_length=3)
