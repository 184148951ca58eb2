"""Inverse kinematics' operators: adding without moving the pose, and what is refused."""

import itertools
import math

import bpy
from mathutils import Euler, Vector

import support
from ik.ik_cases import ARM, REACHABLE, IkTestCase, rigid, state, tentacle, turn


class Add(IkTestCase):
    def test_keywords_become_settings(self):
        rig = self.arm()
        given = {
            "chain_length": 1,
            "use_tail": False,
            "bend": 'AWAY',
            "pole_angle": 0.25,
            "hinge_angle": 0.5,
            "softness": 0.125,
            "stretch": 0.75,
            "use_limits": True,
            "position_weight": 0.5,
            "rotation_weight": 0.25,
            "target_blend": 0.5,
            "tolerance": 0.0009765625,
            "iterations": 7,
            "is_muted": True,
        }
        entry = self.reach(rotation_offset=(0.5, 0.25, 1.0), **given)
        self.assertEqual({name: getattr(entry, name) for name in given}, given)
        self.assertEqual(tuple(entry.rotation_offset), (0.5, 0.25, 1.0))
        self.assertEqual((entry.target.name, entry.pole), ("Target", None))
        self.assertTrue(rig.motus.ik.is_active)

    def test_again_changes_only_what_is_given(self):
        rig = self.arm()
        self.target((2.0, 2.0, 1.0), "Pole")
        self.reach(softness=0.25, pole="Pole")
        constraints = [len(bone.constraints) for bone in rig.pose.bones]
        entry = self.reach(target="", rotation_weight=0.5)
        self.assertEqual((entry.softness, entry.rotation_weight, entry.target.name, entry.pole.name), (0.25, 0.5, "Target", "Pole"))
        self.assertEqual(len(rig.motus.ik.entries), 1)
        self.assertEqual([len(bone.constraints) for bone in rig.pose.bones], constraints)
        bpy.ops.motus.ik_add(object="Rig", bone="Bone 1", pole="")
        self.assertIsNone(rig.motus.ik.entries["Bone 1"].pole)

    def test_made_target_leaves_the_pose(self):
        for use_tail, bone in ((True, "Bone 1"), (False, "Hand")):
            with self.subTest(use_tail=use_tail):
                support.empty_scene()
                self.scene = bpy.context.scene
                rig = self.arm()
                rig.matrix_world = rigid((1.0, 2.0, 3.0), (1.0, 1.0, 0.0), 0.7, (1.5, 1.5, 1.5))
                for index, name in enumerate(("Bone 0", "Bone 1", "Hand")):
                    turn(rig.pose.bones[name], (0.3, 1.0, 0.2), 0.3 + 0.2 * index)
                before = self.poses(rig)
                entry = self.reach(bone, target="", use_tail=use_tail, rotation_weight=1.0, make_pole=True)
                self.assertSamePose(rig, before)
                target = entry.target
                self.assertEqual(target.name, f"Rig {bone} Target")
                tip = self.tail(rig, bone) if use_tail else self.head(rig, bone)
                self.assertNear(target.matrix_world.translation, tip)
                self.assertTurned(target.matrix_world, self.pose(rig, bone).to_quaternion())
                self.assertEqual(tuple(entry.rotation_offset), (0.0, 0.0, 0.0))
                self.assertEqual(target.users_collection, rig.users_collection)

    def test_made_pole_leaves_the_pose(self):
        straight = ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 2.0))
        for name, joints in (("bent", ARM), ("straight", straight), ("long", tentacle(6))):
            for bend in ('TOWARDS', 'AWAY'):
                with self.subTest(name, bend=bend):
                    support.empty_scene()
                    self.scene = bpy.context.scene
                    rig = self.arm(joints)
                    turn(rig.pose.bones["Bone 0"], (0.2, 1.0, 0.4), 0.6)
                    before = self.poses(rig)
                    count = len(joints) - 1
                    entry = self.reach(f"Bone {count - 1}", target="", make_pole=True, chain_length=count, bend=bend)
                    self.assertSamePose(rig, before, 5e-6)
                    length = sum((Vector(b) - Vector(a)).length for a, b in itertools.pairwise(joints))
                    self.assertGreater((entry.pole.location - self.tail(rig, "Bone 0")).length, 0.5 * length)

    def test_bend_axis(self):
        """The joint's own where the rest pose is bent; else what the pole asks for; else X."""
        rig = self.arm()
        turn(rig.pose.bones["Bone 0"], (0.0, 1.0, 0.0), 1.0)
        angle = self.reach().hinge_angle
        rest = rig.data.bones["Bone 0"].matrix_local.to_3x3()
        axis = rest @ Vector((math.cos(angle), 0.0, -math.sin(angle)))
        joints = [Vector(joint) for joint in ARM]
        normal = (joints[2] - joints[0]).cross(joints[1] - joints[0]).normalized()
        self.assertNear(axis, normal, 1e-5)
        straight = ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 2.0))
        other = self.arm(straight, "Straight")
        self.target((3.0, 4.0, 1.0), "Pole")
        angle = self.reach(rig="Straight", pole="Pole").hinge_angle
        axis = other.data.bones["Bone 0"].matrix_local.to_3x3() @ Vector((math.cos(angle), 0.0, -math.sin(angle)))
        self.assertNear(axis, Vector((0.0, 0.0, 1.0)).cross(Vector((0.6, 0.8, 0.0))), 1e-5)
        self.arm(straight, "Plain")
        self.assertEqual(self.reach(rig="Plain").hinge_angle, 0.0)

    def test_several_chains_at_once(self):
        def build(bones):
            for side, x in (("L", 1.0), ("R", -1.0)):
                parent = None
                for name, low in (("upper", 2.0), ("lower", 1.0)):
                    bone = bones.new(f"{name}.{side}")
                    bone.head, bone.tail, bone.parent = (x, 0.0, low), (x, 0.1 * low - 0.1, low - 1.0), parent
                    parent = bone

        rig = self.rig(build, "Legs")
        before = self.poses(rig)
        bpy.ops.motus.ik_add(object="Legs", bones="lower.L, lower.R", chain_length=2)
        entries = rig.motus.ik.entries
        self.assertEqual([entry.name for entry in entries], ["lower.L", "lower.R"])
        self.assertNotEqual(entries[0].target, entries[1].target)
        self.assertSamePose(rig, before, 5e-6)
        bpy.ops.motus.ik_remove(object="Legs")
        self.assertRefused("driven from lower.L and from upper.L", bpy.ops.motus.ik_add, object="Legs", bones="lower.L,upper.L")
        self.assertFalse(rig.motus.ik.entries)

    def test_a_knee_that_bends_by_little_bends_that_way(self):
        """At rest, or as posed where the rest pose is straight; the target comes half as near, so that the knee stands far out."""
        for degrees in (0.45, 0.1, 0.02):
            for way in ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (-0.6, 0.8, 0.0)):
                for is_posed in (False, True):
                    with self.subTest(degrees=degrees, way=way, is_posed=is_posed):
                        support.empty_scene()
                        self.scene = bpy.context.scene
                        out = math.tan(0.5 * math.radians(degrees)) * Vector(way)
                        knee = Vector((0.0, 0.0, 1.0)) + (Vector() if is_posed else out)
                        rig = self.arm(((0.0, 0.0, 2.0), tuple(knee), (0.0, 0.0, 0.0)))
                        if is_posed:
                            axis = Vector((0.0, 0.0, -1.0)).cross(way)
                            for name, angle in (("Bone 0", 0.5 * degrees), ("Bone 1", -degrees)):
                                rest = rig.data.bones[name].matrix_local.to_3x3()
                                turn(rig.pose.bones[name], rest.inverted() @ axis, math.radians(angle))
                            bpy.context.view_layer.update()
                        self.target((0.0, 0.0, 1.0))
                        self.reach()
                        bpy.context.view_layer.update()
                        self.assertNear(self.tail(rig, "Bone 0"), Vector((0.0, 0.0, 1.5)) + math.sqrt(0.75) * Vector(way), 0.02)

    def test_orientation_of_a_given_target_is_kept(self):
        rig = self.arm()
        target = self.target()
        target.rotation_euler = (0.4, 0.8, 1.2)
        bpy.context.view_layer.update()
        before = self.pose(rig, "Hand").to_quaternion()
        entry = self.reach("Hand", use_tail=False, rotation_weight=1.0)
        self.assertTurned(self.pose(rig, "Hand"), before)
        target.rotation_euler = (0.4, 0.8, 0.0)
        turned = Euler((0.4, 0.8, 0.0)).to_quaternion() @ entry.rotation_offset.to_quaternion()
        self.assertTurned(self.pose(rig, "Hand"), turned)
        entry = self.reach("Hand", target="", keep_rotation=False, rotation_offset=(0.0, 0.0, 0.0))
        self.assertTurned(self.pose(rig, "Hand"), target.matrix_world.to_quaternion())

    def test_selection(self):
        rig = self.arm()
        target = self.target()
        rig.data.bones.active = rig.data.bones["Bone 1"]
        bpy.ops.object.mode_set(mode='POSE')
        target.select_set(True)
        self.assertEqual(bpy.ops.motus.ik_add(), {'FINISHED'})
        self.assertEqual(rig.motus.ik.entries["Bone 1"].target, target)
        self.assertEqual(bpy.context.mode, 'POSE')
        bpy.ops.motus.ik_remove()
        bpy.ops.object.mode_set(mode='OBJECT')
        for found in bpy.context.selected_objects:
            found.select_set(False)
        rig.select_set(True)
        self.assertEqual(bpy.ops.motus.ik_add(), {'FINISHED'})
        self.assertEqual(rig.motus.ik.entries["Bone 1"].target.name, "Rig Bone 1 Target")

    def test_all_bones_up_to_the_root(self):
        rig = self.arm()
        self.reach(chain_length=0)
        driven = [bone.name for bone in rig.pose.bones if bone.constraints]
        self.assertEqual(driven, ["Shoulder", "Bone 0", "Bone 1"])
        self.assertNear(self.tail(rig), REACHABLE)

    def test_longer_than_the_rig(self):
        rig = self.arm()
        entry = self.reach(chain_length=9)
        chain = support.addon("ik.chains").find(rig, entry)
        self.assertEqual(chain.bones, ("Shoulder", "Bone 0", "Bone 1"))
        (warning,) = support.addon("ik.targets").warnings(rig, chain, 9)
        self.assertIn("only 3 bones", warning)

    def test_warnings(self):
        rig = self.arm()
        constraint = rig.pose.bones["Bone 0"].constraints.new('COPY_ROTATION')
        constraint.name = "Mine"
        entry = self.reach()
        warnings = support.addon("ik.targets").warnings(rig, support.addon("ik.chains").find(rig, entry), 2)
        self.assertEqual(len(warnings), 1)
        self.assertIn("Mine", warnings[0])

    def test_further_targets(self):
        rig = self.arm()
        entry = self.reach()
        self.target((0.5, -0.4, 1.2), "Other")
        bpy.ops.motus.ik_target_add(object="Rig", bone="Bone 1", target="Other")
        entry.target_blend = 1.0
        self.assertNear(self.tail(rig), (0.5, -0.4, 1.2))
        bpy.ops.motus.ik_target_remove(object="Rig", bone="Bone 1")
        self.assertNear(self.tail(rig), REACHABLE)
        self.assertRefused("no such target", bpy.ops.motus.ik_target_remove, object="Rig", bone="Bone 1")
        self.assertRefused(
            "moves with the chain", bpy.ops.motus.ik_target_add, object="Rig", bone="Bone 1", target="Rig", target_bone="Hand"
        )


