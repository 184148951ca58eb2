"""PoseBuffer: poses that a solver fills at each frame."""

import unittest

import numpy as np

import motus_native as native


class PoseBufferTest(unittest.TestCase):
    def setUp(self):
        rng = np.random.default_rng(3)
        self.told = np.zeros(4)
        self.poses = native.PoseBuffer(5, self.told)
        self.values = rng.normal(size=(5, 3)), rng.normal(size=(5, 4)), rng.normal(size=(5, 3))

    def fill(self, poses):
        poses.locations[:], poses.rotations[:], poses.scales[:] = self.values

    def assertNeutral(self, poses):
        self.assertTrue((poses.locations == 0.0).all() and (poses.scales == 1.0).all())
        np.testing.assert_array_equal(poses.rotations, [[1.0, 0.0, 0.0, 0.0]] * 5)

    def test_poses_are_neutral_until_they_are_filled_and_after_a_reset(self):
        self.assertNeutral(self.poses)
        self.fill(self.poses)
        self.poses.reset()
        self.assertNeutral(self.poses)

    def test_a_view_outlives_the_buffer(self):
        self.fill(self.poses)
        rotations = self.poses.rotations
        del self.poses
        np.testing.assert_array_equal(rotations, self.values[1])

    def test_matrices_are_those_of_pack_matrices(self):
        locations, rotations, scales = self.values
        for has_scales in (False, True):
            self.fill(self.poses)
            self.poses.forget()
            found = self.poses.matrices(has_scales)
            wanted = native.pack_matrices(locations, rotations, scales=scales if has_scales else None)
            np.testing.assert_array_equal(found.reshape(5, 16), wanted)

    def test_slots(self):
        locations, rotations, scales = self.values
        self.fill(self.poses)
        for has_scales in (False, True):
            slots = np.zeros(45 if has_scales else 30)
            self.poses.forget()
            self.assertTrue(self.poses.write_slots(slots, has_scales))
            np.testing.assert_array_equal(slots[:30].reshape(5, 6), np.hstack((locations, native.euler_xyz(rotations))))
            np.testing.assert_array_equal(slots[30:], scales.ravel() if has_scales else [])

    def test_poses_that_have_not_changed_are_not_written_again(self):
        self.fill(self.poses)
        self.assertIsNotNone(self.poses.matrices(True))
        self.assertIsNone(self.poses.matrices(True))
        slots = np.zeros(30)
        self.assertFalse(self.poses.write_slots(slots, False))
        self.assertFalse(slots.any())
        self.poses.locations[4, 2] = -0.0
        self.assertIsNotNone(self.poses.matrices(True))
        self.poses.locations[4, 2] = 0.0
        self.assertIsNotNone(self.poses.matrices(True), "the two zeros are different numbers")
        self.poses.forget()
        self.assertIsNotNone(self.poses.matrices(True))

    def test_numbers_that_are_not_ordinary(self):
        self.assertTrue(self.poses.is_ordinary())
        for array in (self.poses.locations, self.poses.rotations, self.poses.scales, self.told):
            for number in (np.nan, np.inf, -np.inf, 1e200, -1e15):
                before = array.flat[-1]
                array.flat[-1] = number
                self.assertFalse(self.poses.is_ordinary())
                array.flat[-1] = before
                self.assertTrue(self.poses.is_ordinary())

    def test_no_members(self):
        poses = native.PoseBuffer(0, np.zeros(0))
        self.assertEqual(poses.locations.shape, (0, 3))
        self.assertTrue(poses.is_ordinary())
        self.assertIsNone(poses.matrices(False), "nothing is new")
        poses.write_slots(np.zeros(0), True)

    def test_errors_name_the_argument(self):
        frozen = np.zeros(2)
        frozen.flags.writeable = False
        cases = (
            (ValueError, "count", lambda: native.PoseBuffer(-1, self.told)),
            (ValueError, "count", lambda: native.PoseBuffer(2**31 - 1, self.told)),
            (TypeError, "count", lambda: native.PoseBuffer("5", self.told)),
            (TypeError, "outputs", lambda: native.PoseBuffer(5, [0.0])),
            (TypeError, "outputs", lambda: native.PoseBuffer(5, np.zeros(4, np.float32))),
            (TypeError, "outputs", lambda: native.PoseBuffer(5, np.zeros((4, 2))[:, 0])),
            (TypeError, "outputs", lambda: native.PoseBuffer(5, frozen)),
            (ValueError, "slots", lambda: self.poses.write_slots(np.zeros(31), False)),
            (TypeError, "slots", lambda: self.poses.write_slots(None, False)),
        )
        for error, name, failing in cases:
            with self.subTest(name), self.assertRaisesRegex(error, f"^{name}: "):
                failing()
        self.poses.rotations[2] = 0.0
        with self.assertRaisesRegex(ValueError, "^rotations: "):
            self.poses.matrices(False)
        self.poses.forget()
        with self.assertRaisesRegex(ValueError, "^rotations: "):
            self.poses.write_slots(np.zeros(30), False)


if __name__ == "__main__":
    unittest.main()
