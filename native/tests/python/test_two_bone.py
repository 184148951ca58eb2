"""solve_two_bone(), soft_reach() and Reason through the binding."""

import pickle
import unittest

import numpy as np

import motus_native as native


class OneChainTest(unittest.TestCase):
    def test_triangle_of_3_4_5(self):
        at = native.solve_two_bone((0, 0, 0), (5, 0, 0), 3, 4, (2, 9, 0))
        self.assertIsInstance(at, native.TwoBoneSolution)
        np.testing.assert_allclose(at.elbow, (1.8, 2.4, 0.0), atol=1e-15)
        np.testing.assert_array_equal(at.tip, (5, 0, 0))
        np.testing.assert_allclose(at.normal, (0, 0, 1), atol=1e-15)
        self.assertEqual((at.scale, at.residual), (1.0, 0.0))
        self.assertIs(at.reason, native.Reason.REACHED)
        self.assertIsInstance(at.residual, float)
        away = native.solve_two_bone((0, 0, 0), (5, 0, 0), 3, 4, (2, 9, 0), bend=-1)
        np.testing.assert_allclose(away.elbow, (1.8, -2.4, 0.0), atol=1e-15)

    def test_out_of_reach(self):
        far = native.solve_two_bone((0, 0, 0), (0, 0, 10), 1, 2, (0, 9, 0))
        np.testing.assert_array_equal(far.elbow, (0, 0, 1))
        np.testing.assert_array_equal(far.tip, (0, 0, 3))
        self.assertEqual((far.residual, far.reason), (7.0, native.Reason.TOO_FAR))
        near = native.solve_two_bone((0, 0, 0), (0, 0, 0.25), 1, 2, (0, 9, 0))
        np.testing.assert_array_equal(near.elbow, (0, 0, -1))
        np.testing.assert_array_equal(near.tip, (0, 0, 1))
        self.assertEqual((near.residual, near.reason), (0.75, native.Reason.TOO_NEAR))

    def test_softness_and_stretch(self):
        soft = native.solve_two_bone((0, 0, 0), (2, 0, 0), 1, 1, (0, 1, 0), softness=0.5)
        self.assertAlmostEqual(soft.tip[0], native.soft_reach(2.0, 2.0, 0.5), places=15)
        self.assertGreater(soft.elbow[1], 0.1)
        stretched = native.solve_two_bone((0, 0, 0), (4, 0, 0), 1, 1, (0, 1, 0), stretch=0.5)
        np.testing.assert_allclose(stretched.elbow, (1.5, 0, 0))
        np.testing.assert_allclose(stretched.tip, (3, 0, 0))
        self.assertEqual((stretched.scale, stretched.residual), (1.5, 1.0))
        whole = native.solve_two_bone((0, 0, 0), (4, 0, 0), 1, 1, (0, 1, 0), softness=0.5, stretch=1)
        np.testing.assert_array_equal(whole.tip, (4, 0, 0))
        self.assertIs(whole.reason, native.Reason.REACHED)
        long_softness = native.solve_two_bone((0, 0, 0), (1, 0, 0), 1, 1, (0, 1, 0), softness=9.0)
        self.assertEqual(long_softness.tip[0], native.soft_reach(1.0, 2.0, 2.0))

    def test_plane_decides_where_the_pole_cannot(self):
        at = native.solve_two_bone((0, 0, 0), (0, 1.5, 0), 1, 1, (0, 4, 0), plane=(0, 0, 3))
        np.testing.assert_allclose(at.normal, (0, 0, 1), atol=1e-15)
        self.assertLess(at.elbow[0], -0.6)
        without = native.solve_two_bone((0, 0, 0), (0, 1.5, 0), 1, 1, (0.02, 4, 0))
        np.testing.assert_allclose(without.normal, (0, 0, -1), atol=1e-14)

    def test_everything_may_coincide(self):
        at = native.solve_two_bone((1, 2, 3), (1, 2, 3), 0, 0, (1, 2, 3))
        np.testing.assert_array_equal((at.elbow, at.tip), ((1, 2, 3), (1, 2, 3)))
        folded = native.solve_two_bone((0, 0, 0), (0, 0, 0), 1, 1, (0, 0, 5))
        np.testing.assert_allclose(folded.elbow, (0, 0, 1), atol=1e-15)
        self.assertIs(folded.reason, native.Reason.REACHED)


