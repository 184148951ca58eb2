"""Look At, measured on the evaluated pose: where the gaze goes, who takes which share, limits, and time."""

import math
import random

import bpy
from mathutils import Euler, Matrix, Quaternion, Vector

import support
from look_at.look_at_cases import BODY, EYES, FAR, LookAtTestCase, build_rig, direction

HIT = 2e-3  # degrees: what single precision leaves of a matrix' direction
FRAMES = [1, 61, 33, 40.5, 12, 50.25, 21, 3]


class Gaze(LookAtTestCase):
    def test_the_head_meets_its_target(self):
        for distance in (0.6, 3.0, 1000.0):
            for yaw, pitch in ((0, 0), (50, 0), (-50, 10), (20, 40), (-15, -45), (60, 20)):
                self.aim(yaw, pitch, distance)
                self.look()
                self.assertLess(self.off("Head"), HIT, (distance, yaw, pitch))
                self.assertLess(math.degrees(self.told("angle")), HIT)
                self.assertEqual(self.told("reason"), self.reasons.REACHED)

    def test_a_posed_figure_meets_it_too(self):
        generator = random.Random(1)
        for bone in self.rig.pose.bones:
            turn = Euler([generator.uniform(-0.3, 0.3) for _ in range(3)])
            bone.rotation_quaternion = turn.to_quaternion()
        self.aim(30, 10, 2.0)
        self.look()
        self.assertLess(self.off("Head"), HIT)

    def test_scaled_and_turned_rigs(self):
        generator = random.Random(2)
        for scale in ((1.0, 1.0, 1.0), (2.5, 2.5, 2.5), (0.01, 0.01, 0.01), (1.0, 2.0, 0.5)):
            with self.subTest(scale):
                self.rig.location = [generator.uniform(-3.0, 3.0) for _ in range(3)]
                self.rig.rotation_euler = [generator.uniform(-3.0, 3.0) for _ in range(3)]
                self.rig.scale = scale
                self.aim(35, 15, 2.0)
                self.look()
                self.assertLess(self.off("Head"), 5 * HIT)

    def test_scaled_bones(self):
        self.rig.pose.bones["Spine"].scale = (1.0, 1.6, 0.8)
        self.rig.pose.bones["Head"].scale = (1.3, 0.9, 1.1)
        self.aim(25, 20, 1.5)
        self.look()
        self.assertLess(self.off("Head"), 5 * HIT)

    def test_a_leaning_head_stays_as_it_is_before_a_target_in_front(self):
        bones = {
            "Chest": ("", (0, 0, 1.0), (0, 0, 1.5)),
            "Neck": ("Chest", (0, 0, 1.5), (0, -0.05, 1.6)),
            "Head": ("Neck", (0, -0.05, 1.6), (0, -0.15, 1.8)),
        }
        rig = build_rig(bones, "Leaning")
        before = self.poses(rig)
        bpy.ops.motus.look_at_add(object="Leaning")
        entry = rig.motus.look_at.entries["Head"]
        bpy.context.view_layer.update()
        self.assertSamePoses(self.poses(rig), before, 2e-6)
        self.assertLess(entry.target.location.y, -0.5)

    def test_a_given_axis(self):
        self.aim(20, 10, 2.0)
        self.look(head_forward='POS_X', clamp=0.0, head_limit=math.pi)
        self.assertLess(self.off("Head", (1, 0, 0)), HIT)
        self.look(head_forward='NEG_Z', clamp=0.0, head_limit=math.pi)
        self.assertLess(self.off("Head", (0, 0, -1)), HIT)

    def test_a_bone_as_target(self):
        other = build_rig(name="Other")
        other.location = (1.5, -2.0, 0.2)
        other.pose.bones["Spine"].rotation_quaternion = Euler((0.4, 0.0, 0.3)).to_quaternion()
        self.look(target="Other", target_bone="Head")
        bpy.context.view_layer.update()
        way = self.pose("Head", other).translation - self.pose("Head").translation
        self.assertLess(math.degrees(self.gaze("Head").angle(way)), HIT)

    def test_a_bone_of_its_own_rig_as_target(self):
        self.rig.pose.bones["UpperArm.L"].rotation_quaternion = Euler((0.0, 0.0, -0.8)).to_quaternion()
        self.look(target="Rig", target_bone="Thigh.L", clamp=0.0, head_limit=math.pi, body_limit=math.pi)
        way = self.pose("Thigh.L").translation - self.pose("Head").translation
        self.assertLess(math.degrees(self.gaze("Head").angle(way)), 1e-2)

    def test_two_figures_look_at_each_other(self):
        other = build_rig(name="Other")
        other.location, other.rotation_euler = (0.5, -3.0, 0.3), (0.0, 0.0, 3.0)
        # Both at the other's hips, which no head moves.
        self.look(target="Other", target_bone="Hips")
        self.look("Other", target="Rig", target_bone="Hips")
        bpy.context.view_layer.update()
        for one, two in ((self.rig, other), (other, self.rig)):
            way = self.pose("Hips", two).translation - self.pose("Head", one).translation
            self.assertLess(math.degrees(self.gaze("Head", rig=one).angle(way)), HIT)


