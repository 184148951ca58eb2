"""One layer of two, layers that are played alone, new ones without keys, and strips of the NLA."""

import itertools

import bpy

from layers.layer_cases import new_action, turning
from layers.test_layers_keying import KeyingTestCase

FRAMES = (1, 8, 21, 3, 30)


class MergingTestCase(KeyingTestCase):
    def setUp(self):
        super().setUp()
        self.scene = bpy.context.scene
        self.scene.frame_start, self.scene.frame_end = 1, 32
        self.below, self.above = turning("Below", {"UpperArm.L": (0.2, 0.0, 0.3)}), turning("Above", {"UpperArm.L": (0.1, 0.3, 0.0)})

    def seen_at(self, frames=FRAMES):
        found = {}
        for frame in frames:
            self.go_to(frame)
            found[frame] = self.seen()
        return found

    def assertSeenAt(self, wanted, message=""):
        for frame, poses in wanted.items():
            self.go_to(frame)
            self.assertSeen(poses, f"{message} {frame}")


class Merging(MergingTestCase):
    def test_two_layers_become_one_that_is_the_same_at_whole_frames(self):
        for lower, upper, steady in itertools.product(('OVERRIDE', 'ADDITIVE'), ('OVERRIDE', 'ADDITIVE'), (False, True)):
            with self.subTest(lower=lower, upper=upper, steady=steady):
                self.add(action="Below", bones="Chest", weight=0.5)
                self.add(bones="Chest", mode=lower, reference='REST', weight=0.6, blend_in=5.0, feather=1, layer="Lower")
                entry = self.add(
                    action="Above", bones="UpperArm.L", mode=upper, reference='REST', in_armature=steady, layer="Upper", start=4.0
                )
                for frame, weight in ((1, 0.2), (20, 0.9)):
                    entry.weight = weight
                    entry.keyframe_insert("weight", frame=frame)
                self.add(action="Above", bones="LowerArm.L", mode='ADDITIVE', reference='REST', layer="Top")
                wanted = self.seen_at()
                self.assertEqual(bpy.ops.motus.layer_merge(object="Rig", layer="Upper"), {'FINISHED'})
                self.assertEqual(self.rig.motus.layers.entries.keys(), ["Below", "Lower", "Top"])
                merged = self.rig.motus.layers.entries["Lower"]
                self.assertEqual(merged.mode, 'ADDITIVE' if lower == upper == 'ADDITIVE' else 'OVERRIDE')
                self.assertEqual(merged.action.name, "Lower + Upper")
                self.assertSeenAt(wanted, "merged")
                for path in {curve.data_path for curve in self.actions.fcurves(self.rig)}:
                    self.assertFalse(path.startswith("motus."), path)
                if merged.mode == 'ADDITIVE' and not steady:
                    self.rig.motus.layers.entries["Below"].is_muted = True
                    moved = self.seen_at()
                    self.assertNotEqual(moved[8]["UpperArm.L"], wanted[8]["UpperArm.L"])
                while self.rig.motus.layers.entries:
                    bpy.ops.motus.layer_remove(object="Rig")
                bpy.data.actions.remove(bpy.data.actions["Lower + Upper"])

    def test_what_is_not_merged(self):
        entry = self.add(bones="Chest")
        self.assertRefused("no layer beneath Throw", bpy.ops.motus.layer_merge, object="Rig")
        self.add(action="Above", bones="Chest")
        entry = self.rig.motus.layers.entries["Throw"]
        entry.is_muted = True
        self.assertRefused("Throw is muted", bpy.ops.motus.layer_merge, object="Rig")


class Solo(MergingTestCase):
    def test_a_layer_that_is_played_alone(self):
        self.add(bones="Chest")
        alone = self.seen_at()
        upper = self.add(action="Above", bones="UpperArm.L")
        both = self.seen_at()
        self.rig.motus.layers.entries[0].is_solo = True
        self.assertSeenAt(alone)
        upper.is_solo = True
        self.assertSeenAt(both)


