"""Chains of an owner that touch each other; limits to the side, and bones that do not twist."""

import math
import unittest.mock

import bpy
import numpy as np

import solved_cases
import support
from chains import chain_cases as cases

THICKNESS = 0.05


def least_distance(rig, frame):
    """Of the bones of two chains, sampled along each."""
    cases.go_to(frame)
    found = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    along = []
    for number in range(2):
        bones = [found.pose.bones[name] for name in cases.chain(rig, number)]
        shares = np.linspace(0.0, 1.0, 15)[:, None]
        along.append(np.concatenate([(1.0 - shares) * np.array(bone.head) + shares * np.array(bone.tail) for bone in bones]))
    return np.linalg.norm(along[0][:, None] - along[1][None], axis=2).min()


class TouchingTest(solved_cases.Solved, support.SceneTestCase):
    label = "Chains"

    def swinging(self):
        """Two chains beside each other: the wind drives the second one, which feels it, against the first one."""
        rig = cases.rope(5, chains=2)
        rig.animation_data_clear()
        first, second = cases.add(rig, "Tail 0 0, Tail 1 0", frequency=0.0, thickness=THICKNESS, settle=5.0)
        heads = [np.array(rig.matrix_world @ rig.pose.bones[f"Tail {number} 0"].head) for number in range(2)]
        way = heads[0] - heads[1]
        self.gap = np.linalg.norm(way)
        first.drag, second.drag = 0.2, 4.0
        rig.motus.chains.wind = 6.0 * way / self.gap
        bpy.context.view_layer.update()
        return rig

    def test_they_do_not_go_through_each_other(self):
        rig = self.swinging()
        frames = range(1, 60, 3)
        self.assertLess(min(least_distance(rig, frame) for frame in frames), THICKNESS)
        rig.motus.chains.use_touch = True
        bpy.context.view_layer.update()
        self.assertIsNone(cases.problem(rig))
        apart = [least_distance(rig, frame) for frame in frames]
        self.assertGreater(min(apart), 1.8 * THICKNESS)
        self.assertLess(min(apart), 2.2 * THICKNESS)
        alone = cases.tails(rig, 31, cases.chain(rig))
        cases.go_to(7)
        np.testing.assert_array_equal(cases.tails(rig, 31, cases.chain(rig)), alone)

    def test_a_muted_chain_touches_nothing(self):
        rig = self.swinging()
        second = cases.chain(rig, 1)
        free = cases.tails(rig, 31, second)
        rig.motus.chains.use_touch = True
        bpy.context.view_layer.update()
        self.assertGreater(np.abs(cases.tails(rig, 31, second) - free).max(), 0.01)
        rig.motus.chains.entries[0].is_muted = True
        bpy.context.view_layer.update()
        np.testing.assert_allclose(cases.tails(rig, 31, second), free, atol=1e-6)

    def test_chains_that_wait_for_each_other_do_not_touch_and_say_so(self):
        rig = self.swinging()
        rig.motus.chains.use_touch = True
        bpy.ops.motus.chains_pin(object=rig.name, bones="Tail 1 4", target=rig.name, target_bone="Tail 0 4", weight=0.0)
        bpy.context.view_layer.update()
        self.assertEqual(cases.problem(rig), support.addon("chains.making").CHAINS_PARTED)

    def test_so_many_near_each_other_are_as_dear_as_they_are(self):
        """What the bound of work counts is what the native module compares."""
        rig = cases.rope(6, chains=12)
        motion = support.addon("chains.motion")
        with unittest.mock.patch.object(motion, "step_price", side_effect=motion.step_price) as priced:
            cases.add(rig, ", ".join(f"Tail {number} 0" for number in range(12)), thickness=10.0, use_touch=True)
            cases.go_to(2)
        pairs = [call.args[2] for call in priced.call_args_list if call.args[2] is not None]
        self.assertGreater(min(pairs), 2000)

    def test_what_hangs_on_one_of_them_is_known(self):
        rig = self.swinging()
        rig.motus.chains.use_touch = True
        flag = support.link("Flag", parent=rig)
        flag.parent_type, flag.parent_bone = 'BONE', "Tail 0 3"
        bpy.context.view_layer.update()
        for thing in (rig.pose.bones["Tail 0 2"], flag):
            self.assertSolved(thing, 1e-4)


class SideLimitTest(support.SceneTestCase):
    def angles(self, rig, frame):
        """(about X, about Z) by which the bones of a chain but the first are turned, and their largest twist, in radians."""
        cases.go_to(frame)
        found = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
        about, twists = [], []
        for name in cases.chain(rig)[1:]:
            bone = found.pose.bones[name]
            rest = bone.parent.bone.matrix_local.inverted() @ bone.bone.matrix_local
            turn = ((bone.parent.matrix @ rest).inverted() @ bone.matrix).to_quaternion()
            swing, twist = turn.to_swing_twist('Y')
            axis, angle = swing.to_axis_angle()
            about.append((axis.x * angle, axis.z * angle))
            twists.append(abs(twist))
        return np.array(about), max(twists)

    def test_bones_bend_less_sideways_and_do_not_twist(self):
        rig = cases.rope(4)
        rig.animation_data_clear()
        for frame, place in ((1, (0.0, 0.0, 0.0)), (12, (1.0, 0.4, 0.0)), (24, (-0.5, -0.6, 0.3)), (36, (0.4, 0.5, 0.0))):
            cases.key(rig, "location", {frame: place})
        bend, side = math.radians(50.0), math.radians(10.0)
        cases.add(rig, frequency=0.0, bend_limit=bend, side_limit=side)
        found = [self.angles(rig, frame) for frame in range(1, 49, 2)]
        about = np.concatenate([one for one, _ in found])
        tenth = math.radians(0.1)
        # What turns about Z goes towards X, the side.
        size = np.hypot(about[:, 0] / bend, about[:, 1] / side)
        self.assertLess((np.linalg.norm(about, axis=1) * (1.0 - 1.0 / np.maximum(size, 1.0))).max(), tenth)
        self.assertGreater(np.abs(about[:, 0]).max(), 2.0 * side)
        self.assertGreater(np.abs(about[:, 1]).max(), 0.9 * side)
        self.assertLess(max(twist for _, twist in found), tenth)
