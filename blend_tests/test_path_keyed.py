"""Follow Path by a keyed speed: the distance is the integral of what Blender's F-curve says."""

import time

import bpy
import numpy as np
import support
from path_cases import PathTestCase, circle_knots

LENGTH = 1e4
STEPS = 400  # per frame, of the independent integral


def integral(curve, first, last, jumps=()):
    """Trapezoids between the jumps, in frames times the value."""
    edges = [first, *(jump for jump in sorted(jumps) if first < jump < last), last]
    total = 0.0
    for start, end in zip(edges, edges[1:]):
        # Not at the jumps themselves, where the F-curve is already on its other side.
        count = max(2, round((end - start) * STEPS))
        middles = start + (np.arange(count) + 0.5) * (end - start) / count
        total += (end - start) * np.mean([curve.evaluate(frame) for frame in middles])
    return total


class KeyedSpeed(PathTestCase):
    def setUp(self):
        super().setUp()
        self.line(LENGTH)

    def keyed(self, values, interpolation, **keywords):
        car = self.follow(timing='SPEED', extend='EXTRAPOLATE', **keywords)
        for frame, value in values:
            car.motus.path.speed = value
            car.keyframe_insert("motus.path.speed", frame=frame)
        self.curve = support.addon("core.actions").find(car, "motus.path.speed")
        for key in self.curve.keyframe_points:
            key.interpolation = interpolation
        self.curve.update()
        return car

    def assertIntegrated(self, car, frames, start=1.0, jumps=(), tolerance=1e-6):
        for frame in frames:
            wanted = integral(self.curve, start, frame, jumps) / 24.0 if frame > start else 0.0
            with self.subTest(frame=frame):
                found = self.output(car, "distance", frame)
                self.assertLessEqual(abs(found - wanted), tolerance * max(abs(wanted), 1e-3), f"{found} instead of {wanted}")

    def test_smooth_keys(self):
        for interpolation in ('SINE', 'BEZIER', 'LINEAR', 'CUBIC'):
            with self.subTest(interpolation):
                car = self.keyed([(1, 3.0), (7, 20.0), (9, 11.0), (10, 30.0), (14, 5.0), (60, 2.0)], interpolation)
                self.assertIntegrated(car, (-5, 1, 1.75, 4, 8.5, 33.3, 60, 200))

    def test_steep_handles(self):
        car = self.keyed([(1, 3.0), (25, 20.0), (49, 4.0)], 'BEZIER')
        for key in self.curve.keyframe_points:
            key.handle_left_type = key.handle_right_type = 'FREE'
            key.handle_left = key.co[0] - 20.0, key.co[1]
            key.handle_right = key.co[0] + 20.0, key.co[1]
        self.assertIntegrated(car, (6, 13, 25.5, 49))

    def test_stepped_keys_jump_at_any_sub_frame(self):
        keys = (1.0, 10.37, 10.62, 30.5)
        car = self.keyed(list(zip(keys, (4.0, 40.0, 8.0, 2.0))), 'CONSTANT')
        self.assertIntegrated(car, (5, 10.37, 10.5, 11, 30, 31, 100), jumps=keys)

    def test_cycles(self):
        keys = (1.0, 5.25, 11.5)
        car = self.keyed(list(zip(keys, (2.0, 30.0, 5.0))), 'LINEAR')
        modifier = self.curve.modifiers.new('CYCLES')
        for mode in ('REPEAT', 'MIRROR'):
            modifier.mode_before = modifier.mode_after = mode
            jumps = [key + 10.5 * lap for key in keys for lap in range(-1, 9)]
            jumps += [12.5 - key + 10.5 * lap for key in keys for lap in range(-1, 9)]
            self.assertIntegrated(car, (11.5, 12, 40, 77.25), jumps=jumps)

    def test_cycles_before_the_first_key(self):
        car = self.keyed([(100, 2.0), (110, 30.0)], 'LINEAR', start_frame=-12.0)
        modifier = self.curve.modifiers.new('CYCLES')
        modifier.mode_before = modifier.mode_after = 'REPEAT'
        self.assertIntegrated(car, (-20, 0, 57), start=-12.0, jumps=range(-20, 120, 10))

    def test_speed_before_the_start(self):
        car = self.keyed([(1, 3.0), (25, 9.0)], 'LINEAR', start_frame=9.0)
        self.assertAlmostEqual(self.output(car, "speed", 2), 5.0, places=5)
        self.assertEqual(self.output(car, "distance", 2), 0.0)
        self.assertAlmostEqual(self.output(car, "speed", 17), 7.0, places=5)

    def test_lag_does_not_change_the_way(self):
        self.keyed([(1, 3.0), (9, 20.0), (40, 4.0)], 'SINE')
        self.follow(lag_rate=1.0)
        self.assertIntegrated(bpy.data.objects["Car"], (-5, 1, 6.5, 40, 90))

    def test_muted_keys_do_not_count(self):
        car = self.keyed([(1, 3.0), (25, 9.0)], 'LINEAR')
        self.curve.mute = True
        car.motus.path.speed = 5.0
        self.assertAlmostEqual(self.output(car, "distance", 25), 5.0, places=5)

    def test_driver_comes_before_keys(self):
        car = self.keyed([(1, 3.0), (25, 9.0)], 'LINEAR')
        car.motus.path.driver_add("speed").driver.expression = "2.0"
        self.assertIn("driven", self.sentence(car, 25))
        self.assertAlmostEqual(self.place(car, 25)[0], 2.0, places=5)

    def test_cost(self):
        car = self.keyed([(1 + 25 * index, 3.0 + index % 4) for index in range(11)], 'BEZIER')
        keyed = support.addon("path.keyed")
        curve = keyed.find(car, car.motus.path, "speed")
        best = min(_seconds(lambda: keyed.samples(curve, 1.0, 251.0)) for _ in range(20))
        self.assertLess(best, 2e-3, "an order of magnitude above what it should take")
        print(f"250 frames of a keyed speed: {best * 1e3:.3f} ms")


