"""The flakes in Blender are the library's, on any frame in any order."""

import bpy
import numpy as np

from snow.snow_cases import MANY, OFF_THE_FRAMES, SnowTestCase, flakes, hub_mesh, instances, native, seconds, state
from support import go_to

EVERYTHING = {
    "random_speed": True,
    "random_orientation": True,
    "random_lifetime": True,
    "random_size": True,
    "random_color": True,
    "use_steering": True,
    "steering_per_flake": True,
    "gravity": True,
    "drag": 0.7,
    "wind": (1.0, 0.5, 0.0),
    "gusts": 0.4,
    "turbulence": 0.3,
    "tumble": 2.0,
    "cone_angle": 0.4,
    "seed": 7,
    "max_angle": 1.2,
    "steering_frequency": 0.8,
    "gust_frequency": 0.4,
    "turbulence_size": 1.5,
}

NATIVE = {
    "emitter_radius": "cone_radius",
    "use_steering": "snow",
    "steering_frequency": "snow_frequency",
    "steering_per_flake": "snow_offsets",
}
"""Keyword of the operator -> argument of the library, where they differ."""


class Flakes(SnowTestCase):
    def library(self, emitter, frame, **keywords):
        """What the library makes of an emitter that stands still."""
        matrix = np.array(emitter.matrix_world)
        keywords = {NATIVE.get(name, name): value for name, value in keywords.items()}
        return native().Snow(emitter_times=[0.0], emitter_matrices=[matrix], **keywords).evaluate(seconds(frame))

    def test_the_defaults_are_the_librarys(self):
        emitter = self.add(location=(0.0, 0.0, 10.0), all_attributes=True)
        go_to(49)
        expected = self.library(emitter, 49)
        found = flakes(emitter)
        self.assertEqual(len(found["id"]), 10)
        np.testing.assert_array_equal(found["id"], expected["id"])
        np.testing.assert_array_equal(found["position"], expected["position"])
        np.testing.assert_array_equal(found["velocity"], expected["velocity"])
        np.testing.assert_array_equal(found["tint"], np.ones((10, 4), np.float32))
        # It faces down, and is 5 m/s fast.
        np.testing.assert_allclose(found["position"][:, 2], 10.0 - 5.0 * found["age"], atol=1e-5)
        np.testing.assert_allclose(found["radius"], 0.025, rtol=1e-6)

    def test_every_setting_arrives(self):
        emitter = self.add(location=(1.0, 2.0, 3.0), all_attributes=True, **MANY, **EVERYTHING)
        settings = emitter.motus.snow
        settings.stops[0].color = 1.0, 0.0, 0.0, 1.0
        stop = settings.stops.add()
        stop.position, stop.color = 1.0, (0.0, 0.0, 1.0, 1.0)
        go_to(40)
        gravity = tuple(bpy.context.scene.gravity)
        keywords = {
            name: tuple(value) if hasattr(value, "__len__") else value
            for name, value in ((name, getattr(settings, name)) for name in (*MANY, *EVERYTHING))
        }
        expected = self.library(
            emitter,
            40,
            acceleration=gravity,
            start_size=0.5 * settings.flake_width,
            start_color=([0.0, 1.0], [[1, 0, 0, 1], [0, 0, 1, 1]]),
            **keywords,
        )
        found = flakes(emitter)
        self.assertGreater(len(found["id"]), 200)
        for name, own in (
            ("position", "position"),
            ("velocity", "velocity"),
            ("tint", "color"),
            ("radius", "size"),
            ("age", "age"),
            ("id", "id"),
        ):
            np.testing.assert_array_equal(found[name], expected[own], name)

    def test_attributes_that_a_look_needs(self):
        emitter = self.add(**MANY)
        settings = emitter.motus.snow
        go_to(40)
        before = instances(emitter)
        for look, all_attributes, missing in (
            ('FLAKE', False, {"velocity"}),
            ('POINTS', False, {"turn"}),
            ('POINTS', True, set()),
            ('FLAKE', True, set()),
            ('OBJECT', False, {"velocity"}),
            ('FLAKE', False, {"velocity"}),
        ):
            with self.subTest(look, all_attributes=all_attributes):
                settings.look, settings.all_attributes = look, all_attributes
                names = set(hub_mesh(emitter).attributes.keys())
                self.assertEqual({"velocity", "radius", "tint", "age", "turn", "id"} - names, missing)
                self.assertEqual(len(hub_mesh(emitter).vertices), len(before))
        np.testing.assert_array_equal(instances(emitter), before)

    def test_any_frame_in_any_order(self):
        emitter = self.add(**MANY, **EVERYTHING)

        def states():
            found = {}
            for frame in OFF_THE_FRAMES:
                go_to(frame)
                self.assertEqual(found.setdefault(frame, state(emitter)), state(emitter), frame)
            return found

        first = states()
        self.assertEqual(states(), first)
        for frame in range(1, 31):
            go_to(frame)
        self.assertEqual(state(emitter), first[30])
        self.assertEqual(first[1], b"")
        self.assertNotEqual(first[24.5], first[17])

    def test_other_frame_rates_have_the_same_times(self):
        emitter = self.add(**MANY, **EVERYTHING)
        go_to(1 + 24)
        before = state(emitter)
        bpy.context.scene.render.fps = 48
        go_to(1 + 48)
        self.assertEqual(state(emitter), before)

    def test_a_burst(self):
        emitter = self.add(rate=0.0, burst=50, burst_time=0.5)
        go_to(12)
        self.assertEqual(len(flakes(emitter)["id"]), 0)
        go_to(13)
        self.assertEqual(len(flakes(emitter)["id"]), 50)

    def test_the_preview_shows_some_of_the_flakes(self):
        emitter = self.add(rate=4000.0, lifetime=1.5, all_attributes=True, **EVERYTHING)
        go_to(60)
        whole = flakes(emitter)
        shown = set()
        for percentage in (0.0, 3.0, 25.0, 70.0):
            emitter.motus.snow.preview = percentage
            found = flakes(emitter)
            numbers = set(found["id"].tolist())
            self.assertLessEqual(shown, numbers)
            shown = numbers
            self.assertAlmostEqual(len(numbers) / len(whole["id"]), percentage / 100.0, delta=0.02)
            places = np.flatnonzero(np.isin(whole["id"], found["id"]))
            for name, array in found.items():
                np.testing.assert_array_equal(array, whole[name][places], name)

    def test_edits_reach_them(self):
        emitter = self.add(**MANY)
        go_to(49)
        before = flakes(emitter)
        emitter.location.x = 3.0
        bpy.context.view_layer.update()
        np.testing.assert_allclose(flakes(emitter)["position"], before["position"] + (3.0, 0.0, 0.0), atol=1e-6)
        emitter.motus.snow.rate = 400.0
        self.assertEqual(len(flakes(emitter)["id"]), 600)
        emitter.motus.snow.influence = 0.0
        self.assertEqual(len(flakes(emitter)["id"]), 0)

    def test_the_scenes_gravity(self):
        emitter = self.add(gravity=True, start_speed=0.0, location=(0.0, 0.0, 0.0), emitter_radius=0.0)
        scene = bpy.context.scene
        scene.gravity = 0.0, 2.0, 0.0
        go_to(48)
        found = flakes(emitter)
        np.testing.assert_allclose(found["position"][:, 1], found["age"] ** 2, atol=1e-5)
        scene.use_gravity = False
        go_to(49)
        np.testing.assert_allclose(flakes(emitter)["position"], 0.0, atol=1e-6)
        scene.use_gravity, scene.gravity = True, (0.0, 0.0, -9.81)
