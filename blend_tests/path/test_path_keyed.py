"""Follow Path by a keyed speed: the distance is the integral of what Blender's F-curve says."""

import itertools
import time
import tracemalloc

import bpy
import numpy as np

import support
from path.path_cases import PathTestCase, circle_knots

LENGTH = 1e4
STEPS = 400  # per frame, of the independent integral


def integral(curve, first, last, jumps=()):
    """Trapezoids between the jumps, in frames times the value."""
    edges = [first, *(jump for jump in sorted(jumps) if first < jump < last), last]
    total = 0.0
    for start, end in itertools.pairwise(edges):
        # Not at the jumps themselves, where the F-curve is already on its other side.
        count = max(2, round((end - start) * STEPS))
        middles = start + (np.arange(count) + 0.5) * (end - start) / count
        total += (end - start) * np.mean([curve.evaluate(frame) for frame in middles])
    return total


class KeyedCase(PathTestCase):
    def setUp(self):
        super().setUp()
        self.line(LENGTH)

    def keyed(self, values, interpolation, **keywords):
        car = self.follow(timing='SPEED', extend='EXTRAPOLATE', **keywords)
        for frame, value in values:
            car.motus.path.speed = value
            car.keyframe_insert("motus.path.speed", frame=frame)
        self.curve = support.addon("core.blender.actions").find(car, "motus.path.speed")
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


class KeyedSpeed(KeyedCase):
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

    def test_cycles_modifier_repeats_keyed_speed(self):
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

    def test_far_frames_of_keyed_speed_cost_little(self):
        car = self.keyed([(1 + 25 * index, 3.0 + index % 4) for index in range(11)], 'BEZIER')
        curve = support.addon("path.keyed").find(car, car.motus.path, "speed")
        keys = support.addon("core.animation.keys")
        best = min(_seconds(lambda: keys.integral(curve, 1.0, 251.0)) for _ in range(20))
        self.assertLess(best, 2e-3, "an order of magnitude above what it should take")
        print(f"250 frames of a keyed speed: {best * 1e3:.3f} ms")


class Counted:
    """An F-curve that counts how often it is evaluated."""

    def __init__(self, curve):
        self._curve, self.evaluations = curve, 0

    def __getattr__(self, name):
        return getattr(self._curve, name)

    def evaluate(self, frame):
        self.evaluations += 1
        return self._curve.evaluate(frame)


