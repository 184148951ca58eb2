"""Inverse kinematics over time and in copies: every frame alone equals playback, copies keep to themselves."""

import bpy
import numpy as np
from mathutils import Vector

import support
from ik.ik_cases import ARM, REACHABLE, IkTestCase, add_bone, add_chain, tentacle, turn

FRAMES = (30, 4, 17.5, 42, 1, 29)


class Time(IkTestCase):
    def animated(self):
        rig = self.arm(tentacle(4, 0.5))
        target = self.target()
        for frame, place in ((1, (0.6, 0.3, 1.4)), (20, (-0.5, 0.4, 0.9)), (45, (0.2, -0.6, 1.2))):
            target.location = place
            target.keyframe_insert("location", frame=frame)
        for index in range(4):
            bone = rig.pose.bones[f"Bone {index}"]
            for frame in (1, 25, 45):
                turn(bone, (0.3 * index, 1.0, 0.2 * frame / 45.0), 0.02 * frame)
                bone.keyframe_insert("rotation_quaternion", frame=frame)
        self.reach("Bone 3", chain_length=4)
        return rig, target

    def test_any_frame_equals_playback(self):
        rig, target = self.animated()
        played = {}
        for frame in range(1, 46):
            played[frame] = self.poses(rig, frame)
        for frame in (30, 4, 17, 42, 1, 29):
            self.assertEqual(self.poses(rig, frame).tolist(), played[frame].tolist())
        for frame in FRAMES:
            self.poses(rig, frame)
            self.assertNear(self.tail(rig, "Bone 3"), self.evaluated(target).matrix_world.translation, 1e-5)

    def test_posed_by_hand(self):
        """A bone without a parent that is turned in Pose Mode: the solver sees it at once."""

        def build(bones):
            add_chain(bones, "Bone", ARM)

        rig = self.rig(build)
        self.reach(position_weight=0.5)
        for angle in (0.2, 0.9):
            turn(rig.pose.bones["Bone 0"], (0.0, 1.0, 0.0), angle)
            found = self.poses(rig)
            bpy.ops.motus.refresh(object="Rig", system="ik")
            self.assertSamePose(rig, found, 1e-6)

    def test_driven_bones(self):
        rig = self.arm()
        mover = self.target((0.0, 0.0, 0.0), "Mover")
        rig.pose.bones["Bone 0"].rotation_mode = 'XYZ'
        driver = rig.pose.bones["Bone 0"].driver_add("rotation_euler", 1).driver
        variable = driver.variables.new()
        variable.targets[0].id, variable.targets[0].data_path = mover, "location[0]"
        driver.expression = variable.name
        self.reach(position_weight=0.5)
        for angle in (0.3, 1.1):
            mover.location.x = angle
            found = self.poses(rig)
            self.scene.frame_set(self.scene.frame_current + 1)
            self.assertSamePose(rig, found, 0.0)

    def test_driven_object_with_chains_that_wait_for_each_other(self):
        rig = self.arm()
        leader = self.target((0.0, 0.0, 0.0), "Leader")
        for frame, x in ((1, 0.0), (50, 1.0)):
            leader.location.x = x
            leader.keyframe_insert("location", frame=frame)
        driver = rig.driver_add("location", 0).driver
        variable = driver.variables.new()
        variable.targets[0].id, variable.targets[0].data_path = leader, "location.x"
        driver.expression = variable.name
        self.target((0.4, 0.6, 1.4), "Above")
        self.reach("Shoulder", target="Above", chain_length=1)
        self.reach()
        first = {frame: self.poses(rig, frame) for frame in FRAMES}
        for frame in FRAMES:
            self.assertTrue((self.poses(rig, frame) == first[frame]).all(), frame)
        self.assertNear(self.tail(rig, frame=4), REACHABLE)

    def test_sub_frames(self):
        rig, target = self.animated()
        for frame in (17.25, 17.5, 17.75):
            self.poses(rig, frame)
            self.assertNear(self.tail(rig, "Bone 3"), self.evaluated(target).matrix_world.translation, 1e-5)


STRAIGHT = ((0.0, 0.0, 1.0), (0.7, 0.0, 1.0), (1.3, 0.0, 1.0))


