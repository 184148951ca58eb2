"""Matching on Rigify's metarigs, both ways: joints and poses of all limbs at every frame, as evaluated."""

import bpy

import rig_samples as samples
import support
from ik.test_ik_rigs import CHAINS, add_ik

FRAMES = range(1, 8)
KEYED = (1, 4, 7)
TOLERANCE = 1e-5  # m: joints


class TestMatching(support.SceneTestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        samples.enable_rigify()
        cls.addClassCleanup(samples.disable_rigify)

    def animated(self, name):
        """(rig, generator of random numbers): every bone has keys of its own."""
        support.empty_scene()
        generator = samples.new_generator(name)
        rig = samples.metarig(name)
        for frame in KEYED:
            samples.pose_at_random(rig, generator)
            for bone in rig.pose.bones:
                bone.keyframe_insert("rotation_quaternion", frame=frame)
        return rig, generator

    @staticmethod
    def recorded(rig, chains):
        """{frame: ({chain: joints}, {bone: matrix})}."""
        found = {}
        for frame in FRAMES:
            bpy.context.scene.frame_set(frame)
            joints = {bone: samples.joints(rig, bone, count) for bone, count in chains}
            found[frame] = joints, samples.pose_of(rig)
        return found

    def assert_recorded(self, rig, chains, wanted):
        for frame, (joints, poses) in self.recorded(rig, chains).items():
            for chain, points in joints.items():
                off = max((point - before).length for point, before in zip(points, wanted[frame][0][chain]))
                self.assertLessEqual(off, TOLERANCE, f"{chain} at frame {frame}")
            for bone, matrix in poses.items():
                self.assertTrue(samples.same_matrix(matrix, wanted[frame][1][bone], 1e-3), f"{bone} at frame {frame}")

    def assert_elsewhere(self, rig, chains, wanted):
        """All chains stand far from where they are wanted."""
        for frame, (joints, _) in self.recorded(rig, chains).items():
            for chain, points in joints.items():
                size = sum(samples.lengths(points))
                self.assertGreater((points[-1] - wanted[frame][0][chain][-1]).length, 0.01 * size, f"{chain} {frame}")

    def match(self, operator, rig):
        status = getattr(bpy.ops.motus, operator)(object=rig.name, frame_start=FRAMES[0], frame_end=FRAMES[-1])
        self.assertEqual(status, {'FINISHED'})

    def test_controls_to_the_animated_pose(self):
        for name, chains in CHAINS.items():
            with self.subTest(name):
                rig, _ = self.animated(name)
                before = self.recorded(rig, chains)
                for bone, count in chains:
                    add_ik(rig, bone, count, make_pole=count == 2)
                self.assert_elsewhere(rig, chains, before)
                self.match("ik_match_fk", rig)
                self.assert_recorded(rig, chains, before)

    def test_animated_pose_to_the_solution(self):
        for name, chains in CHAINS.items():
            with self.subTest(name):
                rig, generator = self.animated(name)
                before = self.recorded(rig, chains)
                targets = [(bone, count, add_ik(rig, bone, count)) for bone, count in chains]
                for frame in KEYED:
                    bpy.context.scene.frame_set(frame)
                    for bone, count, target in targets:
                        target.location = samples.random_reachable(samples.joints(rig, bone, count), generator)
                        target.keyframe_insert("location", frame=frame)
                solved = self.recorded(rig, chains)
                self.assert_elsewhere(rig, chains, before)
                self.match("fk_match_ik", rig)
                bpy.ops.motus.ik_remove(object=rig.name)
                self.assert_recorded(rig, chains, solved)
