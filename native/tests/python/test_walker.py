"""The walker through the binding: names, defaults, shapes and errors. How it walks is tested natively."""

import unittest

import numpy as np

import motus_native as native

REST = np.array([[side * 1.0, ahead, 0.0] for ahead in (0.9, 0.3, -0.3, -0.9) for side in (-1, 1)])
TIMES = np.arange(97) / 24.0
FLOOR = ([[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], [[0, 1, 2], [0, 2, 3]])


def poses_ahead(speed=1.0):
    poses = np.tile(np.eye(4), (len(TIMES), 1, 1))
    poses[:, 1, 3] = speed * np.clip(TIMES - 0.5, 0.0, 2.0)
    return poses


def walker(**settings):
    phases, duty = native.walker_gait("tetrapod", REST)
    given = {
        "times": TIMES,
        "poses": poses_ahead(),
        "rest": REST,
        "ground": native.WalkerGround(*FLOOR),
        "phases": phases,
        "duty": duty,
        **settings,
    }
    return native.Walker(**given)


class WalkerTest(unittest.TestCase):
    def test_gaits(self):
        phases, duty = native.walker_gait("tetrapod", REST)
        np.testing.assert_array_equal(phases, [0, 0.5, 0.5, 0, 0, 0.5, 0.5, 0])
        self.assertEqual(duty, 0.6)
        for gait in ("tripod", "ripple", "wave", "trot", "pace", "walk", "run", "canter", "gallop", "hop"):
            phases, duty = native.walker_gait(gait, REST, forward=(0, 0, 1), up=(1, 0, 0))
            self.assertEqual(phases.shape, (8,))
            self.assertIsInstance(duty, float)
        with self.assertRaisesRegex(ValueError, "gait: must be one of 'tripod'"):
            native.walker_gait("tölt", REST)
        with self.assertRaisesRegex(ValueError, "rest"):
            native.walker_gait("trot", REST[:, :2])
        with self.assertRaisesRegex(ValueError, "forward"):
            native.walker_gait("trot", REST, forward=(0, 0, 0))

    def test_ground(self):
        ground = native.WalkerGround(np.asarray(FLOOR[0], np.float32), np.asarray(FLOOR[1], np.int32))
        self.assertEqual((ground.vertex_count, ground.triangle_count), (4, 2))
        self.assertEqual(native.WalkerGround().triangle_count, 0)
        native.WalkerGround(plane=[[0, 0, 1], [0, 0, 2]])
        for arguments, name in (
            ({"positions": [[0, 0]]}, "positions"),
            ({"positions": FLOOR[0], "triangles": [[0, 1, 4]]}, "triangles"),
            ({"triangles": [[0, 1, 2]]}, "triangles"),
            ({"plane": [0, 0, 1]}, "plane"),
            ({"plane": [[0, 0, 1], [0, 0, 0]]}, "plane"),
            ({"plane": [[0, 0, 1]]}, "plane"),
        ):
            with self.assertRaisesRegex(ValueError, name):
                native.WalkerGround(**arguments)
        self.assertGreater(ground.nbytes, native.WalkerGround().nbytes)

    def test_another_plane_for_the_same_triangles(self):
        ground = native.WalkerGround(*FLOOR)
        raised = ground.with_plane([[0, 0, 0.2], [0, 0, 1]])
        self.assertEqual(raised.triangle_count, ground.triangle_count)
        for on, height in ((ground, 0.0), (raised, 0.2), (raised.with_plane(None), 0.0)):
            np.testing.assert_allclose(walker(ground=on).feet(0.0)[:, 2], height, atol=1e-12)
        with self.assertRaisesRegex(ValueError, "plane"):
            ground.with_plane([[0, 0, 1], [0, 0, 0]])

    def test_shapes(self):
        walks = walker()
        self.assertEqual(walks.leg_count, 8)
        times = np.linspace(-1.0, 6.0, 50)
        for name, shape in (("feet", (8, 3)), ("normals", (8, 3)), ("turns", (8, 4)), ("swing", (8,))):
            rows = getattr(walks, name)(times)
            self.assertEqual(rows.shape, (50, *shape), name)
            self.assertEqual(rows.dtype, np.float64)
            for time, row in zip(times, rows):
                np.testing.assert_array_equal(getattr(walks, name)(time), row)
        offsets, rotations = walks.body(times)
        self.assertEqual((offsets.shape, rotations.shape), ((50, 3), (50, 4)))
        offset, rotation = walks.body(times[7])
        np.testing.assert_array_equal(offset, offsets[7])
        np.testing.assert_array_equal(rotation, rotations[7])
        self.assertEqual(walks.phase(times).shape, (50,))
        self.assertIsInstance(walks.phase(0.5), float)
        self.assertGreater(walks.nbytes, len(TIMES) * 16 * 8)

    def test_feet_follow_the_body_and_come_to_rest(self):
        walks = walker()
        np.testing.assert_allclose(walks.feet(0.0), REST, atol=1e-12)
        np.testing.assert_allclose(walks.feet(walks.settled), REST + [0.0, 2.0, 0.0], atol=1e-5)
        self.assertEqual(walks.problems, [])
        np.testing.assert_allclose(walks.normals(2.0), np.tile([0.0, 0.0, 1.0], (8, 1)))
        offset, rotation = walks.body(2.0)
        np.testing.assert_allclose(offset, 0.0, atol=1e-9)
        np.testing.assert_allclose(rotation, [1, 0, 0, 0], atol=1e-9)

    def test_the_body_in_any_space_of_rows(self):
        """Matrices are rows, as mathutils' are: a body that is turned a quarter about Z."""
        poses = poses_ahead(0.0)
        poses[:, :3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
        feet = walker(poses=poses).feet(0.0)
        np.testing.assert_allclose(feet, np.stack([-REST[:, 1], REST[:, 0], REST[:, 2]], axis=1), atol=1e-12)

    def test_the_body_is_corrected_in_the_world(self):
        walks = walker(ground=native.WalkerGround(plane=[[0, 0, 0.2], [-0.1, 0, 1]]), poses=poses_ahead(0.0))
        offset, (w, x, y, z) = walks.body(3.0)
        np.testing.assert_allclose(offset, [0, 0, 0.2], atol=1e-6)
        up = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
        np.testing.assert_allclose(up, np.array([-0.1, 0, 1]) / np.sqrt(1.01), atol=1e-6)

    def test_soles_turn_with_the_body_and_roll(self):
        """Rotations are w, x, y, z; a body that is turned a quarter about Z."""
        poses = poses_ahead(0.0)
        poses[:, :3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
        np.testing.assert_allclose(walker(poses=poses).turns(0.0), np.tile([0.5**0.5, 0, 0, 0.5**0.5], (8, 1)), atol=1e-12)
        walks = walker(forward=(0, 1, 0), ankle=0.1, heel=0.1, toe=0.2, strike=0.3, push=0.8)
        w, x = walks.turns(0.0)[:, :2].T
        pitches = 2.0 * np.arctan2(x, w)  # four feet stand flat, the others are about to lift, and have rolled over their toes
        np.testing.assert_allclose(np.sort(pitches)[3:], [-0.8 / 3.0, 0, 0, 0, 0], atol=1e-12)
        np.testing.assert_allclose(walks.feet(0.0)[:, 2], 0.1 * np.cos(pitches) - 0.2 * np.sin(pitches), atol=1e-12)
        w, x, y, z = walks.turns(TIMES).reshape(-1, 4).T
        np.testing.assert_allclose(y, 0.0, atol=1e-12)
        np.testing.assert_allclose(z, 0.0, atol=1e-12)
        pitches = 2.0 * np.arctan2(x, w)
        self.assertLess(pitches.min(), -0.5)
        self.assertGreater(pitches.max(), 0.1)

    def test_steps(self):
        steps = walker().steps
        self.assertEqual(list(steps), ["leg", "lift", "touch", "start", "end", "apex", "middle", "turn", "chosen", "planned"])
        count = len(steps["leg"])
        self.assertEqual(steps["leg"].dtype, np.int32)
        self.assertEqual(steps["chosen"].dtype, np.int32)
        self.assertEqual(set(steps["chosen"]), {-1})
        self.assertEqual(steps["turn"].shape, (count, 4))
        np.testing.assert_allclose(np.linalg.norm(steps["turn"], axis=1), 1.0)
        np.testing.assert_array_equal(steps["planned"], steps["middle"])
        for name in ("lift", "touch", "middle", "planned"):
            self.assertEqual(steps[name].shape, (count,))
        for name in ("start", "end", "apex"):
            self.assertEqual(steps[name].shape, (count, 3))
        put = steps["lift"] == steps["touch"]
        self.assertEqual(put.sum(), 8)
        np.testing.assert_array_equal(steps["end"][:-1][~put[1:]], steps["start"][1:][~put[1:]])
        long = np.linalg.norm(steps["end"] - steps["start"], axis=1) > 0.125
        self.assertTrue(long.any())
        np.testing.assert_allclose(steps["apex"][long][:, 2], 0.1)

    def test_chosen_steps(self):
        planned = walker().steps
        row = np.flatnonzero(planned["leg"] == 2)[2]
        time = planned["middle"][row]
        fixed = (3.0, 2.0, 1.0), (0.0, 0.0, 0.0, 2.0)
        steps = walker(chosen=[(np.int32(2), time, (0.1, 0.2, 0.0), 0.5, None, None, None)]).steps
        np.testing.assert_allclose(steps["end"][row], planned["end"][row] + (0.1, 0.2, 0.0), atol=1e-12)
        np.testing.assert_allclose(steps["turn"][row], (np.cos(0.25), 0.0, 0.0, np.sin(0.25)), atol=1e-12)
        np.testing.assert_array_equal(np.flatnonzero(steps["chosen"] == 0), [row])
        np.testing.assert_allclose(steps["start"][row + 1], steps["end"][row])
        steps = walker(chosen=((2, time, (0.1, 0.2, 0.0), 0.0, fixed, None, None),)).steps
        np.testing.assert_array_equal(steps["end"][row], fixed[0])
        np.testing.assert_array_equal(steps["turn"][row], (0.0, 0.0, 0.0, 1.0))
        touch, until = planned["touch"][row] + 0.05, planned["lift"][row + 1] + 0.1
        timed = walker(chosen=[(2, time, (0.0, 0.0, 0.0), 0.0, None, touch, until)])
        self.assertEqual((timed.steps["touch"][row], timed.steps["lift"][row + 1]), (touch, until))
        self.assertEqual(timed.steps["planned"][row], time)
        self.assertEqual(timed.problems, [])
        timed = walker(chosen=[(2, time, (0.0, 0.0, 0.0), 0.0, None, touch, touch - 1.0)])
        self.assertEqual(timed.problems, [(2, touch - 1.0, touch - 1.0, "no_lift")])
        timed = walker(chosen=[(2, time, (0.0, 0.0, 0.0), 0.0, None, -9.0, None)])
        self.assertEqual(timed.problems, [(2, -9.0, -9.0, "no_touch")])
        before, held = planned["middle"][row - 1], planned["lift"][row + 1]
        timed = walker(chosen=[(2, before, (0.0, 0.0, 0.0), 0.0, None, None, held), (2, time, (0.1, 0.0, 0.0), 0.0, None, None, None)])
        self.assertEqual(timed.problems, [(2, time, time, "left_out")])
        for wrong in (
            7,
            [7],
            [(2, time)],
            [(2.5, time, (0, 0, 0), 0.0, None, None, None)],
            [(8, time, (0, 0, 0), 0.0, None, None, None)],
            [(-1, time, (0, 0, 0), 0.0, None, None, None)],
            [(2, "now", (0, 0, 0), 0.0, None, None, None)],
            [(2, time, (0, 0), 0.0, None, None, None)],
            [(2, time, (0, 0, 0), np.nan, None, None, None)],
            [(2, time, (0, 0, 0), 0.0, 1, None, None)],
            [(2, time, (0, 0, 0), 0.0, ((0, 0, 0), (0, 0, 0)), None, None)],
            [(2, time, (0, 0, 0), 0.0, ((0, 0, 0), (0, 0, 0, 0)), None, None)],
            [(2, time, (0, 0, 0), 0.0, None, np.nan, None)],
            [(2, time, (0, 0, 0), 0.0, None, None, "late")],
        ):
            with self.assertRaisesRegex((ValueError, TypeError), "^chosen: "):
                walker(chosen=wrong)

    def test_gaits_over_time(self):
        walk, trot = (native.walker_gait(name, REST) for name in ("ripple", "trot"))
        given = {"poses": poses_ahead(0.0), "phases": walk[0], "duty": walk[1]}
        count = len(TIMES)
        changed = walker(
            **given, changes=[(np.int64(24), *trot)], transition=2.0, strides=np.full(count, 0.3), cadences=np.full(count, 2.0)
        )
        np.testing.assert_allclose(changed.phase(3.0), 6.0)
        plain = walker(**given, cadence=2.0)
        np.testing.assert_array_equal(changed.swing(0.9), plain.swing(0.9))
        self.assertEqual(walker(**given, duties=np.full(count, 0.25)).leg_count, 8)
        for name, wrong in (
            ("changes", (7, [7], [(1,)], [(-1, *trot)], [(97, *trot)], [(0.5, *trot)], [(3, trot[0][1:], 0.5)], [(3, trot[0], 2.0)])),
            ("transition", (0.0, np.nan)),
            ("strides", (0.3, np.full(count, 0.0), np.ones(3))),
            ("cadences", (np.full(count, -1.0),)),
            ("duties", (np.full(count, np.nan),)),
            ("hip_height", (-1.0, np.inf)),
        ):
            for value in wrong:
                with self.assertRaisesRegex((ValueError, TypeError), f"^{name}: "):
                    walker(**{name: value})

    def test_natural_strides(self):
        speeds = np.array([0.5, 1.4, 3.0])
        wanted = 2.3 * 0.9 * (speeds**2 / (9.81 * 0.9)) ** 0.3
        np.testing.assert_allclose(native.walker_natural_stride(speeds, 0.9), wanted)
        self.assertAlmostEqual(native.walker_natural_stride(1.4, hip_height=0.9), wanted[1])
        steady = poses_ahead(0.0)
        steady[:, 1, 3] = 1.4 * TIMES
        np.testing.assert_allclose(walker(poses=steady, hip_height=0.9, cadence=0.1).phase(2.0), 2.0 * 1.4 / wanted[1])
        for arguments, name in (((-1.0, 0.9), "speed"), ((1.0, -0.9), "hip_height"), (("now", 0.9), "speeds")):
            with self.assertRaisesRegex((ValueError, TypeError), f"^{name}"):
                native.walker_natural_stride(*arguments)

    def test_problems(self):
        for settings, reason in (
            ({"ground": native.WalkerGround(plane=[[0, 0, -9], [0, 0, 1]])}, "no_ground"),
            ({"hips": 0.2 * REST + [0, 0, 0.4], "lengths": np.full(8, 0.2)}, "out_of_reach"),
            ({"hips": 0.2 * REST, "lengths": np.zeros(8)}, "no_length"),
        ):
            problems = walker(**settings).problems
            self.assertEqual({leg for leg, *_ in problems}, set(range(8)), reason)
            for _leg, first, last, found in problems:
                self.assertEqual(found, reason)
                self.assertLessEqual(first, last)

    def test_jumps(self):
        poses = poses_ahead(0.0)
        poses[40:, 0, 3] = 1.0
        before, after = TIMES[39] + 0.04, TIMES[40]
        for settings in ({"resets": [40]}, {"jump": 0.5}):
            walks = walker(poses=poses, **settings)
            np.testing.assert_allclose(walks.feet(before), REST, atol=1e-12)
            np.testing.assert_allclose(walks.feet(after), REST + [1.0, 0.0, 0.0], atol=1e-12)
        self.assertFalse(np.allclose(walker(poses=poses).feet(after), REST + [1.0, 0.0, 0.0]))

    def test_errors_name_the_argument(self):
        wrong = {
            "times": (np.zeros(97), TIMES[:5], [TIMES], "now"),
            "poses": (np.eye(4), poses_ahead() * np.nan, poses_ahead()[:, :3]),
            "rest": (REST[:0], REST[0], np.full((8, 3), np.inf)),
            "phases": ([0.0], None, [[0.0] * 8]),
            "duty": (0.0, 1.0, "half", None),
            "stride": (0.0, -1.0, np.nan),
            "cadence": (0.0, np.inf),
            "clearance": (-0.1,),
            "reach_up": (-1.0,),
            "reach_down": (np.nan,),
            "minimum_step": (-1.0,),
            "up": ((0, 0, 0), (0, 1)),
            "resets": ([-1], [3, 3], 7, [0.5], [97]),
            "jump": (0.0, np.nan),
            "frequency": (0.0,),
            "damping": (-1.0,),
            "response": (np.inf,),
            "height": (1.5,),
            "forward": ((0, 1), (np.nan, 0, 0)),
            "ankle": (-0.1,),
            "heel": (-0.1,),
            "toe": (np.inf,),
            "strike": (2.0,),
            "push": (-0.1,),
            "tilt": (-0.5,),
            "hips": (REST[:3], REST[0]),
            "ground": (FLOOR, 1),
        }
        for name, values in wrong.items():
            for value in values:
                with self.subTest(name=name, value=type(value)), self.assertRaisesRegex((ValueError, TypeError), name):
                    walker(**{name: value})
        with self.assertRaisesRegex(ValueError, "lengths"):
            walker(hips=REST)
        with self.assertRaisesRegex(ValueError, "hips|lengths"):
            walker(lengths=np.ones(8))
        with self.assertRaisesRegex(ValueError, "1,000,000 steps"):
            walker(poses=poses_ahead(1e6), jump=1e9, stride=0.01)
        for call in (walker().feet, walker().body, walker().phase):
            with self.assertRaisesRegex(ValueError, "times"):
                call(np.nan)
