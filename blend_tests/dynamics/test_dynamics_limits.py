"""What dynamics bound, and what they say where they cannot do what is wanted."""

from unittest import mock

import bpy
import numpy as np

import support
from dynamics.dynamics_cases import add, link, matrix, moved, place, problem

LEVELS = 8


class DynamicsLimitsTest(support.SceneTestCase):
    def nested(self):
        """Empties, each the child of the one before, all with dynamics."""
        found = [moved("Level 0")]
        for level in range(1, LEVELS):
            found.append(link(f"Level {level}", parent=found[-1]))
            found[-1].location.z = 1.0
        for one in found:
            add(one, follow='WORLD' if one.parent else 'OWN', frequency=2.0)
        return found

    @support.in_one_blender
    def test_nested_things_are_worked_out_once_a_level(self):
        motion = support.addon("dynamics.motion")
        levels = self.nested()
        with mock.patch.object(motion, "part_of", wraps=motion.part_of) as made:
            levels[0].keyframe_insert("location", frame=40)
            last = place(levels[-1], 30)
        self.assertGreater(made.call_count, LEVELS - 1)
        self.assertLess(made.call_count, 2 * LEVELS * LEVELS)
        np.testing.assert_array_equal(last, place(levels[-1], 30))

    @support.in_one_blender
    def test_nested_things_in_any_order(self):
        levels = self.nested()
        alone = matrix(levels[-1], 33)
        for frame in (1, 80, 12.5):
            matrix(levels[-1], frame)
        np.testing.assert_array_equal(matrix(levels[-1], 33), alone)
        self.assertGreater(abs(place(levels[-1], 24)[0] - place(levels[0], 24)[0]), 0.01)

    def test_jumps_in_a_loop_are_named(self):
        ball = moved(rows={1: (0.0, 0.0, 0.0), 10: (9.0, 0.0, 0.0), 24: (0.0, 0.0, 0.0)}, interpolation='CONSTANT')
        (entry,) = add(ball, jump=3.0)
        place(ball, 12)
        self.assertIsNone(problem(ball))
        entry.use_loop, entry.loop_start, entry.loop_end = True, 1, 24
        place(ball, 12)
        self.assertIn("jumps", problem(ball).sentence)

    def test_constraints_of_its_own_are_named(self):
        ball, target = moved(), link("Target")
        add(ball)
        constraint = ball.constraints.new('COPY_LOCATION')
        constraint.target = target
        place(ball, 12)
        self.assertIn("Constraints", problem(ball).sentence)
        constraint.mute = True
        place(ball, 13)
        self.assertIsNone(problem(ball))

    def test_numbers_that_are_none(self):
        for name in ("delay", "jump", "weight"):
            with self.subTest(name=name):
                ball = moved(f"Ball {name}")
                (entry,) = add(ball)
                entry[name] = float("nan")
                ball.update_tag()
                self.assertTrue(np.isfinite(matrix(ball, 25)).all())
                self.assertIn("numbers", problem(ball).sentence)

    def test_unbaked_it_is_whole(self):
        add(moved())
        bpy.ops.motus.bake(object="Ball", frame_start=1, frame_end=30)
        objects, partial = support.addon("core.bake.job").unbake(bpy.data.objects["Ball"])
        self.assertEqual((len(objects), partial), (1, []))
