"""Walkers on motions that are solved or recorded, and what is known of them at other times."""

from unittest import mock

import bpy
import numpy as np

import solved_cases
import support
from path import path_cases
from walker import walker_cases as cases


class Motions(cases.WalkerTestCase):
    def path(self):
        course = path_cases.curve_data("Course")
        path_cases.add_bezier(course, path_cases.cubic_knots(((0, 0, 0), (0, 1, 0), (1, 2, 0), (2, 2, 0))))
        return support.link("Course", course)

    def test_a_path_is_followed(self):
        curve = self.path()
        spider = cases.spider(ahead=0.0)
        self.assertEqual(bpy.ops.motus.path_follow_add(object=spider.name, curve=curve.name, duration=4.0), {'FINISHED'})
        bpy.context.view_layer.update()
        self.assertStands(spider, list(range(1, 121, 2)), 2e-6)
        self.assertWell(spider)
        for frame in (-50, 400):  # where it rests at the beginning and at the end of the curve
            support.go_to(frame)
            self.assertWell(spider)

    def test_beyond_what_is_planned_a_body_that_goes_on_is_told(self):
        curve = self.path()
        spider = cases.spider(ahead=0.0)
        bpy.ops.motus.path_follow_add(object=spider.name, curve=curve.name, extend='LOOP', duration=4.0)
        for frame in (400, 433):
            support.go_to(frame)
            self.assertIn("planned for the frames of the scene", self.sentence(spider))
        self.scene.frame_end = 500
        support.go_to(401)
        self.assertWell(spider)

    def test_frames_of_a_path_in_any_order(self):
        curve = self.path()
        spider = cases.spider(ahead=0.0)
        bpy.ops.motus.path_follow_add(object=spider.name, curve=curve.name, duration=4.0)
        frames = sorted(set(cases.OFF_THE_FRAMES))
        played = dict(zip(frames, cases.over(frames, lambda: cases.places(spider))))
        for frame in cases.OFF_THE_FRAMES:
            support.go_to(frame)
            np.testing.assert_array_equal(cases.places(spider), played[frame])

    def test_where_the_scene_begins_changes_nothing_on_a_path(self):
        curve = self.path()
        spider = cases.spider(ahead=0.0)
        bpy.ops.motus.path_follow_add(object=spider.name, curve=curve.name, duration=4.0)
        frames = (57, 60, 70)
        whole = cases.over(frames, lambda: cases.places(spider))
        for self.scene.frame_start, self.scene.frame_end in ((50, 120), (57, 70)):
            np.testing.assert_array_equal(cases.over(frames, lambda: cases.places(spider)), whole)

    def test_a_scene_that_begins_late(self):
        curve = self.path()
        spider = cases.spider(ahead=0.0)
        bpy.ops.motus.path_follow_add(object=spider.name, curve=curve.name, extend='LOOP', duration=4.0)
        self.scene.frame_start, self.scene.frame_end = 30_000, 30_100
        support.go_to(30_050)
        self.assertWell(spider)

    def test_each_frame_of_a_long_motion_is_a_sample(self):
        spider = cases.spider(ahead=0.0)
        plan = support.addon("walker.plan")
        support.key_places(spider, {0: (0.0, 0.0, 0.0), 30_000: (0.0, 20_000.0, 0.0)})
        for curve in support.addon("core.blender.actions").fcurves(spider):
            for key in curve.keyframe_points:
                key.interpolation = 'LINEAR'
        support.go_to(5000)
        steps = cases.plan_of(spider).walker.steps
        self.assertGreater(int((steps["touch"] > steps["lift"]).sum()), 8 * plan.MOST_FRAMES)

    def test_a_render_plans_nothing_anew(self):
        """Its evaluated copies are others on each frame; what they are read for is the same."""
        spider = cases.spider_on_waves()
        support.go_to(20)
        native, tracks, stamps = support.addon("core.native").module, support.addon("core.tracks"), set()
        with mock.patch.object(native, "Walker", wraps=native.Walker) as made:
            for frame in (20, 21):
                spider.animation_data.action.update_tag()
                spider.update_tag()
                support.go_to(frame)
                stamps.add(tracks.world_track(support.evaluated(spider), self.scene).stamp)
                self.assertNotIsInstance(cases.plan_of(spider), support.addon("core.declare").Problem)
        self.assertEqual(len(stamps), 2)
        self.assertEqual(made.call_count, 0)

    def test_feet_and_body_share_a_plan_for_as_long_as_an_evaluation(self):
        spider = cases.spider_on_waves()
        plan = support.addon("walker.plan")
        support.go_to(20)
        with mock.patch.object(plan, "of", wraps=plan.of) as asked:
            support.go_to(21)
            self.assertIn(asked.call_count, (1, 2))  # two where both begin at once
        for stride in (0.2, 0.6):
            for change in (
                lambda stride=stride: setattr(spider.motus.walker, "stride", stride),
                lambda: setattr(spider.pose.bones["body"], "location", (0.0, 0.01, 0.0)),
            ):
                change()
                bpy.context.view_layer.update()
                found = cases.places(spider), cases.body_of(spider)
                support.go_to(1)
                support.go_to(21)
                for was, now in zip(found, (cases.places(spider), cases.body_of(spider))):
                    np.testing.assert_array_equal(was, now)

    def test_an_extent_needs_no_plan(self):
        spider = cases.spider_on_waves()
        support.go_to(20)
        native, tracks = support.addon("core.native").module, support.addon("core.tracks")
        with mock.patch.object(native, "Walker", wraps=native.Walker) as made:
            for name in ("abdomen", "foot 1.L"):
                self.assertGreater(tracks.world_track(spider.pose.bones[name], self.scene).extent[1], 90.0)
        self.assertEqual(made.call_count, 0)

    def test_feet_rest_when_the_extent_ends(self):
        for gait in ("TETRAPOD", "WAVE", "RIPPLE"):
            for cadence in (0.5, 1.0):
                with self.subTest((gait, cadence)):
                    support.empty_scene()
                    spider = cases.spider(gait=gait, cadence=cadence, ahead=1.7)
                    end = support.addon("core.tracks").world_track(spider.pose.bones["foot 1.L"], bpy.context.scene).extent[1]
                    self.assertLess(cases.plan_of(spider).walker.settled, cases.seconds(end))

    def test_what_is_not_known_is_recorded(self):
        spider = cases.spider(ahead=0.0)
        carrier = support.link("Carrier")
        support.key_places(carrier, {1: (0.0, 0.0, 0.0), 60: (0.0, 2.0, 0.0)})
        spider.constraints.new('COPY_LOCATION').target = carrier
        support.go_to(30)
        self.assertIn("record it", self.sentence(spider))
        np.testing.assert_allclose(cases.places(spider), cases.rests(spider), atol=1e-5)
        self.assertEqual(bpy.ops.motus.track_record(datablock=spider.name, frame_start=1, frame_end=120), {'FINISHED'})
        self.assertStands(spider, list(range(1, 121, 3)))
        self.assertWell(spider)

    def test_what_was_recorded_and_goes_on_is_recorded_again(self):
        spider = cases.spider(ahead=0.0)
        carrier = support.link("Carrier")
        support.key_places(carrier, {1: (0.0, 0.0, 0.0), 200: (0.0, 4.0, 0.0)})
        spider.constraints.new('COPY_LOCATION').target = carrier
        bpy.ops.motus.track_record(datablock=spider.name, frame_start=1, frame_end=100)
        support.go_to(90)
        self.assertWell(spider)
        support.go_to(150)
        self.assertIn("not where it was recorded", self.sentence(spider))
        np.testing.assert_allclose(cases.places(spider), cases.rests(spider), atol=1e-5)


