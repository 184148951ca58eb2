"""What follows a path is known at any times, for systems that need its past."""

import unittest.mock

import bpy
import numpy as np

import support
from path.path_cases import PathTestCase, circle_knots

FRAMES = (-3.0, 1.0, 2.5, 13.0, 24.25, 60.0, 120.0, 300.0)


class OverTime(PathTestCase):
    def setUp(self):
        super().setUp()
        self.tracks = support.addon("core.tracks")

    def track(self, thing):
        return self.tracks.world_track(thing, self.scene)

    def assertSolved(self, thing, tolerance=2e-6, frames=FRAMES):
        track = self.track(thing)
        self.assertEqual(track.kind, self.tracks.Kind.SOLVED, track.sentence)
        self.assertIn("Follow Path", track.sentence)
        wanted = np.array([np.array(self.at(thing, frame)) for frame in frames])
        found = track.values(frames)
        self.assertLessEqual(np.abs(found - wanted).max(), tolerance * max(1.0, np.abs(wanted).max()))
        evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
        np.testing.assert_array_equal(self.tracks.world_track(evaluated, self.scene).values(frames), found)

    def key(self, thing, name, *keys):
        for frame, value in keys:
            setattr(thing.motus.path, name, value)
            thing.keyframe_insert(f"motus.path.{name}", frame=frame)

    def test_timings(self):
        self.cubic()
        for keywords in ({"timing": 'DURATION', "ease_in": 0.3}, {"timing": 'SPEED', "speed": 2.0}):
            for orientation in ('NONE', 'WORLD_UP', 'MINIMAL', 'BANKING', 'CURVATURE'):
                car = self.follow(orientation=orientation, **keywords)
                car.scale = 1.5, 0.5, 2.0
                car.rotation_euler = 0.1, 0.2, 0.3
                with self.subTest(orientation, **keywords):
                    self.assertSolved(car)

    def test_keys(self):
        self.bezier(circle_knots(20.0), cyclic=True)
        car = self.follow(timing='SPEED', extend='LOOP', orientation='BANKING', lag_rate=0.5)
        self.key(car, "speed", (1, 2.0), (40, 9.0))
        self.key(car, "offset", (1, 0.0), (60, 4.0))
        self.key(car, "bank_strength", (1, 0.0), (60, 1.0))
        self.assertSolved(car)
        self.assertTrue({1.0, 40.0, 60.0} <= set(self.track(car).bounds(1.0, 60.0)))

    def test_a_curve_that_moves(self):
        course = self.cubic()
        for frame, place in ((1, (0.0, 0.0, 0.0)), (60, (1.0, 2.0, 3.0))):
            course.location = place
            course.keyframe_insert("location", frame=frame)
        self.assertSolved(self.follow())

    def test_children_of_followers_and_trains(self):
        self.cubic()
        self.follow(duration=3.0)
        car, rider = bpy.data.objects["Car"], self.link("Rider")
        rider.parent, rider.location = car, (1.0, 2.0, 3.0)
        self.assertSolved(rider)
        wagons = [self.link(f"Wagon {index}") for index in range(3)]
        names = ",".join(one.name for one in (car, *wagons))
        self.assertEqual(bpy.ops.motus.path_train_add(objects=names, curve="Course", gap=1.5), {'FINISHED'})
        for thing in (car, rider, wagons[2]):
            self.assertSolved(thing, 5e-6)

    def test_transforms_that_are_not_known_have_a_reason(self):
        course, car = self.cubic(), self.follow()
        sentences = []

        def unknown(part):
            self.assertEqual(self.track(car).kind, self.tracks.Kind.RECORDED)
            sentences.append(self.track(car).sentence)
            self.assertIn(part, sentences[-1])

        car.motus.path.influence = 0.5
        unknown("by a part alone")
        car.motus.path.influence = 1.0
        course.modifiers.new("Wave", 'SMOOTH')
        unknown("shape of Course changes")
        course.modifiers.clear()
        driver = car.motus.path.driver_add("offset")
        driver.driver.expression = "frame"
        unknown("driver")
        car.motus.path.driver_remove("offset")
        self.assertSolved(car)
        other = car.constraints.new('COPY_ROTATION')
        unknown("constraint")
        car.constraints.remove(other)
        self.assertSolved(car)
        bpy.ops.motus.bake(object="Car", frame_start=1, frame_end=10)
        self.assertEqual(self.track(car).kind, self.tracks.Kind.EXACT)
        bpy.ops.motus.unbake(object="Car")
        bpy.data.objects.remove(course)
        self.assertEqual(len(self.track(car).values(FRAMES)), len(FRAMES))

    def test_what_does_not_move_is_read_and_planned_once_for_many_frames(self):
        course, solve = self.cubic(), support.addon("path.solve")
        car = self.follow()
        frames = np.arange(1.0, 60.0, 0.5)
        wanted = self.track(car).values(frames)

        def counted():
            with (
                unittest.mock.patch.object(solve.curves, "_read_bezier", wraps=solve.curves._read_bezier) as read,
                unittest.mock.patch.object(solve, "_still", wraps=solve._still) as planned,
            ):
                np.testing.assert_array_equal(self.track(car).values(frames), wanted)
            return read.call_count, planned.call_count

        self.assertEqual(counted(), (1, 1))
        for frame in (1, 60):
            course.keyframe_insert("location", frame=frame)
            self.key(car, "offset", (frame, 0.0))
        self.assertEqual(counted(), (1, len(frames)))

    def test_curve_parented_to_its_follower_is_unknown_over_time(self):
        """A curve that hangs on what follows it."""
        course, car = self.cubic(), self.follow()
        course.parent = car
        for thing in (car, course):
            self.assertIn("hangs on itself", self.track(thing).sentence)

    def test_results_are_cached_until_settings_change(self):
        course, car = self.cubic(), self.follow()
        made = []

        def ask(frame):
            self.at(car, frame)
            evaluated = car.evaluated_get(bpy.context.evaluated_depsgraph_get())
            self.tracks.kept(self.tracks.world_track(evaluated, self.scene), "test", lambda: made.append(1) or True)
            return len(made)

        self.assertEqual([ask(frame) for frame in (1, 5, 2.5)], [1, 1, 1])
        car.motus.path.duration = 2.0
        self.assertEqual(ask(4), 2)
        course.data.splines[0].bezier_points[0].co.x += 1.0
        self.assertEqual(ask(5), 3)
        course.location.x += 1.0
        self.assertEqual(ask(6), 4)
        car.motus.path.extend = 'LOOP'
        self.assertEqual(ask(7), 5)
        self.assertEqual(ask(8), 5)
