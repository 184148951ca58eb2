"""Emitters that move, and meshes that flakes leave."""

import bpy
import numpy as np

from snow.snow_cases import MANY, OFF_THE_FRAMES, SnowTestCase, flakes, go_to, hub_mesh, seconds, state

SQUARE = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]


def key_places(obj, keys):
    for frame, place in keys.items():
        obj.location = place
        obj.keyframe_insert("location", frame=frame)


class Moving(SnowTestCase):
    def test_flakes_stay_where_they_were_born(self):
        emitter = self.add(rate=50.0, lifetime=2.0, start_speed=0.0, cone_radius=0.0)
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
        emitter = self.add(snow=True, random_lifetime=True, **MANY)
        emitter.parent = carrier
        found = {}
        for _ in range(2):
            for frame in OFF_THE_FRAMES:
                go_to(frame)
                self.assertEqual(found.setdefault(frame, state(emitter)), state(emitter), frame)

    def test_a_motion_without_an_end(self):
        emitter = self.add(rate=50.0, lifetime=2.0, start_speed=0.0, cone_radius=0.0)
        key_places(emitter, {1: (0.0, 0.0, 0.0), 25: (1.0, 0.0, 0.0)})
        animation = emitter.animation_data
        action = animation.action
        curves = action.fcurves if hasattr(action, "fcurves") else [
            curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags for curve in bag.fcurves]
        for curve in curves:
            curve.extrapolation = 'LINEAR'
            for point in curve.keyframe_points:
                point.interpolation = 'LINEAR'
        emitter.update_tag()
        for frame in (255.0, 256.0, 257.5, 10000.0):
            go_to(frame)
            found = flakes(emitter)
            self.assertEqual(len(found["id"]), 100)
            np.testing.assert_allclose(
                found["position"][:, 0], seconds(frame) - found["age"], rtol=1e-5, atol=1e-3)

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
        self.assertRefused(bpy.ops.motus.snow_add, "has no faces", surface="Wire")
        ground = self.mesh("Ground", SQUARE, [(0, 1, 2, 3)])
        emitter = self.add(surface="Ground", **MANY)
        go_to(30)
        ground.data.clear_geometry()
        self.assertIn("has no faces", self.sentence(emitter))
        self.assertEqual(len(hub_mesh(emitter).vertices), 0)
        emitter.motus.snow.surface = None
        self.assertIn("Choose a mesh", self.sentence(emitter))

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


class Collider(SnowTestCase):
    FALLING = {"start_speed": 2.0, "lifetime": 4.0, "rate": 60.0}

    def test_the_ground(self):
        emitter = self.add(use_ground=True, ground=1.0, location=(0.0, 0.0, 3.0), **self.FALLING)
        go_to(121)
        found = flakes(emitter)
        landed = found["age"] > 1.0
        self.assertGreater(np.count_nonzero(landed), 100)
        np.testing.assert_allclose(found["position"][landed, 2], 1.0, atol=1e-5)
        np.testing.assert_allclose(found["position"][~landed, 2], 3.0 - 2.0 * found["age"][~landed], atol=1e-5)
        self.assertPlayedAsCold(emitter)

    def assertPlayedAsCold(self, emitter):
        played = {}
        for frame in (40, 80, 121):
            go_to(frame)
            played[frame] = flakes(emitter)["position"]
        for frame in (121, 40, 80):
            go_to(frame)
            np.testing.assert_array_equal(flakes(emitter)["position"], played[frame])

    def test_a_mesh_in_the_way(self):
        roof = self.mesh("Roof", SQUARE, [(0, 1, 2, 3)], place=(-2.0, -2.0, 2.0))
        roof.scale = 2.0, 4.0, 1.0  # x from -2 to 0
        bpy.context.view_layer.update()
        emitter = self.add(collider="Roof", location=(0.0, 0.0, 3.0), **self.FALLING)
        go_to(121)
        found = flakes(emitter)
        below = found["position"][found["position"][:, 2] < 2.0 - 1e-4]
        self.assertGreater(len(below), 30)
        self.assertGreater(below[:, 0].min(), 0.0)
        lying = np.abs(found["position"][:, 2] - 2.0) < 1e-4
        self.assertGreater(np.count_nonzero(lying & (found["age"] > 0.6)), 30)
        self.assertEqual(self.sentence(emitter), "")
        self.assertPlayedAsCold(emitter)
        roof.location.z = 2.5
        bpy.context.view_layer.update()
        self.assertGreater(np.count_nonzero(np.abs(flakes(emitter)["position"][:, 2] - 2.5) < 1e-4), 30)

    def test_melting(self):
        emitter = self.add(use_ground=True, ground=2.0, collision='MELT', melt_time=0.5, location=(0.0, 0.0, 3.0), **self.FALLING)
        go_to(121)
        found = flakes(emitter)
        self.assertLess(found["age"].max(), 1.0 + 1e-3)
        whole, melting = (found["radius"][choice] for choice in (found["age"] < 0.5, found["age"] > 0.8))
        self.assertLess(melting.max(), 0.6 * whole.min())

    def test_faults_are_said(self):
        roof = self.mesh("Roof", SQUARE, [(0, 1, 2, 3)])
        emitter = self.add(collider="Roof", **self.FALLING)
        key_places(roof, {1: (0.0, 0.0, 0.0), 25: (1.0, 0.0, 0.0)})
        go_to(25)
        self.assertIn("collider moves", self.sentence(emitter))
        self.assertGreater(len(flakes(emitter)["id"]), 0)
        roof.data.clear_geometry()
        go_to(26)
        self.assertIn("has no faces", self.sentence(emitter))
        self.assertGreater(len(flakes(emitter)["id"]), 0)
        bpy.context.scene.collection.objects.unlink(roof)
        for frame in (27, 28):
            go_to(frame)
        self.assertIn("collider is gone", self.sentence(emitter))
        self.assertRefused(bpy.ops.motus.snow_add, "is no mesh", collider=bpy.data.objects.new("Empty", None).name)
