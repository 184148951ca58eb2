"""Adding, changing and removing layers: no trace, copies, names, files, flattening, baking, and what is refused."""

import bpy

import support
from layers.layer_cases import LayerTestCase, turning
from look_at.test_look_at_setup import state

ARM = ("UpperArm.L", "LowerArm.L")


class Add(LayerTestCase):
    def test_keywords_become_settings(self):
        given = {
            "weight": 0.75,
            "start": 12.5,
            "speed": 0.5,
            "after": 'REPEAT',
            "mode": 'ADDITIVE',
            "reference": 'FRAME',
            "reference_frame": 4.0,
            "blend_in": 3.0,
            "blend_out": 5.0,
            "feather": 2,
            "in_armature": True,
            "use_range": True,
            "first_frame": 2.0,
            "last_frame": 9.0,
        }
        entry = self.add(bones="Chest", **given)
        self.assertEqual({name: getattr(entry, name) for name in given}, given)
        self.assertEqual((entry.name, entry.action), ("Throw", self.throw))
        self.assertEqual([(item.name, item.kind, item.with_children) for item in entry.mask], [("Chest", 'BONE', True)])

    def test_without_a_start_it_is_the_current_frame(self):
        bpy.context.scene.frame_set(12)
        self.assertEqual(bpy.ops.motus.layer_add(object="Rig", action="Throw", layer="Now"), {'FINISHED'})
        self.assertEqual(self.rig.motus.layers.entries["Now"].start, 12.0)
        self.assertIn("current frame", bpy.ops.motus.layer_add.get_rna_type().properties["start"].description)

    def test_the_slot_that_animates_the_rig(self):
        if not support.addon("core.blender.capabilities").has_slotted_actions():
            self.skipTest("actions have no slots")
        action = bpy.data.actions.new("Shot")
        strip = action.layers.new("Layer").strips.new(type='KEYFRAME')
        for name, path, value in (
            ("Prop", "location", 9.0),
            ("Double", 'pose.bones["Hips"].location', 2.0),
            ("Rig", 'pose.bones["Hips"].location', 3.0),
        ):
            slot = action.slots.new('OBJECT', name)
            strip.channelbag(slot, ensure=True).fcurves.new(path, index=2).keyframe_points.insert(1, value)
        for slot, value in (("", 3.0), ("OBDouble", 2.0)):
            self.add(action="Shot", slot=slot, bones="Hips", layer="Shot")
            self.go_to(5)
            self.assertAlmostEqual(self.own("Hips").translation.z, value, delta=1e-6)
        # An action that is chosen in the panel has no slot named.
        action.slots.remove(action.slots["OBRig"])
        self.rig.motus.layers.entries["Shot"].slot = ""
        self.go_to(6)
        self.assertAlmostEqual(self.own("Hips").translation.z, 2.0, delta=1e-6)

    def test_selected_bones_are_the_mask(self):
        bpy.context.view_layer.objects.active = self.rig
        bpy.ops.object.mode_set(mode='POSE')
        for bone in self.rig.pose.bones:
            holder = bone if hasattr(bone, "select") else bone.bone
            holder.select = bone.name in {"UpperArm.L", "LowerArm.L", "Thigh.L"}
        self.assertEqual(bpy.ops.motus.layer_add(action="Throw"), {'FINISHED'})
        (entry,) = self.rig.motus.layers.entries
        self.assertEqual(sorted(item.name for item in entry.mask), ["Thigh.L", "UpperArm.L"])
        self.assertEqual(entry.start, self.scene.frame_current)
        bpy.ops.object.mode_set(mode='OBJECT')

    def test_again_by_name_changes_only_what_is_given(self):
        self.add(bones="Chest", weight=0.5, layer="Top")
        bpy.ops.motus.layer_add(object="Rig", layer="Top", feather=3)
        (entry,) = self.rig.motus.layers.entries
        self.assertEqual((entry.weight, entry.feather, entry.mask[0].name), (0.5, 3, "Chest"))

    def test_names_are_free_ones(self):
        self.assertEqual([self.add().name for _ in range(3)], ["Throw", "Throw.001", "Throw.002"])

    def test_refusals(self):
        add = bpy.ops.motus.layer_add
        self.assertRefused("no action Sneeze", add, object="Rig", action="Sneeze")
        self.assertRefused("has no bone Tail", add, object="Rig", action="Throw", bones="Tail")
        self.assertRefused("no armature|not an armature", add, object="Target", action="Throw")
        self.assertRefused("no slot", add, object="Rig", action="Throw", slot="OBNobody")
        self.assertRefused("Nothing here has layers", bpy.ops.motus.layer_remove, object="Rig")
        self.add()
        self.assertRefused("has no layer Sky", bpy.ops.motus.layer_remove, object="Rig", layer="Sky")
        self.assertRefused("end of the list", bpy.ops.motus.layer_move, object="Rig")
        self.assertRefused("no such item", bpy.ops.motus.layer_mask_remove, object="Rig")
        for _ in range(support.addon("layers.properties").MOST_LAYERS - 1):
            self.rig.motus.layers.entries.add()
        self.assertRefused("flatten some", add, object="Rig", action="Throw")


