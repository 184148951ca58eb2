"""Feet that turn with the ground and roll over heel and toe: objects and bones, and their motion over time."""

import math
from unittest import mock

import bpy
import numpy as np
from mathutils import Euler, Quaternion

import solved_cases
import support
from walker import walker_cases as cases

HEADING = 0.6
"""rad: of the way."""
OWN = Euler((0.2, -0.3, 0.9)).to_quaternion()
"""Rotation of feet as they were modelled."""


def slope(x, y):
    return 0.2 * x - 0.15 * y


def biped(**keywords):
    """A body on two feet that are objects, on its way over a slope; (body, feet)."""
    body = support.link("Body")
    body.rotation_euler.z = HEADING
    feet = []
    for index, side in enumerate((-0.12, 0.12)):
        foot = support.link(f"Foot {index}", location=(side, 0.0, 0.1), parent=body)
        foot.rotation_mode = 'QUATERNION'
        foot.rotation_quaternion = OWN
        feet.append(foot)
    bpy.context.view_layer.update()
    settings = {"gait": 'WALK', "stride": 0.5, "use_soles": True, "ankle": 0.1, "heel": 0.06, "toe": 0.15, "reach_down": 1.0, **keywords}
    assert bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), **settings) == {'FINISHED'}
    support.key_places(body, {1: (0.0, 0.0, 0.0), 80: (-2.0 * math.sin(HEADING), 2.0 * math.cos(HEADING), 0.0)})
    support.go_to(1)
    return body, feet


def turn_of(thing):
    seen = support.evaluated(thing)
    matrix = seen.matrix_world if thing == thing.id_data else seen.id_data.matrix_world @ seen.matrix
    return matrix.to_quaternion()


def numbers(thing):
    return np.array(support.evaluated(thing).matrix_world)