class Keyed(IkTestCase):
    """A keyed setting gives the poses of the setting itself, whichever frame comes first."""

    def assertKeyed(self, name, start, end, joints=ARM, place=REACHABLE, pole=True, **keywords):
        rig = self.arm(joints)
        for axis in "xyz":
            bone = rig.pose.bones["Bone 1"]
            setattr(bone, f"use_ik_limit_{axis}", True)
            setattr(bone, f"ik_min_{axis}", -0.3)
            setattr(bone, f"ik_max_{axis}", 0.3)
        self.target(place).rotation_euler = (0.4, 0.8, 0.2)
        self.target((0.6, -3.0, 1.2), "Pole")
        entry = self.reach(**({"pole": "Pole"} if pole else {}), **keywords)
        wanted = {}
        for frame, value in ((1, start), (11, end)):
            setattr(entry, name, value)
            wanted[frame] = self.poses(rig)
        self.assertGreater(np.abs(wanted[1] - wanted[11]).max(), 0.01, name)
        for frame, value in ((1, start), (11, end)):
            setattr(entry, name, value)
            self.assertTrue(entry.keyframe_insert(name, frame=frame), name)
        for frame in (11, 1, 11, 20, 0):
            self.assertSamePose(rig, wanted[1 if frame < 2 else 11], 2e-6, frame)

    def test_softness(self):
        self.assertKeyed("softness", 0.0, 0.5, place=(1.2, 0.2, 1.2))

    def test_stretch(self):
        self.assertKeyed("stretch", 0.25, 1.0, place=(2.0, 0.4, 1.2))

    def test_stretch_in_a_strip(self):
        """The keys of a strip of the NLA count as the action's do, when the chain is wired."""
        rig = self.arm()
        self.target((2.0, 0.4, 1.2))
        entry = self.reach()
        for frame, value in ((1, 0.0), (11, 1.0)):
            entry.stretch = value
            entry.keyframe_insert("stretch", frame=frame)
        animation = rig.animation_data
        animation.nla_tracks.new().strips.new("Strip", 1, animation.action)
        animation.action = None
        entry.stretch = 0.0
        bpy.ops.motus.refresh(object="Rig", system="ik")
        self.assertNear(self.tail(rig, "Bone 1", frame=11), (2.0, 0.4, 1.2), 1e-5)
        self.assertIsNone(self.wiring.problem(self.system, rig, bpy.context.evaluated_depsgraph_get()))

    def test_pole_angle(self):
        self.assertKeyed("pole_angle", 0.0, 1.0)

    def test_bend(self):
        self.assertKeyed("bend", 'TOWARDS', 'AWAY')

    def test_bend_axis(self):
        self.assertKeyed("hinge_angle", 0.0, 1.2, joints=STRAIGHT, pole=False)

    def test_limits(self):
        self.assertKeyed("use_limits", False, True, place=(0.3, 0.2, 1.2), pole=False)

    def test_chain_length(self):
        """Bones that a shorter chain leaves out stay as they are animated; 0 takes all."""
        for start, end in ((2, 4), (4, 2), (3, 0), (1, 3)):
            self.setUp()
            rig = self.arm(tentacle(5, 0.5))
            turn(rig.pose.bones["Bone 1"], (1.0, 0.0, 0.0), 0.3)
            self.target((0.7, 0.5, 1.3))
            entry = self.reach("Bone 4")
            wanted = {}
            for frame, value in ((1, start), (11, end)):
                entry.chain_length = value
                wanted[frame] = self.poses(rig)
            self.assertGreater(np.abs(wanted[1] - wanted[11]).max(), 0.01)
            for frame, value in ((1, start), (11, end)):
                entry.chain_length = value
                self.assertTrue(entry.keyframe_insert("chain_length", frame=frame))
            bpy.ops.motus.refresh(object="Rig", system="ik")
            for frame in (11, 1, 11, 20, 0):
                self.assertSamePose(rig, wanted[1 if frame < 11 else 11], 5e-6, frame)

    def test_a_length_keyed_beyond_the_chain(self):
        rig = self.arm(tentacle(5, 0.5))
        self.target((0.7, 0.5, 1.3))
        entry = self.reach("Bone 4")
        for frame in (1, 11):
            entry.keyframe_insert("chain_length", frame=frame)
        self.evaluated(rig, 1)
        (curve,) = support.addon("core.blender.actions").fcurves(rig)
        curve.keyframe_points[1].co.y = 4.0  # as in the graph editor, where nobody is told
        problem = lambda: self.wiring.problem(self.system, rig, bpy.context.evaluated_depsgraph_get())  # noqa: E731
        self.evaluated(rig, 11)
        self.assertIn("press Refresh", problem().sentence)
        self.evaluated(rig, 1)
        self.assertIsNone(problem())
        bpy.ops.motus.refresh(object="Rig", system="ik")
        self.evaluated(rig, 11)
        self.assertIsNone(problem())

    def test_weights(self):
        self.assertKeyed("position_weight", 1.0, 0.3)
        self.setUp()
        self.assertKeyed("rotation_weight", 0.0, 1.0)

    def test_offset(self):
        self.assertKeyed("rotation_offset", (0.0, 0.0, 0.0), (0.5, 0.2, -0.4), rotation_weight=1.0)


