"""The demo of snow: built twice, each village has snow of its own; and its flakes are left out of shadow maps."""

import bpy

import support
from demo import demo_cases


class DemoSnow(support.SceneTestCase):
    def test_built_twice(self):
        self.assertEqual(demo_cases.build('SNOW'), {'FINISHED'})
        self.check_snow()
        self.assertEqual(bpy.ops.motus.demo_scene(system='SNOW'), {'FINISHED'})
        self.check_snow()
        ice = bpy.data.materials["Motus Flake"]
        self.assertEqual(getattr(ice, "shadow_method", 'NONE'), 'NONE')

    def check_snow(self):
        """That the scene which is shown has two emitters, and a cover of these."""
        scene = bpy.context.window.scene
        emitters = [obj for obj in scene.objects if obj.motus.snow.is_active]
        (cover,) = (obj for obj in scene.objects if obj.motus.snow_cover.is_active)
        self.assertEqual(len(emitters), 2)
        near = next(one for one in emitters if one.name.startswith("Near"))
        scene.frame_set(1)
        self.assertAlmostEqual(near.motus.snow.rate, 60.0)
        scene.frame_set(193)
        self.assertAlmostEqual(near.motus.snow.rate, 420.0)
        self.assertEqual({entry.object for entry in cover.motus.snow_cover.emitters}, set(emitters))
        (ball,) = (entry.object for entry in cover.motus.snow_cover.movers)
        self.assertIn(ball, list(scene.objects))
        work = support.addon("snow.cover.work")
        self.assertEqual(len(work.asked(cover.name).marks.movers), 1)
