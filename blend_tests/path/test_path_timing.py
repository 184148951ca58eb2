"""Follow Path in time: ease, keyed speed, pins, ends; and the same place however a frame is reached."""

import random

import bpy
import numpy as np

import support
from path.path_cases import CLIMB, PathTestCase, circle_knots, dense, positions_at

LENGTH = 10.0


def eased(u, ease_in, ease_out):
    """Fraction of the way, from the definition: speed up, go on, slow down."""
    speeds = np.interp(
        np.linspace(0.0, 1.0, 400001),
        (0.0, max(ease_in, 1e-12), 1.0 - max(ease_out, 1e-12), 1.0),
        (0.0 if ease_in else 1.0, 1.0, 1.0, 0.0 if ease_out else 1.0),
    )
    way = np.concatenate(([0.0], np.cumsum(0.5 * (speeds[1:] + speeds[:-1]))))
    return float(np.interp(u, np.linspace(0.0, 1.0, len(way)), way / way[-1]))


def set_interpolation(car, path, interpolation):
    for key in support.addon("core.blender.actions").find(car, path).keyframe_points:
        key.interpolation = interpolation


class Straight(PathTestCase):
    """On a straight line of 10 m along X the distance can be read off the object."""

    def setUp(self):
        super().setUp()
        self.line(LENGTH)

    def assertDistance(self, car, wanted, frame=None, places=4):
        self.assertAlmostEqual(self.place(car, frame)[0], wanted, places=places, msg=f"frame {frame}")


class Duration(Straight):
    def test_constant_speed(self):
        car = self.follow(duration=4.0, start_frame=11.0)
        for frame, wanted in ((1, 0.0), (11, 0.0), (35, 2.5), (59.5, 5.0520833), (107, 10.0), (200, 10.0)):
            self.assertDistance(car, wanted, frame)

    def test_frames_a_second(self):
        self.scene.render.fps, self.scene.render.fps_base = 30, 1.001
        car = self.follow(duration=4.0, start_frame=0.0)
        self.assertDistance(car, 2.5 * 1.001, 30)

    def test_ease(self):
        for ease_in, ease_out in ((0.3, 0.2), (0.5, 0.5), (1.0, 0.0), (0.0, 0.25)):
            car = self.follow(duration=4.0, ease_in=ease_in, ease_out=ease_out)
            for frame in (7, 25, 49, 73.5, 91):
                self.assertDistance(car, LENGTH * eased((frame - 1.0) / 96.0, ease_in, ease_out), frame)

    def test_one_ease_reduces_the_other(self):
        settings = self.follow(ease_in=0.6).motus.path
        settings.ease_out = 0.7
        self.assertAlmostEqual(settings.ease_in, 0.3, places=6)
        settings.ease_in = 1.0
        self.assertEqual(settings.ease_out, 0.0)

    def test_keyed_ease_may_pass_the_limit(self):
        car = self.follow(duration=4.0)
        for name in ("ease_in", "ease_out"):
            setattr(car.motus.path, name, 0.0)
            car.keyframe_insert(f"motus.path.{name}", frame=1)
            setattr(car.motus.path, name, 0.9)
            car.keyframe_insert(f"motus.path.{name}", frame=2)
        self.assertIsNone(self.sentence(car, 49))
        self.assertDistance(car, LENGTH * eased(0.5, 0.9, 0.1), 49)

    def test_sum_of_given_eases_is_limited(self):
        settings = self.follow(ease_in=0.7, ease_out=0.3).motus.path
        for given in ({"ease_in": 0.8, "ease_out": 0.7}, {"ease_out": 0.7, "ease_in": 0.8}):
            self.assertRefused("more than 1", bpy.ops.motus.path_follow_add, object="Car", curve="Course", **given)
        self.assertAlmostEqual(settings.ease_in, 0.7, places=6)
        self.assertAlmostEqual(settings.ease_out, 0.3, places=6)

    def test_offset(self):
        car = self.follow(duration=4.0, offset=1.5)
        self.assertDistance(car, 4.0, 25)


