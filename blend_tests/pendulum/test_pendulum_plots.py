"""Plots of a pendulum in its panel: what they show is the motion, by formula; they are drawn, or say why not."""

import math

import bpy
import numpy as np

import support
from pendulum.pendulum_cases import PendulumTestCase, native, seconds
from support import go_to


class Plots(PendulumTestCase):
    def setUp(self):
        super().setUp()
        self.plots = support.addon("pendulum.plots")

    def plotted(self, pivot, name):
        """(times, index of the present time, Plot)."""
        swing, times, states, present = self.plots.motion(bpy.context, pivot)
        gravity = bpy.context.scene.gravity.length
        return times, present, self.plots.PLOTS[name](pivot.motus.pendulum, swing, states, gravity)

    def test_angles_over_time(self):
        pivot = self.add(kind='DOUBLE', angle1=1.0, angle2=-0.5)
        for frame, first in ((1, 0.0), (49, 0.0), (241, 6.0)):
            go_to(frame)
            times, present, plot = self.plotted(pivot, 'ANGLE')
            self.assertAlmostEqual(times[0], first)
            self.assertAlmostEqual(times[-1], seconds(frame) + 4.0)
            self.assertLess(abs(times[present] - seconds(frame)), 0.01)
            states = np.degrees(native().double_pendulum(times, 1.0, -0.5, gravity=bpy.context.scene.gravity.length))
            np.testing.assert_allclose(plot.values, states[:, 1], atol=1e-6)
            np.testing.assert_allclose(plot.marks[0], states[:, 0], atol=1e-6)

    def test_energy_is_kept_or_lost(self):
        for kind, keywords in (
            ('SINGLE', {}),
            ('DOUBLE', {"mass1": 2.0, "mass2": 0.5, "length2": 0.7}),
            ('SPHERICAL', {"velocity_sideways": 2.0}),
        ):
            with self.subTest(kind=kind):
                pivot = self.add(kind=kind, angle1=1.3, velocity1=1.0, **keywords)
                go_to(100)
                _, _, plot = self.plotted(pivot, 'ENERGY')
                kinetic, potential = plot.marks
                self.assertLess(np.ptp(plot.values), 1e-9 * np.ptp(kinetic))
                self.assertGreater(np.ptp(kinetic), 1.0)
                np.testing.assert_allclose(kinetic + potential, plot.values)
                pivot.motus.pendulum.damping = 0.2
                _, _, plot = self.plotted(pivot, 'ENERGY')
                self.assertLess(np.diff(plot.values).max(), 0.0)

    def test_energy_by_formula(self):
        pivot = self.add(kind='SINGLE', length1=2.0, angle1=1.0)
        _, _, plot = self.plotted(pivot, 'ENERGY')
        self.assertAlmostEqual(plot.values[0], -bpy.context.scene.gravity.length * 2.0 * math.cos(1.0), 5)
        pivot = self.add(kind='DOUBLE', mass1=2.0, mass2=3.0, length1=1.0, length2=0.5, angle1=0.5, angle2=1.0)
        _, _, plot = self.plotted(pivot, 'ENERGY')
        height = -5.0 * math.cos(0.5) - 3.0 * 0.5 * math.cos(1.0)
        self.assertAlmostEqual(plot.values[0], bpy.context.scene.gravity.length * height, 4)

    def test_the_phase_portrait_is_an_ellipse_for_small_swings(self):
        pivot = self.add(kind='SINGLE', angle1=1e-3)
        _, _, plot = self.plotted(pivot, 'PHASE')
        rate = math.sqrt(bpy.context.scene.gravity.length)
        np.testing.assert_allclose(np.hypot(plot.across[0], plot.values / rate), math.degrees(1e-3), rtol=1e-5)

    def test_backwards_and_on_driven_pivots(self):
        pivot = self.add(kind='SINGLE', speed=-1.0)
        go_to(49)
        times, present, _ = self.plotted(pivot, 'ANGLE')
        self.assertAlmostEqual(times[present], -2.0, 1)
        self.assertAlmostEqual(times[-1], 0.0)
        support.key(pivot, "location", {1: (0.0, 0.0, 0.0), 30: (2.0, 0.0, 0.0)})
        pivot.motus.pendulum.speed, pivot.motus.pendulum.use_pivot_motion = 1.0, True
        _, _, felt = self.plotted(pivot, 'ANGLE')
        pivot.motus.pendulum.use_pivot_motion = False
        _, _, alone = self.plotted(pivot, 'ANGLE')
        self.assertGreater(np.abs(felt.values - alone.values).max(), 1.0)

    def test_what_cannot_be_plotted_says_why(self):
        pivot = self.add(kind='DOUBLE')
        pivot.motus.pendulum.length2 = 0.0
        self.assertIs(self.plots.motion(bpy.context, pivot), support.addon("pendulum.solve").NO_LENGTH)
        pivot.motus.pendulum.length2 = 1.0
        pivot.motus.pendulum.speed = 1e6
        go_to(100)
        self.assertIsInstance(self.plots.motion(bpy.context, pivot), support.addon("core.declare").Problem)


class Lines(support.SceneTestCase):
    def test_a_line_through_points_goes_where_they_are(self):
        graph = support.addon("core.interface.view.graph")
        turn = np.linspace(0.0, 2.0 * math.pi, 200)
        picture = graph.pixels(np.sin(turn), (), (), graph.PAD, (), [0.5 + 0.5 * np.cos(turn)], 0)
        rows, columns = np.nonzero(picture[..., 3] > 0.5)
        half = (graph.HEIGHT - 2 * graph.PAD - 1) / 2.0
        radius = np.hypot((columns / (graph.WIDTH - 1.0) - 0.5) * 2.0, (rows - graph.PAD - half) / half)
        dotted = np.hypot(columns - (graph.WIDTH - 1.0), rows - graph.PAD - half) < 6.0
        self.assertLess(np.abs(radius[~dotted] - 1.0).max(), 0.03)
        self.assertTrue((picture[rows[dotted], columns[dotted], 2] > 0.9).any())
        # The whole circle is there, without gaps.
        angles = np.sort(np.arctan2(rows - graph.PAD - half, columns / (graph.WIDTH - 1.0) * 2.0 * half - half))
        self.assertLess(np.diff(angles).max(), 0.03)
