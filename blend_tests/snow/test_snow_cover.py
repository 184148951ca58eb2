"""Snow that lies: as much of it as has landed, on any frame in any order, sheltered, melting, moved and edited."""

import bpy
import numpy as np

import support
from snow.cover_cases import COARSE, FALLING, LUMP, SQUARE, CoverTestCase, cover_system, forget_work, layer, state, volume
from snow.snow_cases import OFF_THE_FRAMES, native, seconds
from support import go_to


class Cover(CoverTestCase):
    def test_it_grows_with_the_flakes_that_land(self):
        self.square()
        emitter = self.add(**FALLING)
        # As many as fall at a speed of 2 m/s from 3 m, on a square that all of them meet.
        cover = self.cover(thinnest=0.0)
        for frame in (30, 60, 61, 200):
            go_to(frame)
            landed = max(0, int((seconds(frame) - 1.5) * 300.0 + 1e-6))
            self.assertAlmostEqual(self.output(cover, "volume"), landed * LUMP**3, delta=2.0 * LUMP**3)
            self.assertAlmostEqual(volume(layer(cover)), self.output(cover, "volume"), delta=0.02 * (0.1 + landed * LUMP**3))
        self.assertEqual(self.cover_sentence(cover), "")
        self.assertEqual(emitter.motus.snow.collider.name, "Meadow")

    def test_any_frame_cold_is_as_played_to(self):
        self.square()
        emitter = self.add(use_steering=True, steering_per_flake=True, turbulence=0.5, start_frame=-60.0, **FALLING)
        for frame, place in ((1, -1.0), (100, 1.0)):
            emitter.location.x = place
            emitter.keyframe_insert("location", frame=frame)
        cover = self.cover()
        played = {}
        for frame in sorted({*OFF_THE_FRAMES, 400}):
            go_to(frame)
            played[frame] = state(cover)
        self.assertGreater(len(set(played.values())), 5)
        for frame in (*OFF_THE_FRAMES, 400):
            forget_work()
            go_to(frame)
            self.assertEqual(state(cover), played[frame], frame)
        for end in (100, 260):
            bpy.context.scene.frame_end = end
            forget_work()
            go_to(60)
            self.assertEqual(state(cover), played[60], end)

    def test_nothing_lies_under_a_roof(self):
        self.square()
        self.mesh("Roof", [(x, y, 1.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))], [(0, 1, 2, 3)])
        self.add(**FALLING)
        for surfaces in ("Meadow", "Meadow,Roof"):
            with self.subTest(surfaces):
                cover = self.cover(surfaces, resolution=0.2, smoothing=0.0, thinnest=0.0)
                if "Roof" not in surfaces:
                    # What only shelters is the emitter's own collider.
                    bpy.data.objects["Snow"].motus.snow.collider = bpy.data.objects["Roof"]
                    bpy.context.view_layer.update()
                go_to(150)
                positions, depths, _ = layer(cover)
                inside = np.abs(positions[:, :2]).max(axis=1) < 0.75
                self.assertGreater(depths[~inside & (positions[:, 2] < 0.9)].max(), 0.0)
                self.assertEqual(depths[inside & (positions[:, 2] < 0.9)].max(initial=0.0), 0.0)
                self.assertEqual(bool((positions[:, 2] > 0.99).any()), "Roof" in surfaces)
                if "Roof" not in surfaces:
                    # What lies on the roof is not shown, and does not count.
                    self.assertAlmostEqual(self.output(cover, "volume"), volume(layer(cover)), delta=0.02)
                bpy.ops.motus.snow_cover_remove(object=cover.name)

    def test_the_ground_at_the_height_of_a_surface_takes_nothing(self):
        self.square()
        emitter = self.add(**FALLING, use_steering=True, steering_per_flake=True)
        cover = self.cover(thinnest=0.0)
        go_to(150)
        before = self.output(cover, "volume")
        self.assertGreater(before, 0.5)
        emitter.motus.snow.use_ground = True
        bpy.context.view_layer.update()
        self.assertEqual(self.output(cover, "volume"), before)

    def test_what_was_recorded_of_a_surface_does_not_shelter_it(self):
        scenery = bpy.data.collections.new("Scenery")
        bpy.context.scene.collection.children.link(scenery)
        roof = self.mesh("Roof", [(x, y, 1.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))], [(0, 1, 2, 3)])
        for one in (self.square(), roof, self.square("Floor", (0.0, 0.0, -1.0))):
            scenery.objects.link(one)
        emitter = self.add(**FALLING, colliders="Scenery")
        cover = self.cover("Meadow", smoothing=0.0, thinnest=0.0, resolution=0.2)
        go_to(150)
        before = state(cover)
        self.assertGreater(len(before), 1000)
        self.assertEqual(bpy.ops.motus.snow_colliders_record(object=emitter.name), {'FINISHED'})
        bpy.context.view_layer.update()
        self.assertEqual(state(cover), before)
        self.assertEqual(self.cover_sentence(cover), "")
        # The roof shelters as it was recorded, wherever it goes.
        roof.location.x = 10.0
        bpy.context.view_layer.update()
        self.assertEqual(state(cover), before)
        bpy.ops.motus.snow_colliders_clear(object=emitter.name)
        bpy.context.view_layer.update()
        self.assertNotEqual(state(cover), before)

    @support.in_one_blender
    def test_the_faces_of_the_layer_count_for_how_long_it_takes(self):
        meadow = self.square()
        self.add(**FALLING)
        self.cover(resolution=0.2)
        work, placing, ground = (support.addon(name) for name in ("snow.cover.work", "core.scenery.meshes", "snow.cover.ground"))
        for scale in ((1.0, 1.0, 1.0), (5.0, 2.0, 1.0)):
            with self.subTest(scale):
                meadow.scale = scale
                bpy.context.view_layer.update()
                (_, plan), _ = work._done.items()[-1]
                _, triangles, _ = native().refine(*placing.joined(plan.lain_on), plan.resolution)
                found = work.price(plan._replace(falls=())) / work.TRIANGLE
                self.assertTrue(0.7 < found / len(triangles) < 1.5, (found, len(triangles)))
        # More than there can be takes no longer.
        self.assertAlmostEqual(work.price(plan._replace(falls=(), resolution=1e-6)) / work.TRIANGLE, 4 * ground.MOST, delta=10)

    def test_the_layer_is_fine_and_the_surface_stays(self):
        meadow = self.square()
        meadow.data.materials.append(bpy.data.materials.new("Grass"))
        meadow.modifiers.new("Thick", 'SOLIDIFY')
        self.add(**FALLING)
        cover = self.cover(resolution=0.2)
        go_to(100)
        positions, _, triangles = layer(cover)
        flat = positions[:, :2]
        self.assertGreater(len(positions), 500)
        for a, b in ((0, 1), (1, 2), (2, 0)):
            self.assertLess(np.linalg.norm(flat[triangles[:, a]] - flat[triangles[:, b]], axis=1).max(), 0.35)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        self.assertEqual(len(meadow.evaluated_get(depsgraph).data.vertices), 8)
        self.assertEqual([one.name for one in meadow.evaluated_get(depsgraph).data.materials], ["Grass"])
        self.assertEqual([one.name for one in cover.evaluated_get(depsgraph).data.materials], ["Motus Snow Cover"])

    def test_thin_snow_is_hidden(self):
        self.square()
        self.add(**FALLING)
        cover = self.cover(thinnest=0.01, smoothing=0.0, resolution=0.2)
        go_to(42)
        positions, depths, _ = layer(cover)
        shown = positions[depths > 0.01]
        self.assertTrue(0 < len(shown) < len(positions))
        self.assertTrue((shown[:, 2] > 0.0).all())
        self.assertTrue((positions[depths < 0.009, 2] <= 0.0).all())

    def test_keyed_influence_melts_it(self):
        self.square()
        self.add(**FALLING)
        cover = self.cover(thinnest=0.0)
        for frame, influence in ((100, 1.0), (200, 0.0)):
            cover.motus.snow_cover.influence = influence
            cover.keyframe_insert("motus.snow_cover.influence", frame=frame)
        heights = {}
        for frame in (100, 150, 200, 150):
            go_to(frame)
            heights[frame] = layer(cover)[1].max(initial=0.0)
        self.assertGreater(heights[100], 0.0)
        self.assertTrue(0.0 < heights[150] < 2.0 * heights[100])
        self.assertEqual(heights[200], 0.0)

    def test_where_all_has_melted_no_snow_is_told(self):
        self.square()
        self.add(**FALLING)
        cover = self.cover()
        settings = cover.motus.snow_cover
        for frame, influence in ((80, 1.0), (100, 0.0)):
            settings.influence = influence
            settings.keyframe_insert("influence", frame=frame)
        go_to(90)
        self.assertGreater(self.output(cover, "volume"), 0.0)
        go_to(100)
        self.assertEqual((self.output(cover, "volume"), self.output(cover, "deepest")), (0.0, 0.0))

    def test_an_emitter_without_a_mesh_leaves_the_snow_of_others(self):
        self.square()
        bare = self.square("Bare", (0.0, 0.0, 3.0))
        emitters = self.add(**FALLING), self.add(**(FALLING | {"shape": 'SURFACE', "surface": "Bare"}))
        cover = self.cover(emitters=",".join(emitter.name for emitter in emitters))
        bare.data.clear_geometry()
        go_to(100)
        self.assertIn("left out", self.cover_sentence(cover))
        self.assertGreater(len(layer(cover)[0]), 0)

    def test_a_cover_is_no_collider_of_what_falls_on_it(self):
        meadow = self.square()
        scenery = bpy.data.collections.new("Scenery")
        bpy.context.scene.collection.children.link(scenery)
        bpy.context.scene.collection.objects.unlink(meadow)
        scenery.objects.link(meadow)
        emitter = self.add(**FALLING, colliders="Scenery")
        cover = self.cover()
        for collection in list(cover.users_collection):
            collection.objects.unlink(cover)
        scenery.objects.link(cover)
        bpy.context.view_layer.update()
        bpy.ops.motus.refresh(object=cover.name, system="snow_cover")
        go_to(100)
        colliders, sources = support.addon("snow.colliders"), support.addon("snow.cover.sources")
        self.assertEqual(colliders.objects(emitter.motus.snow), [meadow])
        emitter.motus.snow.collider = cover
        self.assertEqual(sources.scenery(cover.motus.snow_cover), [meadow])

    def test_edits_reach_it(self):
        meadow = self.square()
        emitter = self.add(**FALLING)
        cover = self.cover()
        go_to(100)
        before = state(cover)

        def changes(edit):
            nonlocal before
            edit()
            bpy.context.view_layer.update()
            after = state(cover)
            self.assertNotEqual(after, before)
            before = after

        changes(lambda: setattr(emitter.motus.snow, "rate", 400.0))
        changes(lambda: setattr(emitter.motus.snow, "seed", 9))
        changes(lambda: setattr(emitter, "location", (0.3, 0.0, 3.0)))
        changes(lambda: setattr(meadow, "location", (0.0, 0.0, 0.5)))
        changes(lambda: setattr(meadow.data.vertices[0], "co", (-2.0, -2.0, 0.4)) or meadow.data.update())
        changes(lambda: setattr(cover.motus.snow_cover, "lump", 0.12))
        changes(lambda: setattr(cover.motus.snow_cover, "resolution", 0.4))
        emitter.motus.snow.flake_width = 0.5  # what flakes look like changes nothing
        bpy.context.view_layer.update()
        self.assertEqual(state(cover), before)

    def test_another_file_begins_with_nothing(self):
        self.square()
        self.add(**FALLING)
        self.cover()
        go_to(100)
        work = support.addon("snow.cover.work")
        (_, plan), _ = work._done.items()[0]
        for leave in (support.empty_scene, lambda: self.addCleanup(support.enable) or support.disable()):
            work.do("Snow Cover", plan)
            work.ask("Snow Cover", plan)
            leave()
            self.assertIsNone(work.asked("Snow Cover"))
            self.assertEqual(len(work._done), 0)
            for kept in (support.addon("snow.cover.ground")._grounds, support.addon("snow.flakes")._snows):
                self.assertEqual(len(kept), 0)

    def test_it_stays_in_the_world(self):
        self.square()
        self.add(**FALLING)
        cover = self.cover()
        go_to(100)
        before = layer(cover)[0]
        cover.location = 1.0, 2.0, 3.0
        bpy.context.view_layer.update()
        np.testing.assert_allclose(layer(cover)[0] + (1.0, 2.0, 3.0), before, atol=1e-5)

    def test_several_emitters_and_a_collection(self):
        collection = bpy.data.collections.new("Yard")
        bpy.context.scene.collection.children.link(collection)
        collection.objects.link(self.square())
        for place in (-1.0, 1.0):
            self.add(**(FALLING | {"location": (place, 0.0, 3.0), "emitter_radius": 0.9}))
        cover = self.cover("", collection="Yard", emitters="Snow,Snow.001", thinnest=0.0)
        self.assertEqual(len(cover.motus.snow_cover.emitters), 2)
        go_to(100)
        self.assertAlmostEqual(self.output(cover, "volume"), 2 * 300.0 * (seconds(100) - 1.5) * LUMP**3, delta=0.005)
        # What comes into the collection is covered, and what leaves it is not any more.
        shelf = self.mesh("Shelf", SQUARE, [(0, 1, 2, 3)], (0.0, 0.0, 1.0))
        collection.objects.link(shelf)
        go_to(101)
        self.assertGreater(layer(cover)[0][:, 2].min(), 0.9)
        collection.objects.unlink(shelf)
        go_to(100)
        self.assertLess(layer(cover)[0][:, 2].max(), 0.9)

    def test_instances_of_a_collection(self):
        seen, yard = (bpy.data.collections.new(name) for name in ("Seen", "Yard"))
        bpy.context.scene.collection.children.link(yard)
        shelf = self.square("Shelf")
        bpy.context.scene.collection.objects.unlink(shelf)
        seen.objects.link(shelf)
        empty = bpy.data.objects.new("Empty", None)
        empty.instance_type, empty.instance_collection, empty.location = 'COLLECTION', seen, (0.0, 0.0, 1.0)
        yard.objects.link(empty)
        self.add(**FALLING)
        cover = self.cover("", collection="Yard")
        go_to(100)
        self.assertEqual(self.cover_sentence(cover), "")
        self.assertGreater(len(layer(cover)[0]), 50)
        self.assertGreater(layer(cover)[0][:, 2].min(), 0.9)
        self.assertEqual(bpy.data.objects["Snow"].motus.snow.colliders, yard)

    def test_steep_slopes_shed_it(self):
        self.mesh("Roof", [(-2, -2, 0), (2, -2, 0), (2, 2, 8), (-2, 2, 8)], [(0, 1, 2, 3)], (0.0, 0.0, -4.0))
        self.add(**(FALLING | {"location": (0.0, 0.0, 6.0)}))
        cover = self.cover("Roof")
        go_to(100)
        self.assertEqual(len(layer(cover)[0]), 0)
        cover.motus.snow_cover.repose = 1.3
        bpy.context.view_layer.update()
        self.assertGreater(len(layer(cover)[0]), 0)

    @support.in_one_blender
    def test_the_snow_is_the_library_s(self):
        self.square()
        self.add(**FALLING)
        cover = self.cover(thinnest=0.0, smoothing=0.4)
        rounds = support.addon("snow.cover.work").rounds(0.4, COARSE["resolution"])
        self.assertEqual(rounds, 5)
        module = native()
        positions, triangles, _ = module.refine(SQUARE, [(0, 1, 2), (0, 2, 3)], COARSE["resolution"])
        matrix = np.diag((1.0, -1.0, -1.0, 1.0))[None]
        matrix[0, 2, 3] = 3.0
        snow = module.Snow(
            rate=300.0,
            start_speed=2.0,
            lifetime=4.0,
            cone_radius=1.9,
            seed=3,
            emitter_times=[0.0],
            emitter_matrices=matrix,
            collider=module.SnowCollider(positions, triangles),
        )
        lying = module.SnowCover(snow, end=seconds(250), flake_volume=LUMP**3, repose=cover.motus.snow_cover.repose, smoothing=rounds)
        go_to(90)
        np.testing.assert_allclose(self.output(cover, "volume"), lying.volume(seconds(90)), rtol=1e-6)
        np.testing.assert_allclose(layer(cover)[1].max(), lying.heights(seconds(90)).max(), rtol=1e-5)
        self.assertEqual(cover_system().unbakeable[:10], "Lying snow")
