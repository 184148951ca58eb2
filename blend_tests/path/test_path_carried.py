"""What stands between a path and its followers: bogies, a place beside the path, gaps by time, a rail, and the path's own space."""

import math

import bpy
import mathutils
import numpy as np

import support
from path.path_cases import PathTestCase, add_bezier, axis, circle_knots, dense_knots, positions_at

RADIUS = 20.0
HANDLE_ERROR = 3e-4  # of the radius: a circle of four cubic segments is no exact one


class Carried(PathTestCase):
    def setUp(self):
        super().setUp()
        self.bezier(circle_knots(RADIUS), cyclic=True)

    def angle_at(self, obj, frame=None):
        place = self.place(obj, frame)
        return math.atan2(place[1], place[0])

    def test_a_wagon_cuts_the_circle_as_its_chord_does(self):
        car = self.follow(timing='SPEED', speed=3.0, wheelbase=12.0)
        points = dense_knots(circle_knots(RADIUS), cyclic=True)
        for frame in (1, 30, 77.5, 500):
            matrix = self.at(car, frame)
            forward = axis(matrix, "Y")
            for bogie in (6.0, -6.0):
                gap = np.linalg.norm(points - (np.array(matrix.translation) + bogie * forward), axis=1).min()
                self.assertLess(gap, 3e-4)  # the points are that far apart
            self.assertAlmostEqual(matrix.translation.length, math.sqrt(RADIUS**2 - 36.0), delta=HANDLE_ERROR * RADIUS)

    def test_wagons_of_a_train_have_wheelbases_of_their_own(self):
        for name in ("Loco", "First", "Second"):
            self.link(name)
        bpy.ops.motus.path_train_add(objects="Loco,First,Second", curve="Course", gap=8.0, wheelbase=4.0, timing='SPEED', speed=3.0)
        settings = bpy.data.objects["Loco"].motus.path
        self.assertEqual([round(one.wheelbase, 5) for one in settings.wagons], [4.0, 4.0])
        settings.wagons[1].wheelbase = 10.0
        for name, wheelbase in (("Loco", 4.0), ("First", 4.0), ("Second", 10.0)):
            found = self.at(bpy.data.objects[name], 300).translation.length
            self.assertAlmostEqual(found, math.sqrt(RADIUS**2 - wheelbase**2 / 4.0), delta=HANDLE_ERROR * RADIUS)
        settings.wheelbase_of_all = 6.0
        self.assertEqual([settings.wheelbase, *(one.wheelbase for one in settings.wagons)], [6.0] * 3)
        # A wagon takes its wheelbase along in the train, the gaps stay with their places.
        settings.wagons[1].wheelbase, settings.wagons[1].gap = 10.0, 9.0
        bpy.ops.motus.path_wagon_move(object="Loco", index=1, direction='UP')
        self.assertEqual(
            [(one.object.name, one.gap, one.wheelbase) for one in settings.wagons], [("Second", 8.0, 10.0), ("First", 9.0, 6.0)]
        )

    def test_side_and_height_are_across_the_path_and_the_speed_is_the_paths(self):
        car = self.follow(timing='SPEED', speed=10.0, side=2.0, height=1.0)
        for frame in (1, 25, 61.5):
            place = self.place(car, frame)
            self.assertAlmostEqual(float(np.hypot(*place[:2])), RADIUS + 2.0, delta=2.0 * HANDLE_ERROR * RADIUS)
            self.assertAlmostEqual(place[2], 1.0, places=5)
            self.assertAlmostEqual(self.angle_at(car) % math.tau, (10.0 * (frame - 1.0) / 24.0 / RADIUS) % math.tau, delta=1e-3)

    def test_side_leans_along_or_stays_level(self):
        car = self.follow(timing='SPEED', speed=10.0, orientation='BANKING', side=2.0, extend='LOOP')
        lean = math.atan(100.0 / (RADIUS * 9.81))
        self.assertAlmostEqual(self.place(car, 40)[2], 2.0 * math.sin(lean), delta=0.02)
        car.motus.path.side_by = 'LEVEL'
        self.assertAlmostEqual(self.place(car, 40)[2], 0.0, places=5)
        car.motus.path.orientation = 'NONE'
        self.assertAlmostEqual(float(np.hypot(*self.place(car, 40)[:2])), RADIUS + 2.0, delta=2.0 * HANDLE_ERROR * RADIUS)

    def test_keys_of_side_move_a_follower_from_lane_to_lane(self):
        car = self.follow(timing='SPEED', speed=1.0)
        for frame, side in ((1, -1.0), (41, 3.0)):
            car.motus.path.side = side
            car.keyframe_insert("motus.path.side", frame=frame)
        for frame, side in ((1, -1.0), (21, 1.0), (41, 3.0)):
            self.assertAlmostEqual(float(np.hypot(*self.place(car, frame)[:2])), RADIUS + side, delta=2.0 * HANDLE_ERROR * RADIUS)

    def test_all_together_share_a_hub_and_give_the_same_bits_as_alone(self):
        keywords = {
            "timing": 'SPEED',
            "speed": 4.0,
            "orientation": 'BANKING',
            "side": 1.0,
            "wheelbase": 3.0,
            "space": 'PATH',
            "extend": 'LOOP',
        }
        alone = self.follow("Alone", **keywords)
        found = [np.array(self.at(alone, frame)) for frame in (1, 33, 70.5)]
        for index in range(2):
            self.follow(f"Car {index}", **(keywords | {"space": ('WORLD', 'PATH')[index]}))
        self.assertTrue(support.addon("core.wiring.hubs.sharing").has_rows(alone.motus.path.hub.data))
        for frame, wanted in zip((1, 33, 70.5), found):
            np.testing.assert_array_equal(np.array(self.at(alone, frame)), wanted)
            np.testing.assert_array_equal(np.array(self.at(bpy.data.objects["Car 1"], frame)), wanted)


