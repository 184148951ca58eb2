"""The demo of the chroma key: a set of its own is keyed over the land, without a hole in the pilot and without green on him."""

import bpy
import numpy as np

import support
from chroma import chroma_cases
from demo import demo_cases

compositor = support.addon("chroma.compositor")
green_screen = support.addon("demo.chroma.green_screen")
SIZE = (160, 90)


class DemoChroma(support.SceneTestCase):
    def test_the_pilot_is_keyed(self):
        self.assertEqual(demo_cases.build('CHROMA'), {'FINISHED'})
        scene = bpy.context.window.scene
        studio = bpy.data.scenes[green_screen.SCENE_NAME]
        np.testing.assert_allclose(self.color(scene), green_screen.GREEN, atol=0.02)
        self.check_measured_again(scene)
        self.assertTrue(bpy.data.images[green_screen.TEST_SHOT].packed_file)
        np.testing.assert_allclose(scene.camera.matrix_world, studio.camera.matrix_world)
        for one in (scene, studio):
            one.render.engine, one.cycles.samples, one.cycles.use_denoising = 'CYCLES', 4, False
        scene.render.resolution_x, scene.render.resolution_y = SIZE
        scene.frame_set(44)
        matte = chroma_cases.keyed('MATTE')[..., 0]
        self.assertLess(abs(matte.mean() - 0.14), 0.04)
        middle = matte[5:40, 38:48]
        self.assertGreater(np.median(middle), 0.99, "the pilot is opaque")
        self.assertLess(matte[:, 100:].max(), 0.02, "nothing is left of the screen")
        composite = chroma_cases.keyed('COMPOSITE')[..., :3]
        excess = composite[..., 1] - composite[..., (0, 2)].max(axis=2)
        self.assertLess(excess.max(), 0.03, "no green is left on the pilot")

    def color(self, scene):
        return compositor.key_of(scene).inputs["Screen Color"].default_value[:3]

    def check_measured_again(self, scene):
        """The same colour and levels, from the picture that is kept in the file."""
        before = self.color(scene)
        self.assertEqual(bpy.ops.motus.chroma_key_measure(), {'FINISHED'})
        np.testing.assert_array_equal(self.color(scene), before)
