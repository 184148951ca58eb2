"""look_at and LookAtPlan as Python sees them."""

import math
import unittest

import numpy as np

import motus_native as native

PLAIN = 8 | 16
DEGREE = math.pi / 180.0
AHEAD = (0.0, -1.0, 0.0)


def turned(quaternion, vector):
    w, axis = quaternion[0], np.asarray(quaternion[1:])
    across = np.cross(axis, vector)
    return np.asarray(vector) + 2.0 * (w * across + np.cross(axis, across))


def about_z(angle):
    return np.array((math.cos(angle / 2.0), 0.0, 0.0, math.sin(angle / 2.0)))


def shares(*args, **options):
    turns = native.look_at(*args, **options)
    return turns.body, turns.head, turns.eyes


class LookAt(unittest.TestCase):
    def test_the_original_s_weights(self):
        body, head, eyes = shares(AHEAD, (-math.sin(30 * DEGREE), -math.cos(30 * DEGREE), 0.0))
        np.testing.assert_allclose(body, about_z(-9 * DEGREE), atol=1e-15)
        np.testing.assert_allclose(head, about_z(-21 * DEGREE), atol=1e-15)
        np.testing.assert_array_equal(eyes, (1.0, 0.0, 0.0, 0.0))

    def test_many_targets(self):
        targets = np.random.default_rng(1).normal(size=(50, 3))
        parts = shares(AHEAD, targets, clamp=0.0)
        for i, target in enumerate(targets):
            for part, alone in zip(parts, shares(AHEAD, target, clamp=0.0)):
                self.assertEqual(part.shape, (50, 4))
                np.testing.assert_array_equal(part[i], alone)
            body, head, eyes = (part[i] for part in parts)
            gaze = turned(eyes, turned(head, turned(body, AHEAD)))
            np.testing.assert_allclose(gaze, target / np.linalg.norm(target), atol=1e-13)
        self.assertEqual(native.look_at(AHEAD, np.empty((0, 3))).body.shape, (0, 4))

    def test_the_chest_tells_which_way_round(self):
        left, behind_right = (math.sin(1.0), -math.cos(1.0), 0.0), (-math.sin(3.0), -math.cos(3.0), 0.0)
        options = {"clamp": 0.0, "body_weight": 0.0, "head_weight": 0.5}
        by_the_front = native.look_at(left, behind_right, AHEAD, **options).head
        by_the_back = native.look_at(left, behind_right, **options).head
        np.testing.assert_allclose(by_the_front, about_z(-2.0), atol=1e-14)
        np.testing.assert_allclose(by_the_back, about_z((2.0 * math.pi - 4.0) / 2.0), atol=1e-14)

    def test_what_is_left_and_why(self):
        aside = (-math.sin(60 * DEGREE), -math.cos(60 * DEGREE), 0.0)
        free = native.look_at(AHEAD, aside)
        self.assertLess(free.residual, 1e-15)
        self.assertIs(free.reason, native.Reason.REACHED)
        held = native.look_at(AHEAD, aside, head_limit=20 * DEGREE)
        self.assertGreaterEqual(held.residual, 22 * DEGREE)
        self.assertIs(held.reason, native.Reason.LIMIT)
        by_side = native.look_at(AHEAD, aside, head_sides=(20 * DEGREE, 30 * DEGREE, 1.0, 1.0), body_weight=0.0)
        self.assertAlmostEqual(by_side.residual, 30 * DEGREE, delta=1e-9)  # to the right
        self.assertIs(by_side.reason, native.Reason.LIMIT)
        half = native.look_at(AHEAD, aside, weight=0.5)  # as it is wanted
        self.assertAlmostEqual(half.residual, 30 * DEGREE, delta=1e-14)
        self.assertIs(half.reason, native.Reason.REACHED)
        many = native.look_at(AHEAD, [AHEAD, aside], head_limit=20 * DEGREE)
        self.assertEqual(many.residual[1], held.residual)
        self.assertEqual(many.reason.tolist(), [native.Reason.REACHED, native.Reason.LIMIT])

    def test_errors_name_the_argument(self):
        for name, value, error in (
            ("forward", (0, 0, 0), ValueError),
            ("forward", "x", TypeError),
            ("targets", (1, 2), ValueError),
            ("targets", [(0, 0, 0)], ValueError),
            ("targets", [(0, math.nan, 0)], ValueError),
            ("up", AHEAD, ValueError),
            ("chest", (0, 0, 1), ValueError),
            ("weight", 1.5, ValueError),
            ("clamp", -0.1, ValueError),
            ("head_limit", -1.0, ValueError),
            ("eyes_weight", math.inf, ValueError),
            ("head_sides", (1.0, 1.0), ValueError),
            ("eyes_sides", (1.0, 1.0, -1.0, 1.0), ValueError),
            ("body_limit", [1.0], TypeError),
        ):
            arguments = {"forward": AHEAD, "targets": (1, 0, 0), name: value}
            with self.subTest(name=name, value=value), self.assertRaises(error) as caught:
                native.look_at(**arguments)
            self.assertIn("up" if name == "chest" else name, str(caught.exception))