class ManyChainsTest(unittest.TestCase):
    def setUp(self):
        rng = np.random.default_rng(5)
        m = 300
        self.arguments = dict(
            root=rng.normal(size=(m, 3)),
            target=rng.normal(size=(m, 3)),
            length1=rng.uniform(0.2, 2.0, m),
            length2=rng.uniform(0.2, 2.0, m),
            pole=rng.normal(size=(m, 3)) * 4.0,
            bend=rng.choice([-1, 1], m),
            softness=rng.uniform(0.0, 0.3, m),
            stretch=rng.uniform(0.0, 1.0, m),
            plane=rng.normal(size=(m, 3)),
        )

    def assert_rows_alike(self, many, one_by_one):
        for name in ("elbow", "tip", "normal", "scale", "residual", "reason"):
            np.testing.assert_array_equal(getattr(many, name), [getattr(at, name) for at in one_by_one], name)

    def test_rows_are_those_of_single_chains(self):
        many = native.solve_two_bone(**self.arguments)
        self.assertEqual(many.elbow.shape, (300, 3))
        self.assertEqual((many.residual.shape, many.residual.dtype), ((300,), np.float64))
        self.assertEqual((many.reason.shape, many.reason.dtype), ((300,), np.int64))
        singles = [native.solve_two_bone(**{k: v[i] for k, v in self.arguments.items()}) for i in range(300)]
        self.assert_rows_alike(many, singles)

    def test_each_argument_may_be_the_only_array(self):
        one = {name: value[0] for name, value in self.arguments.items()}
        for name, values in self.arguments.items():
            with self.subTest(name):
                many = native.solve_two_bone(**{**one, name: values[:40]})
                self.assert_rows_alike(many, [native.solve_two_bone(**{**one, name: v}) for v in values[:40]])
                shared = native.solve_two_bone(**{**self.arguments, name: one[name]})
                self.assertEqual(shared.tip.shape, (300, 3))

    def test_one_row_is_still_many(self):
        at = native.solve_two_bone([[0, 0, 0]], (1, 0, 0), 1, 1, (0, 1, 0))
        self.assertEqual((at.elbow.shape, at.scale.shape, at.reason.shape), ((1, 3), (1,), (1,)))

    def test_no_row(self):
        at = native.solve_two_bone(np.empty((0, 3)), (1, 0, 0), 1, 1, (0, 1, 0), stretch=np.empty(0))
        self.assertEqual((at.elbow.shape, at.tip.shape, at.normal.shape), ((0, 3), (0, 3), (0, 3)))
        self.assertEqual((at.scale.shape, at.residual.shape, at.reason.shape), ((0,), (0,), (0,)))

    def test_lengths_and_residuals(self):
        many = native.solve_two_bone(**{**self.arguments, "stretch": 0.0, "softness": 0.0})
        root, target = self.arguments["root"], self.arguments["target"]
        longest = self.arguments["length1"] + self.arguments["length2"]
        first = np.linalg.norm(many.elbow - root, axis=1) - self.arguments["length1"]
        second = np.linalg.norm(many.tip - many.elbow, axis=1) - self.arguments["length2"]
        self.assertLess(max(abs(first / longest).max(), abs(second / longest).max()), 1e-14)
        np.testing.assert_allclose(many.residual, np.linalg.norm(many.tip - target, axis=1), atol=1e-14)
        reached = many.reason == native.Reason.REACHED
        self.assertTrue(0 < reached.sum() < 300)
        np.testing.assert_array_equal(many.tip[reached], target[reached])
        self.assertTrue((many.residual[~reached] > 0.0).all())

    def test_views_and_other_numbers(self):
        points = np.arange(24, dtype=np.float32).reshape(4, 6)
        at = native.solve_two_bone(points[:, ::2], points[:, 1::2], np.int32(2), 1.5, [9, 0, 0], np.int8(-1))
        expected = native.solve_two_bone(points[:, ::2].astype(float), points[:, 1::2].astype(float), 2.0, 1.5, [9.0, 0.0, 0.0], -1)
        np.testing.assert_array_equal(at.elbow, expected.elbow)