class Shares(LookAtTestCase):
    def assertYaws(self, body, head, eyes=0.0):
        for name in BODY:
            self.assertAlmostEqual(self.yaw(name), body / len(BODY), delta=5e-3, msg=name)
        self.assertAlmostEqual(self.yaw("Head"), head, delta=5e-3)
        for name in EYES:
            self.assertAlmostEqual(self.yaw(name), eyes, delta=5e-3, msg=name)

    def setUp(self):
        super().setUp()
        self.aim(40)

    def test_unity_defaults(self):
        entry = self.look()
        weights = entry.weight, round(entry.body_weight, 6), entry.head_weight, entry.eyes_weight
        self.assertEqual(weights, (1, 0.3, 1, 0))
        self.assertYaws(12.0, 28.0)

    def test_body_head_and_eyes(self):
        self.look(body_weight=0.25, head_weight=0.5, eyes_weight=1.0)
        self.assertYaws(10.0, 15.0, 15.0)
        self.assertLess(self.off("Eye.L"), HIT)
        self.assertLess(math.degrees(self.told("angle")), HIT)

    def test_what_the_weights_leave_is_told(self):
        self.look(body_weight=0.25, head_weight=0.5, eyes_weight=0.4)
        self.assertYaws(10.0, 15.0, 6.0)
        self.assertAlmostEqual(math.degrees(self.told("angle")), 9.0, delta=5e-3)
        self.assertEqual(self.told("reason"), self.reasons.REACHED)
        self.assertIn("weights leave 9.0 degrees", self.reasons.sentence(self.told("reason"), self.told("angle")))

    def test_body_alone(self):
        self.look(body_weight=1.0, head_weight=0.0)
        self.assertYaws(40.0, 0.0)

    def test_general_weight(self):
        self.look(weight=0.5)
        self.assertYaws(6.0, 14.0)
        entry = self.look(weight=0.0)
        self.assertYaws(0.0, 0.0)
        entry.weight = 1.0
        entry.is_muted = True
        bpy.context.view_layer.update()
        self.assertYaws(0.0, 0.0)
        self.assertEqual(self.told("reason"), self.reasons.MUTED)

    def test_influence_scales_the_weight(self):
        self.look()
        self.rig.motus.look_at.influence = 0.25
        bpy.context.view_layer.update()
        self.assertYaws(3.0, 7.0)

    def test_weight_zero_is_exactly_the_animation(self):
        for bone in self.rig.pose.bones:
            bone.rotation_quaternion = Euler((0.2, -0.1, 0.3)).to_quaternion()
        bpy.context.view_layer.update()
        before = self.poses()
        self.look(weight=0.0, eyes_weight=1.0)
        self.assertSamePoses(self.poses(), before, 5e-7)

    def test_yaw_and_pitch_of_the_target_are_told(self):
        self.aim(25, 35)
        self.look()
        self.assertAlmostEqual(math.degrees(self.told("yaw")), 25.0, delta=0.01)
        self.assertAlmostEqual(math.degrees(self.told("pitch")), 35.0, delta=0.01)

    def test_no_bones_of_the_body(self):
        self.look(body_length=0)
        self.assertYaws(0.0, 40.0)

    def test_bones_that_do_not_turn_stay(self):
        before = self.poses()
        self.look(eyes_weight=1.0)
        self.assertSamePoses(
            {name: self.poses()[name] for name in ("Hips", "Thigh.L", "Shin.L")},
            {name: before[name] for name in ("Hips", "Thigh.L", "Shin.L")},
            0.0,
        )


