"""solve_chain() through the binding."""

import unittest

import numpy as np

import motus_native as native


def lengths_of(joints):
    return np.linalg.norm(np.diff(joints, axis=0), axis=1)


def random_joints(generator, bones):
    return np.cumsum(np.vstack([[0.0, 0.0, 0.0], generator.normal(size=(bones, 3))]), axis=0)


def turned(quaternion, vector):
    w, axis = quaternion[0], quaternion[1:]
    across = np.cross(axis, vector)
    return vector + 2.0 * (w * across + np.cross(axis, across))


def product(a, b):
    w = a[0] * b[0] - a[1:] @ b[1:]
    return np.concatenate([[w], a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])])


def conjugate(quaternion):
    return quaternion * np.array([1.0, -1.0, -1.0, -1.0])


class FreeChainTest(unittest.TestCase):
    def test_reaches(self):
        generator = np.random.default_rng(1)
        for bones in (2, 3, 5, 20, 100, 255):
            joints = random_joints(generator, bones)
            before = joints.copy()
            target = generator.normal(size=3)
            target *= 0.5 * lengths_of(joints).sum() / np.linalg.norm(target)
            solution = native.solve_chain(joints, target)
            self.assertIs(solution.reason, native.Reason.REACHED)
            self.assertEqual(solution.joints.shape, (bones + 1, 3))
            self.assertIsNone(solution.rotations)
            self.assertIsInstance(solution.residual, float)
            self.assertIsInstance(solution.iterations, int)
            np.testing.assert_array_equal(joints, before)
            np.testing.assert_array_equal(solution.joints[0], joints[0])
            np.testing.assert_allclose(lengths_of(solution.joints), lengths_of(joints), rtol=1e-11)
            measured = np.linalg.norm(solution.joints[-1] - target)
            self.assertAlmostEqual(solution.residual, measured, delta=1e-12 * bones)
            self.assertLessEqual(measured, 1e-6 * lengths_of(joints).sum())

    def test_out_of_reach(self):
        joints = np.array([[0, 0, 0], [0, 1, 0], [0, 2, 0.5]])
        reach = lengths_of(joints).sum()
        solution = native.solve_chain(joints, [0, 0, 9])
        self.assertIs(solution.reason, native.Reason.TOO_FAR)
        np.testing.assert_allclose(solution.joints[-1], [0, 0, reach], atol=1e-15)
        self.assertAlmostEqual(solution.residual, 9 - reach)
        near = native.solve_chain([[0, 0, 0], [0, 3, 0], [0, 3, 1]], [0, 0, 0.5])
        self.assertIs(near.reason, native.Reason.TOO_NEAR)
        np.testing.assert_allclose(near.joints, [[0, 0, 0], [0, 0, 3], [0, 0, 2]], atol=1e-15)

    def test_pole_and_plane(self):
        straight = [[0, 0, 0], [0, 1, 0], [0, 2, 0], [0, 3, 0]]
        by_pole = native.solve_chain(straight, [0, 2, 0], pole=[5, 1, 0]).joints
        self.assertTrue((by_pole[1:3, 0] > 0.1).all())
        np.testing.assert_allclose(by_pole[:, 2], 0.0, atol=1e-12)
        by_plane = native.solve_chain(straight, [0, 2, 0], plane=[1, 0, 0]).joints
        self.assertTrue((by_plane[1:3, 2] > 0.1).all())  # X x Y = Z
        np.testing.assert_allclose(by_plane[:, 0], 0.0, atol=1e-12)

    def test_iterations(self):
        joints = random_joints(np.random.default_rng(2), 6)
        stopped = native.solve_chain(joints, [0.5, 0.2, 0.1], max_iterations=0)
        self.assertIs(stopped.reason, native.Reason.ITERATIONS)
        self.assertEqual(stopped.iterations, 0)
        exact = native.solve_chain(joints, [0.5, 0.2, 0.1], tolerance=1e-13)
        self.assertLess(exact.residual, 1e-12)

    def test_errors_name_the_argument(self):
        good = [[0, 0, 0], [0, 1, 0], [0, 2, 0]]
        values = (
            (dict(joints=[[0, 0, 0]]), "joints"),
            (dict(joints=np.zeros((257, 3))), "joints"),
            (dict(joints=[[0, 0], [1, 1]]), "joints"),
            (dict(joints=[[0, 0, 0], [0, np.nan, 0]]), "joints"),
            (dict(joints=[[0, 0, 0], [0, 1.7e308, 0]]), "joints"),
            (dict(target=[0, 0, 1.7e308]), "target"),
            (dict(target=[0, 0]), "target"),
            (dict(target=[0, 0, np.inf]), "target"),
            (dict(tolerance=0.0), "tolerance"),
            (dict(max_iterations=-1), "max_iterations"),
            (dict(pole=[1, 2]), "pole"),
            (dict(plane=[np.nan, 0, 0]), "plane"),
            (dict(limits=np.zeros((3, 6))), "limits"),
            (dict(limits=[[0.1, 0, 0, 0, 0, 0]] * 2), "limits"),
            (dict(limits=[[np.nan, 0, 0, 1, 1, 1]] * 2), "limits"),
            (dict(limits=[[np.inf] * 6] * 2), "limits"),
            (dict(frames=np.ones((2, 4))), "frames"),
            (dict(frames=np.ones((3, 4)), limits=np.zeros((2, 6))), "frames"),
            (dict(frames=np.zeros((2, 4)), limits=np.zeros((2, 6))), "frames"),
        )
        for changed, name in values:
            with self.assertRaisesRegex(ValueError, f"^{name}:", msg=str(changed)):
                native.solve_chain(**{"joints": good, "target": [0, 1, 1], **changed})
        types = (
            (dict(joints="chain"), "joints"),
            (dict(max_iterations=1.5), "max_iterations"),
            (dict(tolerance="small"), "tolerance"),
            (dict(limits=[["a"] * 6] * 2), "limits"),
        )
        for changed, name in types:
            with self.assertRaisesRegex(TypeError, f"^{name}:", msg=str(changed)):
                native.solve_chain(**{"joints": good, "target": [0, 1, 1], **changed})


