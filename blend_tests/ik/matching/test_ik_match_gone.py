"""Matching where targets and poles are gone, or have lost their bone."""

import bpy

from ik.ik_cases import add_bone, state
from ik.matching.ik_match_cases import MatchTestCase, state_of


class Gone(MatchTestCase):
    """Targets and poles that were removed, or have lost their bone."""

    def setUp(self):
        super().setUp()
        self.rigged = self.animated_arm()
        self.recorded_poses = self.recorded(self.rigged, (1, 9, 30))
        self.helper = self.rig(lambda bones: add_bone(bones, "Goal", (0.6, 0.3, 1.4), (0.6, 0.3, 1.7)), "Controls")

    def lose_bone(self):
        bpy.context.view_layer.update()
        bpy.context.view_layer.objects.active = self.helper
        bpy.ops.object.mode_set(mode='EDIT')
        bones = self.helper.data.edit_bones
        bones.remove(bones["Goal"])
        add_bone(bones, "Other", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
        bpy.ops.object.mode_set(mode='OBJECT')

    def delete(self, name):
        bpy.context.view_layer.update()  # seen in its collection
        self.scene.collection.objects.unlink(bpy.data.objects[name])

    def assertNothingDone(self, sentence, obj):
        bpy.context.view_layer.update()
        self.scene.frame_set(3)
        before = state(self.rigged), state_of(obj), obj.animation_data, len(bpy.data.actions)
        for switch in (False, True):
            self.assertRefused(sentence, bpy.ops.motus.ik_match_fk, object="Rig", switch=switch)
            self.assertEqual((state(self.rigged), state_of(obj), obj.animation_data, len(bpy.data.actions)), before)
            self.assertEqual(self.scene.frame_current, 3)

    def test_bone_of_the_target(self):
        self.reach(target="Controls", target_bone="Goal")
        self.lose_bone()
        self.assertNothingDone("Controls has no bone Goal", self.helper)

    def test_bone_of_a_further_target(self):
        entry = self.reach()
        bpy.ops.motus.ik_target_add(object="Rig", bone="Bone 1", target="Controls", target_bone="Goal")
        entry.target_blend = 1.0
        self.lose_bone()
        self.assertNothingDone("Controls has no bone Goal", self.helper)

    def test_target(self):
        self.reach()
        self.delete("Target")
        self.assertNothingDone("Target is in no collection any more: choose another target", bpy.data.objects["Target"])

    def test_further_target(self):
        entry = self.reach()
        bpy.ops.motus.ik_target_add(object="Rig", bone="Bone 1", target="Controls")
        entry.target_blend = 1.0
        self.delete("Controls")
        self.assertNothingDone("Controls is in no collection any more: choose another target", self.helper)

    def test_pole(self):
        """The chain bends as without one."""
        self.target((0.0, -3.0, 1.0), "Pole")
        for keywords, lose in (
            ({"pole": "Pole"}, lambda: self.delete("Pole")),
            ({"pole": "Controls", "pole_bone": "Goal"}, self.lose_bone),
        ):
            with self.subTest(keywords["pole"]):
                entry = self.reach(**keywords)
                pole = entry.pole
                lose()
                self.match()
                self.assertRecorded(self.rigged, self.recorded_poses)
                self.assertIsNone(pole.animation_data)
                bpy.ops.motus.ik_remove(object="Rig")

    def test_name_of_a_bone_of_what_has_none(self):
        """It counts for nothing."""
        entry = self.reach(make_pole=True)
        entry.target_bone = entry.pole_bone = "Goal"
        self.match()
        self.assertRecorded(self.rigged, self.recorded_poses)
        target = bpy.data.objects["Target"]
        target.animation_data_clear()
        evaluated = self.rigged.evaluated_get(bpy.context.evaluated_depsgraph_get())
        bones, world = evaluated.pose.bones, evaluated.matrix_world
        target.location = (world @ bones["Bone 0"].head).lerp(world @ bones["Bone 1"].tail, 0.8)
        bpy.context.view_layer.update()
        self.assertLess((world @ bones["Bone 1"].tail - target.location).length, 1e-5)
