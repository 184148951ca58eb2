"""Measuring depth and checking what an audience would see."""

import bpy
import numpy as np

import support
from stereo.stereo_cases import StereoTestCase, camera, native, square
from support import go_to


def sentences(obj):
    return support.addon("stereo.results").of(obj).sentences


class Check(StereoTestCase):
    def setUp(self):
        super().setUp()
        self.camera = camera()
        square("Wall", (0.0, 10.0, 0.0), 40.0)

    def check(self, **keywords):
        self.assertEqual(bpy.ops.motus.stereo_check(object="Camera", **keywords), {'FINISHED'})
        return sentences(self.camera)

    def test_divergence_by_how_much(self):
        self.add(interocular=0.2, distance=5.0, screen='CINEMA')
        found = native().parallax(10.0, 0.2, 35.0, 36.0, 5.0)
        by = 100.0 * (found - native().divergence_limit(12.0))
        self.assertEqual(self.check(range='CURRENT'), (f"Diverges on a 12 m screen by {by:.2g} % in frame 1",))

    def test_what_was_found_is_forgotten(self):
        results, path = support.addon("stereo.results"), self.save()
        self.add()
        self.check(range='CURRENT')
        bpy.data.objects.remove(self.camera)
        self.camera = camera()
        self.add()
        self.assertIsNone(results.of(self.camera))
        self.check(range='CURRENT')
        bpy.ops.wm.open_mainfile(filepath=path)
        self.assertIsNone(results.of(bpy.data.objects["Camera"]))

    def test_check_without_faults(self):
        self.add(interocular=0.02, distance=8.0, screen='MONITOR')
        self.assertEqual(self.check(range='CURRENT'), ())
        result = support.addon("stereo.results").of(self.camera)
        self.assertAlmostEqual(result.highest, native().parallax(10.0, 0.02, 35.0, 36.0, 8.0), 6)
        self.assertAlmostEqual(result.shares.sum(), 1.0, 9)

    def test_no_problems_are_said_with_the_frames(self):
        self.add(interocular=0.02, distance=8.0, screen='MONITOR')
        self.check(frame_start=1, frame_end=25)
        result = support.addon("stereo.results").of(self.camera)
        self.assertEqual(result.verdict, "No problems on a 0.6 m screen in frames 1-25")
        self.assertEqual(result.frames.tolist(), list(range(1, 26)))
        self.assertFalse(result.is_faulty.any())

    def test_convergence_and_parallax_of_each_frame(self):
        obj = self.add(interocular=0.2, distance=8.0, screen='CINEMA')
        for frame, distance in ((1, 8.0), (5, 3.0)):
            obj.motus.stereo.distance = distance
            obj.keyframe_insert("motus.stereo.distance", frame=frame)
        bpy.context.view_layer.update()
        self.check(frame_start=1, frame_end=5)
        result = support.addon("stereo.results").of(self.camera)
        self.assertEqual(result.verdict, "")
        np.testing.assert_allclose(result.convergence[[0, 4]], (8.0, 3.0), rtol=1e-6)
        wanted = [native().parallax(10.0, 0.2, 35.0, 36.0, distance) for distance in result.convergence]
        np.testing.assert_allclose(result.farthest, wanted, rtol=1e-5)
        np.testing.assert_allclose(result.nearest, wanted, rtol=1e-5)
        limit = native().comfortable_parallax(12.0, 15.0)[1]
        np.testing.assert_array_equal(result.is_faulty, np.array(wanted) > limit)
        self.assertEqual(set(result.is_faulty.tolist()), {False, True})

    def test_eyes_that_are_turned_away_from_corners(self):
        self.add(mode='TOE', interocular=3.0, distance=0.3)
        found = self.check(range='CURRENT')
        width = bpy.context.scene.render.resolution_x
        self.assertIn(f"{width - 1} pixels", next(one for one in found if "Corners" in one))

    def test_the_window_on_the_frames_where_it_is_violated(self):
        self.add(interocular=0.065, distance=8.0, screen='PHONE')
        pillar = square("Pillar", (0.0, 4.0, 0.0), 0.6)
        edge = 0.5 * 36.0 / 35.0 * 4.0
        for frame, x in ((1, 0.0), (10, 0.0), (11, -edge), (20, -edge), (21, 0.0)):
            pillar.location.x = x
            pillar.keyframe_insert("location", frame=frame)
        found = self.check(frame_start=5, frame_end=25)
        (left,) = [one for one in found if "window" in one]
        self.assertIn("left edge", left)
        self.assertIn("frames 11-20", left)

    def test_a_floating_window_takes_its_violations_away(self):
        obj = self.add(interocular=0.065, distance=8.0, screen='PHONE')
        pillar = square("Pillar", (0.0, 4.0, 0.0), 0.6)
        edge = 0.5 * 36.0 / 35.0 * 4.0
        for frame, x in ((1, 0.0), (20, 0.0), (21, -edge), (30, -edge), (31, 0.0)):
            pillar.location.x = x
            pillar.keyframe_insert("location", frame=frame)
        self.assertTrue(any("window" in one for one in self.check(frame_start=1, frame_end=50)))
        self.assertEqual(bpy.ops.motus.stereo_window(object="Camera", frame_start=1, frame_end=50, ahead=4), {'FINISHED'})
        self.assertFalse([one for one in self.check(frame_start=1, frame_end=50) if "window" in one])
        find = support.addon("core.blender.actions").find
        curve = find(obj, "motus.stereo.window_left")
        parallax = -100.0 * native().parallax(4.0, 0.065, 35.0, 36.0, 8.0)
        for frame in range(21, 31):
            self.assertGreater(curve.evaluate(frame), parallax - 1e-4)
            self.assertLess(curve.evaluate(frame), parallax + 0.1)
        self.assertAlmostEqual(curve.evaluate(1), 0.0, 3)
        self.assertLess(len(curve.keyframe_points), 20)
        self.assertEqual(len(find(obj, "motus.stereo.window_right").keyframe_points), 1)
        bpy.ops.motus.stereo_rig_remove(object="Camera")
        self.assertIsNone(find(obj, "motus.stereo.window_left"))

    def test_a_window_of_one_frame(self):
        obj = self.add(interocular=0.065, distance=8.0, screen='PHONE')
        edge = 0.5 * 36.0 / 35.0 * 4.0
        square("Pillar", (edge, 4.0, 0.0), 0.6)
        bpy.context.view_layer.update()
        bpy.ops.motus.stereo_window(object="Camera", range='CURRENT')
        parallax = -100.0 * native().parallax(4.0, 0.065, 35.0, 36.0, 8.0)
        self.assertAlmostEqual(obj.motus.stereo.window_right, parallax, 4)
        self.assertEqual(obj.motus.stereo.window_left, 0.0)
        self.assertEqual(self.check(range='CURRENT'), ())

    def test_toe_in_moves_corners(self):
        self.add(mode='TOE', interocular=0.3, distance=3.0, screen='PHONE')
        self.assertTrue(any("Corners" in one for one in self.check(range='CURRENT')))

    def test_nothing_in_view(self):
        self.add()
        self.camera.rotation_euler.x = -1.0
        self.assertEqual(len(self.check(range='CURRENT')), 1)
        self.assertIn("sees nothing", sentences(self.camera)[0])

    def test_the_frame_stays(self):
        self.add()
        go_to(7.5)
        self.check(frame_start=1, frame_end=3)
        scene = bpy.context.scene
        self.assertEqual((scene.frame_current, scene.frame_subframe), (7, 0.5))