class FarStart(KeyedCase):
    """A start, a key or an end that lies a million frames away is no more work than one nearby."""

    MOST = 40_000  # evaluations for a frame; three million of them took five seconds

    def counted(self, call):
        """The result of call(F-curve), which has not evaluated it too often."""
        curve = Counted(self.curve)
        result = call(curve)
        self.assertLess(curve.evaluations, self.MOST)
        return result

    def integral_from(self, first, last):
        return self.counted(lambda curve: support.addon("core.animation.keys").integral(curve, first, last))

    def cyclic(self, before, after, count=0):
        self.keyed([(10.0, 2.0), (14.25, 30.0), (20.0, 5.0)], 'BEZIER')
        modifier = self.curve.modifiers.new('CYCLES')
        modifier.mode_before, modifier.mode_after = before, after
        modifier.cycles_before = modifier.cycles_after = count
        return modifier

    def test_linear_extrapolation(self):
        car = self.keyed([(1, 2.0), (11, 3.0)], 'LINEAR', start_frame=-1e6)
        self.curve.extrapolation = 'LINEAR'
        for now in (-999.0, 6.5, 400.0, 1e6):
            wanted = 0.5 * ((1.9 + 0.1 * now) ** 2 - (1.9 - 1e5) ** 2) / 0.1
            found = self.integral_from(-1e6, now)
            self.assertLess(abs(found - wanted), 1e-6 * 5e10)
        self.assertAlmostEqual(self.output(car, "distance", 400) / (self.integral_from(-1e6, 400.0) / 24.0), 1.0, places=6)

    def test_laps_equal_what_is_summed_over_them(self):
        for before, after in (('REPEAT', 'MIRROR'), ('MIRROR', 'REPEAT_OFFSET'), ('REPEAT_OFFSET', 'REPEAT'), ('NONE', 'NONE')):
            for count in (0, 2):
                for extrapolation in ('CONSTANT', 'LINEAR'):
                    self.cyclic(before, after, count)
                    self.curve.extrapolation = extrapolation
                    jumps = [10.0 + 10.0 * lap for lap in range(-9, 12)]
                    for first, last in ((10, 20), (-31.5, 10), (-63, -24.25), (12, 26), (20, 52.75), (-40, 71), (53, 66)):
                        with self.subTest(before=before, after=after, count=count, first=first, last=last):
                            wanted = integral(self.curve, first, last, jumps)
                            found = self.integral_from(float(first), float(last))
                            self.assertLess(abs(found - wanted), 2e-5 * max(abs(wanted), 100.0))
                    bpy.data.objects.remove(bpy.data.objects["Car"])

    def test_cycles_without_end(self):
        self.cyclic('REPEAT', 'MIRROR')
        lap = self.integral_from(10.0, 20.0)
        self.assertAlmostEqual(self.integral_from(10.0 - 1e6, 20.0) / lap, 100_001.0, delta=1e-6)
        self.assertAlmostEqual(self.integral_from(10.0, 10.0 + 1e6) / lap, 100_000.0, delta=1e-6)
        bpy.data.objects.remove(bpy.data.objects["Car"])
        self.cyclic('REPEAT_OFFSET', 'REPEAT_OFFSET')
        # Lap n lies n times 3 m/s above the first.
        self.assertAlmostEqual(self.integral_from(10.0 - 1e6, 10.0) / (1e5 * lap - 30.0 * 1e5 * 100_001 / 2.0), 1.0, places=9)

    def test_cycles_of_a_very_short_period(self):
        self.keyed([(1.0, 2.0), (1.25, 4.0)], 'LINEAR')
        modifier = self.curve.modifiers.new('CYCLES')
        modifier.mode_before = modifier.mode_after = 'REPEAT'
        self.assertAlmostEqual(self.integral_from(-1e6, 1e6) / (3.0 * 2e6), 1.0, places=3)
        self.curve.modifiers.new('NOISE').strength = 0.0
        self.assertTrue(np.isfinite(self.integral_from(-1e6, 1e6)))

    def test_other_modifiers(self):
        """Frame by frame near the keys, as ever; far away the mean of a noise and the slope of a line are still right."""
        self.keyed([(1, 2.0), (11, 3.0)], 'LINEAR')
        noise = self.curve.modifiers.new('NOISE')
        noise.strength, noise.scale = 1.0, 30.0
        self.assertAlmostEqual(self.integral_from(-500.0, 1500.0) / integral(self.curve, -500.0, 1500.0, range(-500, 1500)), 1.0, places=5)
        far = [self.integral_from(-1e6, now) for now in (400.0, 400.001)]
        self.assertLess(far[1] - far[0], 0.01, "the distance grows by what is between")
        self.assertGreater(far[1], far[0])
        self.curve.modifiers.remove(noise)
        line = self.curve.modifiers.new('GENERATOR')
        line.use_additive, line.coefficients = True, (0.0, 0.01)
        wanted = 2.0 * (1.0 + 9e5) + 25.0 + 0.5 * 0.01 * (11.0**2 - 9e5**2)
        self.assertAlmostEqual(self.integral_from(-9e5, 11.0) / wanted, 1.0, places=5)
        self.assertEqual(len(support.addon("core.animation.keys").bounds(self.curve, -5.0, 5.0)), 11)

    def test_keys_far_apart(self):
        for interpolation in ('LINEAR', 'SINE', 'BEZIER'):
            self.keyed([(1, 2.0), (1 + 240, 8.0)], interpolation)
            near = self.integral_from(1.0, 181.0)
            for key in self.curve.keyframe_points:
                for name in ("co", "handle_left", "handle_right"):
                    place = getattr(key, name)
                    setattr(key, name, (1.0 + 4000.0 * (place[0] - 1.0), place[1]))
            self.curve.update()
            self.assertAlmostEqual(self.integral_from(1.0, 1.0 + 4000.0 * 180.0) / near / 4000.0, 1.0, places=5)
            bpy.data.objects.remove(bpy.data.objects["Car"])

    def test_a_lag_reads_what_it_remembers(self):
        """A frame a million frames after the start of a cyclic speed; the wiring sees it, and the lag's past is the curve's."""
        car = self.keyed([(1, 3.0), (25, 9.0)], 'LINEAR', start_frame=-9e5, lag_rate=0.5)
        modifier = self.curve.modifiers.new('CYCLES')
        modifier.mode_before = modifier.mode_after = 'REPEAT'
        find, keyed = support.addon("path.keyed").find, support.addon("path.keyed")
        self.addCleanup(setattr, keyed, "find", find)
        found = []
        keyed.find = lambda *arguments: found.append(Counted(find(*arguments))) or found[-1]
        distance = self.output(car, "distance", 700)
        self.assertTrue(found)
        self.assertLess(max(curve.evaluations for curve in found), self.MOST)
        self.assertAlmostEqual(distance / (self.integral_from(-9e5, 700.0) / 24.0), 1.0, places=9)

    def test_frames_too_far_away_are_reported(self):
        car = self.keyed([(1, 3.0), (25, 9.0)], 'LINEAR', start_frame=-3e38)
        self.curve.extrapolation = 'LINEAR'
        self.assertIn("not a finite number", self.sentence(car, 30))


