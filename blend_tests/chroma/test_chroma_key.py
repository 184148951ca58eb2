"""Keyed pictures: the footage's alpha is known, and so is the subject without the screen's light."""

import bpy
import numpy as np

import support
from chroma import chroma_cases as cases

MEAN_ERROR, HOLE, SPILL = 0.02, 0.98, 0.03
GREY = 0.3


class Exact(support.SceneTestCase):
    """Pictures of floats: what is rendered is the formula's."""

    def set_up(self, picture, **keywords):
        self.assertEqual(bpy.ops.motus.chroma_key_setup(clip=self.image("Shot", picture), **keywords), {'FINISHED'})
        return support.addon("chroma.compositor").key_of(bpy.context.scene)

    def image(self, name, picture):
        whole = np.ones((*picture.shape[:2], 4), np.float32)
        whole[..., : picture.shape[2]] = picture
        image = bpy.data.images.new(name, picture.shape[1], picture.shape[0], alpha=True, float_buffer=True)
        image.pixels.foreach_set(whole.ravel())
        return image.name

    def colors(self):
        """A screen, below it every mixture of it with colours of all kinds, highlights above 1 among them."""
        random = np.random.default_rng(5)
        picture = np.ones((40, 60, 3)) * cases.GREEN
        colors = random.uniform(0.0, 1.0, (20, 60, 3)) * random.choice((0.3, 1.0, 6.0), (20, 60, 1))
        share = random.uniform(0.0, 1.0, (20, 60, 1))
        picture[:20] = share * colors + (1.0 - share) * cases.GREEN
        return picture

    def test_the_matte_is_the_library_s(self):
        native = support.addon("core.native").module
        picture = self.colors()
        for color, balance, gain in ((cases.GREEN, 0.0, 1.0), (cases.GREEN, 0.5, 1.3), (cases.BLUE, 1.0, 1.0)):
            self.set_up(picture, underneath='NOTHING', color=color, balance=balance, gain=gain, black=0.0, white=1.0)
            whole = np.dstack((picture, np.ones(picture.shape[:2]))).astype(np.float32)
            np.testing.assert_allclose(cases.keyed('MATTE')[..., 0], native.screen_matte(whole, color, balance, gain), atol=1e-5)
            bpy.ops.motus.chroma_key_remove()

    def test_foreground(self):
        """Without despill: the picture less what the matte says is of the screen; what is opaque stays bit for bit."""
        picture = self.colors()
        self.set_up(picture, underneath='NOTHING', color=cases.GREEN, despill=0.0, black=0.0, white=1.0)
        alpha = cases.keyed('MATTE')[..., :1]
        found = cases.keyed('COMPOSITE')[..., :3]
        right = np.maximum(0.0, picture - (1.0 - alpha) * np.array(cases.GREEN)) * (alpha > 0.0)
        np.testing.assert_allclose(found, right, atol=1e-5)
        is_opaque = alpha[..., 0] == 1.0
        self.assertGreater(is_opaque.sum(), 100)
        np.testing.assert_array_equal(found[is_opaque], picture[is_opaque].astype(np.float32))

    def soft(self, colour, screen, width, radius=32.0):
        """(alpha, picture) of a disc out of focus."""
        y, x = np.mgrid[0:96, 0:160]
        alpha = np.clip((radius - np.hypot(x - 80.0, y - 48.0)) / width + 0.5, 0.0, 1.0)[..., None]
        return alpha, alpha * np.array(colour) + (1.0 - alpha) * np.array(screen)

    def test_soft_edges_are_even(self):
        """A grey of any brightness over any background, by one call without a number, whatever levels are set."""
        for value, behind, screen, width in (
            (0.8, 0.8, cases.GREEN, 2),
            (0.8, 0.8, cases.GREEN, 8),
            (0.2, 0.9, cases.BLUE, 8),
            (3.0, 0.5, cases.GREEN, 4),
            (0.0, 1.0, cases.BLUE, 2),
        ):
            with self.subTest(value=value, behind=behind, width=width):
                alpha, picture = self.soft((value,) * 3, screen, width)
                background = self.image("Behind", np.full((96, 160, 3), behind))
                self.set_up(picture, background=background)
                np.testing.assert_allclose(
                    cases.keyed('COMPOSITE')[..., :3], np.repeat(alpha * value + (1.0 - alpha) * behind, 3, 2), atol=0.004
                )
                bpy.ops.motus.chroma_key_remove()

    def test_levels_and_choke_leave_colors_even(self):
        _, picture = self.soft((0.8,) * 3, cases.GREEN, 8)
        for keywords in ({"black": 0.3}, {"grow": -2}, {"feather": 4, "grow": -4}):
            background = self.image("Behind", np.full((96, 160, 3), 0.8))
            self.set_up(picture, background=background, **keywords)
            np.testing.assert_allclose(cases.keyed('COMPOSITE')[..., :3], 0.8, atol=0.004)
            bpy.ops.motus.chroma_key_remove()

    def test_bright_and_yellow_subjects_are_opaque(self):
        picture = np.ones((40, 60, 3)) * cases.GREEN
        for index, color in enumerate(((0.9, 0.8, 0.1), (0.1, 0.8, 0.9), (5.0, 4.9, 4.0), (1.0, 1.0, 1.0))):
            picture[10:30, 6 + 12 * index : 16 + 12 * index] = color
        self.set_up(picture, underneath='NOTHING')
        composite = cases.keyed('COMPOSITE')
        is_subject = np.any(picture != cases.GREEN, axis=2)
        self.assertEqual(composite[is_subject][:, 3].min(), 1.0)
        np.testing.assert_array_equal(composite[is_subject][:, :3], picture[is_subject].astype(np.float32))
        self.assertEqual(composite[~is_subject].max(), 0.0)

    def test_despill(self):
        """The screen's channel is limited by the two others, and the luminance stays."""
        lit = np.array((0.3, 0.5, 0.1))
        picture = np.ones((40, 60, 3)) * cases.GREEN
        picture[10:30, 20:40] = lit
        luminance = np.array((0.2126, 0.7152, 0.0722))
        for limit, most in (('MAXIMUM', 0.3), ('DOUBLE', (2 * 0.3 + 0.1) / 3), ('AVERAGE', 0.2)):
            self.set_up(picture, underneath='NOTHING', black=0.0, white=0.2, despill_limit=limit)
            found = cases.keyed('COMPOSITE')[20, 30, :3]
            grey = (0.5 - most) * luminance[1]
            np.testing.assert_allclose(found, np.array((0.3, most, 0.1)) + grey, atol=1e-5)
            self.assertAlmostEqual(float(found @ luminance), float(lit @ luminance), 5)
            bpy.ops.motus.chroma_key_remove()
        self.set_up(picture, underneath='NOTHING', black=0.0, white=0.2, despill=0.5, luminance=0.0)
        np.testing.assert_allclose(cases.keyed('COMPOSITE')[20, 30, :3], (0.3, 0.4, 0.1), atol=1e-5)

    def test_core_fills_holes_and_leaves_the_edge(self):
        alpha, picture = self.soft((0.5,) * 3, cases.GREEN, 6)
        picture[44:52, 76:84] = (0.2, 0.3, 0.2)
        key = self.set_up(picture, underneath='NOTHING', black=0.0, white=1.0)
        hole = cases.keyed('MATTE')[..., 0]
        self.assertLess(hole[48, 80], 0.8)
        key.inputs["Core Fill"].default_value = 0.6
        filled = cases.keyed('MATTE')[..., 0]
        self.assertEqual(filled[48, 80], 1.0)
        np.testing.assert_allclose(filled[alpha[..., 0] < 0.98], hole[alpha[..., 0] < 0.98], atol=1e-5)
        np.testing.assert_allclose(cases.keyed('COMPOSITE')[48, 80, :3], np.array((0.2, 0.2, 0.2)) + 0.1 * 0.7152, atol=1e-5)

    def test_a_core_mask_keeps_and_a_garbage_mask_takes(self):
        picture = np.ones((60, 60, 3)) * cases.GREEN
        picture[20:40, 20:40] = 0.5
        self.set_up(picture, underneath='NOTHING')
        bpy.ops.motus.chroma_mask_add(
            kind='CORE', picture=self.image("Left", np.repeat(np.arange(60)[None, :, None] < 10, 60, 0) * np.ones(3))
        )
        matte = cases.keyed('MATTE')[..., 0]
        self.assertEqual((matte[:, :10].min(), matte[:20, 10:].max(), matte[20:40, 20:40].min()), (1.0, 0.0, 1.0))
        bpy.ops.motus.chroma_mask_add(kind='GARBAGE')  # around the picture
        matte = cases.keyed('MATTE')[..., 0]
        self.assertEqual((matte[:, :2].max(), matte[30, 5:9].min(), matte[20:40, 20:40].min()), (0.0, 1.0, 1.0))

    def test_two_screens_are_keyed(self):
        """A green screen and a blue floor, each with a soft edge to the subject."""
        alpha, picture = self.soft((0.7,) * 3, cases.GREEN, 6)
        _, below = self.soft((0.7,) * 3, cases.BLUE, 6)
        picture[:40] = below[:40]
        background = self.image("Behind", np.full((96, 160, 3), 0.4))
        self.set_up(picture, background=background)
        self.assertEqual(bpy.ops.motus.chroma_key_add(), {'FINISHED'})
        key = support.addon("chroma.compositor").active_key(bpy.context.scene)
        np.testing.assert_allclose(key.inputs["Screen Color"].default_value[:3], cases.BLUE, atol=1e-5)
        np.testing.assert_allclose(cases.keyed('MATTE')[..., 0], alpha[..., 0], atol=0.004)
        np.testing.assert_allclose(cases.keyed('COMPOSITE')[..., :3], np.repeat(alpha * 0.7 + (1.0 - alpha) * 0.4, 3, 2), atol=0.004)
        np.testing.assert_allclose(cases.keyed('SOURCE')[..., :3], picture, atol=1e-6)

    def test_levels_of_the_balance(self):
        random = np.random.default_rng(3)
        picture = np.ones((90, 160, 3)) * (0.07, 0.42, 0.08)
        picture[..., 0] += random.uniform(-0.06, 0.06, (90, 160))
        picture[25:65, 60:100] = (0.5, 0.33, 0.25)
        outside = np.ones((90, 160), bool)
        outside[20:70, 55:105] = False
        for balance in (0.0, 0.5, 1.0):
            self.set_up(picture, underneath='NOTHING', balance=balance)
            self.assertEqual(bpy.ops.motus.chroma_key_measure(keep_color=True), {'FINISHED'})
            matte = cases.keyed('MATTE')[..., 0]
            self.assertGreater((matte[outside] < 0.002).mean(), 0.98)
            self.assertEqual(matte[30:60, 65:95].min(), 1.0)
            bpy.ops.motus.chroma_key_remove()

    def test_set_scene_leaves_colors_alone(self):
        shown = np.array((224, 172, 140)) / 255.0
        picture = np.ones((36, 64, 3)) * cases.GREEN
        picture[8:28, 22:42] = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
        view = bpy.context.scene.view_settings
        view.exposure, view.gamma, view.use_curve_mapping = 1.0, 1.3, True
        view.curve_mapping.curves[3].points.new(0.5, 0.7)
        view.curve_mapping.update()
        if hasattr(view, "use_white_balance"):
            view.use_white_balance, view.white_balance_temperature = True, 4000
        self.set_up(picture, underneath='NOTHING')
        scene = bpy.context.scene
        scene.render.image_settings.file_format, scene.render.filepath = 'PNG', str(self.folder / "shown.png")
        scene.render.image_settings.color_depth = '8'
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        np.testing.assert_array_equal(np.round(255.0 * cases.values(image)[18, 32, :3]), (224, 172, 140))
        self.assertEqual(support.addon("chroma.scene_settings").changes(scene), [])
        view.exposure = 0.5
        self.assertEqual(len(support.addon("chroma.scene_settings").changes(scene)), 1)

    def test_straight_alpha_of_eight_bits(self):
        picture = np.ones((54, 96, 4)) * (*cases.GREEN, 1.0)
        picture[10:44, 10:40, :3] = 0.4
        picture[10:44, 40:60] = (0.4, 0.4, 0.4, 0.5)
        picture[10:44, 60:70] = (0.9, 0.1, 0.1, 0.0)
        behind = self.image("Behind", np.ones((54, 96, 3)) * (0.7, 0.3, 0.5))
        path = cases.written(picture, self.folder / "own.png")
        self.assertEqual(bpy.ops.motus.chroma_key_setup(clip=path, background=behind), {'FINISHED'})
        found = cases.keyed('COMPOSITE')[..., :3]
        np.testing.assert_allclose(found[27, 50], (0.55, 0.35, 0.45), atol=0.004)
        np.testing.assert_allclose(found[27, 65], (0.7, 0.3, 0.5), atol=0.002)
        np.testing.assert_allclose(found[27, 20], 0.4, atol=0.004)

    def test_a_background_plays_at_its_own_speed(self):
        """A film of another frame rate than the scene's shows what it shows at that second."""
        frames = [np.full((32, 32, 4), (0.0, 0.1 * index, 0.0, 1.0)) for index in range(cases.FRAMES)]
        film = cases.filmed_of(frames, self.folder, 12)
        self.set_up(self.colors()[:32, :32], background=film)
        scene = bpy.context.scene
        node = support.addon("chroma.compositor").node_of(scene, "Background")
        for fps, places in (
            (24, (1, 1, 2, 2, 3, 3, 3)),
            (12, (1, 2, 3, 3, 3, 3, 3)),
            (6, (1, 3, 3, 3, 3, 3, 3)),
            (48, (1, 1, 1, 1, 2, 2, 2)),
        ):
            scene.render.fps, scene.render.fps_base = fps, 1.0
            for frame in (7, 1, 4, 2, 6, 3, 5):
                scene.frame_set(frame)
                self.assertEqual(frame + node.frame_offset, places[frame - 1], (fps, frame))
        scene.render.fps = 24
        for frame, place in ((3, 2), (1, 1), (5, 3)):
            scene.frame_set(frame)
            np.testing.assert_allclose(cases.keyed('COMPOSITE')[30, 5, 1], 0.1 * (place - 1), atol=0.02)


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

    def test_green_screen_is_measured(self):
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

    def test_blue_screen_is_measured(self):
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
        holder, name = settings.place(key, settings.BY_KEYWORD["grow"])
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
        self.assertGreater(without[:, : half - 4].max(), 0.99)
        self.assertLess(matte[:, : half - 4].max(), 0.01)
        np.testing.assert_allclose(matte[:, half + 4 :], without[:, half + 4 :], atol=0.01)
