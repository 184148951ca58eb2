"""Adding snow, what it looks like, taking it away, and bad input."""

import os

import bpy
import numpy as np

import support
from snow.snow_cases import MANY, SnowTestCase, flakes, hub_mesh, instances, state
from support import go_to

LISTS = ("objects", "meshes", "materials", "node_groups")


def counts():
    return {name: len(getattr(bpy.data, name)) for name in LISTS}


class Setup(SnowTestCase):
    def test_it_faces_down(self):
        emitter = self.add(location=(1.0, 2.0, 3.0))
        np.testing.assert_allclose(emitter.matrix_world.col[2].xyz, (0.0, 0.0, -1.0), atol=1e-6)
        np.testing.assert_allclose(emitter.matrix_world.translation, (1.0, 2.0, 3.0))
        settings = emitter.motus.snow
        self.assertEqual((settings.start_speed, settings.lifetime, settings.rate, settings.looping), (5.0, 2.0, 5.0, True))
        self.assertFalse(settings.snow or settings.gravity or settings.random_size)

    def test_a_preset_in_stretched_time(self):
        """Flakes have fallen for their whole life on the scene's first frame."""
        scene = bpy.context.scene
        scene.frame_start, scene.render.frame_map_old, scene.render.frame_map_new = 1001, 100, 200
        settings = self.add(preset='GENTLE').motus.snow
        fps = scene.render.fps / scene.render.fps_base
        self.assertLess(settings.start_frame, 500.5 - settings.lifetime * fps)
        self.assertGreater(settings.start_frame, 500.5 - (settings.lifetime + 2.0) * fps)

    def test_presets(self):
        presets = support.addon("snow.presets")
        for identifier in presets.NUMBERS:
            with self.subTest(identifier):
                emitter = self.add(preset=identifier)
                settings = emitter.motus.snow
                for name, value in presets.NUMBERS[identifier].items():
                    found = getattr(settings, name)
                    if isinstance(value, (bool, str)):
                        self.assertEqual(found, value, name)
                    else:
                        np.testing.assert_allclose(found, value, rtol=1e-6, err_msg=name)
                go_to(1)
                self.assertEqual(self.sentence(emitter), "")
                kind = next(label for name, label, *_ in presets.KINDS if name == identifier)
                self.assertEqual(presets.kind_of(emitter.motus.snow), kind)
                if identifier != presets.PLAIN:
                    self.assertGreater(len(flakes(emitter)["id"]), 0.6 * settings.rate * settings.lifetime)
        self.assertEqual(bpy.ops.motus.snow_preset(object=emitter.name, preset='PLAIN'), {'FINISHED'})
        self.assertEqual(emitter.motus.snow.rate, 5.0)
        own = self.add(preset='GENTLE', rate=7.0).motus.snow
        self.assertEqual((own.rate, presets.kind_of(own)), (7.0, ""))

    def test_flakes_are_instances(self):
        emitter = self.add(random_size=True, location=(0.0, 0.0, 9.0), **MANY)
        go_to(40)
        found, shown = flakes(emitter), instances(emitter)
        self.assertEqual(len(shown), len(found["id"]))
        np.testing.assert_allclose(shown[:, :3, 3], found["position"], atol=1e-5)
        np.testing.assert_allclose(np.linalg.norm(shown[:, :3, 0], axis=1), found["radius"], rtol=1e-4)

    def test_objects_and_collections(self):
        ball = self.mesh("Ball", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        emitter = self.add(flake="Ball", start_size=0.5, **MANY)
        self.assertEqual(emitter.motus.snow.look, 'OBJECT')
        go_to(40)
        shown = instances(emitter)
        self.assertEqual(len(shown), len(flakes(emitter)["id"]))
        np.testing.assert_allclose(np.linalg.norm(shown[:, :3, 0], axis=1), 0.5, rtol=1e-5)
        collection = bpy.data.collections.new("Shapes")
        bpy.context.scene.collection.children.link(collection)
        collection.objects.link(ball)
        collection.objects.link(self.mesh("Other", [(0, 0, 0), (2, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
        settings = emitter.motus.snow
        settings.flakes, settings.look = collection, 'COLLECTION'
        go_to(41)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        names = [one.object.name for one in depsgraph.object_instances if one.is_instance and one.parent.original == emitter]
        self.assertEqual(len(names), len(flakes(emitter)["id"]))
        self.assertEqual(set(names), {"Ball", "Other"})
        settings.look = 'OBJECT'
        settings.flake = None
        self.assertIn("no such object", self.sentence(emitter))
        settings.look = 'POINTS'
        self.assertEqual(self.sentence(emitter), "")
        self.assertEqual(len(instances(emitter)), 0)

    def test_a_flake_keeps_its_shape_from_frame_to_frame(self):
        ball = self.mesh("Ball", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        collection = bpy.data.collections.new("Shapes")
        bpy.context.scene.collection.children.link(collection)
        for one in (ball, self.mesh("Other", [(0, 0, 0), (2, 0, 0), (0, 1, 0)], [(0, 1, 2)])):
            collection.objects.link(one)
        emitter = self.add(flakes="Shapes", rate=20.0)
        shapes = {}
        for frame in (40, 41, 60):
            go_to(frame)
            depsgraph = bpy.context.evaluated_depsgraph_get()
            names = [one.object.name for one in depsgraph.object_instances if one.is_instance and one.parent.original == emitter]
            for number, name in zip(flakes(emitter)["id"].tolist(), names):
                self.assertEqual(shapes.setdefault(number, name), name)

    def test_removed(self):
        before = counts()
        first, second = self.add(**MANY), self.add(look='POINTS')
        self.assertEqual(bpy.ops.motus.snow_remove(object=first.name), {'FINISHED'})
        self.assertEqual(bpy.ops.motus.snow_remove(object=second.name), {'FINISHED'})
        self.assertEqual(counts(), before)
        kept = self.add()
        bpy.ops.motus.snow_remove(object=kept.name, keep_object=True)
        self.assertFalse(kept.modifiers or kept.is_property_set("motus"))
        self.assertRefused("Nothing here snows", bpy.ops.motus.snow_remove, object=kept.name)

    def test_the_gradient(self):
        emitter = self.add(random_color=True, **MANY)
        stops = emitter.motus.snow.stops
        bpy.ops.motus.snow_stop_add(object=emitter.name)
        stops[1].color = 0.0, 0.0, 0.0, 1.0
        go_to(40)
        tints = flakes(emitter)["tint"][:, 0]
        self.assertTrue(tints.min() < 0.1 and tints.max() > 0.9)
        bpy.ops.motus.snow_stop_remove(object=emitter.name)
        self.assertTrue((flakes(emitter)["tint"] == 1.0).all())
        bpy.ops.motus.snow_stop_remove(object=emitter.name, index=0)
        self.assertTrue((flakes(emitter)["tint"] == 1.0).all())
        self.assertRefused("no such colour", bpy.ops.motus.snow_stop_remove, object=emitter.name)

    def test_saved_and_opened_it_is_the_same_and_small(self):
        emitter = self.add(preset='GENTLE', rate=100000.0)
        emitter.motus.snow.preview = 1.0
        go_to(77)
        before, name = state(emitter), emitter.name
        self.saved("snow")
        go_to(5)
        bpy.ops.wm.open_mainfile(filepath=os.path.join(self.folder, "snow.blend"))
        self.assertEqual(state(bpy.data.objects[name]), before)
        sizes = np.array([self.saved("snow", compress) for compress in (True, False)])
        bpy.ops.motus.snow_remove(object=name)
        bpy.ops.outliner.orphans_purge(do_recursive=True)
        compressed, plain = sizes - [self.saved("empty", compress) for compress in (True, False)]
        # Most of it are the sockets of nodes.
        self.assertLess(compressed, 12_000)
        self.assertLess(plain, 70_000)

    def saved(self, name, compress=False):
        """Size of the file of that name, saved anew."""
        file = os.path.join(self.folder, f"{name}.blend")
        bpy.ops.wm.save_as_mainfile(filepath=file, check_existing=False, compress=compress)
        return os.path.getsize(file)

    def test_an_object_has_no_settings_by_being_asked(self):
        emitter = self.add(**MANY)
        emitter.select_set(True)
        go_to(30)
        features = support.addon("core.declare").registered.values()
        self.assertEqual([one.name for one in features if one.settings and emitter.motus.is_property_set(one.name)], ["snow"])

    def test_a_changed_material_survives_another_look(self):
        before, emitter = counts(), self.add(**MANY)
        bpy.data.materials["Motus Flake"].diffuse_color = 1.0, 0.0, 0.0, 1.0
        for look in ('SPARK', 'POINTS', 'FLAKE'):
            emitter.motus.snow.look = look
        self.assertEqual(tuple(bpy.data.materials["Motus Flake"].diffuse_color), (1.0, 0.0, 0.0, 1.0))
        self.assertEqual(bpy.ops.motus.snow_remove(object=emitter.name), {'FINISHED'})
        self.assertEqual(counts(), before)

    def test_an_override_keeps_a_look_of_its_own(self):
        self.add(**MANY)
        emitter = self.load(self.save(), True, "Snow").override_create(remap_local_usages=True)
        for look, shown in (('SPECK', ".Motus Speck"), ('POINTS', None), ('PETAL', ".Motus Petal")):
            emitter.motus.snow.look = look
            bpy.ops.wm.open_mainfile(filepath=self.save(f"{look}.blend"))
            emitter = next(one for one in bpy.data.objects if one.override_library and one.modifiers)
            go_to(40)
            found = instances(emitter)
            self.assertEqual(len(found), 300 if shown else 0)
            depsgraph = bpy.context.evaluated_depsgraph_get()
            self.assertEqual(
                {one.object.name for one in depsgraph.object_instances if one.is_instance and shown}, {shown} if shown else set()
            )


class BadInput(SnowTestCase):
    def test_too_many(self):
        self.assertRefused("would need 127 GB", bpy.ops.motus.snow_add, rate=1e9)
        self.assertEqual(len(bpy.data.objects), 0)
        emitter = self.add(**MANY)
        go_to(30)
        emitter.motus.snow.rate = 1e9
        self.assertIn("16 million", self.sentence(emitter))
        self.assertEqual(len(flakes(emitter)["id"]), 0)
        emitter.motus.snow.rate = 100.0
        self.assertEqual(self.sentence(emitter), "")

    def test_values_that_mean_no_flakes(self):
        emitter = self.add(**MANY)
        go_to(30)
        for name, value in (("rate", 0.0), ("rate", -5.0), ("lifetime", 0.0), ("lifetime", -1.0), ("preview", 0.0)):
            with self.subTest(name, value=value):
                before = getattr(emitter.motus.snow, name)
                setattr(emitter.motus.snow, name, value)
                self.assertEqual(self.sentence(emitter), "")
                self.assertEqual(len(flakes(emitter)["id"]), 0)
                setattr(emitter.motus.snow, name, before)

    def test_what_is_no_number(self):
        for name in ("rate", "lifetime", "start_speed"):
            self.assertRefused("not a finite number", bpy.ops.motus.snow_add, **{name: float("nan")})
        emitter = self.add(**MANY)
        go_to(30)
        emitter.motus.snow.start_speed = float("nan")
        self.assertIn("not a finite number", self.sentence(emitter))
        emitter.motus.snow.start_speed = 1.0
        self.assertEqual(self.sentence(emitter), "")

    def test_an_emitter_scaled_to_nothing(self):
        emitter = self.add(location=(0.0, 0.0, 4.0), **MANY)
        emitter.scale = 0.0, 0.0, 0.0
        go_to(30)
        self.assertIn("a scale of 0", self.sentence(emitter))
        self.assertEqual(len(flakes(emitter)["id"]), 0)
        emitter.scale = 1.0, 1.0, 0.5
        self.assertEqual(self.sentence(emitter), "")
        self.assertEqual(len(instances(emitter)), len(flakes(emitter)["id"]))

    def test_a_deleted_emitter(self):
        before = counts()
        emitter, other = self.add(**MANY), self.add(location=(3.0, 0.0, 0.0), **MANY)
        go_to(30)
        bpy.data.objects.remove(emitter)
        for frame in (31, 32):
            go_to(frame)
        self.assertEqual(len(flakes(other)["id"]), 258)
        bpy.ops.motus.snow_remove(object=other.name)
        bpy.ops.outliner.orphans_purge(do_recursive=True)
        self.assertEqual(counts()["objects"], before["objects"])

    def test_a_file_of_a_newer_version(self):
        """Flakes have other attributes there."""
        emitter = self.add(**MANY)
        go_to(30)
        hub = emitter.motus.snow.hub.data
        hub.attributes.new("later", 'FLOAT', 'POINT')
        hub.update_tag()
        go_to(31)
        self.assertEqual(len(flakes(emitter)["id"]), 250)
        hub.attributes.remove(hub.attributes["tint"])
        hub.update_tag()
        go_to(32)
        self.assertIn("Refresh", self.sentence(emitter))
        self.assertEqual(len(hub_mesh(emitter).vertices), 0)
        self.assertEqual(bpy.ops.motus.refresh(object=emitter.name, system="snow"), {'FINISHED'})
        self.assertEqual(self.sentence(emitter), "")
        self.assertEqual(len(flakes(emitter)["id"]), 258)

    def test_refusals(self):
        self.assertRefused("There is no object Nobody", bpy.ops.motus.snow_add, surface="Nobody")
        self.assertRefused("There is no object Nobody", bpy.ops.motus.snow_add, flake="Nobody")
        self.assertRefused("There is no collection Nobody", bpy.ops.motus.snow_add, flakes="Nobody")
        bpy.context.scene.collection.objects.link(bpy.data.objects.new("Empty", None))
        self.assertRefused("is no mesh", bpy.ops.motus.snow_add, surface="Empty")
        self.assertRefused("Nothing here snows", bpy.ops.motus.snow_preset, object="Empty")
        emitter = self.add(**MANY)
        self.assertRefused("nothing to bake", bpy.ops.motus.bake, object=emitter.name)
