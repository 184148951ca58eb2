"""Rendered pairs: the disparity of known points in the pixels is what the formula says."""

import math

import bpy
import numpy as np
from mathutils import Euler, Vector

import support
from stereo.stereo_cases import LENS, SENSOR, StereoTestCase, camera, native, square

POINTS = ((-0.35, 2.5, 0.2), (0.1, 4.0, -0.3), (0.9, 9.0, 0.5))
"""Right, forward, up of the camera."""
COLORS = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
TOLERANCE = 0.1
"""Pixels."""


class Pictures(StereoTestCase):
    WIDTH, HEIGHT = 320, 240

    def setUp(self):
        super().setUp()
        scene = bpy.context.scene
        scene.render.engine = 'CYCLES'
        scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = 32, False, False
        scene.cycles.max_bounces = 0
        scene.render.resolution_x, scene.render.resolution_y = self.WIDTH, self.HEIGHT
        scene.render.resolution_percentage = 100
        # Of the picture what the squares are in is rendered: the centre of one that is cut off would be elsewhere.
        scene.render.use_border = True
        scene.render.border_min_x, scene.render.border_max_x = 0.12, 0.88
        scene.render.border_min_y, scene.render.border_max_y = 0.22, 0.78
        scene.view_settings.view_transform = 'Raw'
        scene.render.image_settings.file_format, scene.render.image_settings.color_depth = 'PNG', '16'
        if scene.world:
            scene.world = None
        self.camera = camera()

    def squares(self, size=0.035):
        """Squares at the points, as large in the picture as each other."""
        for place, color in zip(POINTS, COLORS):
            square(f"Square {place[1]}", place, size * place[1], color)

    def pair(self):
        """(3, 2, 2): centres of the three squares in the left and the right picture, pixels from the lower left."""
        scene = bpy.context.scene
        bpy.ops.motus.stereo_output(object="Camera", format='PAIR')
        scene.render.filepath = str(self.folder / "pair.png")
        bpy.ops.render.render(write_still=True)
        return np.stack([self.centres(self.folder / f"pair_{eye}.png") for eye in "LR"], axis=1)

    def centres(self, path):
        image = bpy.data.images.load(str(path))
        image.colorspace_settings.name = 'Non-Color'
        width, height = image.size
        pixels = np.empty(height * width * image.channels, np.float32)
        image.pixels.foreach_get(pixels)
        pixels = pixels.reshape(height, width, image.channels)[..., :3].astype(float)
        x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
        found = []
        for channel in range(3):
            weights = pixels[..., channel]
            self.assertGreater(weights.sum(), 10.0)
            found.append([(weights * x).sum() / weights.sum(), (weights * y).sum() / weights.sum()])
        return np.array(found)

    def assert_disparity(self, interocular, distance, sensor=SENSOR, mode="off_axis"):
        """That the pictures show what eyes with these distances, behind so wide a sensor, see of the points."""
        found = self.pair()
        points = np.array([(x, z, y) for x, y, z in POINTS])
        wanted = native().stereo_points(points, interocular, LENS, sensor, distance, mode=mode)
        width = bpy.context.scene.render.resolution_x
        disparity, expected = found[:, 1] - found[:, 0], width * (wanted[:, 1] - wanted[:, 0])
        np.testing.assert_allclose(disparity[:, 0], expected[:, 0], atol=TOLERANCE)
        self.assertGreater(np.abs(expected[:, 0]).max(), 2.0)
        if mode != "toe_in":
            np.testing.assert_allclose(
                disparity[:, 0], width * native().parallax(points[:, 2], interocular, LENS, sensor, distance, mode=mode), atol=TOLERANCE
            )
        return disparity, expected

    def test_pictures_in_each_convergence_mode(self):
        self.squares()
        self.add(interocular=0.2, distance=4.0)
        for name, mode in (("off_axis", 'OFFAXIS'), ("parallel", 'PARALLEL'), ("toe_in", 'TOE')):
            self.camera.data.stereo.convergence_mode = mode
            with self.subTest(mode):
                disparity, expected = self.assert_disparity(0.2, 4.0, mode=name)
                np.testing.assert_allclose(disparity[:, 1], expected[:, 1], atol=TOLERANCE)

    def test_a_budget_is_taken(self):
        self.squares()
        self.add(convergence='BUDGET', near=2.5, far=9.0, near_parallax=2.0, far_parallax=3.0)
        disparity = np.diff(self.pair(), axis=1)[:, 0, 0]
        np.testing.assert_allclose(disparity[[0, 2]], (-0.02 * self.WIDTH, 0.03 * self.WIDTH), atol=TOLERANCE)

    def test_sensor_fits_and_pixel_aspect(self):
        self.squares()
        data, render = self.camera.data, bpy.context.scene.render
        data.sensor_height = 20.0
        self.add(interocular=0.2, distance=4.0)
        for fit, size, pixel_aspect, sensor in (
            ('VERTICAL', (320, 240), (1.0, 1.0), 20.0 * 320 / 240),
            ('AUTO', (240, 320), (1.0, 1.0), SENSOR * 240 / 320),
            ('HORIZONTAL', (240, 320), (1.0, 1.0), SENSOR),
            ('AUTO', (320, 240), (2.0, 1.0), SENSOR),
            ('AUTO', (320, 240), (1.0, 2.0), SENSOR * 320 / 480),
            ('VERTICAL', (320, 240), (1.0, 1.5), 20.0 * 320 / 360),
        ):
            data.sensor_fit = fit
            render.resolution_x, render.resolution_y = size
            render.pixel_aspect_x, render.pixel_aspect_y = pixel_aspect
            bpy.context.view_layer.update()
            with self.subTest(fit, size=size, pixel_aspect=pixel_aspect):
                self.assert_disparity(0.2, 4.0, sensor)

    def test_a_shift_in_use_and_a_scaled_parent(self):
        self.squares()
        parent = bpy.data.objects.new("Parent", None)
        parent.scale = (2.0, 2.0, 2.0)
        bpy.context.scene.collection.objects.link(parent)
        self.camera.parent = parent
        self.camera.data.shift_x = 0.1
        self.add(interocular=0.2, distance=4.0)
        self.assert_disparity(0.2, 4.0)

    def test_an_animated_focus(self):
        self.squares()
        self.add(focus="Square 4.0", interocular=0.2)
        self.assert_disparity(0.2, 4.0)

    def test_panoramas(self):
        """In pictures of 360 and of 180 degrees, parallel or not, parallax is the angle of the formula, also where the eyes approach at the poles."""
        degree = math.pi / 180.0
        places = ((1.5, -40.0, 0.0), (4.0, 10.0, 30.0), (3.0, 50.0, 67.0))  # distance, azimuth, elevation
        for (distance, azimuth, elevation), color in zip(places, COLORS):
            turned = Euler((elevation * degree, 0.0, -azimuth * degree)).to_matrix()
            # Near the pole parallax changes much within a square: a small one has its centre's.
            size = distance * (0.05 if elevation < 60.0 else 0.025)
            obj = square(f"Square {distance}", turned @ Vector((0.0, distance, 0.0)), size, color)
            obj.rotation_euler = turned.to_euler()
        self.add(interocular=0.3, distance=2.5)
        render, stereo = bpy.context.scene.render, self.camera.data.stereo
        render.border_min_y, render.border_max_y = 0.45, 0.93
        for half, width, left, right in ((False, 720, 0.33, 0.7), (True, 360, 0.16, 0.9)):
            render.resolution_x, render.border_min_x, render.border_max_x = width, left, right
            bpy.ops.motus.stereo_output(object="Camera", format='PAIR', use_360=True, use_180=half)
            self.assertEqual(render.resolution_y, 360)
            for mode, convergence in (('OFFAXIS', 2.5), ('PARALLEL', math.inf)):
                stereo.convergence_mode = mode
                with self.subTest(width=width, mode=mode):
                    found = self.pair()
                    disparity, rows = found[:, 1] - found[:, 0], (found[:, 0, 1] / 360.0 - 0.5) * math.pi
                    np.testing.assert_allclose(rows, [elevation * degree for *_, elevation in places], atol=0.003)
                    ends = {"merge_from": stereo.pole_merge_angle_from, "merge_to": stereo.pole_merge_angle_to}
                    wanted = [
                        native().parallax_around(distance, 0.3, convergence, row, **ends) for (distance, *_), row in zip(places, rows)
                    ]
                    np.testing.assert_allclose(disparity[:, 0], np.array(wanted) * 720.0 / (2.0 * math.pi), atol=TOLERANCE)
                    np.testing.assert_allclose(disparity[:, 1], 0.0, atol=TOLERANCE)
                    self.assertGreater(np.abs(disparity[:, 0]).max(), 5.0)

    @support.needs_drawing
    def test_pictures_of_other_engines(self):
        self.squares()
        self.add(interocular=0.2, distance=4.0)
        scene = bpy.context.scene
        engines = {item.identifier for item in scene.render.bl_rna.properties["engine"].enum_items}
        for engine in sorted(engines & {'BLENDER_EEVEE', 'BLENDER_EEVEE_NEXT'}):
            support.use_eevee(scene, engine, samples=16)
            with self.subTest(engine):
                self.assert_disparity(0.2, 4.0)
