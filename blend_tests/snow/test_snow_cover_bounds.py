"""Work on lying snow is priced before it is done: what is too much is not done, and what was worked out before stays."""

from unittest import mock

import support
from snow.cover_cases import FALLING, CoverTestCase, layer, state
from support import go_to


class Bounds(CoverTestCase):
    def setUp(self):
        super().setUp()
        self.work = support.addon("snow.cover.work")
        self.square()
        self.emitter = self.add(**FALLING)
        self.snow_cover = self.cover()

    def done(self, change, frame=100):
        """How often work is done while a change is made and evaluated."""
        with mock.patch.object(self.work, "steps", wraps=self.work.steps) as steps:
            change()
            go_to(frame)
        return steps.call_count

    def test_the_last_layer_stays_while_long_work_waits(self):
        go_to(120)
        later = state(self.snow_cover)
        go_to(100)
        before = state(self.snow_cover)
        self.assertNotEqual(before, later)

        def change():
            self.emitter.motus.snow.rate = 30_000.0

        self.assertEqual(self.done(change), 0)
        self.assertIn("press Calculate Snow", self.cover_sentence(self.snow_cover))
        self.assertEqual(state(self.snow_cover), before)
        go_to(120)
        self.assertEqual(state(self.snow_cover), later)

    def test_covers_share_the_time_of_a_frame(self):
        """What one cover has worked out at once waits if several are to be."""
        go_to(100)
        price = max(self.work.price(plan) for _, plan in (place for place, _ in self.work._done.items()))
        with mock.patch.object(self.work, "LONG", 1.5 * price):

            def change():
                self.emitter.motus.snow.seed += 1

            self.assertEqual(self.done(change), 1)
            self.square("Yard", (9.0, 0.0, 0.0))
            second = self.cover("Yard")
            before = state(self.snow_cover)
            self.assertEqual(self.done(change), 0)
            for one in (self.snow_cover, second):
                self.assertIn("press Calculate Snow", self.cover_sentence(one))
            self.assertEqual(state(self.snow_cover), before)

    def test_smoothing_shares_the_time_of_a_frame(self):
        lain_on = mock.Mock(area=4.0, faces=mock.Mock(triangles=range(2000)))
        share = lambda rounds, of: self.work.share_of_smoothing((lain_on,), 0.1, rounds, of)  # noqa: E731
        self.assertEqual(share(400, 0.25), 1.0, "far less than there is time for")
        self.assertEqual(share(400_000, 0.25), 0.25)
        go_to(100)
        ((_, plan),) = [place for place, _ in self.work._done.items()][-1:]
        bounds = support.addon("core.measures.bounds")
        with mock.patch.object(bounds, "AT_ONCE", 8 * self.work.ROUND * len(layer(self.snow_cover)[0])):
            done = self.work.do("Shared", plan._replace(smoothing=400, share=0.5))
            alone = self.work.do("Alone", plan._replace(smoothing=400))
        self.assertIs(done.fault, self.work.LESS_SMOOTH)
        self.assertIs(alone.fault, self.work.LESS_SMOOTH)
        self.assertFalse((done.covers[0].heights(4.0) == alone.covers[0].heights(4.0)).all())

    def test_renders_have_it_done(self):
        may_wait = self.work.may_wait
        modes = [mock.Mock(mode=mode) for mode in ('VIEWPORT', 'RENDER')]
        self.assertEqual([may_wait(depsgraph, self.snow_cover) for depsgraph in modes], [True, False])

    def test_a_layer_that_is_too_fine_is_not_begun(self):
        go_to(100)
        before, ground = state(self.snow_cover), support.addon("snow.cover.ground")
        with mock.patch.object(ground, "made", wraps=ground.made) as made:
            self.snow_cover.motus.snow_cover.resolution = 1e-4
            go_to(100)
            self.assertEqual(made.call_count, 0)
        self.assertIn("2 million vertices", self.cover_sentence(self.snow_cover))
        self.assertEqual(state(self.snow_cover), before)
        # Without a layer of before there is none.
        self.work._done.clear()
        self.emitter.update_tag()
        go_to(101)
        self.assertEqual(len(layer(self.snow_cover)[0]), 0)

    def test_too_many_flakes_leave_the_layer(self):
        go_to(100)
        before = state(self.snow_cover)
        self.emitter.motus.snow.lifetime = 0.1
        self.emitter.motus.snow.rate = 1e7
        go_to(100)
        self.assertIn("10 million flakes", self.cover_sentence(self.snow_cover))
        self.assertEqual(state(self.snow_cover), before)

    def test_smoothing_has_as_many_rounds_as_a_frame_has_time_for(self):
        native, bounds = support.addon("core.native").module, support.addon("core.measures.bounds")
        rounds = []

        def made(*arguments, smoothing, **keywords):
            rounds.append(smoothing)
            return native.SnowCover(*arguments, smoothing=smoothing, **keywords)

        module = mock.Mock(wraps=native, SnowCover=made)
        self.snow_cover.motus.snow_cover.smoothing = 1e6
        go_to(100)
        self.assertEqual(self.cover_sentence(self.snow_cover), "")
        with (
            mock.patch.object(self.work.native, "module", module),
            mock.patch.object(bounds, "AT_ONCE", 0.03 * len(layer(self.snow_cover)[0])),
        ):
            self.emitter.motus.snow.seed += 1
            go_to(100)
            self.assertIn("spreads less far", self.cover_sentence(self.snow_cover))
        self.assertEqual(len(rounds), 1)
        self.assertLess(rounds[0], 10)

    def test_a_frame_far_away(self):
        self.emitter.motus.snow.rate = 20.0
        self.emitter.keyframe_insert("location", frame=1)
        self.emitter.location.x = 1.0
        self.emitter.keyframe_insert("location", frame=50)
        for curve in support.addon("core.blender.actions").fcurves(self.emitter):
            curve.modifiers.new('CYCLES')
            curve.update()
        go_to(100)
        before = state(self.snow_cover)
        births = support.addon("snow.births")
        with mock.patch.object(births, "_sampled", wraps=births._sampled) as sampled:
            self.assertEqual(self.done(lambda: None, 1_000_000), 0)
        self.assertIn("press Calculate Snow", self.cover_sentence(self.snow_cover))
        self.assertGreater(len(layer(self.snow_cover)[0]), 0)
        frames = sum(len(one.bounds(*call.args[1:3])) for call in sampled.call_args_list for one in call.args[0])
        self.assertLess(frames, 30_000)
        go_to(100)
        self.assertEqual(state(self.snow_cover), before)
