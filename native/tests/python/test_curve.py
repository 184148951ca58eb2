"""The curve classes of motus_native as Python sees them: shapes, dtypes, errors, docstrings."""

import threading
import unittest

import numpy as np

import motus_native as native

S_CURVE = np.array([(0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (1.0, 4.0, 0.0), (4.0, 4.0, 0.0)])
S_LENGTH = 6.289030810696900


def smooth_spline(count=8, cyclic=True):
    points = np.random.default_rng(5).uniform(-1.0, 1.0, (count, 3))
    arms = (np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)) / 6.0
    return native.Spline(points, points - arms, points + arms, cyclic)


class Construction(unittest.TestCase):
    def test_bezier_keeps_its_control_points(self):
        curve = native.Bezier(S_CURVE)
        self.assertEqual((curve.degree, curve.segment_count, curve.cyclic), (3, 1, False))
        np.testing.assert_array_equal(curve.control_points, S_CURVE)
        self.assertIsInstance(curve, native.Curve)

    def test_control_points_are_a_copy(self):
        curve = native.Bezier(S_CURVE)
        curve.control_points[:] = 0.0
        np.testing.assert_array_equal(curve.control_points, S_CURVE)

    def test_numbers_of_other_types_are_converted(self):
        expected = native.Bezier(S_CURVE).position(0.25)
        for points in (
            S_CURVE.astype(np.float32),
            S_CURVE.astype(np.int16),
            S_CURVE.tolist(),
            S_CURVE[:, ::-1][:, ::-1],
            np.asfortranarray(S_CURVE),
        ):
            np.testing.assert_array_equal(native.Bezier(points).position(0.25), expected)

    def test_spline(self):
        curve = smooth_spline(8, True)
        self.assertEqual((curve.degree, curve.segment_count, curve.cyclic), (3, 8, True))
        self.assertEqual(curve.control_points.shape, (8, 4, 3))
        self.assertEqual(smooth_spline(8, False).segment_count, 7)

    def test_chain_of_a_curves_control_points_is_that_curve(self):
        curve = smooth_spline()
        chain = native.Chain(curve.control_points, cyclic=True)
        t = np.linspace(0.0, 8.0, 33)
        np.testing.assert_array_equal(chain.position(t), curve.position(t))

    def test_bspline_and_poly_line(self):
        points = np.random.default_rng(1).uniform(size=(6, 3))
        curve = native.BSpline(points, 4, cyclic=False, use_endpoint=True, use_bezier=False)
        self.assertEqual((curve.degree, curve.segment_count), (3, 3))
        np.testing.assert_allclose(curve.position([0.0, 3.0]), points[[0, -1]], atol=1e-15)
        line = native.PolyLine(points, cyclic=True)
        self.assertEqual((line.degree, line.segment_count), (1, 6))
        np.testing.assert_array_equal(line.position(np.arange(6)), points)

    def test_repr_says_what_it_is(self):
        self.assertEqual(repr(smooth_spline()), "<Spline of degree 3, 8 segments, cyclic>")


class Shapes(unittest.TestCase):
    """A number gives (3,) or a float, (m,) gives (m, 3) or (m,)."""

    def test_points(self):
        curve = native.Bezier(S_CURVE)
        for method in (curve.position, curve.derivative, curve.tangent, curve.position_at_length):
            single = method(0.5)
            self.assertEqual((single.shape, single.dtype), ((3,), np.float64))
            self.assertEqual(method(np.zeros(5)).shape, (5, 3))
            self.assertEqual(method([]).shape, (0, 3))
            np.testing.assert_array_equal(method([0.25, 0.5])[1], single)

    def test_numbers(self):
        curve = native.Bezier(S_CURVE)
        for method in (curve.curvature, curve.torsion, curve.length_at, curve.t_at_length):
            self.assertIsInstance(method(0.5), float)
            self.assertIsInstance(method(np.float32(0.5)), float)
            self.assertIsInstance(method(np.array(0.5)), float)
            self.assertIsInstance(method(1), float)
            self.assertEqual(method(np.zeros(5)).shape, (5,))
            self.assertEqual(method([0.25, 0.5])[1], method(0.5))

    def test_nearest(self):
        curve = native.Bezier(S_CURVE)
        t, position, distance = curve.nearest((2.0, 2.0, 1.0))
        self.assertAlmostEqual(t, 0.5, places=12)
        np.testing.assert_allclose(position, (2.0, 2.0, 0.0), atol=1e-12)
        self.assertAlmostEqual(distance, 1.0, places=14)
        t, position, distance = curve.nearest(np.zeros((4, 3)))
        self.assertEqual((t.shape, position.shape, distance.shape), ((4,), (4, 3), (4,)))


