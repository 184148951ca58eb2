"""Control bones, poles that are made later, and what becomes of targets and poles when chains are removed."""

import bpy
from mathutils import Matrix, Vector

import support
from ik.ik_cases import IkTestCase

MOVED = 2e-5


class Controls(IkTestCase):
    def setUp(self):
        super().setUp()
        self.arm_rig = self.arm()

    def bend(self):
        self.arm_rig.pose.bones["Bone 0"].rotation_quaternion = (0.9, 0.2, 0.3, 0.1)
        self.arm_rig.pose.bones["Bone 1"].rotation_quaternion = (0.8, -0.1, 0.1, 0.5)
        for bone in self.arm_rig.pose.bones:
            bone.rotation_quaternion.normalize()


class ControlBones(Controls):
    def assert_control(self, name):
        bone = self.arm_rig.data.bones[name]
        self.assertEqual((bone.parent, bone.use_deform), (None, False))
        return bone

    def test_added_with_a_chain(self):
        self.bend()
        self.arm_rig.location, self.arm_rig.rotation_euler, self.arm_rig.scale = (1, 2, 3), (0.1, 0.2, 0.3), (2, 2, 2)
        before = self.poses(self.arm_rig)
        count = len(bpy.data.objects)
        entry = self.reach(target="", make_control_bone=True)
        self.assertEqual((entry.target, entry.target_bone), (self.arm_rig, "Target Bone 1"))
        self.assertEqual(tuple(entry.rotation_offset), (0.0, 0.0, 0.0))
        self.assert_control("Target Bone 1")
        after = self.poses(self.arm_rig)
        names = [bone.name for bone in self.arm_rig.pose.bones if bone.name != "Target Bone 1"]
        for row, name in enumerate(names):
            index = self.arm_rig.pose.bones.find(name)
            self.assertLess(abs(after[index] - before[row]).max(), MOVED, name)
        self.assertEqual(len([obj for obj in bpy.data.objects if obj.type == 'EMPTY']), 0)
        self.assertGreaterEqual(len(bpy.data.objects), count)
        self.assertEqual((self.arm_rig.mode, bpy.context.object), ('OBJECT', self.arm_rig))
        self.assertEqual(tuple(self.arm_rig.pose.bones["Target Bone 1"].scale), (1.0, 1.0, 1.0))

    def test_the_chain_follows_it(self):
        self.reach(target="", make_control_bone=True)
        control = self.arm_rig.pose.bones["Target Bone 1"]
        control.matrix = Matrix.Translation((0.6, 0.3, 1.4))
        tip = self.pose(self.arm_rig, "Hand").translation
        self.assertLess((tip - Vector((0.6, 0.3, 1.4))).length, 1e-4)

    def test_it_rests_at_the_chain_at_rest(self):
        self.bend()
        self.reach(target="", make_control_bone=True)
        bone = self.arm_rig.data.bones["Target Bone 1"]
        self.assertLess((bone.head_local - self.arm_rig.data.bones["Bone 1"].tail_local).length, 1e-6)

    def test_with_a_pole_both_are_bones(self):
        self.bend()
        before = self.poses(self.arm_rig)
        entry = self.reach(target="", make_control_bone=True, make_pole=True)
        self.assertEqual((entry.pole, entry.pole_bone), (self.arm_rig, "Pole Bone 1"))
        self.assert_control("Pole Bone 1")
        after = self.poses(self.arm_rig)
        for name in ("Bone 0", "Bone 1", "Hand"):
            row = [bone.name for bone in self.arm_rig.pose.bones].index(name)
            self.assertLess(abs(after[row] - before[row]).max(), MOVED, name)

    def test_for_a_chain_that_is_there(self):
        """It takes the place of the target, so that nothing moves, also where the target is out of reach or half its weight."""
        entry = self.reach(rotation_weight=0.7)
        for place, weight in (((0.6, 0.3, 1.4), 1.0), ((3.0, 0.0, 0.0), 1.0), ((0.6, 0.3, 1.4), 0.5)):
            bpy.data.objects["Target"].location = place
            entry = self.arm_rig.motus.ik.entries["Bone 1"]
            entry.target, entry.position_weight = bpy.data.objects["Target"], weight
            before = {bone.name: self.pose(self.arm_rig, bone.name) for bone in self.arm_rig.pose.bones}
            bpy.ops.motus.ik_control_bone_add(object="Rig", bone="Bone 1")
            entry = self.arm_rig.motus.ik.entries["Bone 1"]
            self.assert_control(entry.target_bone)
            for name, matrix in before.items():
                found = self.pose(self.arm_rig, name)
                self.assertLess(max(abs(a - b) for one, other in zip(found, matrix) for a, b in zip(one, other)), MOVED, name)

    def test_in_pose_mode_and_of_another_active_object(self):
        other = self.target(name="Other")
        bpy.context.view_layer.objects.active = other
        self.reach(target="", make_control_bone=True)
        self.assertEqual((bpy.context.object, self.arm_rig.mode), (other, 'OBJECT'))
        bpy.context.view_layer.objects.active = self.arm_rig
        bpy.ops.object.mode_set(mode='POSE')
        bpy.ops.motus.ik_control_bone_add(object="Rig", bone="Bone 1")
        self.assertEqual(bpy.context.mode, 'POSE')
        self.assertEqual(self.arm_rig.motus.ik.entries["Bone 1"].target_bone, "Target Bone 1.001")

    def test_a_linked_armature_refuses(self):
        self.reach()
        path = str(self.folder / "rig.blend")
        bpy.data.libraries.write(path, {self.arm_rig.data})
        with bpy.data.libraries.load(path, link=True) as (source, found):
            found.armatures = list(source.armatures)
        self.arm_rig.data = found.armatures[0]
        bpy.context.view_layer.update()
        names = len(self.arm_rig.data.bones)
        for operator, keywords in (
            (bpy.ops.motus.ik_control_bone_add, {}),
            (bpy.ops.motus.ik_add, {"make_control_bone": True}),
            (bpy.ops.motus.ik_pole_add, {"as_bone": True}),
        ):
            self.assertRefused("linked from another file", operator, object="Rig", bone="Bone 1", **keywords)
        self.assertEqual(len(self.arm_rig.data.bones), names)
        self.assertEqual(self.arm_rig.motus.ik.entries["Bone 1"].target, bpy.data.objects["Target"])