class Strips(PathTestCase):
    """Keys that were pushed down into the NLA editor."""

    def pushed_down(self, name, keys, **keywords):
        self.bezier(circle_knots(20.0), cyclic=True)
        car = self.follow(extend='LOOP', **keywords)
        for frame, value in keys:
            setattr(car.motus.path, name, value)
            car.keyframe_insert(f"motus.path.{name}", frame=frame)
        animation = car.animation_data
        action = animation.action
        slot = getattr(animation, "action_slot", None)
        animation.action = None
        self.strip = animation.nla_tracks.new().strips.new("Keys", 1, action)
        if slot:
            self.strip.action_slot = slot
        return car

    def test_speed(self):
        car = self.pushed_down("speed", [(1, 2.0), (25, 4.0)], timing='SPEED')
        self.assertIn("NLA strips", self.sentence(car, 25))
        self.assertAlmostEqual(self.output(car, "distance", 25), 4.0, places=5)

    def test_fraction(self):
        car = self.pushed_down("distance_factor", [(1, 0.0), (25, 0.5)], timing='MANUAL')
        self.assertIn("NLA strips", self.sentence(car, 25))
        self.assertAlmostEqual(self.output(car, "fraction", 25), 0.5, places=5)

    def test_muted_strip_says_nothing(self):
        car = self.pushed_down("speed", [(1, 2.0), (25, 4.0)], timing='SPEED')
        self.strip.mute = True
        self.assertIsNone(self.sentence(car, 25))

    def test_other_settings_in_strips_do_not_matter(self):
        car = self.pushed_down("offset", [(1, 2.0), (25, 4.0)], timing='SPEED')
        self.assertIsNone(self.sentence(car, 25))

    def test_keys_above_the_strips_are_integrated(self):
        car = self.pushed_down("speed", [(1, 2.0), (25, 4.0)], timing='SPEED')
        for frame in (1, 25):
            car.motus.path.speed = 8.0
            car.keyframe_insert("motus.path.speed", frame=frame)
        self.assertIsNone(self.sentence(car, 25))
        self.assertAlmostEqual(self.output(car, "distance", 25), 8.0, places=5)


class ByHand(PathTestCase):
    def test_lag_remembers_a_jump_of_the_fraction_as_one(self):
        """A stepped fraction under a lag: what the orientation trails is the way that was gone, not one far off it."""
        self.bezier(circle_knots(20.0), cyclic=True)
        car = self.follow(timing='MANUAL', orientation='WORLD_UP')
        for frame, value in ((1, 0.0), (25, 0.25)):
            car.motus.path.distance_factor = value
            car.keyframe_insert("motus.path.distance_factor", frame=frame)
        for key in support.addon("core.actions").find(car, "motus.path.distance_factor").keyframe_points:
            key.interpolation = 'CONSTANT'
        before = self.at(car, 20)
        target = self.at(car, 60)
        self.follow(lag_rate=2.0, lag_by='CURVATURE')
        self.assertPlace(car, np.array(target.translation), 60)
        # 35 frames at a rate of 2 / 20 m: exp(-0.146) of the quarter turn is still to go.
        to_go = self.at(car, 60).to_quaternion().rotation_difference(target.to_quaternion()).angle
        whole = before.to_quaternion().rotation_difference(target.to_quaternion()).angle
        self.assertAlmostEqual(to_go / whole, np.exp(-35.0 / 24.0 * 0.1), delta=0.02)


def _seconds(call):
    started = time.thread_time()
    call()
    return time.thread_time() - started
