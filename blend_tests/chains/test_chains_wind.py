"""Chains that feel the wind of snow: that of its keys, with its gusts, at any frame."""

import bpy
import numpy as np

import solved_cases
import support
from chains import chain_cases as cases

KEYS = {1: (0.0, 0.0, 0.0), 30: (4.0, 0.0, 0.0), 50: (0.0, -3.0, 0.5)}


class WindTest(solved_cases.Solved, support.SceneTestCase):
    label = "Chains"

    def emitter(self, **settings):
        bpy.ops.motus.snow_add()
        emitter = bpy.context.object
        for name, value in settings.items():
            setattr(emitter.motus.snow, name, value)
        return emitter

    def seen(self, rig):
        return np.array([cases.tails(rig, frame, cases.chain(rig)) for frame in (1, 20, 45.5, 90)])

    def test_it_is_as_if_it_were_its_own(self):
        rig = cases.still_rope(3)
        cases.add(rig, frequency=0.0, drag=4.0)
        calm = self.seen(rig)
        cases.key(rig.motus.chains, "wind", KEYS)
        bpy.context.view_layer.update()
        own = self.seen(rig)
        self.assertGreater(np.abs(own - calm).max(), 0.1)
        rig.animation_data_clear()
        rig.motus.chains.wind = (0.0, 0.0, 0.0)
        emitter = self.emitter()
        cases.key(emitter.motus.snow, "wind", KEYS)
        rig.motus.chains.wind_from = emitter
        bpy.context.view_layer.update()
        self.assertIsNone(cases.problem(rig))
        np.testing.assert_array_equal(self.seen(rig), own)
        support.addon().forget_all()
        np.testing.assert_array_equal(self.seen(rig), own)

    def test_the_own_wind_is_added(self):
        rig = cases.still_rope(3)
        cases.add(rig, frequency=0.0, drag=4.0, settle=30.0, wind=(0.0, 1.5, 0.0), wind_from=self.emitter(wind=(0.0, 0.5, 0.0)))
        way = cases.tail(rig, 1, "Tail 0 0") - cases.place(rig, 1, "Tail 0 0")
        self.assertAlmostEqual(way[1] / -way[2], 4.0 * 2.0 / 9.81, places=2)

    def test_gusts_are_those_of_the_flakes(self):
        """The air is that which flakes have that take on its velocity at once."""
        rig = cases.still_rope(2)
        emitter = self.emitter(wind=(2.0, 1.0, 0.0), gusts=0.7, gust_frequency=0.5, start_frame=10.0)
        cases.add(rig, drag=1.0)
        (found,) = cases.made(lambda: setattr(rig.motus.chains, "wind_from", emitter))
        numbers = {"wind": (2.0, 1.0, 0.0), "gusts": 0.7, "gust_frequency": 0.5}
        flakes = support.addon("core.native").module.Snow(rate=10.0, lifetime=5.0, start_speed=0.0, drag=1000.0, **numbers)
        for frame in (20.0, 40.0, 61.5):
            flown = flakes.evaluate((frame - 10.0) / 24.0)
            air = [np.interp(frame / 24.0, found.times, found.air[:, axis]) for axis in range(3)]
            oldest = np.argmax(flown["age"])
            self.assertGreater(flown["age"][oldest], 0.1)
            np.testing.assert_allclose(flown["velocity"][oldest], air, atol=0.02)
        self.assertGreater(np.ptp(found.air[:, 0]), 1.0)
        # The own wind has the same gusts, counted from the scene's frame 0.
        emitter.motus.snow.start_frame = 0.0
        (snowy,) = cases.made(lambda: setattr(emitter.motus.snow, "seed", 3))
        rig.motus.chains.wind_from = None
        rig.motus.chains.gusts, rig.motus.chains.gust_frequency = 0.7, 0.5
        (own,) = cases.made(lambda: setattr(rig.motus.chains, "wind", (2.0, 1.0, 0.0)))
        np.testing.assert_allclose(own.air, snowy.air, atol=1e-5)

    def test_an_edit_of_the_snow_is_felt(self):
        rig = cases.still_rope(3)
        emitter = self.emitter(wind=(1.0, 0.0, 0.0))
        cases.add(rig, frequency=0.0, drag=4.0, wind_from=emitter)
        for name, value in (("wind", (2.0, 0.0, 0.0)), ("gusts", 0.5), ("gust_frequency", 1.0), ("start_frame", 5.0)):
            before = self.seen(rig)
            self.assertEqual(len(cases.made(lambda name=name, value=value: setattr(emitter.motus.snow, name, value))), 1, name)
            self.assertGreater(np.abs(self.seen(rig) - before).max(), 1e-4, name)
        cases.key(emitter.motus.snow, "wind", KEYS)
        before = self.seen(rig)
        curve = support.addon("core.blender.actions").fcurves(emitter)[0]
        curve.keyframe_points[1].co.y += 3.0
        curve.update()
        emitter.animation_data.action.update_tag()
        bpy.context.view_layer.update()
        self.assertGreater(np.abs(self.seen(rig) - before).max(), 1e-2)

    def test_in_a_loop_it_closes(self):
        rig = cases.still_rope(3)
        bpy.context.scene.frame_end = 80
        cases.add(rig, frequency=1.0, drag=2.0, use_loop=True, wind_from=self.emitter(wind=(3.0, 0.0, 0.0), gusts=0.8))
        self.assertIsNone(cases.problem(rig))
        np.testing.assert_allclose(cases.tails(rig, 81, cases.chain(rig)), cases.tails(rig, 1, cases.chain(rig)), atol=1e-5)
        self.assertGreater(np.abs(cases.tails(rig, 40, cases.chain(rig)) - cases.tails(rig, 1, cases.chain(rig))).max(), 0.01)

    def test_what_hangs_on_it_is_known(self):
        rig = cases.still_rope(3)
        emitter = self.emitter(gusts=0.4)
        cases.key(emitter.motus.snow, "wind", KEYS)
        cases.add(rig, frequency=0.0, drag=3.0, wind_from=emitter)
        self.assertSolved(rig.pose.bones["Tail 0 2"], 1e-4)

    def test_a_wind_of_one_metre_a_second_that_is_driven_is_said(self):
        """What is not known differs from every number that is."""
        rig = cases.still_rope(2)
        cases.add(rig, drag=3.0, wind=(1.0, 0.0, 0.0))
        cases.go_to(3)
        rig.driver_add("motus.chains.wind", 0).driver.expression = "frame"
        bpy.context.view_layer.update()
        cases.go_to(4)
        self.assertIn("The wind is not known", cases.problem(rig).sentence)

    def test_what_is_not_there_or_not_known_is_said(self):
        rig = cases.still_rope(2)
        emitter = self.emitter(wind=(1.0, 0.0, 0.0))
        cases.add(rig, frequency=0.0, drag=3.0, wind_from=emitter)
        calm = self.seen(rig)
        emitter.driver_add("motus.snow.wind", 0).driver.expression = "frame"
        bpy.context.view_layer.update()
        cases.go_to(4)
        self.assertIn("The wind is not known", cases.problem(rig).sentence)
        emitter.driver_remove("motus.snow.wind", 0)
        emitter.update_tag()  # the removal from Python leaves the evaluated copy as it was
        bpy.context.view_layer.update()
        cases.go_to(5)
        self.assertIsNone(cases.problem(rig))
        bpy.ops.motus.snow_remove(object=emitter.name, keep_object=True)
        bpy.context.view_layer.update()
        cases.go_to(6)
        self.assertIn("emits no snow", cases.problem(rig).sentence)
        self.assertGreater(np.abs(self.seen(rig) - calm).max(), 1e-3)
        rig.motus.chains.wind_from = None
        bpy.context.view_layer.update()
        self.assertIsNone(cases.problem(rig))