class Poles(Controls):
    def test_nothing_moves(self):
        for as_bone in (False, True):
            for angle in (0.0, 0.6):
                with self.subTest(as_bone=as_bone, angle=angle):
                    bpy.ops.motus.ik_remove(object="Rig") if self.arm_rig.motus.ik.is_active else None
                    self.bend()
                    entry = self.reach()
                    entry.pole_angle = angle
                    before = {bone.name: self.pose(self.arm_rig, bone.name) for bone in self.arm_rig.pose.bones}
                    bpy.ops.motus.ik_pole_add(object="Rig", bone="Bone 1", as_bone=as_bone)
                    entry = self.arm_rig.motus.ik.entries["Bone 1"]
                    self.assertIsNotNone(entry.pole)
                    self.assertEqual(entry.pole == self.arm_rig, as_bone)
                    for name, matrix in before.items():
                        found = self.pose(self.arm_rig, name)
                        self.assertLess(max(abs(a - b) for one, other in zip(found, matrix) for a, b in zip(one, other)), MOVED, name)

    def test_of_the_second_chain(self):
        self.reach("Bone 0", chain_length=1)
        self.reach("Bone 1", target="Second", chain_length=1)
        bpy.ops.motus.ik_pole_add(object="Rig", bone="Bone 1")
        entries = self.arm_rig.motus.ik.entries
        self.assertEqual((entries["Bone 0"].pole, entries["Bone 1"].pole.name), (None, "Rig Bone 1 Pole"))

    def test_one_is_enough(self):
        self.reach(target="", make_pole=True)
        self.assertRefused("has a pole already", bpy.ops.motus.ik_pole_add, object="Rig", bone="Bone 1")


