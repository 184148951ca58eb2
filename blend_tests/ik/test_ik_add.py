"""What is made along with a chain: controls that leave the pose as it is, wherever the rig stands."""

import math
import random

import bpy
from mathutils import Quaternion, Vector

import support
from ik.ik_cases import ARM, IkTestCase, rigid, tentacle, turn


class OfAnOverride(IkTestCase):
    """Blender lets nobody put an object into a collection that is linked or overridden."""

    def overridden(self):
        """An override of a whole collection "Linked" with a rig, whose bones are those of an arm."""
        rig = self.arm()
        collection = bpy.data.collections.new("Linked")
        self.scene.collection.children.link(collection)
        collection.objects.link(rig)
        self.scene.collection.objects.unlink(rig)
        path = str(self.folder / "library.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        support.empty_scene()
        self.scene = bpy.context.scene
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.collections = ["Linked"]
        self.scene.collection.children.link(wanted.collections[0])
        made = wanted.collections[0].override_hierarchy_create(self.scene, bpy.context.view_layer)
        bpy.context.view_layer.update()
        return made.objects["Rig"]

    def test_controls_go_into_the_scene(self):
        rig = self.overridden()
        before = self.poses(rig)
        entry = self.reach(target="", make_pole=True)
        for control in (entry.target, entry.pole):
            self.assertEqual(control.users_collection, (self.scene.collection,))
        self.assertSamePose(rig, before)

    def test_controls_go_into_a_collection_of_the_file(self):
        rig = self.overridden()
        own = bpy.data.collections.new("Own")
        self.scene.collection.children.link(own)
        own.objects.link(rig)
        self.assertEqual(self.reach(target="").target.users_collection, (own,))

    def test_target_of_a_head(self):
        rig = self.overridden()
        bpy.ops.motus.look_at_add(object="Rig", bone="Hand")
        target = rig.motus.look_at.entries[0].target
        self.assertEqual(target.users_collection, (self.scene.collection,))


class OnAScaledRig(IkTestCase):
    """Keep Rotation, where axes are no longer at right angles."""

    def stand(self, rig, kind):
        if kind == "mirrored":
            rig.scale = (-1.0, 1.0, 1.0)
        else:
            rig.rotation_euler = (0.5, 0.6, 0.7)
            rig.scale = (1.0, 2.0, 0.5)
        if kind == "sheared":
            parent = self.target((0.1, 0.2, 0.3), "Parent")
            parent.scale, parent.rotation_euler = (1.0, 2.0, 0.5), (0.3, 0.4, 0.5)
            rig.parent, rig.scale = parent, (1.0, 1.0, 1.0)

    def given_target(self, rig, bone, use_tail):
        """On the chain's tip, under a parent that shears it."""
        parent = self.target((0.3, 0.2, 0.1), "Shearing")
        parent.scale, parent.rotation_euler = (1.0, -0.5, 2.0), (0.2, 0.9, 0.4)
        target = self.target((0.0, 0.0, 0.0))
        target.parent, target.rotation_euler = parent, (0.4, 0.8, 1.2)
        tip = self.tail(rig, bone) if use_tail else self.head(rig, bone)
        target.location = self.evaluated(parent).matrix_world.inverted() @ tip
        return target.name

    def test_the_pose_is_kept(self):
        for kind in ("scaled", "sheared", "mirrored"):
            for bone, use_tail in (("Bone 1", True), ("Hand", False)):
                for is_given in (False, True):
                    with self.subTest(kind, bone=bone, is_given=is_given):
                        support.empty_scene()
                        self.scene = bpy.context.scene
                        rig = self.arm()
                        self.stand(rig, kind)
                        for index, name in enumerate(("Bone 0", "Bone 1", "Hand")):
                            turn(rig.pose.bones[name], (0.3, 0.2 + 0.1 * index, -0.4), 0.8)
                        before = self.poses(rig)
                        target = self.given_target(rig, bone, use_tail) if is_given else ""
                        self.reach(bone, target=target, use_tail=use_tail, rotation_weight=1.0)
                        self.assertSamePose(rig, before, 1e-5)


class MadePole(IkTestCase):
    """Nothing moves until the pole is moved."""

    def setUp(self):
        super().setUp()
        self.random = random.Random(7)

    def renew(self, joints):
        support.empty_scene()
        self.scene = bpy.context.scene
        return self.arm(joints)

    def bones_of(self, count, is_bent):
        joints = [Vector((0.0, 0.0, 1.0))]
        for index in range(count):
            angle = 0.3 * index * is_bent
            joints.append(joints[-1] + 0.3 * Vector((math.cos(angle), math.sin(angle), 0.05 * index * is_bent)))
        return joints

    def pose_at_random(self, rig, most=0.4):
        for bone in rig.pose.bones:
            bone.rotation_quaternion = Quaternion([self.random.uniform(-0.5, 0.5) for _ in range(3)], most)

    def test_any_pose(self):
        settings = (
            {},
            {"use_limits": True},
            {"bend": 'AWAY', "pole_angle": 0.7},
            {"rotation_weight": 1.0},
            {"use_limits": True, "bend": 'AWAY', "pole_angle": 0.7},
        )
        for count in (1, 2, 3, 5):
            for is_bent in (False, True):
                for keywords in settings * 2:
                    with self.subTest(count=count, is_bent=is_bent, **keywords):
                        rig = self.renew(self.bones_of(count, is_bent))
                        self.pose_at_random(rig)
                        before = self.poses(rig)
                        self.reach(f"Bone {count - 1}", target="", make_pole=True, chain_length=count, **keywords)
                        self.assertSamePose(rig, before, 5e-6)

    def test_between_straight_and_bent(self):
        """The plane that the pose bends in counts the less, the straighter it is; at rest it is straight, or not."""
        for joints in (((0.0, 0.0, 1.0), (0.5, 0.0, 1.0), (1.0, 0.0, 1.0)), ARM):
            for degrees in (0.0, 2.0, 5.0, 7.0, 9.0, 12.0):
                with self.subTest(joints=joints, degrees=degrees):
                    rig = self.renew(joints)
                    turn(rig.pose.bones["Bone 1"], (0.3, 0.1, 1.0), math.radians(degrees))
                    before = self.poses(rig)
                    self.reach(target="", make_pole=True)
                    self.assertSamePose(rig, before, 5e-6)

    def test_scaled_and_mirrored_rigs(self):
        for scale in ((1.0, 2.0, 0.5), (-1.0, 1.0, 1.0)):
            for keywords in ({}, {"use_limits": True}):
                with self.subTest(scale=scale, **keywords):
                    rig = self.renew(tentacle(4))
                    rig.matrix_world = rigid((1.0, 2.0, 3.0), (1.0, 1.0, 0.0), 0.7, scale)
                    self.pose_at_random(rig)
                    before = self.poses(rig)
                    self.reach("Bone 3", target="", make_pole=True, chain_length=4, **keywords)
                    self.assertSamePose(rig, before, 5e-6)

    def test_to_a_chain_that_stands_elsewhere(self):
        """A pole that is made later leaves the solution that there is."""
        for keywords in ({}, {"use_limits": True}, {"pole_angle": 0.5, "chain_length": 3}):
            with self.subTest(**keywords):
                rig = self.renew(self.bones_of(3, True))
                self.pose_at_random(rig)
                self.target((0.3, 0.35, 1.3))
                self.reach("Bone 2", **{"chain_length": 3, **keywords})
                before = self.poses(rig)
                self.reach("Bone 2", make_pole=True)
                self.assertSamePose(rig, before, 5e-6)

    def test_real_limits(self):
        for _ in range(5):
            rig = self.renew(self.bones_of(3, True))
            for bone in rig.pose.bones:
                for axis in "xyz":
                    setattr(bone, f"use_ik_limit_{axis}", True)
                    setattr(bone, f"ik_min_{axis}", -0.5)
                    setattr(bone, f"ik_max_{axis}", 0.5)
            self.pose_at_random(rig)
            before = self.poses(rig)
            self.reach("Bone 2", target="", make_pole=True, chain_length=3, use_limits=True)
            self.assertSamePose(rig, before, 5e-6)
