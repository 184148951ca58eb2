"""Inverse kinematics on evaluated rigs: the tip is where it should be, and the chain bends where it should."""

import math

import bpy
import numpy as np
from mathutils import Quaternion, Vector

import support
from ik.ik_cases import ARM, REACHABLE, IkTestCase, add_chain, angle_between, rigid, tentacle, turn


class Reach(IkTestCase):
    def test_tail_and_head(self):
        rig = self.arm()
        self.reach()
        self.assertNear(self.tail(rig), REACHABLE)
        bpy.ops.motus.ik_remove(object="Rig")
        self.reach("Hand", use_tail=False)
        self.assertNear(self.head(rig), REACHABLE)

    def test_bones_keep_their_lengths_and_the_target_is_followed(self):
        rig = self.arm()
        target = self.target()
        self.reach()
        for place in ((0.2, 0.2, 1.1), (-0.4, 0.9, 0.6), (0.0, 0.0, 2.2), (1.2, 0.1, 1.0)):
            target.location = place
            self.assertNear(self.tail(rig), place)
            bones = self.evaluated(rig).pose.bones
            for bone in (bones["Bone 0"], bones["Bone 1"]):
                self.assertAlmostEqual((bone.tail - bone.head).length, bone.bone.length, places=6)

    def test_rigs_anywhere(self):
        """Moved, turned, scaled evenly and unevenly, mirrored in one bone's rest, parented."""
        for scale in ((1.0, 1.0, 1.0), (2.5, 2.5, 2.5), (1.0, 1.3, 0.8)):
            with self.subTest(scale=scale):
                support.empty_scene()
                self.scene = bpy.context.scene
                rig = self.arm()
                carrier = self.link("Carrier")
                carrier.matrix_world = rigid((3.0, -2.0, 1.0), (1.0, 2.0, 3.0), 0.8)
                rig.parent = carrier
                rig.matrix_local = rigid((0.2, 0.3, 0.4), (0.0, 1.0, 1.0), -1.1, scale)
                turn(rig.pose.bones["Shoulder"], (1.0, 0.0, 0.3), 0.4)
                turn(rig.pose.bones["Bone 0"], (0.0, 1.0, 0.3), 0.4)
                bpy.context.view_layer.update()
                place = rig.matrix_world @ Vector((0.5, 0.3, 1.2))
                self.target(place)
                self.reach()
                self.assertNear(self.tail(rig), place, 5e-6)

    def test_unconnected_bones_and_locations(self):
        rig = self.arm(connect=False)
        rig.pose.bones["Bone 1"].location = (0.05, 0.1, -0.05)
        rig.pose.bones["Bone 0"].location = (0.0, 0.1, 0.2)
        rig.pose.bones["Bone 0"].scale = (1.0, 1.5, 1.0)
        self.reach()
        self.assertNear(self.tail(rig), REACHABLE, 5e-6)
        self.assertNear(self.pose(rig, "Bone 0").to_scale(), (1.0, 1.5, 1.0), 1e-5)

    def test_rotation_modes(self):
        rig = self.arm()
        for mode in ('XYZ', 'ZYX', 'AXIS_ANGLE', 'QUATERNION'):
            for bone in rig.pose.bones:
                bone.rotation_mode = mode
            if "Bone 1" not in rig.motus.ik.entries:
                self.reach()
            self.assertNear(self.tail(rig), REACHABLE)

    def test_single_bone_points_at_the_target(self):
        rig = self.arm()
        self.reach("Hand", chain_length=1)
        matrix = self.pose(rig, "Hand")
        self.assertLess(angle_between(matrix.col[1].xyz, Vector(REACHABLE) - matrix.translation), 1e-3)

    def test_long_chains(self):
        rig = self.arm(tentacle(20), hand=False)
        target = self.target((0.8, 0.5, 0.9))
        self.reach("Bone 19", chain_length=20)
        for place in ((0.8, 0.5, 0.9), (0.0, 0.1, 0.05), (-1.0, 0.3, -0.8), (1.1, 0.0, 1.65)):
            target.location = place
            self.assertNear(self.tail(rig, "Bone 19"), place, 1e-5)
            self.assertEqual(self.output(rig, "Bone 19.reason"), 0.0)

    def test_several_chains_on_one_rig(self):
        def build(bones):
            for leg in range(30):
                joints = [(leg, 0.0, 1.0), (leg, 0.3, 0.6), (leg, 0.1, 0.0)]
                add_chain(bones, f"Leg {leg}", joints)

        rig = self.rig(build)
        for leg in range(30):
            self.target((leg + 0.1, 0.2 + 0.01 * leg, 0.2), f"Foot {leg}")
            self.reach(f"Leg {leg} 1", target=f"Foot {leg}")
        for leg in range(30):
            self.assertNear(self.tail(rig, f"Leg {leg} 1"), (leg + 0.1, 0.2 + 0.01 * leg, 0.2), 1e-5)
        bpy.ops.motus.ik_remove(object="Rig", bone="Leg 7 1")
        self.assertNear(self.tail(rig, "Leg 7 1"), (7.0, 0.1, 0.0))
        self.assertNear(self.tail(rig, "Leg 29 1"), (29.1, 0.49, 0.2), 1e-5)

    def test_too_far_and_too_near(self):
        rig = self.arm(((0.0, 0.0, 0.0), (0.0, 0.2, 1.0), (0.0, 0.0, 1.5)))
        target = self.target((0.0, 3.0, 4.0))
        self.reach()
        lengths = [rig.data.bones[name].length for name in ("Bone 0", "Bone 1")]
        self.assertNear(self.tail(rig), Vector((0.0, 0.6, 0.8)) * sum(lengths), 1e-5)
        self.assertAlmostEqual(self.output(rig, "Bone 1.distance"), 5.0, places=5)
        self.assertAlmostEqual(self.output(rig, "Bone 1.reach"), sum(lengths), places=5)
        self.assertRegex(self.sentence(rig), r"^The target is 3\.44\d* m too far away$")
        target.location = (0.0, 0.1, 0.0)
        self.assertIn("too near", self.sentence(rig))
        self.assertAlmostEqual(self.output(rig, "Bone 1.residual"), lengths[0] - lengths[1] - 0.1, places=5)
        target.location = (0.0, 0.6, 0.8)
        self.assertEqual(self.sentence(rig), "")

    def test_softness(self):
        rig = self.arm(((0.0, 0.0, 0.0), (0.0, 0.01, 1.0), (0.0, 0.0, 2.0)))
        target = self.target()
        self.reach(softness=0.1)
        length = sum(rig.data.bones[name].length for name in ("Bone 0", "Bone 1"))
        soft = 0.1 * length
        for distance in (1.0, 1.85, 1.95, 2.05, 2.15, 2.5):
            target.location = (0.0, 0.6 * distance, 0.8 * distance)
            start = length - soft
            slowed = length - soft * max(1 - (distance - start) / (3 * soft), 0.0) ** 3
            wanted = distance if distance < start else slowed
            self.assertAlmostEqual(self.tail(rig).length, wanted, places=5)
        target.location = (0.0, 0.0, 1.95)
        self.assertIn("Softness", self.sentence(rig))

    def test_stretch(self):
        rig = self.arm()
        self.target((1.5, 1.2, 1.6))
        entry = self.reach(stretch=1.0)
        hand = rig.data.bones["Hand"]
        self.assertNear(self.tail(rig), (1.5, 1.2, 1.6), 5e-6)
        self.assertNear(self.head(rig), (1.5, 1.2, 1.6), 5e-6)
        self.assertNear((self.tail(rig, "Hand") - self.head(rig)).length, hand.length, 5e-6)
        self.assertNear(self.pose(rig, "Hand").to_scale(), (1.0, 1.0, 1.0), 5e-6)
        orientation = self.pose(rig, "Hand").to_quaternion()
        entry.stretch = 0.0
        self.assertNear(
            (self.tail(rig) - self.head(rig, "Bone 0")).length, sum(rig.data.bones[name].length for name in ("Bone 0", "Bone 1")), 5e-6
        )
        self.assertTurned(self.pose(rig, "Hand"), orientation)
        entry.stretch = 0.5
        reach = sum(rig.data.bones[name].length for name in ("Bone 0", "Bone 1"))
        distance = (Vector((1.5, 1.2, 1.6)) - self.head(rig, "Bone 0")).length
        self.assertNear((self.tail(rig) - self.head(rig, "Bone 0")).length, 0.5 * (reach + distance), 5e-6)

    def test_keyed_stretch(self):
        rig = self.arm()
        self.target((1.5, 1.2, 1.6))
        entry = self.reach()
        for frame, value in ((1, 0.0), (11, 1.0)):
            entry.stretch = value
            rig.keyframe_insert("motus.ik.entries[0].stretch", frame=frame)
        self.assertNear(self.tail(rig, frame=11), (1.5, 1.2, 1.6), 5e-6)
        self.assertNear(self.pose(rig, "Hand").to_scale(), (1.0, 1.0, 1.0), 5e-6)

    def test_limits(self):
        rig = self.arm(((0.0, 0.0, 0.0), (0.0, 0.2, 1.0), (0.0, 0.0, 2.0)))
        elbow = rig.pose.bones["Bone 1"]
        for letter in "xyz":
            setattr(elbow, f"use_ik_limit_{letter}", True)
            setattr(elbow, f"ik_min_{letter}", -0.3)
            setattr(elbow, f"ik_max_{letter}", 0.3)
        self.target((0.0, 1.0, 0.5))
        entry = self.reach()
        self.assertNear(self.tail(rig), (0.0, 1.0, 0.5), 1e-5)
        entry.use_limits = True
        self.assertLessEqual(self.local(rig, "Bone 1").angle, 0.3 * math.sqrt(2.0) + 1e-4)
        self.assertIn("A joint limit is in the way", self.sentence(rig))
        elbow.lock_ik_x = elbow.lock_ik_y = elbow.lock_ik_z = True
        rig.update_tag()
        self.assertLess(self.local(rig, "Bone 1").angle, 1e-3)

    def test_limits_of_the_bone_after_the_chain(self):
        """With Use Tail off they are not kept, and the panel says so where that matters."""
        ignored = "Hand has joint limits of its own: they count only with Use Tail"
        rig = self.arm()
        hand = rig.pose.bones["Hand"]
        for letter in "xyz":
            setattr(hand, f"use_ik_limit_{letter}", True)
            setattr(hand, f"ik_min_{letter}", -0.1)
            setattr(hand, f"ik_max_{letter}", 0.1)
        self.target().rotation_euler = (0.5, 0.3, 1.2)
        entry = self.reach("Hand", use_tail=False, use_limits=True, rotation_weight=1.0, keep_rotation=False)
        self.assertGreater(self.local(rig, "Hand").angle, 1.0)
        self.assertEqual(self.sentence(rig, "Hand"), ignored)
        for name, value in (("rotation_weight", 0.0), ("use_limits", False)):
            kept = getattr(entry, name)
            setattr(entry, name, value)
            self.assertEqual(self.sentence(rig, "Hand"), "", name)
            setattr(entry, name, kept)
        entry.target.location.x = 5.0
        self.assertIn("too far away", self.sentence(rig, "Hand"), "what is worse comes first")
        entry.position_weight = 0.0
        self.assertGreater(self.local(rig, "Hand").angle, 1.0, "the hand turns where it is animated too")
        self.assertEqual(self.sentence(rig, "Hand"), ignored)
        entry.position_weight, entry.target.location.x = 1.0, 0.6
        for letter in "xyz":
            setattr(hand, f"use_ik_limit_{letter}", False)
        self.assertEqual(self.sentence(rig, "Hand"), "")
        hand.lock_ik_y = True
        self.assertEqual(self.sentence(rig, "Hand"), ignored)
        entry.use_tail, entry.chain_length = True, 3
        self.assertEqual(self.sentence(rig, "Hand"), "")
        hand.lock_ik_x = hand.lock_ik_z = True
        rig.update_tag()
        self.assertLess(self.local(rig, "Hand").angle, 1e-3)


