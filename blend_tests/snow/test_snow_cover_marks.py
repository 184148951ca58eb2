"""Marks in lying snow: as deep as what has pressed there was above the ground, filled by snow that falls later, on any frame."""

from unittest import mock

import bpy
import numpy as np

import support
from snow.cover_cases import FALLING, CoverTestCase, forget_work, layer, state
from support import go_to, key_places
from walker import walker_cases

FRAMES = (100, 1, 70, 62.25, 130, 55.5, 200, 100)
DENSE = {**FALLING, "rate": 400.0, "start_frame": -100.0}
FINE = {"lump": 0.085, "resolution": 0.12, "thinnest": 0.0, "packed": 0.0}
CORNERS = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


class Marks(CoverTestCase):
    def setUp(self):
        super().setUp()
        self.square()
        self.emitter = self.add(**DENSE)

    def crate(self, half=(0.4, 0.4, 0.2), name="Crate", **keywords):
        """A box of these half sides around its origin."""
        return self.mesh(name, [tuple(a * b for a, b in zip(half, corner)) for corner in CORNERS], SIDES, **keywords)

    def dropped(self):
        """A crate whose lower side is 5 cm above the ground from frame 60 to 120."""
        crate = self.crate()
        key_places(crate, {50: (0.0, 0.0, 3.0), 60: (0.0, 0.0, 0.25), 120: (0.0, 0.0, 0.25), 121: (0.0, 0.0, 3.0)})
        return crate

    def depths(self, cover, near=0.2, at=(0.0, 0.0)):
        """Depths of the layer above the square around a place."""
        positions, depths, _ = layer(cover)
        return depths[np.abs(positions[:, :2] - at).max(axis=1) < near]

    def test_a_mark_is_as_deep_as_what_pressed_and_fills_with_later_snow(self):
        self.dropped()
        plain, marked = self.cover(**FINE), self.cover(movers="Crate", **FINE)
        self.assertEqual([entry.object.name for entry in marked.motus.snow_cover.movers], ["Crate"])
        fallen = {}
        for frame in (50, 100, 120, 160, 240):
            go_to(frame)
            whole, found = self.depths(plain), self.depths(marked)
            fallen[frame] = whole
            self.assertEqual(len(found), len(whole))
            if frame == 50:
                np.testing.assert_array_equal(found, whole)
            elif frame <= 120:
                self.assertGreater(whole.min(), 0.06)
                np.testing.assert_allclose(found, 0.05, atol=1e-4)
            else:
                np.testing.assert_allclose(found, whole - fallen[120] + 0.05, atol=1e-4)
            far = np.abs(layer(marked)[0][:, :2]).max(axis=1) > 0.6
            np.testing.assert_array_equal(layer(marked)[0][far], layer(plain)[0][far])
            self.assertEqual(self.cover_sentence(marked), "")
            self.assertEqual(self.output(marked, "volume") < self.output(plain, "volume") - 0.01, frame > 50)

    def test_any_frame_cold_is_as_played_to(self):
        self.dropped()
        cover, played = self.cover(movers="Crate", **FINE), {}
        for frame in sorted(set(FRAMES)):
            go_to(frame)
            played[frame] = state(cover)
        self.assertEqual(len(set(played.values())), len(played))
        for frame in FRAMES:
            forget_work()
            go_to(frame)
            self.assertEqual(state(cover), played[frame], frame)

    def test_packed_snow_stays_and_keys_act_at_once(self):
        crate, work = self.dropped(), support.addon("snow.cover.work")
        cover = self.cover(movers="Crate", **(FINE | {"packed": 0.08}))
        go_to(120)
        np.testing.assert_allclose(self.depths(cover), 0.08, atol=1e-4)
        with mock.patch.object(work, "_covered", wraps=work._covered) as covered:
            cover.motus.snow_cover.packed = 0.0
            go_to(120)
            np.testing.assert_allclose(self.depths(cover), 0.05, atol=1e-4)
            # Of a different motion the flakes land at the same places.
            key_places(crate, {60: (1.0, 0.0, 0.22), 120: (1.0, 0.0, 0.22)})
            go_to(120)
            np.testing.assert_allclose(self.depths(cover, at=(1.0, 0.0)), 0.02, atol=1e-4)
            self.assertGreater(self.depths(cover).max(), 0.09)
        covered.assert_not_called()
        # Of half of the snow the mark is as far above the ground.
        cover.motus.snow_cover.influence = 0.5
        bpy.context.view_layer.update()
        np.testing.assert_allclose(self.depths(cover, at=(1.0, 0.0)), 0.02, atol=1e-4)

    def test_a_plough_sweeps_a_road(self):
        plough = self.crate((0.1, 0.5, 0.3), "Plough")
        key_places(plough, {60: (-2.5, 0.0, 0.3), 120: (2.5, 0.0, 0.3)})
        cover = self.cover(movers="Plough", **(FINE | {"thinnest": 0.004}))
        go_to(123)
        positions, _, _ = layer(cover)
        # The ground is bare there, but for the snow of the last frames at its end.
        inside = (np.abs(positions[:, 1]) < 0.35) & (np.abs(positions[:, 0]) < 1.0)
        self.assertLess(positions[inside, 2].max(initial=0.0), 0.045)
        self.assertGreater(positions[np.abs(positions[:, 1]) > 0.8, 2].max(), 0.08)

    def test_feet_of_a_walker_leave_a_print_for_each_step(self):
        body, _, feet = walker_cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=walker_cases.names(feet), stride=0.6, use_plane=True)
        key_places(body, {40: (0.0, -1.2, 0.0), 140: (0.0, 1.2, 0.0)})
        for index, foot in enumerate(feet):
            sole = self.crate((0.12, 0.12, 0.1), f"Sole {index}", place=(0.0, 0.0, 0.13))
            sole.parent = foot
        go_to(1)
        cover = self.cover(movers=",".join(f"Sole {index}" for index in range(len(feet))), **FINE)
        go_to(150)
        self.assertEqual(self.cover_sentence(cover), "")
        steps, pressed = walker_cases.plan_of(body).walker.steps, 0
        for place, touch in zip(steps["end"], steps["touch"]):
            if np.abs(place[:2]).max() < 1.6 and walker_cases.seconds(60) < touch < walker_cases.seconds(145):
                pressed += 1
                self.assertLess(self.depths(cover, 0.08, place[:2]).min(), 0.1)
        self.assertGreater(pressed, 6)
        self.assertGreater(np.median(layer(cover)[1]), 0.11)

    def test_motion_that_is_not_known_leaves_no_marks_until_it_is_recorded(self):
        crate = self.dropped()
        hook = crate.modifiers.new("Wave", 'WAVE')
        cover = self.cover(movers="Crate", **FINE)
        go_to(120)
        self.assertIn("leaves no marks", self.cover_sentence(cover))
        self.assertGreater(self.depths(cover).min(), 0.06)
        crate.modifiers.remove(hook)
        go_to(120)
        self.assertEqual(self.cover_sentence(cover), "")
        self.assertLess(self.depths(cover).max(), 0.06)
        leader = bpy.data.objects.new("Leader", None)
        bpy.context.scene.collection.objects.link(leader)
        crate.constraints.new('COPY_ROTATION').target = leader
        go_to(120)
        self.assertIn("leaves no marks", self.cover_sentence(cover))
        self.assertGreater(self.depths(cover).min(), 0.06)
        self.assertEqual(bpy.ops.motus.track_record(datablock="Crate", frame_start=1, frame_end=130), {'FINISHED'})
        go_to(120)
        self.assertEqual(self.cover_sentence(cover), "")
        self.assertLess(self.depths(cover).max(), 0.06)

    def test_what_stands_in_snow_and_what_cannot_leave_marks(self):
        stone = self.crate(name="Stone", place=(0.0, 0.0, 0.22))
        cover = self.cover(movers="Stone", **FINE)
        stone.hide_viewport = stone.hide_render = True
        go_to(90)
        np.testing.assert_allclose(self.depths(cover), 0.02, atol=1e-4)
        stone.location.z = -5.0
        go_to(90)
        self.assertGreater(self.depths(cover).min(), 0.05)
        self.assertRefused(
            "cannot leave marks", bpy.ops.motus.snow_cover_entry_add, object=cover.name, what='MOVERS', objects=self.emitter.name
        )
        self.assertRefused("cannot leave marks", bpy.ops.motus.snow_cover_add, surfaces="Meadow", movers=self.emitter.name)
        # A surface does not press the snow that lies on it.
        self.assertEqual(bpy.ops.motus.snow_cover_entry_add(object=cover.name, what='MOVERS', objects="Meadow"), {'FINISHED'})
        go_to(90)
        self.assertGreater(self.depths(cover).min(), 0.05)

    def test_the_list_is_changed_in_one_step(self):
        self.dropped()
        cover = self.cover(**FINE)
        go_to(110)
        before = state(cover)
        self.assertEqual(bpy.ops.motus.snow_cover_entry_add(object=cover.name, what='MOVERS', objects="Crate"), {'FINISHED'})
        bpy.context.view_layer.update()
        self.assertNotEqual(state(cover), before)
        self.assertEqual(bpy.ops.motus.snow_cover_entry_remove(object=cover.name, what='MOVERS'), {'FINISHED'})
        bpy.context.view_layer.update()
        self.assertEqual(state(cover), before)

    def test_long_work_waits(self):
        work = support.addon("snow.cover.work")
        self.dropped()
        cover = self.cover(**FINE)
        go_to(110)
        before = state(cover)
        with mock.patch.object(work, "LONG", 1e3):
            bpy.ops.motus.snow_cover_entry_add(object=cover.name, what='MOVERS', objects="Crate")
            bpy.context.view_layer.update()
            self.assertIn("press Calculate Snow", self.cover_sentence(cover))
            self.assertEqual(state(cover), before)
            self.assertEqual(bpy.ops.motus.snow_cover_work_out(object=cover.name), {'FINISHED'})
            bpy.context.view_layer.update()
            self.assertEqual(self.cover_sentence(cover), "")
            self.assertNotEqual(state(cover), before)
