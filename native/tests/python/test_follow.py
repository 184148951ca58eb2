"""follow() through the binding."""

import unittest

import numpy as np

import motus_native as native


class FollowTest(unittest.TestCase):
    def setUp(self):
        rng = np.random.default_rng(6)
        points = np.cumsum(rng.normal(size=(5, 3)) * 3.0, axis=0)
        handles = rng.normal(size=(5, 3))
        self.curve = native.Spline(points, points - handles, points + handles)
        self.timing = native.Timing.eased(5.0, self.curve.length(), 0.2, 0.2)
        self.offsets = np.linspace(0.0, -3.0, 20)

    def test_places_and_frames(self):
        locations, rotations = native.follow(self.curve, self.timing, 3.0, self.offsets, "banking", strength=0.5)
        s = self.timing.distance(3.0) + self.offsets
        np.testing.assert_allclose(locations, self.curve.position_at_length(s), atol=1e-12)
        expected = native.frames(self.curve, s, "banking", strength=0.5, speed=self.timing.speed(3.0))
        np.testing.assert_allclose(rotations, expected, atol=1e-12)

    def test_one_offset(self):
        locations, rotations = native.follow(self.curve, self.timing, 3.0, 0.0, "minimal")
        self.assertEqual((locations.shape, rotations.shape), ((1, 3), (1, 4)))

    def test_writes_into_given_arrays(self):
        locations, rotations = np.empty((20, 3)), np.empty((20, 4))
        result = native.follow(self.curve, self.timing, 3.0, self.offsets, "world_up", locations=locations, rotations=rotations)
        self.assertIs(result[0], locations)
        self.assertIs(result[1], rotations)
        fresh = native.follow(self.curve, self.timing, 3.0, self.offsets, "world_up")
        np.testing.assert_array_equal(locations, fresh[0])
        np.testing.assert_array_equal(rotations, fresh[1])

    def test_buffers_of_other_owners(self):
        memory = bytearray(8 * 60)
        view = np.frombuffer(memory, np.float64).reshape(20, 3)
        native.follow(self.curve, self.timing, 3.0, self.offsets, "world_up", locations=view)
        self.assertTrue(np.frombuffer(memory, np.float64).any())

    def test_extrapolate(self):
        locations, _ = native.follow(self.curve, native.Timing.constant(0.0), 0.0, -2.0, "minimal", extend="extrapolate")
        expected = self.curve.position(0.0) - 2.0 * self.curve.tangent(0.0)
        np.testing.assert_allclose(locations[0], expected, atol=1e-12)

    def test_axes(self):
        camera = native.follow(self.curve, self.timing, 3.0, 0.0, "world_up", forward="-Z", up="Y")[1][0]
        w, x, y, z = camera
        minus_z = -np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
        t = self.curve.t_at_length(self.timing.distance(3.0))
        np.testing.assert_allclose(minus_z, self.curve.tangent(t), atol=1e-9)

    def test_rotation_switched_off(self):
        locations, rotations = native.follow(self.curve, self.timing, 3.0, self.offsets, "banking", rotate=False)
        np.testing.assert_array_equal(rotations, np.tile([1.0, 0.0, 0.0, 0.0], (20, 1)))
        np.testing.assert_allclose(locations, self.curve.position_at_length(self.timing.distance(3.0) + self.offsets), atol=1e-12)

    def test_bogies_stand_on_the_path_a_wheelbase_apart(self):
        curve = native.Spline(
            *[np.array(rows, float) for rows in ([[0, 0, 0], [9, 3, 1]], [[-3, 0, 0], [7, 8, 1]], [[4, -3, 1], [11, 0, 0]])]
        )
        middle = 0.5 * curve.length()
        (place,), (turn,) = native.follow(curve, native.Timing.constant(0.0), 0.0, middle, "world_up", wheelbases=2.0)
        w, x, y, z = turn
        forward = np.array([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)])
        for side in (1.0, -1.0):
            self.assertLess(curve.nearest(place + side * forward)[2], 1e-9)

    def test_delays(self):
        delays = [0.0, 0.5, 1.25]
        found = native.follow(self.curve, self.timing, 2.0, np.zeros(3), "banking", delays=delays)
        for index, delay in enumerate(delays):
            alone = native.follow(self.curve, self.timing, 2.0 - delay, 0.0, "banking")
            np.testing.assert_array_equal(found[0][index], alone[0][0])
            np.testing.assert_array_equal(found[1][index], alone[1][0])
        rest = native.follow(self.curve, native.Timing.constant(1.0), 1.0, 0.0, "minimal", delays=3.0, start=0.0)
        np.testing.assert_allclose(rest[0][0], self.curve.position(0.0), atol=1e-12)

    def test_side_and_height(self):
        line = native.PolyLine([[0.0, 0.0, 0.0], [0.0, 10.0, 0.0]], False)
        still, tilt = native.Timing.constant(0.0), [np.pi / 2.0, np.pi / 2.0]
        for options, wanted in (
            ({"level": True}, [2.0, 5.0, 1.0]),
            ({}, [1.0, 5.0, -2.0]),
            ({"level": True, "rotate": False}, [2.0, 5.0, 1.0]),
        ):
            found = native.follow(line, still, 0.0, 5.0, "tilt", tilt=tilt, side=2.0, height=1.0, **options)
            np.testing.assert_allclose(found[0][0], wanted, atol=1e-12)

    def test_lag_is_a_function_of_time(self):
        def at(time):
            return native.follow(self.curve, self.timing, time, 0.0, "world_up", lag_rate=0.05)[1][0]

        times = np.linspace(0.0, 6.0, 25)
        forward = [at(t) for t in times]
        backward = [at(t) for t in times[::-1]][::-1]
        np.testing.assert_array_equal(forward, backward)
        rigid = native.follow(self.curve, self.timing, 3.0, 0.0, "world_up")[1][0]
        self.assertLess(abs(np.dot(rigid, at(3.0))), 1.0 - 1e-6)

    def test_errors_name_the_argument(self):
        def call(time=1.0, offsets=0.0, mode="minimal", **options):
            return lambda: native.follow(self.curve, self.timing, time, offsets, mode, **options)

        cases = (
            (ValueError, "time", call(time=float("nan"))),
            (ValueError, "offsets", call(offsets=[float("inf")])),
            (ValueError, "mode", call(mode="best")),
            (ValueError, "forward", call(forward="W")),
            (ValueError, "up: must be across forward", call(forward="Y", up="-Y")),
            (ValueError, "lag_rate", call(lag_rate=-1.0)),
            (ValueError, "lag_by", call(lag_by="mood")),
            (ValueError, "delays", call(delays=[0.0, 1.0])),
            (ValueError, "delays", call(delays=float("nan"))),
            (ValueError, "wheelbases", call(wheelbases=[0.0, 1.0])),
            (ValueError, "wheelbases", call(wheelbases=-1.0)),
            (ValueError, "side", call(side=float("inf"))),
            (ValueError, "height", call(height=float("nan"))),
            (ValueError, "start", call(start=float("inf"))),
            (TypeError, "level", call(level=1.5)),
            (TypeError, "speed", call(mode="banking", speed=1.0)),
            (ValueError, "locations", call(offsets=[0.0, 1.0], locations=np.empty((1, 3)))),
            (TypeError, "locations", call(locations=np.empty((1, 3), np.float32))),
            (TypeError, "rotations", call(rotations=np.empty((4, 1)).T[:, ::-1])),
        )
        for error, name, failing in cases:
            with self.assertRaisesRegex(error, name):
                failing()
        for name in ("mode", "extend", "forward", "up", "lag_by", "rotate", "lag_rate", "time", "offsets", "locations"):
            with self.assertRaisesRegex(TypeError, f"^{name}: "):
                call(**{name: "no" if name in ("rotate", "lag_rate", "time", "offsets", "locations") else 3})()
        with self.assertRaisesRegex(TypeError, "^curve: must be a Curve, not Timing$"):
            native.follow(self.timing, self.timing, 1.0, 0.0, "minimal")
        with self.assertRaisesRegex(TypeError, "^timing: must be a Timing, not NoneType$"):
            native.follow(self.curve, None, 1.0, 0.0, "minimal")
        read_only = np.empty((1, 3))
        read_only.flags.writeable = False
        with self.assertRaisesRegex(TypeError, "locations"):
            call(locations=read_only)()
        unaligned = np.frombuffer(bytearray(25), np.float64, 3, offset=1).reshape(1, 3)
        with self.assertRaisesRegex(TypeError, "locations"):
            call(locations=unaligned)()

    def test_outputs_that_share_memory_are_refused(self):
        memory = np.zeros(14)
        with self.assertRaisesRegex(ValueError, "rotations: must not share memory with locations"):
            native.follow(
                self.curve,
                self.timing,
                1.0,
                [0.0, 1.0],
                "minimal",
                locations=memory[:6].reshape(2, 3),
                rotations=memory[5:13].reshape(2, 4),
            )
        with self.assertRaisesRegex(ValueError, "locations: must not share memory with offsets"):
            native.follow(self.curve, self.timing, 1.0, memory[:2], "minimal", locations=memory[:6].reshape(2, 3))
        beside = native.follow(
            self.curve,
            self.timing,
            1.0,
            [0.0, 1.0],
            "minimal",
            locations=memory[:6].reshape(2, 3),
            rotations=memory[6:].reshape(2, 4),
        )
        fresh = native.follow(self.curve, self.timing, 1.0, [0.0, 1.0], "minimal")
        np.testing.assert_array_equal(beside[0], fresh[0])
        np.testing.assert_array_equal(beside[1], fresh[1])