class Limits(LookAtTestCase):
    def test_head_limit(self):
        self.aim(40)
        self.look(body_weight=0.0, head_limit=math.radians(20))
        turned = self.yaw("Head")
        self.assertLess(turned, 20.01)
        self.assertGreater(turned, 15.9)
        self.assertEqual(self.told("reason"), self.reasons.LIMIT)
        self.assertAlmostEqual(math.degrees(self.told("angle")), 40.0 - turned, delta=5e-3)
        self.assertRegex(self.reasons.sentence(self.told("reason"), self.told("angle")), "degrees beyond the limits")

    def test_body_limit_leaves_more_to_the_head(self):
        self.aim(40)
        self.look(body_weight=1.0, body_limit=math.radians(10))
        turned = sum(self.yaw(name) for name in BODY)
        self.assertLess(turned, 10.01)
        self.assertAlmostEqual(self.yaw("Head"), 40.0 - turned, delta=5e-3)

    def test_eyes_limit(self):
        self.aim(40)
        self.look(body_weight=0.0, head_weight=0.0, eyes_weight=1.0, eyes_limit=math.radians(15))
        for name in EYES:
            self.assertLess(self.yaw(name), 15.01)
            self.assertGreater(self.yaw(name), 11.9)

    def test_each_direction_has_a_limit_of_its_own(self):
        limits = {"left": 20.0, "right": 25.0, "up": 15.0, "down": 10.0}
        seen = {"left": (70, 0), "right": (-70, 0), "up": (0, 60), "down": (0, -60)}
        for part, bone in (("head", "Head"), ("eyes", "Eye.L")):
            weights = {"body_weight": 0.0, "head_weight": 0.0, "eyes_weight": 0.0, f"{part}_weight": 1.0}
            keywords = {f"{part}_{side}_limit": math.radians(angle) for side, angle in limits.items()}
            self.look(clamp=0.0, eyes_limit=math.pi, head_limit=math.pi, **weights, **keywords)
            for side, aim in seen.items():
                with self.subTest(part=part, side=side):
                    self.aim(*aim)
                    turned = math.degrees(self.gaze(bone).angle(Vector((0.0, -1.0, 0.0))))
                    self.assertAlmostEqual(turned, limits[side], delta=0.01)
                    self.assertEqual(self.told("reason"), self.reasons.LIMIT)

    def test_clamp(self):
        self.aim(120)
        for clamp, least, most in ((1.0, 0.0, 1e-3), (0.5, 71.9, 90.01), (0.0, 119.99, 120.01)):
            self.look(clamp=clamp, head_limit=math.pi, body_limit=math.pi)
            turned = sum(self.yaw(name) for name in (*BODY, "Head"))
            self.assertGreaterEqual(turned, least, clamp)
            self.assertLessEqual(turned, most, clamp)

    def test_no_jump_as_the_target_goes_round(self):
        """From frame to frame the gaze moves by little more than the target does."""
        self.look(eyes_weight=1.0)
        last, worst = None, 0.0
        for step in range(721):
            self.aim(0.5 * step - 180.0, 15.0, 3.0)
            bpy.context.view_layer.update()
            gaze = self.gaze("Eye.L")
            if last is not None:
                worst = max(worst, math.degrees(gaze.angle(last)))
            last = gaze
        self.assertLess(worst, 4.0)


