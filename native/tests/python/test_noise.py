"""Noise through the binding: shapes, types and errors. What it looks like is tested natively."""

import unittest

import numpy as np

import motus_native as native


class NoiseTest(unittest.TestCase):
    def test_shapes_and_types(self):
        places = np.linspace(-5.0, 5.0, 12, dtype=np.float32).reshape(-1, 3)
        for noise, rows in ((native.noise1, places.ravel()), (native.noise2, places[:, :2]), (native.noise3, places)):
            with self.subTest(noise=noise.__name__):
                found = noise(rows, 3)
                self.assertEqual((found.shape, found.dtype), ((len(rows),), np.float32))
                self.assertEqual(noise(rows[2], seed=3), found[2])
                self.assertIsInstance(noise(rows[2]), float)
                self.assertEqual(noise(rows[:0]).shape, (0,))
                self.assertFalse(np.array_equal(noise(rows, 4), found))

    def test_one_number_keeps_its_precision(self):
        late = 1e6 + 0.01
        self.assertNotEqual(native.noise1(late), native.noise1(1e6))
        self.assertAlmostEqual(native.noise1(late), native.noise1(1e6), 1)

    def test_gusts(self):
        times = np.linspace(0.0, 10.0, 7)
        found = native.gusts(times, 0.5)
        self.assertEqual((found.shape, found.dtype), ((7,), np.float64))
        self.assertEqual(native.gusts(times[2:3], frequency=0.5)[0], found[2])
        self.assertAlmostEqual(native.gusts([1.0], 0.5, period=3.0)[0], native.gusts([4.0], 0.5, 3.0)[0], 12)

    def test_errors_name_the_argument(self):
        for call, name in (
            (lambda: native.noise1(float("nan")), "x"),
            (lambda: native.noise1([1e300]), "x"),
            (lambda: native.noise1([[1.0]]), "x"),
            (lambda: native.noise2([1.0, 2.0, 3.0]), "xy"),
            (lambda: native.noise3([[1.0, 2.0]]), "xyz"),
            (lambda: native.noise1(0.5, -1), "seed"),
            (lambda: native.noise1(0.5, 0.5), "seed"),
            (lambda: native.noise1(0.5, 2**32), "seed"),
            (lambda: native.gusts([float("nan")], 1.0), "times"),
            (lambda: native.gusts([[1.0]], 1.0), "times"),
            (lambda: native.gusts([1.0], 0.0), "frequency"),
            (lambda: native.gusts([1.0], 1.0, -1.0), "period"),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(ValueError, f"^{name}: "):
                call()
        with self.assertRaisesRegex(TypeError, "^x: "):
            native.noise1("a")
