"""Inverse kinematics taken back without a trace, keys of later chains that stay theirs, and presets."""

import bpy

import support
from ik.ik_cases import IkTestCase, counts, state, tentacle, turn


class Remove(IkTestCase):
    def used(self):
        """A rig with everything of its own that must survive."""
        rig = self.arm()
        rig.pose.bones["Bone 1"].constraints.new('COPY_SCALE').name = "Own"
        rig.pose.bones["Bone 0"].use_ik_limit_x = True
        turn(rig.pose.bones["Bone 0"], (0.0, 0.0, 1.0), 0.2)
        rig.pose.bones["Hand"].keyframe_insert("rotation_quaternion", frame=1)
        rig.driver_add("location", 2).driver.expression = "0.5"
        self.target()
        bpy.context.view_layer.update()
        return rig

    def test_nothing_is_left(self):
        rig = self.used()
        before = state(rig), counts()
        entry = self.reach(stretch=0.5, rotation_weight=0.5)
        entry.softness = 0.1
        rig.keyframe_insert("motus.ik.entries[0].position_weight", frame=1)
        rig.keyframe_insert('motus.ik.entries["Bone 1"].pole_angle', frame=1)
        rig.keyframe_insert("motus.ik.influence", frame=1)
        rig.driver_add("motus.ik.entries[0].rotation_weight").driver.expression = "0.25"
        self.poses(rig, 10)
        self.assertNotEqual(state(rig), before[0])
        bpy.ops.motus.ik_remove(object="Rig")
        self.poses(rig, 1)
        self.assertEqual((state(rig), counts()), before)

    def test_the_active_constraint_stays_active(self):
        rig = self.used()
        constraints = rig.pose.bones["Bone 1"].constraints
        own, other = constraints.new('LIMIT_ROTATION'), constraints.new('LIMIT_SCALE')
        for active in (own, other, None):
            constraints.active = active
            self.reach()
            self.assertEqual(constraints.active, active)
            bpy.ops.motus.ik_remove(object="Rig")
            self.assertEqual(constraints.active, active)

    def test_poses_are_restored_bit_by_bit(self):
        rig = self.used()
        before = self.poses(rig, 1).tolist()
        self.reach()
        self.assertNotEqual(self.poses(rig, 2).tolist(), before)
        bpy.ops.motus.ik_remove(object="Rig")
        self.assertEqual(self.poses(rig, 1).tolist(), before)

    def test_keys_of_later_chains_stay_theirs(self):
        rig = self.arm(tentacle(6))
        for bone in ("Bone 1", "Bone 3", "Bone 5"):
            self.reach(bone)
        for index in range(3):
            rig.motus.ik.entries[index].softness = 0.1 * (index + 1)
            rig.keyframe_insert(f"motus.ik.entries[{index}].softness", frame=1)
        rig.driver_add("motus.ik.entries[2].pole_angle").driver.expression = "0.5"
        bpy.ops.motus.ik_remove(object="Rig", bone="Bone 3")
        self.assertEqual([entry.name for entry in rig.motus.ik.entries], ["Bone 1", "Bone 5"])
        curves = support.addon("core.blender.actions").fcurves(rig)
        values = {curve.data_path: round(curve.evaluate(1), 6) for curve in curves}
        self.assertEqual(values, {"motus.ik.entries[0].softness": 0.1, "motus.ik.entries[1].softness": 0.3})
        self.assertIn("motus.ik.entries[1].pole_angle", [curve.data_path for curve in rig.animation_data.drivers])
        self.evaluated(rig, 2)
        self.assertAlmostEqual(rig.motus.ik.entries["Bone 5"].pole_angle, 0.5, places=6)
        self.assertFalse(rig.pose.bones["Bone 3"].constraints)
        self.assertTrue(rig.pose.bones["Bone 4"].constraints)

    def test_shared_action_of_another_rig_is_left_alone(self):
        rig = self.arm(tentacle(4))
        self.reach("Bone 1")
        self.reach("Bone 3")
        for index in range(2):
            rig.keyframe_insert(f"motus.ik.entries[{index}].softness", frame=1)
        other = rig.copy()
        self.scene.collection.objects.link(other)
        other.animation_data.action = rig.animation_data.action
        paths = [curve.data_path for curve in support.addon("core.blender.actions").fcurves(other)]
        bpy.ops.motus.ik_remove(object="Rig", bone="Bone 1")
        self.assertEqual([curve.data_path for curve in support.addon("core.blender.actions").fcurves(other)], paths)
        self.assertEqual(
            [curve.data_path for curve in support.addon("core.blender.actions").fcurves(rig)], ["motus.ik.entries[0].softness"]
        )

    def keyed(self, name="softness"):
        """Three chains, of which a setting is 0.1, 0.2 and 0.3 by keys."""
        rig = self.arm(tentacle(6))
        for index, bone in enumerate(("Bone 1", "Bone 3", "Bone 5")):
            setattr(self.reach(bone), name, 0.1 * (index + 1))
            rig.keyframe_insert(f"motus.ik.entries[{index}].{name}", frame=1)
        return rig

    @staticmethod
    def push_down(rig, count=1):
        """Let strips of the NLA play the rig's action, which it has no more."""
        animation = rig.animation_data
        action = animation.action
        strips = [animation.nla_tracks.new().strips.new("Strip", 1, action) for _ in range(count)]
        animation.action = None
        return strips

    @staticmethod
    def curves_of(strip):
        curves = support.addon("core.blender.actions").curves_of(strip)
        return {curve.data_path: round(curve.evaluate(1), 6) for curve in curves}

    LEFT = {"motus.ik.entries[0].softness": 0.1, "motus.ik.entries[1].softness": 0.3}

    def test_keys_in_strips_stay_with_their_chains(self):
        rig = self.keyed()
        strips = self.push_down(rig, 2)
        rig.motus.ik.entries[2].keyframe_insert("softness", frame=1)
        bpy.ops.motus.ik_remove(object="Rig", bone="Bone 3")
        self.assertEqual([self.curves_of(strip) for strip in strips], [self.LEFT] * 2)
        self.assertEqual(self.curves_of(rig.animation_data), {"motus.ik.entries[1].softness": 0.3})
        evaluated = self.evaluated(rig, 5).motus.ik.entries
        self.assertEqual([round(entry.softness, 6) for entry in evaluated], [0.1, 0.3])

    def test_strips_of_another_rig_are_left_alone(self):
        rig = self.keyed()
        (strip,) = self.push_down(rig)
        other = rig.copy()
        self.scene.collection.objects.link(other)
        before = self.curves_of(strip)
        bpy.ops.motus.ik_remove(object="Rig", bone="Bone 3")
        self.assertEqual(self.curves_of(strip), self.LEFT)
        self.assertEqual(self.curves_of(other.animation_data.nla_tracks[0].strips[0]), before)

    def test_linked_keys_are_left_alone(self):
        rig = self.keyed()
        library = str(self.folder / "library.blend")
        bpy.data.libraries.write(library, {rig.animation_data.action}, fake_user=True)
        with bpy.data.libraries.load(library, link=True) as (found, chosen):
            chosen.actions = found.actions
        (linked,) = chosen.actions
        actions = support.addon("core.blender.actions")
        actions.assign(rig, linked, actions.slot_identifier(rig))
        strip = rig.animation_data.nla_tracks.new().strips.new("Strip", 1, linked)
        rig.animation_data.action_influence = 0.5
        before = [curve.data_path for curves in actions.all_fcurves(linked) for curve in curves]
        bpy.ops.motus.ik_remove(object="Rig", bone="Bone 3")
        self.assertEqual([curve.data_path for curves in actions.all_fcurves(linked) for curve in curves], before)
        self.assertEqual([self.curves_of(player) for player in (rig.animation_data, strip)], [self.LEFT] * 2)

    def test_tweaked_strips(self):
        rig = self.keyed()
        (strip,) = self.push_down(rig)
        rig.animation_data.nla_tracks.active = rig.animation_data.nla_tracks[0]
        strip.select = True
        rig.animation_data.use_tweak_mode = True
        self.assertTrue(rig.animation_data.use_tweak_mode)
        before = state(rig)
        for operator, keywords in ((bpy.ops.motus.ik_remove, {}), (bpy.ops.motus.ik_remove, {"bone": "Bone 3"})):
            self.assertRefused("tweak mode", operator, object="Rig", **keywords)
        self.assertEqual(state(rig), before)

    def test_nothing_is_left_in_strips(self):
        rig = self.keyed()
        rig.pose.bones["Hand"].keyframe_insert("rotation_quaternion", frame=1)
        (strip,) = self.push_down(rig)
        bpy.ops.motus.ik_remove(object="Rig")
        self.assertEqual(list(self.curves_of(strip)), ['pose.bones["Hand"].rotation_quaternion'])

    def test_controls(self):
        self.arm()
        self.reach(target="", make_pole=True)
        self.reach("Hand", target="Rig Bone 1 Pole", chain_length=1)
        bpy.ops.motus.ik_remove(object="Rig", bone="Bone 1", remove_controls=True)
        self.assertNotIn("Rig Bone 1 Target", bpy.data.objects)
        self.assertIn("Rig Bone 1 Pole", bpy.data.objects, "another chain reaches for it")
        bpy.ops.motus.ik_remove(object="Rig")
        self.assertIn("Rig Bone 1 Pole", bpy.data.objects)
        self.reach(target="Rig Bone 1 Pole")
        bpy.ops.motus.ik_remove(object="Rig", remove_controls=True)
        self.assertNotIn("Rig Bone 1 Pole", bpy.data.objects)

    def test_removed_settings_are_the_defaults_again(self):
        rig = self.arm()
        self.reach(softness=0.5)
        bpy.ops.motus.ik_remove(object="Rig")
        self.assertEqual((len(rig.motus.ik.entries), rig.motus.ik.is_active), (0, False))
        self.assertEqual(self.reach().softness, 0.0)

    def test_refresh_keeps_everything(self):
        rig = self.arm()
        self.reach(stretch=0.5)
        before = state(rig), counts(), self.poses(rig)
        bpy.ops.motus.refresh(object="Rig", system="ik")
        self.assertSamePose(rig, before[2], 0.0)
        self.assertEqual((state(rig), counts()), before[:2])


class Presets(IkTestCase):
    def test_kept_and_taken_up_again(self):
        rig = self.arm()
        self.reach(softness=0.25, stretch=0.5, position_weight=0.5)
        bpy.context.view_layer.objects.active = rig
        take_up = self.keep_preset("ik")
        entry = self.reach(softness=0.0, stretch=0.0, position_weight=1.0)
        take_up()
        self.assertEqual((entry.softness, entry.stretch), (0.25, 0.5))
        self.assertEqual(entry.position_weight, 1.0, "belongs to the shot, not to the preset")
