"""Stereo rigs: what they set, live; what is restored; and what is refused."""

import math

import bpy
import numpy as np

import support
from stereo.stereo_cases import LENS, SENSOR, StereoTestCase, camera, eyes, native, square
from support import go_to

STEREO = "convergence_mode", "pivot", "interocular_distance", "convergence_distance", "use_spherical_stereo", "use_pole_merge"


def state(obj):
    """What a rig may touch of a camera and its scene."""
    render = bpy.context.scene.render
    return (
        [getattr(obj.data.stereo, name) for name in STEREO],
        obj.data.type,
        obj.data.lens,
        render.use_multiview,
        sorted(obj.data.keys()),
        sorted(key for key in obj.keys() if key != "motus"),
        bool(obj.data.animation_data and obj.data.animation_data.drivers),
    )


class Eyes(StereoTestCase):
    def test_distances(self):
        obj = self.add(interocular=0.1, distance=3.0)
        self.assert_eyes(obj, 0.1, 3.0)
        settings = obj.motus.stereo
        settings.interocular, settings.distance = 0.2, 5.0
        bpy.context.view_layer.update()
        self.assert_eyes(obj, 0.2, 5.0)

    def test_the_known_budget(self):
        obj = self.add(convergence='BUDGET', near=2.0, far=10.0, near_parallax=1.0, far_parallax=2.0)
        self.assert_eyes(obj, 0.0771428571, 2.7272727273)
        obj.data.lens = 70.0
        bpy.context.view_layer.update()
        self.assert_eyes(obj, 0.0771428571 / 2.0, 2.7272727273)
        obj.motus.stereo.far = 20.0
        bpy.context.view_layer.update()
        self.assert_eyes(obj, *native().solve_depth_budget(2.0, 20.0, 0.01, 0.02, 70.0, SENSOR))

    def test_keys_count_on_the_frame(self):
        obj = self.add(convergence='BUDGET')
        for frame, far, lens in ((1, 10.0, LENS), (21, 40.0, 70.0)):
            obj.motus.stereo.far, obj.data.lens = far, lens
            obj.keyframe_insert("motus.stereo.far", frame=frame)
            obj.data.keyframe_insert("lens", frame=frame)
        for frame in (21, 1, 11, 5.5):
            go_to(frame)
            evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
            wanted = native().solve_depth_budget(2.0, evaluated.motus.stereo.far, 0.01, 0.02, evaluated.data.lens, SENSOR)
            np.testing.assert_allclose(eyes(obj), wanted, rtol=1e-5)

    def test_an_object_is_followed_along_the_axis(self):
        target = square("Target", (1.0, 4.0, 0.5))
        obj = self.add(focus="Target", interocular=0.05)
        self.assert_eyes(obj, 0.05, 4.0)
        target.location.y = 7.0
        target.keyframe_insert("location", frame=1)
        target.location.y = 9.0
        target.keyframe_insert("location", frame=11)
        for frame, depth in ((11, 9.0), (1, 7.0)):
            go_to(frame)
            self.assert_eyes(obj, 0.05, depth)
        obj.location.y = -1.0
        bpy.context.view_layer.update()
        self.assert_eyes(obj, 0.05, 8.0)

    def test_influence(self):
        obj = camera()
        obj.data.stereo.interocular_distance, obj.data.stereo.convergence_distance = 0.2, 4.0
        self.add(interocular=0.1, distance=2.0)
        obj.motus.stereo.influence = 0.5
        bpy.context.view_layer.update()
        self.assert_eyes(obj, 0.15, 3.0)

    def test_defaults_are_metres(self):
        bpy.context.scene.unit_settings.scale_length = 0.01
        obj = self.add()
        self.assert_eyes(obj, 6.5, 200.0)

    def test_what_is_wrong_is_said_and_leaves_the_camera_alone(self):
        obj = camera()
        before = eyes(obj)
        wiring, rig = support.addon("core.wiring"), support.addon("stereo.rig")
        square("Target", (0.0, -1.0, 0.0))
        self.add(interocular=0.3, distance=3.0)
        settings = obj.motus.stereo
        for changes, word in (
            ({"convergence": 'OBJECT'}, "Choose"),
            ({"focus": bpy.data.objects["Target"]}, "behind"),
            ({"convergence": 'BUDGET', "near": 3.0, "far": 2.0}, "far greater"),
            ({"far": 5.0, "near_parallax": 0.0, "far_parallax": 0.0}, "both 0"),
            ({"convergence": 'DISTANCE', "distance": 0.0}, "behind"),
        ):
            for name, value in changes.items():
                setattr(settings, name, value)
            bpy.context.view_layer.update()
            problem = wiring.problem(rig.system(), obj, bpy.context.view_layer.depsgraph)
            with self.subTest(word):
                self.assertIn(word, problem.sentence)
                np.testing.assert_allclose(eyes(obj), before, rtol=1e-6)
        settings.distance = 2.0
        for kind in ('ORTHO', 'PANO'):
            obj.data.type = kind
            bpy.context.view_layer.update()
            problem = wiring.problem(rig.system(), obj, bpy.context.view_layer.depsgraph)
            self.assertIn("perspective", problem.sentence)
            np.testing.assert_allclose(eyes(obj), before, rtol=1e-6)

    def test_baked_and_back(self):
        obj = self.add(convergence='BUDGET')
        for frame, far in ((1, 10.0), (11, 40.0)):
            obj.motus.stereo.far = far
            obj.keyframe_insert("motus.stereo.far", frame=frame)

        def seen():
            found = []
            for frame in (1, 4, 7, 11):
                go_to(frame)
                found.append(eyes(obj))
            return found

        live = seen()
        bpy.ops.motus.bake(object="Camera", frame_start=1, frame_end=11)
        np.testing.assert_allclose(seen(), live, rtol=1e-5)
        bpy.ops.motus.unbake(object="Camera")
        np.testing.assert_allclose(seen(), live, rtol=1e-6)

    def test_rigs_in_saved_files(self):
        self.add(convergence='BUDGET')
        wanted = eyes(bpy.data.objects["Camera"])
        path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        bpy.context.view_layer.update()
        np.testing.assert_allclose(eyes(bpy.data.objects["Camera"]), wanted, rtol=1e-6)
        linked = self.load(path, True, "Camera")
        bpy.context.view_layer.update()
        np.testing.assert_allclose(eyes(linked), wanted, rtol=1e-6)

    def test_appended(self):
        self.add(convergence='BUDGET')
        wanted = eyes(bpy.data.objects["Camera"])
        appended = self.load(self.save(), False, "Camera")
        bpy.context.view_layer.update()
        np.testing.assert_allclose(eyes(appended), wanted, rtol=1e-6)
        appended.motus.stereo.near_parallax = 0.0
        bpy.context.view_layer.update()
        self.assertGreater(abs(eyes(appended)[0] - wanted[0]), 0.01)
        bpy.ops.motus.stereo_rig_remove(object=appended.name)
        self.assertFalse(appended.data.animation_data and appended.data.animation_data.drivers)

    def test_a_copy_has_a_rig_of_its_own(self):
        obj = self.add(interocular=0.1, distance=3.0)
        twin = obj.copy()
        twin.data = obj.data.copy()
        bpy.context.scene.collection.objects.link(twin)
        for _ in range(2):  # a copy is given a solver of its own by the first evaluation
            bpy.context.view_layer.update()
        twin.motus.stereo.interocular, twin.motus.stereo.distance = 0.2, 5.0
        bpy.context.view_layer.update()
        self.assert_eyes(twin, 0.2, 5.0)
        self.assert_eyes(obj, 0.1, 3.0)
        bpy.ops.motus.stereo_rig_remove(object=twin.name)
        obj.motus.stereo.distance = 4.0
        bpy.context.view_layer.update()
        self.assert_eyes(obj, 0.1, 4.0)

    def test_an_override_takes_settings_of_its_own(self):
        obj = self.add(interocular=0.1, distance=3.0)
        scene = bpy.context.scene
        collection = bpy.data.collections.new("Cameras")
        scene.collection.children.link(collection)
        collection.objects.link(obj)
        library, user = self.save("library.blend"), str(self.folder / "user.blend")
        support.empty_scene()
        with bpy.data.libraries.load(library, link=True) as (_, wanted):
            wanted.collections = ["Cameras"]
        scene = bpy.context.scene
        scene.collection.children.link(wanted.collections[0])
        wanted.collections[0].override_hierarchy_create(scene, bpy.context.view_layer)
        bpy.context.view_layer.update()

        def local():
            return next(one for one in bpy.data.objects if one.type == 'CAMERA' and not one.library)

        self.assert_eyes(local(), 0.1, 3.0)
        local().motus.stereo.distance = 6.0
        bpy.context.view_layer.update()
        self.assert_eyes(local(), 0.1, 6.0)
        for _ in range(2):
            bpy.ops.wm.save_as_mainfile(filepath=user)
            bpy.ops.wm.open_mainfile(filepath=user)
            bpy.context.view_layer.update()
            self.assert_eyes(local(), 0.1, 6.0)

    def test_a_budget_that_fits_the_screen(self):
        """Comfortable, and the eyes no further apart than what is round."""
        fit = support.addon("stereo.budget").parallaxes
        seen = support.addon("stereo.lens").Lens(LENS, SENSOR, 16.0 / 9.0, 1.0)
        screens = support.addon("stereo.screens").SIZES
        for name, (width, away) in screens.items():
            screen = {"width": width, "viewing_distance": away, "eye_separation": 0.065}
            comfortable = native().comfortable_parallax(**screen)
            for near, far in ((2.0, 40.0), (9.7, 12.0), (5.0, 5.005)):
                found = [0.01 * one for one in fit(near, far, seen, screen)]
                interaxial, distance = native().solve_depth_budget(near, far, *found, LENS, SENSOR)
                roundness = native().roundness(
                    distance, interaxial=interaxial, focal_length=LENS, sensor_width=SENSOR, convergence=distance, **screen
                )
                with self.subTest(name, near=near, far=far):
                    self.assertTrue(all(mine <= limit for mine, limit in zip(found, comfortable)), (found, comfortable))
                    # Two decimals of a percent are the least that the settings show.
                    self.assertTrue(roundness <= 1.001 or min(found) < 1.5e-4, (roundness, found))

    def test_fit_to_screen(self):
        square("Near", (0.0, 4.0, 0.0), 1.0)
        square("Wall", (0.0, 20.0, 0.0), 60.0)
        obj = self.add(convergence='BUDGET', near=4.0, far=20.0, near_parallax=3.0, far_parallax=3.0, screen='CINEMA')
        self.assertEqual(bpy.ops.motus.stereo_fit(object=obj.name), {'FINISHED'})
        self.assertLess(obj.motus.stereo.far_parallax, 0.55)
        self.assertGreater(obj.motus.stereo.far_parallax, 0.01)
        obj.motus.stereo.near_parallax = obj.motus.stereo.far_parallax = 0.0
        self.assertEqual(bpy.ops.motus.stereo_fit(object=obj.name), {'FINISHED'})
        self.assertGreater(obj.motus.stereo.far_parallax, 0.01)
        obj.motus.stereo.eye_separation = float("nan")
        with self.assertRaisesRegex(RuntimeError, "eye_separation is not a finite number"):
            bpy.ops.motus.stereo_fit(object=obj.name)

    def test_presets(self):
        obj = self.add(screen='CINEMA', interocular=0.08)
        again = self.keep_preset("stereo")
        obj.motus.stereo.screen, obj.motus.stereo.interocular = 'PHONE', 0.01
        again()
        self.assertEqual(obj.motus.stereo.screen, 'CINEMA')
        self.assertAlmostEqual(obj.motus.stereo.interocular, 0.08)


