"""Problems that the panel of Look At tells, and set-ups that its operators refuse."""

import math

import bpy

import support
from look_at.look_at_cases import LookAtTestCase, build_rig


class Problems(LookAtTestCase):
    def assertNeutral(self, before):
        bpy.context.view_layer.update()
        self.assertSamePoses(self.poses(), before, 0.0)

    def setUp(self):
        super().setUp()
        bpy.context.view_layer.update()
        self.before = self.poses()
        self.aim(40)
        self.entry = self.look()

    def test_no_target(self):
        self.entry.target = None
        self.assertNeutral(self.before)
        self.assertIn("nothing to look at", self.sentence())
        self.assertEqual(self.told("reason"), self.reasons.NO_TARGET)
        self.assertIn("Choose a target", self.reasons.sentence(self.told("reason"), self.told("angle")))

    def test_a_deleted_target(self):
        bpy.data.objects.remove(self.target)
        self.assertNeutral(self.before)
        self.assertEqual(self.told("reason"), self.reasons.NO_TARGET)

    def test_a_target_taken_out_of_the_scene(self):
        self.scene.collection.objects.unlink(self.target)
        self.go_to(2)
        self.assertNeutral(self.before)
        self.assertEqual(self.told("reason"), self.reasons.TARGET_DELETED)

    def test_a_bone_that_the_target_has_not(self):
        self.entry.target = build_rig(name="Other")
        self.entry.target_bone = "Nose"
        self.assertNeutral(self.before)
        self.assertEqual(self.told("reason"), self.reasons.NO_TARGET_BONE)

    def test_a_name_of_a_bone_left_from_an_earlier_target(self):
        bpy.context.view_layer.update()
        aimed = self.poses()
        self.entry.target_bone = "Nose"
        self.assertSamePoses(self.poses(), aimed, 0.0)
        self.assertEqual(self.told("reason"), float(support.addon("core.native").module.Reason.REACHED))

    def test_a_setting_that_is_no_number(self):
        self.rig["bad"] = float("nan")
        curve = self.rig.driver_add("motus.look_at.entries[0].weight")
        variable = curve.driver.variables.new()
        variable.targets[0].id, variable.targets[0].data_path = self.rig, '["bad"]'
        curve.driver.type = 'SUM'
        for _ in range(2):
            bpy.context.view_layer.update()
        values = [value for matrix in self.poses().values() for row in matrix for value in row]
        self.assertTrue(all(map(math.isfinite, values)))

    def test_a_target_that_comes_to_hang_on_the_head(self):
        self.target.parent = self.rig
        self.target.parent_type, self.target.parent_bone = 'BONE', "Head"
        bpy.ops.motus.refresh(object="Rig", system="look_at")
        self.assertNeutral(self.before)
        self.assertIn("moves with the head", self.sentence())

    def test_one_head_without_a_target_leaves_the_others_alone(self):
        bones = {
            "Body": ("", (0, 0, 0), (0, 0, 1)),
            "HeadA": ("Body", (0.2, 0, 1), (0.2, 0, 1.2)),
            "HeadB": ("Body", (-0.2, 0, 1), (-0.2, 0, 1.2)),
        }
        rig = build_rig(bones, "Two")
        self.target.location = (0.0, -2.0, 1.0)
        for name in ("HeadA", "HeadB"):
            self.look("Two", bone=name)
        rig.motus.look_at.entries["HeadA"].target = None
        bpy.context.view_layer.update()
        way = self.target.location - self.pose("HeadB", rig).translation
        self.assertLess(math.degrees(self.gaze("HeadB", rig=rig).angle(way)), 2e-3)


class Refusals(LookAtTestCase):
    def test_names(self):
        add = bpy.ops.motus.look_at_add
        self.assertRefused("no object Nobody", add, object="Nobody")
        self.assertRefused("Target is not an armature", add, object="Target")
        self.assertRefused("has no bone Nose", add, object="Rig", bone="Nose")
        self.assertRefused("no object Nowhere", add, object="Rig", bone="Head", target="Nowhere")
        self.assertRefused("Name an armature", add, object="Rig", bone="Head", target="Target", target_bone="Head")
        self.assertRefused("no bone Nose", add, object="Rig", bone="Head", target="Rig", target_bone="Nose")
        self.assertRefused("has no bone Nose", add, object="Rig", bone="Head", eyes="Nose")
        self.assertRefused("not below Head", add, object="Rig", bone="Head", eyes="Chest")
        self.assertRefused("named twice", add, object="Rig", bone="Head", eyes="Eye.L, Eye.L")
        self.assertRefused("only 4 bones below", add, object="Rig", bone="Head", body_length=5)
        self.assertRefused("weight is not a finite", add, object="Rig", bone="Head", weight=math.nan)
        self.assertFalse(self.rig.motus.look_at.is_active or self.rig.motus.look_at.entries)
        self.assertRefused("Nothing here looks", bpy.ops.motus.look_at_remove, object="Rig")
        self.assertRefused("Rig is not driven by Motus", bpy.ops.motus.refresh, object="Rig", system="look_at")
        self.look()
        self.assertRefused("Neck of Rig looks at nothing", bpy.ops.motus.look_at_remove, object="Rig", bone="Neck")

    def test_a_head_that_cannot_be_guessed(self):
        rig = build_rig({"One": ("", (0, 0, 0), (0, 0, 1))}, "Plain")
        self.assertRefused("Choose the bone of the head", bpy.ops.motus.look_at_add, object="Plain")
        self.assertFalse(rig.motus.look_at.is_active)

    def test_loops(self):
        add = bpy.ops.motus.look_at_add
        self.target.parent = self.rig
        self.target.parent_type, self.target.parent_bone = 'BONE', "Eye.L"
        self.assertRefused("moves with Head", add, object="Rig", bone="Head", target="Target")
        self.assertRefused("moves with Head", add, object="Rig", bone="Head", target="Rig", target_bone="LowerArm.L")
        # The neck carries no arm.
        self.look(target="Rig", target_bone="LowerArm.L", body_length=1)

    def test_linked_rig(self):
        library = str(self.folder / "library.blend")
        bpy.data.libraries.write(library, {self.rig}, fake_user=True)
        bpy.data.objects.remove(self.rig)
        with bpy.data.libraries.load(library, link=True) as (_, chosen):
            chosen.objects = ["Rig"]
        self.scene.collection.objects.link(chosen.objects[0])
        self.assertRefused("linked", bpy.ops.motus.look_at_add, object="Rig", bone="Head")
