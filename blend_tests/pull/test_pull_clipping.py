"""Clipping of Mirror modifiers: what is on a mirror plane stays on it, and nothing crosses it, as in Blender's own tools."""

import math

import bpy
import numpy as np

import support
from pull.pull_cases import PullTestCase

SEAM = 10  # column of the plane's 21 that lies on X = 0


class Clipping(PullTestCase):
    def mirrored(self, **settings):
        """A plane with a Mirror modifier that clips."""
        obj = self.plane()
        modifier = obj.modifiers.new("Mirror", 'MIRROR')
        modifier.use_clip = True
        for name, value in settings.items():
            setattr(modifier, name, value)
        bpy.context.view_layer.update()
        return obj

    def rows(self, obj):
        return self.places(obj).reshape(21, 21, 3)

    def assertClipped(self, obj, before, along=0):
        after = self.rows(obj)
        seam = np.abs(before[..., along]) <= 1e-3
        self.assertNear(after[seam][:, along], np.zeros(seam.sum()), 1e-7)
        self.assertGreaterEqual((after[..., along] * before[..., along]).min(), -1e-7)
        return after

    def test_seam_stays_and_nothing_crosses(self):
        for accumulate in (False, True):
            for displacement in ((0.5, 0.0, 0.2), (-0.9, 0.3, 0.2)):
                obj = self.mirrored()
                before = self.rows(obj)
                for vertex in (10 * 21 + SEAM, 10 * 21 + 13):
                    self.pull(vertex=vertex, displacement=displacement, radius=1.0, accumulate=accumulate)
                with self.subTest(accumulate=accumulate, displacement=displacement):
                    after = self.assertClipped(obj, before)
                    # Across the plane alone: along it the seam goes with the rest.
                    self.assertGreater(after[10, SEAM, 2], 0.1)

    def test_as_blender_moves_all(self):
        """Pulled by one force everywhere, the plane is what Blender's own Move makes of it in Edit Mode."""
        for displacement in ((0.25, 0.0, 0.1), (-0.55, 0.1, 0.0)):
            obj = self.mirrored(merge_threshold=0.12)
            self.pull(vertex=200, displacement=displacement, radius=100.0, falloff='CONSTANT')
            found = self.places(obj)
            obj = self.mirrored(merge_threshold=0.12)
            bpy.ops.object.mode_set(mode='EDIT')
            bpy.ops.mesh.select_all(action='SELECT')
            bpy.ops.transform.translate(value=displacement)
            bpy.ops.object.mode_set(mode='OBJECT')
            with self.subTest(displacement=displacement):
                self.assertNear(found, self.places(obj), 1e-6)

    def test_what_is_not_held_goes_as_without(self):
        obj = self.mirrored()
        before = self.rows(obj)
        self.pull(vertex=10 * 21 + 15, displacement=(0.1, 0.05, 0.2), radius=0.45)
        found = self.rows(obj)
        obj = self.plane()
        self.pull(vertex=10 * 21 + 15, displacement=(0.1, 0.05, 0.2), radius=0.45)
        self.assertNear(found, self.rows(obj), 1e-6)
        self.assertGreater(np.abs(found - before).max(), 0.1)

    def test_switched_off(self):
        for settings in ({"use_clip": False}, {"show_viewport": False}, {"use_axis": (False, False, True)}):
            obj = self.mirrored(**settings)
            self.pull(vertex=10 * 21 + SEAM, displacement=(0.3, 0.0, 0.0), radius=0.5)
            with self.subTest(**settings):
                self.assertNear(self.rows(obj)[10, SEAM, 0], 0.3, 1e-6)

    def test_other_axes_and_a_mirror_object(self):
        obj = self.mirrored(use_axis=(True, True, False))
        before = self.rows(obj)
        self.pull(vertex=10 * 21 + SEAM, displacement=(0.4, -0.4, 0.1), radius=1.0)
        for along in (0, 1):
            self.assertClipped(obj, before, along)
        for scale in (1.0, -2.0):
            other = bpy.data.objects.new("Plane", None)
            self.scene.collection.objects.link(other)
            other.location, other.scale, other.rotation_euler = (0.3, 0.0, 0.0), (scale, 1.0, 1.0), (0.0, 0.0, math.radians(90.0))
            bpy.context.view_layer.update()
            obj = self.mirrored(mirror_object=other)  # whose X is the world's Y
            before = self.rows(obj)
            self.pull(vertex=10 * 21 + SEAM, displacement=(0.4, -0.4, 0.1), radius=1.0)
            after = self.assertClipped(obj, before, 1)
            self.assertNear(after[10, SEAM], (0.4, 0.0, 0.1), 1e-5)

    def test_edit_mode_and_smoothing(self):
        obj = self.mirrored()
        before = self.rows(obj)
        bpy.ops.object.mode_set(mode='EDIT')
        self.pull(vertex=10 * 21 + SEAM, displacement=(0.5, 0.0, 0.2), radius=1.0)
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertClipped(obj, before)
        brush = support.addon("pull.brush").Brush()
        session = support.addon("pull.session.dab").Session(bpy.context, obj, brush)
        session.begin_stroke()
        session.smooth(10 * 21 + SEAM + 2, 1.0)
        session.finish()
        self.assertClipped(obj, before)