class GapsByTime(PathTestCase):
    TIMINGS = (
        {"timing": 'DURATION', "duration": 5.0, "ease_in": 0.3, "ease_out": 0.2},
        {"timing": 'SPEED', "speed": 2.0},
        {"timing": 'MANUAL'},
        {"timing": 'DISTANCE'},
        {"timing": 'PLACES'},
    )

    def train(self, **keywords):
        for name in ("Lead", "Second", "Third"):
            if name not in bpy.data.objects:
                self.link(name)
        bpy.ops.motus.path_train_add(objects="Lead,Second,Third", curve="Course", gaps_by='TIME', delay=0.75, **keywords)
        return [bpy.data.objects[name] for name in ("Lead", "Second", "Third")]

    def key(self, obj, name, *keys):
        for frame, value in keys:
            setattr(obj.motus.path, name, value)
            obj.keyframe_insert(f"motus.path.{name}", frame=frame)

    def assertFollowByTime(self, train, tolerance=1e-5):
        for frame in (1, 20, 41.25, 70, 140):
            found = [self.place(obj, frame) for obj in train]
            for index, place in enumerate(found):
                before = self.place(train[0], frame - 18.0 * index)
                self.assertLess(np.abs(place - before).max(), tolerance, f"{train[index].name} at {frame}")

    def test_wagons_are_where_the_leader_was(self):
        self.cubic()
        for keywords in self.TIMINGS:
            with self.subTest(**keywords):
                train = self.train(**keywords)
                if keywords["timing"] == 'PLACES':
                    bpy.ops.motus.path_speed_add(object="Lead", distance=0.0, speed=1.0)
                    bpy.ops.motus.path_speed_add(object="Lead", distance=8.0, speed=4.0)
                for timing, name, keys in (
                    ('MANUAL', "distance_factor", ((10, 0.0), (60, 0.9), (100, 0.4))),
                    ('DISTANCE', "distance", ((10, 1.0), (60, 12.0), (100, 5.0))),
                ):
                    if keywords["timing"] == timing:
                        self.key(train[0], name, *keys)
                self.assertFollowByTime(train)
                bpy.ops.motus.path_follow_remove(object="Lead")

    def test_keyed_speed_and_a_lag(self):
        self.cubic()
        train = self.train(timing='SPEED', lag_rate=0.5)
        self.key(train[0], "speed", (1, 0.5), (40, 6.0), (80, 1.0))
        self.assertFollowByTime(train)

    def test_a_frame_alone_is_that_of_playback_to_the_bit(self):
        self.cubic()
        train = self.train(timing='DISTANCE', wheelbase=1.0, side=0.5, lag_rate=0.3)
        self.key(train[0], "distance", (1, 0.0), (40, 9.0), (80, 3.0))
        played = {frame: [np.array(self.at(obj, frame)) for obj in train] for frame in range(1, 50)}
        for frame in (33, 2, 49, 17):
            self.go_to(90)
            for obj, wanted in zip(train, played[frame]):
                np.testing.assert_array_equal(np.array(self.at(obj, frame)), wanted)

    def test_a_driven_fraction_has_no_past_which_is_said(self):
        self.cubic()
        train = self.train(timing='MANUAL')
        train[0].motus.path.driver_add("distance_factor").driver.expression = "frame / 100"
        self.assertIn("past is not known", self.sentence(train[0], 20))

    def test_delays_are_those_of_the_list(self):
        self.line(20.0)
        train = self.train(timing='SPEED', speed=2.0)
        settings = train[0].motus.path
        settings.wagons[1].delay = 2.0
        self.assertAlmostEqual(self.place(train[2], 121)[0], 2.0 * (5.0 - 2.75), places=5)
        settings.delay_of_all = 0.5
        self.assertAlmostEqual(self.place(train[2], 121)[0], 2.0 * (5.0 - 1.0), places=5)
        bpy.ops.motus.path_wagon_remove(object="Lead", index=0)
        self.assertAlmostEqual(self.place(train[2], 121)[0], 2.0 * (5.0 - 1.0), places=5)


