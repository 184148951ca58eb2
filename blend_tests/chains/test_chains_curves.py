"""Chains of the points of a curve: where they hang, with bevels and handles, in any order of frames, and after they are removed."""

import bpy
import numpy as np

import support
from chains import chain_cases as cases

FRAMES = (1, 8, 13.5, 20, 26, 31.25, 90)
LIMP = {"frequency": 0.0, "drag": 0.5}
LINK = 0.3


def rope(kind='POLY', count=5, splines=1, name="Rope"):
    """A curve object that keys move along X; its splines stand straight out along Y, beside each other."""
    data = bpy.data.curves.new(name, 'CURVE')
    data.dimensions = '3D'
    for number in range(splines):
        spline = data.splines.new(kind)
        points = spline.bezier_points if kind == 'BEZIER' else spline.points
        points.add(count - 1)
        for index, point in enumerate(points):
            place = np.array((float(number), LINK * index, 0.0))
            if kind == 'BEZIER':
                point.co, point.handle_left, point.handle_right = place, place - (0.0, 0.1, 0.0), place + (0.0, 0.1, 0.0)
            else:
                point.co = (*place, 1.0)
    found = support.link(name, data)
    cases.key(found, "location", {1: (0.0, 0.0, 2.0), 12: (0.0, 0.0, 2.0), 24: (1.0, 0.0, 2.0)})
    return found


def add(curve, **settings):
    """The entries that motus.chains_add makes; keywords of the operator, and settings of the curve."""
    keywords = {name: settings.pop(name) for name in list(settings) if name in (*support.addon("chains.operators").KEYWORDS, "spline")}
    bpy.ops.motus.chains_add(object=curve.name, **keywords)
    for name, value in settings.items():
        setattr(curve.motus.chains, name, value)
    bpy.context.view_layer.update()
    return curve.motus.chains.entries


def shown(curve, frame):
    """Points of the line or surface that Blender makes of the curve on a frame, in the world, (n, 3)."""
    cases.go_to(frame)
    evaluated = support.evaluated(curve)
    mesh = evaluated.to_mesh()
    found = np.array([evaluated.matrix_world @ vertex.co for vertex in mesh.vertices])
    evaluated.to_mesh_clear()
    return found