class Ends(Straight):
    """Beyond the ends; 10 m in 4 s, at 8 s + a quarter."""

    def test_ends_stop(self):
        self.assertDistance(self.follow(duration=4.0), 10.0, 121)

    def test_ends_go_on_along_the_tangent(self):
        car = self.follow(duration=4.0, extend='EXTRAPOLATE', ease_in=0.5)
        final_speed = 10.0 / 4.0 / 0.75
        self.assertDistance(car, 10.0 + final_speed, 121)
        self.assertDistance(self.follow("Slow", duration=4.0, extend='EXTRAPOLATE', ease_out=0.5), 10.0, 121)

    def test_go_on_backwards(self):
        self.assertDistance(self.follow(timing='SPEED', speed=-2.0, extend='EXTRAPOLATE'), -4.0, 49)

    def test_ends_loop(self):
        car = self.follow(duration=4.0, extend='LOOP', ease_in=0.5, ease_out=0.2)
        for frame in (25, 121, 193 + 24):
            self.assertDistance(car, LENGTH * eased(0.25, 0.5, 0.2), frame)

    def test_ends_ping_pong(self):
        car = self.follow(duration=4.0, extend='PING_PONG', ease_in=0.5)
        self.assertDistance(car, LENGTH * (1.0 - eased(0.25, 0.5, 0.0)), 121)
        self.assertDistance(car, LENGTH * eased(0.25, 0.5, 0.0), 193 + 24)

    def test_lag_does_not_change_the_way(self):
        for extend in ('LOOP', 'PING_PONG', 'EXTRAPOLATE', 'CLAMP'):
            for ease_in, ease_out in ((0.3, 0.2), (0.3, 0.0), (0.0, 0.2), (0.0, 0.0), (0.4, 0.6)):
                keywords = {"duration": 4.0, "extend": extend, "ease_in": ease_in, "ease_out": ease_out}
                exact, lagging = self.follow("Exact", **keywords), self.follow("Lagging", lag_rate=1.0, **keywords)
                for frame in (30, 97, 110, 200, 230.5):
                    with self.subTest(extend=extend, ease=(ease_in, ease_out), frame=frame):
                        self.assertDistance(lagging, self.place(exact, frame)[0], frame)

    def test_outputs_stay_on_the_path(self):
        for extend, wanted, travelled in (('CLAMP', 10.0, 10.0), ('EXTRAPOLATE', 13.0, 13.0), ('LOOP', 3.0, 13.0), ('PING_PONG', 7.0, 7.0)):
            car = self.follow(extend, timing='MANUAL', distance_factor=1.3, extend=extend)
            self.assertAlmostEqual(self.output(car, "distance"), travelled, places=4)
            self.assertAlmostEqual(self.output(car, "fraction"), wanted / 10.0, places=5)
            self.assertAlmostEqual(self.output(car, "parameter"), min(wanted, 10.0) / 10.0, places=5)
            self.assertDistance(car, wanted)

    def test_distance_grows_over_the_seam(self):
        """Whatever the timing: on a loop of 10 m at 5 m/s, which begins anew every two seconds, forwards and backwards."""
        ways = {
            "Speed": {"timing": 'SPEED', "speed": 5.0},
            "Back": {"timing": 'SPEED', "speed": -5.0},
            "Duration": {"timing": 'DURATION', "duration": 2.0},
            "Keyed": {"timing": 'SPEED', "speed": 5.0},
            "Ahead": {"timing": 'SPEED', "speed": 5.0, "offset": 4.0},
        }
        for name, keywords in ways.items():
            car = self.follow(name, extend='LOOP', **keywords)
            if name == "Keyed":
                car.keyframe_insert("motus.path.speed", frame=1)
            start, way = keywords.get("offset", 0.0), -5.0 if name == "Back" else 5.0
            for frame in (1, 48.5, 49, 50, 97, 300, 5000):
                with self.subTest(name, frame=frame):
                    wanted = start + way * (frame - 1) / 24
                    self.assertAlmostEqual(self.output(car, "distance", frame), wanted, delta=1e-6 * max(1.0, abs(wanted)))
                    off = self.output(car, "fraction", frame) - wanted / LENGTH
                    self.assertAlmostEqual(off, round(off), places=5)