class FollowPlanTest(unittest.TestCase):
    def setUp(self):
        rng = np.random.default_rng(6)
        points = np.cumsum(rng.normal(size=(5, 3)) * 3.0, axis=0)
        handles = rng.normal(size=(5, 3))
        self.curves = [native.Spline(points, points - handles, points + handles), native.PolyLine(np.diag([1.0, 2.0, 3.0]), False)]

    @staticmethod
    def solved(plan, curves, frame, fps=24.0):
        progress = np.zeros((plan.followers, 5))
        poses = native.PoseBuffer(plan.rows, progress)
        plan.solve(curves, frame, fps, poses)
        return poses.locations, poses.rotations, progress

    def test_poses_are_those_of_follow_at_the_times_that_the_frames_give(self):
        eased = native.Timing.eased(5.0, self.curves[0].length(), 0.2, 0.2)
        cases = (
            (0, eased, [0.0, -0.5, -1.0], "banking", {"strength": 0.5, "lag_rate": 0.2}, {"start_frame": 10.0}),
            (1, native.Timing.constant(0.7), [0.3], "minimal", {"extend": "loop", "forward": "X"}, {}),
            (0, native.Timing.constant(2.0), [0.0, 1.0], "world_up", {"rotate": False, "line_up": True}, {"time": 1.25}),
        )
        plan = native.FollowPlan()
        for place, timing, offsets, mode, options, clock in cases:
            plan.add(place, timing, offsets, mode, **options, **clock)
        self.assertEqual((plan.rows, plan.followers), (6, 3))
        for frame in (60.0, 3.0, 12.5, 60.0):
            times = max(frame - 10.0, 0.0) / 24.0, frame / 24.0, 1.25
            wanted = [
                native.follow(self.curves[place], timing, time, offsets, mode, **options)
                for (place, timing, offsets, mode, options, _), time in zip(cases, times)
            ]
            locations, rotations, _ = self.solved(plan, self.curves, frame)
            np.testing.assert_array_equal(locations, np.concatenate([one for one, _ in wanted]))
            np.testing.assert_array_equal(rotations, np.concatenate([one for _, one in wanted]))

    def test_spaces_move_the_poses(self):
        turn, there = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), np.array([1.0, 2.0, 3.0])
        space = np.eye(4)
        space[:3, :3], space[:3, 3] = turn, there
        plan = native.FollowPlan()
        plan.add(0, native.Timing.constant(1.0), [0.0, 0.5], "banking", wheelbases=[0.0, 0.5], side=0.25)
        plan.add(1, native.Timing.constant(1.0), 0.0, "minimal", rotate=False)
        own, moved = np.zeros((2, 5)), np.zeros((2, 5))
        first, second = native.PoseBuffer(3, own), native.PoseBuffer(3, moved)
        plan.solve(self.curves, 24.0, 24.0, first)
        plan.solve(self.curves, 24.0, 24.0, second, [space, None])
        np.testing.assert_allclose(second.locations[:2], first.locations[:2] @ turn.T + there, atol=1e-12)
        half = np.sqrt(0.5)
        w, x, y, z = first.rotations[:2].T
        wanted = half * np.column_stack((w - z, x - y, y + x, z + w))
        np.testing.assert_allclose(second.rotations[:2], wanted, atol=1e-12)
        np.testing.assert_array_equal(second.locations[2], first.locations[2])
        np.testing.assert_array_equal(moved, own)
        with self.assertRaisesRegex(TypeError, "^spaces: "):
            plan.solve(self.curves, 24.0, 24.0, second, 3.0)
        with self.assertRaisesRegex(ValueError, "^spaces: "):
            plan.solve(self.curves, 24.0, 24.0, second, [np.eye(3)])

    def test_progress(self):
        line = native.PolyLine([[0.0, 0.0, 0.0], [10.0, 0.0, 0.0]], False)
        cases = (  # extend, line_up, distance at 24 frames, fraction of the length, distance told
            ("clamp", False, 4.0, 0.4, 4.0),
            ("clamp", False, 12.0, 1.0, 10.0),
            ("loop", False, 23.0, 0.3, 23.0),
            ("loop", False, -3.0, 0.7, -3.0),
            ("ping_pong", False, 13.0, 0.7, 7.0),
            ("extrapolate", False, 15.0, 1.5, 15.0),
            ("extrapolate", True, 15.0, 1.0, 10.0),
        )
        plan = native.FollowPlan()
        for extend, line_up, distance, _, _ in cases:
            plan.add(0, native.Timing.constant(3.0), 0.0, "minimal", moved=distance - 5.0, offset=2.0, extend=extend, line_up=line_up)
        _, _, progress = self.solved(plan, [line], 24.0)
        for (*_, fraction, told), found in zip(cases, progress):
            np.testing.assert_allclose(found, [min(max(fraction, 0.0), 1.0), fraction, told, 3.0, 10.0], atol=1e-12)

    def test_a_follower_that_is_left_out_stays_as_it_is(self):
        plan = native.FollowPlan()
        plan.skip()
        plan.add(0, native.Timing.constant(1.0), 0.0, "minimal")
        progress = np.full((2, 5), 7.0)
        poses = native.PoseBuffer(2, progress)
        poses.locations[:] = poses.rotations[:] = 7.0
        plan.solve([self.curves[1]], 24.0, 24.0, poses)
        for array in (poses.locations, poses.rotations, progress):
            self.assertTrue((array[0] == 7.0).all())
            self.assertFalse((array[1] == 7.0).any())

    def test_a_distance_that_is_not_finite(self):
        plan = native.FollowPlan()
        plan.add(0, native.Timing.constant(1e300), 0.0, "minimal", start_frame=0.0)
        plan.add(0, native.Timing.constant(1.0), 0.0, "minimal")
        locations, rotations, progress = self.solved(plan, self.curves, 1e300)
        self.assertTrue(np.isnan(locations[0]).all() and np.isnan(rotations[0]).all() and np.isnan(progress[0]).all())
        locations, rotations, progress = self.solved(plan, self.curves, 24.0)
        self.assertTrue(np.isfinite(locations[1]).all() and np.isfinite(rotations[1]).all() and np.isfinite(progress[1]).all())

    def test_errors_name_the_argument(self):
        plan, timing = native.FollowPlan(), native.Timing.constant(1.0)
        plan.add(1, timing, 0.0, "minimal")
        cases = (
            (ValueError, "place", lambda: plan.add(-1, timing, 0.0, "minimal")),
            (TypeError, "timing", lambda: plan.add(0, None, 0.0, "minimal")),
            (ValueError, "mode", lambda: plan.add(0, timing, 0.0, "best")),
            (TypeError, "start_frame", lambda: plan.add(0, timing, 0.0, "minimal", start_frame="now")),
            (ValueError, "curves", lambda: self.solved(plan, self.curves[:1], 1.0)),
            (TypeError, "curve", lambda: self.solved(plan, [None, None], 1.0)),
            (TypeError, "poses", lambda: plan.solve(self.curves, 1.0, 24.0, np.zeros((1, 10)))),
            (ValueError, "poses", lambda: plan.solve(self.curves, 1.0, 24.0, native.PoseBuffer(2, np.zeros((1, 5))))),
            (ValueError, "poses", lambda: plan.solve(self.curves, 1.0, 24.0, native.PoseBuffer(1, np.zeros((2, 5))))),
        )
        for error, name, failing in cases:
            with self.assertRaisesRegex(error, f"^{name}: "):
                failing()
        self.assertEqual((plan.rows, plan.followers), (1, 1))
