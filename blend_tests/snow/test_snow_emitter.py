"""Emitters that move, meshes that flakes leave, cameras in whose view they are born, and keyed wind."""

import bpy
import numpy as np

import support
from snow.snow_cases import MANY, OFF_THE_FRAMES, SnowTestCase, actions, flakes, hub_mesh, native, seconds, state
from support import go_to, key_places

SQUARE = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]


class Moving(SnowTestCase):
    def test_flakes_stay_where_they_were_born(self):
        emitter = self.add(rate=50.0, lifetime=2.0, start_speed=0.0, emitter_radius=0.0)
        key_places(emitter, {1: (0.0, 0.0, 0.0), 49: (8.0, 0.0, 2.0)})
        born = {}
        for frame in (25, 25.5, 40, 49, 60, 30):
            go_to(frame)
            found = flakes(emitter)
            for number, place in zip(found["id"].tolist(), found["position"]):
                np.testing.assert_allclose(born.setdefault(number, place), place, atol=1e-6)
        for number, place in born.items():
            go_to(1.0 + 24.0 * (number + 1) / 50.0)
            np.testing.assert_allclose(place, emitter.matrix_world.translation, atol=2e-3)

    def test_any_frame_in_any_order(self):
        carrier = bpy.data.objects.new("Carrier", None)
        bpy.context.scene.collection.objects.link(carrier)
        key_places(carrier, {1: (0.0, 0.0, 0.0), 60: (4.0, 0.0, 0.0)})
        carrier.rotation_euler.z = 0.0
        carrier.keyframe_insert("rotation_euler", frame=1)
        carrier.rotation_euler.z = 5.0
        carrier.keyframe_insert("rotation_euler", frame=60)
        emitter = self.add(use_steering=True, random_lifetime=True, **MANY)
        emitter.parent = carrier
        found = {}
        for _ in range(2):
            for frame in OFF_THE_FRAMES:
                go_to(frame)
                self.assertEqual(found.setdefault(frame, state(emitter)), state(emitter), frame)

    def test_a_motion_without_an_end(self):
        emitter = self.add(rate=50.0, lifetime=2.0, start_speed=0.0, emitter_radius=0.0)
        key_places(emitter, {1: (0.0, 0.0, 0.0), 25: (1.0, 0.0, 0.0)})
        animation = emitter.animation_data
        action = animation.action
        curves = (
            action.fcurves
            if hasattr(action, "fcurves")
            else [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags for curve in bag.fcurves]
        )
        for curve in curves:
            curve.extrapolation = 'LINEAR'
            for point in curve.keyframe_points:
                point.interpolation = 'LINEAR'
        emitter.update_tag()
        for frame in (255.0, 256.0, 257.5, 10000.0):
            go_to(frame)
            found = flakes(emitter)
            self.assertEqual(len(found["id"]), 100)
            np.testing.assert_allclose(found["position"][:, 0], seconds(frame) - found["age"], rtol=1e-5, atol=1e-3)

    def test_an_unknown_motion_is_said(self):
        emitter = self.add(**MANY)
        target = bpy.data.objects.new("Target", None)
        bpy.context.scene.collection.objects.link(target)
        constraint = emitter.constraints.new('COPY_LOCATION')
        constraint.target = target
        key_places(target, {1: (0.0, 0.0, 0.0), 25: (1.0, 0.0, 0.0)})
        go_to(25)
        self.assertIn("not known ahead", self.sentence(emitter))
        self.assertGreater(len(flakes(emitter)["id"]), 0)
        self.assertEqual(bpy.ops.motus.track_record(datablock=emitter.name, frame_start=1, frame_end=50), {'FINISHED'})
        self.assertEqual(self.sentence(emitter), "")