class Speed(Straight):
    def test_constant(self):
        car = self.follow(timing='SPEED', speed=2.0, start_frame=25.0)
        for frame, wanted in ((1, 0.0), (25, 0.0), (49, 2.0), (61, 3.0)):
            self.assertDistance(car, wanted, frame)
        self.assertAlmostEqual(self.output(car, "speed"), 2.0, places=6)

    def keyed(self, values, interpolation='LINEAR', **keywords):
        car = self.follow(timing='SPEED', extend='EXTRAPOLATE', **keywords)
        for frame, value in values:
            car.motus.path.speed = value
            car.keyframe_insert("motus.path.speed", frame=frame)
        set_interpolation(car, "motus.path.speed", interpolation)
        return car

    def test_keyed_speed_is_integrated(self):
        car = self.keyed([(1, 0.0), (25, 4.0), (49, 4.0), (73, 0.0)])
        for frame, wanted in ((13, 0.5), (25, 2.0), (49, 6.0), (61, 7.5), (73, 8.0), (500, 8.0)):
            self.assertDistance(car, wanted, frame)

    def test_stepped_speed(self):
        car = self.keyed([(1, 1.0), (25, 3.0)], 'CONSTANT')
        self.assertDistance(car, 1.0, 25, places=3)
        self.assertDistance(car, 4.0, 49, places=3)

    def test_start_after_the_first_key(self):
        car = self.keyed([(1, 0.0), (25, 4.0), (49, 4.0)], start_frame=13.0)
        self.assertDistance(car, 1.5, 25)

    def test_backwards(self):
        car = self.keyed([(1, 4.0), (25, -4.0)])
        self.assertDistance(car, 1.0, 13)
        self.assertDistance(car, 0.0, 25)

    def test_driven_speed_is_said(self):
        car = self.follow(timing='SPEED', start_frame=1.0)
        car.motus.path.driver_add("speed").driver.expression = "3.0"
        self.assertIn("driven", self.sentence(car, 25))
        self.assertDistance(car, 3.0, 25)


class Pins(Straight):
    def pinned(self, pins, **keywords):
        car = self.follow(timing='PINS', **keywords)
        for frame, value in pins:
            pin = car.motus.path.pins.add()
            pin.frame = frame
            pin.fraction = pin.distance = value
        car.update_tag()
        return car

    def test_pin_is_added_at_the_present_place_and_frame(self):
        pins = [(40.5, 0.7), (10, 0.2), (60, 0.7), (80, 1.0)]
        car = self.pinned(pins)
        for frame, fraction in pins:
            self.assertDistance(car, LENGTH * fraction, frame)
        self.assertDistance(car, 7.0, 50)  # equal pins: it rests
        self.assertDistance(car, 2.0, 1)
        places = [self.place(car, frame)[0] for frame in np.arange(10, 40.5, 0.5)]
        self.assertTrue((np.diff(places) > 0.0).all(), "it never turns back between rising pins")

    def test_distances(self):
        car = self.pinned([(10, 2.5), (30, 9.0)], pins_by='DISTANCE')
        self.assertDistance(car, 9.0, 30)

    def test_problems_are_said(self):
        self.assertIn("Add a pin", self.sentence(self.pinned([])))

    def test_of_two_pins_on_one_frame_the_later_one_counts(self):
        car = self.pinned([(5, 0.1), (15, 0.5), (5, 0.9)])
        self.assertIn("same frame", self.sentence(car, 5))
        self.assertDistance(car, 9.0, 5)
        self.assertDistance(car, 5.0, 15)
        car.motus.path.pins[2].frame = 25
        self.assertIsNone(self.sentence(car, 5))
        self.assertDistance(car, 1.0, 5)

    def test_adding_on_a_frame_replaces_its_pins(self):
        car = self.pinned([(5, 0.1), (15, 0.5), (5, 0.9)])
        bpy.ops.motus.path_pin_add(object="Car", frame=5.0, fraction=0.3)
        settings = car.motus.path
        self.assertEqual([(pin.frame, round(pin.fraction, 6)) for pin in settings.pins], [(15.0, 0.5), (5.0, 0.3)])
        self.assertEqual(settings.active_pin, 1)
        self.assertDistance(car, 3.0, 5)

    def test_operators(self):
        car = self.follow(duration=4.0)
        bpy.ops.motus.path_pin_add(object="Car", frame=60.0, fraction=1.0)
        self.scene.frame_set(25)
        self.assertEqual(car.motus.path.timing, 'PINS')
        car.motus.path.timing = 'DURATION'
        self.assertDistance(car, 2.5, 25)
        bpy.ops.motus.path_pin_add(object="Car")
        self.assertAlmostEqual(car.motus.path.pins[1].fraction, 0.25, places=5)
        self.assertAlmostEqual(car.motus.path.pins[1].distance, 2.5, places=4)
        self.assertEqual(car.motus.path.pins[1].frame, 25.0)
        self.assertDistance(car, 2.5, 25)
        bpy.ops.motus.path_pin_remove(object="Car", index=1)
        self.assertDistance(car, 10.0, 25)
        self.assertRefused("no such pin", bpy.ops.motus.path_pin_remove, object="Car", index=1)