class Metres(PathTestCase):
    def test_a_keyed_distance_is_in_metres(self):
        self.line(20.0)
        car = self.follow(timing='DISTANCE')
        for frame, metres in ((1, 0.0), (49, 12.0)):
            car.motus.path.distance = metres
            car.keyframe_insert("motus.path.distance", frame=frame)
        self.assertPlace(car, np.array((12.0, 0.0, 0.0)), 49)
        self.assertPlace(car, np.array((6.0, 0.0, 0.0)), 25, 1e-5)
        # A longer path changes nothing.
        bpy.data.objects["Course"].scale.x = 2.0
        self.assertPlace(car, np.array((12.0, 0.0, 0.0)), 49)

    def test_speeds_by_place_solve_the_way(self):
        self.line(40.0)
        car = self.follow(timing='PLACES', start_frame=1.0)
        self.assertIn("Add a speed", self.sentence(car))
        for place, speed in ((0.0, 2.0), (10.0, 2.0), (20.0, 6.0)):
            bpy.ops.motus.path_speed_add(object="Car", distance=place, speed=speed)
        self.assertIsNone(self.sentence(car))
        # ds/dt = 2 + 0.4 (s - 10) from 10 m on: s = 10 + 5 (e^(0.4 t) - 1).
        for seconds in (1.0, 5.0, 6.5):
            wanted = 2.0 * seconds if seconds <= 5.0 else 10.0 + 5.0 * (math.exp(0.4 * (seconds - 5.0)) - 1.0)
            self.assertPlace(car, np.array((wanted, 0.0, 0.0)), 1.0 + 24.0 * seconds, 1e-6)
        car.motus.path.offset = 10.0
        self.assertPlace(car, np.array((10.0 + 5.0 * (math.exp(0.4) - 1.0), 0.0, 0.0)), 25, 1e-6)

    def test_speeds_come_again_each_lap(self):
        self.line(20.0)
        for extend, period in (('LOOP', 1), ('PING_PONG', 2)):
            car = self.follow(timing='PLACES', start_frame=1.0, extend=extend)
            car.motus.path.speeds.clear()
            for place, speed in ((0.0, 2.0), (10.0, 8.0), (20.0, 2.0)):
                bpy.ops.motus.path_speed_add(object="Car", distance=place, speed=speed)
            # Half a lap at a speed from 2 to 8: ln(4) / 0.6 seconds.
            lap = period * 2.0 * math.log(4.0) / 0.6
            for frame in (5, 30, 61.5):
                wanted = self.place(car, frame)
                self.assertPlace(car, wanted, frame + 24.0 * 3.0 * lap, 1e-5)

    def test_a_speed_on_a_later_lap(self):
        """Added where the object is; given beyond the path it is left out, and told of."""
        self.line(20.0)
        for extend, frames in (('LOOP', 240.0), ('PING_PONG', 204.0)):
            with self.subTest(extend=extend):
                car = self.follow(timing='SPEED', speed=3.0, start_frame=1.0, extend=extend)
                car.motus.path.speeds.clear()
                place = self.place(car, 1.0 + frames)[0]
                self.assertEqual(bpy.ops.motus.path_speed_add(object="Car", speed=5.0), {'FINISHED'})
                self.assertAlmostEqual(car.motus.path.speeds[0].distance, place, places=4)
                self.assertIsNone(self.sentence(car))
                bpy.ops.motus.path_speed_add(object="Car", distance=20.5, speed=1.0)
                self.assertIn("left out", self.sentence(car))
                wanted = self.place(car, 30)
                car.motus.path.speeds.remove(1)
                self.assertPlace(car, wanted, 30)

    def test_speeds_from_bends(self):
        self.bezier(circle_knots(20.0), cyclic=True)
        car = self.follow(extend='LOOP')
        bpy.ops.motus.path_speeds_from_bends(object="Car", top_speed=30.0, sideways=5.0, braking=3.0)
        speeds = [one.speed for one in car.motus.path.speeds]
        self.assertEqual(car.motus.path.timing, 'PLACES')
        for speed in speeds:
            self.assertAlmostEqual(speed, math.sqrt(5.0 * 20.0), delta=0.6)  # the list stays within 2 % of the top speed
        self.assertEqual(bpy.ops.motus.path_speeds_from_bends(object="Car", top_speed=4.0), {'FINISHED'})
        self.assertEqual([round(one.speed, 5) for one in car.motus.path.speeds], [4.0, 4.0])

    def test_braking_before_a_bend_is_even(self):
        bends = support.addon("path.bends")
        native = support.addon("core.native").module
        line, turn = np.linspace((0.0, 0.0, 0.0), (60.0, 0.0, 0.0), 4), 5.0 * 4.0 / 3.0 * (math.sqrt(2.0) - 1.0)
        arc = np.array([(60.0, 0.0, 0.0), (60.0 + turn, 0.0, 0.0), (65.0, 5.0 - turn, 0.0), (65.0, 5.0, 0.0)])
        places, speeds = bends.speeds_in_bends(native.Chain(np.array([line, arc]), False), 10.0, 5.0, 1.0)
        for place in (20.0, 45.0, 55.0, 59.0):
            wanted = min(10.0, math.sqrt(25.0 + 2.0 * (60.0 - place)))
            self.assertAlmostEqual(float(np.interp(place, places, speeds)), wanted, delta=0.25)

    def test_what_cannot_be_is_refused(self):
        self.line(20.0)
        self.follow()
        self.assertRefused("no such speed", bpy.ops.motus.path_speed_remove, object="Car", index=3)


