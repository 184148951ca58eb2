"""Every demo scene that is listed can be built, and has what `./motus demo` takes of it."""

import unittest

import bpy
import support


class DemoScenes(unittest.TestCase):
    @classmethod
    def tearDownClass(cls):
        support.empty_scene()

    def test_the_operator_offers_those_that_are_listed(self):
        offered = bpy.ops.motus.demo_scene.get_rna_type().properties["system"].enum_items
        listed = support.addon("demo.scenes").SCENES
        self.assertEqual([(item.identifier, item.name, item.description) for item in offered],
                         [(demo.identifier, demo.label, demo.description) for demo in listed])

    def test_cameras_and_times_are_those_of_the_scene(self):
        for demo in support.addon("demo.scenes").SCENES:
            with self.subTest(scene=demo.name):
                support.empty_scene()
                self.assertEqual(bpy.ops.motus.demo_scene(system=demo.identifier), {'FINISHED'})
                scene = bpy.context.window.scene
                seconds = (scene.frame_end - scene.frame_start + 1) * scene.render.fps_base / scene.render.fps
                for camera, moment in demo.stills:
                    self.assertEqual(scene.objects[camera].type, 'CAMERA')
                    self.assertTrue(0.0 <= moment <= seconds, moment)
                start, end = demo.film
                self.assertTrue(0.0 <= start < end <= seconds, demo.film)
