"""Adding and removing snow that lies, its lists and presets, what is said of bad input, and work that takes long."""

from unittest import mock

import bpy
import numpy as np

import support
from snow.cover_cases import FALLING, CoverTestCase, layer, state
from snow.snow_cases import flakes
from snow.test_snow_setup import counts
from support import go_to


class Setup(CoverTestCase):
    def test_for_what_is_selected(self):
        before = counts()
        meadow = self.square()
        emitter = self.add(**FALLING)
        for obj in bpy.context.selected_objects:
            obj.select_set(False)
        meadow.select_set(True)
        self.assertEqual(bpy.ops.motus.snow_cover_add(), {'FINISHED'})
        cover = bpy.context.object
        settings = cover.motus.snow_cover
        self.assertEqual([entry.object for entry in settings.surfaces], [meadow])
        self.assertEqual([entry.object for entry in settings.emitters], [emitter])
        self.assertTrue(settings.is_active)
        self.assertEqual(bpy.ops.motus.snow_cover_remove(), {'FINISHED'})
        self.assertFalse(cover in list(bpy.data.objects))
        bpy.ops.motus.snow_remove(object=emitter.name)
        bpy.data.meshes.remove(meadow.data)
        self.assertEqual(counts(), before)

    def test_what_hangs_on_it_stays(self):
        self.square()
        self.add(**FALLING)
        cover = self.cover()
        cover.location.x = 5.0
        lamp = bpy.data.objects.new("Lamp", None)
        bpy.context.scene.collection.objects.link(lamp)
        lamp.parent = cover
        bpy.context.view_layer.update()
        self.assertEqual(lamp.matrix_world.translation.x, 5.0)
        self.assertEqual(bpy.ops.motus.snow_cover_remove(object=cover.name), {'FINISHED'})
        bpy.context.view_layer.update()
        self.assertEqual(lamp.matrix_world.translation.x, 5.0)

    def test_refused(self):
        add = bpy.ops.motus.snow_cover_add
        self.square()
        self.assertRefused("It does not snow in this scene", add, surfaces="Meadow")
        emitter = self.add(**FALLING)
        self.mesh("Wire", [(0, 0, 0), (1, 0, 0)], [])
        self.assertRefused("Select the meshes", add)
        self.assertRefused("has no faces", add, surfaces="Wire")
        self.assertRefused("cannot lie on", add, surfaces=emitter.name)
        self.assertRefused("There is no object Nobody", add, surfaces="Nobody")
        self.assertRefused("is no emitter", add, surfaces="Meadow", emitters="Meadow")
        self.assertRefused("no collection", add, collection="Nowhere")
        self.assertRefused("not a finite number", add, surfaces="Meadow", lump=float("nan"))
        self.assertRefused("no snow cover", bpy.ops.motus.snow_cover_remove, object="Meadow")
        self.assertFalse(any(obj.is_property_set("motus") and obj.motus.snow_cover.is_active for obj in bpy.data.objects))

    def test_sentences(self):
        meadow, emitter = self.square(), self.add(**FALLING)
        cover = self.cover(lands=False)
        settings = cover.motus.snow_cover
        go_to(100)
        self.assertEqual(self.cover_sentence(cover), "")
        for name, value, told, stays in (("resolution", 1e-4, "2 million vertices", True), ("lump", float("nan"), "finite number", False)):
            kept = getattr(settings, name)
            setattr(settings, name, value)
            self.assertIn(told, self.cover_sentence(cover))
            self.assertEqual(len(layer(cover)[0]) > 0, stays)
            setattr(settings, name, kept)
        emitter.motus.snow.rate, emitter.motus.snow.lifetime = 5e6, 0.01
        self.assertIn("More than 10 million", self.cover_sentence(cover))
        emitter.motus.snow.rate = float("nan")
        self.assertIn("finite number", self.cover_sentence(cover))
        emitter.motus.snow.rate, emitter.motus.snow.lifetime = 300.0, 4.0
        self.assertEqual(self.cover_sentence(cover), "")
        meadow.data.clear_geometry()
        self.assertIn("has faces", self.cover_sentence(cover))
        bpy.data.objects.remove(emitter)
        self.assertIn("Add an emitter", self.cover_sentence(cover))
        bpy.data.objects.remove(meadow)
        self.assertIn("Add a mesh", self.cover_sentence(cover))

    def test_deleted_objects_do_not_count(self):
        self.square()
        emitter = self.add(**FALLING)
        cover = self.cover()
        go_to(100)
        self.assertGreater(len(layer(cover)[0]), 0)
        bpy.context.scene.collection.objects.unlink(emitter)
        bpy.context.view_layer.update()
        self.assertIn("Add an emitter", self.cover_sentence(cover))
        self.assertEqual(len(layer(cover)[0]), 0)

    def test_flakes_land_on_all_surfaces(self):
        self.square()
        shelf = self.mesh("Shelf", [(-2, -2, 1), (0, -2, 1), (0, 2, 1), (-2, 2, 1)], [(0, 1, 2, 3)])
        ledge = self.mesh("Ledge", [(1, -2, 0.5), (2, -2, 0.5), (2, 2, 0.5), (1, 2, 0.5)], [(0, 1, 2, 3)])
        scenery = bpy.data.collections.new("Scenery")
        scenery.objects.link(ledge)
        bpy.context.scene.collection.objects.unlink(ledge)
        bpy.context.scene.collection.children.link(scenery)
        emitter = self.add(**(FALLING | {"lifetime": 100.0, "start_speed": 2.0}))
        self.cover("Meadow,Shelf", collection="Scenery")
        go_to(100)
        places = flakes(emitter)["position"]
        # Those that were born more than 1.5 s ago have landed, each on what is below it.
        landed = places[flakes(emitter)["age"] > 1.5]
        below = np.select([landed[:, 0] < 0.0, landed[:, 0] > 1.0], [1.0, 0.5], 0.0)
        self.assertAlmostEqual(len(landed), (99.0 / 24.0 - 1.5) * FALLING["rate"], delta=2.0)
        np.testing.assert_allclose(landed[:, 2], below, atol=1e-4)
        self.assertEqual(bpy.ops.motus.snow_colliders_record(object=emitter.name), {'FINISHED'})
        shelf.location.z = 5.0
        go_to(100)
        np.testing.assert_array_equal(flakes(emitter)["position"], places)

    def test_a_surface_that_moves_is_told(self):
        meadow = self.square()
        self.add(**FALLING)
        cover = self.cover()
        for frame, place in ((1, 0.0), (100, 1.0)):
            meadow.location.x = place
            meadow.keyframe_insert("location", frame=frame)
        go_to(100)
        self.assertIn("A surface moves", self.cover_sentence(cover))
        self.assertGreater(layer(cover)[0][:, 0].min(), -1.5)

    def test_lists(self):
        self.square()
        shelf = self.square("Shelf", (0.0, 0.0, 1.0))
        self.add(**FALLING)
        cover = self.cover()
        add, remove = bpy.ops.motus.snow_cover_entry_add, bpy.ops.motus.snow_cover_entry_remove
        go_to(100)
        self.assertLess(layer(cover)[0][:, 2].max(), 0.9)
        self.assertEqual(add(object=cover.name, what='SURFACES', objects="Shelf"), {'FINISHED'})
        bpy.context.view_layer.update()
        self.assertGreater(layer(cover)[0][:, 2].max(), 0.9)
        self.assertRefused("not in the list", add, object=cover.name, what='SURFACES', objects="Shelf")
        self.assertRefused("no emitter", add, object=cover.name, what='EMITTERS', objects="Shelf")
        self.assertEqual(remove(object=cover.name, what='SURFACES', index=1), {'FINISHED'})
        bpy.context.view_layer.update()
        self.assertLess(layer(cover)[0][:, 2].max(), 0.9)
        self.assertRefused("no such object", remove, object=cover.name, what='SURFACES', index=7)
        self.assertEqual(remove(object=cover.name, what='EMITTERS'), {'FINISHED'})
        self.assertIn("Add an emitter", self.cover_sentence(cover))
        self.assertIsNotNone(shelf.data)

    def test_presets(self):
        self.square()
        self.add(**FALLING)
        cover = self.cover()
        presets = support.addon("snow.cover.presets")
        for preset in presets.BROUGHT:
            self.assertEqual(bpy.ops.motus.snow_cover_preset_use(preset=preset.identifier), {'FINISHED'})
            for name, value in preset.values.items():
                self.assertAlmostEqual(getattr(cover.motus.snow_cover, name), value, places=5)

    def test_the_material(self):
        self.square()
        self.add(**FALLING)
        cover = self.cover()
        go_to(100)

        def shown():
            bpy.context.view_layer.update()
            mesh = cover.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
            return [one.name for one in mesh.materials]

        self.assertEqual(shown(), ["Motus Snow Cover"])
        bpy.data.materials["Motus Snow Cover"].diffuse_color = 1.0, 0.0, 0.0, 1.0
        cover.motus.snow_cover.material = bpy.data.materials.new("Slush")
        self.assertEqual(shown(), ["Slush"])
        cover.motus.snow_cover.material = None
        self.assertEqual(shown(), ["Motus Snow Cover"])
        self.assertEqual(tuple(bpy.data.materials["Motus Snow Cover"].diffuse_color), (1.0, 0.0, 0.0, 1.0))
        self.assertEqual(bpy.ops.motus.snow_cover_remove(object=cover.name), {'FINISHED'})
        self.assertNotIn("Motus Snow Cover", bpy.data.materials)

    def test_long_work_waits_until_it_is_asked_for(self):
        self.square()
        self.add(**FALLING)
        cover = self.cover()
        go_to(100)
        wanted = state(cover)
        work = support.addon("snow.cover.work")
        work._done.clear()
        self.assertRefused("nothing to calculate", bpy.ops.motus.snow_cover_work_out, object=cover.name)
        with mock.patch.object(work, "LONG", 0.0):
            go_to(101)
            self.assertIn("press Calculate Snow", self.cover_sentence(cover))
            self.assertEqual(len(layer(cover)[0]), 0)
            self.assertEqual(bpy.ops.motus.snow_cover_work_out(object=cover.name), {'FINISHED'})
            self.assertEqual(self.cover_sentence(cover), "")
            go_to(100)
            self.assertEqual(state(cover), wanted)
