"""What is known of an evaluated copy, for as long as Blender keeps it."""

import weakref

import bpy

import support

copies = support.addon("core.evaluated.copies")


class Held:
    """Something that is kept of a copy."""


class CopiesTest(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.thing = self.prepared("Thing")

    def prepared(self, name):
        thing = bpy.data.objects.new(name, None)
        bpy.context.scene.collection.objects.link(thing)
        copies.prepare(thing)
        return thing

    def evaluated(self, thing=None):
        bpy.context.view_layer.update()
        return (thing or self.thing).evaluated_get(bpy.context.evaluated_depsgraph_get())

    @staticmethod
    def of_all(things):
        bpy.context.view_layer.update()
        depsgraph = bpy.context.evaluated_depsgraph_get()
        return [copies.of(thing.evaluated_get(depsgraph)) for thing in things]

    def held(self, evaluated):
        """A weak reference to what is kept of a copy."""
        held = copies.of(evaluated).found["held"] = Held()
        return weakref.ref(held)

    def test_kept_until_blender_copies_anew(self):
        known = copies.of(self.evaluated())
        for frame in (1, 20, 3.5):
            support.go_to(frame)
            self.assertIs(copies.of(self.evaluated()), known)
        self.thing.location.x = 1.0
        self.assertIsNot(copies.of(self.evaluated()), known)

    def test_of_a_datablock_the_latest_copy_alone(self):
        before = self.held(self.evaluated())
        self.assertIsNotNone(before())
        self.thing.location.x = 1.0
        copies.of(self.evaluated())
        self.assertIsNone(before())

    def test_another_file(self):
        before = self.held(self.evaluated())
        support.empty_scene()
        self.assertIsNone(before())

    def test_however_many_are_there(self):
        things = [self.prepared(f"Thing {index}") for index in range(5000)]
        known = self.of_all(things)
        self.assertTrue(all(one is other for one, other in zip(self.of_all(things), known)))

    def test_those_that_are_gone(self):
        """As those of a render that has ended."""
        bpy.context.view_layer.update()
        scene = bpy.data.scenes.new("Second")
        scene.collection.objects.link(self.thing)
        with bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0]):
            second = bpy.context.evaluated_depsgraph_get()
            second.update()
            gone = self.held(self.thing.evaluated_get(second))
        here = self.held(self.evaluated())
        bpy.data.scenes.remove(scene)
        self.assertIsNotNone(gone())
        self.of_all([self.prepared(f"Thing {index}") for index in range(200)])
        self.assertIsNone(gone())
        self.assertIsNotNone(here())

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
        for curve in support.addon("core.blender.actions").fcurves(self.thing)[:1]:
            curve.keyframe_points.insert(5, 1.0)
        self.thing.motus.path.keyframe_insert("influence", frame=1)
        self.assertTrue(copies.of(self.evaluated()).has_animated_settings)
