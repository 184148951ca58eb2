"""Keyed rates, the snow's own time, loops without a seam, flakes that follow the emitter, and what its scale and velocity do."""

import bpy
import numpy as np

import support
from snow.snow_cases import MANY, OFF_THE_FRAMES, SnowTestCase, flakes, native, seconds, state
from support import go_to, key_places

PLAIN = {"start_speed": 0.7, "emitter_radius": 2.0, "use_steering": True, "steering_per_flake": True, "turbulence": 0.3, **MANY}
SOON = 1.0 / 64.0


def linear(obj):
    """Have all keys of an object's action go straight to the next ones."""
    for curve in curves(obj):
        for point in curve.keyframe_points:
            point.interpolation = 'LINEAR'
    obj.update_tag()


def curves(obj):
    return [curve for each in support.addon("core.blender.actions").all_fcurves(obj.animation_data.action) for curve in each]


def keyed(emitter, name, rows):
    """Keys of a setting of an emitter: frame -> value."""
    for frame, value in rows.items():
        setattr(emitter.motus.snow, name, value)
        emitter.keyframe_insert(f"motus.snow.{name}", frame=frame)


class Rate(SnowTestCase):
    def rated(self, rows, **keywords):
        emitter = self.add(**(PLAIN | keywords))
        keyed(emitter, "rate", rows)
        linear(emitter)
        return emitter

    def test_births_are_the_integral_of_the_rate(self):
        emitter = self.rated({1: 0.0, 49: 96.0, 97: 0.0}, lifetime=9.0)
        for frame in (97, 13, 48.5, 49, 120, 25):
            go_to(frame)
            # 24 t^2 flakes until t = 2 s, where there are 96; then 96 (t - 2) - 24 (t - 2)^2 more.
            time = seconds(frame)
            later = min(max(time - 2.0, 0.0), 2.0)
            count = 24.0 * min(time, 2.0) ** 2 + 96.0 * later - 24.0 * later**2
            found = flakes(emitter)
            self.assertLessEqual(abs(len(found["id"]) - count), 1.0, frame)
            early = found["id"] < 90
            np.testing.assert_allclose(found["age"][early], time - np.sqrt((found["id"][early] + 1.0) / 24.0), atol=1e-4)
        self.assertEqual(self.sentence(emitter), "")

    def test_any_frame_in_any_order_without_an_end(self):
        emitter = self.rated({1: 20.0, 25: 400.0}, random_lifetime=True)
        found = {}
        for modifier in (False, True):
            if modifier:
                curves(emitter)[0].modifiers.new('CYCLES')
                linear(emitter)
                found.clear()
            for _ in range(2):
                for frame in (*OFF_THE_FRAMES, 5000.5):
                    go_to(frame)
                    self.assertEqual(found.setdefault(frame, state(emitter)), state(emitter), frame)
                self.assertEqual(len(set(found.values())), len(found))

    def test_a_driven_rate_is_said(self):
        emitter = self.add(**PLAIN)
        emitter.driver_add("motus.snow.rate").driver.expression = "frame"
        go_to(30)
        self.assertIn("rate is not known ahead", self.sentence(emitter))
        self.assertGreater(len(flakes(emitter)["id"]), 0)
        recorded = {"data_path": "motus.snow.rate", "frame_start": 1, "frame_end": 50}
        self.assertEqual(bpy.ops.motus.track_record(datablock=emitter.name, **recorded), {'FINISHED'})
        self.assertEqual(self.sentence(emitter), "")

    def test_a_rate_that_lets_too_many_live(self):
        emitter = self.rated({1: 0.0, 20: 1e8})
        go_to(5)
        self.assertIn("16 million", self.sentence(emitter))


