"""Stereo through the binding: shapes, types, errors, and numbers that are known. What holds beyond is tested natively."""

import math
import unittest

import numpy as np

import motus_native as native

LENS = {"focal_length": 35.0, "sensor_width": 36.0}
EYES = {"interaxial": 0.065, "convergence": 3.0, **LENS}
SCREEN = {"width": 12.0, "viewing_distance": 15.0}


class StereoTest(unittest.TestCase):
    def test_the_known_budget(self):
        interaxial, convergence = native.solve_depth_budget(2.0, 10.0, 0.01, 0.02, **LENS)
        self.assertAlmostEqual(interaxial, 0.077143, 6)
        self.assertAlmostEqual(convergence, 2.727273, 6)
        near, far = native.parallax([2.0, 10.0], interaxial, 35.0, 36.0, convergence)
        self.assertAlmostEqual(near, -0.01, 14)
        self.assertAlmostEqual(far, 0.02, 14)
        back = native.depth_budget(0.01, 0.02, interaxial, 35.0, 36.0, convergence)
        np.testing.assert_allclose(back, (2.0, 10.0), rtol=1e-12)

    def test_shapes_and_types(self):
        self.assertIsInstance(native.parallax(2, **EYES), float)
        depths = np.linspace(1.0, 9.0, 5, dtype=np.float32)
        found = native.parallax(depths, **EYES)
        self.assertEqual((found.shape, found.dtype), ((5,), np.float64))
        self.assertEqual(native.parallax(np.empty(0), **EYES).shape, (0,))
        self.assertEqual(native.roundness(depths, **EYES, **SCREEN).shape, (5,))
        self.assertEqual(native.seen_distance(found, **SCREEN).shape, (5,))
        pairs = native.stereo_points(np.array([(0.2, 0.1, 2.0), (0.0, 0.0, 3.0)]), **EYES)
        self.assertEqual(pairs.shape, (2, 2, 2))
        self.assertAlmostEqual(pairs[0, 1, 0] - pairs[0, 0, 0], native.parallax(2.0, **EYES), 14)
        np.testing.assert_allclose(pairs[1], 0.0, atol=1e-15)

    def test_modes_and_infinity(self):
        self.assertEqual(native.parallax(4.0, **EYES, mode="parallel"), native.parallax(4.0, **{**EYES, "convergence": math.inf}))
        self.assertEqual(native.vertical_parallax(3.0, 1.5, **EYES, mode="off_axis"), 0.0)
        self.assertGreater(native.vertical_parallax(3.0, 1.5, **EYES), 0.0)
        self.assertEqual(native.depth_budget(0.01, 1.0, **EYES)[1], math.inf)
        self.assertGreater(native.solve_depth_budget(1.0, math.inf, 0.01, 0.02, **LENS)[0], 0.0)

    def test_around(self):
        self.assertIsInstance(native.parallax_around(3, 0.065, 2.0), float)
        found = native.parallax_around([1.0, 2.0, 50.0], 0.065, 2.0)
        ray = 0.0325 * math.cos(math.atan(0.0325 / 2.0))
        wanted = [2.0 * (math.asin(ray / 2.0) - math.asin(ray / distance)) for distance in (1.0, 2.0, 50.0)]
        np.testing.assert_allclose(found, wanted, atol=1e-15)
        self.assertEqual(native.parallax_around(3.0, 0.065, 2.0, elevation=1.5, merge_from=1.0, merge_to=1.3), 0.0)
        for keywords in ({"elevation": 2.0}, {"merge_from": 1.0, "merge_to": 0.5}):
            with self.assertRaisesRegex(ValueError, next(reversed(keywords))):
                native.parallax_around(3.0, 0.065, 2.0, **keywords)

    def test_screens(self):
        self.assertAlmostEqual(native.divergence_limit(12.0), 0.0054, 4)
        self.assertEqual(native.seen_distance(0.02, **SCREEN), math.inf)
        near, far = native.comfortable_parallax(**SCREEN)
        self.assertGreater(near, 0.0)
        self.assertAlmostEqual(far, native.divergence_limit(12.0), 12)  # which is nearer than one degree

    def test_samples(self):
        self.assertEqual(native.depth_range([3.0, 1.0, 2.0], 0.0, 1.0), (1.0, 3.0))
        self.assertIsNone(native.depth_range([]))
        left, right = native.window_violations([-0.5, 0.0], [1.0, 1.0], **EYES)
        self.assertAlmostEqual(left, -native.parallax(1.0, **EYES))
        self.assertEqual(right, 0.0)
        np.testing.assert_array_equal(native.smooth_ahead([5.0, 1.0, 5.0], 1, "below"), [1.0, 1.0, 1.0])

    def test_errors_name_the_argument(self):
        budget = {"near": 2.0, "far": 10.0, "near_parallax": 0.01, "far_parallax": 0.02, **LENS}
        samples = {"x": [0.0], "depths": [1.0], **EYES}
        for function, good, name, value in (
            (native.parallax, {"depth": 2.0, **EYES}, "depth", 0.0),
            (native.parallax, {"depth": 2.0, **EYES}, "depth", [-1.0]),
            (native.parallax, {"depth": 2.0, **EYES}, "interaxial", -0.1),
            (native.parallax, {"depth": 2.0, **EYES}, "focal_length", 0.0),
            (native.parallax, {"depth": 2.0, **EYES}, "sensor_width", 0.0),
            (native.parallax, {"depth": 2.0, **EYES}, "convergence", 0.0),
            (native.parallax, {"depth": 2.0, **EYES}, "convergence", math.nan),
            (native.parallax, {"depth": 2.0, **EYES}, "mode", "cross"),
            (native.solve_depth_budget, budget, "near", 0.0),
            (native.solve_depth_budget, budget, "far", 2.0),
            (native.solve_depth_budget, budget, "near_parallax", -0.01),
            (native.solve_depth_budget, budget, "far_parallax", math.nan),
            (native.solve_depth_budget, budget, "focal_length", 0.0),
            (native.stereo_points, {"points": [(0.0, 0.0, 1.0)], **EYES}, "point", [(0.0, 0.0, -1.0)]),
            (native.seen_distance, {"parallax": 0.0, **SCREEN}, "width", 0.0),
            (native.seen_distance, {"parallax": 0.0, **SCREEN}, "viewing_distance", -1.0),
            (native.comfortable_parallax, SCREEN, "angle", 0.0),
            (native.depth_range, {"depths": [1.0]}, "low", 2.0),
            (native.window_violations, samples, "depths", [1.0, 2.0]),
            (native.window_violations, samples, "tolerance", -1.0),
            (native.smooth_ahead, {"values": [1.0], "ahead": 1}, "ahead", -1),
            (native.smooth_ahead, {"values": [1.0], "ahead": 1}, "ahead", 10001),
            (native.smooth_ahead, {"values": [1.0], "ahead": 1}, "side", "left"),
        ):
            key = "points" if name == "point" else name
            with self.subTest(function=function.__name__, name=name, value=value), self.assertRaisesRegex(ValueError, f"\\b{name}\\b"):
                function(**{**good, key: value})
        with self.assertRaises(TypeError):
            native.parallax("near", **EYES)
