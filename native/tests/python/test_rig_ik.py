"""IkPlan, RigGoals, bone_to_pose and pack_matrices' scales through the binding."""

import unittest

import numpy as np

import motus_native as native

BONES = 4  # shoulder, upper arm, fore arm, hand
CHAIN = [1, 2]
FLAGS = 8 + 16  # inherits rotation and has local location


def translation(x, y, z):
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def turn_x(angle):
    matrix = np.eye(4)
    matrix[1:3, 1:3] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return matrix


def quaternion_matrix(q):
    w, x, y, z = q
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return matrix


def columns(matrices, dtype=np.float32):
    return np.ascontiguousarray(np.swapaxes(matrices, -1, -2).reshape(len(matrices), 16), dtype)


class Arm:
    """An arm along Y, one unit a bone, bent by half a radian a joint."""

    def __init__(self):
        self.parents = np.array([-1, 0, 1, 2])
        self.rest = np.array([translation(0, i, 0) for i in range(BONES)])
        self.basis = np.array([turn_x(0.5) for _ in range(BONES)])
        self.poses = self.posed(self.basis)
        self.settings = np.zeros((1, len(native.IkPlan.SETTINGS)))
        for name, value in (("position_weight", 1.0), ("bend", 1.0), ("tolerance", 1e-6), ("iterations", 100), ("is_on", 1)):
            self.settings[0, native.IkPlan.SETTINGS.index(name)] = value
        self.target = np.eye(4)
        self.target[:3, 3] = 0.4, 1.5, 1.6
        self.pole = np.full((1, 3), np.nan)

    def posed(self, basis):
        poses = [self.rest[0] @ basis[0]]
        for i in range(1, BONES):
            poses.append(native.bone_to_pose(self.rest[i], self.rest[i - 1], poses[i - 1], basis[i]))
        return np.array(poses)

    def at_rest(self):
        return {"rest": columns(self.rest), "lengths": np.ones(BONES, np.float32), "inheritance": np.full(BONES, FLAGS, np.int32)}

    def bones(self, plan):
        return plan.bones(plan.rest(**self.at_rest()), columns(self.basis))

    def rig(self, plan):
        return {"bones": self.bones(plan), "poses": columns(self.poses), "world": np.eye(4).T.ravel().copy(), "settings": self.settings}

    def arguments(self, plan):
        return {**self.rig(plan), "targets": columns(self.target[None], np.float64), "poles": self.pole}


class RigGoalsTest(unittest.TestCase):
    def setUp(self):
        self.poses = np.array([turn_x(0.3 * i) @ translation(i, 1, 2) for i in range(3)])
        self.things = np.array([translation(5, i, 0) @ turn_x(i) for i in range(2)])
        self.world = translation(0, 0, 7) @ turn_x(1.0)
        self.given = columns(self.poses), columns(self.world[None], float)[0], columns(self.things)
        self.goals = native.RigGoals(4, [(2, 1)], [(0, 1), (3, 0)])

    def test_where_goals_are(self):
        expected = np.array([self.things[1], np.eye(4), self.world @ self.poses[1], self.things[0]])
        found = self.goals.matrices(*self.given)
        np.testing.assert_allclose(found.reshape(4, 4, 4).swapaxes(1, 2), expected, atol=1e-6)
        points = self.goals.points(*self.given)
        np.testing.assert_array_equal(points[[0, 2, 3]], found[[0, 2, 3], 12:15])
        self.assertTrue(np.isnan(points[1]).all())

    def test_what_no_goal_reads(self):
        """Nothing is asked of arrays from which no goal comes."""
        np.testing.assert_array_equal(native.RigGoals(1, [], []).matrices(None, None, None), np.eye(4).reshape(1, 16))

    def test_wrong_arguments_are_named(self):
        for name, arguments in {
            "count": (-1, [], []),
            "own": (1, [(1, 0)], []),
            "others": (1, [], [(0, -1)]),
        }.items():
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"^{name}: "):
                native.RigGoals(*arguments)
        poses, world, things = self.given
        for name, arguments, error in (
            ("poses", (poses[:1], world, things), ValueError),
            ("poses", (poses.astype(float), world, things), TypeError),
            ("world", (poses, np.eye(4), things), ValueError),
            ("things", (poses, world, things[:, :12]), TypeError),
            ("things", (poses, world, things[:1]), ValueError),
        ):
            with self.subTest(name), self.assertRaisesRegex(error, f"^{name}: "):
                self.goals.matrices(*arguments)