class OwnTime(SnowTestCase):
    def test_slow_motion_is_the_same_snow_later(self):
        emitter = self.add(**PLAIN)
        before = {}
        for frame in (15.5, 20, 30):
            go_to(frame)
            before[frame] = flakes(emitter)
        emitter.motus.snow.time_speed = 0.5
        for frame, plain in before.items():
            go_to(1 + 2 * (frame - 1))
            found = flakes(emitter)
            for name in ("position", "id", "age"):
                self.assertEqual(found[name].tobytes(), plain[name].tobytes(), name)
        emitter.motus.snow.time_speed = 0.0
        go_to(90)
        self.assertEqual(len(flakes(emitter)["id"]), 0)

    def test_a_keyed_speed_goes_by_its_integral(self):
        emitter = self.add(all_attributes=True, **PLAIN)
        carrier = support.link("Carrier")
        key_places(carrier, {1: (0.0, 0.0, 0.0), 60: (4.0, 0.0, 0.0)})
        emitter.parent = carrier
        keyed(emitter, "time_speed", {1: 1.0, 49: 0.0, 61: 0.0, 73: 1.0})
        linear(emitter)
        found = {}
        for _ in range(2):
            for frame in (*OFF_THE_FRAMES, 55, 72.75):
                go_to(frame)
                self.assertEqual(found.setdefault(frame, state(emitter)), state(emitter), frame)
        self.assertEqual(found[60], found[55])  # time stands still, whatever the emitter does
        carrier.animation_data_clear()
        settings = emitter.motus.snow
        for frame in (25, 49, 24.5):
            go_to(frame)
            part = (frame - 1.0) / 48.0
            time = 2.0 * (part - 0.5 * part * part)
            found = flakes(emitter)
            slow = dict(zip(found["id"].tolist(), found["position"]))
            number, speed = found["id"], 1.0 - part
            velocity = found["velocity"]
            plain = (
                native()
                .Snow(
                    rate=MANY["rate"],
                    lifetime=MANY["lifetime"],
                    start_speed=settings.start_speed,
                    cone_radius=settings.emitter_radius,
                    snow=True,
                    snow_offsets=True,
                    max_angle=settings.max_angle,
                    turbulence=settings.turbulence,
                    emitter_times=[0.0],
                    emitter_matrices=[np.array(emitter.matrix_world)],
                )
                .evaluate(time)
            )
            np.testing.assert_array_equal(plain["id"], number)
            np.testing.assert_allclose(plain["position"], [slow[one] for one in number.tolist()], atol=1e-5)
            np.testing.assert_allclose(speed * plain["velocity"], velocity, atol=1e-5)

    def test_a_driven_speed_is_said(self):
        emitter = self.add(**PLAIN)
        emitter.driver_add("motus.snow.time_speed").driver.expression = "0.5"
        go_to(31)
        self.assertIn("Tempo is driven", self.sentence(emitter))
        self.assertGreater(len(flakes(emitter)["id"]), 0)


class Loops(SnowTestCase):
    def looping(self, length=48, **keywords):
        return self.add(use_loop=True, loop_start=1, loop_end=1 + length, **(PLAIN | keywords))

    def check_seam(self, emitter, end, fastest, most_changed=4):
        """That flakes go on over the end of the loop: each from where it was, and few are born or gone."""
        go_to(end - SOON)
        before = flakes(emitter)
        go_to(end + SOON)
        after = flakes(emitter)
        places = dict(zip(before["id"].tolist(), before["position"]))
        self.assertEqual(len(places), len(before["id"]))  # each has a number of its own
        both = [(places[number], place) for number, place in zip(after["id"].tolist(), after["position"]) if number in places]
        self.assertGreater(len(both), 50)
        self.assertLessEqual(len(places) + len(after["id"]) - 2 * len(both), most_changed)
        ways = np.linalg.norm([end - start for start, end in both], axis=1)
        self.assertLess(ways.max(), fastest * 2.0 * SOON / 24.0 + 1e-5)

    def test_a_loop_repeats_to_the_bit_without_a_seam(self):
        emitter = self.looping(random_lifetime=True, random_size=True, random_color=True, burst=30, burst_time=0.7, lifetime=0.9)
        found = {}
        for frame in (1, 49, 30, 12.25, 60.25, 97, -18, 108.25):
            go_to(frame)
            where = 1 + (frame - 1) % 48
            self.assertEqual(found.setdefault(where, state(emitter)), state(emitter), frame)
        self.assertEqual(len(found), 3)
        self.check_seam(emitter, 49, 3.0)
        self.check_seam(emitter, 1, 3.0)
        self.assertEqual(self.sentence(emitter), "")

    def test_flakes_that_live_longer_than_the_loop(self):
        emitter = self.looping(length=12, lifetime=2.0, drag=1.0, wind=(1.0, 0.0, -0.5), gusts=0.6, use_ground=True, ground=-0.6)
        go_to(5)
        first = flakes(emitter)
        self.assertEqual(len(first["id"]), 400)
        self.assertTrue((first["position"][:, 2] < -0.599).any())
        go_to(17)
        again = flakes(emitter)
        for name in ("position", "age", "radius"):
            self.assertEqual(first[name].tobytes(), again[name].tobytes(), name)
        for end in (13, 25, 37, 49, 61):
            self.check_seam(emitter, end, 4.0)

    def test_what_moves_and_changes_repeats_as_well(self):
        emitter = self.looping(lifetime=3.0, drag=1.0)
        keyed(emitter, "wind", {1: (0.0, 0.0, 0.0), 25: (3.0, 0.0, 0.0), 49: (0.0, 0.0, 0.0)})
        keyed(emitter, "rate", {1: 10.0, 20: 300.0, 49: 10.0})
        keyed(emitter, "time_speed", {1: 1.0, 30: 0.3, 49: 1.0})
        key_places(emitter, {1: (0.0, 0.0, 0.0), 25: (5.0, 0.0, 0.0), 49: (0.0, 0.0, 0.0)})
        for frame in (10, 40.5):
            go_to(frame)
            first = flakes(emitter)
            go_to(frame + 48)
            self.assertEqual(first["position"].tobytes(), flakes(emitter)["position"].tobytes())
        self.check_seam(emitter, 49, 6.0)
        self.check_seam(emitter, 97, 6.0)
        self.assertEqual(self.sentence(emitter), "")

    def test_loops_that_are_none(self):
        emitter = self.looping(length=0)
        go_to(20)
        self.assertIn("ends before it begins", self.sentence(emitter))
        emitter.motus.snow.loop_end = 2
        emitter.motus.snow.lifetime = 1000.0
        self.assertIn("too short", self.sentence(emitter))
        emitter.motus.snow.use_loop = False
        self.assertEqual(self.sentence(emitter), "")

    def test_a_loop_over_the_scene(self):
        emitter = self.add(**PLAIN)
        bpy.context.scene.frame_start, bpy.context.scene.frame_end = 11, 70
        self.assertEqual(bpy.ops.motus.snow_loop(object=emitter.name), {'FINISHED'})
        settings = emitter.motus.snow
        self.assertEqual((settings.use_loop, settings.loop_start, settings.loop_end), (True, 11, 71))
        self.check_seam(emitter, 71, 3.0)