class Rails(PathTestCase):
    def setUp(self):
        super().setUp()
        self.bezier(circle_knots(10.0), cyclic=True)
        rail = self.bezier(circle_knots(12.0), "Outer", cyclic=True)
        rail.location.z = 1.0

    def test_the_follower_banks_as_the_rails_say(self):
        # Seen along the anticlockwise path the wider circle lies to the right.
        car = self.follow(timing='SPEED', speed=2.0, orientation='RAIL', rail="Outer", rail_side='RIGHT', extend='LOOP')
        for by in ('SHARE', 'NEAREST'):
            car.motus.path.rail_by = by
            for frame in (1, 31, 100.5):
                matrix = self.at(car, frame)
                out = np.array(matrix.translation) / matrix.translation.length
                wanted = (2.0 * out + np.array((0.0, 0.0, 1.0))) / math.sqrt(5.0)
                self.assertLess(np.abs(axis(matrix, "X") - wanted).max(), 2e-3)
        car.motus.path.rail_side = 'ABOVE'
        self.assertLess(np.abs(axis(self.at(car), "Z") - wanted).max(), 2e-3)

    def test_a_rail_that_moves_turns_the_follower(self):
        car = self.follow(timing='MANUAL', orientation='RAIL', rail="Outer")
        rail = bpy.data.objects["Outer"]
        for frame, height in ((1, 1.0), (20, 5.0)):
            rail.location.z = height
            rail.keyframe_insert("location", frame=frame)
        for frame, height in ((1, 1.0), (20, 5.0), (1, 1.0)):
            wanted = np.array((2.0, 0.0, height)) / math.hypot(2.0, height)
            self.assertLess(np.abs(axis(self.at(car, frame), "Z") - wanted).max(), 2e-3)

    def test_a_hooked_rail_is_deformed_before_it_is_read(self):
        rail, hook = bpy.data.objects["Outer"], self.link("Hook")
        modifier = rail.modifiers.new("Hook", 'HOOK')
        modifier.object, modifier.strength = hook, 1.0
        modifier.vertex_indices_set(range(12))
        car = self.follow(timing='MANUAL', orientation='RAIL', rail="Outer")
        for frame, height in ((1, 1.0), (20, 4.0)):
            hook.location.z = height
            hook.keyframe_insert("location", frame=frame)
        for frame, height in ((20, 4.0), (1, 1.0), (20, 4.0)):
            wanted = np.array((2.0, 0.0, height)) / math.hypot(2.0, height)
            self.assertLess(np.abs(axis(self.at(car, frame), "Z") - wanted).max(), 2e-3)

    def test_both_rails_may_be_splines_of_one_curve(self):
        add_bezier(bpy.data.objects["Course"].data, circle_knots(12.0), cyclic=True)
        car = self.follow(timing='MANUAL', orientation='RAIL', rail="Course", rail_spline=1, rail_side='RIGHT')
        self.assertLess(np.abs(axis(self.at(car), "X") - np.array((1.0, 0.0, 0.0))).max(), 1e-5)

    def test_a_missing_rail_is_said(self):
        car = self.follow(orientation='RAIL')
        self.assertEqual(self.sentence(car), "Choose the curve that is the rail")
        self.assertPlace(car, np.zeros(3))
        car.motus.path.rail = bpy.data.objects["Outer"]
        self.assertIsNone(self.sentence(car))
        bpy.data.objects["Outer"].data.splines.clear()
        self.assertEqual(self.sentence(car), "The curve has no splines")

    def test_removing_leaves_nothing(self):
        car = self.follow(orientation='RAIL', rail="Outer", wheelbase=2.0, side=1.0)
        bpy.ops.motus.path_follow_remove(object="Car")
        self.assertFalse(car.is_property_set("motus"))
        self.assertPlace(car, np.zeros(3))


