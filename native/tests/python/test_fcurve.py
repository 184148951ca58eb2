"""FCurve as Python sees it."""

import unittest

import numpy as np

import motus_native as native

KEYS = np.array([[1, 0, 0, 0, 2, 0], [11, 5, 10, 5, 12, 5]], np.float32)
LINEAR = np.array([1, 1], np.int32)
CYCLES = np.array([1, 2, 0, 0, -np.inf, np.inf, 0, 0, 1.0, 1.0])


class FCurves(unittest.TestCase):
    def test_values(self):
        curve = native.FCurve(KEYS, LINEAR, False)
        np.testing.assert_array_equal(curve.values([3, 21, 1, -5]), (1, 5, 0, 0))
        self.assertEqual(curve.value(3.0), 1.0)
        self.assertTrue(curve.is_plain)
        self.assertEqual(native.FCurve(KEYS, LINEAR, True).value(21), 10.0)

    def test_cycles_and_easings(self):
        curve = native.FCurve(KEYS, LINEAR, False, cycles=CYCLES)
        np.testing.assert_array_equal(curve.values([15, 25, -3]), (7, 12, 3))
        self.assertFalse(curve.is_plain)
        eased = native.FCurve(KEYS, np.array([9, 9], np.int32), False, easings=np.array([1, 1], np.int32))
        self.assertEqual(eased.value(6), 1.25)
        back = native.FCurve(KEYS, np.array([3, 3], np.int32), False, np.array([1, 1], np.int32), np.ones((2, 3), np.float32))
        self.assertEqual(back.value(6), 0.0)

    def test_refusals(self):
        good = {"keys": KEYS, "interpolations": LINEAR, "goes_on": False}
        bad = (
            ("keys", ValueError, np.zeros((2, 5), np.float32)),
            ("keys", ValueError, np.zeros(6, np.float32)),
            ("keys", ValueError, KEYS[::-1].copy()),
            ("keys", ValueError, np.full((2, 6), np.inf, np.float32)),
            ("keys", TypeError, KEYS.astype(float)),
            ("interpolations", ValueError, np.array([1, 13], np.int32)),
            ("interpolations", ValueError, LINEAR[:1].copy()),
            ("easings", ValueError, np.array([1, 4], np.int32)),
            ("shapes", ValueError, np.zeros((2, 2), np.float32)),
            ("cycles", ValueError, CYCLES[:8].copy()),
            ("cycles", ValueError, np.where(CYCLES == 2, 4, CYCLES)),
            ("cycles", ValueError, np.where(CYCLES == 0, -1, CYCLES)),
            ("cycles", ValueError, np.where(CYCLES == 1, np.nan, CYCLES)),
        )
        for name, error, value in bad:
            with self.subTest(name), self.assertRaisesRegex(error, f"^{name}: "):
                native.FCurve(**(good | {name: value}))
        with self.assertRaisesRegex(ValueError, "^keys: "):
            native.FCurve(np.zeros((0, 6), np.float32), np.zeros(0, np.int32), False)
        with self.assertRaisesRegex(ValueError, "^frames: "):
            native.FCurve(KEYS, LINEAR, False).values([np.nan])
        with self.assertRaisesRegex(ValueError, "^frames: "):
            native.FCurve(KEYS, LINEAR, False).values(3.0)


if __name__ == "__main__":
    unittest.main()