class Values(unittest.TestCase):
    def test_length_and_its_inverse(self):
        curve = native.Bezier(S_CURVE)
        self.assertAlmostEqual(curve.length(), S_LENGTH, delta=1e-13)
        s = np.random.default_rng(2).uniform(0.0, S_LENGTH, 10_000)
        np.testing.assert_allclose(curve.length_at(curve.t_at_length(s)), s, rtol=0.0, atol=1e-10 * S_LENGTH)

    def test_extend(self):
        curve = native.Bezier(S_CURVE)
        end = S_CURVE[-1]
        np.testing.assert_array_equal(curve.position(1.5), end)
        np.testing.assert_allclose(curve.position(1.5, extend="extrapolate"), end + 0.5 * curve.derivative(1.0))
        np.testing.assert_array_equal(curve.position(1.25, "loop"), curve.position(0.25))
        np.testing.assert_array_equal(curve.position(1.25, "ping_pong"), curve.position(0.75))
        np.testing.assert_array_equal(curve.position_at_length(99.0), end)
        np.testing.assert_allclose(curve.position_at_length(S_LENGTH + 2.0, "extrapolate"), end + (2.0, 0.0, 0.0))
        self.assertAlmostEqual(curve.t_at_length(1.5 * S_LENGTH, "loop"), 0.5, places=11)
        self.assertAlmostEqual(curve.t_at_length(-0.5 * S_LENGTH, "ping_pong"), 0.5, places=11)

    def test_extended_derivatives_and_lengths(self):
        curve = smooth_spline(5, cyclic=False)
        h = 1e-5
        for extend in ("extrapolate", "loop", "ping_pong"):
            t = np.array([-5.3, -0.4, 0.7, 4.2, 7.9, 8.3])
            d1, d2 = (curve.derivative(t, order, extend=extend) for order in (1, 2))
            numeric = (curve.position(t + h, extend) - curve.position(t - h, extend)) / (2.0 * h)
            np.testing.assert_allclose(d1, numeric, atol=1e-6)
            speeds = np.linalg.norm(d1, axis=1)
            np.testing.assert_allclose(curve.tangent(t, extend), d1 / speeds[:, None], atol=1e-12)
            bends = np.linalg.norm(np.cross(d1, d2), axis=1) / speeds**3
            np.testing.assert_allclose(curve.curvature(t, extend=extend), bends, atol=1e-9)
            np.testing.assert_allclose(curve.torsion(t, extend)[:2] == 0.0, extend == "extrapolate")
            s = curve.length_at(t, extend)
            np.testing.assert_allclose(curve.position_at_length(s, extend), curve.position(t, extend), atol=1e-10)
            self.assertTrue((np.diff(s) > 0.0).all())
        self.assertEqual(curve.length_at(9.0), curve.length())
        np.testing.assert_array_equal(curve.derivative(9.0), curve.derivative(4.0))

    def test_split_elevate_reverse(self):
        curve = native.Bezier(S_CURVE)
        before, after = curve.split(0.3)
        self.assertIsInstance(before, native.Bezier)
        self.assertAlmostEqual(before.length() + after.length(), S_LENGTH, places=12)
        self.assertEqual(curve.elevate(5).degree, 8)
        np.testing.assert_allclose(curve.elevate().position(0.3), curve.position(0.3), atol=1e-15)
        np.testing.assert_allclose(curve.reversed().position(0.3), curve.position(0.7), atol=1e-15)
        for part in smooth_spline().split(2.5):
            self.assertIsInstance(part, native.Chain)

    def test_transformed_takes_rows_as_blender_does(self):
        matrix = np.array([(0.0, -2.0, 0.0, 5.0), (1.0, 0.0, 0.0, 6.0), (0.0, 0.0, 3.0, 7.0), (0.0, 0.0, 0.0, 1.0)])
        curve = native.Bezier(S_CURVE)
        expected = matrix[:3, :3] @ curve.position(0.4) + matrix[:3, 3]
        np.testing.assert_allclose(curve.transformed(matrix).position(0.4), expected, atol=1e-14)

    def test_bounds(self):
        low, high = native.Bezier([(0, 0, 0), (1, 1, 0), (2, 1, 0), (3, 0, 0)]).bounds()
        np.testing.assert_allclose((low, high), ((0, 0, 0), (3, 0.75, 0)), atol=1e-15)

    def test_curve_without_length(self):
        curve = native.Bezier(np.full((4, 3), 1.5))
        self.assertEqual(curve.length(), 0.0)
        self.assertEqual(curve.t_at_length(1.0), 0.0)
        for extend in ("clamp", "extrapolate", "loop", "ping_pong"):
            np.testing.assert_array_equal(curve.position_at_length([-1.0, 0.0, 1.0], extend), np.full((3, 3), 1.5))

    def test_threads_agree(self):
        curve = smooth_spline(40)
        s = np.linspace(0.0, curve.length(), 50_000)
        results = [None] * 4

        def work(index):
            results[index] = curve.position_at_length(s)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results[1:]:
            np.testing.assert_array_equal(result, results[0])