class Removal(StereoTestCase):
    def test_removing_restores_everything(self):
        obj = camera()
        stereo = obj.data.stereo
        stereo.convergence_mode, stereo.pivot = 'TOE', 'LEFT'
        stereo.interocular_distance, stereo.convergence_distance = 0.123, 4.5
        before = state(obj)
        self.add(mode='PARALLEL', interocular=0.3)
        obj.keyframe_insert("motus.stereo.interocular", frame=1)
        self.assertTrue(bpy.context.scene.render.use_multiview)
        self.assertEqual(bpy.ops.motus.stereo_rig_remove(object=obj.name), {'FINISHED'})
        bpy.context.view_layer.update()
        self.assertEqual(state(obj), before)
        self.assertFalse(obj.motus.stereo.is_active)
        self.assertEqual([one.name for one in bpy.data.objects], ["Camera"])

    def test_a_scene_that_was_multiview_stays_so(self):
        render, rig = bpy.context.scene.render, support.addon("stereo.rig")
        render.use_multiview, render.views_format = True, 'MULTIVIEW'
        self.add()
        self.assertFalse(rig.renders_both_eyes(bpy.context.scene))
        self.assertEqual(render.views_format, 'MULTIVIEW')
        bpy.ops.motus.stereo_rig_remove(object="Camera")
        self.assertEqual((render.use_multiview, render.views_format), (True, 'MULTIVIEW'))
        self.add()
        bpy.ops.motus.stereo_output(object="Camera")
        self.assertTrue(rig.renders_both_eyes(bpy.context.scene))
        render.views["right"].use = False
        self.assertFalse(rig.renders_both_eyes(bpy.context.scene))
        bpy.ops.motus.stereo_output(object="Camera")
        self.assertTrue(rig.renders_both_eyes(bpy.context.scene))

    def test_the_format_of_views_comes_back(self):
        render = bpy.context.scene.render
        render.views_format = 'MULTIVIEW'
        self.add()
        self.assertEqual((render.use_multiview, render.views_format), (True, 'STEREO_3D'))
        bpy.ops.motus.stereo_rig_remove(object="Camera")
        self.assertEqual((render.use_multiview, render.views_format), (False, 'MULTIVIEW'))

    def test_the_last_of_two_rigs_gives_multiview_back(self):
        self.add()
        camera("Other")
        self.add(object="Other")
        bpy.ops.motus.stereo_rig_remove(object="Camera")
        self.assertTrue(bpy.context.scene.render.use_multiview)
        bpy.ops.motus.stereo_rig_remove(object="Other")
        self.assertFalse(bpy.context.scene.render.use_multiview)

    def test_the_scene_that_the_rig_set_is_given_back(self):
        scene = bpy.context.scene
        self.add()
        other = bpy.data.scenes.new("Other")
        other.render.use_multiview = True
        other.collection.objects.link(bpy.data.objects["Camera"])
        bpy.context.window.scene = other
        bpy.ops.motus.stereo_rig_remove(object="Camera")
        self.assertTrue(other.render.use_multiview)
        self.assertFalse(scene.render.use_multiview)
        bpy.context.window.scene = scene
        bpy.data.scenes.remove(other)