class Removing(Controls):
    def test_bones_go_with_their_keys(self):
        self.reach(target="", make_control_bone=True, make_pole=True)
        for name in ("Target Bone 1", "Pole Bone 1", "Hand"):
            self.arm_rig.pose.bones[name].keyframe_insert("location", frame=1)
        before = len(self.arm_rig.data.bones)
        bpy.ops.motus.ik_remove(object="Rig", remove_controls=True)
        self.assertEqual(len(self.arm_rig.data.bones), before - 2)
        paths = {curve.data_path for curve in support.addon("core.blender.actions").fcurves(self.arm_rig)}
        self.assertEqual(paths, {'pose.bones["Hand"].location'})

    def test_they_stay_by_default(self):
        self.reach(target="", make_control_bone=True)
        bpy.ops.motus.ik_remove(object="Rig")
        self.assertIn("Target Bone 1", self.arm_rig.data.bones)

    def test_what_something_else_needs_stays(self):
        self.reach(target="", make_pole=True)
        child = self.target(name="Child")
        child.parent = bpy.data.objects["Rig Bone 1 Target"]
        looking = self.target(name="Looking").constraints.new('TRACK_TO')
        looking.target = bpy.data.objects["Rig Bone 1 Pole"]
        bpy.ops.motus.ik_remove(object="Rig", remove_controls=True)
        self.assertIn("Rig Bone 1 Target", bpy.data.objects)
        self.assertIn("Rig Bone 1 Pole", bpy.data.objects)

    def test_bones_that_something_else_needs_stay(self):
        def by_child(bone):
            obj = self.target(name="Child")
            obj.parent, obj.parent_type, obj.parent_bone = self.arm_rig, 'BONE', bone

        def by_constraint(bone):
            constraint = self.arm_rig.pose.bones["Shoulder"].constraints.new('COPY_LOCATION')
            constraint.target, constraint.subtarget, constraint.mute = self.arm_rig, bone, True

        def by_driver(bone):
            variable = self.target(name="Driven").driver_add("location", 0).driver.variables.new()
            variable.type = 'TRANSFORMS'
            variable.targets[0].id, variable.targets[0].bone_target = self.arm_rig, bone

        for hang in (by_child, by_constraint, by_driver):
            with self.subTest(hang=hang.__name__):
                entry = self.reach(target="", make_control_bone=True)
                name = entry.target_bone
                hang(name)
                bpy.ops.motus.ik_remove(object="Rig", remove_controls=True)
                self.assertIn(name, self.arm_rig.data.bones)

    def test_another_chains_target_stays(self):
        self.reach("Bone 0", target="", chain_length=1, make_control_bone=True)
        self.reach("Bone 1", target="Rig", target_bone="Target Bone 0", chain_length=1)
        bpy.ops.motus.ik_remove(object="Rig", bone="Bone 0", remove_controls=True)
        self.assertIn("Target Bone 0", self.arm_rig.data.bones)
        bpy.ops.motus.ik_remove(object="Rig", remove_controls=True)
        self.assertNotIn("Target Bone 0", self.arm_rig.data.bones)

    def test_a_bone_that_another_rig_with_the_same_armature_goes_to_stays(self):
        entry = self.reach(target="", make_control_bone=True)
        name = entry.target_bone
        twin = bpy.data.objects.new("Twin", self.arm_rig.data)
        self.scene.collection.objects.link(twin)
        bpy.ops.motus.ik_add(object="Twin", bone="Bone 1", target="Twin", target_bone=name)
        bpy.ops.motus.ik_remove(object="Rig", remove_controls=True)
        self.assertIn(name, self.arm_rig.data.bones)
        bpy.ops.motus.ik_remove(object="Twin", remove_controls=True)
        self.assertNotIn(name, self.arm_rig.data.bones)

    def test_of_a_rig_that_is_not_shown_nothing_is_removed(self):
        self.reach(target="", make_control_bone=True)
        self.arm_rig.hide_viewport = True
        self.assertRefused("show it in the viewport", bpy.ops.motus.ik_remove, object="Rig", remove_controls=True)
        self.assertEqual(len(self.arm_rig.motus.ik.entries), 1)
        bpy.ops.motus.ik_remove(object="Rig")
        self.assertIn("Target Bone 1", self.arm_rig.data.bones)

    def test_what_the_artist_made_stays(self):
        self.reach(pole="Target")
        bpy.ops.motus.ik_remove(object="Rig", remove_controls=True)
        self.assertIn("Target", bpy.data.objects)
