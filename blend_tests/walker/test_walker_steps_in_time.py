"""Steps that are set in time: feet touch the ground and lift on frames of the artist's choice, and the steps around make room."""

import math
from unittest import mock

import bpy
import numpy as np
from mathutils import Vector

import support
from walker import walker_cases as cases
from walker.test_walker_carrier import on_board, ship
from walker.test_walker_steps import FOOT, foot_of, stand

FRAME = 50


def time_step(owner, **changes):
    return bpy.ops.motus.walker_step_time(object=owner.name, **{"foot": FOOT, "frame": FRAME, **changes})


def step_on(owner, name=FOOT, frame=FRAME):
    """The chosen.Step that a foot has on a frame."""
    chosen = support.addon("walker.steps.chosen")
    return chosen.step_at(bpy.context, owner, cases.foot_bones(owner).index(name), frame)


def frames_of(step):
    """(frame of the touchdown, frame of the lift-off) of a step."""
    return step.touch / cases.seconds(1.0), step.lift / cases.seconds(1.0)


def arrived(owner):
    """Frames on which the entry 0 of a walker has its foot touch down and lift, as planned."""
    return frames_of(support.addon("walker.steps.chosen").step_of_entry(bpy.context, owner, 0))


class StepsInTime(cases.WalkerTestCase):
    def walking(self, **keywords):
        spider = cases.spider_on_waves(**keywords)
        support.go_to(stand(spider))
        return spider

    def test_a_foot_lands_and_lifts_on_the_frames(self):
        spider = self.walking()
        before = cases.plan_of(spider).walker.steps
        touch, lift = (round(frame) for frame in frames_of(step_on(spider)))
        touch, lift = touch + 2, lift + 5
        self.assertEqual(time_step(spider, touch=touch, lift=lift), {'FINISHED'})
        self.assertEqual(arrived(spider), (touch, lift))
        self.assertWell(spider)
        places = cases.over(np.arange(touch - 1.0, lift + 1.5, 0.5), lambda: foot_of(spider))
        stands = np.abs(places - places[4]).max(axis=1) <= cases.SINGLE
        self.assertTrue(stands[2:-2].all())
        self.assertFalse(stands[0] or stands[-1])
        # Feet of other legs step as before.
        after, leg = cases.plan_of(spider).walker.steps, cases.foot_bones(spider).index(FOOT)
        for name in ("lift", "touch", "end"):
            np.testing.assert_array_equal(after[name][after["leg"] != leg], before[name][before["leg"] != leg])
        self.assertStands(spider, range(1, 100))

    def test_frames_in_any_order(self):
        spider = self.walking()
        touch, lift = frames_of(step_on(spider))
        time_step(spider, touch=touch - 1.5, lift=lift + 30.25)
        time_step(spider, foot="foot 3.R", frame=30, lift=40)
        frames = sorted(set(cases.OFF_THE_FRAMES))
        played = dict(zip(frames, cases.over(frames, lambda: cases.places(spider))))
        for frame in cases.OFF_THE_FRAMES:
            support.go_to(frame)
            np.testing.assert_array_equal(cases.places(spider), played[frame])
        self.assertStands(spider, range(1, 100))

    def test_settings_arrive(self):
        spider = self.walking()
        native = support.addon("core.native").module
        touch, lift = (round(frame) for frame in frames_of(step_on(spider)))
        planned = step_on(spider).planned
        time_step(spider, touch=touch)
        entry = spider.motus.walker.steps[0]
        self.assertEqual((entry.use_touch, entry.touch, entry.use_lift), (True, touch, False))
        with mock.patch.object(native, "Walker", wraps=native.Walker) as made:
            entry.lift, entry.use_lift = lift + 1, True
            bpy.context.view_layer.update()
        (given,) = made.call_args.kwargs["chosen"]
        self.assertEqual(given[5:], (cases.seconds(touch), cases.seconds(lift + 1)))
        self.assertAlmostEqual(given[1], planned, delta=1e-6)
        with mock.patch.object(native, "Walker", wraps=native.Walker) as made:
            entry.use_touch = entry.use_lift = False
            bpy.context.view_layer.update()
        self.assertEqual(made.call_args.kwargs["chosen"][0][5:], (None, None))
        for name in ("touch", "lift"):
            setattr(entry, f"use_{name}", True)
            before = getattr(entry, name)
            setattr(entry, name, math.inf)
            self.assertEqual(self.sentence(spider), "Changed Steps is not a finite number")
            setattr(entry, name, before)
        self.assertWell(spider)

    def test_the_same_step_is_meant_after_it_was_timed(self):
        spider = self.walking()
        step = step_on(spider)
        time_step(spider, touch=round(frames_of(step)[0]) + 3)
        self.assertAlmostEqual(step_on(spider, frame=frames_of(step)[1] - 1.0).planned, step.planned)
        bpy.ops.motus.walker_step(object=spider.name, index=0, lock=True)
        time_step(spider, index=0, lift=frames_of(step)[1] + 20)
        (entry,) = spider.motus.walker.steps
        self.assertTrue(entry.is_locked and entry.use_touch and entry.use_lift)
        # A neighbour that was pushed is known by when it was planned.
        middle = support.addon("walker.steps.chosen").near(bpy.context, spider, cases.seconds(entry.lift + 8), 0.5)
        pushed = next(one for one in middle if one.leg == step.leg and one.entry < 0)
        time_step(spider, frame=pushed.middle / cases.seconds(1.0), lift=pushed.lift / cases.seconds(1.0) + 1.0)
        self.assertEqual(len(spider.motus.walker.steps), 2)
        self.assertAlmostEqual(spider.motus.walker.steps[1].frame, pushed.planned / cases.seconds(1.0), delta=1e-4)
        self.assertWell(spider)

    def test_removing_restores_exactly(self):
        spider = self.walking()
        frames = sorted(cases.OFF_THE_FRAMES)
        before = cases.over(frames, lambda: cases.places(spider))
        support.go_to(FRAME)
        time_step(spider, lift=frames_of(step_on(spider))[1] + 20)
        self.assertTrue((cases.over(frames, lambda: cases.places(spider)) != before).any())
        bpy.ops.motus.walker_step_remove(object=spider.name)
        np.testing.assert_array_equal(cases.over(frames, lambda: cases.places(spider)), before)

    def test_a_drag_that_is_given_up_leaves_nothing(self):
        spider = self.walking()
        chosen = support.addon("walker.steps.chosen")
        made = chosen.Edit(bpy.context, spider, step_on(spider))
        made.time("touch", 40.0)
        made.restore()
        self.assertEqual(len(spider.motus.walker.steps), 0)
        time_step(spider, lift=60)
        made = chosen.Edit(bpy.context, spider, chosen.step_of_entry(bpy.context, spider, 0))
        made.time("lift", 70.0)
        made.time("touch", 40.0)
        made.restore()
        entry = spider.motus.walker.steps[0]
        self.assertEqual((entry.use_touch, entry.use_lift, entry.lift), (False, True, 60.0))

    def test_on_a_carrier(self):
        carrier, deck = ship()
        spider = cases.spider(ground=deck.name, carrier=carrier.name)
        on_board(spider, carrier)
        support.go_to(FRAME)
        lift = round(frames_of(step_on(spider))[1]) + 6
        time_step(spider, lift=lift)
        self.assertEqual(arrived(spider)[1], lift)
        space = support.addon("walker.steps.chosen").space
        on_deck = []
        for frame in (lift - 6, lift - 0.5, lift):
            support.go_to(frame)
            on_deck.append(space(bpy.context, spider).inverted() @ foot_of(spider))
        for place in on_deck[1:]:
            self.assertLess((place - on_deck[0]).length, 1e-5)

    def test_with_a_keyed_gait(self):
        spider = self.walking()
        for frame, gait, cadence in ((1, 'TETRAPOD', 1.0), (60, 'TRIPOD', 2.0)):
            spider.motus.walker.gait, spider.motus.walker.cadence = gait, cadence
            spider.keyframe_insert("motus.walker.gait", frame=frame)
            spider.keyframe_insert("motus.walker.cadence", frame=frame)
        support.go_to(FRAME)
        lift = round(frames_of(step_on(spider))[1]) + 20
        time_step(spider, lift=lift)
        self.assertEqual(arrived(spider)[1], lift)
        self.assertStands(spider, range(1, 100))

    def test_time_stretching(self):
        spider = self.walking()
        bpy.context.scene.render.frame_map_old, bpy.context.scene.render.frame_map_new = 100, 200
        support.go_to(100)
        time_step(spider, frame=100, lift=130)
        self.assertEqual(spider.motus.walker.steps[0].lift, 65.0)
        self.assertAlmostEqual(arrived(spider)[1], 65.0, delta=1e-9)

    def test_what_hangs_on_the_legs_knows_how_long_they_move(self):
        spider = self.walking(ahead=1.0, last=60)
        track = support.addon("walker.over_time").over_time(spider, spider.pose.bones[FOOT], bpy.context.scene)
        before = track.extent
        time_step(spider, lift=110)
        track = support.addon("walker.over_time").over_time(spider, spider.pose.bones[FOOT], bpy.context.scene)
        self.assertEqual(track.extent[0], before[0])
        self.assertAlmostEqual(track.extent[1], before[1] + 110 - 60)

    def test_what_cannot_be_is_told(self):
        spider = self.walking()
        touch = round(frames_of(step_on(spider))[0])
        time_step(spider, touch=touch, lift=touch - 3)
        self.assertEqual(self.sentence(spider), f"{FOOT} cannot lift on frame {touch - 3}: its step has no room, or is the last one")
        entry = spider.motus.walker.steps[0]
        entry.use_lift, entry.touch = False, -200.0
        self.assertEqual(self.sentence(spider), f"{FOOT} cannot land on frame -200: its steps before leave no room")
        entry.use_touch = False
        self.assertWell(spider)
        for changes, sentence in (
            ({}, "Say when the step is: touch or lift is missing"),
            ({"foot": "Tail", "touch": 1.0}, "Spider has no foot Tail"),
            ({"touch": math.nan}, "(?i)touch"),
            ({"index": 3, "touch": 1.0}, "Spider has no such step"),
        ):
            with self.assertRaisesRegex(RuntimeError, sentence):
                time_step(spider, **changes)

    def test_a_changed_step_that_is_left_out_is_told(self):
        spider = self.walking()
        frame = frames_of(step_on(spider))[1] + 1.0
        following = step_on(spider, frame=frame)
        place = tuple(np.array(following.end) + (0.02, 0.02, 0.0))
        told = f"{FOOT} takes no step on frame {following.planned / cases.seconds(1.0):.0f}, where it was changed: it still stands where it is held"
        for changes in ({"location": place}, {"turn": 0.1}, {"lock": True}):
            with self.subTest(changes=changes):
                bpy.ops.motus.walker_step(object=spider.name, foot=FOOT, frame=frame, **changes)
                self.assertWell(spider)
                time_step(spider, lift=frames_of(following)[1])
                self.assertEqual(self.sentence(spider), told)
                spider.motus.walker.steps[1].use_lift = False
                self.assertWell(spider)
                spider.motus.walker.steps.clear()
                spider.update_tag()
                self.assertWell(spider)

    def test_the_chart(self):
        spider = self.walking()
        chart = support.addon("walker.steps.chart")
        # Without a window the interface has no scale.
        drawn = chart.Chart.of(bpy.context, spider, mock.Mock(width=900, height=600))._replace(scale=1.0, width=400.0)
        self.assertEqual(drawn.rows, 8)
        ends = drawn.ends()
        self.assertTrue({end.moment for end in ends} == {"touch", "lift"} and len({end.step.leg for end in ends}) == 8)
        for end in ends:
            found = drawn.pick((drawn.x(end.seconds), drawn.y(end.step.leg)))
            self.assertEqual((found.step.leg, found.seconds), (end.step.leg, end.seconds))
        self.assertIsNone(drawn.pick((0.0, 0.0)))
        self.assertAlmostEqual(drawn.seconds(drawn.x(drawn.now + 1.0) - drawn.x(drawn.now)), 1.0)
        self.assertLess(Vector((drawn.x(math.inf) - drawn.x(drawn.now + chart.SECONDS), 0.0)).length, 1e-9)