class Refusals(IkTestCase):
    def test_names(self):
        self.arm()
        add = bpy.ops.motus.ik_add
        self.target()
        self.assertRefused("no object Nobody", add, object="Nobody", bone="Bone 1")
        self.assertRefused("not an armature", add, object="Target", bone="Bone 1")
        self.assertRefused("no bone Nose", add, object="Rig", bone="Nose")
        self.assertRefused("no object Nowhere", add, object="Rig", bone="Bone 1", target="Nowhere")
        self.assertRefused("no bone Nose", add, object="Rig", bone="Bone 1", target="Rig", target_bone="Nose")
        self.assertRefused("has no bone", add, object="Rig", bone="Bone 1", target="Target", target_bone="Nose")
        self.assertRefused("Name the armature", add, object="Rig", bone="Bone 1", pole_bone="Hand")
        self.assertRefused("has no parent", add, object="Rig", bone="Shoulder", use_tail=False)
        self.assertRefused("Nothing here", bpy.ops.motus.ik_remove, object="Rig")
        self.assertFalse(bpy.data.objects["Rig"].motus.ik.entries)

    def test_not_finite(self):
        self.arm()
        for name, value in (("softness", math.nan), ("pole_angle", math.nan), ("rotation_offset", (0, math.nan, 0))):
            self.assertRefused(f"{name} is not a finite", bpy.ops.motus.ik_add, object="Rig", bone="Bone 1", **{name: value})

    def test_shared_bones(self):
        self.arm(tentacle(5))
        self.reach("Bone 4", chain_length=3)
        self.assertRefused(
            "Bone 2 is driven by Inverse Kinematics of Bone 4", bpy.ops.motus.ik_add, object="Rig", bone="Bone 3", target="Target"
        )
        self.reach("Bone 1", chain_length=2)

    def test_loops(self):
        rig = self.arm()
        add = bpy.ops.motus.ik_add
        before = state(rig)
        for bone in ("Bone 1", "Bone 0", "Hand"):
            self.assertRefused("moves with the chain", add, object="Rig", bone="Bone 1", target="Rig", target_bone=bone)
        held = self.target(name="Held")
        held.parent, held.parent_type, held.parent_bone = rig, 'BONE', "Hand"
        self.assertRefused("Held moves with the chain of Bone 1", add, object="Rig", bone="Bone 1", target="Held")
        self.assertRefused("Held moves with the chain", add, object="Rig", bone="Bone 1", pole="Held")
        follower = self.target(name="Follower")
        follower.constraints.new('COPY_LOCATION').target = held
        self.assertRefused("moves with the chain", add, object="Rig", bone="Bone 1", target="Follower")
        self.assertEqual(state(rig), before)
        self.reach()
        self.assertRefused("moves with the chain", add, object="Rig", bone="Bone 1", target="Follower")
        self.assertEqual(rig.motus.ik.entries["Bone 1"].target.name, "Target")
        self.assertNear(self.tail(rig), REACHABLE)

    def test_two_chains_that_wait_for_each_other(self):
        rig = self.arm(name="Rig")
        other = self.arm(name="Other")
        other.location.x = -0.4
        self.reach("Bone 1", "Rig", target="Other", target_bone="Hand")
        self.assertRefused("moves with the chain", bpy.ops.motus.ik_add, object="Other", bone="Bone 1", target="Rig", target_bone="Hand")
        self.assertFalse(other.motus.ik.is_active)
        self.assertNear(self.tail(rig), self.head(other))

    def test_linked_and_baked(self):
        self.arm()
        self.reach()
        bpy.ops.motus.bake(object="Rig", frame_start=1, frame_end=3)
        self.assertRefused("baked", bpy.ops.motus.ik_add, object="Rig", bone="Bone 1", softness=0.1)
        self.assertRefused("baked", bpy.ops.motus.ik_remove, object="Rig")
        bpy.ops.motus.unbake(object="Rig")
        bpy.ops.motus.ik_remove(object="Rig")
        library = str(self.folder / "library.blend")
        bpy.data.libraries.write(library, {bpy.data.objects["Rig"]}, fake_user=True)
        bpy.data.objects.remove(bpy.data.objects["Rig"])
        with bpy.data.libraries.load(library, link=True) as (_, chosen):
            chosen.objects = ["Rig"]
        self.scene.collection.objects.link(chosen.objects[0])
        self.assertRefused("linked", bpy.ops.motus.ik_add, object="Rig", bone="Bone 1")


class Undo(IkTestCase):
    def test_one_step(self):
        """Blender pushes an undo step for each operator by itself only in a window; the flag says that it does."""
        for name in ("ik_add", "ik_remove", "refresh", "ik_target_add", "ik_target_remove"):
            self.assertLessEqual({'REGISTER', 'UNDO'}, getattr(bpy.types, f"MOTUS_OT_{name}").bl_options)

    def test_modes(self):
        rig = self.arm()
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        self.assertFalse(bpy.ops.motus.ik_add.poll())
        bpy.ops.object.mode_set(mode='POSE')
        self.assertTrue(bpy.ops.motus.ik_add.poll())
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertTrue(bpy.ops.motus.ik_add.poll())
