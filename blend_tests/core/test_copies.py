"""What is known of an evaluated copy, for as long as Blender keeps it."""

import bpy
import support

copies = support.addon("core.copies")


class CopiesTest(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.thing = bpy.data.objects.new("Thing", None)
        bpy.context.scene.collection.objects.link(self.thing)
        copies.prepare(self.thing)

    def evaluated(self):
        bpy.context.view_layer.update()
        return self.thing.evaluated_get(bpy.context.evaluated_depsgraph_get())

    def test_kept_until_blender_copies_anew(self):
        known = copies.of(self.evaluated())
        for frame in (1, 20, 3.5):
            bpy.context.scene.frame_set(int(frame), subframe=frame % 1.0)
            self.assertIs(copies.of(self.evaluated()), known)
        self.thing.location.x = 1.0
        self.assertIsNot(copies.of(self.evaluated()), known)

    def test_nothing_is_known_of_originals(self):
        """A number that is written into an original would be that of all its copies."""
        self.assertIsNone(copies.of(self.thing))
        self.assertEqual(self.thing[copies.KEY][0], 0)

    def test_what_a_file_holds(self):
        """Only what prepare() makes is taken for a mark, and no number that was not given."""
        for value in ("text", 3, [1.5, 2.5], {"a": 1}, [7, 7], [-1], None):
            with self.subTest(value):
                if value is None:
                    del self.thing[copies.KEY]
                else:
                    self.thing[copies.KEY] = value
                self.thing.update_tag()
                found = copies.of(self.evaluated())
                self.assertEqual(found is not None, value == [-1])

    def test_animated_settings(self):
        """Also when keys are added to an action that was there."""
        self.thing.keyframe_insert("location", frame=1)
        self.assertFalse(copies.of(self.evaluated()).has_animated_settings)
        for curve in support.addon("core.actions").fcurves(self.thing)[:1]:
            curve.keyframe_points.insert(5, 1.0)
        self.thing.motus.path.keyframe_insert("influence", frame=1)
        self.assertTrue(copies.of(self.evaluated()).has_animated_settings)