class Cuts(StereoTestCase):
    """Two cameras with rigs, which markers choose in turns: the first one to frame 10, the second one from there on."""

    def setUp(self):
        super().setUp()
        scene = bpy.context.scene
        square("Wall", (0.0, 10.0, 0.0), 80.0)
        self.mild, self.wild = camera("Mild"), camera("Wild")
        self.add(object="Mild", interocular=0.02, distance=8.0, screen='CINEMA')
        self.add(object="Wild", interocular=0.3, distance=5.0, screen='CINEMA')
        for name, frame in (("Mild", 1), ("Wild", 11)):
            scene.timeline_markers.new(name, frame=frame).camera = bpy.data.objects[name]

    def check(self, name):
        self.assertEqual(bpy.ops.motus.stereo_check(object=name, frame_start=1, frame_end=20), {'FINISHED'})

    def test_the_camera_of_each_frame_is_checked(self):
        self.check("Mild")
        self.assertEqual(sentences(self.mild), ())
        (found,) = sentences(self.wild)
        self.assertRegex(found, "^Diverges on a 12 m screen by .* in frames 11-20$")

    def test_a_camera_counts_on_its_own_frames_alone(self):
        bpy.context.scene.timeline_markers.remove(bpy.context.scene.timeline_markers["Wild"])
        self.check("Wild")
        self.assertEqual(sentences(self.wild), ())

    def test_a_camera_without_a_rig_is_checked_on_the_same_screen(self):
        bpy.ops.motus.stereo_rig_remove(object="Wild")
        self.wild.data.stereo.interocular_distance, self.wild.data.stereo.convergence_distance = 0.3, 5.0
        self.check("Mild")
        (found,) = sentences(self.wild)
        self.assertRegex(found, "^Diverges on a 12 m screen by .* in frames 11-20$")

    def test_the_scene_keeps_its_camera(self):
        scene = bpy.context.scene
        scene.camera = self.wild  # as somebody may choose by hand on the first frame
        self.check("Mild")
        self.assertEqual((scene.camera, scene.frame_current), (self.wild, 1))


