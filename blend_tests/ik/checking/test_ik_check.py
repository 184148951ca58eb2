"""Checking chains over a range of frames."""

import math
import types

import bpy
from mathutils import Vector

import support
from ik.checking.ik_check_cases import CheckTestCase
from ik.ik_cases import REACHABLE, turn


class Frames(CheckTestCase):
    FAR = ((1, REACHABLE), (12, (2.0, 0.0, 1.0)), (41, REACHABLE), (77, (1.4, 0.0, 1.0)), (78, REACHABLE))

    def test_out_of_reach(self):
        self.moving(self.FAR)
        entry = self.reach()
        self.check()
        reach = sum(self.rigged.data.bones[name].length for name in ("Bone 0", "Bone 1"))
        self.assertEqual((entry.check_range, entry.check_frames, entry.check_reason), ("1-100", "12-40, 77", 'FAR'))
        self.assertAlmostEqual(entry.check_worst, 2.0 - reach, places=5)
        self.assertIn("Out of reach on frames 12-40, 77, at most 66.56 cm short", self.told(entry))

    def test_all_is_well(self):
        self.target()
        entry = self.reach()
        self.check()
        self.assertEqual((entry.check_frames, entry.check_worst, entry.check_reason), ("", 0.0, 'NONE'))
        self.assertEqual(self.told(entry), "Reaches its target on all frames 1-100")

    def test_a_later_check_replaces_the_first(self):
        target = self.moving(self.FAR)
        entry = self.reach()
        self.check()
        target.animation_data_clear()
        target.location = REACHABLE
        self.check(frame_start=5, frame_end=50)
        self.assertEqual((entry.check_range, entry.check_frames, entry.check_worst), ("5-50", "", 0.0))

    def test_range_and_step(self):
        self.moving(self.FAR)
        entry = self.reach()
        self.check(frame_start=30, frame_end=60, step=2.0)
        self.assertEqual((entry.check_range, entry.check_frames), ("30-60", "30-40"))
        self.scene.frame_set(15)
        self.check(use_range=False)
        self.assertEqual((entry.check_range, entry.check_frames), ("15", "15"))

    def test_too_near(self):
        self.rigged.pose.bones["Bone 1"].scale = (1.0, 1.0, 1.0)
        rig = self.arm(((0.0, 3.0, 1.0), (1.0, 3.0, 1.1), (1.2, 3.0, 1.0)), "Rig")
        self.target((0.1, 3.0, 1.0), "Near")
        entry = self.reach("Bone 1", rig.name, "Near")
        bpy.ops.motus.ik_check(object=rig.name, frame_start=1, frame_end=3)
        self.assertEqual((entry.check_reason, entry.check_frames), ('NEAR', "1-3"))
        self.assertIn("Too near on frames 1-3", self.told(entry))

    def test_limits(self):
        for name in ("Bone 0", "Bone 1"):
            bone = self.rigged.pose.bones[name]
            for axis in "xyz":
                setattr(bone, f"use_ik_limit_{axis}", True)
                setattr(bone, f"ik_min_{axis}", -0.05)
                setattr(bone, f"ik_max_{axis}", 0.05)
        self.target((0.0, 0.9, 1.2))
        entry = self.reach(use_limits=True)
        self.check(frame_start=1, frame_end=2)
        self.assertEqual(entry.check_reason, 'LIMIT')
        self.assertGreater(entry.check_worst, 0.1)

    def test_orientation(self):
        """Turned by half a turn, the last bone leaves the other one too short."""
        target = self.target((1.25, 0.0, 1.0))
        target.rotation_euler = (0.0, 0.0, math.pi / 2.0)
        entry = self.reach()
        entry.rotation_weight, entry.rotation_offset = 1.0, (0.0, 0.0, 0.0)
        self.assertRegex(self.sentence(self.rigged), "^With the target's orientation .* are left$")
        self.check(frame_start=1, frame_end=2)
        self.assertEqual((entry.check_frames, entry.check_reason), ("1-2", 'TURN'))
        self.assertAlmostEqual(entry.check_worst, self.output(self.rigged, "Bone 1.residual"), places=6)
        self.assertIn("Too far with the target's orientation on frames 1-2", self.told(entry))

    def test_half_stretched(self):
        self.target((2.0, 0.0, 1.0))
        self.reach(stretch=0.5)
        left = support.addon("ik.status").length(bpy.context, self.output(self.rigged, "Bone 1.residual"))
        self.assertEqual(self.sentence(self.rigged), f"The target is {left} too far away")

    def test_a_check_of_before_a_change(self):
        target = self.moving(self.FAR)
        entry = self.reach()
        self.check()
        outdated = support.addon("ik.checking.results").contradicts
        self.assertFalse(outdated(entry, 20, 'FAR') or outdated(entry, 77, 'NEAR') or outdated(entry, 50, 'NONE'))
        self.assertTrue(outdated(entry, 20, 'NONE') and outdated(entry, 50, 'FAR'))
        self.assertTrue(outdated(entry, 20, 'UNSOLVED') and outdated(entry, 50, 'ANIMATED'))
        self.assertFalse(outdated(entry, 101, 'FAR'))
        self.check(frame_start=-20, frame_end=-5)
        self.assertEqual(entry.check_frames, "")
        self.assertTrue(outdated(entry, -10, 'FAR'))
        panel = support.addon("ik.tools_panel")
        self.scene.frame_set(-10)
        bpy.context.view_layer.update()
        self.assertFalse(panel.is_outdated(bpy.context, self.rigged, entry))
        target.animation_data_clear()
        target.location = (3.0, 0.0, 1.0)
        bpy.context.view_layer.update()
        self.assertTrue(panel.is_outdated(bpy.context, self.rigged, entry))

    def test_only_frames_that_were_checked_contradict(self):
        self.moving(((1, REACHABLE), (11, (2.0, 0.0, 1.0)), (20, REACHABLE)))
        entry = self.reach()
        self.check(step=10.0)
        self.assertEqual((entry.check_range, entry.check_frames), ("1-91", "11"))
        panel = support.addon("ik.tools_panel")
        for frame in (1, 11, 12, 19, 20, 21, 91, 95):
            self.scene.frame_set(frame)
            self.assertFalse(panel.is_outdated(bpy.context, self.rigged, entry), frame)
        outdated = support.addon("ik.checking.results").contradicts
        self.assertTrue(outdated(entry, 11, 'NONE') and outdated(entry, 21, 'FAR'))
        self.check(step=0.3, frame_end=5)  # in single precision: 1, 1.3, 1.6, 1.9, 2.2, 2.5, 2.8, 3.1, 3.4, 3.7, 4.0000001
        self.assertTrue(outdated(entry, 4, 'FAR'))
        self.assertFalse(outdated(entry, 3, 'FAR'))

    def test_softness_hides_no_orientation(self):
        target = self.target((1.25, 0.0, 1.0))
        target.rotation_euler = (0.0, 0.0, math.pi / 2.0)
        entry = self.reach(softness=0.02, rotation_weight=1.0, keep_rotation=False)
        self.check(frame_start=1, frame_end=2)
        self.assertEqual((entry.check_frames, entry.check_reason), ("1-2", 'TURN'))

    def test_softness_is_no_fault(self):
        self.target(Vector((1.3, 0.0, 1.0)))
        entry = self.reach(softness=0.3)
        self.assertIn("Softness", self.sentence(self.rigged))
        self.check(frame_start=1, frame_end=2)
        self.assertEqual(entry.check_frames, "")

    def test_weight_0_and_muted_do_not_count(self):
        self.target((3.0, 0.0, 1.0))
        entry = self.reach()
        entry.position_weight = 0.0
        entry.keyframe_insert("position_weight", frame=10)
        entry.position_weight = 1.0
        entry.keyframe_insert("position_weight", frame=11)
        self.check(frame_end=20)
        self.assertEqual((entry.check_range, entry.check_frames), ("11-20", "11-20"))
        entry.is_muted = True
        self.check(frame_end=20)
        self.assertEqual((entry.check_range, entry.check_frames), ("", ""))

    def test_all_chains_or_one(self):
        self.arm(((0.0, 2.0, 1.0), (0.7, 2.1, 1.0), (1.3, 2.0, 1.0)), "Other")
        bpy.data.objects["Other"].name = "Two"
        rig = self.rigged
        self.target((3.0, 0.0, 1.0), "Far")
        first = self.reach("Bone 1", target="Far")
        second = self.reach("Hand", target="Far", chain_length=1)
        self.check(bone="Hand", frame_end=2)
        first, second = rig.motus.ik.entries["Bone 1"], rig.motus.ik.entries["Hand"]
        self.assertEqual((first.check_frames, second.check_frames), ("", "1-2"))
        self.assertEqual(first.check_range, "")
        self.check(frame_end=2)
        self.assertEqual((first.check_frames, second.check_frames), ("1-2", "1-2"))


