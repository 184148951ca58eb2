"""Screens through the binding: shapes, types and errors. What is found in pictures is tested natively."""

import unittest

import numpy as np

import motus_native as native

GREEN = (0.05, 0.45, 0.08)


def picture(rows=24, columns=32):
    """A grey square in front of a green screen."""
    found = np.ones((rows, columns, 4), np.float32)
    found[..., :3] = GREEN
    found[rows // 3 : 2 * rows // 3, columns // 3 : 2 * columns // 3, :3] = 0.4
    return found


class ColourTest(unittest.TestCase):
    def test_shapes_and_types(self):
        found = native.screen_color(picture())
        self.assertEqual((found.shape, found.dtype), ((3,), np.float64))
        np.testing.assert_allclose(found, GREEN, atol=1e-6)
        report = native.screen_report(picture(), found)
        self.assertEqual(sorted(report), ["black", "chroma_spread", "luminance_spread", "share", "spill", "white"])
        self.assertTrue(all(isinstance(value, float) for value in report.values()))
        matte = native.screen_matte(picture(), found)
        self.assertEqual((matte.shape, matte.dtype), ((24, 32), np.float64))
        self.assertEqual((matte.min(), matte.max()), (0.0, 1.0))

    def test_any_real_numbers_and_views(self):
        whole = np.zeros((8, 8, 4), np.int32)
        whole[..., 1] = whole[..., 3] = 1
        np.testing.assert_array_equal(native.screen_color(whole), (0.0, 1.0, 0.0))
        np.testing.assert_allclose(native.screen_color(picture()[::-2, ::3]), GREEN, atol=1e-6)

    def test_no_screen(self):
        self.assertIsNone(native.screen_color(np.full((5, 7, 4), 0.5)))
        self.assertIsNone(native.screen_color(np.full((1, 1, 4), 0.5)))

    def test_errors_name_the_argument(self):
        broken = picture()
        broken[3, 4, 1] = np.nan
        for call, name in (
            (lambda: native.screen_color(np.zeros((4, 4, 3))), "picture"),
            (lambda: native.screen_color(np.zeros((0, 4, 4))), "picture"),
            (lambda: native.screen_color(broken), "picture"),
            (lambda: native.screen_color(np.full((2, 2, 4), np.inf)), "picture"),
            (lambda: native.screen_report(picture(), (0.5, 0.5, 0.5)), "color"),
            (lambda: native.screen_report(picture(), (0.5, 0.5)), "color"),
            (lambda: native.screen_matte(picture(), (0.5, float("inf"), 0.5)), "color"),
            (lambda: native.screen_matte(picture(), GREEN, 1.5), "balance"),
            (lambda: native.screen_matte(picture(), GREEN, gain=-1.0), "gain"),
            (lambda: native.screen_report(picture(), GREEN, -0.5), "balance"),
            (lambda: native.screen_report(picture(), (0.7, 0.1, 0.8)), "color"),
            (lambda: native.screen_report(picture(), (0.0, 0.6, 0.6)), "color"),
            (lambda: native.screen_matte(picture(), (0.0, 0.6, 0.6)), "color"),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(ValueError, f"^{name}: "):
                call()
        with self.assertRaisesRegex(TypeError, "^picture: "):
            native.screen_color(np.zeros((2, 2, 4), bool))
