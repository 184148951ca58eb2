"""Snow in a camera's view after a cut: the new view is as full of flakes as in the long run, at once, on any frame."""

import bpy
import numpy as np

from snow.snow_cases import SnowTestCase, actions, flakes, state
from support import go_to, key_places

FALLING = {"rate": 400.0, "lifetime": 2.0, "start_speed": 0.3, "closest": 1.0, "farthest": 15.0, "start_frame": -200.0}
NOISE = 5.0 * 800.0**0.5
"""Of how many of the 800 flakes that live are in view: five deviations."""
PLACES = {1: (1.0, -8.0, 3.0), 60: (60.0, 20.0, 5.0), 120: (1.0, -8.0, 3.0)}


class Shots(SnowTestCase):
    def camera(self, name, place):
        camera = bpy.data.objects.new(name, bpy.data.cameras.new(name))
        camera.location, camera.rotation_euler = place, (1.4, 0.0, 0.3)
        bpy.context.scene.collection.objects.link(camera)
        return camera

    def cut(self):
        """A camera whose keys jump, and its snow."""
        camera = self.camera("Camera", PLACES[1])
        key_places(camera, PLACES)
        for curve in actions().fcurves(camera):
            for key in curve.keyframe_points:
                key.interpolation = 'CONSTANT'
        return camera, self.add(camera="Camera", **FALLING)

    def in_view(self, camera, emitter):
        """How many flakes a camera sees."""
        found = flakes(emitter)["position"]
        points = np.column_stack((found, np.ones(len(found)))) @ np.linalg.inv(np.array(camera.matrix_world)).T
        corner = camera.data.view_frame(scene=bpy.context.scene)[0]
        places = np.abs(points[:, :2] / -points[:, 2:3] / (corner.x / -corner.z, corner.y / -corner.z))
        return int(((points[:, 2] < 0.0) & (places.max(axis=1) <= 1.0)).sum())

    def assertFull(self, camera, emitter, frames):
        """A flake that falls 0.6 m in its life hardly leaves a view of 15 m."""
        for frame in frames:
            go_to(frame)
            self.assertAlmostEqual(self.in_view(camera, emitter), 760.0, delta=NOISE, msg=frame)

    def test_keys_that_jump(self):
        camera, emitter = self.cut()
        self.assertFull(camera, emitter, (59, 60, 61, 59.75, 90, 119, 120, 40, 60.25, 200))
        self.assertEqual(self.sentence(emitter), "")

    def test_a_parent_that_jumps(self):
        camera, emitter = self.cut()
        rig = self.camera("Rig", (0.0, 0.0, 0.0))
        rig.animation_data_create().action = camera.animation_data.action
        if hasattr(rig.animation_data, "action_slot"):
            rig.animation_data.action_slot = camera.animation_data.action_slot
        camera.animation_data_clear()
        camera.location, camera.parent = (0.0, 0.0, 0.0), rig
        self.assertFull(camera, emitter, (59, 60, 120, 61))

    def test_any_frame_first(self):
        _, emitter = self.cut()
        played = {}
        for frame in (*range(55, 66), 119, 120, 121):
            go_to(frame)
            played[frame] = state(emitter)
        for frame in (61, 120, 59, 60, 119, 64):
            go_to(frame)
            self.assertEqual(state(emitter), played[frame], frame)

    def test_a_motion_is_no_cut(self):
        camera, emitter = self.cut()
        for curve in actions().fcurves(camera):
            for key in curve.keyframe_points:
                key.interpolation = 'LINEAR'
        go_to(60)
        # Those that were born one second ago are where the camera was.
        ages, places = flakes(emitter)["age"], flakes(emitter)["position"]
        old = places[np.abs(ages - 1.0) < 0.1].mean(axis=0) - places[ages < 0.1].mean(axis=0)
        way = np.subtract(PLACES[60], PLACES[1]) * 24.0 / 59.0
        np.testing.assert_allclose(old[:2], -way[:2], atol=3.0)

    def test_markers_that_bind_cameras(self):
        scene = bpy.context.scene
        cameras = self.camera("Near", PLACES[1]), self.camera("Far", PLACES[60])
        for frame, camera in ((1, cameras[0]), (60, cameras[1]), (120, cameras[0])):
            scene.timeline_markers.new(camera.name, frame=frame).camera = camera
        emitter = self.add(camera="Near", **FALLING)
        for frame in (59, 60, 61, 119, 120, -50, 90):
            go_to(frame)
            self.assertAlmostEqual(self.in_view(scene.camera, emitter), 760.0, delta=NOISE, msg=frame)
        cameras[1].location.x += 30.0
        bpy.context.view_layer.update()
        self.assertAlmostEqual(self.in_view(cameras[1], emitter), 760.0, delta=NOISE)
        # A camera that is bound later on counts too.
        third = self.camera("Third", (-70.0, 0.0, 2.0))
        scene.timeline_markers.new("Third", frame=150).camera = third
        for frame in (160, 161):
            go_to(frame)
        self.assertAlmostEqual(self.in_view(third, emitter), 760.0, delta=NOISE)
        emitter.motus.snow.follow_markers = False
        bpy.context.view_layer.update()
        self.assertEqual(self.in_view(third, emitter), 0)
        self.assertAlmostEqual(self.in_view(cameras[0], emitter), 760.0, delta=NOISE)
