"""F-curves that the native module plays: Blender's own values, of every kind that it plays; and who plays what."""

import math
from unittest import mock

import bpy
import numpy as np

import support
from core.tracks.track_cases import EASINGS, INTERPOLATIONS, TrackTestCase

MODES = ('NONE', 'REPEAT', 'REPEAT_OFFSET', 'MIRROR')
FAR = 1_000_000.0
CURVES = 260
CLOSE = 1e-6
"""How far from Blender's values, as a part of them; where both use the same mathematics library they have the same bits."""


class NativeKeysTest(TrackTestCase):
    def setUp(self):
        super().setUp()
        self.native_keys, self.keys = support.addon("core.animation.native_keys"), support.addon("core.animation.keys")
        self.thing = self.link("Thing")

    def curve(self, count, first=1.0):
        """An F-curve with random keys of every kind."""
        draw = self.random
        self.thing.animation_data_clear()
        self.thing.keyframe_insert("location", index=0, frame=first)
        curve = support.addon("core.blender.actions").find(self.thing, "location", 0)
        curve.keyframe_points.add(count - 1)
        frame = first
        for point in curve.keyframe_points:
            point.handle_left_type = point.handle_right_type = 'FREE'
            point.co = frame, draw.uniform(-3, 3)
            # Some are longer than the way.
            point.handle_left = frame - draw.uniform(0, 30), draw.uniform(-4, 4)
            point.handle_right = frame + draw.uniform(0, 30), draw.uniform(-4, 4)
            point.interpolation, point.easing = draw.choice(INTERPOLATIONS), draw.choice(EASINGS)
            point.back, point.amplitude = draw.uniform(-1, 3), draw.choice((0.0, draw.uniform(-1, 8)))
            point.period = draw.choice((0.0, draw.uniform(0.5, 9)))
            frame += draw.choice((1.0, 3.0, draw.uniform(0.5, 15)))
        curve.extrapolation = draw.choice(('CONSTANT', 'LINEAR'))
        return curve

    def cycles(self, curve):
        """A random Cycles modifier on it."""
        draw, cycles = self.random, curve.modifiers.new('CYCLES')
        cycles.mode_before, cycles.mode_after = draw.choice(MODES), draw.choice(MODES)
        cycles.cycles_before, cycles.cycles_after = draw.choice((0, 0, 1, 3)), draw.choice((0, 0, 2, 3))
        if draw.random() < 0.4:
            cycles.use_restricted_range = True
            cycles.frame_end, cycles.frame_start = draw.uniform(20, 60), draw.uniform(-60, 0)
            cycles.blend_in, cycles.blend_out = draw.uniform(0, 20), draw.uniform(0, 20)
        cycles.use_influence, cycles.influence = draw.random() < 0.4, draw.random()
        curve.update()

    def frames(self, curve):
        """Before, at, near, between and behind its keys, and far away."""
        places = [point.co.x for point in curve.keyframe_points]
        lap = max(1.0, places[-1] - places[0])
        near = [place + part for place in places for part in (0.0, 1e-4, -1e-4, 5e-5, 2e-4)]
        laps = [places[-1] + times * lap for times in (-2, -1, 1, 2, 3)]
        return [
            *near,
            *laps,
            *(self.random.uniform(places[0] - 3 * lap, places[-1] + 3 * lap) for _ in range(60)),
            FAR,
            FAR + 0.3,
            FAR + 1.0,
            -FAR,
        ]

    def test_blender_says_the_same(self):
        """Random F-curves of all kinds, with and without the modifier, near frame 1 and at a million."""
        same = asked = 0
        for number in range(CURVES):
            curve = self.curve(1 + number % 6, FAR if number % 9 == 8 else self.random.uniform(-20, 20))
            if number % 2:
                self.cycles(curve)
            frames = self.frames(curve)
            wanted = np.array([curve.evaluate(frame) for frame in frames])
            player = self.native_keys.player(curve)
            if number % 9 != 8:  # at a million keys may stand so close that Blender takes them for one
                self.assertIsNotNone(player, number)
            if player is None:
                continue
            found = player.values(frames)
            np.testing.assert_allclose(found, wanted, rtol=CLOSE, atol=CLOSE, err_msg=str(number))
            same += int((found == wanted).sum())
            asked += len(frames)
        self.assertGreater(same, 0.99 * asked, "the same bits")

    def test_blender_is_asked_for_nothing(self):
        """Not for a curve that the native module knows, however many values are read of it."""
        self.curve(4)
        curve = support.addon("core.blender.actions").find(self.thing, "location", 0)
        self.cycles(curve)
        bpy.context.view_layer.update()
        thing = self.evaluated(self.thing)
        track = self.tracks.own_track(thing)
        times = np.linspace(-100.0, 2000.0, 999)
        with (
            mock.patch.object(self.keys, "_asked") as asked,
            mock.patch.object(self.native_keys, "read", wraps=self.native_keys.read) as read,
        ):
            first = track.values(times)
            np.testing.assert_array_equal(self.tracks.own_track(thing).values(times[:1]).locations, first.locations[:1])
        asked.assert_not_called()
        self.assertEqual(read.call_count, 1, "kept for as long as the action is not edited")
        curve.keyframe_points[0].co.y += 1.0
        curve.update()
        bpy.context.view_layer.update()
        self.assertNotEqual(self.tracks.own_track(self.evaluated(self.thing)).values(times).locations[0, 0], first.locations[0, 0])

    def test_what_only_blender_plays(self):
        """Other modifiers, samples, keys that count as one; none of which may be played as if it were plain."""
        for kind in ('NOISE', 'GENERATOR', 'FNGENERATOR', 'ENVELOPE', 'LIMITS', 'STEPPED'):
            curve = self.curve(4)
            curve.modifiers.new(kind)
            self.assertIsNone(self.native_keys.player(curve), kind)
            curve.modifiers[0].mute = True
            self.assertIsNotNone(self.native_keys.player(curve), kind)
        curve = self.curve(3)
        curve.modifiers.new('CYCLES')
        curve.modifiers.new('NOISE')
        self.assertIsNone(self.native_keys.player(curve))
        curve = self.curve(3)
        curve.keyframe_points[1].co.x = curve.keyframe_points[0].co.x + 0.005
        self.assertIsNone(self.native_keys.player(curve))

    def test_a_modifier_that_is_left_out(self):
        """Blender plays a Cycles modifier as the first one alone."""
        curve = self.curve(3)
        curve.modifiers.new('LIMITS').mute = True
        curve.modifiers.new('CYCLES')
        curve.update()
        self.check(curve)

    def test_numbers_that_are_whole(self):
        """F-curves of whole numbers and switches round, which Python is not told."""
        self.thing["count"], holder = 3, self.thing
        for path, values in (('["count"]', (1, 8)), ("hide_render", (False, True))):
            for frame, value in zip((1, 20), values):
                if path.startswith("["):
                    holder["count"] = value
                else:
                    setattr(holder, path, value)
                holder.keyframe_insert(path, frame=frame)
            curve = support.addon("core.blender.actions").find(holder, path)
            for point in curve.keyframe_points:
                point.interpolation = 'LINEAR'
            self.check(curve)

    def check(self, curve):
        """Whoever plays it, the values are Blender's."""
        frames = np.linspace(-30.0, 90.0, 301)
        np.testing.assert_allclose(self.keys.values(curve, frames), [curve.evaluate(frame) for frame in frames], rtol=CLOSE, atol=CLOSE)

    def test_without_the_native_module(self):
        curve = self.curve(3)
        wanted = self.keys.values(curve, np.linspace(0.0, 30.0, 50))
        with mock.patch.object(support.addon("core.native"), "module", None):
            np.testing.assert_allclose(self.keys.values(curve, np.linspace(0.0, 30.0, 50)), wanted, rtol=CLOSE, atol=CLOSE)

    def test_numbers_that_are_none(self):
        curve = self.curve(3)
        curve.keyframe_points[1].co.y = math.inf
        self.assertIsNone(self.native_keys.player(curve))
