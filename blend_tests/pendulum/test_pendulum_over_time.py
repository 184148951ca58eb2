"""What hangs on a pendulum is known at any times, for systems that need its past."""

import bpy
import numpy as np

import solved_cases
import support
from pendulum.pendulum_cases import PendulumTestCase, world
from support import go_to


class OverTime(solved_cases.Solved, PendulumTestCase):
    label = "Pendulum"

    def test_rods_and_bobs(self):
        for keywords in ({"kind": 'SINGLE'}, {"kind": 'DOUBLE', "damping": 0.1, "start_frame": 7.5}, {"kind": 'FAN', "count": 3}):
            pivot = self.add(**keywords)
            pivot.location, pivot.rotation_euler, pivot.scale = (1.0, 2.0, 3.0), (0.4, 0.2, -0.7), (2.0, 2.0, 2.0)
            with self.subTest(**keywords):
                self.assertSolved(self.bobs(pivot)[-1])
                self.assertSolved(self.rods(pivot)[0])

    def test_a_rod_with_a_scale_of_its_own(self):
        pivot = self.add(kind='SINGLE')
        (rod,) = self.rods(pivot)
        rod.scale, rod.rotation_euler = (1.0, 0.5, 3.0), (0.1, 0.2, 0.3)
        pivot.scale = (1.0, 2.0, 0.5)
        self.assertSolved(self.bobs(pivot)[0])

    def test_keyed_time_and_influence(self):
        pivot = self.add(kind='DOUBLE')
        settings = pivot.motus.pendulum
        support.key(settings, "is_playing", {1: True, 10: False, 20: True})
        support.key(settings, "speed", {1: 1.0, 60: 0.5})
        support.key(settings, "influence", {1: 0.2, 60: 1.0})
        self.assertSolved(self.bobs(pivot)[1])

    def test_a_pivot_that_is_moved_and_felt(self):
        pivot = self.add(kind='SINGLE', angle1=0.3)
        support.key(pivot, "location", {1: (0.0, 0.0, 0.0), 30: (2.0, 0.0, 0.0)})
        self.assertSolved(self.bobs(pivot)[0])
        pivot.motus.pendulum.use_pivot_motion = True
        self.assertSolved(self.bobs(pivot)[0])
        self.assertIn(30.0, solved_cases.track(self.bobs(pivot)[0]).bounds(1.0, 60.0))

    def test_when_it_moves(self):
        pivot = self.add(kind='SINGLE', start_frame=12.0)
        (bob,) = self.bobs(pivot)
        self.assertEqual(solved_cases.track(bob).extent, (12.0, np.inf))
        pivot.motus.pendulum.is_playing = False
        self.assertIsNone(solved_cases.track(bob).extent)

    def test_what_is_not_known(self):
        pivot = self.add(kind='SINGLE')
        (bob,) = self.bobs(pivot)
        pivot.motus.pendulum.driver_add("speed").driver.expression = "frame / 10"
        self.assertUnknown(bob, "driver")
        pivot.motus.pendulum.driver_remove("speed")
        self.assertSolved(bob)
        pivot.motus.pendulum.length1 = 0.0  # the panel says so; the rod hangs
        self.assertSolved(bob)

    def test_more_rods_than_the_settings_say(self):
        """The solver says that something is damaged, and leaves all of them where they hang."""
        pivot = self.add(kind='FAN', count=5)
        pivot.motus.pendulum.count = 2
        pivot.update_tag()
        for rod in (self.rods(pivot)[0], self.rods(pivot)[-1], self.bobs(pivot)[-1]):
            self.assertSolved(rod)

    def test_dynamics_on_what_hangs_on_a_bob(self):
        pivot = self.add(kind='DOUBLE')
        flag = self.link("Flag")
        flag.parent = self.bobs(pivot)[1]
        bpy.ops.motus.dynamics_add(object="Flag", style='BOUNCY')
        wiring, dynamics = support.addon("core.wiring"), support.addon("dynamics").SYSTEM
        go_to(40)
        self.assertIsNone(wiring.problem(dynamics, flag, bpy.context.evaluated_depsgraph_get()))
        alone = world(flag)
        for frame in (90, 3, 12.5):
            go_to(frame)
        go_to(40)
        np.testing.assert_array_equal(world(flag), alone)
        before = world(flag)
        pivot.motus.pendulum.angle1 = 0.2
        go_to(40)
        self.assertGreater(np.abs(world(flag) - before).max(), 0.1)
