"""The demo of inverse kinematics and look-at: it stands in a scene of its own, and does what it is to show."""

import math
import unittest
from pathlib import Path
from typing import NamedTuple

import bpy
import numpy as np
from mathutils import Vector

import support
from demo import demo_cases

MODULES = (
    "reach/scene",
    "reach/motion",
    "reach/lookout",
    "reach/butterfly",
    "reach/flower",
    "character/mannequin",
    "character/parts",
    "character/face",
    "character/limbs",
    "character/skeleton",
)
PLANTED = ("hand.R", "foot.L", "foot.R")
PLANTED_ERROR, PLANTED_TURN = 0.002, math.radians(0.5)  # m, rad
REACH_ERROR = 0.005  # m
GAZE_ERROR = math.radians(1.0)
ARM = ("upper_arm.L", "forearm.L")
ELBOW_JERK = 5.0  # degrees from one frame's step of the elbow to the next one's


def world(rig, bone):
    """A bone's matrix in the world, as evaluated."""
    evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return evaluated.matrix_world @ evaluated.pose.bones[bone].matrix


def place_of(thing):
    """An object's matrix in the world, as evaluated."""
    return thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.copy()


def pilot_of(scene):
    return next(thing for thing in scene.objects if thing.type == 'ARMATURE' and "head" in thing.pose.bones)


def turn_between(first, second):
    angle = first.to_quaternion().rotation_difference(second.to_quaternion()).angle
    return min(angle, 2.0 * math.pi - angle)


class Moment(NamedTuple):
    """What a frame shows, in the world."""

    frame: int
    bones: dict  # matrices
    goals: dict  # matrices, by bone
    butterfly: Vector
    weight: float  # of the reaching hand

    def error(self, bone):
        """How far a bone's head is from its goal."""
        return (self.bones[bone].translation - self.goals[bone].translation).length

    def elbow(self):
        """Angle between the reaching arm's two bones."""
        return self.bones[ARM[0]].col[1].xyz.angle(self.bones[ARM[1]].col[1].xyz)


