"""The main scene: all systems move in it, and what is to touch, to stand and to be seen does so."""

import itertools
import math
import unittest
from typing import NamedTuple

import bpy
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

import support
from demo import demo_cases

steps, pilot_module, flight, transmitter, land = (
    support.addon(f"demo.main.{name}") for name in ("steps", "pilot", "flight", "transmitter", "terrain")
)
RELEASE = pilot_module.RELEASE
SLIDE, SUNK = 0.002, 0.004  # m
REACHED, REACHED_TURN = 0.003, math.radians(1.0)
GAZE_ERROR = math.radians(3.0)


class Moment(NamedTuple):
    """What a frame shows: matrices in the world, by name."""

    frame: float
    bones: dict
    things: dict
    seen: tuple
    """Where the camera has the head and the toy: across and up the picture (0 to 1), and the depth."""


class MainScene(unittest.TestCase):
    """All tests look at one scene, which takes some seconds to build, and at the same frames of it."""

    @classmethod
    def setUpClass(cls):
        support.empty_scene()
        cls.own = bpy.context.scene
        cls.own.frame_set(7)
        cls.result = demo_cases.build('MAIN')
        cls.scene = bpy.context.window.scene
        cls.rig = next(thing for thing in cls.scene.objects if thing.name.startswith("Wooden Pilot") and thing.type == 'ARMATURE')
        demo_cases.show_shapes(cls.scene, False)
        cls.played = {frame: cls.moment(frame) for frame in range(1, cls.scene.frame_end + 1)}

    @classmethod
    def tearDownClass(cls):
        support.empty_scene()

    @classmethod
    def moment(cls, frame):
        cls.scene.frame_set(math.floor(frame), subframe=frame % 1.0)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        rig = cls.rig.evaluated_get(depsgraph)
        bones = {bone.name: rig.matrix_world @ bone.matrix for bone in rig.pose.bones}
        things = {thing.name: thing.evaluated_get(depsgraph).matrix_world.copy() for thing in cls.scene.objects}
        seen = tuple(world_to_camera_view(cls.scene, cls.scene.camera, place.translation) for place in (bones["head"], things["Toy"]))
        return Moment(frame, bones, things, seen)

    # --- the scene ------------------------------------------------------------------------------------------------

    def test_in_a_scene_of_its_own(self):
        self.assertEqual(self.result, {'FINISHED'})
        self.assertNotEqual(self.scene, self.own)
        self.assertEqual((self.own.frame_current, list(self.own.objects)), (7, []))

    def test_every_system_has_its_part(self):
        objects = self.scene.objects
        self.assertEqual([layer.name.split(".")[0] for layer in self.rig.motus.layers.entries], ["Walk", "Carry", "Throw"])
        self.assertEqual(sorted(chain.name for chain in self.rig.motus.ik.entries), ["foot.L", "foot.R", "hand.L", "hand.R"])
        self.assertTrue(self.rig.motus.look_at.entries["head"].target.motus.path.is_active)
        for system in ("path", "pendulum", "snow", "snow_cover", "walker"):
            self.assertTrue(any(getattr(thing.motus, system).is_active for thing in objects), system)
        self.assertTrue(self.scene.camera.motus.stereo.is_active)
        self.assertTrue(self.scene.render.use_multiview)

    def test_nothing_is_wrong(self):
        """No panel has anything to complain about, in the middle of the walk and of the flight."""
        wiring, systems = support.addon("core.wiring"), support.addon("core.declare").systems()
        self.assertTrue(any(thing.motus.snow_cover.is_active and thing.hide_viewport for thing in self.scene.objects))
        demo_cases.show_shapes(self.scene, True)
        self.addCleanup(demo_cases.show_shapes, self.scene, False)
        for frame in (30, 150):
            self.scene.frame_set(frame)
            depsgraph = bpy.context.evaluated_depsgraph_get()
            for thing in self.scene.objects:
                for system in systems:
                    settings = getattr(thing.motus, system.name)
                    if settings.is_active:
                        self.assertIsNone(wiring.problem(system, thing, depsgraph), (frame, thing.name, system.name))

    # --- the walk -------------------------------------------------------------------------------------------------

    def test_walks_for_three_seconds_and_stands(self):
        ways = [self.played[frame].things["Pilot Stage"].translation for frame in (1, 25, 49, steps.WALK_END, steps.REST, 200)]
        paces = [(later - earlier).length for earlier, later in itertools.pairwise(ways)]
        for pace in paces[:3]:
            self.assertAlmostEqual(pace, 24 * steps.PACE, places=4)
        self.assertAlmostEqual(paces[3], 0.5 * steps.PACE * (steps.REST - steps.WALK_END), places=3)
        self.assertEqual(paces[4], 0.0)

    def test_feet_do_not_slide(self):
        """The ball of a foot stays where it is from when the sole is down until the toes leave the ground."""
        for side, contacts in steps.CONTACTS.items():
            for came_down in contacts:
                last = self.scene.frame_end if came_down == contacts[-1] else came_down + int(steps.LIFTED)
                stand = [self.played[frame] for frame in range(max(came_down + 3, 1), last + 1)]
                for moment in stand:
                    moved = moment.bones[f"toe.{side}"].translation - stand[0].bones[f"toe.{side}"].translation
                    self.assertLess(moved.length, SLIDE, (side, moment.frame))
        self.assertGreater((stand[0].bones["foot.L"].translation - self.played[1].bones["foot.L"].translation).length, 2.5)

    def test_feet_are_where_they_step_and_not_in_the_ground(self):
        ground = land.on_way_at(0.0)[2]
        for moment in self.played.values():
            for side in ("L", "R"):
                foot, goal = moment.bones[f"foot.{side}"], moment.things[f"Foot {side}"]
                self.assertLess((foot.translation - goal.translation).length, REACHED, (side, moment.frame))
                self.assertGreater(moment.bones[f"toe.{side}"].translation.z - 0.03, ground - SUNK, (side, moment.frame))

    def test_knees_do_not_snap(self):
        for before, now, after in zip(*(list(self.played.values())[shift:] for shift in range(3))):
            for side in ("L", "R"):
                bends = [
                    moment.bones[f"thigh.{side}"].col[1].xyz.angle(moment.bones[f"shin.{side}"].col[1].xyz)
                    for moment in (before, now, after)
                ]
                jerk = math.degrees(abs(bends[0] - 2.0 * bends[1] + bends[2]))
                self.assertLess(jerk, 9.0, (side, now.frame))

    # --- the throw ------------------------------------------------------------------------------------------------

    def test_aeroplane_is_held_and_let_go_without_a_jump(self):
        held = [self.played[frame] for frame in range(1, RELEASE)]
        first = self.in_hand(held[0])
        for moment in held:
            self.assertLess((self.in_hand(moment) - first).length, 1e-4, moment.frame)
        places = [self.played[frame].things["Toy"].translation for frame in range(RELEASE - 3, RELEASE + 5)]
        ways = [later - earlier for earlier, later in itertools.pairwise(places)]
        for one, other in itertools.pairwise(ways):
            self.assertLess((other - one).length, 0.6 * max(one.length, other.length))
        turns = [self.played[frame].things["Toy"].to_quaternion() for frame in range(RELEASE, RELEASE + 4)]
        for one, other in itertools.pairwise(turns):
            self.assertLess(math.degrees(one.rotation_difference(other).angle), 20.0)

    def in_hand(self, moment):
        return moment.bones[flight.HAND].inverted() @ moment.things["Toy"].translation

    def test_aeroplane_comes_down_on_its_wheels_and_stands(self):
        last, before = (self.played[frame].things["Toy"] for frame in (self.scene.frame_end, self.scene.frame_end - 10))
        self.assertEqual(last, before)
        wheel = last @ Vector((0.98, flight.WHEEL_AHEAD, -flight.WHEELS))
        self.assertLess(abs(wheel.z - land.LEVEL), 0.02)
        highest = max(moment.things["Toy"].translation.z for moment in self.played.values())
        self.assertGreater(highest, 3.0)

    # --- the hands and the gaze -----------------------------------------------------------------------------------

    def test_hands_hold_the_remote(self):
        for side, first in (("R", 1), ("L", RELEASE + 60)):
            for frame in range(first, self.scene.frame_end + 1):
                hand, goal = self.played[frame].bones[f"hand.{side}"], self.played[frame].things[f"Hold {side}"]
                self.assertLess((hand.translation - goal.translation).length, REACHED, (side, frame))
                turn = hand.to_quaternion().rotation_difference(goal.to_quaternion()).angle
                self.assertLess(min(turn, math.tau - turn), REACHED_TURN, (side, frame))

    def test_left_hand_does_not_go_through_the_remote(self):
        half = 0.5 * Vector(transmitter.SIZE)
        for moment in self.played.values():
            for place in ((0.0, 0.0, 0.0), (0.0, 0.05, -0.012), (0.0, 0.09, 0.0)):
                point = moment.things["Remote"].inverted() @ (moment.bones["hand.L"] @ Vector(place))
                self.assertFalse(all(abs(point[axis]) < half[axis] - 0.001 for axis in range(3)), (moment.frame, place))

    def test_arm_does_not_snap(self):
        for now, after in zip(list(self.played.values())[RELEASE:], list(self.played.values())[RELEASE + 1 :]):
            for bone in ("upper_arm.L", "forearm.L", "head"):
                turn = now.bones[bone].to_quaternion().rotation_difference(after.bones[bone].to_quaternion()).angle
                self.assertLess(math.degrees(min(turn, math.tau - turn)), 26.0 if now.frame < RELEASE + 7 else 12.0, (bone, now.frame))

    def test_eyes_look_after_the_aeroplane(self):
        for frame in range(RELEASE + 16, self.scene.frame_end + 1):
            moment = self.played[frame]
            for eye in ("eye.L", "eye.R"):
                matrix = moment.bones[eye]
                gaze = moment.things["Flight"].translation - matrix.translation
                self.assertLess(matrix.col[1].xyz.angle(gaze), GAZE_ERROR, (eye, frame))

    def test_camera_has_both_in_sight(self):
        for moment in self.played.values():
            for seen in moment.seen:
                self.assertTrue(0.03 < seen.x < 0.97 and 0.03 < seen.y < 0.97 and seen.z > 2.0, (moment.frame, seen))

    # --- in any order ---------------------------------------------------------------------------------------------

    def test_frames_in_any_order(self):
        for frame in (201, 12, RELEASE, RELEASE - 1, 140, 95):
            alone = self.moment(frame)
            self.assertEqual(alone, self.played[frame])

    def test_sub_frames_lie_between(self):
        between = self.moment(RELEASE + 30.5)
        again = self.moment(3), self.moment(RELEASE + 30.5)
        self.assertEqual(again[1], between)
        before, after = (self.played[frame].things["Toy"].translation for frame in (RELEASE + 30, RELEASE + 31))
        self.assertLess((between.things["Toy"].translation - 0.5 * (before + after)).length, 0.02)
