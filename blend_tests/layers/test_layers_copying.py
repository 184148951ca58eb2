"""To All Selected gives the shown layer's settings to the shown layers of all selected rigs."""

import bpy

from look_at.look_at_cases import build_rig

from .layer_cases import LayerTestCase


class ToAllSelected(LayerTestCase):
    def setUp(self):
        super().setUp()
        self.other = build_rig(name="Other")
        self.play(self.other, self.walk)
        self.first, self.second = self.add(), self.add("Other", layer="Lower")
        self.add("Other", layer="Upper").is_muted = True
        self.other.motus.layers.active_entry = 0
        for rig in (self.rig, self.other):
            rig.select_set(True)
        bpy.context.view_layer.objects.active = self.rig

    def layer(self, rig, index=0):
        return bpy.data.objects[rig].motus.layers.entries[index]

    def test_a_style(self):
        own = self.layer("Rig")
        own.blend_in, own.mode, own.weight = 6.0, 'ADDITIVE', 0.5
        bpy.ops.motus.to_selected(system="layers")
        found = self.layer("Other")
        self.assertEqual((found.blend_in, found.mode, found.weight), (6.0, 'ADDITIVE', 1.0))
        self.assertEqual(self.layer("Other", 1).blend_in, 0.0)
        self.assertEqual(found.action, self.throw)

    def test_what_belongs_to_a_shot_and_keys(self):
        own = self.layer("Rig")
        for frame, weight in ((1, 0.0), (11, 1.0)):
            own.weight = weight
            own.keyframe_insert("weight", frame=frame)
        own.start = 4.0
        bpy.ops.motus.to_selected(system="layers", with_shot=True, with_keys=True)
        self.assertEqual(self.layer("Other").start, 4.0)
        for frame in (3, 6, 14):
            self.go_to(frame)
            self.assertEqual(self.layer("Other").weight, self.layer("Rig").weight)
            for bone in ("Chest", "UpperArm.L"):
                self.assertSameTurn(self.own(bone, self.other), self.own(bone, self.rig), bone)

    def test_in_pose_mode(self):
        self.layer("Rig").blend_out = 8.0
        bpy.ops.object.mode_set(mode='POSE')
        bpy.ops.motus.to_selected(system="layers")
        self.assertEqual(self.layer("Other").blend_out, 8.0)

    def test_nobody_else(self):
        self.other.select_set(False)
        self.assertRefused("Nothing else", bpy.ops.motus.to_selected, system="layers")