class ReachingPilot(unittest.TestCase):
    """All tests look at one scene, which takes a second to build, and most at the same cycle of its frames."""

    @classmethod
    def setUpClass(cls):
        support.empty_scene()
        cls.own = bpy.context.scene
        cls.own.collection.objects.link(bpy.data.objects.new("Own", None))
        cls.own.frame_set(7)
        cls.before = cls.state_of_own()
        cls.result = demo_cases.build('IK')
        cls.scene = bpy.context.window.scene
        cls.motion = support.addon("demo.reach.motion")
        demo_cases.show_shapes(cls.scene, False)
        cls.rig = pilot_of(cls.scene)
        cls.arm_length = sum(cls.rig.data.bones[name].length for name in ARM)
        cls.butterfly = cls.rig.motus.look_at.entries["head"].target
        cls.goals = {entry.name: entry.target for entry in cls.rig.motus.ik.entries}
        cls.cycle = [cls.moment(frame) for frame in range(cls.scene.frame_start, cls.scene.frame_end + 1)]

    @classmethod
    def tearDownClass(cls):
        support.empty_scene()

    @classmethod
    def state_of_own(cls):
        scene = cls.own
        return [thing.name for thing in scene.objects], scene.frame_current, scene.render.fps, scene.world, scene.camera

    @classmethod
    def moment(cls, frame):
        cls.scene.frame_set(frame)
        rig = cls.rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
        return Moment(
            frame,
            {bone.name: rig.matrix_world @ bone.matrix for bone in rig.pose.bones},
            {bone: place_of(goal) for bone, goal in cls.goals.items()},
            place_of(cls.butterfly).translation,
            rig.motus.ik.entries["hand.L"].position_weight,
        )

    def reach(self, moment):
        """Distances from the shoulder's joint to the hand and to its goal, in lengths of the arm."""
        shoulder = moment.bones[ARM[0]].translation
        places = moment.bones["hand.L"].translation, moment.goals["hand.L"].translation
        return [(place - shoulder).length / self.arm_length for place in places]

    # --- the scene ------------------------------------------------------------------------------------------------

    def test_in_a_scene_of_its_own(self):
        self.assertEqual(self.result, {'FINISHED'})
        self.assertNotEqual(self.scene, self.own)
        self.assertEqual(self.state_of_own(), self.before)
        self.assertFalse(set(self.scene.objects) & set(self.own.objects))
        self.assertIsNotNone(self.scene.camera)
        seconds = (self.scene.frame_end - self.scene.frame_start + 1) / self.scene.render.fps
        self.assertTrue(8.0 <= seconds <= 10.0, seconds)

    def test_by_public_operators_only(self):
        self.assertEqual(sorted(self.goals), ["foot.L", "foot.R", "hand.L", "hand.R"])
        self.assertEqual([eye.name for eye in self.rig.motus.look_at.entries["head"].eyes], ["eye.L", "eye.R"])
        self.assertTrue(self.butterfly.motus.path.is_active)
        own = {'IK', 'SPLINE_IK', 'DAMPED_TRACK', 'TRACK_TO', 'LOCKED_TRACK', 'COPY_ROTATION', 'COPY_TRANSFORMS'}
        used = {constraint.type for bone in self.rig.pose.bones for constraint in bone.constraints}
        self.assertFalse(used & own, "Blender's own constraints do the work")
        folder = Path(support.addon("demo").__file__).parent
        for module in MODULES:
            self.assertNotIn("from ...", (folder / f"{module}.py").read_text(encoding="utf-8"), module)

    def test_built_twice(self):
        self.addCleanup(setattr, bpy.context.window, "scene", self.scene)
        bpy.ops.motus.demo_scene(system='IK')
        second = bpy.context.window.scene
        rig = pilot_of(second)
        goals = [entry.target for entry in rig.motus.ik.entries] + [rig.motus.look_at.entries["head"].target]
        self.assertTrue(all(goal.name in second.objects for goal in goals))
        second.frame_set(self.cycle[79].frame)
        place = world(rig, "hand.L").translation
        self.assertLess((place - self.cycle[79].bones["hand.L"].translation).length, 1e-4)

    # --- the motion -----------------------------------------------------------------------------------------------

    def test_planted_hand_and_feet_stay(self):
        first = self.cycle[0]
        for moment in self.cycle:
            for bone in PLANTED:
                matrix = moment.bones[bone]
                with self.subTest(frame=moment.frame, bone=bone):
                    self.assertLess(moment.error(bone), PLANTED_ERROR)
                    self.assertLess(turn_between(matrix, moment.goals[bone]), PLANTED_TURN)
                    self.assertLess((matrix.translation - first.bones[bone].translation).length, PLANTED_ERROR)

    def test_hips_sway(self):
        first = self.cycle[0].bones["pelvis"].translation
        widest = max((moment.bones["pelvis"].translation - first).length for moment in self.cycle)
        self.assertTrue(0.05 < widest < 0.15, widest)

    def test_hand_reaches_what_it_can(self):
        softness = self.rig.motus.ik.entries["hand.L"].softness
        self.assertGreater(softness, 0.0)
        start, end = self.motion.FULL_REACH
        reached = missed = 0
        for moment in self.cycle:
            if not start <= moment.frame <= end:
                continue
            self.assertAlmostEqual(moment.weight, 1.0, places=5)
            hand, goal = self.reach(moment)
            with self.subTest(frame=moment.frame):
                if goal < 1.0 - softness:
                    reached += 1
                    self.assertLess(moment.error("hand.L"), REACH_ERROR)
                else:
                    self.assertTrue(1.0 - softness - 1e-3 < hand < 1.0 + 1e-4, hand)
                missed += goal > 1.15
        self.assertGreater(reached, 24, "frames on which the hand is at the butterfly")
        self.assertGreater(missed, 8, "frames on which the butterfly is out of reach")

    def test_the_daisy_stretches_and_keeps_its_volume(self):
        daisy = next(thing for thing in self.scene.objects if thing.type == 'ARMATURE' and thing != self.rig)
        stem = [bone.name for bone in daisy.data.bones if bone.name.startswith("Stem")]
        longest = 0.0
        for moment in self.cycle[::12]:
            self.scene.frame_set(moment.frame)
            scales = [world(daisy, name).to_scale() for name in stem]
            longest = max(longest, *(scale.y for scale in scales))
            for scale in scales:
                self.assertAlmostEqual(scale.x * scale.y * scale.z, 1.0, places=4)
            np.testing.assert_allclose(world(daisy, "Blossom").to_scale(), 1.0, atol=1e-4)
        self.assertGreater(longest, 1.2)

    def test_arm_never_snaps(self):
        for before, now, after in zip(self.cycle, self.cycle[1:], self.cycle[2:]):
            with self.subTest(frame=now.frame):
                for bone in (*ARM, "hand.L"):
                    self.assertLess(math.degrees(turn_between(before.bones[bone], now.bones[bone])), 10.0, bone)
                change = before.elbow() - 2.0 * now.elbow() + after.elbow()
                self.assertLess(abs(math.degrees(change)), ELBOW_JERK)

    def test_hand_hangs_while_it_does_not_reach(self):
        resting = [moment for moment in self.cycle if moment.weight == 0.0]
        self.assertGreater(len(resting), 24)
        for moment in resting:
            height = moment.bones["hand.L"].translation.z - moment.bones["thigh.L"].translation.z
            self.assertLess(abs(height), 0.12, moment.frame)

    def test_eyes_look_at_the_butterfly(self):
        for moment in self.cycle:
            for eye in ("eye.L", "eye.R"):
                matrix = moment.bones[eye]
                with self.subTest(frame=moment.frame, eye=eye):
                    gaze = moment.butterfly - matrix.translation
                    self.assertLess(matrix.col[1].xyz.angle(gaze), GAZE_ERROR)

    def test_cycle_closes(self):
        """A cycle later everything is as it was, on both sides of the seam."""
        for frame in (-2, 0, 1, 2, 5):
            first, later = (self.moment(place) for place in (frame, frame + self.motion.CYCLE))
            with self.subTest(frame=frame):
                self.assertLess((first.butterfly - later.butterfly).length, 1e-3)
                for bone, matrix in first.bones.items():
                    self.assertLess((later.bones[bone].translation - matrix.translation).length, 2e-3, bone)

    def test_frames_in_any_order(self):
        played = self.cycle[99]
        self.moment(3)
        alone = self.moment(played.frame)
        for bone, matrix in played.bones.items():
            self.assertLess((alone.bones[bone].translation - matrix.translation).length, 1e-6, bone)
