"""LayerClip, LayerStack, layer_mask and layer_moments as Python sees them."""

import unittest

import numpy as np

import motus_native as native

PLAIN = 8 | 16
KEYS = np.array([[1, 0, 0, 0, 2, 0], [11, 1, 10, 1, 12, 1]], np.float32)
LINEAR = np.array([1, 1], np.int32)
EYE = np.eye(4, dtype=np.float32).ravel()


LINE = native.FCurve(KEYS, LINEAR, False)


def clip(bones=3, curves=((1, 5, 0, 0),), mode=1):
    return native.LayerClip([mode] * bones, np.array(curves, np.int32), [LINE])


def about_z(angle):
    return np.array((np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2)))


def settings(**given):
    names = native.LayerStack.SETTINGS
    values = dict.fromkeys(names, 0.0) | {"start": 1.0, "first": 1.0, "last": 11.0, "speed": 1.0, "after": 1.0, "weight": 1.0}
    return np.array([[(values | given)[name] for name in names]])


class Stack:
    """Three bones, each below the one before."""

    def __init__(self):
        self.stack = native.LayerStack([-1, 0, 1], np.tile(EYE, (3, 1)), np.full(3, PLAIN, np.int32))
        self.arguments = {
            "basis": np.tile(EYE, (3, 1)),
            "clips": [clip()],
            "settings": settings(),
            "masks": np.ones((1, 3)),
            "references": [None],
            "given": [None],
            "rows": [0, 1],
        }

    def solve(self, frame=6.0, **given):
        found = {
            "locations": np.empty((2, 3)),
            "rotations": np.empty((2, 4)),
            "scales": np.empty((2, 3)),
            "laid": np.empty((2, 16), np.float32),
        }
        self.stack.solve(frame, **(self.arguments | found | given))
        return found


class Sources(unittest.TestCase):
    def test_what_a_layer_has_to_say_makes_the_wanted_pose(self):
        told = native.LayerClip([0] * 3, np.array([(1, channel, -1, 0) for channel in range(10)], np.int32), [])
        rest = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0]
        stack, rows = Stack(), [1]
        layers = {
            "clips": [told, clip()],
            "settings": np.concatenate([settings(weight=0.3), settings(weight=0.5)]),
            "masks": np.ones((2, 3)),
            "references": [None, None],
        }
        wanted = np.tile(EYE, (3, 1))
        wanted[1, 12:15] = 0.3, 0.0, -0.6
        given = stack.arguments | layers | {"given": [rest, None]}
        given.pop("rows")
        found, reached = stack.stack.sources(6.0, **given, edited=0, wanted=wanted, rows=rows)
        self.assertEqual(reached, (7,))
        np.testing.assert_allclose(found[0, :3], [1.0, 0.0, -2.0], atol=1e-6)
        seen = stack.solve(6.0, **(layers | {"given": [found[0], None], "rows": [0, 1]}))
        np.testing.assert_allclose(seen["laid"][1], wanted[1], atol=1e-6)
        for name, bad in (("edited", 2), ("wanted", wanted[:2]), ("rows", [3])):
            with self.assertRaisesRegex(ValueError, f"^{name}: "):
                stack.stack.sources(6.0, **(given | {"edited": 0, "wanted": wanted, "rows": rows} | {name: bad}))

    def test_moves(self):
        found = Stack().solve()
        made = {name: np.empty_like(found[name]) for name in ("locations", "rotations", "scales")}
        native.layer_moves(np.tile(EYE, (2, 1)), found["laid"], **made)
        for name, values in made.items():
            np.testing.assert_allclose(values, found[name], atol=1e-6)
        with self.assertRaisesRegex(ValueError, "^laid: "):
            native.layer_moves(np.tile(EYE, (2, 1)), found["laid"][:1], **made)


class Clips(unittest.TestCase):
    def test_what_it_says(self):
        found = clip()
        self.assertEqual((found.bones, found.channels, found.given), ((1,), (2,), 0))
        np.testing.assert_allclose(found.pose(6.0), [[0, 0, 0, *about_z(0.5), 1, 1, 1]], atol=1e-15)

    def test_values_that_are_given(self):
        found = clip(curves=((0, 1, -1, 0), (2, 7, 0, 0)))
        self.assertEqual((found.bones, found.given), ((0, 2), 1))
        pose = found.pose(11.0, [3.0])
        self.assertEqual(pose[0, 1], 3.0)
        self.assertEqual(pose[1, 7], 1.0)
        with self.assertRaisesRegex(ValueError, "^given: "):
            found.pose(11.0)

    def test_refusals(self):
        good = {"rotations": [1], "curves": np.array([[0, 5, 0, 0]], np.int32), "fcurves": [LINE]}
        bad = (
            ("rotations", ValueError, [8]),
            ("curves", ValueError, np.zeros((1, 5), np.int32)),
            ("curves", TypeError, np.zeros((1, 4))),
            ("curves", ValueError, np.array([[1, 5, 0, 0]], np.int32)),
            ("curves", ValueError, np.array([[0, 5, 1, 0]], np.int32)),
            ("fcurves", TypeError, LINE),
            ("fcurves", TypeError, [3]),
        )
        for name, error, value in bad:
            with self.subTest(name), self.assertRaisesRegex(error, f"^{name}: "):
                native.LayerClip(**(good | {name: value}))


