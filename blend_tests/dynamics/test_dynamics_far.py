"""Motions without an end: a frame far away takes no longer than one nearby, and is as exact."""

from unittest import mock

import bpy
import numpy as np

import support
from dynamics.dynamics_cases import add, go_to, link, matrix, moved, place, problem, rope

PERIOD = 40
FAR = 1_000_000
MOST = 50_000
"""Samples for a frame. Of two and a half hours there would be 8 million."""


def repeated(name="Ball"):
    """An empty whose keys are repeated for ever."""
    ball = moved(name, {1: (0.0, 0.0, 0.0), 11: (3.0, 1.0, 0.0), 1 + PERIOD: (0.0, 0.0, 0.0)})
    for curve in support.addon("core.blender.actions").fcurves(ball):
        curve.modifiers.new('CYCLES')
        curve.update()
    return ball


class FarTest(support.SceneTestCase):
    def samples(self, frame, *objects):
        """(places of objects on a frame, how many samples of inputs they were made of)."""
        motion = support.addon("dynamics.motion")
        counted = []

        def times_of(*arguments):
            found = inputs_times(*arguments)
            counted.append(len(found))
            return found

        inputs_times = motion.inputs.times_of
        with mock.patch.object(motion.inputs, "times_of", times_of):
            found = [place(obj, frame) for obj in objects]
        return np.array(found), sum(counted)

    def test_a_repeated_motion_repeats(self):
        """By its definition: once its start is forgotten the output of what has a period has that period."""
        ball = repeated()
        add(ball, frequency=1.5, damping=0.3)
        near = 15 + 20 * PERIOD
        expected, _ = self.samples(near, ball)
        self.assertGreater(np.abs(expected - place(repeated("Free"), near)).max(), 0.05)
        for laps in (200, 5000, FAR // PERIOD - 21):
            found, count = self.samples(near + laps * PERIOD, ball)
            # A key far away lies on a number of single precision.
            np.testing.assert_allclose(found, expected, atol=2e-3)
            self.assertLess(count, MOST)
        self.assertIsNone(problem(ball))
        np.testing.assert_allclose(place(ball, near), expected[0], atol=1e-6)

    def test_where_one_window_goes_over_into_the_next(self):
        ball = repeated()
        add(ball, frequency=1.0, damping=0.2)
        window = round(40 * bpy.context.scene.render.fps)
        edge = 1 + 7 * window
        steps = np.array([place(ball, edge + offset) for offset in (-0.02, -0.01, 0.0, 0.01, 0.02)])
        ways = np.diff(steps, axis=0)
        np.testing.assert_allclose(ways, ways[:1].repeat(4, axis=0), atol=2e-4)

    def test_in_any_order(self):
        ball = repeated()
        child = link("Child", parent=ball)
        child.location.z = 1.0
        add(ball)
        add(child, follow='WORLD')
        frames = (30, 12_345, 40_000.5, FAR)
        found = {frame: matrix(child, frame) for frame in frames}
        for frame in reversed(frames):
            bpy.data.objects["Ball"].update_tag()
            np.testing.assert_array_equal(matrix(child, frame), found[frame])

    def test_a_child_of_what_swings_is_bounded(self):
        ball = moved()
        children = [link(f"Child {index}", parent=ball) for index in range(3)]
        add(ball)
        for child in children:
            add(child, follow='WORLD')
        _, count = self.samples(FAR, ball, *children)
        self.assertLess(count, 4 * MOST)

    def test_what_is_never_forgotten_is_said(self):
        ball = repeated()
        (entry,) = add(ball, damping=0.0)
        self.assertIsNone(problem(ball))
        _, count = self.samples(FAR, ball)
        self.assertIn("raise Damping", problem(ball).sentence)
        self.assertLess(count, 200_000)
        self.assertTrue(np.isfinite(matrix(ball, FAR)).all())
        entry.damping = 0.5
        go_to(FAR)
        self.assertIsNone(problem(ball))

    def test_many_that_never_forget_share_the_bound(self):
        balls = [repeated(f"Ball {index}") for index in range(2)]
        holder = link("Holder")
        for ball in balls:
            ball.parent = holder
            add(ball, damping=0.0, channels={'LOCATION', 'ROTATION', 'SCALE'})
        _, count = self.samples(FAR, *balls)
        self.assertLess(count, 400_000)

    def test_many_objects_share_the_bound(self):
        """So that a frame of all of them takes no longer than one of a single one at its hardest."""
        balls = [repeated(f"Ball {index}") for index in range(4)]
        for ball in balls:
            add(ball, damping=0.0)
        limit = 2_000_000
        with mock.patch.object(support.addon("core.measures.bounds"), "MANY_AT_ONCE", limit):
            found, count = self.samples(FAR, *balls)
            self.assertLess(10 * count, 1.1 * limit)
            for ball in balls:
                self.assertIn("have fewer dynamics", problem(ball).sentence)
            again, _ = self.samples(FAR, *reversed(balls))
            np.testing.assert_array_equal(again[::-1], found)
            bpy.data.objects.remove(balls.pop())
            bpy.data.objects.remove(balls.pop())
            bpy.context.view_layer.update()
            _, fewer = self.samples(FAR, *balls)
        self.assertGreater(fewer, 0.9 * count, "two have what four had")

    def test_many_rigs_share_the_bound(self):
        """Of each less is sampled than of one alone, and what they make of it is the same in any order."""
        rigs = [self.swinging(3, f"Rope {index}") for index in range(4)]
        limit = 3_000_000  # a rope alone has four whole pieces in it
        with mock.patch.object(support.addon("core.measures.bounds"), "MANY_AT_ONCE", limit):
            self.assertLess(self.check_shared(rigs), 1.1 * limit)
            found = [matrix(rig, FAR, "Tail 0 2") for rig in rigs]
            for rig, expected in reversed(list(zip(rigs, found))):
                go_to(FAR - 40)
                np.testing.assert_array_equal(matrix(rig, FAR, "Tail 0 2"), expected)

    def check_shared(self, rigs):
        """The price of all samples of ropes with three bones on a frame far away."""
        go_to(250)
        _, count = self.samples(FAR, *rigs)
        for rig in rigs:
            self.assertTrue(np.isfinite(matrix(rig, FAR, "Tail 0 2")).all())
        return count * 10 * 4

    def test_many_loops_share_the_bound(self):
        """A long loop has as many samples as there is time for."""
        ball = moved(rows={1: (0.0, 0.0, 0.0), 101: (3.0, 0.0, 0.0), 201: (0.0, 0.0, 0.0)})
        add(ball, use_loop=True, loop_start=1, loop_end=201)
        counts = []
        for limit in (16_000_000, 2000):
            ball.update_tag()
            with mock.patch.object(support.addon("core.measures.bounds"), "MANY_AT_ONCE", limit):
                counts.append(self.samples(30, ball)[1])
        # Whole frames are samples in any case.
        self.assertEqual(counts, [1601, 201])

    def swinging(self, count, name=""):
        """A rope whose bones all repeat their keys for ever, and follow them with hardly any damping."""
        rig = rope(count, name=name or f"Rope {count}")
        for index in range(count):
            bone = rig.pose.bones[f"Tail 0 {index}"]
            bone.rotation_mode = 'XYZ'
            for frame, angle in ((1, 0.0), (7, 0.4), (19, -0.4), (25, 0.0)):
                bone.rotation_euler.x = angle
                bone.keyframe_insert("rotation_euler", frame=frame)
        for curve in support.addon("core.blender.actions").fcurves(rig):
            curve.modifiers.new('CYCLES')
            curve.update()
        names = ",".join(f"Tail 0 {index}" for index in range(count))
        add(rig, bones=names, frequency=0.05, damping=0.05)
        return rig

    def work(self, rig, frame):
        """(Reach of a frame, samples that its inputs have, F-curve values that Blender was asked for one by one)."""
        keys, solve = support.addon("core.animation.keys"), support.addon("dynamics.solve")
        asked, made = [], []

        def values(curve, times):
            asked.append(len(times))
            return asked_of_blender(curve, times)

        def make(*arguments):
            made.append(found_of(*arguments))
            return made[-1]

        asked_of_blender, found_of = keys._asked, solve._make
        with mock.patch.object(keys, "_asked", values), mock.patch.object(solve, "_make", make):
            _, count = self.samples(frame, rig)
        (one,) = made
        return one.reach, count, sum(asked)

    def check_many(self, count):
        """Their numbers together stay below the bound, and F-curves are not read value by value. Returns frames in a piece."""
        rig = self.swinging(count)
        go_to(250)
        reach, samples, asked = self.work(rig, FAR)
        self.assertEqual(asked, 0)
        # A transform at one time is 10 numbers. Keys of the rope are samples too.
        self.assertLess(samples * 10 * (count + 1), 1.1 * support.addon("core.measures.bounds").MANY_AT_ONCE)
        self.assertIn("have fewer dynamics", problem(rig).sentence)
        last = f"Tail 0 {count - 1}"
        alone = matrix(rig, FAR, last)
        self.assertTrue(np.isfinite(alone).all())
        go_to(FAR - 40)
        np.testing.assert_array_equal(matrix(rig, FAR, last), alone)
        return reach.length

    def test_many_entries_at_once(self):
        self.assertEqual(self.check_many(12), round(support.addon("dynamics.sampling").PIECE * bpy.context.scene.render.fps))

    def test_very_many_entries_at_once(self):
        """Of these less is sampled: pieces are shorter."""
        usual = support.addon("dynamics.sampling").PIECE * bpy.context.scene.render.fps
        self.assertLess(self.check_many(100), 0.6 * usual)