class RigIkTest(unittest.TestCase):
    def setUp(self):
        self.arm = Arm()
        self.plan = native.IkPlan(self.arm.parents, [CHAIN], [3], [])
        self.rotations = np.zeros((3, 4))
        self.scales = np.zeros((3, 3))

    def solve(self, **changed):
        outputs = {"rotations": self.rotations, "scales": self.scales}
        return self.plan.solve(**{**self.arm.arguments(self.plan), **outputs, **changed})

    def report(self, **changed):
        return dict(zip(native.IkPlan.REPORT, self.solve(**changed)[0]))

    def test_the_hand_reaches_its_target(self):
        self.assertEqual(self.plan.rows, (1, 2, 3))
        self.assertEqual(self.plan.absolute, (False, False, False))
        report = self.report()
        basis = self.arm.basis.copy()
        for row, bone in enumerate(self.plan.rows):
            basis[bone] = basis[bone] @ quaternion_matrix(self.rotations[row])
        hand = self.arm.posed(basis)[3][:3, 3]
        np.testing.assert_allclose(hand, self.arm.target[:3, 3], atol=1e-6)
        np.testing.assert_allclose([report["tip_x"], report["tip_y"], report["tip_z"]], hand, atol=1e-6)
        self.assertLess(report["residual"], 1e-9)
        self.assertEqual(report["reason"], native.Reason.REACHED)
        np.testing.assert_array_equal(self.scales, 1.0)

    def test_out_of_reach_and_stretched(self):
        self.arm.target[:3, 3] = 0.0, 1.0, 5.0
        report = self.report()
        self.assertEqual(report["reason"], native.Reason.TOO_FAR)
        self.assertAlmostEqual(report["residual"], report["distance"] - report["reach"], places=6)
        self.arm.settings[0, native.IkPlan.SETTINGS.index("stretch")] = 1.0
        self.assertLess(self.report()["residual"], 1e-6)
        self.assertGreater(self.scales[0, 1], 2.0)
        self.plan = native.IkPlan(self.arm.parents, [CHAIN], [3], [[3, 0]])
        self.assertEqual(self.plan.absolute, (False, False, True))
        self.report()
        np.testing.assert_allclose(self.scales[2], 1.0, atol=1e-6)

    def test_arrays_are_made_where_none_is_given(self):
        given = self.solve()
        np.testing.assert_array_equal(self.solve(rotations=None, scales=None), given)

    def test_limits(self):
        self.arm.settings[0, native.IkPlan.SETTINGS.index("use_limits")] = 1.0
        free = np.tile([-np.inf] * 3 + [np.inf] * 3, (2, 1))
        self.assertLess(self.report(limits=free)["residual"], 1e-5)
        tight = np.tile([-0.1] * 3 + [0.1] * 3, (2, 1))
        report = self.report(limits=tight)
        self.assertGreater(report["residual"], 0.1)
        self.assertEqual(report["reason"], native.Reason.LIMIT)

    def test_match(self):
        targets, poles = self.plan.match(**self.arm.rig(self.plan))
        self.assertLess(self.report(targets=targets, poles=poles)["residual"], 1e-9)
        np.testing.assert_allclose(self.rotations, np.tile([1, 0, 0, 0], (3, 1)), atol=1e-7)
        np.testing.assert_allclose(targets[0, 12:15], self.arm.poses[3][:3, 3], atol=1e-6)

    def test_numbers_that_are_not_finite(self):
        self.arm.target[0, 3] = np.nan
        self.assertEqual(self.report()["reason"], -1.0)
        np.testing.assert_array_equal(self.rotations, np.tile([1, 0, 0, 0], (3, 1)))
        np.testing.assert_array_equal(self.scales, 1.0)

    def test_wrong_arguments_are_named(self):
        other = native.IkPlan(self.arm.parents, [CHAIN], [2], [])
        wrong = {
            "bones": (self.arm.bones(other), ValueError),
            "poses": (columns(self.arm.poses)[:3], ValueError),
            "world": (np.eye(4), ValueError),
            "settings": (np.zeros((2, len(native.IkPlan.SETTINGS))), ValueError),
            "targets": ([[0.0] * 16], TypeError),
            "poles": (np.zeros(3), ValueError),
            "limits": (np.zeros((1, 6)), ValueError),
            "rotations": (np.zeros((2, 4)), ValueError),
            "scales": (np.zeros((3, 3), np.float32), TypeError),
        }
        for name, (value, error) in wrong.items():
            with self.subTest(name), self.assertRaisesRegex(error, f"^{name}: "):
                self.solve(**{name: value})
        shared = np.zeros(21)
        with self.assertRaisesRegex(ValueError, "scales"):
            self.solve(rotations=shared[:12].reshape(3, 4), scales=shared[9:18].reshape(3, 3))

    def test_wrong_bones_are_named(self):
        arguments = self.arm.at_rest()
        wrong = {
            "rest": (arguments["rest"].astype(float), TypeError),
            "lengths": (np.ones(3, np.float32), ValueError),
            "inheritance": (np.ones(4, np.int64), TypeError),
        }
        for name, (value, error) in wrong.items():
            with self.subTest(name), self.assertRaisesRegex(error, f"^{name}: "):
                self.plan.rest(**{**arguments, name: value})
        with self.assertRaisesRegex(TypeError, "^basis: "):
            self.plan.bones(self.plan.rest(**arguments), columns(self.arm.basis).T)
        other = native.IkPlan(self.arm.parents, [CHAIN], [2], [])
        with self.assertRaisesRegex(ValueError, "^rest: "):
            self.plan.bones(other.rest(**arguments), columns(self.arm.basis))
        for bones in (None, self.plan.rest(**arguments)):
            with self.assertRaisesRegex(TypeError, "bones: must be an IkBones, not (NoneType|IkRest)"):
                self.solve(bones=bones)
        for made_by_plans in (native.IkRest, native.IkBones):
            with self.assertRaises(TypeError):
                made_by_plans()

    def test_the_world_from_lent_memory(self):
        """As a mathutils.Matrix lends it: column by column, in single precision."""
        world = translation(3, -2, 0.5) @ turn_x(0.3)
        expected = self.solve(world=columns(world[None])[0].astype(float))
        lent = memoryview(np.asfortranarray(world, np.float32))
        np.testing.assert_array_equal(self.solve(world=lent), expected)
        for wrong in (memoryview(np.eye(4)), memoryview(b"world"), None, "world"):
            with self.assertRaisesRegex(TypeError, "^world: "):
                self.solve(world=wrong)

    def test_bones_stay_as_they_were_read(self):
        arguments, basis = self.arm.at_rest(), columns(self.arm.basis)
        rest = self.plan.rest(**arguments)
        bones = self.plan.bones(rest, basis)
        before = self.solve(bones=bones)
        basis.fill(np.nan)
        arguments["rest"].fill(np.nan)
        np.testing.assert_array_equal(self.solve(bones=bones), before)
        self.assertEqual(self.report(bones=self.plan.bones(rest, basis))["reason"], -1.0)
        lost = self.plan.bones(self.plan.rest(**arguments), columns(self.arm.basis))
        self.assertEqual(self.report(bones=lost)["reason"], -1.0)
        del rest  # what is read of it stays
        np.testing.assert_array_equal(self.solve(bones=bones), before)

    def test_wrong_plans_are_named(self):
        parents = self.arm.parents
        for name, arguments in {
            "parents": ([0.5], [], [], []),
            "chains": (parents, [[1, 3]], [3], []),
            "effectors": (parents, [[1, 2]], [0], []),
            "guards": (parents, [[1, 2]], [2], [[1, 0]]),
        }.items():
            with self.subTest(name), self.assertRaisesRegex((TypeError, ValueError), f"^{name}: "):
                native.IkPlan(*arguments)
        with self.assertRaisesRegex(ValueError, "^effectors: "):
            native.IkPlan(parents, [[1, 2]], [], [])
        for guards in ([1, 2], [[1, 2, 3]], [[1.5, 0]], "x"):
            with self.subTest(guards=guards), self.assertRaisesRegex((TypeError, ValueError), "^guards: "):
                native.IkPlan(parents, [[1, 2]], [2], guards)
        self.assertEqual(native.IkPlan([], [], [], []).rows, ())


