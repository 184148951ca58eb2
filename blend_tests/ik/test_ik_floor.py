"""Floors below which the end of a chain does not go: by formula, on moved and keyed planes, over time."""

import bpy
import numpy as np
from mathutils import Matrix, Vector

import support
from ik.ik_cases import IkTestCase


def lifted(height, margin):
    """Height of the end for that of the target, by the formula of docs/ik.md."""
    return height if height >= margin else 0.0 if height <= -margin else (height + margin) ** 2 / (4.0 * margin)


class Floor(IkTestCase):
    def setUp(self):
        super().setUp()
        self.made = self.arm()
        self.floor = self.link("Deck", None, (0.0, 0.0, 0.6))
        self.entry = self.reach()
        self.entry.floor = self.floor

    def aim(self, x, z):
        bpy.data.objects["Target"].location = (x, 0.3, z)

    def test_by_formula(self):
        for margin in (0.0, 0.2):
            for height in (0.0, 0.15):
                self.entry.floor_margin, self.entry.floor_height = margin, height
                for z in (-0.2, 0.4, 0.55, 0.6, 0.7, 0.75, 0.85, 1.0, 1.4):
                    with self.subTest(margin=margin, height=height, z=z):
                        self.aim(0.6, z)
                        wanted = 0.6 + height + lifted(z - 0.6 - height, margin)
                        self.assertNear(self.tail(self.made), (0.6, 0.3, wanted), 5e-6)

    def test_a_turned_and_scaled_plane(self):
        turn = Matrix.Rotation(0.5, 3, 'X')
        for side in (1.0, -1.0):
            self.floor.matrix_world = Matrix.LocRotScale(Vector((0.2, 0.1, 0.7)), turn.to_quaternion(), Vector((3.0, 0.5, 2.0 * side)))
            for z in (0.0, 0.4, 0.9, 1.4):
                self.aim(0.6, z)
                height = side * (turn @ Vector((0.0, 0.0, 1.0))).dot(self.tail(self.made) - self.floor.location)
                self.assertGreater(height, -1e-5)

    def test_the_end_reaches_what_stands_on_the_floor(self):
        self.aim(0.6, 0.2)
        self.assertLess(self.output(self.made, "Bone 1.residual"), 1e-5)
        self.assertEqual(self.sentence(self.made), "")

    def test_keyed_floor_in_any_order(self):
        support.key(self.floor, "location", {1: (0.0, 0.0, 0.2), 21: (0.0, 0.0, 1.1)})
        support.key(self.entry, "floor_height", {1: 0.0, 21: 0.2})
        self.aim(0.6, 0.3)
        found = {}
        for frame in (1, 21, 11, 5.5, 21, 5.5, 1, 11):
            poses = self.poses(self.made, frame)
            np.testing.assert_array_equal(poses, found.setdefault(frame, poses))
        self.assertNear(self.tail(self.made, frame=1), (0.6, 0.3, 0.3), 5e-6)
        self.assertNear(self.tail(self.made, frame=21), (0.6, 0.3, 1.3), 5e-6)

    def test_over_time(self):
        support.key(self.floor, "location", {1: (0.0, 0.0, 0.2), 21: (0.0, 0.0, 1.1)})
        self.entry.floor_margin = 0.3
        self.aim(0.6, 0.3)
        frames = [1.0, 6.5, 14.0, 21.0]
        wanted = [np.array(self.pose(self.made, "Bone 1", frame)) for frame in frames]
        track = support.addon("core.tracks").world_track(self.made.pose.bones["Bone 1"], self.scene)
        np.testing.assert_allclose(track.values(frames), wanted, atol=1e-5)

    def test_without_and_with_a_deleted_floor(self):
        self.aim(0.6, 0.3)
        self.entry.floor = None
        self.assertNear(self.tail(self.made), (0.6, 0.3, 0.3), 5e-6)
        self.entry.floor = self.floor
        self.assertNear(self.tail(self.made), (0.6, 0.3, 0.6), 5e-6)
        bpy.context.scene.collection.objects.unlink(self.floor)
        self.assertNear(self.tail(self.made), (0.6, 0.3, 0.3), 5e-6)

    def test_a_floor_that_hangs_on_the_chain_is_told(self):
        self.floor.parent, self.floor.parent_type, self.floor.parent_bone = self.made, 'BONE', "Hand"
        bpy.ops.motus.refresh(object="Rig")
        self.assertIn("moves with the chain", self.sentence(self.made))

    def test_weight_zero_is_the_animation(self):
        self.entry.position_weight = 0.0
        self.aim(0.6, 1.4)
        before = self.poses(self.made)
        self.aim(0.6, 0.2)
        np.testing.assert_array_equal(self.poses(self.made), before)
