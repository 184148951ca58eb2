"""frames() and the conversions of its rotations through the binding."""

import unittest

import numpy as np

import motus_native as native

SAMPLES = 64


def circle(radius, plane="XY"):
    """A spline round a circle, anticlockwise from +X, or in "XZ" from the bottom towards +X."""
    a = 2.0 * np.pi * np.arange(SAMPLES) / SAMPLES
    handle = 4.0 / 3.0 * np.tan(np.pi / SAMPLES / 2.0)
    zero = np.zeros(SAMPLES)
    if plane == "XY":
        points, along = np.stack([np.cos(a), np.sin(a), zero], 1), np.stack([-np.sin(a), np.cos(a), zero], 1)
    else:
        points, along = np.stack([np.sin(a), zero, -np.cos(a)], 1), np.stack([np.cos(a), zero, np.sin(a)], 1)
    return native.Spline(radius * points, radius * (points - handle * along), radius * (points + handle * along), True)


def axes(rotations):
    """The columns x, y, z of the rotation matrices of quaternions (m, 4)."""
    w, x, y, z = np.asarray(rotations).T
    return (
        np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], 1),
        np.stack([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)], 1),
        np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], 1),
    )


class FramesTest(unittest.TestCase):
    def test_every_mode_is_on_the_tangent(self):
        rng = np.random.default_rng(4)
        curve = native.Bezier(rng.normal(size=(6, 3)))
        s = np.linspace(0.0, curve.length(), 40)
        for mode in ("world_up", "minimal", "banking", "curvature"):
            rotations = native.frames(curve, s, mode)
            self.assertEqual(rotations.shape, (40, 4))
            np.testing.assert_allclose(np.linalg.norm(rotations, axis=1), 1.0, atol=1e-12)
            np.testing.assert_allclose(axes(rotations)[1], curve.tangent(curve.t_at_length(s)), atol=1e-9)
        self.assertEqual(native.frames(curve, 1.0, "minimal").shape, (4,))

    def test_bank_of_27_degrees(self):
        up = axes(native.frames(circle(20.0), [5.0, 60.0], "banking", speed=10.0))[2]
        np.testing.assert_allclose(np.degrees(np.arccos(up[:, 2])), np.degrees(np.arctan(100 / (20 * 9.81))), atol=1e-4)
        speeds = np.array([0.0, 10.0])
        up = axes(native.frames(circle(20.0), [5.0, 5.0], "banking", speed=speeds, strength=2.0, gravity=20.0))[2]
        np.testing.assert_allclose(np.arccos(np.minimum(up[:, 2], 1.0)), [0.0, np.arctan(0.5)], atol=1e-5)

    def test_loop_flown_upside_down(self):
        curve = circle(10.0, "XZ")
        for mode, options in (("banking", {"speed": 12.0}), ("curvature", {})):
            up = axes(native.frames(curve, [0.5 * curve.length()], mode, **options))[2]
            np.testing.assert_allclose(up, [[0, 0, -1]], atol=1e-6)
        up = axes(native.frames(curve, [0.5 * curve.length()], "curvature", outward=True))[2]
        np.testing.assert_allclose(up, [[0, 0, 1]], atol=1e-6)

    def test_tilt(self):
        line = native.PolyLine([[0, 0, 0], [0, 4, 0]])
        up = axes(native.frames(line, [0.0, 2.0, 4.0], "tilt", tilt=[0.0, np.pi / 2]))[2]
        root = np.sqrt(0.5)
        np.testing.assert_allclose(up, [[0, 0, 1], [root, 0, root], [1, 0, 0]], atol=1e-9)

    def test_rail(self):
        line = native.PolyLine([[0.0, 0.0, 0.0], [0.0, 10.0, 0.0]], False)
        rail = native.PolyLine([[3.0, 0.0, 4.0], [3.0, 20.0, 4.0]], False)
        across = np.array([0.6, 0.0, 0.8])
        for side, axis, sign in (("above", 2, 1.0), ("right", 0, 1.0), ("left", 0, -1.0)):
            for point in ("share", "nearest"):
                q = native.frames(line, 5.0, "rail", rail=rail, rail_side=side, rail_point=point)
                w, x, y, z = q
                columns = np.array(
                    [
                        [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
                        [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
                        [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
                    ]
                )
                np.testing.assert_allclose(sign * columns[axis], across, atol=1e-12)

    def test_extend(self):
        curve = native.Bezier([[0, 0, 0], [0, 3, 0], [3, 3, 2]])
        length = curve.length()
        for extend, inside in (("clamp", length), ("extrapolate", length), ("loop", 0.5), ("ping_pong", length - 0.5)):
            outside = native.frames(curve, length + 0.5, "minimal", extend=extend)
            np.testing.assert_allclose(outside, native.frames(curve, inside, "minimal"), atol=1e-9)

    def test_point_gives_the_identity(self):
        point = native.Bezier([[1, 2, 3]] * 4)
        for mode in ("world_up", "minimal", "banking", "curvature"):
            np.testing.assert_array_equal(native.frames(point, [-1.0, 0.0, 5.0], mode), [[1, 0, 0, 0]] * 3)

    def test_rows_depend_on_themselves_alone(self):
        curve = native.Bezier(np.random.default_rng(8).normal(size=(7, 3)))
        s = np.linspace(-1.0, curve.length() + 1.0, 50)
        for mode in ("world_up", "minimal", "banking", "curvature"):
            rows = native.frames(curve, s, mode)
            np.testing.assert_array_equal(rows[::-1], native.frames(curve, s[::-1], mode))

    def test_errors_name_the_argument(self):
        curve = native.Bezier([[0, 0, 0], [0, 3, 0], [3, 3, 2]])
        cases = (
            (TypeError, "outward", lambda: native.frames(curve, 0.0, "banking", outward=True)),
            (TypeError, "speed", lambda: native.frames(curve, 0.0, "minimal", speed=1.0)),
            (TypeError, "wings", lambda: native.frames(curve, 0.0, "banking", wings=2)),
            (TypeError, "tilt", lambda: native.frames(curve, 0.0, "tilt")),
            (ValueError, "tilt", lambda: native.frames(curve, 0.0, "tilt", tilt=[1.0])),
            (TypeError, "rail", lambda: native.frames(curve, 0.0, "rail")),
            (TypeError, "rail", lambda: native.frames(curve, 0.0, "rail", rail=None)),
            (TypeError, "rail", lambda: native.frames(curve, 0.0, "minimal", rail=curve)),
            (ValueError, "rail_side", lambda: native.frames(curve, 0.0, "rail", rail=curve, rail_side="behind")),
            (ValueError, "rail_point", lambda: native.frames(curve, 0.0, "rail", rail=curve, rail_point="first")),
            (ValueError, "mode", lambda: native.frames(curve, 0.0, "upwards")),
            (ValueError, "extend", lambda: native.frames(curve, 0.0, "minimal", extend="bounce")),
            (ValueError, "lengths", lambda: native.frames(curve, [0.0, float("nan")], "minimal")),
            (ValueError, "lengths", lambda: native.frames(curve, [[0.0]], "minimal")),
            (ValueError, "speed", lambda: native.frames(curve, [0.0, 1.0], "banking", speed=[1.0, 2.0, 3.0])),
            (ValueError, "gravity", lambda: native.frames(curve, 0.0, "banking", gravity=0.0)),
            (ValueError, "smoothing", lambda: native.frames(curve, 0.0, "curvature", smoothing=-1.0)),
            (TypeError, "outward", lambda: native.frames(curve, 0.0, "curvature", outward="no")),
            (TypeError, "^curve: must be a Curve, not NoneType$", lambda: native.frames(None, 0.0, "minimal")),
            (TypeError, "^curve: ", lambda: native.frames(np.zeros((4, 3)), 0.0, "minimal")),
            (TypeError, "^lengths: ", lambda: native.frames(curve, None, "minimal")),
            (TypeError, "^mode: ", lambda: native.frames(curve, 0.0, None)),
            (TypeError, "^extend: ", lambda: native.frames(curve, 0.0, "minimal", extend=1)),
        )
        for error, name, call in cases:
            with self.assertRaisesRegex(error, name):
                call()


class PoseTest(unittest.TestCase):
    def setUp(self):
        self.rotations = np.random.default_rng(2).normal(size=(100, 4))

    def test_euler_angles_make_the_same_rotation(self):
        x, y, z = native.euler_xyz(self.rotations).T
        unit = self.rotations / np.linalg.norm(self.rotations, axis=1)[:, None]
        columns = axes(unit)
        np.testing.assert_allclose(columns[0], np.stack([np.cos(y) * np.cos(z), np.cos(y) * np.sin(z), -np.sin(y)], 1), atol=1e-12)
        np.testing.assert_allclose(columns[2][:, 2], np.cos(x) * np.cos(y), atol=1e-12)
        np.testing.assert_allclose(columns[1][:, 2], np.sin(x) * np.cos(y), atol=1e-12)

    def test_quaternions_of_any_length(self):
        q = np.array([0.5, 0.5, -0.1, 0.2])
        for size in (1e-300, 1e-200, 1e200, 1e307):
            np.testing.assert_allclose(native.euler_xyz(size * q), native.euler_xyz(q), atol=1e-14)

    def test_euler_out(self):
        out = np.empty((100, 3))
        self.assertIs(native.euler_xyz(self.rotations, out=out), out)
        np.testing.assert_array_equal(out, native.euler_xyz(self.rotations))
        np.testing.assert_allclose(native.euler_xyz([1, 0, 0, 0]), [0, 0, 0])
        with self.assertRaisesRegex(ValueError, "rotations"):
            native.euler_xyz([0, 0, 0, 0])
        with self.assertRaisesRegex(ValueError, "out"):
            native.euler_xyz(self.rotations, out=np.empty((99, 3)))

    def test_matrices(self):
        locations = np.random.default_rng(3).normal(size=(100, 3))
        packed = native.pack_matrices(locations, self.rotations)
        self.assertEqual((packed.shape, packed.dtype), ((100, 16), np.dtype(np.float32)))
        unit = self.rotations / np.linalg.norm(self.rotations, axis=1)[:, None]
        matrices = packed.reshape(100, 4, 4)
        for column, axis in enumerate(axes(unit)):
            np.testing.assert_allclose(matrices[:, column, :3], axis, atol=1e-6)
        np.testing.assert_allclose(matrices[:, 3, :3], locations, atol=1e-6)
        np.testing.assert_array_equal(matrices[:, :, 3], np.tile([0, 0, 0, 1], (100, 1)))
        out = np.empty((100, 16), np.float32)
        self.assertIs(native.pack_matrices(locations, self.rotations, out), out)
        with self.assertRaisesRegex(TypeError, "out"):
            native.pack_matrices(locations, self.rotations, np.empty((100, 16)))
        with self.assertRaisesRegex(ValueError, "rotations"):
            native.pack_matrices(locations, self.rotations[:50])

    def test_turns_of_links(self):
        before, after = np.random.default_rng(4).normal(size=(2, 50, 4, 3))
        turns = native.link_turns(before, after)
        self.assertEqual((turns.shape, turns.dtype), ((50, 4, 4), np.dtype(float)))
        w, v = turns[..., :1], turns[..., 1:]
        turned = before + 2.0 * np.cross(v, np.cross(v, before) + w * before)
        lengths = np.linalg.norm(turned, axis=2, keepdims=True) / np.linalg.norm(after, axis=2, keepdims=True)
        np.testing.assert_allclose(turned, lengths * after, atol=1e-12)
        np.testing.assert_array_equal(native.link_turns(before[:1], after[:1]), turns[:1])
        still = np.tile([1.0, 0.0, 0.0, 0.0], (50, 4, 1))
        np.testing.assert_array_equal(native.link_turns(before, np.full(after.shape, np.nan)), still)
        for shape in ((0, 4), (50, 0)):
            self.assertEqual(native.link_turns(np.zeros((*shape, 3)), np.zeros((*shape, 3))).shape, (*shape, 4))
        cases = (
            (before[0], after, "before"),
            (before, after[:40], "after"),
            (before, after[:, :3].copy(), "after"),
            (before[..., :2].copy(), after, "before"),
        )
        for one, other, name in cases:
            with self.assertRaisesRegex(ValueError, f"^{name}: "):
                native.link_turns(one, other)
        with self.assertRaisesRegex(TypeError, "^after: "):
            native.link_turns(before, after.astype(np.float32))
