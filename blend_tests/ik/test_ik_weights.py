"""Weights of inverse kinematics: the animated pose at 0, the solution at 1, slerp between; orientation goals."""

import bpy
import numpy as np
from mathutils import Euler, Vector

import support
from ik.ik_cases import REACHABLE, IkTestCase, tentacle, turn


class Position(IkTestCase):
    def posed(self):
        rig = self.arm()
        turn(rig.pose.bones["Bone 0"], (1.0, 0.3, 0.2), 0.5)
        turn(rig.pose.bones["Bone 1"], (0.2, 1.0, 0.4), 0.8)
        turn(rig.pose.bones["Hand"], (0.2, 0.1, 1.0), 0.3)
        return rig

    def test_zero_is_the_animated_pose(self):
        rig = self.posed()
        before = self.poses(rig).tolist()
        for keywords in ({}, {"stretch": 0.5}):
            entry = self.reach(position_weight=0.0, **keywords)
            self.assertSamePose(rig, before)
            entry.position_weight = 1.0
            self.assertNear(self.tail(rig), REACHABLE)

    def test_the_pose_of_a_rig_that_nothing_animates_may_be_edited(self):
        """What is read once for a copy of the rig is read again when a bone is turned by hand, or by a key."""
        rig = self.posed()
        self.reach()
        bone = rig.pose.bones["Bone 0"]
        for angle in (0.5, -0.4, 0.9):
            turn(bone, (0.1, 0.2, 1.0), angle)
            self.assertNear(self.tail(rig), REACHABLE)
        bone.keyframe_insert("rotation_quaternion", frame=1)
        turn(bone, (0.1, 0.2, 1.0), 0.1)
        bone.keyframe_insert("rotation_quaternion", frame=11)
        for frame in (1, 6, 11, 3):
            self.assertNear(self.tail(rig, frame=frame), REACHABLE)

    def test_half_is_halfway_by_slerp(self):
        rig = self.posed()
        entry = self.reach()
        names = ("Bone 0", "Bone 1")
        whole = [self.local(rig, name) for name in names]
        own = [rig.pose.bones[name].rotation_quaternion.copy() for name in names]
        for weight in (0.5, 0.1, 0.75):
            entry.position_weight = weight
            for name, start, end in zip(names, own, whole):
                self.assertLess(_angle(self.local(rig, name), start.slerp(end, weight)), 2e-3)

    def test_influence_is_a_weight_for_all(self):
        rig = self.posed()
        before = self.poses(rig)
        entry = self.reach("Hand", use_tail=False, rotation_weight=1.0)
        entry.position_weight = entry.rotation_weight = 0.25
        wanted = self.poses(rig)
        entry.position_weight = entry.rotation_weight = 0.5
        rig.motus.ik.influence = 0.5
        self.assertSamePose(rig, wanted, 1e-6)
        rig.motus.ik.influence = 0.0
        self.assertSamePose(rig, before)

    def test_keyed_weight(self):
        rig = self.posed()
        entry = self.reach()
        for frame, weight in ((1, 0.0), (11, 1.0)):
            entry.position_weight = weight
            rig.keyframe_insert("motus.ik.entries[0].position_weight", frame=frame)
        for curve in _curves(rig):
            for key in curve.keyframe_points:
                key.interpolation = 'LINEAR'
        keyed = {frame: self.poses(rig, frame) for frame in (11, 6, 1, 3)}
        rig.animation_data.action = None
        for frame, poses in keyed.items():
            entry.position_weight = (frame - 1) / 10.0
            self.assertSamePose(rig, poses, 1e-6)

    def test_driven_weight(self):
        """Also when the driver is added after the chain: the rig is wired anew, so that the solver waits for it."""
        rig = self.posed()
        mover = self.target((0.0, 0.0, 0.0), "Mover")
        entry = self.reach()
        wanted = {}
        for weight in (0.0, 0.3, 1.0):
            entry.position_weight = weight
            wanted[weight] = self.poses(rig)
        driver = rig.driver_add("motus.ik.entries[0].position_weight").driver
        variable = driver.variables.new()
        variable.targets[0].id, variable.targets[0].data_path = mover, "location[0]"
        driver.expression = variable.name
        self.evaluated(rig, 2)
        for weight in (1.0, 0.0, 0.3):
            mover.location.x = weight
            self.assertSamePose(rig, wanted[weight], 1e-6)
        mover.driver_add("location", 0).driver.expression = "frame * 0.1"
        for frame in (10, 3, 0):
            self.assertSamePose(rig, wanted[round(frame * 0.1, 1)], 1e-5, frame)
        bpy.ops.motus.ik_remove(object="Rig")
        self.assertIsNone(rig.animation_data)