class Refusals(StereoTestCase):
    def refused(self, word, operator="stereo_rig_add", **keywords):
        with self.subTest(word, operator=operator, **keywords), self.assertRaisesRegex(RuntimeError, word):
            getattr(bpy.ops.motus, operator)(**keywords)

    def test_keywords(self):
        camera()
        square("Target", (0.0, 5.0, 0.0))
        self.refused("no object Nothing", object="Nothing")
        self.refused("no camera", object="Target")
        self.refused("far greater", object="Camera", convergence='BUDGET', near=3.0, far=3.0)
        self.refused("both 0", object="Camera", convergence='BUDGET', near_parallax=0.0, far_parallax=0.0)
        self.refused("greater than 0", object="Camera", distance=0.0)
        self.refused("lies on the screen", object="Camera", convergence='OBJECT')
        self.refused("own focus", object="Camera", focus="Camera")
        self.refused("finite", object="Camera", interocular=float("inf"))
        self.refused("no stereo rig", "stereo_rig_remove", object="Camera")
        self.refused("no stereo rig", "stereo_check", object="Camera")
        self.refused("no stereo rig", "stereo_measure", object="Camera")
        self.refused("no stereo rig", "stereo_output", object="Camera")
        self.assertFalse(bpy.context.scene.render.use_multiview)

    def test_cameras(self):
        obj = camera()
        for kind in ('ORTHO', 'PANO'):
            obj.data.type = kind
            self.refused("perspective", object="Camera")
        obj.data.type = 'PERSP'
        self.add()
        self.refused("has a stereo rig", object="Camera")
        twin = bpy.data.objects.new("Twin", obj.data)
        bpy.context.scene.collection.objects.link(twin)
        self.refused("in common", object="Twin")
        other = camera("Other")
        other.data.stereo.driver_add("convergence_distance")
        self.refused("driver", object="Other")

    def test_linked_cameras(self):
        camera()
        linked = self.load(self.save(), True, "Camera")
        self.refused("linked", object=linked.name)

    def test_nothing_in_view(self):
        self.add()
        self.refused("sees nothing", "stereo_measure", object="Camera", range='CURRENT')