class Measure(StereoTestCase):
    def test_near_and_far(self):
        obj = self.add(convergence='BUDGET')
        square("Near", (-2.0, 3.0, 0.0), 2.0)
        square("Wall", (0.0, 12.0, 0.0), 60.0)
        bpy.ops.motus.stereo_measure(object="Camera", range='CURRENT')
        np.testing.assert_allclose((obj.motus.stereo.near, obj.motus.stereo.far), (3.0, 12.0), rtol=1e-5)

    def test_near_over_time_changes_ahead_and_stays_below(self):
        obj = self.add(convergence='BUDGET')
        square("Wall", (0.0, 12.0, 0.0), 60.0)
        near = square("Near", (0.0, 8.0, 0.0), 4.0)
        for frame, depth in ((1, 8.0), (20, 8.0), (21, 3.0), (30, 3.0)):
            near.location.y = depth
            near.keyframe_insert("location", frame=frame)
        bpy.ops.motus.stereo_measure(object="Camera", frame_start=1, frame_end=30, ahead=5)
        found = []
        for frame in range(1, 31):
            go_to(frame)
            found.append(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).motus.stereo.near)
        self.assertAlmostEqual(found[0], 8.0, 4)
        self.assertLess(found[18], 7.9)
        for frame, value in enumerate(found, 1):
            self.assertLessEqual(value, (8.0 if frame <= 20 else 3.0) + 1e-4)

    def test_a_shot_is_keyed_by_few_keys_which_keep_to_their_side(self):
        obj = self.add(convergence='BUDGET')
        wall, near = square("Wall", (0.0, 30.0, 0.0), 200.0), square("Near", (0.0, 20.0, 0.0), 4.0)
        for thing, frame, depth in ((near, 1, 20.0), (near, 60, 5.0), (near, 100, 9.0), (wall, 1, 30.0), (wall, 100, 60.0)):
            thing.location.y = depth
            thing.keyframe_insert("location", frame=frame)
        obj.keyframe_insert("motus.stereo.near", frame=200)
        find = support.addon("core.blender.actions").find
        seen = {}
        for tolerance in (0.0, 1.0):
            bpy.ops.motus.stereo_measure(object="Camera", frame_start=1, frame_end=100, tolerance=tolerance)
            seen[tolerance] = {name: find(obj, f"motus.stereo.{name}") for name in ("near", "far")}
            seen[tolerance] = {name: ([key.co.x for key in curve.keyframe_points], curve) for name, curve in seen[tolerance].items()}
        for name, beyond in (("near", 1), ("far", 0)):
            frames, curve = seen[1.0][name]
            self.assertEqual(frames, sorted(frames))
            self.assertLess(len(frames), 20)
            self.assertLess(len(frames), len(seen[0.0][name][0]))
            self.assertEqual(sum(frame > 100.0 for frame in frames), beyond)
            for frame in range(1, 101):
                go_to(frame)
                depth = (near if name == "near" else wall).matrix_world.translation.y
                with self.subTest(name, frame=frame):
                    if name == "near":
                        self.assertLess(curve.evaluate(frame), depth * (1.0 + 1e-5))
                    else:
                        self.assertGreater(curve.evaluate(frame), depth * (1.0 - 1e-5))

    def test_measuring_in_stretched_time(self):
        """Twice as many frames of the time line, so that near goes ahead by twice as many too, have what plain time has."""
        found = []
        for stretch in (1, 2):
            self.setUp()
            render = bpy.context.scene.render
            render.frame_map_old, render.frame_map_new = 100, 100 * stretch
            obj = self.add(convergence='BUDGET')
            square("Wall", (0.0, 12.0, 0.0), 60.0)
            near = square("Near", (0.0, 8.0, 0.0), 4.0)
            for frame, depth in ((1, 8.0), (20, 8.0), (21, 3.0), (30, 3.0)):
                near.location.y = depth
                near.keyframe_insert("location", frame=frame)
            bpy.ops.motus.stereo_measure(object="Camera", frame_start=stretch, frame_end=30 * stretch, ahead=5 * stretch)
            for frame in (1, 10, 18, 25):
                go_to(frame * stretch)
                found.append(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).motus.stereo.near)
        render.frame_map_new = 100
        np.testing.assert_allclose(found[4:], found[:4], atol=0.25)

    def test_a_single_depth_leaves_a_budget(self):
        obj = self.add(convergence='BUDGET')
        square("Wall", (0.0, 12.0, 0.0), 60.0)
        bpy.ops.motus.stereo_measure(object="Camera", range='CURRENT')
        self.assertGreater(obj.motus.stereo.far, obj.motus.stereo.near)