class OverTime(solved_cases.Solved, cases.WalkerTestCase):
    label = "Walker"

    def setUp(self):
        super().setUp()
        self.land = cases.grid("Land", cases.waves)

    def test_feet_and_bodies_that_are_objects(self):
        body, shell, feet = cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), body=shell.name, ground=self.land.name)
        support.key_places(body, {1: (0.0, 0.0, 0.0), 60: (0.0, 2.0, 0.0)})
        bpy.context.view_layer.update()
        for thing in (feet[2], shell):
            self.assertSolved(thing, 2e-5)

    def test_bones(self):
        spider = cases.spider(ground=self.land.name)
        spider.pose.bones["body"].location = (0.01, 0.02, 0.03)
        bpy.context.view_layer.update()
        for name in ("foot 2.L", "body", "abdomen", "lower 2.L"):
            with self.subTest(name):
                self.assertSolved(spider.pose.bones[name], 5e-5)

    def test_dynamics_on_a_body_that_leans(self):
        spider = cases.spider(ground=self.land.name)
        self.assertEqual(bpy.ops.motus.dynamics_add(object=spider.name, bones="abdomen", style='BOUNCY'), {'FINISHED'})
        bpy.context.view_layer.update()
        found = support.addon("core.wiring").problem(support.addon("dynamics").SYSTEM, spider, bpy.context.view_layer.depsgraph)
        self.assertIsNone(found)
        frames = (30, 80, 55, 30)
        values = cases.over(frames, lambda: np.array(support.evaluated(spider).pose.bones["abdomen"].matrix))
        np.testing.assert_array_equal(values[0], values[3])
        support.go_to(60)
        walker = cases.plan_of(spider).walker
        np.testing.assert_allclose(cases.places(spider), walker.feet(cases.seconds(60)), atol=cases.SINGLE)

    def test_a_keyed_influence(self):
        spider = cases.spider(ground=self.land.name)
        for frame, value in ((1, 0.25), (100, 1.0)):
            spider.motus.walker.influence = value
            spider.keyframe_insert("motus.walker.influence", frame=frame)
        bpy.context.view_layer.update()
        for name in ("foot 2.L", "body"):
            with self.subTest(name):
                self.assertSolved(spider.pose.bones[name], 5e-5)

    def test_what_is_not_known(self):
        spider = cases.spider()
        spider.constraints.new('COPY_LOCATION').target = self.land
        bpy.context.view_layer.update()
        self.assertUnknown(spider.pose.bones["foot 1.L"], "has the constraint")
