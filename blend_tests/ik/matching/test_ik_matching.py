"""Matching the controls of chains to their animated pose, measured on evaluated poses."""

import math
import time

import bpy
import numpy as np
from mathutils import Quaternion, Vector

import support
from ik.ik_cases import ARM, add_bone, add_chain, state, tentacle, turn
from ik.matching.ik_match_cases import FEW, MANY, MatchTestCase, all_of, rewrite, state_of

WEIGHT = "motus.ik.entries[0].position_weight"


class IkMatchesFk(MatchTestCase):
    def test_animated_pose_is_the_solution(self):
        rig = self.animated_arm()
        before = self.recorded(rig)
        self.reach(make_pole=True, target="")
        self.assertGreater(np.abs(self.poses(rig, 20) - before[20]).max(), 0.05)
        self.match()
        self.assertRecorded(rig, before)

    def test_in_stretched_time(self):
        """Frames of the operator are of the time line, keys stand in the keys' time: 60 frames show what 30 did."""
        rig = self.animated_arm()
        before = self.recorded(rig)
        self.reach(make_pole=True, target="", position_weight=0.0)
        render, self.scene.frame_end = self.scene.render, 60
        render.frame_map_old, render.frame_map_new = 100, 200
        self.match(switch=True, frame_start=2, frame_end=60)
        self.assertRecorded(rig, {2 * frame: pose for frame, pose in before.items()})
        curve = support.addon("core.blender.actions").find(bpy.data.objects["Rig"].motus.ik.entries[0].target, "location", 0)
        self.assertEqual([point.co.x for point in curve.keyframe_points][::58], [1.0, 30.0])

    def test_without_pole(self):
        rig = self.animated_arm()
        before = self.recorded(rig)
        self.reach()
        self.match()
        self.assertRecorded(rig, before)

    def test_settings_that_shape_the_solution(self):
        for settings in (
            {"softness": 0.2},
            {"stretch": 1.0},
            {"bend": 'AWAY', "pole_angle": 0.7},
            {"rotation_weight": 1.0},
            {"position_weight": 0.3},
            {"use_limits": True},
        ):
            with self.subTest(str(settings)):
                self.setUp()
                rig = self.animated_arm()
                before = self.recorded(rig, (1, 7.0, 20, 30))
                entry = self.reach(target="", make_pole=True, **settings)
                self.match()
                entry.position_weight = 1.0
                self.assertRecorded(rig, before)

    def test_sheared_chain(self):
        rig = self.animated_arm()
        rig.scale = (1.0, 1.3, 0.8)
        before = self.recorded(rig)
        self.reach(target="", make_pole=True)
        self.match()
        self.assertRecorded(rig, before, 1e-5)

    def test_rotation_is_taken_too(self):
        for mode in ('QUATERNION', 'XYZ', 'ZXY', 'AXIS_ANGLE'):
            with self.subTest(mode):
                self.setUp()
                rig = self.animated_arm()
                before = self.recorded(rig)
                self.target((0.2, 0.5, 1.0)).rotation_mode = mode
                self.reach("Hand", use_tail=False, rotation_weight=1.0, rotation_offset=(0.3, -0.2, 0.5))
                self.match()
                self.assertRecorded(rig, before, 1e-5)

    def test_long_chain_with_pole(self):
        joints = tentacle(6)
        rig = self.animate(self.arm(joints), [f"Bone {index}" for index in range(6)])
        before = self.recorded(rig, (1, 10, 20, 30))
        self.reach("Bone 5", target="", make_pole=True, chain_length=6)
        self.match()
        self.assertRecorded(rig, before, 1e-3)

    def test_controls_in_other_spaces(self):
        rig = self.animated_arm()
        rig.location, rig.rotation_euler, rig.scale = (0.4, -0.3, 0.2), (0.4, 0.2, -0.7), (1.5, 1.5, 1.5)
        rig.keyframe_insert("location", frame=1)
        before = self.recorded(rig)
        holder = self.link("Holder", None, (1.0, 2.0, 3.0))
        holder.rotation_euler, holder.scale = (0.5, 0.2, 0.1), (2.0, 2.0, 2.0)
        holder.keyframe_insert("location", frame=1)
        holder.location.x += 2.0
        holder.keyframe_insert("location", frame=30)
        target = self.target()
        target.parent, target.delta_location = holder, (0.1, 0.2, 0.3)
        target.delta_rotation_euler = (0.2, -0.4, 0.1)
        pole = self.target((0.0, -3.0, 1.0), "Pole")
        pole.parent = target
        self.reach("Hand", use_tail=False, rotation_weight=1.0, pole="Pole")
        self.match()
        self.assertRecorded(rig, before, 2e-5)

    def test_bone_of_another_rig_and_of_the_same(self):
        for where in ("Controls", "Rig"):
            with self.subTest(where):
                self.setUp()

                def extra(bones):
                    bone = bones.new("Root")
                    bone.head, bone.tail = (0.0, 1.0, 0.0), (0.3, 1.0, 0.4)
                    goal = bones.new("Goal")
                    goal.head, goal.tail, goal.parent = (1.0, 0.5, 1.0), (1.0, 0.5, 1.3), bone

                if where == "Rig":

                    def build(bones):
                        add_chain(bones, "Bone", ARM)
                        extra(bones)

                    rig = self.animate(self.rig(build))
                else:
                    rig = self.animated_arm()
                    self.rig(extra, "Controls").location = (0.5, 0.1, 0.2)
                root = bpy.data.objects[where].pose.bones["Root"]
                root.rotation_quaternion = Quaternion((1.0, 1.0, 0.0), 0.6)
                names = ["Bone 0", "Bone 1"]
                before = {frame: [self.pose(rig, name, frame) for name in names] for frame in (1, 9, 30)}
                self.reach(target=where, target_bone="Goal", rotation_weight=1.0)
                self.match()
                for frame, poses in before.items():
                    for name, wanted in zip(names, poses):
                        self.assertNear(self.pose(rig, name, frame), wanted, 1e-5)

    def test_pole_that_follows_the_target_by_way_of_another_object(self):
        def copies(holder, target):
            constraint = holder.constraints.new('COPY_LOCATION')
            constraint.target, constraint.use_offset = target, True

        def is_child(holder, target):
            holder.constraints.new('CHILD_OF').target = target

        def is_driven(holder, target):
            driver = holder.driver_add("location", 0).driver
            variable = driver.variables.new()
            variable.targets[0].id, variable.targets[0].data_path = target, "location[0]"
            driver.expression = variable.name

        for follow in (copies, is_child, is_driven):
            with self.subTest(follow.__name__):
                self.setUp()
                rig = self.animated_arm()
                before = self.recorded(rig)
                pole, holder = self.target((0.0, -3.0, 1.0), "Pole"), self.target((0.2, -1.0, 0.5), "Holder")
                pole.parent = holder
                follow(holder, self.target())
                self.reach(pole="Pole")
                self.match()
                self.assertRecorded(rig, before, 2e-5)

    def test_pole_that_hangs_on_the_rig_of_the_target(self):
        rig = self.animated_arm()
        before = self.recorded(rig)

        def build(bones):
            add_bone(bones, "Goal", (1.0, 0.5, 1.0), (1.0, 0.5, 1.3))

        pole = self.target((0.0, -3.0, 1.0), "Pole")
        pole.parent = self.rig(build, "Controls")
        self.reach(target="Controls", target_bone="Goal", pole="Pole")
        self.match()
        self.assertRecorded(rig, before, 2e-5)

    def test_target_on_another_chain_with_poles_that_hang_on_targets(self):
        def build(bones):
            add_chain(bones, "Bone", ARM)
            add_chain(bones, "Right", [Vector(joint) - Vector((0.0, 2.0, 0.0)) for joint in ARM])

        names = ["Bone 0", "Bone 1", "Right 0", "Right 1"]
        rig = self.animate(self.rig(build), names)
        before = {frame: [self.pose(rig, name, frame) for name in names] for frame in (1, 9, 30)}
        for name, place in (("Bone", (0.0, -3.0, 1.0)), ("Right", (0.0, -5.0, 1.0))):
            target, pole = self.target(name=f"{name} Target"), self.target(place, f"{name} Pole")
            pole.parent = target
            self.reach(f"{name} 1", target=target.name, pole=pole.name, chain_length=2)
        target.parent, target.parent_type, target.parent_bone = rig, 'BONE', "Bone 1"
        self.match()
        for frame, poses in before.items():
            for name, wanted in zip(names, poses):
                self.assertNear(self.pose(rig, name, frame), wanted, 2e-5)

    def test_chains_that_hang_on_one_another(self):
        rig = self.animate(self.arm(tentacle(6)), [f"Bone {index}" for index in range(6)])
        before = self.recorded(rig, (1, 15, 30))
        self.reach("Bone 2", target="", chain_length=3)
        self.reach("Bone 5", target="", chain_length=3)
        self.match()
        self.assertRecorded(rig, before, 1e-3)

    def test_only_the_named_chain(self):
        self.animate(self.arm(tentacle(4)), [f"Bone {index}" for index in range(4)])
        self.reach("Bone 1", target="First")
        self.reach("Bone 3", target="Second", chain_length=2)
        self.match(bone="Bone 1")
        self.assertIsNotNone(bpy.data.objects["First"].animation_data)
        self.assertIsNone(bpy.data.objects["Second"].animation_data)

    def test_keys_outside_the_range_are_kept(self):
        self.animated_arm()
        target = self.target()
        target.location = (9.0, 9.0, 9.0)
        for frame in (-5, 12, 40):
            target.keyframe_insert("location", frame=frame)
        self.reach()
        self.match(frame_start=10, frame_end=20, step=2.0)
        curves = support.addon("core.blender.actions").fcurves(target)
        frames = [[round(point.co.x, 3) for point in curve.keyframe_points] for curve in curves if curve.data_path == "location"]
        self.assertEqual(frames, [[-5, 10, 12, 14, 16, 18, 20, 40]] * 3)
        self.assertEqual([curve.evaluate(40) for curve in curves if curve.data_path == "location"], [9.0] * 3)

    def keyed_target(self, **options):
        """The F-curve of the X location of an arm's target that has keys already."""
        self.setUp()
        self.animated_arm()
        self.reach()
        target = bpy.data.objects["Target"]
        target.keyframe_insert("location", frame=1)
        curve = support.addon("core.blender.actions").find(target, "location", 0)
        rewrite(curve, MANY, **options)
        return curve

    def test_frames_between_kept_keys_stay(self):
        """Handles of the keys next to the range do not go by what is keyed there."""
        for keys, frames in (
            (FEW, (11, 30)),
            (FEW, (20, 25)),
            (FEW, (1, 5)),
            (FEW, (-5, 5)),
            (FEW, (45, 50)),
            (MANY, (11, 30)),
            (MANY, (20, 25)),
            (MANY, (-30, 2)),
        ):
            self.keyed_target()
            for handles in ('AUTO_CLAMPED', 'AUTO', 'VECTOR', ('AUTO', 'VECTOR')):
                for smoothing in ('CONT_ACCEL', 'NONE'):
                    with self.subTest(f"{len(keys)} keys, {frames}, {handles}, {smoothing}"):
                        self.assertFramesStay(
                            "ik_match_fk", bpy.data.objects["Target"], "location", keys, frames, handles=handles, smoothing=smoothing
                        )

    def test_frames_before_a_kept_corner_stay(self):
        """A key whose one handle points at the next key, while the other is aligned to it."""
        self.keyed_target()
        self.assertFramesStay(
            "ik_match_fk", bpy.data.objects["Target"], "location", FEW, (11, 30), handles=('ALIGNED', 'VECTOR'), smoothing='NONE'
        )

    def test_frames_between_kept_keys_of_a_repeated_curve_stay(self):
        for frames in ((11, 30), (20, 25), (1, 5), (65, 70), (-35, 80)):
            with self.subTest(f"{frames}"):
                self.keyed_target()
                self.assertFramesStay("ik_match_fk", bpy.data.objects["Target"], "location", MANY, frames, handles='AUTO', is_cyclic=True)

    def test_kept_keys_are_taken_back(self):
        for options in ({}, {"handles": 'AUTO', "is_cyclic": True}, {"handles": ('AUTO_CLAMPED', 'VECTOR')}):
            for frames in ((11, 30), (20, 25), (-40, -35), (65, 90)):
                with self.subTest(f"{options}, {frames}"):
                    curve = self.keyed_target(**options)
                    target, writer = bpy.data.objects["Target"], support.addon("ik.keying").KeyWriter()
                    before = all_of(curve)
                    writer.write(target, "location", list(range(*frames)), [(2.0, 0.0, 0.0)] * (frames[1] - frames[0]))
                    curve = support.addon("core.blender.actions").find(target, "location", 0)
                    self.assertNotEqual(all_of(curve), before)
                    writer.take_back()
                    self.assertEqual(all_of(support.addon("core.blender.actions").find(target, "location", 0)), before)

    def test_current_frame_alone(self):
        rig = self.animated_arm()
        before = self.poses(rig, 17)
        self.reach()
        self.scene.frame_set(17)
        self.match(use_range=False)
        self.assertSamePose(rig, before, 5e-6, 17)
        self.assertEqual(self.scene.frame_current, 17)
        curve = support.addon("core.blender.actions").find(bpy.data.objects["Target"], "location", 0)
        self.assertEqual([point.co.x for point in curve.keyframe_points], [17.0])

    def test_frame_and_unkeyed_values_stay(self):
        rig = self.animated_arm()
        self.reach()
        rig.keyframe_insert("location", frame=1)
        self.scene.frame_set(8)
        rig.location.z = 2.5
        turn(rig.pose.bones["Bone 0"], (1.0, 0.0, 0.0), 1.25)
        kept = tuple(rig.pose.bones["Bone 0"].rotation_quaternion)
        self.match()
        self.assertEqual((self.scene.frame_current, rig.location.z), (8, 2.5))
        self.assertEqual(tuple(rig.pose.bones["Bone 0"].rotation_quaternion), kept)

    def test_switch(self):
        rig = self.animated_arm()
        entry = self.reach(position_weight=0.0)
        before = self.recorded(rig, (1, 15, 30))
        self.match(switch=True)
        self.assertEqual(entry.position_weight, 1.0)
        self.assertRecorded(rig, before)
        self.match(switch=True, frame_start=1, frame_end=30)
        self.assertIsNone(support.addon("core.blender.actions").find(rig, "motus.ik.entries[0].position_weight"))

    def test_switch_for_a_part_of_the_scene_is_keyed(self):
        rig = self.animated_arm()
        entry = self.reach(position_weight=0.25)
        self.match(switch=True, frame_start=10, frame_end=20)
        for frame, weight in ((1, 0.25), (9, 0.25), (10, 1.0), (15, 1.0), (20, 1.0), (21, 0.25), (30, 0.25)):
            self.evaluated(rig, frame)
            self.assertAlmostEqual(entry.position_weight, weight, msg=f"frame {frame}")

    def keyed_weight(self, keys, interpolation='BEZIER', handles='AUTO_CLAMPED', smoothing='CONT_ACCEL'):
        """F-curve of the position weight of an arm that is made anew."""
        self.setUp()
        rig = self.animated_arm()
        entry = self.reach()
        for frame, weight in keys:
            entry.position_weight = weight
            rig.keyframe_insert(WEIGHT, frame=frame)
        curve = support.addon("core.blender.actions").find(rig, WEIGHT)
        curve.auto_smoothing = smoothing
        for key in curve.keyframe_points:
            key.interpolation, key.handle_left_type, key.handle_right_type = interpolation, handles, handles
        curve.update()
        return curve

    def assertSwitched(self, keys, interpolation='BEZIER', frames=(20, 30), **options):
        """Weights that have keys are 1 from frame to frame, and on all others what they were."""
        curve = self.keyed_weight(keys, interpolation, **options)
        step = 1.0 if interpolation == 'SINE' else 0.5
        before = {frame: curve.evaluate(frame) for frame in np.arange(-20.0, 81.0, step)}
        self.match(switch=True, frame_start=frames[0], frame_end=frames[1])
        curve = support.addon("core.blender.actions").find(bpy.data.objects["Rig"], WEIGHT)
        for frame, weight in before.items():
            if frames[0] <= frame <= frames[1]:
                weight = 1.0
            elif frames[0] - 1 < frame < frames[1] + 1:
                continue
            self.assertAlmostEqual(curve.evaluate(frame), weight, delta=1e-5, msg=f"frame {frame}")

    def test_switch_of_keyed_weights_leaves_other_frames(self):
        ways = ((1, 0.0), (40, 1.0)), ((-10, 0.2), (1, 0.0), (12, 0.7), (25, 0.1), (38, 0.9), (44, 0.5), (70, 0.0))
        for keys in ways:
            for handles in ('AUTO_CLAMPED', 'AUTO', 'VECTOR', 'ALIGNED', 'FREE'):
                for smoothing in ('CONT_ACCEL', 'NONE'):
                    with self.subTest(f"{len(keys)} keys, {handles}, {smoothing}"):
                        self.assertSwitched(keys, handles=handles, smoothing=smoothing)
            for interpolation in ('LINEAR', 'CONSTANT', 'SINE'):
                with self.subTest(f"{len(keys)} keys, {interpolation}"):
                    self.assertSwitched(keys, interpolation)

    def test_switch_beside_the_keys_of_weights(self):
        for frames in ((45, 50), (2, 5), (-9, -5), (41, 43), (12, 19), (40, 60), (5, 40)):
            for handles in ('AUTO_CLAMPED', 'AUTO'):
                with self.subTest(f"{frames}, {handles}"):
                    self.assertSwitched(((11, 0.0), (20, 0.8), (40, 0.3)), handles=handles, frames=frames)

    def test_switch_of_keyed_weights_is_taken_back(self):
        for interpolation in ('BEZIER', 'SINE'):
            for frames in ((20, 30), (45, 50), (2, 40)):
                with self.subTest(f"{interpolation}, {frames}"):
                    curve = self.keyed_weight(((11, 0.0), (20, 0.8), (40, 0.3)), interpolation)
                    rig, writer = bpy.data.objects["Rig"], support.addon("ik.keying").KeyWriter()
                    before = _keys(curve)
                    support.addon("ik.matching.weights").switch(
                        self.scene, rig, rig.motus.ik.entries[:], frames, writer, {"position_weight": 1.0}
                    )
                    self.assertNotEqual(_keys(curve), before)
                    writer.take_back()
                    self.assertEqual(_keys(curve), before)

    def test_error_is_found_with_weight_0_too(self):
        """Joint limits that the animated pose breaks show in the report though IK does not act yet."""
        rig = self.animated_arm()
        bone = rig.pose.bones["Bone 0"]
        bone.use_ik_limit_x = bone.use_ik_limit_z = True
        bone.ik_min_x = bone.ik_max_x = bone.ik_min_z = bone.ik_max_z = 0.0
        self.reach(use_limits=True, position_weight=0.0)
        reports = self.error_of_job(rig)
        self.assertGreater(reports.length, 0.01)
        rig.motus.ik.entries["Bone 1"].use_limits = False
        self.assertLess(self.error_of_job(rig).length, 1e-5)

    def test_measured_error_is_the_real_one(self):
        rig = self.animated_arm()
        before = self.recorded(rig)
        self.reach("Bone 1", make_pole=True, target="")
        error = self.error_of_job(rig)
        worst = max(np.abs(self.poses(rig, frame) - wanted)[:, :3, 3].max() for frame, wanted in before.items())
        self.assertLess(error.length, 1e-5)
        self.assertGreaterEqual(error.length * 1.8 + 1e-9, worst)
        self.assertLess(math.degrees(error.angle), 0.05)

    def test_cancelled_leaves_everything(self):
        rig = self.animated_arm()
        self.reach(make_pole=True)
        target, pole = bpy.data.objects["Target"], rig.motus.ik.entries[0].pole
        target.keyframe_insert("location", frame=5)
        module = support.addon("ik.matching.job")
        self.scene.frame_set(3)
        before = [state_of(obj) for obj in (target, pole)], state(rig), len(bpy.data.actions)
        for job in ("match_fk", "match_ik"):
            for stop in (3, 31, 55):
                steps = getattr(module, job)(bpy.context, rig, "", list(range(1, 31)), True, {})
                for _ in range(stop):
                    next(steps)
                steps.close()
                after = [state_of(obj) for obj in (target, pole)], state(rig), len(bpy.data.actions)
                self.assertEqual(after, before, f"{job} stopped after {stop} steps")
                self.assertEqual(self.scene.frame_current, 3)

    def test_refusals(self):
        self.animated_arm()
        match = bpy.ops.motus.ik_match_fk
        self.assertRefused("Nothing here", match, object="Rig")
        entry = self.reach()
        self.assertRefused("range is empty", match, object="Rig", frame_start=5, frame_end=4)
        self.assertRefused("has no inverse kinematics", match, object="Rig", bone="Hand")
        target = bpy.data.objects["Target"]
        constraint = target.constraints.new('LIMIT_LOCATION')
        self.assertRefused("has a constraint", match, object="Rig")
        target.constraints.remove(constraint)
        target.driver_add("location", 0)
        self.assertRefused("moved by a driver", match, object="Rig")
        target.driver_remove("location")
        entry.extra_targets.add().object = self.link("Other")
        entry.target_blend = 0.5
        self.assertRefused("passes from one target", match, object="Rig")
        entry.target_blend = 1.0
        self.match()
        self.assertIsNotNone(bpy.data.objects["Other"].animation_data)
        entry.pole = bpy.data.objects["Other"]
        self.assertRefused("control of several", match, object="Rig")

    def test_speed(self):
        """250 frames of 4 chains, in seconds of the processor: 0.7 and 0.4 s here."""

        def build(bones):
            for index in range(4):
                add_chain(bones, f"Chain {index}", [(x, index, z) for x, _, z in ARM])

        rig = self.rig(build)
        self.animate(rig, [f"Chain {index} {bone}" for index in range(4) for bone in range(2)], (1, 120, 250))
        for index in range(4):
            self.reach(f"Chain {index} 1", target="", make_pole=True)
        for operator in ("ik_match_fk", "fk_match_ik"):
            started = time.process_time()
            self.match(operator, frame_start=1, frame_end=250)
            self.assertLess(time.process_time() - started, 2.0, operator)


def _keys(curve):
    return [
        (
            tuple(key.co),
            tuple(round(part, 4) for part in (*key.handle_left, *key.handle_right)),
            key.handle_left_type,
            key.handle_right_type,
            key.interpolation,
        )
        for key in curve.keyframe_points
    ]