class Remove(LayerTestCase):
    def test_no_trace(self):
        self.rig.pose.bones["Chest"].constraints.new('LIMIT_SCALE')
        self.go_to(11)
        before, poses = state(self.rig), self.poses()
        entry = self.add(mask='ALL')
        entry.keyframe_insert("weight", frame=3)
        self.add(bones="Chest")
        for _ in range(2):
            self.assertEqual(bpy.ops.motus.layer_remove(object="Rig"), {'FINISHED'})
        self.go_to(11)
        self.assertEqual(state(self.rig), before)
        self.assertSamePoses(self.poses(), poses, 0.0)

    def test_keys_follow_their_layer(self):
        for _ in range(2):
            self.add()
        self.rig.motus.layers.entries[1].keyframe_insert("weight", frame=1)
        bpy.ops.motus.layer_move(object="Rig", layer="Throw.001", direction='UP')
        paths = [curve.data_path for curve in self.actions.fcurves(self.rig) if "layers" in curve.data_path]
        self.assertEqual(paths, ["motus.layers.entries[0].weight"])
        bpy.ops.motus.layer_duplicate(object="Rig", layer="Throw.001")
        self.assertEqual([entry.name for entry in self.rig.motus.layers.entries], ["Throw.001", "Throw.002", "Throw"])
        bpy.ops.motus.layer_remove(object="Rig", layer="Throw.001")
        self.assertFalse([curve for curve in self.actions.fcurves(self.rig) if "layers" in curve.data_path])


class Edits(LayerTestCase):
    def test_masks(self):
        self.add(bones="UpperArm.L")
        self.assertEqual(bpy.ops.motus.layer_mask_add(object="Rig", bones="Thigh.L"), {'FINISHED'})
        self.assertTrue(self.rig.pose.bones["Shin.L"].constraints)
        self.assertEqual(bpy.ops.motus.layer_mask_remove(object="Rig", index=0), {'FINISHED'})
        self.assertFalse(self.rig.pose.bones["UpperArm.L"].constraints)
        self.assertTrue(self.rig.pose.bones["Thigh.L"].constraints)

    def test_renamed_bones(self):
        entry = self.add(bones="UpperArm.L")
        self.rig.data.bones["UpperArm.L"].name = "Humerus"
        bpy.context.view_layer.update()
        (entry,) = self.rig.motus.layers.entries
        self.assertEqual(entry.mask[0].name, "Humerus")
        self.assertIsNone(self.sentence())

    def test_a_deleted_action(self):
        self.add(bones="UpperArm.L")
        walk = self.played(self.walk, 11)
        bpy.data.actions.remove(self.throw)
        self.go_to(11)
        self.assertSameTurn(self.own("UpperArm.L"), walk["UpperArm.L"])
        self.assertIn("no action", self.sentence())

    def test_a_copy_has_layers_of_its_own(self):
        entry = self.add(bones="UpperArm.L")
        other = self.rig.copy()
        self.scene.collection.objects.link(other)
        bpy.context.view_layer.update()
        bpy.context.view_layer.update()
        other.motus.layers.entries[0].weight = 0.0
        walk, throw = self.played(self.walk, 21), self.played(self.throw, 21)
        self.go_to(21)
        self.assertSameTurn(self.own("UpperArm.L"), throw["UpperArm.L"])
        self.assertSameTurn(self.own("UpperArm.L", other), walk["UpperArm.L"])
        self.assertNotEqual(other.motus.layers.hub, self.rig.motus.layers.hub)
        self.assertEqual(entry.weight, 1.0)

    def test_saved_and_opened(self):
        self.add(bones="UpperArm.L", in_armature=True)
        self.go_to(11)
        before = self.poses()
        path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        self.rig = bpy.data.objects["Rig"]
        self.scene = bpy.context.scene
        self.go_to(5)
        self.go_to(11)
        self.assertSamePoses(self.poses(), before, 1e-6)

    def test_linked_and_overridden(self):
        self.add(bones="UpperArm.L")
        self.go_to(11)
        before = self.poses()
        path = self.save()
        self.rig = self.load(path, True, "Rig")
        self.scene = bpy.context.scene
        self.go_to(5)
        self.go_to(11)
        self.assertSamePoses(self.poses(), before, 1e-6)
        override = self.rig.override_create(remap_local_usages=True)
        bpy.context.view_layer.update()
        bpy.context.view_layer.update()
        self.rig = override
        self.go_to(5)
        self.go_to(11)
        self.assertSamePoses(self.poses(override), before, 1e-6)
        override.motus.layers.entries[0].is_muted = True
        self.go_to(11)
        with self.assertRaises(AssertionError):
            self.assertSamePoses(self.poses(override), before, 1e-3)

    def test_undo(self):
        bpy.ops.ed.undo_push(message="before")
        self.add(bones="UpperArm.L")
        bpy.ops.ed.undo_push(message="added")
        bpy.ops.ed.undo()
        self.assertFalse(bpy.data.objects["Rig"].pose.bones["UpperArm.L"].constraints)
        bpy.ops.ed.redo()
        self.assertTrue(bpy.data.objects["Rig"].pose.bones["UpperArm.L"].constraints)