class Errors(unittest.TestCase):
    """Every error is a ValueError or a TypeError that names the argument."""

    def check(self, error, name, call, *args, **kwargs):
        with self.assertRaisesRegex(error, rf"^{name}: "):
            call(*args, **kwargs)

    def test_control_points(self):
        make = native.Bezier
        self.check(ValueError, "control_points", make, np.zeros((1, 3)))
        self.check(ValueError, "control_points", make, np.zeros((66, 3)))
        self.check(ValueError, "control_points", make, np.zeros((4, 2)))
        self.check(ValueError, "control_points", make, np.zeros(3))
        self.check(ValueError, "control_points", make, [[0, 0, 0], [np.nan, 0, 0]])
        self.check(ValueError, "control_points", make, [[0, 0, 0], [np.inf, 0, 0]])
        self.check(ValueError, "control_points", make, [[0, 0, 0], [0, 0]])
        for dtype in (complex, object, str, bool):
            self.check(TypeError, "control_points", make, np.zeros((4, 3), dtype))
        self.check(TypeError, "control_points", make, None)
        self.check(ValueError, "control_points", native.Chain, np.zeros((2, 1, 3)))
        self.check(ValueError, "control_points", native.Chain, np.zeros((0, 4, 3)))
        self.check(ValueError, "control_points", native.Chain, np.zeros((4, 3)))

    def test_spline(self):
        three, four = np.zeros((3, 3)), np.zeros((4, 3))
        self.check(ValueError, "handles_left", native.Spline, three, four, three)
        self.check(ValueError, "handles_right", native.Spline, three, three, four)
        self.check(ValueError, "points", native.Spline, three[:1], three[:1], three[:1])
        self.check(ValueError, "handles_right", native.Spline, three, three, np.full((3, 3), np.nan))
        self.check(TypeError, "handles_left", native.Spline, three, "handles", three)

    def test_bspline(self):
        self.check(ValueError, "order", native.BSpline, np.zeros((8, 3)), 1)
        self.check(ValueError, "order", native.BSpline, np.zeros((8, 3)), 7)
        self.check(ValueError, "points", native.BSpline, np.zeros((1, 3)), 4)
        self.check(ValueError, "points", native.PolyLine, np.zeros((1, 3)))

    def test_arguments_of_methods(self):
        curve = native.Bezier(S_CURVE)
        for method, name in (
            (curve.position, "t"),
            (curve.derivative, "t"),
            (curve.tangent, "t"),
            (curve.curvature, "t"),
            (curve.torsion, "t"),
            (curve.length_at, "t"),
            (curve.t_at_length, "s"),
            (curve.position_at_length, "s"),
        ):
            self.check(ValueError, name, method, float("nan"))
            self.check(ValueError, name, method, [0.0, np.inf])
            self.check(ValueError, name, method, np.zeros((2, 2)))
            self.check(TypeError, name, method, "0.5")
            self.check(TypeError, name, method, 0.5j)
            self.check(TypeError, name, method, None)
        for method in (
            curve.position,
            curve.derivative,
            curve.tangent,
            curve.curvature,
            curve.torsion,
            curve.length_at,
            curve.t_at_length,
            curve.position_at_length,
        ):
            self.check(ValueError, "extend", method, 0.5, extend="mirror")
            for extend in (None, 3, b"clamp", ["clamp"]):
                self.check(TypeError, "extend", method, 0.5, extend=extend)
        self.check(ValueError, "order", curve.derivative, 0.5, 4)
        self.check(ValueError, "order", curve.derivative, 0.5, order=0)
        self.check(ValueError, "t", curve.split, float("nan"))
        self.check(TypeError, "t", curve.split, "half")
        self.check(ValueError, "times", curve.elevate, -1)
        self.check(ValueError, "times", curve.elevate, 62)
        self.check(ValueError, "times", curve.elevate, 2**40)
        self.check(ValueError, "times", curve.elevate, -(2**80))
        for wrong in ("x", None, 1.0, True, np.arange(2)):
            self.check(TypeError, "times", curve.elevate, wrong)
        for wrong in ("a", None, 1.5):
            self.check(TypeError, "order", curve.derivative, 0.5, order=wrong)
            self.check(TypeError, "order", native.BSpline, np.zeros((8, 3)), order=wrong)
        self.check(ValueError, "matrix", curve.transformed, np.eye(3))
        self.check(ValueError, "point", curve.nearest, (1.0, 2.0))
        self.check(ValueError, "point", curve.nearest, np.zeros((2, 2, 3)))

    def test_flags(self):
        points = np.arange(12.0).reshape(4, 3)
        for make in (
            lambda **flags: native.Spline(points, points, points, **flags),
            lambda **flags: native.Chain(points.reshape(2, 2, 3), **flags),
            lambda **flags: native.BSpline(points, **flags),
            lambda **flags: native.PolyLine(points, **flags),
        ):
            self.assertTrue(make(cyclic=np.bool_(True)).cyclic)
            self.assertFalse(make(cyclic=np.bool_(False)).cyclic)
            for wrong in ("yes", None, 1, 0.0):
                self.check(TypeError, "cyclic", make, cyclic=wrong)
        for name in ("use_endpoint", "use_bezier"):
            self.check(TypeError, name, native.BSpline, points, **{name: "yes"})

    def test_a_message_is_one_sentence(self):
        for call in (
            lambda: native.Bezier(S_CURVE).position(0.5, extend=None),
            lambda: native.Bezier(S_CURVE).elevate("x"),
            lambda: native.frames(None, 0.0, "minimal"),
        ):
            with self.assertRaises(TypeError) as caught:
                call()
            self.assertRegex(str(caught.exception), r"^[a-z]+: must be [^\n.]+, not [A-Za-z]+$")

    def test_numpy_integers_are_whole_numbers(self):
        curve = native.Bezier(S_CURVE)
        self.assertEqual(curve.elevate(np.int64(2)).degree, 5)
        np.testing.assert_array_equal(curve.derivative(0.5, np.uint8(2)), curve.derivative(0.5, 2))


class Documentation(unittest.TestCase):
    def test_every_public_name_has_a_docstring(self):
        for cls in (native.Curve, native.Bezier, native.Spline, native.Chain, native.BSpline, native.PolyLine):
            self.assertTrue(cls.__doc__.strip())
            for name, member in vars(cls).items():
                if not name.startswith("_"):
                    self.assertGreater(len(member.__doc__.strip().splitlines()[-1]), 20, f"{cls.__name__}.{name}")
