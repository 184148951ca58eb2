"""Rigs whose armature was exchanged while Blender did not evaluate them: their poses lack bones that the armature has."""

import bpy

import support
from core import pair_cases as cases

declare = support.addon("core.declare")
poses = support.addon("core.blender.poses")
wiring = support.addon("core.wiring")
SYSTEMS = [name for name in cases.KINDS["rig"] if name.split()[0] in {"layers", "ik", "look_at", "walker", "dynamics"}]
"""Systems that drive bones."""


class OutdatedPoses(support.SceneTestCase):
    def take_out(self, owner):
        """Take the rig out of the scene, and exchange its armature for one whose bones have other names, but one."""
        bpy.context.scene.collection.objects.unlink(owner)
        bpy.context.view_layer.update()
        first, other = owner.data, owner.data.copy()
        first.use_fake_user = True
        for bone in other.bones:
            if bone.name != "Spine":
                bone.name += " of another"
        first.user_remap(other)
        self.assertTrue(poses.is_pose_outdated(owner))
        return first

    def give_other_relations(self):
        """What has Motus compare the groups of all owners with those wired."""
        bpy.data.objects["Left"].parent = bpy.data.objects["Right"]
        with self.assertNoLogs(level="ERROR"):
            bpy.context.view_layer.update()

    def test_a_rig_that_comes_back_is_as_it_was(self):
        for name in SYSTEMS:
            with self.subTest(name):
                support.empty_scene()
                owner = cases.build("rig")
                cases.add(name, "rig")
                bpy.context.view_layer.update()
                wanted = cases.seen()
                first = self.take_out(owner)
                self.give_other_relations()
                wiring.refresh(declare.registered[name.split()[0]], owner)
                cases.sentences(owner)
                self.give_other_relations()
                owner.data.user_remap(first)
                bpy.data.objects["Left"].parent = None
                bpy.context.scene.collection.objects.link(owner)
                bpy.context.view_layer.update()
                self.assertFalse(poses.is_pose_outdated(owner))
                self.assertFalse(support.differ(cases.seen(), wanted))
                self.assertEqual(cases.sentences(owner), [])

    def test_a_rig_without_a_pose(self):
        owner = cases.build("rig")
        cases.add("ik", "rig")
        new = bpy.data.objects.new("New", owner.data)
        new.motus.ik.entries.add().name = "LowerArm.L"
        new.motus.ik.is_active = True
        self.assertTrue(poses.is_pose_outdated(new))
        self.give_other_relations()
        bpy.context.scene.collection.objects.link(new)
        bpy.context.view_layer.update()
        self.assertFalse(poses.is_pose_outdated(new))
