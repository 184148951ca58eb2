"""ease() and Timing through the binding."""

import unittest

import numpy as np

import motus_native as native


class EaseTest(unittest.TestCase):
    def test_numbers_and_arrays(self):
        self.assertEqual(native.ease(0.5, 0.25, 0.25), 0.5)
        self.assertIsInstance(native.ease(1, 0, 0), float)
        u = np.linspace(-0.5, 1.5, 201)
        values = native.ease(u, 0.2, 0.3)
        self.assertEqual(values.shape, (201,))
        self.assertTrue((np.diff(values) >= 0.0).all())
        self.assertEqual((values[0], values[-1]), (0.0, 1.0))
        np.testing.assert_allclose(values, [native.ease(float(x), 0.2, 0.3) for x in u], rtol=0, atol=0)

    def test_derivative(self):
        u = np.linspace(0.01, 0.99, 99)
        numeric = (native.ease(u + 1e-6, 0.33, 0.44) - native.ease(u - 1e-6, 0.33, 0.44)) / 2e-6
        np.testing.assert_allclose(native.ease_derivative(u, 0.33, 0.44), numeric, atol=1e-5)

    def test_domain(self):
        for arguments, name in (((0.5, 0.6, 0.6), "ease_in"), ((0.5, -0.1, 0.0), "ease_in"), ((0.5, 0.0, 1.1), "ease_out")):
            with self.assertRaisesRegex(ValueError, name):
                native.ease(*arguments)
        for function in (native.ease, native.ease_derivative):
            with self.assertRaisesRegex(ValueError, "^u:"):
                function(float("nan"), 0.1, 0.1)
            with self.assertRaisesRegex(TypeError, "^u:"):
                function("half", 0.1, 0.1)
            with self.assertRaisesRegex(ValueError, "^ease_in:"):
                function(0.5, float("nan"), 0.1)
            with self.assertRaisesRegex(TypeError, "^ease_out:"):
                function(0.5, 0.1, "half")


class TimingTest(unittest.TestCase):
    def test_eased(self):
        timing = native.Timing.eased(4.0, 10.0, ease_in=0.25, ease_out=0.25)
        np.testing.assert_allclose(timing.distance(np.array([-1.0, 0.0, 2.0, 4.0, 5.0])), [0, 0, 5, 10, 10])
        self.assertEqual(timing.speed(-1.0), 0.0)
        for after, distance in (('rest', 10.0), ('go_on', 10.0), ('repeat', 25.0)):
            timing = native.Timing.eased(4.0, 10.0, 0.25, 0.25, after=after)
            self.assertEqual(timing.distance(10.0), distance)
        self.assertEqual(native.Timing.eased(4.0, 10.0, after='go_on').distance(10.0), 25.0)

    def test_constant(self):
        self.assertEqual(native.Timing.constant(3.0).distance(-2.0), -6.0)

    def test_pins(self):
        timing = native.Timing.pins([1.0, 2.0, 3.0], [0.0, 5.0, 5.0])
        self.assertEqual(timing.distance(2.0), 5.0)
        self.assertEqual(timing.distance(2.5), 5.0)
        self.assertEqual(timing.distance(0.0), 0.0)

    def test_speeds(self):
        self.assertAlmostEqual(native.Timing.speeds([0.0, 2.0], [0.0, 4.0]).distance(2.0), 4.0)
        self.assertAlmostEqual(native.Timing.speeds_by_distance([0.0, 9.0], [3.0, 3.0]).distance(2.0), 6.0)
        laps = native.Timing.speeds_by_distance([0.0, 5.0], [1.0, 3.0], lap=10.0)
        self.assertAlmostEqual(laps.distance(2.0 * 5.0 * np.log(3.0) / 2.0), 10.0)

    def test_errors_name_the_argument(self):
        make = native.Timing
        cases = (
            (lambda: make.eased(0.0, 1.0), "duration"),
            (lambda: make.eased(1.0, float("inf")), "length"),
            (lambda: make.eased(1.0, 1.0, after="later"), "after"),
            (lambda: make.constant(float("nan")), "speed"),
            (lambda: make.pins([0.0, 0.0], [1.0, 2.0]), "times"),
            (lambda: make.pins([0.0, 1.0], [1.0]), "distances"),
            (lambda: make.pins([], []), "times"),
            (lambda: make.pins([0.0], [float("nan")]), "distances"),
            (lambda: make.speeds([1.0, 0.0], [1.0, 1.0]), "times"),
            (lambda: make.speeds_by_distance([0.0, 1.0], [1.0, 0.0]), "speeds"),
            (lambda: make.speeds_by_distance([0.0, 1.0], [1.0, 1.0], lap=0.5), "distances"),
            (lambda: make.speeds_by_distance([0.0, 1.0], [1.0, 1.0], lap=0.0), "lap"),
            (lambda: make.constant(1.0).distance([[1.0]]), "time"),
        )
        for call, name in cases:
            with self.assertRaisesRegex(ValueError, name):
                call()
        for call, name in (
            (lambda: make.eased("4", 1.0), "duration"),
            (lambda: make.eased(4.0, None), "length"),
            (lambda: make.constant([1.0]), "speed"),
        ):
            with self.assertRaisesRegex(TypeError, f"^{name}:"):
                call()
