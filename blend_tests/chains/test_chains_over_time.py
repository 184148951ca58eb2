"""Bones of chains are known at any times, for what hangs on them."""

import unittest.mock

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

    def test_what_hangs_on_several_of_a_chain_shares_its_motion(self):
        """Which is found once for all that follow, and anew when the chain, or what it hangs on, is edited."""
        beads, rig = test_chains_objects.row(3), cases.rope(3)
        rows, ropes = test_chains_objects.add(beads, frequency=1.0), cases.add(rig, frequency=1.0)
        flags = [support.link(f"Flag {index}", parent=beads[index]) for index in (1, 2, 3)]
        lamps = [support.link(f"Lamp {index}", parent=rig) for index in (0, 1, 2)]
        for lamp in lamps:
            lamp.parent_type, lamp.parent_bone = 'BONE', "Tail 0 2"
        over_time = support.addon("chains.over_time")
        for followers, kind, name, entry, root in (
            (flags, over_time._Object, "_moved", rows[0], beads[0]),
            (lamps, over_time._Bone, "_changes", ropes[0], rig),
        ):
            with self.subTest(name):
                for follower in followers:
                    dynamics_cases.add(follower, style='BOUNCY')
                for edit in (
                    lambda entry=entry: setattr(entry, "frequency", 0.5),
                    lambda root=root: dynamics_cases.key(root, "location", {20: (2.0, 1.0, 2.0)}),
                ):
                    before = cases.matrix(followers[0], 24)
                    with unittest.mock.patch.object(kind, name, autospec=True, side_effect=getattr(kind, name)) as found:
                        edit()
                        bpy.context.view_layer.update()
                        bpy.context.scene.frame_set(24)
                    # Two threads may find it at the same time.
                    self.assertIn(found.call_count, (1, 2))
                    self.assertGreater(np.abs(cases.matrix(followers[0], 24) - before).max(), 1e-3)


class ChainsOnChains(support.SceneTestCase):
    def pinned(self):
        """Two rigs: the end of the second one's limp chain is pinned to a bone of the first one's chain."""
        first, second = cases.rope(4, name="First"), cases.rope(8, name="Second")
        (entry,) = cases.add(first)
        cases.add(second, frequency=0.0)
        second.location.x = 0.2
        bpy.ops.motus.chains_pin(object="Second", bones="Tail 0 7", target="First", target_bone="Tail 0 2")
        return entry, second, cases.chain(second)

    def test_an_edit_of_the_chain_that_a_pin_follows_is_felt(self):
        entry, second, names = self.pinned()
        before = cases.tails(second, 30, names)
        entry.frequency = 0.3
        bpy.context.view_layer.update()
        after = cases.tails(second, 30, names)
        self.assertGreater(np.abs(after - before).max(), 0.05)
        second.motus.chains.entries[0].drag += 1e-6  # makes its motion anew
        bpy.context.view_layer.update()
        np.testing.assert_allclose(cases.tails(second, 30, names), after, atol=1e-3)

    def test_nothing_is_made_anew_from_frame_to_frame(self):
        _, second, names = self.pinned()
        ball = support.link("Ball", parent=bpy.data.objects["First"])
        ball.parent_type, ball.parent_bone, ball.empty_display_type = 'BONE', "Tail 0 3", 'SPHERE'
        solid = bpy.data.collections.new("Solid")
        solid.objects.link(ball)
        second.motus.chains.colliders = solid
        bpy.context.view_layer.update()
        for frame in (20, 21):
            cases.tails(second, frame, names)
        making = support.addon("chains.making").Making
        with unittest.mock.patch.object(making, "make", autospec=True, side_effect=making.make) as made:
            for frame in (22, 23, 5):
                cases.tails(second, frame, names)
        self.assertEqual(made.call_count, 0)