class ArgumentsTest(unittest.TestCase):
    GOOD = dict(root=(0, 0, 0), target=(1, 0, 0), length1=1.0, length2=1.0, pole=(0, 1, 0))

    def assert_raises(self, error, name, **changes):
        with self.subTest(name, **changes), self.assertRaisesRegex(error, f"^{name}:"):
            native.solve_two_bone(**{**self.GOOD, **changes})

    def test_points(self):
        for name in ("root", "target", "pole", "plane"):
            self.assert_raises(ValueError, name, **{name: (0, float("nan"), 0)})
            self.assert_raises(ValueError, name, **{name: (0, float("inf"), 0)})
            self.assert_raises(ValueError, name, **{name: (0, 1)})
            self.assert_raises(ValueError, name, **{name: 1.0})
            self.assert_raises(ValueError, name, **{name: np.zeros((2, 2, 3))})
            self.assert_raises(TypeError, name, **{name: "xyz"})
        self.assert_raises(TypeError, "root", root=None)

    def test_numbers(self):
        for name in ("length1", "length2", "bend", "softness", "stretch"):
            self.assert_raises(ValueError, name, **{name: float("nan")})
            self.assert_raises(ValueError, name, **{name: [[1.0]]})
            self.assert_raises(ValueError, name, **{name: [1.0, -0.5]})
            self.assert_raises(TypeError, name, **{name: "long"})
        for name in ("length1", "length2", "softness", "stretch"):
            self.assert_raises(ValueError, name, **{name: -1e-9})
        self.assert_raises(ValueError, "stretch", stretch=1.0 + 1e-9)
        for bend in (0, 2, -2, 0.5):
            self.assert_raises(ValueError, "bend", bend=bend)
        self.assert_raises(TypeError, "bend", bend=True)

    def test_rows_that_differ(self):
        self.assert_raises(ValueError, "target", root=np.zeros((3, 3)), target=np.zeros((2, 3)))
        self.assert_raises(ValueError, "plane", length1=np.ones(3), plane=np.zeros((0, 3)))
        with self.assertRaisesRegex(ValueError, "as many rows as length1: 3, not 2"):
            native.solve_two_bone(**{**self.GOOD, "length1": [1, 1, 1], "stretch": [0, 0]})


class SoftReachTest(unittest.TestCase):
    def test_values(self):
        self.assertEqual(native.soft_reach(1.0, 2.0, 0.5), 1.0)
        self.assertEqual(native.soft_reach(3.0, 2.0, 0.5), 2.0)
        self.assertEqual(native.soft_reach(2.5, 2.0, 0), 2.0)
        d = np.linspace(0.0, 4.0, 401)
        r = native.soft_reach(d, 2.0, 0.5)
        wanted = np.where(d < 1.5, d, 2.0 - 0.5 * (1.0 - np.clip((d - 1.5) / 1.5, 0, 1)) ** 3)
        np.testing.assert_allclose(r, wanted, atol=1e-15)

    def test_errors(self):
        for arguments, name in (((-1, 2, 0), "distance"), ((1, -2, 0), "reach"), ((1, 2, -1), "softness")):
            with self.assertRaisesRegex(ValueError, f"^{name}:"):
                native.soft_reach(*arguments)
        with self.assertRaisesRegex(ValueError, "^distance:"):
            native.soft_reach(float("nan"), 2, 0)


class ReasonTest(unittest.TestCase):
    def test_codes(self):
        names = ["REACHED", "TOO_FAR", "TOO_NEAR", "LIMIT", "ITERATIONS"]
        self.assertEqual([reason.name for reason in native.Reason], names)
        self.assertEqual([int(reason) for reason in native.Reason], [0, 1, 2, 3, 4])
        self.assertEqual(native.Reason(2), native.Reason.TOO_NEAR)
        self.assertTrue((np.array([1, 0]) == native.Reason.TOO_FAR).tolist() == [True, False])
        self.assertIs(pickle.loads(pickle.dumps(native.Reason.LIMIT)), native.Reason.LIMIT)
