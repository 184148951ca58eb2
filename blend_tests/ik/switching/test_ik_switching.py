"""Passing from one target to another, by keys and by triggers, measured on evaluated poses."""

import math

import bpy
from mathutils import Quaternion

import support
from ik.ik_cases import counts, state, turn
from ik.switching.ik_switch_cases import A, B, C, SwitchTestCase


class Keyed(SwitchTestCase):
    def test_there_and_back_again(self):
        """A, B, C and A once more."""
        self.keyed("B", 10, 20)
        self.keyed("C", 30, 40)
        self.keyed("A", 50, 60)
        self.assertEqual(self.stations, ["B", "C", "A"])
        for frame, place in ((1, A), (10, A), (20, B), (25, B), (30, B), (40, C), (50, C), (60, A), (99, A)):
            self.assertAt(place, frame)

    def test_the_way_is_straight_and_smooth(self):
        self.keyed("B", 10, 20)
        start, end = (bpy.data.objects[name].matrix_world for name in "AB")
        last = 0.0
        for frame in range(10, 21):
            share = self.blend_at(frame)
            self.assertGreaterEqual(share, last)
            last = share
            wanted = start.translation.lerp(end.translation, share)
            self.assertAt(wanted, frame, 5e-6)
        self.assertAlmostEqual(self.blend_at(15), 0.5, places=4)
        self.assertLess(self.blend_at(10.5), 0.05 * 0.5, "starts slowly")

    def test_in_stretched_time(self):
        """Frames of the operator are of the time line."""
        render = bpy.context.scene.render
        render.frame_map_old, render.frame_map_new = 100, 200
        self.keyed("B", 20, 40, interpolation='LINEAR')
        for frame, blend in ((10, 0.0), (20, 0.0), (30, 0.5), (40, 1.0), (60, 1.0)):
            self.assertAlmostEqual(self.blend_at(frame), blend, places=5)

    def test_interpolations(self):
        self.keyed("B", 10, 20, interpolation='LINEAR')
        self.keyed("C", 30, 40, interpolation='CONSTANT')
        self.assertAlmostEqual(self.blend_at(12), 0.2, places=5)
        self.assertAlmostEqual(self.blend_at(39.5), 1.0)
        self.assertAlmostEqual(self.blend_at(40), 2.0)

    def test_a_switch_before_another_one(self):
        self.keyed("B", 50, 60)
        self.keyed("C", 10, 20)
        self.assertEqual(self.stations, ["C", "B"])
        for frame, place in ((1, A), (10, A), (20, C), (50, C), (60, B)):
            self.assertAt(place, frame)

    def test_a_switch_before_the_same_one(self):
        """The next target is used again where it is the one that is asked for."""
        self.keyed("B", 50, 60)
        self.keyed("B", 10, 20)
        self.assertEqual(self.stations, ["B"])
        for frame, place in ((1, A), (20, B), (55, B), (60, B)):
            self.assertAt(place, frame)

    def test_an_empty_station_ahead_is_used(self):
        bpy.ops.motus.ik_target_add(object="Rig", bone="Bone 1", target="B")
        self.keyed("B", 10, 20)
        self.assertEqual(self.stations, ["B"])
        self.assertAt(B, 20)

    def test_from_the_present_blend_without_keys(self):
        bpy.ops.motus.ik_target_add(object="Rig", bone="Bone 1", target="B")
        self.entry.target_blend = 1.0
        self.keyed("C", 10, 20)
        self.assertEqual(self.stations, ["B", "C"])
        self.assertAt(B, 1)
        self.assertAt(C, 20)

    def test_moving_targets_and_bones(self):
        other = self.arm(name="Other", joints=((0.0, 0.5, 1.0), (0.5, 0.6, 1.0), (0.9, 0.5, 1.0)))
        bone = other.pose.bones["Bone 0"]
        for frame, angle in ((1, 0.0), (60, 0.8)):
            turn(bone, (1.0, 0.0, 0.0), angle)
            bone.keyframe_insert("rotation_quaternion", frame=frame)
        self.keyed("Other", 10, 20, target_bone="Bone 1")
        for frame in (20, 33, 60):
            self.assertAt(self.head(other, "Bone 1", frame), frame)

    def test_from_a_target_whose_bone_is_gone(self):
        self.arm(name="Other", joints=((0.0, 0.5, 1.0), (0.5, 0.6, 1.0), (0.9, 0.5, 1.0)))
        self.keyed("Other", 10, 20, target_bone="Bone 1")
        self.entry.extra_targets[0].bone = "Nose"
        self.keyed("Other", 30, 40)
        self.keyed("B", 50, 60)
        self.assertEqual(self.stations, ["Other", "Other", "B"])
        self.assertAt(B, 60)

    def test_defaults(self):
        self.scene.frame_set(7)
        self.switch("B")
        self.assertAt(A, 7)
        self.assertAt(B, 19)

    def test_refusals(self):
        def refused(part, **keywords):
            self.assertRefused(part, bpy.ops.motus.ik_switch_target, object="Rig", bone="Bone 1", **keywords)

        refused("Name the target")
        refused("range is empty", target="B", frame_start=5, frame_end=5)
        refused("is at A already", target="A", frame_start=5, frame_end=9)
        refused("moves with the chain", target="Rig", target_bone="Hand")
        self.keyed("B", 10, 20)
        refused("passes from one target to another at frame 15", target="C", frame_start=15, frame_end=25)
        refused("Blend of Bone 1 is keyed", target="C", trigger_object="A", trigger_data_path="location.x")
        self.assertEqual(self.stations, ["B"])