class Spaces(PathTestCase):
    def setUp(self):
        super().setUp()
        self.deck = self.bezier(circle_knots(10.0), "Deck", cyclic=True)
        self.deck.rotation_euler = 0.5, 0.0, 0.3
        self.deck.location = 3.0, 4.0, 5.0
        self.deck.scale = 2.0, 2.0, 2.0

    def test_up_is_the_curves_own_or_the_worlds(self):
        car = self.follow(curve="Deck", timing='SPEED', speed=2.0, extend='LOOP', space='PATH')
        deck_up = axis(self.at(self.deck), "Z")
        for frame in (1, 50, 120.5):
            self.assertLess(np.abs(axis(self.at(car, frame), "Z") - deck_up).max(), 1e-5)
        car.motus.path.space = 'WORLD'
        self.assertGreater(np.abs(axis(self.at(car), "Z") - deck_up).max(), 0.1)

    def test_the_place_is_the_same_in_both(self):
        car, other = (self.follow(f"In {space}", curve="Deck", timing='SPEED', speed=3.0, space=space) for space in ('PATH', 'WORLD'))
        for frame in (1, 50, 120.5):
            self.assertLess(np.abs(self.place(car, frame) - self.place(other, frame)).max(), 2e-5)

    def test_the_bank_of_a_rolling_ship_rolls_along(self):
        """In the path's space a follower stands on a moved deck as it stands on one that was never moved."""
        keywords = {"timing": 'SPEED', "speed": 6.0, "orientation": 'BANKING', "extend": 'LOOP'}
        still = self.bezier(circle_knots(20.0), "Still", cyclic=True)
        on_still, on_deck = (
            self.follow("On Still", curve=still.name, **keywords),
            self.follow("On Deck", curve="Deck", space='PATH', **keywords),
        )
        for frame, roll in ((1, 0.0), (60, 0.7)):
            self.deck.rotation_euler.x = roll
            self.deck.keyframe_insert("rotation_euler", frame=frame)
        for frame in (1, 30.5, 60):
            deck = self.at(self.deck, frame)
            space = mathutils.Matrix.LocRotScale(*deck.decompose()[:2], None)
            wanted = space @ self.at(on_still)
            self.assertLess(np.abs(np.array(wanted) - np.array(self.at(on_deck))).max(), 5e-5)

    def test_over_time(self):
        tracks = support.addon("core.tracks")
        rail = self.bezier(circle_knots(12.0), "Outer", cyclic=True)
        rail.rotation_euler, rail.location = self.deck.rotation_euler, self.deck.location + mathutils.Vector((0.0, 0.0, 3.0))
        for space in ('PATH', 'WORLD'):
            car = self.follow(
                curve="Deck", timing='SPEED', speed=2.0, orientation='RAIL', rail="Outer", space=space, wheelbase=2.0, side=1.0
            )
            track, frames = tracks.world_track(car, self.scene), (1.0, 13.5, 60.0)
            wanted = np.array([np.array(self.at(car, frame)) for frame in frames])
            self.assertEqual(track.kind, tracks.Kind.SOLVED, track.sentence)
            self.assertLess(np.abs(track.values(frames) - wanted).max(), 5e-5)


class Baked(PathTestCase):
    def test_what_is_baked_stands_where_it_stood(self):
        self.bezier(circle_knots(10.0), cyclic=True)
        car = self.follow(timing='SPEED', speed=3.0, wheelbase=4.0, side=1.0, extend='LOOP')
        wanted = {frame: np.array(self.at(car, frame)) for frame in (1, 12, 24)}
        bpy.ops.motus.bake(object="Car", frame_start=1, frame_end=24)
        for frame, matrix in wanted.items():
            self.assertLess(np.abs(np.array(self.at(car, frame)) - matrix).max(), 1e-4)
        bpy.ops.motus.unbake(object="Car")
        for frame, matrix in wanted.items():
            np.testing.assert_array_equal(np.array(self.at(car, frame)), matrix)

    def test_positions_of_a_plain_follower_are_as_before(self):
        self.bezier(circle_knots(10.0), cyclic=True)
        car = self.follow(timing='MANUAL', distance_factor=0.3)
        (wanted,) = positions_at(dense_knots(circle_knots(10.0), cyclic=True), 0.3)
        self.assertPlace(car, wanted, tolerance=1e-6)