class ChainsCurvesTest(support.SceneTestCase):
    def test_limp_points_at_rest_hang_straight_down(self):
        curve = rope()
        (entry,) = add(curve, **LIMP | {"drag": 2.0}, settle=60.0)
        self.assertEqual((entry.name, entry.spline, len(entry.links)), ("Spline 1", 0, 5))
        np.testing.assert_allclose(shown(curve, 1), [(0.0, 0.0, 2.0 - LINK * index) for index in range(5)], atol=6e-3)
        self.assertIsNone(cases.problem(curve))

    def test_points_keep_their_distances(self):
        curve = rope()
        curve.rotation_euler = (0.4, 0.3, -0.8)
        add(curve, **LIMP)
        for frame in FRAMES:
            found = np.linalg.norm(np.diff(shown(curve, frame), axis=0), axis=1)
            np.testing.assert_allclose(found, LINK, rtol=1e-3, err_msg=f"{frame}")

    def test_splines_with_a_bevel_and_of_every_kind(self):
        """The deepest point of what is drawn is the last point's, whose cross-section lies in the horizontal plane."""
        for kind in ('POLY', 'NURBS', 'BEZIER'):
            with self.subTest(kind):
                support.empty_scene()
                curve = rope(kind)
                curve.data.bevel_depth = 0.05
                for spline in curve.data.splines:
                    spline.use_endpoint_u = True
                plain = shown(curve, 1)
                add(curve, **LIMP | {"drag": 2.0}, settle=60.0)
                found = shown(curve, 1)
                self.assertEqual(len(found), len(plain))
                self.assertAlmostEqual(found[:, 2].min(), 2.0 - 4 * LINK, delta=0.02)
                self.assertLess(np.abs(found[:, :2]).max(), 0.12)

    def test_handles_turn_with_their_points(self):
        curve = rope('BEZIER')
        add(curve, **LIMP | {"drag": 2.0}, settle=60.0)
        found = shown(curve, 1)
        last = found[found[:, 2].argmin()]
        before = found[np.argsort(found[:, 2])[1]]
        way = (before - last) / np.linalg.norm(before - last)
        np.testing.assert_allclose(way, (0.0, 0.0, 1.0), atol=0.03)

    def test_both_ends_are_held(self):
        curve = rope(count=9)
        for index, point in enumerate(curve.data.splines[0].points):  # a gable: 2.4 m of rope between ends that are 1.6 m apart
            point.co.y, point.co.z = 0.2 * index, (LINK**2 - 0.2**2) ** 0.5 * min(index, 8 - index)
        add(curve, **LIMP | {"drag": 2.0}, hold_end=True, settle=60.0)
        found = shown(curve, 1)
        np.testing.assert_allclose(found[[0, 8]], [(0.0, 0.0, 2.0), (0.0, 1.6, 2.0)], atol=2e-3)
        self.assertLess(found[4, 2], 1.9)
        np.testing.assert_allclose(found[:, 1] + found[::-1, 1], 1.6, atol=0.02)

    def test_a_chain_for_each_spline(self):
        curve = rope(splines=3)
        self.assertEqual([entry.name for entry in add(curve, spline=1, **LIMP)], ["Spline 2"])
        found = shown(curve, 60)
        np.testing.assert_allclose(found[:5, 2], 2.0, atol=1e-6)
        self.assertLess(found[9, 2], 1.5)
        self.assertEqual(len(add(curve, **LIMP)), 3)
        self.assertLess(shown(curve, 60)[[4, 9, 14], 2].max(), 1.5)

    def test_a_curve_touches(self):
        curve = rope('BEZIER')
        ball = support.link("Ball", location=(0.0, 0.05, 1.2))
        ball.empty_display_type, ball.empty_display_size = 'SPHERE', 0.3
        solid = bpy.data.collections.new("Solid")
        bpy.context.scene.collection.children.link(solid)
        solid.objects.link(ball)
        curve.animation_data_clear()
        curve.location.z = 2.0
        (entry,) = add(curve, **LIMP, thickness=0.05, settle=10.0, colliders=solid)
        for frame in (1, 40):
            cases.go_to(frame)
            anchors = np.array([support.evaluated(link.object).matrix_world.translation for link in entry.links][1:])
            self.assertGreater(np.linalg.norm(anchors - ball.location, axis=1).min(), 0.34)

    def test_any_frame_in_any_order(self):
        curve = rope('BEZIER')
        add(curve, frequency=1.0)
        first = {frame: shown(curve, frame).tobytes() for frame in FRAMES}
        support.addon().forget_all()
        for frame in reversed(FRAMES):
            self.assertEqual(shown(curve, frame).tobytes(), first[frame])

    def test_removal_leaves_nothing(self):
        curve = rope('BEZIER')
        mine = curve.modifiers.new("Mine", 'SIMPLE_DEFORM')
        mine.angle = 0.1
        before = {frame: shown(curve, frame).tobytes() for frame in FRAMES}
        names, keys = {obj.name for obj in bpy.data.objects}, set(curve.data.keys())
        add(curve)
        self.assertEqual(curve.modifiers[-1], mine)
        self.assertNotEqual(shown(curve, 20).tobytes(), before[20])
        bpy.ops.motus.chains_remove(object=curve.name)
        self.assertEqual([one.name for one in curve.modifiers], ["Mine"])
        self.assertEqual({obj.name for obj in bpy.data.objects}, names)
        self.assertEqual(set(curve.data.keys()), keys)
        self.assertEqual({frame: shown(curve, frame).tobytes() for frame in FRAMES}, before)

    def test_bake_and_unbake(self):
        curve = rope('BEZIER')
        add(curve)
        live = {frame: shown(curve, frame) for frame in (1, 15, 30)}
        bpy.context.view_layer.objects.active = curve
        bpy.ops.motus.bake(frame_start=1, frame_end=30)
        for frame, wanted in live.items():
            np.testing.assert_allclose(shown(curve, frame), wanted, atol=1e-5)
        bpy.ops.motus.unbake()
        for frame, wanted in live.items():
            np.testing.assert_array_equal(shown(curve, frame), wanted)

    def test_copies_have_a_motion_of_their_own(self):
        curve = rope('BEZIER')
        add(curve, frequency=0.5)
        wanted = {frame: shown(curve, frame) for frame in FRAMES}
        copy = curve.copy()
        bpy.context.scene.collection.objects.link(copy)
        bpy.context.view_layer.update()
        copy.delta_location.y = 3.0
        for frame, found in wanted.items():
            np.testing.assert_allclose(shown(copy, frame), found + (0.0, 3.0, 0.0), atol=1e-5)
            np.testing.assert_array_equal(shown(curve, frame), found)
        bpy.ops.motus.chains_remove(object=curve.name)
        for frame, found in wanted.items():
            np.testing.assert_allclose(shown(copy, frame), found + (0.0, 3.0, 0.0), atol=1e-5)

    def test_saved_linked_and_appended(self):
        curve = rope('BEZIER')
        add(curve, frequency=0.5)
        wanted = {frame: shown(curve, frame) for frame in FRAMES}
        path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        for frame, found in wanted.items():
            np.testing.assert_array_equal(shown(bpy.data.objects["Rope"], frame), found)
        for is_link in (True, False):
            curve = self.load(path, is_link, "Rope")
            bpy.context.view_layer.update()
            self.assertIsNone(cases.problem(curve))
            for frame, found in wanted.items():
                np.testing.assert_array_equal(shown(curve, frame), found)

    def test_a_deleted_curve_takes_its_helpers_along(self):
        names = {obj.name for obj in bpy.data.objects}
        curve = rope()
        add(curve)
        curve.select_set(True)
        bpy.ops.object.delete()
        bpy.ops.wm.open_mainfile(filepath=self.save())
        self.assertEqual({obj.name for obj in bpy.data.objects}, names)

    def test_another_number_of_points_is_told(self):
        for change in ("more", "fewer", "none"):
            with self.subTest(change):
                support.empty_scene()
                curve = rope()
                add(curve, frequency=0.5)
                shown(curve, 15)
                data = curve.data
                if change == "more":
                    data.splines[0].points.add(3)
                else:
                    data.splines.clear()
                if change == "fewer":
                    data.splines.new('POLY').points.add(1)
                bpy.context.view_layer.update()
                cases.go_to(20)
                self.assertIn("press Refresh", cases.problem(curve).sentence)
                bpy.ops.motus.refresh(object=curve.name)
                cases.go_to(21)
                if change != "none":
                    self.assertIsNone(cases.problem(curve))
                bpy.ops.motus.chains_remove(object=curve.name)
                self.assertFalse(curve.modifiers)

    def test_a_spline_with_one_point_left_is_told(self):
        curve = rope(splines=2)
        add(curve, frequency=0.5)
        data = curve.data
        data.splines.remove(data.splines[1])
        data.splines.new('POLY')
        bpy.context.view_layer.update()
        bpy.ops.motus.refresh(object=curve.name)
        found = shown(curve, 20)
        self.assertTrue(np.isfinite(found).all())
        told = support.addon("chains.told").sentence(curve, cases.problem(curve), bpy.context.scene)
        self.assertEqual(told, "Rope has no spline 2 with two points and more: remove Spline 2 from the list")
        bpy.ops.motus.chains_remove(object=curve.name)
        self.assertEqual([obj.name for obj in bpy.data.objects], ["Rope"])

    def test_points_that_are_moved_are_told(self):
        for kind in ('POLY', 'BEZIER'):
            with self.subTest(kind):
                support.empty_scene()
                curve = rope(kind)
                add(curve, **LIMP | {"drag": 2.0}, settle=60.0)
                cases.go_to(15)
                self.assertIsNone(cases.problem(curve))
                spline = curve.data.splines[0]
                point = (spline.bezier_points if kind == 'BEZIER' else spline.points)[4]
                point.co.x += 1.0
                curve.data.update_tag()
                bpy.context.view_layer.update()
                self.assertIn("press Refresh", cases.problem(curve).sentence)
                bpy.ops.motus.refresh(object=curve.name)
                cases.go_to(1)
                self.assertIsNone(cases.problem(curve))
                anchor = support.evaluated(curve.motus.chains.entries[0].links[4].object).matrix_world.translation
                longest = np.hypot(1.0, LINK)  # of the last link, which hangs down as the others do
                self.assertAlmostEqual(anchor.z, 2.0 - 3 * LINK - longest, delta=2e-2)

    def test_what_was_converted_keeps_no_helpers(self):
        curve = rope()
        add(curve)
        bpy.context.view_layer.objects.active = curve
        curve.select_set(True)
        bpy.ops.object.convert(target='MESH')
        bpy.ops.motus.chains_remove(object="Rope")
        self.assertEqual([obj.name for obj in bpy.data.objects], ["Rope"])

    def test_what_cannot_hang_is_refused(self):
        curve = rope()
        curve.data.splines[0].use_cyclic_u = True
        self.assertRefused("is closed", bpy.ops.motus.chains_add, object="Rope")
        curve.data.splines[0].use_cyclic_u = False
        self.assertRefused("no spline 3", bpy.ops.motus.chains_add, object="Rope", spline=2)
        curve.data.splines.clear()
        self.assertRefused("no spline 1", bpy.ops.motus.chains_add, object="Rope")
