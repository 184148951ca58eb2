"""Pendulums and second-order filters through the binding: shapes, defaults and errors. The formulas are tested natively."""

import math
import unittest

import numpy as np

import motus_native as native


class PendulumTest(unittest.TestCase):
    def test_shapes_and_order_of_times(self):
        times = np.array([3.0, 0.0, -1.0, 0.5])
        single = native.single_pendulum(times, 0.5, length=2.0)
        self.assertEqual(single.shape, (4, 2))
        np.testing.assert_allclose(single[1], [0.5, 0.0], atol=1e-15)
        np.testing.assert_array_equal(native.single_pendulum(0.5, 0.5, length=2.0), single[3])
        double = native.double_pendulum(times, 2.0, 1.0, mass2=0.5)
        self.assertEqual(double.shape, (4, 4))
        np.testing.assert_array_equal(native.double_pendulum(-1.0, 2.0, 1.0, mass2=0.5), double[2])
        self.assertEqual(native.single_pendulum([], 0.5).shape, (0, 2))

    def test_one_number_is_that_of_the_arrays(self):
        angle = native.pendulum_angle(1.5, 0.5, 0.1, 2.0, damping=0.2)
        self.assertEqual(angle, native.single_pendulum(1.5, 0.5, 0.1, 2.0, damping=0.2)[0])
        state = native.double_pendulum(2.5, 2.0, 1.0, mass2=0.5)
        for which in range(4):
            self.assertEqual(native.double_pendulum_value(2.5, which, 2.0, 1.0, mass2=0.5), state[which])
        for call, name in (
            (lambda: native.pendulum_angle(1.0, 0.5, length=0.0), "length"),
            (lambda: native.pendulum_angle(float("inf"), 0.5), "times"),
            (lambda: native.double_pendulum_value(1.0, 4, 0.5, 0.5), "which"),
        ):
            with self.assertRaisesRegex(ValueError, name):
                call()

    def test_period(self):
        period = native.pendulum_period(math.radians(90.0))
        self.assertAlmostEqual(period, 2.3678419475762374, 14)
        self.assertAlmostEqual(native.single_pendulum(period, math.radians(90.0))[0], math.radians(90.0), 12)

    def test_many_are_the_same_as_one_by_one(self):
        starts = np.array([[2.0, 2.0 + 0.0087 * index, 0.0, 0.0] for index in range(5)])
        many = native.double_pendulums(7.5, starts, length2=0.8)
        for row, start in zip(many, starts):
            np.testing.assert_array_equal(row, native.double_pendulum(7.5, *start, length2=0.8))
        pivot = {"pivot_step": 0.04, "pivot_accelerations": 5.0 * np.sin(np.arange(240.0)).reshape(-1, 2)}
        for row, start in zip(native.double_pendulums(3.1, starts, **pivot), starts):
            np.testing.assert_array_equal(row, native.double_pendulum(3.1, *start, **pivot))
        with self.assertRaisesRegex(ValueError, "^time: "):
            native.double_pendulums(1500.0, np.repeat(starts, 100, axis=0))

    def test_moved_pivots(self):
        # Let go together with its pivot, a pendulum does not swing.
        falling = np.tile([0.0, -9.81], (50, 1))
        states = native.single_pendulum([0.0, 1.0], 0.3, pivot_step=0.1, pivot_accelerations=falling)
        np.testing.assert_allclose(states[:, 0], 0.3, atol=1e-12)
        positions = np.stack([np.linspace(0.0, 3.0, 20), np.zeros(20)], axis=1)
        np.testing.assert_allclose(native.pivot_accelerations(0.1, positions), 0.0, atol=1e-9)
        states = native.double_pendulum([1.0], 0.3, 0.3, pivot_step=0.1, pivot_accelerations=falling)
        np.testing.assert_allclose(states[0, :2], 0.3, atol=1e-12)

    def test_spherical(self):
        times = np.array((0.7, -0.3, 2.0))
        states = native.spherical_pendulum(times, 0.8, 0.3, 0.5, 1.5, 1.2, damping=0.1)
        self.assertEqual(states.shape, (3, 6))
        for time, state in zip(times, states):
            np.testing.assert_array_equal(native.spherical_pendulum(time, 0.8, 0.3, 0.5, 1.5, 1.2, damping=0.1), state)
        np.testing.assert_allclose(np.linalg.norm(states[:, :3], axis=1), 1.0, atol=1e-15)
        np.testing.assert_allclose((states[:, :3] * states[:, 3:]).sum(axis=1), 0.0, atol=1e-12)
        # In a plane it is the single pendulum.
        angles = native.single_pendulum(times, 0.8, 0.5, 1.2)[:, 0]
        flat = native.spherical_pendulum(times, 0.8, 0.0, 0.5, length=1.2)
        np.testing.assert_allclose(flat[:, (0, 2)], np.stack((np.sin(angles), -np.cos(angles)), axis=1), atol=1e-10)
        np.testing.assert_array_equal(flat[:, 1], 0.0)
        # In free fall it goes on as it was.
        falling = native.spherical_pendulum(1.0, 0.5, velocity=2.0, pivot_step=1.0, pivot_accelerations=[(0.0, 0.0, -9.81)] * 3)
        np.testing.assert_allclose(falling[:3], (np.sin(2.5), 0.0, -np.cos(2.5)), atol=1e-12)
        for keywords, name in (
            ({"heading": float("nan")}, "heading"),
            ({"angle": 1e10}, "angle"),
            ({"across": float("inf")}, "across"),
            ({"length": 0.0}, "length"),
            ({"pivot_step": 1.0, "pivot_accelerations": [(0.0, 0.0)]}, "pivot_accelerations"),
            ({"pivot_accelerations": [(0.0, 0.0, 0.0)]}, "pivot_step"),
            ({"times": 1e9}, "times"),
        ):
            with self.assertRaisesRegex(ValueError, name):
                native.spherical_pendulum(**{"times": 1.0, "angle": 0.5, **keywords})

    def test_limits(self):
        states = native.double_pendulum(np.linspace(0.0, 5.0, 100), 2.0, 2.0, most_velocity=1.5, most_acceleration=20.0)
        self.assertEqual(np.abs(states[:, 2:]).max(), 1.5)

    def test_errors_name_the_argument(self):
        for keywords, name in (
            ({"length": 0.0}, "length"),
            ({"gravity": -1.0}, "gravity"),
            ({"damping": -1.0}, "damping"),
            ({"theta": math.nan}, "theta"),
            ({"times": [math.nan]}, "times"),
            ({"damping": 0.1, "times": 1e9}, "times"),
            ({"pivot_accelerations": [[0.0, 0.0]]}, "pivot_step"),
            ({"pivot_step": 1.0, "pivot_accelerations": [0.0]}, "pivot_accelerations"),
            ({"pivot_step": 1.0, "pivot_accelerations": [[0.0, 1.0]], "times": -1.0}, "times"),
        ):
            with self.subTest(keywords), self.assertRaisesRegex(ValueError, name):
                native.single_pendulum(**{"times": 1.0, "theta": 0.5, **keywords})
        for keywords, name in (
            ({"mass1": 0.0}, "mass1"),
            ({"length2": -1.0}, "length2"),
            ({"most_velocity": 0.0}, "most_velocity"),
            ({"times": 1e9}, "times"),
            ({"mass2": 1e-30}, "mass2"),
        ):
            with self.subTest(keywords), self.assertRaisesRegex(ValueError, name):
                native.double_pendulum(**{"times": 1.0, "theta1": 0.5, "theta2": 0.5, **keywords})
        with self.assertRaisesRegex(TypeError, "theta"):
            native.single_pendulum(1.0, "much")
        with self.assertRaisesRegex(ValueError, "starts"):
            native.double_pendulums(1.0, [[1.0, 2.0]])
        self.assertGreater(native.double_pendulum_longest_time(2.0, 2.0), 3600.0)