class ShortLoops(PathTestCase):
    def test_a_lag_on_a_short_loop_takes_no_memory(self):
        self.bezier(circle_knots(20.0), cyclic=True)
        car = self.follow(extend='LOOP', duration=0.01, ease_in=0.2, lag_rate=2.0)
        self.at(car, 2)
        tracemalloc.start()
        self.addCleanup(tracemalloc.stop)
        fraction = self.output(car, "fraction", 12001)
        self.assertLess(tracemalloc.get_traced_memory()[1], 500_000, "fifty thousand laps in tables were ten times as much")
        duration = car.motus.path.duration
        done = 500.0 % duration / duration
        trapezium = support.addon("core.native").module.ease(done, car.motus.path.ease_in, 0.0)
        self.assertAlmostEqual(fraction % 1.0, trapezium % 1.0, places=5)


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
    def test_a_key_far_away_is_no_work(self):
        """A fraction with a key a million frames ago, under a lag, which remembers two minutes."""
        self.bezier(circle_knots(20.0), cyclic=True)
        car = self.follow(timing='MANUAL', extend='LOOP', lag_rate=2.0)
        for frame, value in ((-900_000, 0.0), (1, 0.0), (25, 0.5)):
            car.motus.path.distance_factor = value
            car.keyframe_insert("motus.path.distance_factor", frame=frame)
        keyed = support.addon("path.keyed")
        self.addCleanup(setattr, keyed, "find", keyed.find)
        find, found = keyed.find, []
        keyed.find = lambda *arguments: found.append(Counted(find(*arguments))) or found[-1]
        self.assertAlmostEqual(self.output(car, "fraction", 25), 0.5, places=6)
        self.assertLess(max(curve.evaluations for curve in found), 5_000)

    def test_lag_remembers_a_jump_of_the_fraction_as_one(self):
        """A stepped fraction under a lag: what the orientation trails is the way that was gone, not one far off it."""
        self.bezier(circle_knots(20.0), cyclic=True)
        car = self.follow(timing='MANUAL', orientation='WORLD_UP')
        for frame, value in ((1, 0.0), (25, 0.25)):
            car.motus.path.distance_factor = value
            car.keyframe_insert("motus.path.distance_factor", frame=frame)
        for key in support.addon("core.blender.actions").find(car, "motus.path.distance_factor").keyframe_points:
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