class Surface(SnowTestCase):
    def test_flakes_leave_the_faces(self):
        ground = self.mesh("Ground", SQUARE, [(0, 1, 2, 3)], place=(5.0, 0.0, 1.0))
        emitter = self.add(surface="Ground", start_speed=1.0, **MANY)
        go_to(60)
        found = flakes(emitter)
        self.assertGreater(len(found["id"]), 200)
        np.testing.assert_allclose(found["position"][:, 2], 1.0 + found["age"], atol=1e-5)
        self.assertGreater(found["position"][:, 0].min(), 5.0 - 1e-5)
        self.assertLess(found["position"][:, 0].max(), 6.0 + 1e-5)
        ground.location.z = 3.0
        bpy.context.view_layer.update()
        found = flakes(emitter)
        np.testing.assert_allclose(found["position"][:, 2], 3.0 + found["age"], atol=1e-5)

    def test_modifiers_count(self):
        ground = self.mesh("Ground", SQUARE, [(0, 1, 2, 3)])
        array = ground.modifiers.new("Array", 'ARRAY')
        array.count = 3
        emitter = self.add(surface="Ground", start_speed=0.0, **MANY)
        go_to(60)
        self.assertGreater(flakes(emitter)["position"][:, 0].max(), 2.5)
        array.count = 1
        bpy.context.view_layer.update()
        self.assertLess(flakes(emitter)["position"][:, 0].max(), 1.0 + 1e-5)

    def test_what_has_no_faces(self):
        self.mesh("Wire", SQUARE, [])
        self.assertRefused("has no faces", bpy.ops.motus.snow_add, surface="Wire")
        ground = self.mesh("Ground", SQUARE, [(0, 1, 2, 3)])
        emitter = self.add(surface="Ground", **MANY)
        go_to(30)
        ground.data.clear_geometry()
        self.assertIn("has no faces", self.sentence(emitter))
        self.assertEqual(len(hub_mesh(emitter).vertices), 0)
        emitter.motus.snow.surface = None
        self.assertIn("Choose the mesh", self.sentence(emitter))

    def test_a_deleted_surface(self):
        ground = self.mesh("Ground", SQUARE, [(0, 1, 2, 3)])
        emitter = self.add(surface="Ground", **MANY)
        go_to(30)
        self.assertEqual(self.sentence(emitter), "")
        bpy.context.scene.collection.objects.unlink(ground)
        go_to(31)
        go_to(32)
        self.assertIn("in no collection", self.sentence(emitter))
        self.assertEqual(len(hub_mesh(emitter).vertices), 0)