class Figure:
    """A root, two spine bones, a head and an eye; all look along -Y with their Z axes, up along Z with their Y axes."""

    parents = np.array([-1, 0, 1, 2, 3], np.int32)
    axes = np.array([(1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0)], float)  # columns

    def __init__(self, entries=1):
        self.rest = np.zeros((5, 16), np.float32)
        for bone, place in enumerate([(0, 0, 0), (0, 0, 1), (0, 0, 1.25), (0, 0, 1.5), (0, -0.125, 1.625)]):
            self.rest[bone] = [*self.axes.ravel(), *place, 1.0]
        self.basis = np.tile(np.eye(4, dtype=np.float32).ravel(), (5, 1))
        self.inheritance = np.full(5, PLAIN, np.int32)
        self.world = np.eye(4).ravel()
        row = dict.fromkeys(native.LookAtPlan.SETTINGS, 1.0)
        row.update(body_weight=0.3, eyes_weight=0.0, clamp=0.0)
        row.update({name: math.pi for name in row if name.endswith("_limit")})
        self.settings = np.tile(list(row.values()), (entries, 1))
        self.targets = np.tile((-0.5, -1.0, 2.0), (entries, 1))
        self.forward = np.tile((0.0, 0.0, 1.0), (entries, 1))

    def arguments(self, **changes):
        arguments = {
            "rest": self.rest,
            "poses": self.rest.copy(),
            "basis": self.basis,
            "inheritance": self.inheritance,
            "world": self.world,
            "settings": self.settings,
            "targets": self.targets,
            "head_forward": self.forward,
            "eyes_forward": self.forward,
        }
        arguments.update(changes)
        return arguments

    def set(self, **settings):
        for name, value in settings.items():
            self.settings[:, native.LookAtPlan.SETTINGS.index(name)] = value