class Follow(SnowTestCase):
    def test_in_local_space_flakes_follow_the_emitter(self):
        emitter = self.add(**PLAIN)
        go_to(30)
        still = flakes(emitter)
        key_places(emitter, {1: (0.0, 0.0, 0.0), 49: (8.0, 0.0, 2.0)})
        go_to(30)
        trailing = flakes(emitter)
        emitter.motus.snow.use_local = True
        go_to(31)
        go_to(30)
        found = flakes(emitter)
        np.testing.assert_array_equal(found["id"], still["id"])
        for axis in (0, 1):
            moved = found["position"][:, axis].max() - still["position"][:, axis].max()
            self.assertAlmostEqual(moved, emitter.matrix_world.translation[axis], delta=0.9)
        self.assertGreater(np.abs(found["position"] - trailing["position"]).max(), 1.0)
        emitter.motus.snow.turbulence = 0.0
        placed = flakes(emitter)["position"] - np.array(emitter.matrix_world.translation)
        emitter.animation_data_clear()
        emitter.location = 0.0, 0.0, 0.0
        bpy.context.view_layer.update()
        np.testing.assert_allclose(flakes(emitter)["position"], placed, atol=1e-5)
        self.assertEqual(self.sentence(emitter), "")

    def test_the_scale_counts_for_the_size_if_it_shall(self):
        emitter = self.add(random_size=True, **PLAIN)
        go_to(30)
        before = flakes(emitter)["radius"]
        emitter.scale = 8.0, 1.0, 1.0
        bpy.context.view_layer.update()
        self.assertEqual(flakes(emitter)["radius"].tobytes(), before.tobytes())
        emitter.motus.snow.use_scale = True
        np.testing.assert_allclose(flakes(emitter)["radius"], 2.0 * before, rtol=1e-6)

    def test_flakes_leave_with_the_emitters_velocity(self):
        emitter = self.add(rate=50.0, lifetime=2.0, start_speed=0.0, emitter_radius=0.0, emitter_velocity=0.5)
        key_places(emitter, {1: (0.0, 0.0, 0.0), 97: (8.0, 0.0, 0.0)})
        linear(emitter)
        for frame in (60, 24.5):
            go_to(frame)
            found = flakes(emitter)
            born = 2.0 * (seconds(frame) - found["age"])
            np.testing.assert_allclose(found["position"][:, 0], born + 1.0 * found["age"], atol=1e-4)

    def test_the_settings_come_from_keywords(self):
        given = {"time_speed": 0.25, "use_loop": True, "loop_start": 5, "loop_end": 77, "emitter_velocity": 0.5, "use_local": True}
        settings = self.add(use_scale=True, **given).motus.snow
        for name, value in given.items():
            self.assertEqual(getattr(settings, name), value, name)
        self.assertTrue(settings.use_scale)
        kind = support.addon("snow.presets")
        self.assertEqual(kind.kind_of(settings), "Plain")
        self.assertEqual(bpy.ops.motus.snow_preset(preset='GENTLE'), {'FINISHED'})
        self.assertEqual((settings.time_speed, settings.use_local), (0.25, True))