class Camera(SnowTestCase):
    def camera(self, **settings):
        data = bpy.data.cameras.new("Camera")
        for name, value in settings.items():
            setattr(data, name, value)
        camera = bpy.data.objects.new("Camera", data)
        camera.location, camera.rotation_euler = (1.0, -8.0, 3.0), (1.4, 0.0, 0.3)
        bpy.context.scene.collection.objects.link(camera)
        bpy.context.view_layer.update()
        return camera

    def seen(self, camera, found):
        """Where points are in the camera's picture, as shares of its width and height from the middle; and how far away."""
        points = np.column_stack((found["position"], np.ones(len(found["id"])))) @ np.linalg.inv(np.array(camera.matrix_world)).T
        corner = camera.data.view_frame(scene=bpy.context.scene)[0]
        return np.abs(points[:, :2] / -points[:, 2:3] / (corner.x / -corner.z, corner.y / -corner.z)), -points[:, 2]

    def test_flakes_are_born_in_what_a_camera_sees(self):
        camera = self.camera(lens=35.0)
        emitter = self.add(camera="Camera", start_speed=0.0, closest=2.0, farthest=15.0, **MANY)
        self.assertEqual(emitter.motus.snow.shape, 'CAMERA')
        go_to(60)
        places, distances = self.seen(camera, flakes(emitter))
        self.assertEqual(len(distances), 300)
        self.assertLess(places.max(), 1.0 + 1e-4)
        self.assertGreater(places.max(axis=0).min(), 0.95)
        self.assertTrue(distances.min() > 2.0 - 1e-4 and distances.max() < 15.0 + 1e-4)
        # The lens, the picture's shape and the camera's place.
        before = state(emitter)
        camera.data.lens = 100.0
        places, _ = self.seen(camera, flakes(emitter))
        self.assertTrue(0.95 < places.max() < 1.0 + 1e-4)
        camera.data.lens = 35.0
        self.assertEqual(state(emitter), before)
        camera.location.z = 5.0
        bpy.context.view_layer.update()
        self.assertNotEqual(state(emitter), before)
        self.assertEqual(self.sentence(emitter), "")

    def test_a_zoom_and_a_pan_are_known_at_any_frame(self):
        camera = self.camera(lens=80.0)
        camera.data.keyframe_insert("lens", frame=1)
        camera.data.lens = 30.0
        camera.data.keyframe_insert("lens", frame=50)
        key_places(camera, {1: (0.0, -8.0, 3.0), 60: (4.0, -8.0, 3.0)})
        emitter = self.add(camera="Camera", use_steering=True, start_speed=1.0, **MANY)
        found = {}
        for _ in range(2):
            for frame in OFF_THE_FRAMES:
                go_to(frame)
                self.assertEqual(found.setdefault(frame, state(emitter)), state(emitter), frame)
        # Flakes that were born early are where those of the widest lens are.
        emitter.motus.snow.start_speed = 0.0
        go_to(40)
        early = dict(zip(flakes(emitter)["id"].tolist(), map(tuple, flakes(emitter)["position"])))
        go_to(60)
        for number, place in zip(flakes(emitter)["id"].tolist(), flakes(emitter)["position"]):
            if number in early:
                np.testing.assert_allclose(place, early[number], atol=1e-5)

    def test_the_scale_of_a_camera_counts_for_nothing(self):
        camera = self.camera()
        parent = bpy.data.objects.new("Parent", None)
        bpy.context.scene.collection.objects.link(parent)
        camera.parent = parent
        emitter = self.add(camera="Camera", start_speed=0.0, **MANY)

        def born():
            """Where flakes are, as the camera sees them."""
            place, turn, _ = camera.matrix_world.decompose()
            return (flakes(emitter)["position"] - place) @ np.array(turn.to_matrix())

        go_to(60)
        before = born()
        camera.scale = 3.0, 2.0, 0.5
        bpy.context.view_layer.update()
        np.testing.assert_allclose(born(), before, atol=1e-4)
        parent.scale = 3.0, 3.0, 3.0
        bpy.context.view_layer.update()
        np.testing.assert_allclose(born(), before, atol=1e-4)
        # At its poses over time, too.
        parent.scale, camera.scale = (1.0, 1.0, 1.0), (1.0, 1.0, 1.0)
        key_places(camera, {1: (1.0, -8.0, 3.0), 60: (4.0, -8.0, 3.0)})
        go_to(60)
        before = born()
        camera.scale = 3.0, 2.0, 0.5
        bpy.context.view_layer.update()
        np.testing.assert_allclose(born(), before, atol=1e-4)

    def test_shift_and_sensor(self):
        camera = self.camera(lens=35.0, shift_x=0.3, shift_y=-0.1)
        emitter = self.add(camera="Camera", start_speed=0.0, closest=2.0, **MANY)
        view = support.addon("snow.view")

        def seen():
            evaluated = camera.evaluated_get(bpy.context.evaluated_depsgraph_get())
            frame = np.array([tuple(corner) for corner in evaluated.data.view_frame(scene=bpy.context.scene)])
            found = view.angles(evaluated, evaluated.matrix_world, bpy.context.scene)
            return np.tan(found), np.abs(frame[:, :2] / frame[:, 2:]).max(axis=0)

        for fit in ('AUTO', 'HORIZONTAL', 'VERTICAL'):
            for size in ((1920, 1080), (600, 900)):
                with self.subTest(fit=fit, size=size):
                    render = bpy.context.scene.render
                    render.resolution_x, render.resolution_y = size
                    camera.data.sensor_fit = fit
                    bpy.context.view_layer.update()
                    np.testing.assert_allclose(*seen(), rtol=1e-5)
        # Keyed, they count at the widest on all frames.
        widest = [0.0, 0.0]
        for name, values in (("shift_x", (0.0, -0.5)), ("sensor_width", (36.0, 20.0)), ("sensor_height", (20.0, 30.0))):
            for frame, value in zip((1, 60), values):
                setattr(camera.data, name, value)
                camera.data.keyframe_insert(name, frame=frame)
        found = {}
        for frame in (60, 1, 30, 60):
            go_to(frame)
            angles, now = seen()
            widest = np.maximum(widest, now)
            np.testing.assert_array_equal(found.setdefault("angles", angles), angles)
        self.assertTrue((found["angles"] >= widest - 1e-6).all())
        self.assertEqual(self.sentence(emitter), "")
        for frame in (60, 1, 30, 60, 1):
            go_to(frame)
            self.assertEqual(found.setdefault(frame, state(emitter)), state(emitter), frame)
        camera.data.driver_add("shift_y").driver.expression = "0.1 * frame"
        bpy.context.view_layer.update()
        self.assertIn("lens is not known ahead", self.sentence(emitter))

    def test_faults_are_said(self):
        self.assertRefused("The scene has no camera", bpy.ops.motus.snow_add, shape='CAMERA')
        bpy.context.scene.collection.objects.link(bpy.data.objects.new("Empty", None))
        self.assertRefused("is no camera", bpy.ops.motus.snow_add, camera="Empty")
        camera = self.camera()
        bpy.context.scene.camera = camera
        emitter = self.add(shape='CAMERA', **MANY)
        self.assertEqual(emitter.motus.snow.camera, camera)
        go_to(30)
        self.assertEqual(self.sentence(emitter), "")
        camera.data.type = 'ORTHO'
        self.assertIn("perspective camera", self.sentence(emitter))
        camera.data.type = 'PERSP'
        bpy.context.scene.collection.objects.unlink(camera)
        for frame in (31, 32):
            go_to(frame)
        self.assertIn("camera is in no collection", self.sentence(emitter))
        emitter.motus.snow.camera = None
        self.assertIn("Choose a camera", self.sentence(emitter))
        self.assertEqual(len(flakes(emitter)["id"]), 0)