class BoneSpaceTest(unittest.TestCase):
    def test_there_and_back(self):
        rest, parent_rest = translation(0, 1, 0) @ turn_x(0.3), translation(1, 0, 0) @ turn_x(1.0)
        turn_y = np.roll(turn_x(0.6)[:3, :3], (1, 1), (0, 1))
        parent_pose = turn_x(0.4) @ np.diag([1.0, 2.0, 0.5, 1.0]) @ turn_x(0.8)
        parent_pose[:3, :3] = parent_pose[:3, :3] @ turn_y @ np.diag([1.5, 0.7, 1.0])
        basis = turn_x(0.2) @ np.diag([2.0, 1.0, 1.0, 1.0])
        poses = set()
        for mode in ("FULL", "FIX_SHEAR", "ALIGNED", "AVERAGE", "NONE", "NONE_LEGACY"):
            pose = native.bone_to_pose(rest, parent_rest, parent_pose, basis, mode)
            poses.add(pose.tobytes())
            np.testing.assert_allclose(native.pose_to_bone(rest, parent_rest, parent_pose, pose, mode), basis, atol=1e-12)
        self.assertEqual(len(poses), 6)
        np.testing.assert_allclose(native.bone_to_pose(rest, None, None, basis), rest @ basis, atol=1e-12)

    def test_wrong_arguments_are_named(self):
        one = np.eye(4)
        for name, arguments in {
            "rest": (np.eye(3), None, None, one),
            "parent_pose": (one, one, None, one),
            "basis": (one, None, None, one[:3]),
            "inherit_scale": (one, None, None, one, "SOME"),
            "inherit_rotation": (one, None, None, one, "FULL", 1),
        }.items():
            with self.subTest(name), self.assertRaisesRegex((TypeError, ValueError), f"^{name}: "):
                native.bone_to_pose(*arguments)


class ScaledMatricesTest(unittest.TestCase):
    def test_scales(self):
        rng = np.random.default_rng(2)
        locations, rotations = rng.normal(size=(5, 3)), rng.normal(size=(5, 4))
        scales = rng.normal(size=(5, 3))
        packed = native.pack_matrices(locations, rotations, scales=scales).reshape(5, 4, 4)
        plain = native.pack_matrices(locations, rotations).reshape(5, 4, 4)
        np.testing.assert_allclose(packed[:, :3, :3], plain[:, :3, :3] * scales[:, :, None], atol=1e-6)
        np.testing.assert_array_equal(packed[:, 3], plain[:, 3])
        with self.assertRaisesRegex(ValueError, "^scales: "):
            native.pack_matrices(locations, rotations, scales=scales[:4])
        empty = native.pack_matrices(np.zeros((0, 3)), np.zeros((0, 4)), scales=np.zeros((0, 3)))
        self.assertEqual(empty.shape, (0, 16))
