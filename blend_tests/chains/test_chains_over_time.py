"""Bones of chains are known at any times, for what hangs on them."""

import bpy
import numpy as np

import solved_cases
import support
from chains import chain_cases as cases, test_chains_objects
from dynamics import dynamics_cases


class ChainsOverTime(solved_cases.Solved, support.SceneTestCase):
    label = "Chains"

    def test_bones_of_a_chain(self):
        rig = cases.rope(4)
        (entry,) = cases.add(rig, frequency=1.0)
        flag = support.link("Flag", parent=rig)
        flag.parent_type, flag.parent_bone = 'BONE', "Tail 0 3"
        for thing in (rig.pose.bones["Tail 0 0"], rig.pose.bones["Tail 0 3"], flag):
            self.assertSolved(thing, 1e-4)
        entry.weight = 0.3
        self.assertSolved(flag, 1e-4)
        entry.keyframe_insert("weight", frame=1)
        self.assertUnknown(flag, "by a part alone")

    def test_objects_of_a_row(self):
        beads = test_chains_objects.row(3)
        (entry,) = test_chains_objects.add(beads, frequency=1.0)
        flag = support.link("Flag", location=(0.0, 0.3, 0.0), parent=beads[3])
        for thing in (beads[1], beads[3], flag):
            self.assertSolved(thing, 1e-4)
        entry.weight = 0.3
        self.assertSolved(flag, 1e-4)
        entry.keyframe_insert("weight", frame=1)
        self.assertUnknown(flag, "by a part alone")

    def test_dynamics_on_what_hangs_on_a_chain(self):
        rig = cases.rope(3)
        (entry,) = cases.add(rig, frequency=1.0)
        flag = support.link("Flag", parent=rig)
        flag.parent_type, flag.parent_bone = 'BONE', "Tail 0 2"
        dynamics_cases.add(flag, style='BOUNCY')
        self.assertIsNone(dynamics_cases.problem(flag))
        alone = cases.matrix(flag, 24)
        for frame in (3, 80, 12.5):
            cases.matrix(flag, frame)
        np.testing.assert_array_equal(cases.matrix(flag, 24), alone)
        entry.frequency = 0.2
        bpy.context.view_layer.update()
        self.assertGreater(np.abs(cases.matrix(flag, 24) - alone).max(), 1e-3)