class Wind(SnowTestCase):
    BLOWN = {"start_speed": 0.0, "emitter_radius": 0.0, "drag": 2.0, "gusts": 0.3, "location": (0.0, 0.0, 0.0)}

    def blown(self):
        """An emitter with wind that is keyed."""
        emitter = self.add(**self.BLOWN, **MANY)
        for frame, wind in ((1, (0.0, 0.0, 0.0)), (20, (4.0, 0.0, 0.0)), (40, (0.0, -3.0, 0.5))):
            emitter.motus.snow.wind = wind
            emitter.keyframe_insert("motus.snow.wind", frame=frame)
        for curve in actions().own_curves(emitter, lambda path: path == "motus.snow.wind"):
            for one in curve:
                for point in one.keyframe_points:
                    point.interpolation = 'LINEAR'
        emitter.update_tag()
        return emitter

    def test_keys_are_the_librarys_wind_over_time(self):
        emitter = self.blown()
        for frame in (45, 12, 60):
            go_to(frame)
            found = flakes(emitter)
            times = [seconds(one) for one in (1.0, 20.0, 40.0)]
            expected = (
                native()
                .Snow(
                    rate=200.0,
                    lifetime=1.5,
                    start_speed=0.0,
                    cone_radius=0.0,
                    drag=2.0,
                    gusts=0.3,
                    wind_times=times,
                    wind_values=[(0, 0, 0), (4, 0, 0), (0, -3, 0.5)],
                )
                .evaluate(seconds(frame))
            )
            np.testing.assert_allclose(found["position"], expected["position"], atol=1e-4)
        self.assertEqual(self.sentence(emitter), "")

    def test_any_frame_in_any_order(self):
        emitter = self.blown()
        found = {}
        for _ in range(2):
            for frame in OFF_THE_FRAMES:
                go_to(frame)
                self.assertEqual(found.setdefault(frame, state(emitter)), state(emitter), frame)

    def test_a_driven_wind_is_said(self):
        emitter = self.add(**self.BLOWN, **MANY)
        driver = emitter.driver_add("motus.snow.wind", 0).driver
        driver.expression = "frame"
        go_to(30)
        self.assertIn("wind is not known ahead", self.sentence(emitter))
        self.assertGreater(len(flakes(emitter)["id"]), 0)
        self.assertEqual(
            bpy.ops.motus.track_record(datablock=emitter.name, data_path="motus.snow.wind", index=0, frame_start=1, frame_end=50),
            {'FINISHED'},
        )
        self.assertEqual(self.sentence(emitter), "")