class Bend(IkTestCase):
    def elbow_side(self, rig):
        """Direction from the line between root and tip to the elbow."""
        root, elbow, tip = self.head(rig, "Bone 0"), self.tail(rig, "Bone 0"), self.tail(rig)
        along = (tip - root).normalized()
        return (elbow - root) - (elbow - root).dot(along) * along

    def test_pole(self):
        rig = self.arm()
        pole = self.target((0.5, -3.0, 1.5), "Pole")
        entry = self.reach(pole="Pole")
        root = Vector(ARM[0])
        along = (Vector(REACHABLE) - root).normalized()
        for place in ((0.5, -3.0, 1.5), (0.5, 3.0, 1.5), (-1.0, 0.2, 4.0)):
            pole.location = place
            side = Vector(place) - root
            side -= side.dot(along) * along
            self.assertLess(angle_between(self.elbow_side(rig), side), 0.01)
            entry.bend = 'AWAY'
            self.assertLess(angle_between(self.elbow_side(rig), -side), 0.01)
            entry.bend = 'TOWARDS'
            self.assertNear(self.tail(rig), REACHABLE)
        entry.pole_angle = 0.5
        turned = Quaternion(along, 0.5) @ side
        self.assertLess(angle_between(self.elbow_side(rig), turned), 0.01)

    def test_pole_bone(self):
        rig = self.arm()
        self.reach(pole="Rig", pole_bone="Shoulder")
        head = Vector(rig.data.bones["Shoulder"].head_local)
        along = (Vector(REACHABLE) - Vector(ARM[0])).normalized()
        side = head - Vector(ARM[0])
        self.assertLess(angle_between(self.elbow_side(rig), side - side.dot(along) * along), 0.01)

    def test_deleted_pole_is_none(self):
        rig = self.arm()
        self.reach()
        without = self.poses(rig)
        self.target((0.5, -3.0, 1.5), "Pole")
        self.reach(pole="Pole")
        self.assertGreater(np.abs(self.poses(rig) - without).max(), 0.1)
        bpy.data.objects.remove(bpy.data.objects["Pole"])
        self.assertSamePose(rig, without)

    def test_plane_of_the_animated_pose(self):
        rig = self.arm()
        turn(rig.pose.bones["Bone 0"], (0.0, 1.0, 0.0), 0.9)  # about its own length: the plane turns along
        before = self.elbow_side(rig)
        target = self.target(self.tail(rig) * 0.9 + Vector(ARM[0]) * 0.1)
        self.reach()
        self.assertNear(self.tail(rig), target.location, 5e-6)
        self.assertLess(angle_between(self.elbow_side(rig), before), 0.01)

    def test_straight_pose_bends_about_its_axis(self):
        rig = self.arm(((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 2.0)))
        self.target((0.0, 0.0, 1.5))
        entry = self.reach()
        for angle in (0.0, 1.0, 2.5, -1.5):
            entry.hinge_angle = angle
            axis = rig.data.bones["Bone 0"].matrix_local.to_3x3() @ Vector((math.cos(angle), 0.0, -math.sin(angle)))
            self.assertLess(angle_between(self.elbow_side(rig), axis.cross(Vector((0.0, 0.0, 1.0)))), 0.05)
