"""Bones that stretch to their target and keep their volume: scales by formula, on bones that inherit scale in every way."""

import bpy
import numpy as np

import support
from ik.ik_cases import IkTestCase

FAR = (2.4, 0.9, 1.8)
INHERITANCE = ('FULL', 'FIX_SHEAR', 'ALIGNED', 'AVERAGE', 'NONE', 'NONE_LEGACY')


class Volume(IkTestCase):
    def volumes(self, rig, names=("Bone 0", "Bone 1")):
        return [self.pose(rig, name).to_3x3().determinant() for name in names]

    def reach_far(self, **options):
        rig = self.arm(**options)
        self.target(FAR)
        return rig, self.reach(stretch=1.0)

    def test_by_formula(self):
        for inherits in INHERITANCE:
            with self.subTest(inherits):
                support.empty_scene()
                self.scene = bpy.context.scene
                rig, entry = self.reach_far(inherit_scale=inherits)
                for volume in (0.0, 0.5, 1.0):
                    entry.volume = volume
                    self.assertNear(self.tail(rig), FAR)
                    pose = self.pose(rig, "Bone 0").to_3x3()
                    across, along, other = (column.length for column in pose.transposed())
                    self.assertGreater(along, 1.5)
                    self.assertAlmostEqual(across, along ** (-0.5 * volume), delta=2e-6)
                    self.assertAlmostEqual(other, across, delta=2e-6)

    def test_each_bone_keeps_its_volume(self):
        for inherits in ('FULL', 'NONE'):
            with self.subTest(inherits):
                support.empty_scene()
                self.scene = bpy.context.scene
                rig, entry = self.reach_far(inherit_scale=inherits)
                entry.softness = 0.3
                entry.volume = 1.0
                np.testing.assert_allclose(self.volumes(rig), 1.0, atol=2e-6)
                rig.scale = (1.3, 0.8, 0.9)
                rig.pose.bones["Shoulder"].scale = (0.9, 1.2, 1.1)
                stretched = self.volumes(rig)
                entry.stretch = 0.0
                np.testing.assert_allclose(stretched, self.volumes(rig), rtol=5e-6)

    def test_children_keep_their_size(self):
        rig, entry = self.reach_far()
        entry.volume = 1.0
        self.assertAlmostEqual(self.pose(rig, "Hand").to_3x3().determinant(), 1.0, delta=2e-6)

    def test_within_reach_nothing_changes(self):
        rig = self.arm()
        entry = self.reach(stretch=1.0)
        before = self.poses(rig)
        entry.volume = 1.0
        self.assertSamePose(rig, before, 0.0)

    def test_keyed_and_any_order(self):
        rig, entry = self.reach_far()
        support.key(entry, "volume", {1: 0.0, 21: 1.0})
        support.key(entry, "position_weight", {1: 1.0, 41: 0.3})
        found, wanted = {}, {1: 0.0, 21: 1.0, 30.5: 1.0, 41: 1.0}
        for frame in (1, 21, 11, 30.5, 41, 11, 1, 30.5):
            poses = self.poses(rig, frame)
            np.testing.assert_array_equal(poses, found.setdefault(frame, poses))
            if frame in wanted:
                across, along, _ = (column.length for column in self.pose(rig, "Bone 0").to_3x3().transposed())
                self.assertAlmostEqual(across, along ** (-0.5 * wanted[frame]), delta=3e-6)

    def test_over_time(self):
        rig, entry = self.reach_far()
        entry.volume = 0.7
        support.key(bpy.data.objects["Target"], "location", {1: FAR, 40: (0.5, 0.2, 1.3)})
        track = support.addon("core.tracks").world_track(rig.pose.bones["Bone 1"], self.scene)
        frames = [1.0, 7.5, 20.0, 40.0]
        wanted = [np.array(self.pose(rig, "Bone 1", frame)) for frame in frames]
        np.testing.assert_allclose(track.values(frames), wanted, atol=1e-5)

    def test_baked_and_removed(self):
        rig, entry = self.reach_far()
        before = np.array([bone.matrix_local for bone in rig.data.bones])
        entry.volume = 1.0
        live = self.poses(rig, 5)
        self.assertEqual(bpy.ops.motus.bake(object="Rig", frame_start=1, frame_end=10), {'FINISHED'})
        self.assertSamePose(rig, live, 5e-6, 5)
        self.assertEqual(bpy.ops.motus.unbake(object="Rig"), {'FINISHED'})
        self.assertEqual(bpy.ops.motus.ik_remove(object="Rig"), {'FINISHED'})
        self.assertSamePose(rig, before)

    def test_settings_arrive(self):
        self.arm()
        self.target(FAR)
        entry = self.reach(stretch=0.5, volume=0.25)
        self.assertEqual((entry.stretch, entry.volume), (0.5, 0.25))
