"""Combined pictures of pairs: anaglyphs against the published matrices, and floating windows to the column."""

from pathlib import Path

import bpy
import numpy as np

import support
from stereo.stereo_cases import StereoTestCase

RED, GREEN, GREY = (0.8, 0.1, 0.05), (0.1, 0.6, 0.2), (0.5, 0.5, 0.5)


def module():
    return support.addon("stereo.anaglyph")


class Combine(StereoTestCase):
    def setUp(self):
        super().setUp()
        render = bpy.context.scene.render
        render.filepath = str(self.folder / "pair_")
        render.image_settings.file_format = 'PNG'
        self.add()
        bpy.ops.motus.stereo_output(object="Camera", format='PAIR')

    def write_eye(self, eye, frame, rows):
        """Write a picture of one eye of a frame. rows: (height, width, 3) in sRGB."""
        values = np.ones((*np.shape(rows)[:2], 4), np.float32)
        values[..., :3] = rows
        image = bpy.data.images.new("Eye", values.shape[1], values.shape[0])
        image.pixels.foreach_set(values.ravel())
        image.filepath_raw, image.file_format = str(self.folder / f"pair_{frame:04}_{eye}.png"), 'PNG'
        image.save()
        bpy.data.images.remove(image)

    def read(self, frame, kind="anaglyph"):
        image = bpy.data.images.load(str(self.folder / f"pair_{frame:04}_{kind}.png"))
        width, height = image.size
        values = np.array(image.pixels[:]).reshape(height, width, image.channels)[..., :3]
        bpy.data.images.remove(image)
        return values

    def test_white_stays_white_and_black_black(self):
        for glasses in module().MATRICES:
            for value in (0.0, 1.0):
                grey = np.full((1, 3), value)
                np.testing.assert_allclose(module().combined(grey, grey, glasses), value, atol=0.015, err_msg=glasses)

    def test_each_eye_sees_its_own_picture(self):
        """A white left eye beside a black right one is bright in the colours of the left filter alone, and the other way round."""
        white, black = np.ones(3), np.zeros(3)
        for glasses, left, right in (('RED_CYAN', (0,), (1, 2)), ('GREEN_MAGENTA', (1,), (0, 2)), ('YELLOW_BLUE', (0, 1), (2,))):
            for pair, bright, dark in (((white, black), left, right), ((black, white), right, left)):
                found = module().combined(*pair, glasses)
                with self.subTest(glasses, bright=bright):
                    self.assertGreater(found[list(bright)].min(), 0.9)
                    self.assertLess(found[list(dark)].max(), 0.06)

    def test_files_are_what_the_formula_says(self):
        left, right = np.array([[RED, GREEN, GREY]]), np.array([[GREY, RED, GREEN]])
        known = {image.name for image in bpy.data.images}
        for frame in (1, 2):
            self.write_eye("L", frame, left)
            self.write_eye("R", frame, right)
        for glasses, matrices in module().MATRICES.items():
            bpy.ops.motus.stereo_combine(object="Camera", frame_start=1, frame_end=2, glasses=glasses)
            linear = [((one + 0.055) / 1.055) ** 2.4 for one in (left, right)]  # all values are above 0.04045
            wanted = sum(np.einsum("ij,rcj->rci", np.array(matrix), one) for matrix, one in zip(matrices, linear))
            wanted = 1.055 * np.clip(wanted, 0.0, 1.0) ** (1.0 / 2.4) - 0.055
            for frame in (1, 2):
                is_bright = wanted > 0.05  # darker ones lie on the straight part of the curve
                np.testing.assert_allclose(self.read(frame)[is_bright], wanted[is_bright], atol=0.008, err_msg=glasses)
        self.assertEqual({image.name for image in bpy.data.images}, known)

    def test_what_is_missing_or_does_not_fit_is_said(self):
        with self.assertRaisesRegex(RuntimeError, "There is no picture .*pair_0001_L.png"):
            bpy.ops.motus.stereo_combine(object="Camera", frame_start=1, frame_end=1)
        self.write_eye("L", 1, [[RED, GREEN]])
        self.write_eye("R", 1, [[RED]])
        with self.assertRaisesRegex(RuntimeError, "different sizes on frame 1"):
            bpy.ops.motus.stereo_combine(object="Camera", frame_start=1, frame_end=1)
        Path(self.folder / "pair_0001_L.png").write_bytes(b"no picture")
        with self.assertRaisesRegex(RuntimeError, "cannot be read|annot"):
            bpy.ops.motus.stereo_combine(object="Camera", frame_start=1, frame_end=1)
        self.assertFalse(Path(self.folder / "pair_0001_anaglyph.png").exists())

    def test_side_by_side_with_a_keyed_window(self):
        """The left edge of the left eye and the right edge of the right one are black for so much of the width as is keyed."""
        rig = bpy.data.objects["Camera"].motus.stereo
        for frame, left, right in ((1, 20.0, 0.0), (3, 40.0, 10.0)):
            rig.window_left, rig.window_right = left, right
            for name in ("window_left", "window_right"):
                rig.id_data.keyframe_insert(f"motus.stereo.{name}", frame=frame)
        curves = [support.addon("core.blender.actions").find(rig.id_data, f"motus.stereo.window_{side}") for side in ("left", "right")]
        for curve in curves:
            for key in curve.keyframe_points:
                key.interpolation = 'LINEAR'
        white = np.ones((2, 10, 3))
        for frame in (1, 2, 3):
            self.write_eye("L", frame, white)
            self.write_eye("R", frame, white)
        bpy.ops.motus.stereo_combine(object="Camera", format='SIDEBYSIDE', frame_start=1, frame_end=3)
        for frame, left, right in ((1, 2, 0), (2, 3, 0.5), (3, 4, 1)):
            seen = self.read(frame, "sidebyside")
            self.assertEqual(seen.shape, (2, 20, 3))
            np.testing.assert_allclose(seen[0, :10, 0], np.arange(10) >= left, atol=1e-6)
            wanted = np.ones(10)
            wanted[9] = {0: 1.0, 0.5: 1.055 * 0.5 ** (1.0 / 2.4) - 0.055, 1: 0.0}[right]
            np.testing.assert_allclose(seen[1, 10:, 0], wanted, atol=0.004)