class Targets(LookAtTestCase):
    def setUp(self):
        super().setUp()
        self.aim(40)
        self.other = self.link("Other", location=self.rig.data.bones["Head"].head_local + FAR * direction(-20))
        self.entry = self.look(body_weight=0.0)
        self.assertEqual(bpy.ops.motus.look_at_target_add(object="Rig", bone="Head", target="Other"), {'FINISHED'})

    def test_the_mean_by_weight(self):
        for first, second, wanted in ((1.0, 1.0, 10.0), (1.0, 0.0, 40.0), (0.0, 1.0, -20.0), (0.25, 0.25, 5.0), (0.0, 0.0, 0.0)):
            with self.subTest(first=first, second=second):
                self.entry.target_weight, self.entry.extra_targets[0].weight = first, second
                self.assertAlmostEqual(self.yaw("Head"), wanted, delta=5e-3)

    def test_opposed_targets(self):
        self.aim(100)
        self.other.location = self.rig.data.bones["Head"].head_local + FAR * direction(-100)
        self.assertAlmostEqual(self.yaw("Head"), 0.0, delta=5e-3)
        self.assertEqual(self.told("reason"), self.reasons.REACHED)

    def test_keyed_weights_in_any_order(self):
        support.key(self.entry, "target_weight", {1: 1.0, 21: 0.0})
        support.key(self.entry.extra_targets[0], "weight", {1: 0.0, 21: 1.0})
        self.assertInAnyOrder()

    def assertInAnyOrder(self):
        found = {}
        for frame in (1, 6, 11, 16, 21):
            self.scene.frame_set(frame)
            found[frame] = self.yaw("Head")
        self.assertAlmostEqual(found[1], 40.0, delta=5e-3)
        self.assertAlmostEqual(found[11], 10.0, delta=5e-3)
        self.assertAlmostEqual(found[21], -20.0, delta=5e-3)
        for frame in (16, 1, 21, 6, 11):
            self.scene.frame_set(frame)
            self.assertEqual(self.yaw("Head"), found[frame])

    def test_a_further_target_that_is_missing_has_no_weight(self):
        bpy.data.objects.remove(self.other)
        self.assertAlmostEqual(self.yaw("Head"), 40.0, delta=5e-3)

    def test_removing_restores_and_takes_its_keys_along(self):
        self.assertEqual(bpy.ops.motus.look_at_target_add(object="Rig", bone="Head", target="Other"), {'FINISHED'})
        for number in range(2):
            support.key(self.entry.extra_targets[number], "weight", {1: float(number), 21: 0.5})
        self.assertEqual(bpy.ops.motus.look_at_target_remove(object="Rig", bone="Head", index=0), {'FINISHED'})
        paths = [curve.data_path for curve in support.addon("core.blender.actions").curves_of(self.rig.animation_data)]
        self.assertEqual(paths, ["motus.look_at.entries[0].extra_targets[0].weight"])
        self.scene.frame_set(1)
        self.assertAlmostEqual(self.entry.extra_targets[0].weight, 1.0, delta=1e-6)
        bpy.ops.motus.look_at_target_remove(object="Rig", bone="Head")
        self.assertAlmostEqual(self.yaw("Head"), 40.0, delta=5e-3)
        with self.assertRaisesRegex(RuntimeError, "no such target"):
            bpy.ops.motus.look_at_target_remove(object="Rig", bone="Head")

    def test_a_target_on_the_head_is_refused(self):
        with self.assertRaisesRegex(RuntimeError, "cannot look at it"):
            bpy.ops.motus.look_at_target_add(object="Rig", bone="Head", target="Rig", target_bone="Eye.L")


