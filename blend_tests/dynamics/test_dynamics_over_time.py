"""Bones with dynamics are known at any times, for what hangs on them."""

import bpy
import numpy as np

import solved_cases
import support
from dynamics import dynamics_cases as cases


class DynamicsOverTime(solved_cases.Solved, support.SceneTestCase):
    label = "Dynamics"

    def test_a_bone_by_its_own_animation(self):
        rig = cases.rope(2)
        root = rig.pose.bones["Root"]
        root.rotation_mode = 'XYZ'
        cases.key(root, "rotation_euler", {1: (0.0, 0.0, 0.0), 20: (0.4, 0.2, 1.0)})
        cases.add(rig, bones="Root", follow='OWN', style='BOUNCY', channels={'LOCATION', 'ROTATION', 'SCALE'})
        self.assertSolved(root, 2e-5)
        self.assertSolved(rig.pose.bones["Tail 0 1"], 2e-5)

    def test_tails(self):
        rig = cases.rope(4)
        rig.rotation_euler = (0.2, 0.1, 0.3)
        cases.add(rig, bones="Tail 0 0", whole_chains=True, style='FLOPPY', chain_delay=0.04)
        flag = cases.link("Flag", parent=rig)
        flag.parent_type, flag.parent_bone = 'BONE', "Tail 0 3"
        for thing in (rig.pose.bones["Tail 0 0"], rig.pose.bones["Tail 0 3"], flag):
            self.assertSolved(thing, 2e-5)
        rig.motus.dynamics.entries["Tail 0 2"].weight = 0.3
        rig.motus.dynamics.entries["Tail 0 1"].is_muted = True
        self.assertSolved(flag, 2e-5)

    def test_dynamics_on_a_tail(self):
        rig = cases.rope(3)
        cases.add(rig, bones="Tail 0 0", whole_chains=True, style='FLOPPY')
        flag = cases.link("Flag", parent=rig)
        flag.parent_type, flag.parent_bone = 'BONE', "Tail 0 2"
        cases.add(flag, style='BOUNCY')
        self.assertIsNone(cases.problem(flag))
        alone = cases.matrix(flag, 24)
        for frame in (3, 80, 12.5):
            cases.matrix(flag, frame)
        np.testing.assert_array_equal(cases.matrix(flag, 24), alone)
        rig.motus.dynamics.entries["Tail 0 0"].frequency = 0.5
        bpy.context.view_layer.update()
        self.assertGreater(np.abs(cases.matrix(flag, 24) - alone).max(), 1e-3)

    def test_what_is_not_known(self):
        rig = cases.rope(2)
        entries = cases.add(rig, bones="Tail 0 0", style='FLOPPY')
        entries[0].keyframe_insert("weight", frame=1)
        self.assertUnknown(rig.pose.bones["Tail 0 1"], "by a part alone")

    def test_bones_between_those_that_follow(self):
        rig = cases.rope(3)
        cases.add(rig, bones="Tail 0 0, Tail 0 2")
        self.assertSolved(rig.pose.bones["Tail 0 2"], 2e-5)
        rig.pose.bones["Tail 0 1"].constraints.new('DAMPED_TRACK').target = cases.moved("Target")
        self.assertUnknown(rig.pose.bones["Tail 0 2"], "Tail 0 1 has the constraint")