class Empty(MergingTestCase):
    def test_keys_go_into_a_new_layer(self):
        for mode in ('OVERRIDE', 'ADDITIVE'):
            before = self.seen_at()
            self.assertEqual(bpy.ops.motus.layer_new(object="Rig", bones="Chest", mode=mode, layer="Fix"), {'FINISHED'})
            entry = self.rig.motus.layers.entries["Fix"]
            self.assertTrue(entry.action.use_fake_user)
            self.assertSeenAt(before)
            for frame in (20, 8):
                self.go_to(frame)
                self.rig.pose.bones["UpperArm.L"].rotation_quaternion.x += 0.2
                bpy.context.view_layer.update()
                wanted = self.seen()
                self.key("Fix", bones="UpperArm.L")
                self.go_to(3)
                self.go_to(frame)
                self.assertSeen(wanted, f"{mode} {frame}")
            self.go_to(20)
            frames = {point.co.x for curve in next(iter(self.actions.all_fcurves(entry.action))) for point in curve.keyframe_points}
            self.assertEqual(frames, {8.0, 20.0})
            bpy.ops.motus.layer_remove(object="Rig")


class Strips(MergingTestCase):
    def test_layers_become_strips(self):
        new_action("Jump", {('pose.bones["Hips"].location', index): [(1, 0.0), (21, 0.3 * index)] for index in range(3)})
        for index in range(3):
            self.actions.fcurves(self.rig).new('pose.bones["Hips"].location', index=index).keyframe_points.insert(1, 0.1 * index)
        turning("Nod", {"Head": (0.4, 0.0, 0.2)})
        self.rig.pose.bones["Head"].rotation_quaternion = (0.8, 0.6, 0.0, 0.0)  # which nothing keys
        self.add(bones="Chest", start=5.0, speed=0.5, layer="Plain")
        self.add(action="Jump", bones="Hips", mode='ADDITIVE', reference='REST', with_children=False, layer="Added")
        self.add(action="Above", bones="UpperArm.L", weight=0.4, layer="Half")
        self.add(action="Above", bones="UpperArm.L", mode='ADDITIVE', reference='REST', layer="Turned", after='STOP')
        self.add(action="Nod", bones="Head", mode='ADDITIVE', reference='REST', start=8.0, layer="Late")
        wanted = self.seen_at()
        self.assertEqual(bpy.ops.motus.layers_to_nla(object="Rig"), {'FINISHED'})
        animation = self.rig.animation_data
        self.assertIsNone(animation.action)
        self.assertEqual([track.name for track in animation.nla_tracks], ["Walk", "Plain", "Added", "Half", "Turned", "Late"])
        kinds = [track.strips[0].blend_type for track in animation.nla_tracks]
        self.assertEqual(kinds, ['REPLACE', 'REPLACE', 'COMBINE', 'REPLACE', 'COMBINE', 'REPLACE'])
        for name in ("Half", "Late"):
            self.assertEqual(animation.nla_tracks[name].strips[0].action.name, f"Rig {name}")
        self.assertTrue(all(entry.is_muted for entry in self.rig.motus.layers.entries))
        self.assertSeenAt(wanted)

    def test_what_does_not_become_strips(self):
        entry = self.add(bones="Chest")
        entry.is_solo = True
        self.assertRefused("are played alone", bpy.ops.motus.layers_to_nla, object="Rig")
        entry.is_solo = False
        self.rig.animation_data.use_nla = False
        self.assertRefused("switched off", bpy.ops.motus.layers_to_nla, object="Rig")
        self.rig.animation_data.use_nla = True
        entry.is_muted = True
        self.assertRefused("No layer moves a bone", bpy.ops.motus.layers_to_nla, object="Rig")
        self.assertEqual(self.rig.animation_data.action, self.walk)
        self.assertFalse(self.rig.animation_data.nla_tracks)
