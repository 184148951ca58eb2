"""Time Stretching: every system shows at a frame of the time line what it shows unstretched at that keys' time, and is baked so."""

import math

import bpy

import live_scenes
import support


class SceneTimeTest(support.SceneTestCase):
    def test_every_system_in_stretched_time(self):
        live_scenes.opened()
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = 1, 100
        plain = live_scenes.states()
        scene.render.frame_map_old, scene.render.frame_map_new = 100, 200
        scene.frame_start, scene.frame_end = 2, 200
        stretched = live_scenes.states([2 * frame for frame in live_scenes.FRAMES])
        for frame, before in plain.items():
            after = stretched[2 * frame]
            self.assertEqual(set(before), set(after))
            for key, numbers in before.items():
                self.assertEqual(len(numbers), len(after[key]), key)
                self.assertLess(live_scenes.np.abs(numbers - after[key]).max(initial=0.0), 1e-4, (frame, key))

    def test_what_is_new_begins_with_the_scene(self):
        """In a scene that begins at frame 1001, also with Time Stretching, unless a start is given."""
        scene = bpy.context.scene
        for first, new, wanted in ((1, 100, 1.0), (1, 200, 1.0), (1001, 100, 1001.0), (1001, 200, 500.5)):
            support.empty_scene()
            scene = bpy.context.scene
            scene.frame_start, scene.frame_end = first, first + 100
            scene.render.frame_map_old, scene.render.frame_map_new = 100, new
            course = bpy.data.curves.new("Course", 'CURVE')
            course.splines.new('POLY').points.add(1)
            course.splines[0].points[1].co.x = 10.0
            for name, data in (("Course", course), ("Car", None), ("Given", None)):
                scene.collection.objects.link(bpy.data.objects.new(name, data))
            bpy.ops.motus.path_follow_add(object="Car", curve="Course")
            bpy.ops.motus.path_follow_add(object="Given", curve="Course", start_frame=7.0)
            bpy.ops.motus.pendulum_add(kind='SINGLE')
            starts = [obj.motus.path.start_frame for obj in (bpy.data.objects["Car"], bpy.data.objects["Given"])]
            with self.subTest(first=first, new=new):
                self.assertEqual([*starts, bpy.context.object.motus.pendulum.start_frame], [wanted, 7.0, wanted])

    def test_baked_keys_stand_in_the_keys_time(self):
        scene = bpy.context.scene
        scene.render.frame_map_old, scene.render.frame_map_new = 100, 200
        bpy.ops.motus.pendulum_add(kind='SINGLE', length1=1.0, angle1=1.0, start_frame=1)
        pivot = bpy.context.object
        bob = pivot.motus.pendulum.rods[0].bob
        live = [self._angle(bob, frame) for frame in (10, 40, 90)]
        bpy.ops.motus.bake(object=pivot.name, frame_start=1, frame_end=96)
        for frame, angle in zip((10, 40, 90), live):
            self.assertAlmostEqual(self._angle(bob, frame), angle, delta=1e-4)

    def _angle(self, bob, frame):
        bpy.context.scene.frame_set(frame)
        place = bob.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation
        return math.atan2(place.x, -place.z)