class Triggered(SwitchTestCase):
    def aeroplane(self, frames=100):
        """A follower whose parameter goes from 0 to 1 over so many frames."""
        curve = bpy.data.curves.new("Course", 'CURVE')
        curve.dimensions = '3D'
        spline = curve.splines.new('BEZIER')
        spline.bezier_points.add(1)
        for index, point in enumerate(spline.bezier_points):
            point.co = (3.0 * index, 0.0, 0.0)
            point.handle_left, point.handle_right = (3.0 * index - 1.0, 0.0, 0.0), (3.0 * index + 1.0, 0.0, 0.0)
        self.link("Course", curve)
        plane = self.link("Aeroplane")
        bpy.ops.motus.path_follow_add(object="Aeroplane", curve="Course", timing='DURATION', duration=frames / self.scene.render.fps)
        return plane

    def parameter(self, frame):
        self.evaluated(self.rigged, frame)
        path = support.addon("path").SYSTEM
        return self.wiring.output(path, bpy.data.objects["Aeroplane"], "parameter", bpy.context.evaluated_depsgraph_get())

    def test_the_aeroplane_of_the_film(self):
        """Once the parameter passes 0.05 the hand goes from the handle to the remote control."""
        self.aeroplane()
        self.switch("B", trigger_object="Aeroplane", trigger_start=0.05, trigger_end=0.15)
        seen = set()
        for frame in (1, 4, 9, 11, 13.5, 30, 99, 2):
            share = min(max((self.parameter(frame) - 0.05) / 0.1, 0.0), 1.0)
            wanted = share * share * (3.0 - 2.0 * share)
            self.assertAlmostEqual(self.blend_at(frame), wanted, places=5, msg=f"frame {frame}")
            if wanted in (0.0, 1.0):
                self.assertAt((A, B)[int(wanted)], frame)
            seen.add(wanted)
        self.assertGreater(len(seen), 3)

    def test_played_and_jumped_are_the_same(self):
        self.aeroplane()
        self.switch("B", trigger_object="Aeroplane", trigger_start=0.05, trigger_end=0.15)
        played = {frame: self.tail(self.rigged, frame=frame).copy() for frame in range(1, 30)}
        for frame in (29, 8, 17, 3):
            self.assertAt(played[frame], frame, 0.0)

    def test_several_triggers(self):
        self.aeroplane()
        self.switch("B", trigger_object="Aeroplane", trigger_start=0.05, trigger_end=0.1)
        self.switch("C", trigger_object="Aeroplane", trigger_output="fraction", trigger_start=0.4, trigger_end=0.5)
        self.switch("A", trigger_object="Aeroplane", trigger_data_path="location.x", trigger_start=1.0, trigger_end=2.0)
        self.keyed("B", 90, 95)
        self.assertEqual(self.stations, ["B", "C", "A", "B"])
        plane = bpy.data.objects["Aeroplane"]
        for frame, place in ((1, A), (30, B), (80, C), (89, C)):
            self.assertAt(place, frame)
        plane.location.x = 5.0
        self.assertAt(A, 80)
        self.assertAt(B, 96)

    def test_interpolations(self):
        for kind, places in (('LINEAR', ((0.0, 0.0), (1.25, 0.25), (3.0, 1.0))), ('CONSTANT', ((0.9, 0.0), (1.0, 1.0), (3.0, 1.0)))):
            self.setUp()
            trigger = self.link("Trigger")
            self.switch(
                "B", trigger_object="Trigger", trigger_data_path="location.x", trigger_start=1.0, trigger_end=2.0, interpolation=kind
            )
            for value, wanted in places:
                trigger.location.x = value
                self.assertAlmostEqual(self.blend_at(1), wanted, places=5, msg=kind)

    def test_falling_values(self):
        for kind in ('BEZIER', 'CONSTANT'):
            self.setUp()
            trigger = self.link("Trigger")
            self.switch(
                "B", trigger_object="Trigger", trigger_data_path="location[0]", trigger_start=-1.0, trigger_end=-2.0, interpolation=kind
            )
            for value, wanted in ((0.0, 0.0), (-0.9, 0.0), (-2.5, 1.0)):
                trigger.location.x = value
                self.assertAlmostEqual(self.blend_at(1), wanted, msg=kind)

    def test_another_systems_output(self):
        """How far the other arm is from its own target."""
        other = self.other_arm()
        self.assertLess(self.output(other, "Bone 1.distance", 2), 0.9)
        self.assertAt(A, 2)
        bpy.data.objects["D"].location = (1.2, 2.1, 1.0)
        self.assertAt(B, 3)

    def other_arm(self):
        """Another rig, whose arm is less than 0.9 from its target "D" until that is moved."""
        other = self.arm(name="Other", joints=((0.0, 2.0, 1.0), (0.7, 2.15, 1.0), (1.3, 2.0, 1.0)))
        self.target((0.6, 2.3, 1.4), "D")
        bpy.ops.motus.ik_add(object="Other", bone="Bone 1", target="D")
        self.switch("B", trigger_object="Other", trigger_system="ik", trigger_output="Bone 1.distance", trigger_start=0.9, trigger_end=1.1)
        return other

    def assertTriggered(self):
        for place, wanted in (((1.2, 2.1, 1.0), B), ((0.6, 2.3, 1.4), A)):
            bpy.data.objects["D"].location = place
            self.assertAt(wanted, 3)

    def test_the_output_moves_to_a_hub(self):
        other = self.other_arm()
        self.assertTriggered()
        driver = other.driver_add("motus.ik.entries[0].position_weight").driver
        driver.expression = "1.0"
        for _ in range(3):  # wired again after the evaluation that has noticed it
            bpy.context.view_layer.update()
        self.assertTriggered()
        other.driver_remove("motus.ik.entries[0].position_weight")
        bpy.ops.motus.refresh(object="Other", system="ik")
        self.assertTriggered()

    def test_the_output_moves_to_another_slot(self):
        self.other_arm()
        self.target((1.4, 2.1, 1.0), "E")
        bpy.ops.motus.ik_add(object="Other", bone="Hand", target="E", chain_length=1)
        self.assertTriggered()
        bpy.ops.motus.ik_remove(object="Other", bone="Bone 1")
        bpy.ops.motus.ik_add(object="Other", bone="Bone 1", target="D")
        self.assertTriggered()
        bpy.ops.motus.ik_remove(object="Other", bone="Hand")
        self.assertTriggered()

    def test_the_trigger_is_removed_and_comes_back(self):
        self.aeroplane()
        self.switch("B", trigger_object="Aeroplane", trigger_start=0.05, trigger_end=0.15)
        bpy.ops.motus.path_follow_remove(object="Aeroplane")
        self.assertAt(A, 60)
        bpy.ops.motus.path_follow_add(object="Aeroplane", curve="Course", timing='DURATION', duration=100 / self.scene.render.fps)
        for frame, place in ((1, A), (60, B), (2, A)):
            self.assertAt(place, frame)

    def test_what_is_solved_on_the_rig_itself(self):
        self.target((0.6, -0.3, 1.2), "E")
        bpy.ops.motus.ik_add(object="Rig", bone="Hand", target="E", chain_length=1)
        self.assertRefused(
            "cannot wait for what is solved on its own bones",
            bpy.ops.motus.ik_switch_target,
            object="Rig",
            bone="Bone 1",
            target="B",
            trigger_object="Rig",
            trigger_system="ik",
            trigger_output="Hand.distance",
        )
        self.assertIsNone(support.addon("ik.switching.blend_trigger").driver_of(self.rigged, self.entry))

    def test_settings_of_the_rig_itself(self):
        """To Blender its Blend is one with them."""
        self.link("Child").parent = self.rigged
        before = state(self.rigged), counts()
        for owner, path in (
            ("Rig", 'motus.ik.entries["Bone 1"].target_blend'),
            ("Rig", "motus.ik.influence"),
            ("Rig", "motus.ik.entries[0].rotation_offset[0]"),
            ("Child", "parent.motus.ik.influence"),
        ):
            with self.subTest(path):
                self.assertTriggerRefused("cannot wait for what is solved on its own bones", owner, path)
        # Not every Blender finds a way by these.
        for path in ('["motus"]["ik"]["influence"]', " motus.ik.influence", "motus.ik.influence ", " motus .ik.influence"):
            with self.subTest(path):
                self.assertTriggerRefused("cannot wait|is no number", "Rig", path)
        self.assertFalse(self.entry.extra_targets)
        self.assertEqual((state(self.rigged), counts()), before)

    def assertTriggerRefused(self, sentence, owner, path):
        self.assertRefused(
            sentence,
            bpy.ops.motus.ik_switch_target,
            object="Rig",
            bone="Bone 1",
            target="B",
            trigger_object=owner,
            trigger_data_path=path,
            trigger_start=-0.2,
            trigger_end=1.1,
        )

    def test_properties_of_the_rig_and_of_its_bones(self):
        hand = self.rigged.pose.bones["Hand"]
        for holder, path in ((self.rigged, '["motus.own"]'), (hand, 'pose.bones["Hand"]["motus"]')):
            with self.subTest(path):
                name = path.split('"')[-2]
                holder[name] = 0.0
                self.switch("B", trigger_object="Rig", trigger_data_path=path, trigger_start=0.2, trigger_end=0.8)
                self.assertAt(A, 2)
                holder[name] = 1.0
                self.rigged.update_tag()
                self.assertAt(B, 3)
                bpy.ops.motus.ik_target_remove(object="Rig", bone="Bone 1", index=0)

    def test_settings_of_another_rig(self):
        self.other_arm()
        bpy.data.objects["Other"].motus.ik.influence = 0.5
        self.switch("C", trigger_object="Other", trigger_data_path="motus.ik.influence", trigger_start=0.6, trigger_end=0.7)

    def test_saved_and_opened_with_scripts_off(self):
        """Blender evaluates the driver without Python."""
        self.aeroplane()
        self.switch("B", trigger_object="Aeroplane", trigger_start=0.05, trigger_end=0.15)
        (driver,) = [curve.driver for curve in self.rigged.animation_data.drivers if "target_blend" in curve.data_path]
        self.assertTrue(driver.is_simple_expression)
        path = str(self.folder / "switch.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path, use_scripts=False)
        self.scene, self.rigged = bpy.context.scene, bpy.data.objects["Rig"]
        for frame, place in ((1, A), (60, B), (2, A)):
            self.assertAt(place, frame)

    def test_removed_without_a_trace(self):
        self.aeroplane()
        self.switch("B", trigger_object="Aeroplane")
        bpy.ops.motus.ik_remove(object="Rig")
        self.assertIsNone(self.rigged.animation_data)

    def test_refusals(self):
        self.aeroplane()
        switch = bpy.ops.motus.ik_switch_target
        known = {"object": "Rig", "bone": "Bone 1", "target": "B", "trigger_object": "Aeroplane"}
        self.assertRefused("no output height", switch, trigger_output="height", **known)
        self.assertRefused("no system nonsense", switch, trigger_system="nonsense", **known)
        self.assertRefused("is no number", switch, trigger_data_path="location", **known)
        self.assertRefused("is no number", switch, trigger_data_path="nothing.there", **known)
        self.assertRefused("have to be different", switch, trigger_start=1.0, trigger_end=1.0, **known)
        self.assertRefused("have to be different", switch, trigger_start=math.nan, **known)
        known["trigger_object"] = "C"
        self.assertRefused("C is not driven by Follow Path", switch, **known)
        self.assertFalse(self.entry.extra_targets)
        self.assertIsNone(
            self.entry.id_data.animation_data and support.addon("ik.switching.blend_trigger").driver_of(self.rigged, self.entry)
        )
        self.rigged.driver_add("motus.ik.entries[0].target_blend").driver.expression = "0.5*2"
        known["trigger_object"] = "Aeroplane"
        self.assertRefused("a driver of its own", switch, **known)

    def test_a_trigger_that_moves_with_the_chain(self):
        held = self.link("Held")
        held.constraints.new('COPY_LOCATION').target = self.rigged
        held.constraints[0].subtarget = "Hand"
        self.assertRefused(
            "moves with the chain itself",
            bpy.ops.motus.ik_switch_target,
            object="Rig",
            bone="Bone 1",
            target="B",
            trigger_object="Held",
            trigger_data_path="matrix_world[0][3]",
        )
        self.assertFalse(self.entry.extra_targets)
        self.assertAt(A, 3)


class Rotation(SwitchTestCase):
    def test_orientation_passes_too(self):
        for name, axis in (("A", (1.0, 0.0, 0.0)), ("B", (0.0, 0.0, 1.0))):
            goal = bpy.data.objects[name]
            goal.rotation_mode, goal.rotation_quaternion = 'QUATERNION', Quaternion(axis, 0.5)
        bpy.ops.motus.ik_remove(object="Rig")
        self.entry = self.reach("Hand", target="A", use_tail=False, rotation_weight=1.0, keep_rotation=False)
        bpy.ops.motus.ik_switch_target(object="Rig", bone="Hand", target="B", frame_start=10, frame_end=20)
        start, end = (bpy.data.objects[name].rotation_quaternion for name in "AB")
        for frame in (1, 13, 16, 20):
            share = self.evaluated(self.rigged, frame).motus.ik.entries["Hand"].target_blend
            self.assertTurned(self.pose(self.rigged, "Hand", frame), start.slerp(end, share))
