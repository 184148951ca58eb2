"""Keyed pictures: the footage's alpha is known, and so is the subject without the screen's light."""

import bpy
from chroma import chroma_cases as cases
import numpy as np
import support

MEAN_ERROR, HOLE, SPILL = 0.02, 0.98, 0.03
GREY = 0.3


class Keyed(support.SceneTestCase):
    """By one operator call without any number, at the render's size."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.subject = cases.subject()

    def key(self, path, **keywords):
        self.assertEqual(bpy.ops.motus.chroma_key_setup(clip=path, underneath='NOTHING', **keywords), {'FINISHED'})

    def check(self):
        alpha = self.subject[..., 3]
        matte = cases.keyed('MATTE')[..., 0]
        self.assertLess(np.abs(matte - alpha).mean(), MEAN_ERROR)
        self.assertGreater(matte[cases.eroded(alpha, 2)].min(), HOLE)
        self.assertLess(matte[alpha < 0.001].mean(), 0.005)
        composite = cases.keyed('COMPOSITE')
        np.testing.assert_allclose(composite[..., 3], matte, atol=1e-4)
        grey = cases.over(composite, np.full(3, GREY))
        edge = (alpha > 0.02) & (alpha < 0.98)
        excess = np.maximum(0.0, grey[..., 1:3] - np.maximum(grey[..., :1], grey[..., 2:0:-1]))
        self.assertLess(excess[edge].max(), SPILL)

    def test_green(self):
        picture = cases.over(self.subject, cases.screen(cases.GREEN))
        self.key(cases.written(picture, self.folder / "green.png"))
        scene = bpy.context.scene
        self.assertEqual((scene.render.resolution_x, scene.render.resolution_y), (cases.WIDTH, cases.HEIGHT))
        self.check()
        status = cases.keyed('STATUS')[..., 0]
        alpha = self.subject[..., 3]
        self.assertGreater((status[alpha < 0.001] == 0.0).mean(), 0.98)
        self.assertGreater((status[cases.eroded(alpha, 2)] == 1.0).mean(), 0.98)
        self.assertEqual(set(np.unique(status)) - {0.0, 0.5, 1.0}, set())
        np.testing.assert_allclose(cases.keyed('SOURCE')[..., :3], picture[..., :3], atol=0.006)

    def test_blue(self):
        picture = cases.over(self.subject, cases.screen(cases.BLUE))
        self.key(cases.written(picture, self.folder / "blue.png"))
        self.check()

    def test_compressed_picture(self):
        picture = cases.over(self.subject, cases.screen(cases.GREEN))
        self.key(cases.written(picture, self.folder / "green.jpg", 'JPEG'))
        self.check()

    def test_compressed_film(self):
        path = cases.filmed(cases.over(self.subject, cases.screen(cases.GREEN)), self.folder)
        self.key(path)
        scene = bpy.context.scene
        self.assertEqual((scene.frame_start, scene.frame_end), (1, cases.FRAMES))
        scene.frame_set(2)
        self.check()

    def test_alpha_that_is_there_stays(self):
        picture = cases.over(self.subject, cases.screen(cases.GREEN, noise=0.0, dark=0.0))
        picture[:, :40, 3] = 0.0
        self.key(cases.written(picture, self.folder / "holed.png"))
        composite = cases.keyed('COMPOSITE')
        self.assertEqual(composite[:, :38, 3].max(), 0.0)
        alpha = self.subject[..., 3]
        self.assertLess(np.abs(composite[:, 42:, 3] - alpha[:, 42:]).mean(), MEAN_ERROR)

    def test_over_a_background(self):
        footage = cases.written(cases.over(self.subject, cases.screen(cases.GREEN)), self.folder / "green.png")
        # Of another size and shape: it fills the picture.
        behind = cases.written(np.ones((50, 100, 4)) * (0.2, 0.1, 0.4, 1.0), self.folder / "behind.png")
        self.key_over(footage, behind)
        alpha = self.subject[..., 3]
        clear = cases.keyed('COMPOSITE')[alpha < 0.001]
        self.assertLess(np.abs(clear - (0.2, 0.1, 0.4, 1.0)).mean(), 0.01)

    def key_over(self, footage, behind):
        self.assertEqual(bpy.ops.motus.chroma_key_setup(clip=footage, background=behind), {'FINISHED'})

    def test_light_wrap_and_mask(self):
        footage = cases.written(cases.over(self.subject, cases.screen(cases.GREEN)), self.folder / "green.png")
        behind = cases.written(np.ones((64, 96, 4)), self.folder / "behind.png")
        self.key_over(footage, behind)
        plain = cases.keyed('COMPOSITE')
        key = support.addon("chroma.compositor").key_of(bpy.context.scene)
        key.inputs["Light Wrap"].default_value = 1.0
        wrapped = cases.keyed('COMPOSITE')
        alpha = self.subject[..., 3]
        edge = cases.eroded(alpha, 1) & ~cases.eroded(alpha, 3)
        self.assertGreater((wrapped - plain)[edge][:, :3].mean(), 0.1)
        self.assertLess(np.abs(wrapped - plain)[cases.eroded(alpha, 24)].mean(), 0.01)
        for link in list(key.inputs["Garbage Mask"].links):
            key.id_data.links.remove(link)
        key.inputs["Garbage Mask"].default_value = 1.0
        self.assertEqual(cases.keyed('MATTE')[..., 0].max(), 0.0)

    def test_settings_drive_the_picture_and_are_keyed(self):
        path = cases.written(cases.over(self.subject, cases.screen(cases.GREEN)), self.folder / "green.png")
        self.key(path, grow=0)
        scene = bpy.context.scene
        settings = support.addon("chroma.settings")
        key = support.addon("chroma.compositor").key_of(scene)
        grow = next(one for one in settings.OF_KEYING if one.keyword == "grow")
        holder, name = settings.place(key, grow)
        covered = {}
        for frame, pixels in ((1, 0), (2, -3), (3, 3)):
            setattr(holder, name, pixels)
            self.assertTrue(holder.keyframe_insert(name, frame=frame))
        for frame in (1, 2, 3):
            scene.frame_set(frame)
            covered[frame] = cases.keyed('MATTE')[..., 0].mean()
        self.assertGreater(covered[1] - covered[2], 0.02)
        self.assertGreater(covered[3] - covered[1], 0.02)

    def test_a_picked_color_takes_effect(self):
        self.key(cases.written(cases.over(self.subject, cases.screen(cases.GREEN)), self.folder / "green.png"))
        before = cases.keyed('MATTE')[..., 0]
        key = support.addon("chroma.compositor").key_of(bpy.context.scene)
        key.inputs["Screen Color"].default_value = (*cases.BLUE, 1.0)
        after = cases.keyed('MATTE')[..., 0]
        screen = self.subject[..., 3] < 0.001
        self.assertLess(before[screen].mean(), 0.005)
        self.assertGreater(after[screen].mean(), 0.9)

    def test_mask_keyword(self):
        """A mask over the left half clears it, and nothing of the right half."""
        mask = bpy.data.masks.new("Left")
        spline = mask.layers.new().splines.new()
        corners = ((-0.2, -0.2), (0.5, -0.2), (0.5, 1.2), (-0.2, 1.2))
        spline.points.add(len(corners) - len(spline.points))
        for point, corner in zip(spline.points, corners):
            point.co, point.handle_type = corner, 'VECTOR'
        spline.use_cyclic = True
        path = cases.written(cases.over(self.subject, cases.screen(cases.GREEN)), self.folder / "green.png")
        self.key(path)
        without = cases.keyed('MATTE')[..., 0]
        self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})
        self.key(path, mask="Left")
        matte = cases.keyed('MATTE')[..., 0]
        half = cases.WIDTH // 2
        self.assertGreater(without[:, :half - 4].max(), 0.99)
        self.assertLess(matte[:, :half - 4].max(), 0.01)
        np.testing.assert_allclose(matte[:, half + 4:], without[:, half + 4:], atol=0.01)
