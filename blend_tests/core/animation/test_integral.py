"""The integral of an F-curve: right from any frame to any other, and of many keys only what has not been summed up before is asked."""

import contextlib
from unittest import mock

import bpy
import numpy as np

import support
from core.tracks.track_cases import TrackTestCase

FRAMES = (-7.5, 1.0, 1.3, 2.0, 11.9, 12.25, 29.0, 44.75, 60.25, 61.0, 90.5)


class Integral(TrackTestCase):
    def setUp(self):
        super().setUp()
        self.keys = support.addon("core.animation.keys")
        self.thing = self.link("Thing")
        self.key(self.thing, "location", index=0, frames=(1, 12, 13, 30, 60))

    def curve(self):
        """The F-curve of the evaluated action."""
        bpy.context.view_layer.update()
        return support.addon("core.blender.actions").find(self.evaluated(self.thing), "location", 0)

    def summed(self, curve, first, last):
        """By many small pieces."""
        edges = np.unique(np.concatenate([np.linspace(first, last, 2000), np.arange(np.ceil(first), last), [first, last]]))
        edges = np.unique(np.concatenate([edges, [point.co[0] for point in curve.keyframe_points if first < point.co[0] < last]]))
        middles = 0.5 * (edges[:-1] + edges[1:])
        return float((np.diff(edges) * [curve.evaluate(at) for at in middles]).sum())

    def assert_right(self, first, tolerance):
        curve = self.curve()
        for last in FRAMES:
            if last > first:
                np.testing.assert_allclose(
                    self.keys.integral(curve, first, last), self.summed(curve, first, last), atol=tolerance, err_msg=f"{first} to {last}"
                )

    def test_from_any_frame_to_any_other(self):
        for first in (-20.0, 1.0, 5.5, 60.25, 75.0):
            self.assert_right(first, 2e-3)

    @contextlib.contextmanager
    def modified(self, kind):
        """The F-curve has a modifier until the block ends."""
        curve = support.addon("core.blender.actions").find(self.thing, "location", 0)
        modifier = curve.modifiers.new(kind)
        curve.update()
        self.thing.update_tag()
        yield
        curve.modifiers.remove(modifier)
        self.thing.update_tag()

    def test_with_modifiers(self):
        for kind in ('CYCLES', 'NOISE'):
            with self.subTest(kind), self.modified(kind):
                for first in (-9.25, -3.0, 1.0, 11.95):
                    self.assert_right(first, 2e-2)

    def test_what_is_summed_up_serves_every_first_frame(self):
        for kind, most in ((None, 1), ('NOISE', 4)):
            with self.subTest(kind), contextlib.ExitStack() as stack:
                if kind:
                    stack.enter_context(self.modified(kind))
                curve = self.curve()
                sums = stack.enter_context(mock.patch.object(self.keys, "_Sums", wraps=self.keys._Sums))
                for first in np.linspace(-6.5, 50.0, 80).tolist():
                    self.keys.integral(curve, first, 55.5)
                self.assertGreater(sums.call_count, 0)
                self.assertLessEqual(sums.call_count, most)

    def test_the_same_bits_in_any_order(self):
        curve = self.curve()
        forward = [self.keys.integral(curve, 1.0, last) for last in FRAMES[2:]]
        support.addon("core.evaluated.copies").forget()
        backward = [self.keys.integral(curve, 1.0, last) for last in reversed(FRAMES[2:])]
        self.assertEqual(forward, backward[::-1])

    def test_what_is_asked_on_each_frame(self):
        for frame in range(1, 4000, 5):
            self.thing.location.x = frame % 7
            self.thing.keyframe_insert("location", index=0, frame=frame)
        curve = self.curve()
        self.keys.integral(curve, 1.0, 3000.5)
        with mock.patch.object(self.keys, "values", wraps=self.keys.values) as asked:
            for frame in (3001.25, 17.5, 3900.0):
                self.keys.integral(curve, 1.0, frame)
        self.assertLessEqual(max(len(call.args[1]) for call in asked.call_args_list), 3)
        with mock.patch.object(self.keys, "_find_places") as found:
            self.keys.integral(curve, 2.0, 900.0)
        self.assertEqual(found.call_count, 0)

    def test_an_edit_of_a_key_counts(self):
        before = self.keys.integral(self.curve(), 1.0, 50.0)
        curve = support.addon("core.blender.actions").find(self.thing, "location", 0)
        curve.keyframe_points[1].co[1] += 4.0
        curve.update()
        self.thing.update_tag()
        after = self.keys.integral(self.curve(), 1.0, 50.0)
        self.assertGreater(abs(after - before), 0.5)
        np.testing.assert_allclose(after, self.summed(self.curve(), 1.0, 50.0), atol=2e-3)