class Everything(CheckTestCase):
    def test_is_as_it_was(self):
        target = self.moving(Frames.FAR)
        self.reach()
        bone = self.rigged.pose.bones["Bone 0"]
        bone.keyframe_insert("rotation_quaternion", frame=1)
        self.scene.frame_set(7, subframe=0.25)
        turn(bone, (1.0, 0.0, 0.0), 0.7)
        target.location = (0.1, 0.2, 0.3)
        before = tuple(bone.rotation_quaternion), tuple(target.location)
        self.check()
        self.assertEqual((tuple(bone.rotation_quaternion), tuple(target.location)), before)
        self.assertEqual((self.scene.frame_current, self.scene.frame_subframe), (7, 0.25))

    def begun(self, count):
        """(The operator without Blender's part of it, its steps of 100 frames) after so many of these."""
        cls = support.addon("ik.checking.operators").MOTUS_OT_ik_check
        own = {name: value for name, value in vars(cls).items() if isinstance(value, types.FunctionType)}
        walker = type("Walker", (), own | {"object": "Rig", "bone": "", "step": 1.0, "report": lambda *_: None})()
        steps = walker.steps(bpy.context, list(range(1, 101)))
        for _ in range(count):
            next(steps)
        return walker, steps

    def test_cancelled(self):
        self.moving(Frames.FAR)
        entry = self.reach()
        self.scene.frame_set(5)
        _, steps = self.begun(30)
        steps.close()
        self.assertEqual((self.scene.frame_current, entry.check_range), (5, ""))

    def test_scripts_change_the_list_meanwhile(self):
        self.moving(Frames.FAR)
        self.reach()
        walker, steps = self.begun(30)
        entries = self.rigged.motus.ik.entries
        with support.addon("core.settings.entries").unwired(self.rigged.motus.ik):
            for index in range(200):  # Blender moves the list in memory
                entries.add().name = f"More {index}"
            self.assertEqual(len(list(steps)), 70)
            walker.result(bpy.context)
            self.assertEqual([entry.check_range for entry in entries], ["1-100"] + 200 * [""])

    def test_refusals(self):
        self.assertRefused("Nothing here", bpy.ops.motus.ik_check, object="Rig")
        self.reach()
        self.assertRefused("range is empty", bpy.ops.motus.ik_check, object="Rig", frame_start=3, frame_end=1)
        self.assertRefused("has no inverse", bpy.ops.motus.ik_check, object="Rig", bone="Hand")
        bpy.ops.motus.bake(object="Rig", frame_start=1, frame_end=2)
        self.assertRefused("is baked", bpy.ops.motus.ik_check, object="Rig")