class Time(LookAtTestCase):
    def animate(self):
        for frame, yaw in ((1, -60), (30, 50), (61, 10)):
            self.aim(yaw, 20.0 - frame / 3.0, 2.0)
            self.target.keyframe_insert("location", frame=frame)
            self.rig.pose.bones["Chest"].rotation_quaternion = Euler((0.0, 0.005 * frame, 0.0)).to_quaternion()
            self.rig.pose.bones["Chest"].keyframe_insert("rotation_quaternion", frame=frame)

    def test_any_frame_equals_playback(self):
        self.animate()
        entry = self.look(eyes_weight=0.5, head_weight=0.7)
        for frame, weight in ((1, 0.0), (61, 1.0)):
            entry.weight = weight
            self.rig.keyframe_insert("motus.look_at.entries[0].weight", frame=frame)
        played = {}
        for frame in range(1, 62):
            self.go_to(frame)
            played[frame] = self.poses()
        for frame in FRAMES + random.Random(3).sample(range(1, 62), 20):
            self.go_to(frame)
            if frame in played:
                self.assertSamePoses(self.poses(), played[frame], 0.0)

    def test_a_keyed_weight(self):
        self.aim(40)
        entry = self.look()
        for frame, weight in ((1, 0.0), (21, 1.0)):
            entry.weight = weight
            entry.keyframe_insert("weight", frame=frame)
        curve = support.addon("core.blender.actions").find(self.rig, entry.path_from_id("weight"))
        for key in curve.keyframe_points:
            key.interpolation = 'LINEAR'
        for frame in (11, 1, 21, 6):
            self.go_to(frame)
            self.assertAlmostEqual(self.yaw("Head"), 28.0 * (frame - 1) / 20.0, delta=5e-3)

    def test_a_driven_weight(self):
        self.aim(40)
        self.look()
        self.rig["share"] = 0.5
        curve = self.rig.driver_add("motus.look_at.entries[0].weight")
        variable = curve.driver.variables.new()
        variable.name = "v"
        variable.targets[0].id, variable.targets[0].data_path = self.target, "scale.x"
        curve.driver.expression = "v/2"
        for scale in (1.0, 0.5, 0.0, 2.0):
            self.target.scale.x = scale
            for _ in range(2):
                bpy.context.view_layer.update()
            self.assertAlmostEqual(self.yaw("Head"), 14.0 * scale, delta=5e-3)

    def test_a_driven_weight_is_not_a_frame_late(self):
        self.aim(40)
        self.look()
        for frame, scale in ((1, 0.0), (21, 2.0)):
            self.target.scale.x = scale
            self.target.keyframe_insert("scale", index=0, frame=frame)
        curve = self.rig.driver_add("motus.look_at.entries[0].weight")
        variable = curve.driver.variables.new()
        variable.name = "v"
        variable.targets[0].id, variable.targets[0].data_path = self.target, "scale.x"
        curve.driver.expression = "v/2"
        bpy.context.view_layer.update()
        for frame in (11, 1, 21, 6, 17):
            self.go_to(frame)
            self.assertAlmostEqual(self.yaw("Head"), 14.0 * self.target.scale.x, delta=5e-3, msg=f"frame {frame}")

    def test_a_driven_bone_of_the_spine_is_waited_for(self):
        self.look()
        self.aim(30, 0, 1.0)
        for frame, x in ((1, 0.0), (21, 0.5)):
            self.target.location.x = x
            self.target.keyframe_insert("location", index=0, frame=frame)
        bone = self.rig.pose.bones["Chest"]
        bone.rotation_mode = 'XYZ'
        curve = bone.driver_add("rotation_euler", 0)
        variable = curve.driver.variables.new()
        variable.name = "v"
        variable.targets[0].id, variable.targets[0].data_path = self.target, "location.x"
        curve.driver.expression = "v"
        bpy.ops.motus.refresh(object="Rig", system="look_at")
        for frame in (11, 1, 21, 6, 17):
            self.go_to(frame)
            self.assertLess(self.off("Head"), HIT, f"frame {frame}")

    def test_a_moving_target_is_not_a_frame_late(self):
        carrier = self.link("Carrier")
        self.target.parent = carrier
        self.target.location = (0.0, -2.0, 1.6)
        for frame, angle in ((1, -1.0), (41, 1.0)):
            carrier.rotation_euler.z = angle
            carrier.keyframe_insert("rotation_euler", index=2, frame=frame)
        self.look()
        for frame in (20.5, 1, 41, 9, 33):
            self.go_to(frame)
            self.assertLess(self.off("Head"), HIT, f"frame {frame}")


