"""What eyes do by themselves while they look at something: saccades, by formula, on any frame."""

import math

import bpy

import solved_cases
import support
from look_at.look_at_cases import EYES, LookAtTestCase

FRAMES = (1, 61, 33.25, 12, 50.5, 21, 3, -40)
AMPLITUDE = math.radians(6.0)


def place(gaze):
    """Radians to the left of -Y and up of a unit vector, in the map in which turns are vectors."""
    across = math.hypot(gaze.x, gaze.z)
    angle = math.atan2(across, -gaze.y)
    return (angle / across * gaze.x, angle / across * gaze.z) if across else (0.0, 0.0)


class Saccades(LookAtTestCase):
    def setUp(self):
        super().setUp()
        self.aim(30, 10)
        self.entry = self.look(body_weight=0.0, head_weight=0.5, eyes_weight=1.0)
        self.native = support.addon("core.native").module

    def jump(self, **settings):
        """Switch saccades on, with other values of their settings."""
        for name, value in ({"saccade_amplitude": AMPLITUDE, "saccade_rate": 3.0, "eyes_seed": 7, "use_saccades": True} | settings).items():
            setattr(self.entry, name, value)

    def places(self):
        return [place(self.gaze(name)) for name in EYES]

    def beside(self, plain):
        """How far each eye looks beside where it looked at first, radians to the left and up."""
        return [(now[0] - was[0], now[1] - was[1]) for now, was in zip(self.places(), plain)]

    def assertBeside(self, plain, wanted):
        for found in self.beside(plain):
            for one, other in zip(found, wanted):
                self.assertAlmostEqual(one, other, delta=3e-6)

    def test_by_formula(self):
        plain = self.places()
        self.jump()
        for frame in FRAMES:
            with self.subTest(frame):
                support.go_to(frame)
                self.assertBeside(plain, self.native.saccades(frame / 24, AMPLITUDE, 3.0, 7))

    def test_the_same_seconds_at_another_frame_rate(self):
        plain = self.places()
        self.jump()
        self.scene.render.fps = 60
        support.go_to(75)
        self.assertBeside(plain, self.native.saccades(1.25, AMPLITUDE, 3.0, 7))

    def test_any_order_gives_the_same_bits(self):
        self.jump()
        found = {}
        for frame in (*FRAMES, *reversed(FRAMES)):
            support.go_to(frame)
            poses = self.poses()
            self.assertSamePoses(poses, found.setdefault(frame, poses), 0.0)
        self.assertNotEqual(found[1]["Eye.L"], found[12]["Eye.L"])

    def test_the_head_and_the_reports_know_nothing_of_it(self):
        self.entry.eyes_weight = 0.4
        before, angle = self.poses(), self.told("angle")
        self.jump()
        for frame in FRAMES:
            support.go_to(frame)
            self.assertSamePoses(self.poses(), before, 0.0, leave_out=EYES)
            self.assertAlmostEqual(self.told("angle"), angle, delta=1e-6)

    def test_eyes_without_weight_jump_too_and_by_the_weight_of_the_whole(self):
        self.entry.eyes_weight, self.entry.weight = 0.0, 0.5
        plain = self.places()
        self.jump()
        support.go_to(17)
        self.assertBeside(plain, 0.5 * self.native.saccades(17 / 24, AMPLITUDE, 3.0, 7))

    def test_the_overlay_shows_eyes_that_jump_as_looking_at_their_target(self):
        overlay = support.addon("look_at.overlay")
        self.jump()
        support.go_to(17)
        angle = self.told("angle")
        rig = self.evaluated()
        lines = overlay._batches(rig, rig.motus.look_at.entries["Head"], [self.target.matrix_world.translation], angle)
        self.assertEqual([line.colors for line in lines[-3:-1]], [overlay.GAZE_COLOR] * 2)

    def test_within_the_limits(self):
        self.entry.eyes_limit = math.radians(1.0)
        self.entry.head_weight = 1.0
        self.jump(saccade_amplitude=math.radians(20.0))
        for frame in FRAMES:
            support.go_to(frame)
            for name in EYES:
                self.assertLess(math.degrees(self.gaze(name).angle(self.gaze("Head"))), 1.05)

    def test_a_keyed_amplitude(self):
        plain = self.places()
        self.jump()
        support.key(self.entry, "saccade_amplitude", {1: 0.0, 25: AMPLITUDE})
        support.go_to(1)
        self.assertBeside(plain, (0.0, 0.0))
        support.go_to(25)
        self.assertBeside(plain, self.native.saccades(25 / 24, AMPLITUDE, 3.0, 7))

    def test_switched_off_and_removed(self):
        plain = self.poses()
        self.jump()
        support.go_to(9)
        self.entry.use_saccades = False
        bpy.context.view_layer.update()
        self.assertSamePoses(self.poses(), plain, 0.0)
        self.entry.use_saccades = True
        bpy.ops.motus.look_at_remove(object="Rig")
        for name in EYES:
            self.assertLess((self.pose(name).translation - self.rig.data.bones[name].head_local).length, 1e-6)
            self.assertLess(abs(self.yaw(name)), 1e-4)

    def test_the_operator_takes_them(self):
        self.look(use_saccades=True, saccade_amplitude=0.05, saccade_rate=4.0, eyes_seed=3)
        self.assertTrue(self.entry.use_saccades)
        self.assertAlmostEqual(self.entry.saccade_amplitude, 0.05, delta=1e-6)
        self.assertEqual((self.entry.saccade_rate, self.entry.eyes_seed), (4.0, 3))

    def test_baked(self):
        self.jump()
        live = {}
        for frame in (1, 8, 19, 30):
            support.go_to(frame)
            live[frame] = self.poses()
        self.assertEqual(bpy.ops.motus.bake(object="Rig", frame_start=1, frame_end=30), {'FINISHED'})
        for frame, poses in live.items():
            support.go_to(frame)
            self.assertSamePoses(self.poses(), poses, 2e-6)


class SaccadesOverTime(solved_cases.Solved, LookAtTestCase):
    label = "Look At"

    def test_eyes(self):
        support.key(self.target, "location", {1: (2.0, -3.0, 1.5), 30: (-2.0, -2.0, 2.5), 60: (0.0, -3.0, 0.5)})
        entry = self.look(body_length=2, eyes_weight=0.7, use_saccades=True, saccade_rate=5.0)
        support.key(entry, "saccade_amplitude", {1: 0.0, 40: 0.2})
        for name in ("Head", *EYES):
            with self.subTest(name):
                self.assertSolved(self.rig.pose.bones[name])

    def test_eyes_never_rest(self):
        self.look(use_saccades=True)
        eye, head = (solved_cases.track(self.rig.pose.bones[name]) for name in ("Eye.L", "Head"))
        self.assertEqual(eye.extent, (-math.inf, math.inf))
        self.assertIsNone(head.extent)