class Flatten(LayerTestCase):
    def test_under_time_stretching(self):
        self.scene.render.frame_map_old, self.scene.render.frame_map_new = 100, 200
        self.add(bones="UpperArm.L", start=3.0)
        wanted = {}
        for frame in (5, 17, 30):
            self.go_to(frame)
            wanted[frame] = self.poses()
        bpy.ops.motus.layers_flatten(object="Rig", frame_start=1, frame_end=40)
        for frame, poses in wanted.items():
            self.go_to(frame)
            self.assertSamePoses(self.poses(), poses, 2e-6)

    def test_one_action_gives_the_same(self):
        turning("Wave", {"LowerArm.L": (0.0, 0.0, 1.2)})
        self.add(bones="UpperArm.L", blend_in=5.0)
        entry = self.add(action="Wave", bones="LowerArm.L", mode='ADDITIVE')
        entry.keyframe_insert("is_muted", frame=1)
        wanted = {}
        for frame in range(1, 26):
            self.go_to(frame)
            wanted[frame] = self.poses()
        self.go_to(4)
        own = self.rig.animation_data.action
        result = bpy.ops.motus.layers_flatten(object="Rig", frame_start=1, frame_end=25)
        self.assertEqual(result, {'FINISHED'})
        self.assertEqual(self.scene.frame_current, 4)
        self.assertTrue(all(entry.is_muted for entry in self.rig.motus.layers.entries))
        self.assertNotEqual(self.rig.animation_data.action, own)
        self.assertIn(own.name, bpy.data.actions)
        self.assertTrue(own.use_fake_user)
        for frame in (25, 1, 13, 8):
            self.go_to(frame)
            self.assertSamePoses(self.poses(), wanted[frame], 2e-6)
        paths = {curve.data_path for curve in self.actions.fcurves(self.rig)}
        self.assertNotIn('pose.bones["UpperArm.L"].scale', paths, "what does not move has no keys")
        self.assertRefused("are muted", bpy.ops.motus.layers_flatten, object="Rig")

    def test_bake_and_back(self):
        self.add(bones="UpperArm.L")
        self.go_to(11)
        wanted = self.poses()
        self.assertEqual(bpy.ops.motus.bake(object="Rig", frame_start=1, frame_end=21), {'FINISHED'})
        self.go_to(11)
        self.assertSamePoses(self.poses(), wanted, 2e-6)
        self.assertRefused("baked", bpy.ops.motus.layer_add, object="Rig", action="Throw")
        self.assertEqual(bpy.ops.motus.unbake(object="Rig"), {'FINISHED'})
        self.go_to(11)
        self.assertSamePoses(self.poses(), wanted, 2e-6)
        self.assertEqual(self.rig.animation_data.action, self.walk)