class Told(LookAtTestCase):
    """What the panel shows of the outputs."""

    def setUp(self):
        super().setUp()
        self.aim(40)
        self.look()
        bpy.context.view_layer.update()

    def outputs(self):
        return support.addon("look_at.panel").outputs_of(bpy.context, self.rig, "Head")

    def test_nothing_after_a_change_of_mode(self):
        """Blender 5 copies the rig anew without solving it: those zeros are no angles."""
        before = self.outputs()
        self.assertAlmostEqual(math.degrees(before["yaw"]), 40.0, delta=1e-3)
        bpy.ops.object.mode_set(mode='POSE')
        self.assertIn(self.outputs(), (before, None))
        bpy.context.view_layer.update()
        self.assertIn(self.outputs(), (before, None))
        self.scene.frame_set(2)
        self.assertEqual(self.outputs(), before)

    def test_zeros_that_were_solved(self):
        hub = self.rig.motus.look_at.hub.data.evaluated_get(bpy.context.evaluated_depsgraph_get())
        box = hub["motus_look_at_out"]
        for slot in range(2, 6):
            box[slot] = 0.0
        self.assertEqual(self.outputs(), dict.fromkeys(("angle", "reason", "yaw", "pitch"), 0.0))
        box[1] = 0.0
        self.assertIsNone(self.outputs())


class Copies(LookAtTestCase):
    def test_a_copied_rig_looks_for_itself(self):
        self.aim(30, 10, 2.0)
        self.look(eyes_weight=1.0)
        copy = self.rig.copy()
        self.scene.collection.objects.link(copy)
        copy.location = (1.2, 0.5, 0.0)
        bpy.context.view_layer.update()
        for rig in (self.rig, copy):
            self.assertLess(self.off("Head", rig=rig), HIT)
        before = self.poses(self.rig)
        copy.motus.look_at.entries[0].weight = 0.0
        bpy.context.view_layer.update()
        self.assertLess(abs(math.degrees(self.gaze("Head", rig=copy).angle(-Matrix.Identity(3).col[1]))), HIT)
        self.assertSamePoses(self.poses(self.rig), before, 0.0)

    def test_a_copy_after_the_settings_were_driven(self):
        self.aim(40)
        self.look()
        self.rig.driver_add("motus.look_at.entries[0].weight").driver.expression = "0.5"
        for _ in range(2):
            bpy.context.view_layer.update()
        copy = self.rig.copy()
        self.scene.collection.objects.link(copy)
        copy.rotation_euler.z = 0.3
        for _ in range(3):
            bpy.context.view_layer.update()
        turned = math.degrees(
            Quaternion((1, 0, 0, 0))
            .rotation_difference(
                self.evaluated(copy).pose.bones["Head"].matrix.to_quaternion()
                @ copy.data.bones["Head"].matrix_local.to_quaternion().inverted()
            )
            .angle
        )
        self.assertAlmostEqual(turned, 20.0 - 0.5 * math.degrees(0.3), delta=0.05)
