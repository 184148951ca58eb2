"""Lying snow whose depth a vertex group or attribute says, a coarser layer in the viewport, and covers by the snow's own time and rate."""

import bpy
import numpy as np

import support
from snow.cover_cases import FALLING, LUMP, CoverTestCase, forget_work, layer, state
from snow.snow_cases import seconds
from support import go_to


class Painted(CoverTestCase):
    def painted(self, shares):
        """A meadow whose four corners have weights, and its snow."""
        meadow = self.square()
        group = meadow.vertex_groups.new(name="Depth")
        for place, share in enumerate(shares):
            group.add([place], share, 'REPLACE')
        self.add(**FALLING)
        return meadow, self.cover(thinnest=0.0, resolution=0.3)

    def test_the_depth_is_times_the_weight(self):
        meadow, cover = self.painted((0.0, 0.5, 0.5, 0.0))
        go_to(150)
        whole, volume = layer(cover), self.output(cover, "volume")
        cover.motus.snow_cover.depth_group = "Depth"
        bpy.context.view_layer.update()
        self.assertEqual(self.cover_sentence(cover), "")
        half, volume_of_half = layer(cover), self.output(cover, "volume")
        # From 0 at x = -2 to 0.5 at x = 2, straight: a fourth of the snow, which is even.
        self.assertAlmostEqual(volume_of_half / volume, 0.25, delta=0.03)
        for x, share in ((1.0, 0.375), (0.0, 0.25), (-1.0, 0.125)):
            thin, thick = (one[1][(np.abs(one[0][:, 0] - x) < 0.3) & (np.abs(one[0][:, 1]) < 1.5)].mean() for one in (half, whole))
            self.assertAlmostEqual(thin / thick, share, delta=0.04)
        # Even weights are the influence, wherever edges were halved.
        meadow.vertex_groups["Depth"].add([0, 1, 2, 3], 0.5, 'REPLACE')
        meadow.data.update()
        bpy.context.view_layer.update()
        self.assertAlmostEqual(self.output(cover, "volume") / volume, 0.5, places=5)
        even = state(cover)
        cover.motus.snow_cover.depth_group, cover.motus.snow_cover.influence = "", 0.5
        bpy.context.view_layer.update()
        self.assertEqual(state(cover), even)

    def test_an_attribute_counts_as_well(self):
        meadow, cover = self.painted((1.0, 1.0, 1.0, 1.0))
        meadow.data.attributes.new("Bare", 'FLOAT', 'POINT').data.foreach_set("value", (0.25, 0.25, 0.25, 0.25))
        go_to(150)
        volume = self.output(cover, "volume")
        cover.motus.snow_cover.depth_group = "Bare"
        bpy.context.view_layer.update()
        self.assertAlmostEqual(self.output(cover, "volume") / volume, 0.25, places=5)

    def test_a_group_that_no_surface_has(self):
        _, cover = self.painted((0.0, 0.0, 0.0, 0.0))
        go_to(100)
        before = state(cover)
        cover.motus.snow_cover.depth_group = "None"
        bpy.context.view_layer.update()
        self.assertIn("No surface has the vertex group", self.cover_sentence(cover))
        self.assertEqual(state(cover), before)

    def test_one_surface_of_two(self):
        other = self.square("Other", (0.0, 0.0, 0.5))
        _, cover = self.painted((0.0, 0.0, 0.0, 0.0))
        other.location.x = 2.0
        cover.motus.snow_cover.surfaces.add().object = other
        cover.motus.snow_cover.depth_group = "Depth"
        bpy.ops.motus.refresh(object=cover.name)
        go_to(150)
        self.assertGreater(len(layer(cover)[0]), 50)
        self.assertGreater(layer(cover)[0][:, 2].min(), 0.4)


class InTheViewport(CoverTestCase):
    def test_a_coarser_layer_there_alone(self):
        self.square()
        self.add(**FALLING)
        cover = self.cover(resolution=0.2)
        go_to(100)
        fine = state(cover)
        cover.motus.snow_cover.viewport_resolution = 1.0
        bpy.context.view_layer.update()
        self.assertLess(len(layer(cover)[0]), 100)
        cover.motus.snow_cover.viewport_resolution = 0.1  # finer than that of renders: theirs counts
        bpy.context.view_layer.update()
        self.assertEqual(state(cover), fine)
        cover.motus.snow_cover.viewport_resolution = 1.0
        forget_work()
        shares = support.addon("core.evaluated.shares")
        shares.wait_for_all()
        try:
            go_to(100)
            self.assertEqual(state(cover), fine)
        finally:
            shares._waits[0] = False


class OwnTime(CoverTestCase):
    def test_slow_motion_and_a_keyed_rate(self):
        self.square()
        emitter = self.add(**FALLING)
        cover = self.cover(thinnest=0.0)
        go_to(70)
        before = state(cover)
        emitter.motus.snow.time_speed = 0.5
        go_to(139)
        self.assertEqual(state(cover), before)
        emitter.motus.snow.time_speed = 1.0
        settings = emitter.motus.snow
        for frame, rate in ((1, 0.0), (97, 400.0)):
            settings.rate = rate
            emitter.keyframe_insert("motus.snow.rate", frame=frame)
        for each in support.addon("core.blender.actions").all_fcurves(emitter.animation_data.action):
            for point in each[0].keyframe_points:
                point.interpolation = 'LINEAR'
        emitter.update_tag()
        for frame in (90, 60):
            go_to(frame)
            # 50 t^2 flakes until t, of which each falls for 1.5 s.
            landed = int(50.0 * max(0.0, seconds(frame) - 1.5) ** 2)
            self.assertAlmostEqual(self.output(cover, "volume"), landed * LUMP**3, delta=2.5 * LUMP**3)
        self.assertEqual(self.cover_sentence(cover), "")

    def test_the_settings_come_from_keywords(self):
        self.square()
        self.add(**FALLING)
        settings = self.cover(depth_group="Depth", viewport_resolution=0.75).motus.snow_cover
        self.assertEqual((settings.depth_group, settings.viewport_resolution), ("Depth", 0.75))
