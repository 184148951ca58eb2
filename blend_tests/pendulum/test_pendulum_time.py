"""The pendulum's own time: start, speed, play and pause with keys; and dragging while it stands still."""

import math
from unittest import mock

import bpy
from mathutils import Vector

import support
from pendulum.pendulum_cases import PendulumTestCase, native, place, reach
from support import go_to


class Clock(PendulumTestCase):
    def setUp(self):
        super().setUp()
        self.pivot = self.add(kind='SINGLE', angle1=1.0)
        self.settings = self.pivot.motus.pendulum
        (self.bob,) = self.bobs(self.pivot)

    def assertTime(self, seconds):
        angle, _ = native().single_pendulum(seconds, self.settings.angle1, gravity=bpy.context.scene.gravity.length)
        self.assertPlace(self.bob, reach((1.0, angle)))

    def key(self, name, values, interpolation=None):
        for frame, value in values:
            setattr(self.settings, name, value)
            self.pivot.keyframe_insert(f"motus.pendulum.{name}", frame=frame)
        if interpolation:
            import support

            curve = support.addon("core.blender.actions").find(self.pivot, f"motus.pendulum.{name}")
            for point in curve.keyframe_points:
                point.interpolation = interpolation

    def test_it_waits_for_its_start(self):
        self.settings.start_frame = 10.5
        for frame, seconds in ((-100, 0.0), (10, 0.0), (34.5, 1.0)):
            go_to(frame)
            self.assertTime(seconds)

    def test_frame_rates(self):
        bpy.context.scene.render.fps = 1
        go_to(3)
        self.assertTime(2.0)
        bpy.context.scene.render.fps, bpy.context.scene.render.fps_base = 30, 1.001
        go_to(61)
        self.assertTime(2.002)

    def test_speed(self):
        self.settings.speed = -0.5
        go_to(49)
        self.assertTime(-1.0)

    def test_a_keyed_speed_is_integrated(self):
        self.key("speed", ((1, 0.0), (49, 2.0)), 'LINEAR')
        for frame, seconds in ((49, 2.0), (25, 0.5), (73, 4.0), (13.0, 0.125)):
            go_to(frame)
            self.assertTime(seconds)

    def test_pauses_are_cut_out_exactly(self):
        self.key("is_playing", ((1, True), (13, False), (37.25, True)))
        for frame, seconds in ((85.25, 2.5), (13, 0.5), (30, 0.5), (37.25, 0.5), (7, 0.25)):
            go_to(frame)
            self.assertTime(seconds)
        self.key("speed", ((1, 2.0), (100, 2.0)))
        go_to(85.25)
        self.assertTime(5.0)

    def test_play_and_pause_by_the_operator(self):
        go_to(25)
        bpy.ops.motus.pendulum_play(object=self.pivot.name)
        go_to(40)
        self.assertTime(1.0)
        bpy.ops.motus.pendulum_play(object=self.bob.name, play='PLAY')
        go_to(64)
        self.assertTime(2.0)
        go_to(13)
        self.assertTime(0.5)

    def test_not_playing_at_all(self):
        self.settings.is_playing = False
        go_to(200)
        self.assertTime(0.0)

    def test_a_driven_speed_counts_as_it_is(self):
        self.pivot.driver_add("motus.pendulum.speed").driver.expression = "0.5"
        go_to(49)
        self.assertTime(1.0)
        self.assertIn("present value", self.sentence(self.pivot))