class Plan(unittest.TestCase):
    def setUp(self):
        self.figure = Figure()
        self.plan = native.LookAtPlan(Figure.parents, [[1, 2]], [3], [[4]])
        self.rotations = np.full((4, 4), np.nan)

    def solve(self, **changes):
        report = self.plan.solve(**self.figure.arguments(rotations=self.rotations, **changes))
        return dict(zip(native.LookAtPlan.REPORT, report[0]))

    def test_rows_and_columns(self):
        self.assertEqual(self.plan.rows, (1, 2, 3, 4))
        self.assertEqual(native.LookAtPlan.SETTINGS[0], "weight")
        self.assertEqual(native.LookAtPlan.REPORT, ("angle", "reason", "yaw", "pitch"))
        self.assertEqual(native.LookAtPlan([-1, 0], [[]], [1], [[]]).rows, (1,))
        self.assertEqual(native.LookAtPlan([-1], [], [], []).rows, ())

    def gaze(self):
        """Where the head is and looks with the rotations written, by hand: all bones are carried rigidly."""
        axes = self.figure.axes[:, :3].T
        place, turn = np.array((0.0, 0.0, 1.0)), axes
        for row, step in zip(self.rotations[:3], (0.25, 0.25, 0.0)):
            turn = turn @ np.array([turned(row, axis) for axis in np.eye(3)]).T
            place = place + turn @ (0.0, step, 0.0)
        return place, turn @ (0.0, 0.0, 1.0)

    def test_the_head_meets_its_target(self):
        report = self.solve()
        place, gaze = self.gaze()
        wanted = self.figure.targets[0] - place
        np.testing.assert_allclose(gaze, wanted / np.linalg.norm(wanted), atol=1e-12)
        np.testing.assert_array_equal(self.rotations[3], (1.0, 0.0, 0.0, 0.0))
        self.assertLess(report["angle"], 1e-12)
        self.assertEqual(report["reason"], 0.0)
        self.assertLess(report["yaw"], 0.0)
        self.assertGreater(report["pitch"], 0.0)

    def test_limits_are_reported(self):
        self.figure.set(head_limit=0.1, body_limit=0.1)
        report = self.solve()
        self.assertGreater(report["angle"], 0.1)
        self.assertEqual(report["reason"], 3.0)

    def test_several_targets(self):
        self.figure.set(body_weight=0.0, clamp=0.0)
        aside = np.array([(-5.0, 0.0, 1.5), (5.0, 0.0, 1.5)])
        self.solve(targets=aside, target_counts=[2])
        np.testing.assert_allclose(self.gaze()[1], AHEAD, atol=1e-12)
        self.solve(targets=aside, target_counts=[2], target_weights=np.array((0.0, 1.0)))
        np.testing.assert_allclose(self.gaze()[1], (1.0, 0.0, 0.0), atol=1e-12)
        for name, value in (("targets", aside), ("target_counts", [0]), ("target_counts", [1, 1]), ("target_weights", np.ones(3))):
            with self.subTest(name), self.assertRaisesRegex(ValueError, name):
                self.solve(**{name: value})

    def test_weight_0_and_off_are_the_identity(self):
        for name in ("weight", "is_on"):
            self.figure.set(weight=1.0, is_on=1.0)
            self.figure.set(**{name: 0.0})
            self.rotations[:] = np.nan
            self.solve()
            np.testing.assert_array_equal(self.rotations, np.tile((1.0, 0.0, 0.0, 0.0), (4, 1)))

    def test_what_is_not_finite_is_neutral(self):
        for name in ("targets", "settings", "head_forward", "basis", "world"):
            values = self.figure.arguments()[name].copy()
            values.flat[-1] = np.nan
            if name == "basis":
                values[2, 5] = np.nan
            if name == "settings":
                values[0, 0] = np.nan
            report = self.solve(**{name: values})
            self.assertEqual(report["reason"], -1.0, name)
            np.testing.assert_array_equal(self.rotations, np.tile((1.0, 0.0, 0.0, 0.0), (4, 1)))

    def test_many_entries_and_no_rotations(self):
        figure = Figure(2)
        plan = native.LookAtPlan(Figure.parents, [[1, 2], []], [3, 3], [[], [4]])
        rotations = np.empty((5, 4))
        eyes_forward = figure.forward[:1]  # a row an eye, not an entry
        report = plan.solve(**figure.arguments(rotations=rotations, eyes_forward=eyes_forward))
        self.assertEqual(report.shape, (2, 4))
        self.assertLess(report[:, 0].max(), 1e-12)
        np.testing.assert_array_equal(plan.solve(**figure.arguments(eyes_forward=eyes_forward)), report)

    def test_errors_name_the_argument(self):
        wrong = {
            "rest": self.figure.rest[:4],
            "poses": self.figure.rest.astype(float),
            "basis": self.figure.basis.tolist(),
            "inheritance": self.figure.inheritance.astype(np.int64),
            "world": np.eye(4),
            "settings": np.zeros((1, 8)),
            "targets": np.zeros(3),
            "head_forward": np.zeros((1, 4)),
            "eyes_forward": np.zeros((2, 3)),
            "rotations": np.zeros((3, 4)),
            "up": np.zeros(3),
        }
        for name, value in wrong.items():
            with self.subTest(name=name), self.assertRaises((TypeError, ValueError)) as caught:
                self.plan.solve(**self.figure.arguments(**{name: value}))
            self.assertTrue(str(caught.exception).startswith(name), caught.exception)
        read_only = np.zeros((4, 4))
        read_only.flags.writeable = False
        with self.assertRaises(TypeError):
            self.plan.solve(**self.figure.arguments(rotations=read_only))
        shared = np.zeros((4, 4))
        with self.assertRaises(ValueError):
            self.plan.solve(**self.figure.arguments(rotations=shared, targets=shared.ravel()[:3].reshape(1, 3)))

    def test_wrong_bones(self):
        for name, arguments in (
            ("bodies", ([-1, 0], [[1]], [0], [[]])),
            ("heads", ([-1, 0], [[]], [5], [[]])),
            ("eyes", ([-1, 0], [[]], [1], [[0]])),
            ("bodies", ([-1, 0], [], [1], [[]])),
            ("eyes", ([-1, 0], [[]], [1], [])),
            ("parents", ([4], [[]], [0], [[]])),
            ("bodies", ([-1, 0], 3, [1], [[]])),
            ("heads", ([-1, 0], [[]], [0.5], [[]])),
        ):
            with self.subTest(name=name, arguments=arguments), self.assertRaises((TypeError, ValueError)) as caught:
                native.LookAtPlan(*arguments)
            self.assertTrue(str(caught.exception).startswith(name), caught.exception)
