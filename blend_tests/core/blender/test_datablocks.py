import bpy

import support


class Labels(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.obj = bpy.data.objects.new("Cube", bpy.data.meshes.new("Cube"))
        bpy.context.scene.collection.objects.link(self.obj)
        self.label_of = support.addon("core.blender.datablocks").label_of

    def test_channels(self):
        self.assertEqual(self.label_of(self.obj, "location", 2), "Location Z")
        self.assertEqual(self.label_of(self.obj, "rotation_euler", 2), "Rotation Z")
        self.assertEqual(self.label_of(self.obj, "rotation_quaternion", 0), "Quaternion Rotation W")
        self.assertTrue(self.label_of(self.obj, "color", 3).endswith("Color A"))

    def test_within_another_thing(self):
        modifier = self.obj.modifiers.new("Twist", 'SIMPLE_DEFORM')
        self.assertEqual(self.label_of(self.obj, modifier.path_from_id("factor")), "Twist: Factor")

    def test_custom_properties(self):
        self.obj["a.b"] = 1.0
        self.assertEqual(self.label_of(self.obj, '["a.b"]'), "a.b")
        self.assertEqual(self.label_of(self.obj, 'pose.bones["Arm"]["twist"]', 1), "twist 1")

    def test_what_has_no_name(self):
        self.assertEqual(self.label_of(self.obj, 'modifiers["Gone"].factor'), 'modifiers["Gone"].factor')
        self.assertEqual(self.label_of(self.obj, "nothing", 1), "nothing[1]")