class Copies(IkTestCase):
    def test_copy_reaches_by_itself(self):
        rig = self.arm()
        self.reach()
        copy = rig.copy()
        copy.location.x = 0.2
        self.scene.collection.objects.link(copy)
        self.assertNear(self.tail(copy), REACHABLE)
        copy.motus.ik.entries["Bone 1"].position_weight = 0.0
        self.assertNear(self.tail(rig), REACHABLE)
        self.assertNear(self.tail(copy), Vector(ARM[2]) + Vector((0.2, 0.0, 0.0)))
        bpy.ops.motus.ik_remove(object=copy.name)
        self.assertNear(self.tail(rig), REACHABLE)

    def test_copy_of_a_rig_with_control_bones(self):
        def build(bones):
            add_chain(bones, "Bone", ARM)
            add_bone(bones, "Control", REACHABLE, (0.6, 0.3, 1.6))

        rig = self.rig(build)
        self.reach(target="Rig", target_bone="Control")
        copy = rig.copy()
        self.scene.collection.objects.link(copy)
        copy.pose.bones["Control"].location = (0.1, -0.2, 0.05)
        self.assertNear(self.tail(copy), self.head(copy, "Control"))
        self.assertNear(self.tail(rig), self.head(rig, "Control"))

    def test_saved_and_opened_again(self):
        rig = self.arm()
        self.reach(stretch=0.5, make_pole=True)
        before = self.poses(rig)
        path = str(self.folder / "rig.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.scene = bpy.context.scene
        rig = bpy.data.objects["Rig"]
        self.assertSamePose(rig, before, 0.0)
        bpy.data.objects["Target"].location = (0.4, 0.3, 1.3)
        self.assertNear(self.tail(rig), (0.4, 0.3, 1.3))

    def test_edited_armature(self):
        """A bone that is longer, renamed, or given another parent."""
        rig = self.arm()
        self.reach()
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        rig.data.edit_bones["Bone 0"].tail.x += 0.1
        rig.data.edit_bones["Shoulder"].name = "Clavicle"
        rig.data.edit_bones["Bone 1"].name = "Forearm"
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertNear(self.tail(rig, "Forearm"), REACHABLE)
        self.assertEqual(rig.motus.ik.entries.keys(), ["Forearm"])
        bpy.ops.object.mode_set(mode='EDIT')
        rig.data.edit_bones["Bone 0"].parent = None
        bpy.ops.object.mode_set(mode='OBJECT')
        rig.pose.bones["Clavicle"].location = (0.5, 0.5, 0.5)
        self.assertNear(self.tail(rig, "Forearm"), REACHABLE)

    def test_inheritance_switched_off_and_on(self):
        """What was wired comes back: nothing may have been kept under its name from while the rig was another."""
        rig = self.arm()
        self.reach()
        for name, axis in (("Shoulder", (0.0, 0.0, 1.0)), ("Bone 0", (1.0, 0.0, 0.0))):
            turn(rig.pose.bones[name], axis, 0.8)
        bpy.context.view_layer.objects.active = rig
        for inherits, roll, scale in ((False, 0.5, 'NONE'), (True, 0.5, 'FULL'), (False, 0.2, 'FULL'), (True, 0.2, 'FULL')):
            bpy.ops.object.mode_set(mode='EDIT')
            bone = rig.data.edit_bones["Bone 1"]
            bone.use_inherit_rotation, bone.roll, bone.inherit_scale = inherits, roll, scale
            bpy.ops.object.mode_set(mode='OBJECT')
            self.assertNear(self.tail(rig), REACHABLE)
        for inherits in (False, True) * 5:
            rig.data.bones["Bone 1"].use_inherit_rotation = inherits
            rig.data.bones["Bone 1"].use_local_location = not inherits
            self.assertNear(self.tail(rig), REACHABLE)


class Bake(IkTestCase):
    def test_baked_equals_live(self):
        rig = self.arm()
        target = self.target()
        for frame, place in ((1, (0.6, 0.3, 1.4)), (10, (-0.3, 0.4, 0.9)), (20, (1.2, 0.9, 2.0))):
            target.location = place
            target.keyframe_insert("location", frame=frame)
        self.reach("Hand", use_tail=False, rotation_weight=1.0)
        live = {frame: self.poses(rig, frame) for frame in range(1, 21)}
        bpy.ops.motus.bake(object="Rig", frame_start=1, frame_end=20)
        for frame in (20, 3, 11):
            self.assertSamePose(rig, live[frame], 1e-5, frame)
        bpy.ops.motus.unbake(object="Rig")
        for frame in (20, 3, 11):
            self.assertSamePose(rig, live[frame], 0.0, frame)