class Overlay(StereoTestCase):
    def test_planes_lie_where_the_eyes_meet(self):
        obj = self.add(interocular=0.1, distance=3.0, screen='CINEMA')
        overlay = support.addon("stereo.overlay").overlay
        loops = [batch for batch in overlay(bpy.context, obj) if batch.kind == 'LINE_STRIP']
        depths = sorted(float(batch.points[0, 1]) for batch in loops)
        limits = native().comfortable_parallax(12.0, 15.0)
        near, far = native().depth_budget(*limits, 0.1, 35.0, 36.0, 3.0)
        np.testing.assert_allclose(depths, (near, 3.0, far), rtol=1e-5)
        for batch in loops:
            width = np.ptp(batch.points[:, 0])
            self.assertAlmostEqual(width, 36.0 / 35.0 * batch.points[0, 1], 4)

    def test_the_ruler_is_marked_in_half_percents_and_shows_what_is_selected(self):
        obj = self.add(interocular=0.1, distance=3.0, screen='CINEMA')
        colors = support.addon("stereo.overlay")
        bpy.context.scene.motus.show_stereo_planes = bpy.context.scene.motus.show_stereo_volume = False
        places = {(0.5, 3.05, 0.2): colors.COMFORTABLE, (0.0, 1.2, 0.0): colors.STRAINED, (0.0, 20.0, 0.0): colors.DIVERGING}
        for index, place in enumerate(places):
            square(f"Ruled {index}", place).select_set(True)
        square("Behind", (0.0, -2.0, 0.0)).select_set(True)
        bpy.context.view_layer.update()
        scale, *lines = colors.overlay(bpy.context, obj)
        marks = scale.points[2::2]
        parallax = native().parallax(marks[:, 1].astype(float), 0.1, 35.0, 36.0, 3.0)
        np.testing.assert_allclose(parallax / colors.STEP, np.round(parallax / colors.STEP), atol=1e-4)
        self.assertGreater(len(marks), 10)
        self.assertEqual(
            {tuple(np.round(line.points[1], 5).tolist()): line.colors for line in lines},
            {tuple(np.round(np.array(place, np.float32), 5).tolist()): color for place, color in places.items()},
        )