class SecondOrderTest(unittest.TestCase):
    def test_filter(self):
        filter = native.SecondOrder(2.0, 0.5, 0.0)
        self.assertAlmostEqual(filter.overshoot, math.exp(-math.pi * 0.5 / math.sqrt(0.75)), 13)
        k1, k2, k3 = filter.coefficients
        self.assertAlmostEqual(k1, 0.5 / (2.0 * math.pi), 15)
        self.assertAlmostEqual(native.SecondOrder.from_coefficients(k1, k2, k3).frequency, 2.0, 13)
        self.assertAlmostEqual(native.SecondOrder.from_mass_spring(1.0, 4.0, 1.0).response, 2.0, 13)
        same = native.SecondOrder.from_overshoot(filter.overshoot, filter.settling_time(), 0.0)
        self.assertAlmostEqual(same.damping, 0.5, 9)
        self.assertAlmostEqual(native.step_response(0.1, 2.0, 0.5, 0.0), 0.47961214688455489697, 15)
        self.assertEqual(native.step_response([0.0, 0.1], 2.0, 0.5, 0.0).shape, (2,))

    def test_shapes(self):
        times = np.arange(50) / 24.0
        values = np.stack([np.sin(times), times, np.zeros(50)], axis=1)
        outputs = native.second_order(times, values, 2.0, 0.7, 1.0)
        self.assertEqual(outputs.shape, (50, 3))
        np.testing.assert_array_equal(native.second_order(times, values[:, 0], 2.0, 0.7, 1.0), outputs[:, 0])
        filter = native.SecondOrder(2.0, 0.7, 1.0)
        track = native.Track(filter, times, values)
        np.testing.assert_array_equal(track.evaluate(times), outputs)
        self.assertEqual(track.evaluate(0.5).shape, (3,))
        self.assertEqual(native.Track(filter, times, values[:, 0]).evaluate(0.5).shape, ())
        self.assertEqual(native.Track(filter, times, values[:, 0]).evaluate([0.5, 0.6]).shape, (2,))
        plain = native.Track(filter, times, values[:, 0])
        self.assertEqual(plain.value(0.51), plain.evaluate(0.51))
        with self.assertRaisesRegex(ValueError, "inputs"):
            track.value(0.5)
        with self.assertRaisesRegex(ValueError, "time"):
            plain.value(float("nan"))

    def test_memory(self):
        filter = native.SecondOrder(1.0, 0.5, 0.0)
        times = np.arange(100.0)
        turns = np.tile([1.0, 0.0, 0.0, 0.0], (100, 1))
        self.assertEqual(native.Track(filter, times, times).nbytes, 8 * 100 * (1 + 1 + 2))
        self.assertGreaterEqual(native.RotationTrack(filter, times, turns).nbytes, 8 * 100 * (1 + 4 + 3 + 6))

    def test_resets_and_loops(self):
        filter = native.SecondOrder(1.0, 0.3, 0.0)
        track = native.Track(filter, [0.0, 1.0, 2.0], [0.0, 1.0, 9.0], resets=[2])
        self.assertEqual(track.evaluate(2.0), 9.0)
        loop = native.Track(filter, [0.0, 1.0, 2.0], [0.0, 1.0, 0.0], loop=True)
        np.testing.assert_allclose(loop.evaluate([0.3, 1.9]), loop.evaluate([4.3, -0.1]), atol=1e-12)

    def test_rotations(self):
        angles = np.array([0.0, 0.7, 1.1, 0.2])
        rotations = np.stack([np.cos(angles / 2), np.zeros(4), np.zeros(4), np.sin(angles / 2)], axis=1)
        rotations[2] *= -1.0
        filter = native.SecondOrder(1.5, 0.4, 0.0)
        track = native.RotationTrack(filter, [0.0, 0.5, 1.0, 2.0], rotations)
        at = np.linspace(0.0, 3.0, 20)
        found = track.evaluate(at)
        expected = native.Track(filter, [0.0, 0.5, 1.0, 2.0], angles).evaluate(at)
        found *= np.sign(found[:, :1])  # q and -q are the same rotation
        np.testing.assert_allclose(2.0 * np.arctan2(found[:, 3], found[:, 0]), expected, atol=1e-12)
        self.assertEqual(track.evaluate(1.0).shape, (4,))

    def test_errors_name_the_argument(self):
        filter = native.SecondOrder(1.0, 1.0, 0.0)
        for call, name in (
            (lambda: native.SecondOrder(0.0, 1.0, 0.0), "frequency"),
            (lambda: native.SecondOrder(1.0, -1.0, 0.0), "damping"),
            (lambda: native.step_response([0.0, math.inf], 1.0, 1.0, 0.0), "times"),
            (lambda: native.second_order([0.0, 0.0], [1.0, 2.0], 1.0, 1.0, 0.0), "times"),
            (lambda: native.second_order([0.0, 1.0], [1.0], 1.0, 1.0, 0.0), "inputs"),
            (lambda: native.Track(filter, [0.0], [math.nan]), "inputs"),
            (lambda: native.Track(filter, [0.0], [0.0], resets=[-1]), "resets"),
            (lambda: native.Track(filter, [0.0], [0.0], resets=[1]), "resets"),
            (lambda: native.Track(native.SecondOrder(1.0, 0.0, 0.0), [0.0, 1.0], [0.0, 0.0], loop=True), "damping"),
            (lambda: native.RotationTrack(filter, [0.0], [[1.0, 0.0, 0.0]]), "inputs"),
            (lambda: native.RotationTrack(filter, [0.0], [[2.0, 0.0, 0.0, 0.0]]), "inputs"),
        ):
            with self.subTest(name), self.assertRaisesRegex(ValueError, name):
                call()
        with self.assertRaisesRegex(TypeError, "resets"):
            native.Track(filter, [0.0], [0.0], resets=3)