class AnyOrder(PathTestCase):
    """A frame is the same to the last bit however it is reached."""

    FRAMES = [1, 2, 17, 33.25, 48, 77.5, 120, 121, 180]

    def follower(self, **keywords):
        self.bezier(circle_knots(), cyclic=True)
        car = self.follow(orientation='BANKING', extend='LOOP', **keywords)
        for frame, value in ((1, 1.0), (40, 9.0), (90, 3.0)):
            car.motus.path.speed = value
            car.keyframe_insert("motus.path.speed", frame=frame)
        return car

    def assertAnyOrder(self, car):
        alone = {frame: self.at(car, frame) for frame in self.FRAMES}
        shuffled = self.FRAMES * 2
        random.Random(4).shuffle(shuffled)
        for frame in shuffled + self.FRAMES[::-1]:
            self.assertEqual(self.at(car, frame), alone[frame], f"frame {frame}")
        for frame in range(1, 181):
            played = self.at(car, frame)
            if frame in alone:
                self.assertEqual(played, alone[frame], f"frame {frame}, played")

    def test_keyed_speed(self):
        self.assertAnyOrder(self.follower(timing='SPEED'))

    def test_lag(self):
        self.assertAnyOrder(self.follower(timing='SPEED', lag_rate=0.5))

    def test_eased_laps(self):
        self.assertAnyOrder(self.follower(duration=1.7, ease_in=0.2, ease_out=0.3, lag_rate=0.5))


class ByHand(PathTestCase):
    def test_keyed_fraction_is_exact_and_banks(self):
        self.bezier(circle_knots(20.0), cyclic=True)
        car = self.follow(timing='MANUAL', orientation='BANKING')
        for frame, value in ((1, 0.0), (241, 1.0)):
            car.motus.path.distance_factor = value
            car.keyframe_insert("motus.path.distance_factor", frame=frame)
        set_interpolation(car, "motus.path.distance_factor", 'LINEAR')
        self.assertAlmostEqual(self.output(car, "speed", 121), self.output(car, "length") / 10.0, places=2)
        self.assertAlmostEqual(self.output(car, "fraction", 121), 0.5, places=5)
        before = self.at(car, 121)
        car.motus.path.bank_strength = 0.0
        self.assertNotEqual(self.at(car, 121), before)

    def test_lag_keeps_the_place(self):
        self.cubic()
        car = self.follow(timing='MANUAL', orientation='MINIMAL', lag_rate=1.0)
        for frame, value in ((1, 0.0), (49, 1.0)):
            car.motus.path.distance_factor = value
            car.keyframe_insert("motus.path.distance_factor", frame=frame)
        set_interpolation(car, "motus.path.distance_factor", 'LINEAR')
        self.assertPlace(car, positions_at(dense(CLIMB), 0.5)[0], 25)
