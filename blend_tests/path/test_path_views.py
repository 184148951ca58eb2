"""What is shown of a path: edit views and the overlay's batches."""

import bpy
import numpy as np

import support
from path.path_cases import CLIMB, PathTestCase, circle_knots, dense, positions_at


class EditViews(PathTestCase):
    def spaces(self):
        return [area.spaces.active for area in bpy.context.screen.areas if area.type == 'VIEW_3D']

    def state(self):
        views = [space.region_3d for space in self.spaces()]
        return [(tuple(view.view_location), tuple(view.view_rotation), view.view_perspective, view.view_distance) for view in views]

    def test_plain_views_that_switch(self):
        self.cubic()
        before = self.state()
        objects, collections = len(bpy.data.objects), len(bpy.data.collections)
        self.assertTrue(self.spaces())
        for wanted in ((0, 0, -1), (0, 1, 0), (0, 0, -1)):
            bpy.ops.motus.path_edit_views(curve="Course")
            for space in self.spaces():
                view = space.region_3d
                gaze = -np.array(view.view_rotation.to_matrix().col[2])
                self.assertTrue(np.allclose(gaze, wanted, atol=1e-6), gaze)
                self.assertEqual((view.view_perspective, space.use_local_camera), ('ORTHO', False))
        self.assertEqual((len(bpy.data.objects), len(bpy.data.collections), len(bpy.data.cameras)), (objects, collections, 0))
        bpy.ops.motus.path_edit_views(view='LEAVE')
        self.assertEqual(self.state(), before)
        bpy.ops.motus.path_edit_views(view='LEAVE')
        self.assertEqual(self.state(), before)

    def test_whole_curve_in_the_view(self):
        curve = self.cubic()
        curve.location = 100.0, 50.0, -20.0
        curve.scale = 3.0, 3.0, 3.0
        for view, axes in (('TOP', (0, 1)), ('SIDE', (0, 2))):
            bpy.ops.motus.path_edit_views(curve="Course", view=view)
            space = self.spaces()[0]
            centre = np.array(space.region_3d.view_location)[list(axes)]
            points = dense([tuple(3.0 * c + o for c, o in zip(p, curve.location)) for p in CLIMB])[:, axes]
            seen = 72.0 * space.region_3d.view_distance / space.lens
            self.assertLess(np.abs(points - centre).max(), seen / 2.0)
        bpy.ops.motus.path_edit_views(view='LEAVE')

    def test_nothing_of_them_is_left_when_the_add_on_goes(self):
        self.cubic()
        before = self.state()
        bpy.ops.motus.path_edit_views(curve="Course", view='TOP')
        self.assertNotEqual(self.state(), before)
        support.disable()
        self.addCleanup(support.enable)
        self.assertEqual(self.state(), before)

    def test_all_at_once_need_a_window(self):
        self.cubic()
        self.assertRefused("without a window", bpy.ops.motus.path_edit_views, curve="Course", view='ALL')

    def test_refuses_without_a_curve(self):
        self.assertRefused("Choose a curve", bpy.ops.motus.path_edit_views)


class Overlay(PathTestCase):
    def setUp(self):
        super().setUp()
        self.overlay = support.addon("core.interface.overlay")

    def batches(self, obj):
        for other in self.scene.objects:
            other.select_set(other == obj)
        bpy.context.view_layer.objects.active = obj
        found = self.overlay.batches(bpy.context)
        for batch in found:
            self.assertEqual((batch.points.dtype, batch.points.shape[1]), (np.float32, 3))
            if not isinstance(batch.colors, tuple):
                self.assertEqual(batch.colors.shape, (len(batch.points), 4))
        return found

    def show(self, *names):
        for name in ("curve", "control_points", "tangents", "frames", "speed"):
            setattr(self.scene.motus, f"show_{name}", name in names)

    def test_curve_is_the_one_followed(self):
        self.cubic()
        car = self.follow(duration=4.0)
        self.show("curve")
        (lines,) = self.batches(car)
        course = dense(CLIMB)[::100]
        for point in lines.points[::9]:
            self.assertLess(np.linalg.norm(course - point, axis=1).min(), 1e-2)
        self.assertTrue(np.allclose(lines.points[[0, -1]], [CLIMB[0], CLIMB[-1]], atol=1e-5))

    def test_colour_shows_the_speed(self):
        self.line(10.0)
        car = self.follow(duration=4.0, ease_in=0.5, ease_out=0.5)
        self.show("curve", "speed")
        (lines,) = self.batches(car)
        red = lines.colors[:, 0]
        self.assertGreater(red[len(red) // 2], red[0])
        self.assertGreater(red[len(red) // 2], red[-1])

    def test_switches(self):
        self.cubic()
        car = self.follow(orientation='BANKING', timing='SPEED')
        for names, count in (
            ((), 0),
            (("control_points",), 2),
            (("tangents",), 1),
            (("frames",), 2),
            (("curve", "control_points", "tangents", "frames", "speed"), 6),
        ):
            self.show(*names)
            with self.subTest(names=names):
                self.assertEqual(len(self.batches(car)), count)

    def test_wagon_shows_its_train(self):
        self.bezier(circle_knots(), cyclic=True)
        for name in ("First", "Second"):
            self.link(name)
        bpy.ops.motus.path_train_add(objects="First,Second", curve="Course")
        self.show("curve")
        self.assertEqual(len(self.batches(bpy.data.objects["Second"])), 1)

    def test_bezier_curve_without_a_follower(self):
        bpy.ops.motus.path_new_bezier(degree=5)
        curve = bpy.context.object
        self.show("curve")
        (lines,) = self.batches(curve)
        points = [point.co[:3] for point in curve.data.splines[0].points]
        middle = positions_at(dense(points), 0.5)[0]
        self.assertLess(np.linalg.norm(lines.points - middle, axis=1).min(), 0.1)

    def test_nothing_for_other_objects_and_unreadable_curves(self):
        self.assertEqual(self.batches(self.link("Alone")), [])
        self.assertEqual(self.batches(self.cubic()), [])
        self.points('POLY', [(0, 0, 0)], name="Point")
        self.assertEqual(self.batches(self.follow(curve="Point")), [])