class Output(StereoTestCase):
    def test_formats(self):
        self.add()
        image = bpy.context.scene.render.image_settings
        for kind in ('SIDEBYSIDE', 'TOPBOTTOM', 'ANAGLYPH', 'INTERLACE'):
            bpy.ops.motus.stereo_output(object="Camera", format=kind)
            self.assertEqual((image.views_format, image.stereo_3d_format.display_mode), ('STEREO_3D', kind))
        bpy.ops.motus.stereo_output(object="Camera", format='PAIR')
        self.assertEqual(image.views_format, 'INDIVIDUAL')
        self.assertTrue(bpy.context.scene.render.use_multiview)

    def test_output_overrides_previous_scene_settings(self):
        self.add()
        both = bpy.context.scene.render.image_settings.stereo_3d_format
        both.anaglyph_type, both.interlace_type = 'YELLOW_BLUE', 'COLUMN_INTERLEAVED'
        both.use_sidebyside_crosseyed = both.use_interlace_swap = True
        bpy.ops.motus.stereo_output(object="Camera", format='ANAGLYPH')
        self.assertEqual(both.anaglyph_type, 'RED_CYAN')
        bpy.ops.motus.stereo_output(object="Camera", format='SIDEBYSIDE')
        self.assertFalse(both.use_sidebyside_crosseyed)
        bpy.ops.motus.stereo_output(object="Camera", format='INTERLACE')
        self.assertEqual((both.interlace_type, both.use_interlace_swap), ('ROW_INTERLEAVED', False))

    def test_glasses(self):
        self.add()
        both = bpy.context.scene.render.image_settings.stereo_3d_format
        for kind in ('GREEN_MAGENTA', 'YELLOW_BLUE', 'RED_CYAN'):
            bpy.ops.motus.stereo_output(object="Camera", format='ANAGLYPH', glasses=kind)
            self.assertEqual(both.anaglyph_type, kind)

    def test_camera_views_stay_plain(self):
        views = support.addon("core.interface.view.viewports").all_spaces()
        self.assertTrue(views)
        views[0].stereo_3d_camera = 'RIGHT'  # as somebody has chosen
        bpy.context.scene.render.use_multiview = False
        self.add()
        self.assertEqual([view.stereo_3d_camera for view in views], ['RIGHT'] + (len(views) - 1) * ['LEFT'])
        bpy.ops.motus.stereo_rig_remove(object="Camera")
        self.assertEqual([view.stereo_3d_camera for view in views], ['RIGHT'] + (len(views) - 1) * ['S3D'])
        views[0].stereo_3d_camera = 'S3D'

    def test_panoramas_have_square_pixels_and_are_taken_back(self):
        obj, render = camera(), bpy.context.scene.render
        bpy.context.scene.render.engine = 'CYCLES'
        before, size = state(obj), (render.resolution_x, render.resolution_y)
        self.add(interocular=0.1, distance=3.0)
        around = support.addon("stereo.around")
        for half, height in ((False, size[0] // 2), (True, size[0])):
            bpy.ops.motus.stereo_output(object="Camera", format='TOPBOTTOM', use_360=True, use_180=half)
            self.assertEqual((render.resolution_x, render.resolution_y), (size[0], height))
            self.assertAlmostEqual(around.width(obj.data), math.pi if half else 2.0 * math.pi, 5)
            self.assertTrue(obj.data.stereo.use_pole_merge)
            bpy.ops.motus.stereo_output(object="Camera", format='SIDEBYSIDE')  # which leaves what the camera sees
            self.assertEqual(render.resolution_y, height)
        bpy.ops.motus.stereo_output(object="Camera", use_360=False)
        self.assertEqual((render.resolution_x, render.resolution_y), size)
        bpy.ops.motus.stereo_output(object="Camera", use_360=True)
        bpy.ops.motus.stereo_rig_remove(object="Camera")
        self.assertEqual((render.resolution_x, render.resolution_y), size)
        self.assertEqual(state(obj), before)

    def test_panorama_of_360_degrees(self):
        obj = camera()
        before = state(obj)
        self.add(interocular=0.1, distance=3.0)
        scene = bpy.context.scene
        scene.render.engine = 'BLENDER_WORKBENCH'
        with self.assertRaisesRegex(RuntimeError, "Cycles"):
            bpy.ops.motus.stereo_output(object="Camera", use_360=True)
        scene.render.engine = 'CYCLES'
        bpy.ops.motus.stereo_output(object="Camera", use_360=True)
        self.assertEqual((obj.data.type, obj.data.stereo.use_spherical_stereo), ('PANO', True))
        bpy.context.view_layer.update()
        self.assert_eyes(obj, 0.1, 3.0)
        # As by the panel's menu: another way to write the images leaves what the camera sees, in any engine.
        scene.render.engine = 'BLENDER_WORKBENCH'
        bpy.ops.motus.stereo_output(object="Camera", format='ANAGLYPH')
        self.assertEqual((obj.data.type, obj.data.stereo.use_spherical_stereo), ('PANO', True))
        scene.render.engine = 'CYCLES'
        bpy.ops.motus.stereo_output(object="Camera", use_360=False)
        self.assertEqual((obj.data.type, obj.data.stereo.use_spherical_stereo), ('PERSP', False))
        bpy.ops.motus.stereo_output(object="Camera", format='PAIR')
        self.assertEqual((obj.data.type, obj.data.stereo.use_spherical_stereo), ('PERSP', False))
        obj.motus.stereo.convergence = 'BUDGET'
        with self.assertRaisesRegex(RuntimeError, "no budget of depth"):
            bpy.ops.motus.stereo_output(object="Camera", use_360=True)
        obj.motus.stereo.convergence = 'DISTANCE'
        bpy.ops.motus.stereo_output(object="Camera", use_360=True)
        bpy.ops.motus.stereo_rig_remove(object="Camera")
        self.assertEqual(state(obj), before)
