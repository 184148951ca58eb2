"""The bones of chains, and what hangs on them, are known at any times, for systems that need their past."""

import bpy
import numpy as np

import solved_cases
import support
from ik.ik_cases import IkTestCase

WAY = {1: (0.6, 0.3, 1.4), 20: (0.2, -0.5, 1.6), 60: (1.0, 0.4, 0.7)}


class IkOverTime(solved_cases.Solved, IkTestCase):
    label = "Inverse Kinematics"

    def setUp(self):
        super().setUp()
        self.arm_rig = self.arm()

    def moved(self, name="Target", rows=None):
        target = self.target(name=name)
        support.key(target, "location", rows or WAY)
        return target

    def bone(self, name):
        return self.arm_rig.pose.bones[name]

    def test_a_chain_and_what_hangs_on_it(self):
        self.moved()
        self.reach()
        cup = self.link("Cup")
        cup.parent, cup.parent_type, cup.parent_bone = self.arm_rig, 'BONE', "Bone 1"
        cup.location = (0.1, 0.2, 0.3)
        self.arm_rig.location, self.arm_rig.rotation_euler = (1.0, 0.2, 0.0), (0.1, 0.3, -0.4)
        for thing in (self.bone("Bone 0"), self.bone("Bone 1"), self.bone("Hand"), cup):
            self.assertSolved(thing)
        self.assertTrue({20.0, 60.0} <= set(solved_cases.track(cup).bounds(1.0, 60.0)))

    def test_originals_are_asked_without_a_trace(self):
        """Panels ask them, and may not write; what their action held would be handed on to all its copies."""
        self.moved()
        self.reach()
        shoulder = self.bone("Shoulder")
        support.key(shoulder, "rotation_quaternion", {1: (1.0, 0.0, 0.0, 0.0), 20: (0.9, 0.1, 0.3, 0.0)})
        cup = self.link("Cup")
        cup.parent, cup.parent_type, cup.parent_bone = self.arm_rig, 'BONE', "Hand"
        bpy.ops.motus.dynamics_add(object="Cup", follow='WORLD', style='BOUNCY')
        for thing in (self.bone("Hand"), cup):
            found = solved_cases.track(thing)
            self.assertIsNone(found.reason)
            self.assertIsNone(found.stamp)
        for action in bpy.data.actions:
            self.assertEqual(list(action.keys()), [])
        before = solved_cases.world(cup, 24)
        for curve in support.addon("core.blender.actions").fcurves(self.arm_rig):
            curve.keyframe_points[-1].co.y += 0.5
        bpy.context.view_layer.update()
        edited = solved_cases.world(cup, 24)
        self.assertGreater(np.abs(edited - before).max(), 0.01)
        self.arm_rig.update_tag()
        cup.update_tag()
        np.testing.assert_array_equal(solved_cases.world(cup, 24), edited)

    def test_poles_weights_softness_and_orientation_with_keys(self):
        self.moved()
        self.moved("Pole", {1: (0.5, -2.0, 1.0), 60: (0.5, 2.0, 3.0)})
        entry = self.reach(pole="Pole", softness=0.1, rotation_weight=0.5, rotation_offset=(0.1, 0.2, 0.3))
        support.key(bpy.data.objects["Target"], "rotation_euler", {1: (0.0, 0.0, 0.0), 60: (0.4, 0.0, 1.0)})
        for frame, weight in ((1, 1.0), (40, 0.2)):  # by its name, as scripts may have it
            entry.position_weight = weight
            self.arm_rig.keyframe_insert('motus.ik.entries["Bone 1"].position_weight', frame=frame)
        support.key(self.arm_rig.motus.ik, "influence", {1: 1.0, 100: 0.5})
        support.key(self.bone("Shoulder"), "rotation_quaternion", {1: (1.0, 0.0, 0.0, 0.0), 60: (0.9, 0.1, 0.3, 0.0)})
        self.assertSolved(self.bone("Bone 1"), 2e-5)

    def test_a_keyed_pole_angle(self):
        self.moved()
        entry = self.reach(pole=self.target(name="Pole").name)
        support.key(entry, "pole_angle", {1: 0.0, 40: 0.5})
        self.assertSolved(self.bone("Bone 0"))

    def test_stretch_and_a_long_chain_with_limits(self):
        self.moved(rows={1: (3.0, 0.0, 1.0), 60: (2.0, 0.5, 2.0)})
        self.reach(stretch=1.0)
        self.assertSolved(self.bone("Bone 0"), 2e-5)
        self.assertUnknown(self.bone("Hand"), "constraint")  # it keeps its scale while the arm is stretched

    def test_mixed_targets(self):
        self.moved()
        self.moved("Second", {1: (0.2, 0.6, 1.2), 60: (0.6, 0.6, 0.8)})
        entry = self.reach()
        entry.extra_targets.add().object = bpy.data.objects["Second"]
        support.key(entry, "target_blend", {1: 0.0, 60: 1.0})
        self.assertSolved(self.bone("Bone 1"), 2e-5)

    def test_a_target_on_a_path(self):
        curve = bpy.data.curves.new("Course", 'CURVE')
        spline = curve.splines.new('POLY')
        spline.points.add(1)
        spline.points[0].co, spline.points[1].co = (0.2, 0.3, 1.0, 1.0), (0.9, -0.3, 1.5, 1.0)
        self.link("Course", curve)
        self.target()
        bpy.ops.motus.path_follow_add(object="Target", curve="Course", duration=2.0)
        self.reach()
        self.assertSolved(self.bone("Bone 1"))
        self.assertIn("Follow Path", solved_cases.track(bpy.data.objects["Target"]).sentence)

    def test_muted_and_without_a_target(self):
        self.moved()
        entry = self.reach()
        entry.is_muted = True
        self.assertSolved(self.bone("Bone 1"))
        entry.is_muted = False
        entry.target = None
        self.assertSolved(self.bone("Bone 1"))

    def test_what_is_not_known(self):
        target = self.moved()
        entry = self.reach()
        target.constraints.new('LIMIT_LOCATION')
        self.assertUnknown(self.bone("Bone 1"), "Target has the constraint Limit Location")
        target.constraints.clear()
        entry.driver_add("softness").driver.expression = "frame / 100"
        self.assertUnknown(self.bone("Bone 0"), "driver")
        entry.driver_remove("softness")
        self.bone("Bone 0").constraints.new('LIMIT_ROTATION')
        self.assertUnknown(self.bone("Bone 1"), "Bone 0 has the constraint")

    def test_dynamics_of_a_tail_on_a_chain(self):
        """It follows where the hand really goes, exactly on each frame, and edits of the target's keys count."""
        target = self.moved()
        self.reach()
        bpy.ops.motus.dynamics_add(object="Rig", bones="Hand", style='FLOPPY')
        dynamics = support.addon("dynamics").SYSTEM

        def tail(frame):
            return np.array(self.tail(self.arm_rig, "Hand", frame))

        alone = tail(24)
        self.assertIsNone(self.wiring.problem(dynamics, self.arm_rig, bpy.context.evaluated_depsgraph_get()))
        for frame in (70, 3, 11.5):
            tail(frame)
        np.testing.assert_array_equal(tail(24), alone)
        support.key(target, "location", {20: (0.5, 0.6, 1.3)})
        moved = tail(24)
        self.assertGreater(np.abs(moved - alone).max(), 0.01)
        self.arm_rig.motus.ik.entries["Bone 1"].position_weight = 0.3
        weighted = tail(24)
        self.assertGreater(np.abs(weighted - moved).max(), 0.01)
        support.key(self.bone("Bone 0"), "rotation_quaternion", {1: (1.0, 0.0, 0.0, 0.0), 24: (0.8, 0.0, 0.0, 0.6)})
        self.assertGreater(np.abs(tail(24) - weighted).max(), 0.01)
        self.assertSolved(self.bone("Bone 1"))