class Rotation(IkTestCase):
    def setUp(self):
        super().setUp()
        self.wrist = self.target()
        self.wrist.rotation_euler = (0.4, -0.7, 1.1)

    def test_hand(self):
        """The bone below the chain takes the orientation; the chain's own bones stay as they were."""
        rig = self.arm()
        turn(rig.pose.bones["Hand"], (0.2, 0.1, 1.0), 0.3)
        entry = self.reach("Hand", use_tail=False, keep_rotation=False)
        free = self.pose(rig, "Hand").to_quaternion()
        arm = [self.pose(rig, name) for name in ("Bone 0", "Bone 1")]
        goal = self.wrist.matrix_world.to_quaternion()
        for weight in (1.0, 0.4):
            entry.rotation_weight = weight
            self.assertTurned(self.pose(rig, "Hand"), free.slerp(goal, weight))
            self.assertNear(self.head(rig), REACHABLE)
            self.assertNear([self.pose(rig, name) for name in ("Bone 0", "Bone 1")], arm)

    def test_last_bone_of_the_chain(self):
        """It takes the orientation, and the rest of the chain still brings its tail to the target."""
        rig = self.arm(tentacle(4, 0.5))
        self.wrist.location = (0.4, 0.3, 0.7)
        entry = self.reach("Bone 3", chain_length=4, keep_rotation=False)
        free = self.pose(rig, "Bone 3").to_quaternion()
        goal = self.wrist.matrix_world.to_quaternion()
        for weight in (1.0, 0.5):
            entry.rotation_weight = weight
            self.assertTurned(self.pose(rig, "Bone 3"), free.slerp(goal, weight), 0.05)
            self.assertNear(self.tail(rig, "Bone 3"), (0.4, 0.3, 0.7), 1e-5)

    def test_offset(self):
        rig = self.arm()
        entry = self.reach("Hand", use_tail=False, rotation_weight=1.0, rotation_offset=(0.3, 0.2, -0.9))
        wanted = self.wrist.matrix_world.to_quaternion() @ Euler((0.3, 0.2, -0.9)).to_quaternion()
        self.assertTurned(self.pose(rig, "Hand"), wanted)
        self.assertLess(self.output(rig, "Hand.angle"), 1e-4)
        entry.rotation_offset = (0.0, 0.0, 0.0)
        self.assertTurned(self.pose(rig, "Hand"), self.wrist.matrix_world.to_quaternion())

    def test_orientation_of_a_bone(self):
        rig = self.arm()
        other = self.arm(name="Other")
        other.matrix_world = self.wrist.matrix_world @ other.matrix_world
        other.location = (-0.4, 0.2, 0.6)
        turn(other.pose.bones["Shoulder"], (1.0, 1.0, 0.2), 0.6)
        self.reach("Hand", target="Other", target_bone="Bone 0", use_tail=False, keep_rotation=False, rotation_weight=1.0)
        self.assertTurned(self.pose(rig, "Hand"), self.pose(other, "Bone 0").to_quaternion())

    def test_scaled_rig_and_target(self):
        rig = self.arm()
        rig.scale = (2.0, 2.0, 2.0)
        self.wrist.scale = (0.5, 3.0, 0.5)
        self.reach("Hand", use_tail=False, keep_rotation=False, rotation_weight=1.0)
        self.assertTurned(self.pose(rig, "Hand"), self.wrist.matrix_world.to_quaternion())
        self.assertNear(self.head(rig), REACHABLE, 5e-6)

    def test_stretched_arm_keeps_the_hand(self):
        rig = self.arm()
        self.wrist.location = (2.0, 0.5, 1.5)
        self.reach("Hand", use_tail=False, keep_rotation=False, rotation_weight=1.0, stretch=1.0)
        self.assertNear(self.head(rig), (2.0, 0.5, 1.5), 5e-6)
        self.assertTurned(self.pose(rig, "Hand"), self.wrist.matrix_world.to_quaternion())
        self.assertNear(self.pose(rig, "Hand").to_scale(), (1.0, 1.0, 1.0), 1e-5)

    def test_baking_names_what_keyframes_cannot_hold(self):
        rig = self.arm()
        self.reach("Hand", use_tail=False)
        job, systems = support.addon("core.bake.job"), [support.addon("core.declare").registered["ik"]]
        self.assertEqual(job.inexact(rig, systems), [])
        self.reach("Hand", use_tail=False, stretch=1.0)
        self.assertIn("Hand", job.inexact(rig, systems))


class Blend(IkTestCase):
    def test_between_targets(self):
        rig = self.arm()
        places = [REACHABLE, (0.4, -0.4, 1.2), (0.2, 0.6, 0.7)]
        turns = [Euler(angles).to_quaternion() for angles in ((0.0, 0.0, 0.0), (0.5, 1.0, 0.2), (-1.0, 0.3, 0.6))]
        for index, (place, turned) in enumerate(zip(places, turns)):
            self.target(place, f"Target {index}").rotation_euler = turned.to_euler()
        entry = self.reach("Hand", target="Target 0", use_tail=False, keep_rotation=False, rotation_weight=1.0)
        for index in (1, 2):
            bpy.ops.motus.ik_target_add(object="Rig", bone="Hand", target=f"Target {index}")
        for blend in (0.0, 0.3, 1.0, 1.6, 2.0, 7.0):
            entry.target_blend = blend
            first = min(int(blend), 1)
            share = min(blend - first, 1.0)
            self.assertNear(self.head(rig), Vector(places[first]).lerp(places[first + 1], share), 5e-6)
            self.assertTurned(self.pose(rig, "Hand"), turns[first].slerp(turns[first + 1], share))

    def test_blend_is_keyed(self):
        rig = self.arm()
        self.target((0.4, -0.4, 1.2), "Other")
        entry = self.reach()
        bpy.ops.motus.ik_target_add(object="Rig", bone="Bone 1", target="Other")
        for frame, blend in ((1, 0.0), (21, 1.0)):
            entry.target_blend = blend
            rig.keyframe_insert("motus.ik.entries[0].target_blend", frame=frame)
        for frame in (21, 8, 1, 13.5):
            self.evaluated(rig, frame)
            share = self.evaluated(rig).motus.ik.entries[0].target_blend
            self.assertNear(self.tail(rig), Vector(REACHABLE).lerp((0.4, -0.4, 1.2), share), 5e-6)


def _angle(first, second):
    """Degrees between two orientations."""
    return np.degrees(2.0 * np.arcsin(min(1.0, Vector((first.inverted() @ second)[1:]).length)))


def _curves(rig):
    import support

    return support.addon("core.blender.actions").fcurves(rig)