class Soles(solved_cases.Solved, cases.WalkerTestCase):
    label = "Walker"

    def assertTurned(self, thing, wanted, tolerance=2e-5):
        self.assertLess(Quaternion(wanted).rotation_difference(turn_of(thing)).angle % (2.0 * math.pi), tolerance)

    def test_settings_arrive(self):
        body, _ = biped()
        body.scale = 3 * [2.0]
        settings, native = body.motus.walker, support.addon("core.native").module
        for name, value in {"ankle": 0.2, "heel": 0.3, "toe": 0.4, "strike": 0.5, "push": 0.6}.items():
            setattr(settings, name, value)
        with mock.patch.object(native, "Walker", wraps=native.Walker) as made:
            bpy.context.view_layer.update()
        given = made.call_args.kwargs
        for name, value in {"ankle": 0.4, "heel": 0.6, "toe": 0.8, "strike": 0.5, "push": 0.6}.items():
            self.assertAlmostEqual(given[name], value, places=6, msg=name)
        settings.use_soles = False
        with mock.patch.object(native, "Walker", wraps=native.Walker) as made:
            bpy.context.view_layer.update()
        self.assertEqual([made.call_args.kwargs[name] for name in ("strike", "push")], [0.0, 0.0])
        np.testing.assert_array_equal(made.call_args.kwargs["forward"], (0.0, 1.0, 0.0))

    def test_feet_turn_as_the_library_has_them(self):
        land = cases.grid("Land", slope)
        body, feet = biped(ground=land.name)
        walker = cases.plan_of(body).walker
        for frame in (1, 30, 31.5, 40, 47.25, 100):
            support.go_to(frame)
            turns = walker.turns(cases.seconds(frame))
            for foot, turn, place in zip(feet, turns, walker.feet(cases.seconds(frame))):
                self.assertTurned(foot, Quaternion(turn) @ OWN)
                np.testing.assert_allclose(support.evaluated(foot).matrix_world.translation, place, atol=cases.SINGLE)
        turns = walker.turns(cases.seconds(np.arange(20, 70)))
        self.assertGreater(np.ptp(turns, axis=0).max(), 0.2)
        self.assertWell(body)

    def test_at_rest_feet_lie_flat_on_the_ground(self):
        _, feet = biped(ground=cases.grid("Land", slope).name)
        support.go_to(118)
        normal = np.array((-0.2, 0.15, 1.0))
        for foot in feet:
            up = (turn_of(foot) @ OWN.inverted()).to_matrix().col[2]
            np.testing.assert_allclose(up, normal / np.linalg.norm(normal), atol=1e-5)

    def test_frames_in_any_order(self):
        _, feet = biped(ground=cases.grid("Land", slope).name)
        frames = sorted(set(cases.OFF_THE_FRAMES))
        played = dict(zip(frames, cases.over(frames, lambda: [numbers(foot) for foot in feet])))
        for frame in cases.OFF_THE_FRAMES:
            support.go_to(frame)
            np.testing.assert_array_equal([numbers(foot) for foot in feet], played[frame])

    def test_over_time(self):
        body, feet = biped(ground=cases.grid("Land", slope).name)
        self.assertSolved(feet[1], 5e-5)
        for frame, value in ((1, 0.25), (100, 1.0)):
            body.motus.walker.influence = value
            body.keyframe_insert("motus.walker.influence", frame=frame)
        bpy.context.view_layer.update()
        self.assertSolved(feet[0], 5e-4)

    def test_bones(self):
        spider = cases.spider(ground=cases.grid("Land", slope).name)
        spider.rotation_euler.z = 0.3
        spider.motus.walker.use_soles = True
        bpy.context.view_layer.update()
        walker = cases.plan_of(spider).walker
        for frame in (1, 33, 47.5):
            support.go_to(frame)
            for index, turn in enumerate(walker.turns(cases.seconds(frame))):
                bone = spider.pose.bones[cases.foot_bones(spider)[index]]
                self.assertTurned(bone, Quaternion(turn) @ bone.bone.matrix_local.to_quaternion())
        self.assertSolved(spider.pose.bones["foot 2.L"], 5e-5)
        np.testing.assert_allclose(cases.tips(spider), cases.places(spider), atol=2e-5)

    def test_soles_that_are_switched_off_leave_the_rotation_alone(self):
        body, feet = biped()
        support.go_to(40)
        body.motus.walker.use_soles = False
        bpy.context.view_layer.update()
        for foot in feet:
            self.assertTurned(foot, Euler((0.0, 0.0, HEADING)).to_quaternion() @ OWN)
        body.motus.walker.use_soles = True
        bpy.context.view_layer.update()
        self.assertTurned(feet[0], Quaternion(cases.plan_of(body).walker.turns(cases.seconds(40))[0]) @ OWN)
        self.assertEqual(bpy.ops.motus.walker_remove(object=body.name), {'FINISHED'})
        for foot in feet:
            self.assertTurned(foot, Euler((0.0, 0.0, HEADING)).to_quaternion() @ OWN)

    def test_rest_positions_have_turns(self):
        body, feet = biped()
        feet[0].rotation_quaternion = (1.0, 0.0, 0.0, 0.0)
        self.assertEqual(bpy.ops.motus.walker_rest(object=body.name), {'FINISHED'})
        np.testing.assert_allclose(body.motus.walker.legs[0].turn, (1.0, 0.0, 0.0, 0.0), atol=1e-6)
        np.testing.assert_allclose(body.motus.walker.legs[1].turn, OWN, atol=1e-6)

    def test_an_ankle_above_the_ground_does_not_lower_the_body(self):
        body, feet = biped(use_soles=False, use_plane=True)
        shell = support.link("Shell", parent=body)
        body.motus.walker.body = shell
        support.go_to(-20)
        for ankle in (0.1, 0.0):
            body.motus.walker.ankle = ankle
            bpy.context.view_layer.update()
            self.assertAlmostEqual(support.evaluated(feet[0]).matrix_world.translation.z, ankle, places=5)
            self.assertAlmostEqual(support.evaluated(shell).matrix_world.translation.z, ankle - 0.1, places=5)


class Gaits(cases.WalkerTestCase):
    def test_each_gait_goes(self):
        spider = cases.spider()
        native = support.addon("core.native").module
        for gait in ('WALK', 'RUN', 'CANTER', 'GALLOP', 'HOP'):
            with mock.patch.object(native, "walker_gait", wraps=native.walker_gait) as asked:
                spider.motus.walker.gait = gait
                bpy.context.view_layer.update()
            self.assertEqual(asked.call_args.args[0], gait.lower())
            self.assertWell(spider)

    def test_numbers_of_gaits_in_files_stay(self):
        wanted = ('TETRAPOD', 'TRIPOD', 'RIPPLE', 'WAVE', 'TROT', 'PACE', 'OWN')
        spider = cases.spider(ahead=0.0)
        for number, gait in enumerate(wanted):
            cases.set_raw(spider, "gait", number)
            self.assertEqual(spider.motus.walker.gait, gait)