class Drag(PendulumTestCase):
    def test_the_end_bob_goes_there_and_swings_on(self):
        pivot = self.add(kind='DOUBLE', location=(1.0, 0.0, 2.0))
        go_to(30)
        bpy.ops.motus.pendulum_play(play='PAUSE')
        bpy.ops.motus.pendulum_drag(object=pivot.name, location=(2.0, 0.0, 1.0))
        _, lower = self.bobs(pivot)
        self.assertPlace(lower, (2.0, 0.0, 1.0))
        settings = pivot.motus.pendulum
        self.assertEqual((settings.start_frame, settings.velocity1, settings.velocity2), (30.0, 0.0, 0.0))
        go_to(50)
        self.assertPlace(lower, (2.0, 0.0, 1.0))
        bpy.ops.motus.pendulum_play(play='PLAY')
        go_to(74)
        first, second, *_ = native().double_pendulum(1.0, settings.angle1, settings.angle2, gravity=bpy.context.scene.gravity.length)
        self.assertPlace(lower, reach((1.0, first), (1.0, second)) + (1.0, 0.0, 2.0), 5e-6)

    def test_it_says_that_the_earlier_motion_is_replaced(self):
        pivot = self.add(kind='DOUBLE', location=(0.0, 0.0, 0.0))
        held = support.addon("pendulum.drag").Held
        for frame, expected in ((1, False), (25, True)):
            go_to(frame)
            dragged = held(bpy.context, pivot)
            dragged.pull(Vector((1.0, 0.0, -1.0)))
            self.assertEqual(dragged.has_new_start, expected)
            dragged.restore()
        self.assertFalse(dragged.has_new_start)

    def test_a_script_removes_it_meanwhile(self):
        pivot = self.add(kind='DOUBLE', location=(0.0, 0.0, 0.0))
        dragged = support.addon("pendulum.drag").Held(bpy.context, pivot)
        bpy.data.objects.remove(pivot)
        self.assertRaises(ReferenceError, dragged.pull, Vector((1.0, 0.0, -1.0)))
        self.assertRaises(ReferenceError, dragged.restore)

    def test_the_elbow_stays_on_its_side(self):
        for angle1, angle2 in ((0.5, -0.5), (-0.5, 0.5)):
            pivot = self.add(kind='DOUBLE', angle1=angle1, angle2=angle2, location=(0.0, 0.0, 0.0))
            before = place(self.bobs(pivot)[0])[0]
            bpy.ops.motus.pendulum_drag(object=pivot.name, location=(0.0, 0.0, -1.5))
            upper, lower = self.bobs(pivot)
            self.assertGreater(place(upper)[0] * before, 0.0)
            self.assertPlace(lower, (0.0, 0.0, -1.5))

    def test_out_of_reach_and_out_of_the_plane(self):
        pivot = self.add(kind='DOUBLE', location=(0.0, 0.0, 0.0))
        bpy.ops.motus.pendulum_drag(object=pivot.name, location=(5.0, 3.0, 0.0))
        self.assertPlace(self.bobs(pivot)[1], (2.0, 0.0, 0.0))
        bpy.ops.motus.pendulum_drag(object=pivot.name, location=(0.0, 0.0, 0.0))
        self.assertPlace(self.bobs(pivot)[1], (0.0, 0.0, 0.0), 1e-5)

    def test_single_and_one_of_a_fan(self):
        pivot = self.add(kind='SINGLE', location=(0.0, 0.0, 0.0))
        bpy.ops.motus.pendulum_drag(object=pivot.name, location=(0.3, 0.0, -0.3))
        self.assertAlmostEqual(pivot.motus.pendulum.angle1, math.pi / 4, 6)
        fan = self.add(kind='FAN', count=3, spacing=0.0, location=(0.0, 0.0, 0.0))
        bpy.ops.motus.pendulum_drag(object=fan.name, location=(1.0, 0.0, -1.0), number=2)
        self.assertPlace(self.bobs(fan)[-1], (1.0, 0.0, -1.0))

    def test_refusals(self):
        pivot = self.add(kind='DOUBLE')
        go_to(20)
        drag = bpy.ops.motus.pendulum_drag
        self.assertRefused("pause it first", drag, object=pivot.name, location=(0, 0, 0))
        bpy.ops.motus.pendulum_play()
        self.assertRefused("location is missing", drag, object=pivot.name)
        self.assertRefused("has 1 pendulums", drag, object=pivot.name, location=(0, 0, 0), number=1)
        self.assertRefused("not a finite number", drag, object=pivot.name, location=(math.nan, 0, 0))
        self.link("Cube")
        self.assertRefused("Nothing here is part of a pendulum", drag, object="Cube", location=(0, 0, 0))


class Bounds(PendulumTestCase):
    """Nobody waits in a viewport for the motion of many pendulums far from their start."""

    def setUp(self):
        super().setUp()
        self.solve, self.bounds = support.addon("pendulum.solve"), support.addon("core.measures.bounds")
        self.fan = self.add(kind='FAN', count=10)
        settings = self.fan.motus.pendulum
        self.farthest = native().double_pendulum_longest_time(settings.angle1, settings.angle2, gravity=bpy.context.scene.gravity.length)
        # Ten pendulums for fifty seconds.
        limit = mock.patch.object(self.bounds, "AT_ONCE", 10 * self.solve.TABLE * 50.0 / self.farthest)
        limit.start()
        self.addCleanup(limit.stop)

    def told(self, seconds):
        """Whether the panel says what to lower, that many seconds after the start; and no motion is computed then."""
        with mock.patch.object(self.solve, "_fan", wraps=self.solve._fan) as computed:
            self.fan.motus.pendulum.angle1 += 1e-6
            self.fan.update_tag()
            go_to(1 + 24 * seconds)
        is_told = "take fewer" in self.sentence(self.fan)
        self.assertEqual(computed.called, not is_told)
        return is_told

    def test_a_fan(self):
        self.assertEqual([self.told(seconds) for seconds in (49, 51, 1, 40_000)], [False, True, False, True])

    def test_fewer_are_known_for_longer(self):
        bpy.ops.motus.pendulum_remove(object=self.fan.name)
        self.fan = self.add(kind='DOUBLE')
        self.assertEqual([self.told(seconds) for seconds in (499, 501)], [False, True])

    def test_all_of_a_scene_share_the_time_of_a_frame(self):
        self.add(kind='DOUBLE')
        self.assertEqual([self.told(seconds) for seconds in (24, 26, 49)], [False, True, True])

    def test_a_formula_takes_no_longer(self):
        for damping in (0.0, 0.1):
            single = self.add(kind='SINGLE', angle1=1.0, damping=damping)
            swing = self.solve.swing_of(single.motus.pendulum, bpy.context.scene)
            self.assertEqual(math.isinf(swing.farthest), damping == 0.0)

    def test_damped_ones_are_known_about_as_far_as_said(self):
        """The native module has them farther than half the time, and no farther than twice the time, by which they are priced."""
        for length in (0.1, 1.0, 20.0):
            single = self.add(kind='SINGLE', angle1=1.0, length1=length, damping=0.1)
            swing = self.solve.swing_of(single.motus.pendulum, bpy.context.scene)
            swing.at(0.5 * swing.farthest)
            with self.assertRaises(ValueError):
                swing.at(2.0 * swing.farthest)

    def test_renders_wait(self):
        swing = self.solve.swing_of(self.fan.motus.pendulum, bpy.context.scene)
        render = mock.Mock(mode='RENDER')
        self.assertFalse(swing.takes_too_long(600.0, self.fan, render))

    def test_the_trail_waits_too(self):
        bpy.ops.motus.pendulum_trail_add(object=self.fan.name)
        trail = support.addon("pendulum.parts").own_trail(self.fan)
        go_to(1 + 24 * 600)
        system = support.addon("pendulum").TRAILS
        found = support.addon("core.wiring").problem(system, trail, bpy.context.evaluated_depsgraph_get())
        self.assertIn("take fewer", found.sentence)