class Text(support.SceneTestCase):
    def test_ranges(self):
        ranges = support.addon("core.blender.frames").ranges
        self.assertEqual(ranges([], 1.0), "")
        self.assertEqual(ranges([5], 1.0), "5")
        self.assertEqual(ranges([1, 2, 3, 7, 9, 10], 1.0), "1-3, 7, 9-10")
        self.assertEqual(ranges([1.0, 1.5, 2.0, 3.0], 0.5), "1-2, 3")
        self.assertEqual(ranges([-3, -2, 4], 1), "-3--2, 4")

    def test_large_frames(self):
        """An exponent would be nothing to read, and other frames."""
        results, frames = support.addon("ik.checking.results"), support.addon("core.blender.frames")
        self.assertEqual(frames.ranges([1048573, 1048574, 1048575, 1048600.25], 1.0), "1048573-1048575, 1048600.25")
        entry = type("Entry", (results.CheckResults,), {})()
        results.store(entry, [1048573, 1048574, 1048575], 1.0, [1048574], 1.0, 'FAR')
        self.assertEqual((entry.check_range, entry.check_frames), ("1048573-1048575", "1048574"))
        self.assertTrue(results.contradicts(entry, 1048575, 'FAR'))
        self.assertFalse(results.contradicts(entry, 1048574, 'FAR'))