class Stacks(unittest.TestCase):
    def test_what_comes_on_top(self):
        found = Stack().solve()
        np.testing.assert_array_equal(found["rotations"][0], (1, 0, 0, 0))
        np.testing.assert_allclose(found["rotations"][1], about_z(0.5), atol=1e-15)
        np.testing.assert_array_equal(found["locations"], np.zeros((2, 3)))
        np.testing.assert_array_equal(found["scales"], np.ones((2, 3)))
        np.testing.assert_array_equal(found["laid"][0], EYE)
        np.testing.assert_allclose(found["laid"][1, :2], (np.cos(0.5), np.sin(0.5)), atol=1e-7)

    def test_a_reference(self):
        found = Stack().solve(settings=settings(mode=1.0), references=[clip().pose(3.0)])
        np.testing.assert_allclose(found["rotations"][1], about_z(0.3), atol=1e-15)

    def test_whole_turns(self):
        keys = np.array([[1, 0, 0, 0, 2, 0], [11, 4 * np.pi, 10, 1, 12, 1]], np.float32)
        around = native.LayerClip([1] * 3, np.array([[1, 5, 0, 0]], np.int32), [native.FCurve(keys, LINEAR, False)])
        self.assertEqual((around.spins, clip().spins), (True, False))
        np.testing.assert_allclose(around.numbers(6.0), [[0, 0, 2 * np.pi, 0]], atol=1e-6)
        laps = np.hstack((around.numbers(1.0), around.numbers(11.0) - around.numbers(1.0)))
        found = Stack().solve(9.0, clips=[around], settings=settings(weight=0.5), laps=[laps])
        np.testing.assert_allclose(found["rotations"][1], about_z(0.5 * 4 * np.pi * 0.8), atol=1e-6)

    def test_a_list_of_clips_that_changes_meanwhile(self):
        clips = [clip(), clip()]

        class Emptying:
            def __array__(self, *_arguments, **_options):
                clips.clear()
                return np.empty(0)

        two = {"settings": np.vstack((settings(), settings())), "masks": np.ones((2, 3)), "references": [None, None]}
        found = Stack().solve(clips=clips, given=[Emptying(), None], **two)
        expected = Stack().solve(clips=[clip(), clip()], given=[None, None], **two)
        np.testing.assert_array_equal(found["laid"], expected["laid"])
        self.assertEqual(clips, [])

    def test_no_layers(self):
        found = Stack().solve(clips=[], settings=np.empty((0, 10)), masks=np.empty((0, 3)), references=[], given=[])
        np.testing.assert_array_equal(found["laid"], [EYE, EYE])

    def test_refusals(self):
        bad = (
            ("frame", ValueError, np.nan),
            ("basis", ValueError, np.tile(EYE, (2, 1))),
            ("basis", TypeError, np.eye(16)),
            ("clips", TypeError, [3]),
            ("clips", ValueError, [clip(4)]),
            ("settings", ValueError, np.ones((1, 9))),
            ("settings", ValueError, settings(speed=np.inf)),
            ("masks", ValueError, np.ones((1, 2))),
            ("masks", ValueError, np.full((1, 3), 1.5)),
            ("references", ValueError, []),
            ("references", ValueError, [np.zeros((2, 10))]),
            ("given", ValueError, [[1.0]]),
            ("given", ValueError, []),
            ("laps", ValueError, []),
            ("laps", TypeError, 1.0),
            ("laps", ValueError, [np.zeros((1, 4))]),
            ("rows", ValueError, [0, 3]),
            ("locations", ValueError, np.empty((3, 3))),
            ("rotations", TypeError, np.empty((2, 4), np.float32)),
            ("scales", TypeError, [1.0]),
            ("laid", ValueError, np.empty((1, 16), np.float32)),
        )
        for name, error, value in bad:
            with self.subTest(name), self.assertRaisesRegex(error, f"^{name}: "):
                frame = value if name == "frame" else 6.0
                Stack().solve(frame, **({} if name == "frame" else {name: value}))
        with self.assertRaisesRegex(ValueError, "^parents: "):
            native.LayerStack([1, 0], np.tile(EYE, (2, 1)), np.full(2, PLAIN, np.int32))


class Rotations(unittest.TestCase):
    def test_of_modes(self):
        found = native.rotations_of(1, [[0, 0, 0.5, 9]])
        np.testing.assert_allclose(found, [about_z(0.5)], atol=1e-15)
        np.testing.assert_allclose(native.rotations_of(7, [[0.5, 0, 0, 2]]), [about_z(0.5)], atol=1e-15)
        np.testing.assert_allclose(native.rotations_of(0, [[2, 0, 0, 0], [0, 0, 0, 0]]), [[1, 0, 0, 0], [0, 1, 0, 0]])

    def test_refusals(self):
        for name, arguments in (("mode", (8, [[0, 0, 0, 0]])), ("numbers", (0, [0, 0, 0, 1])), ("numbers", (0, [[0, 0, 0, np.nan]]))):
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"^{name}: "):
                native.rotations_of(*arguments)


class MasksAndMoments(unittest.TestCase):
    def test_a_soft_border(self):
        np.testing.assert_allclose(native.layer_mask([-1, 0, 1, 2], [0, 1, 1, 1], 1), (0, 0.5, 1, 1))
        for name, arguments in (
            ("chosen", ([-1], [2.0])),
            ("chosen", ([-1], [1.0, 0.0])),
            ("parents", ([0], [1.0])),
            ("feather", ([-1], [1.0], -1)),
        ):
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"^{name}: "):
                native.layer_mask(*arguments)

    def test_moments(self):
        row = settings(speed=2.0, after=2.0, blend_in=4.0)
        np.testing.assert_allclose(native.layer_moments(row, 3.0), [[5.0, 0.5]])
        np.testing.assert_allclose(native.layer_moments(row, 8.0), [[5.0, 1.0]])
        with self.assertRaisesRegex(ValueError, "^settings: "):
            native.layer_moments(row[:, :5].copy(), 1.0)