class LimitedChainTest(unittest.TestCase):
    JOINTS = np.array([[0.0, 0, 0], [0, 1, 0], [0, 2, 0], [0, 3, 0]])

    def test_free_limits_do_not_limit(self):
        solution = native.solve_chain(self.JOINTS, [1, 1, 0.5], limits=np.array([[-np.inf] * 3 + [np.inf] * 3] * 3))
        self.assertIs(solution.reason, native.Reason.REACHED)
        self.assertEqual(solution.rotations.shape, (3, 4))

    def test_hinges_about_x(self):
        limits = np.zeros((3, 6))
        limits[:, 3] = 1.0  # from 0 to 1 rad about X: Y turns to Z
        solution = native.solve_chain(self.JOINTS, [0.0, 1.5, 2.0], limits=limits)
        self.assertIs(solution.reason, native.Reason.REACHED)
        np.testing.assert_allclose(solution.joints[:, 0], 0.0, atol=1e-12)
        angles = 2.0 * np.arctan2(solution.rotations[:, 1], solution.rotations[:, 0])
        self.assertTrue((angles > -1e-9).all() and (angles < 1.0 + 1e-9).all())
        np.testing.assert_allclose(solution.rotations[:, 2:], 0.0, atol=1e-12)
        wrong_side = native.solve_chain(self.JOINTS, [0.0, 1.5, -2.0], limits=limits)
        self.assertIs(wrong_side.reason, native.Reason.LIMIT)

    def test_locked(self):
        solution = native.solve_chain(self.JOINTS, [1, 1, 1], limits=np.zeros((3, 6)))
        self.assertIs(solution.reason, native.Reason.LIMIT)
        np.testing.assert_allclose(solution.joints, self.JOINTS, atol=1e-15)

    def test_rotations_are_relative_to_the_given_pose(self):
        generator = np.random.default_rng(3)
        for _ in range(20):
            joints = random_joints(generator, 4)
            frames = generator.normal(size=(4, 4))
            frames /= np.linalg.norm(frames, axis=1)[:, None]
            solution = native.solve_chain(
                joints, joints[-1] + 0.3, limits=np.tile([-0.5, -0.2, -0.3, 0.4, 0.3, 0.5], (4, 1)), frames=frames
            )
            np.testing.assert_allclose(np.linalg.norm(solution.rotations, axis=1), 1.0, rtol=1e-12)
            frame = frames[0]
            place = joints[0]
            for i in range(4):
                rest = product(conjugate(frames[i - 1]), frames[i]) if i else np.array([1.0, 0, 0, 0])
                frame = product(product(frame, rest), solution.rotations[i])
                place = place + turned(frame, turned(conjugate(frames[i]), joints[i + 1] - joints[i]))
                np.testing.assert_allclose(solution.joints[i + 1], place, atol=1e-10)

    def test_own_frames(self):
        # Without frames they are carried from bone to bone: about X here, so that X stays the hinge.
        joints = np.array([[0.0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 2, 1]])
        limits = np.zeros((3, 6))
        limits[:, 0], limits[:, 3] = -1.0, 1.0
        solution = native.solve_chain(joints, [0.0, 2.2, 0.5], limits=limits)
        self.assertIs(solution.reason, native.Reason.REACHED)
        np.testing.assert_allclose(solution.joints[:, 0], 0.0, atol=1e-12)
