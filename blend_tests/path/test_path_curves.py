"""Follow Path on every kind of curve: positions against independent truth, in world space."""

import itertools
import math

import bpy
import numpy as np
from mathutils import Matrix

import support
from path.path_cases import (
    CLIMB,
    PathTestCase,
    add_bezier,
    add_points,
    bernstein,
    circle_knots,
    cubic_knots,
    curve_data,
    dense,
    dense_knots,
    length_of,
    positions_at,
)

FRACTIONS = (0.0, 0.13, 0.5, 0.77, 1.0)


class Kinds(PathTestCase):
    def assertFollows(self, points, **keywords):
        """A follower goes along the densely sampled curve by equal lengths."""
        car = self.follow(timing='MANUAL', **keywords)
        for fraction, wanted in zip(FRACTIONS, positions_at(points, FRACTIONS)):
            car.motus.path.distance_factor = fraction
            self.assertIsNone(self.sentence(car))
            self.assertPlace(car, wanted)
        self.assertAlmostEqual(self.output(car, "length"), length_of(points), delta=1e-6 * length_of(points))
        return car

    def test_cubic(self):
        self.cubic()
        self.assertFollows(dense(CLIMB))

    def test_several_segments(self):
        knots = [((-1, 0, 0), (0, 0, 0), (2, 0, 1)), ((3, 4, 0), (4, 4, 0), (6, 4, 0)), ((8, 0, 3), (8, 1, 3), (8, 2, 3))]
        self.bezier(knots)
        self.assertFollows(dense_knots(knots))

    def test_cyclic(self):
        knots = circle_knots()
        self.bezier(knots, cyclic=True)
        self.assertFollows(dense_knots(knots, cyclic=True))

    def test_poly(self):
        corners = [(0, 0, 0), (4, 0, 0), (4, 3, 0), (4, 3, 5)]
        self.points('POLY', corners)
        car = self.assertFollows(dense(*itertools.pairwise(corners)))
        self.assertAlmostEqual(self.output(car, "length"), 12.0, places=5)

    def test_cyclic_poly(self):
        corners = [(0, 0, 0), (4, 0, 0), (4, 3, 0)]
        self.points('POLY', corners, use_cyclic_u=True)
        self.assertFollows(dense(*zip(corners, corners[1:] + corners[:1])))

    def test_nurbs_is_the_exact_b_spline(self):
        points = np.array([(0, 0, 0), (2, 0, 1), (3, 4, 0), (6, 5, 2), (8, 1, 1), (9, 3, 0)], float)
        self.points('NURBS', points, order_u=4, use_endpoint_u=False)
        basis = np.array([[1, 4, 1, 0], [-3, 0, 3, 0], [3, -6, 3, 0], [-1, 3, -3, 1]]) / 6.0
        t = np.linspace(0.0, 1.0, 50001)
        powers = np.stack([t**power for power in range(4)], axis=1)
        self.assertFollows(np.concatenate([powers @ basis @ points[i : i + 4] for i in range(len(points) - 3)]))

    def test_nurbs_through_its_ends(self):
        self.points('NURBS', CLIMB, order_u=4, use_endpoint_u=True)
        self.assertFollows(dense(CLIMB))

    def test_bezier_of_high_degree(self):
        points = [(i, 4.0 * math.sin(2.0 * i), 3.0 * math.cos(1.7 * i)) for i in range(13)]
        curve = self.points('POLY', points)
        curve.data["motus_bezier"] = True
        self.assertFollows(dense(points))

    def test_chosen_spline_and_all_of_them(self):
        data = curve_data()
        first, second = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)], [(0, 5, 0), (0, 6, 3), (2, 8, 1), (7, 5, 0)]
        add_bezier(data, cubic_knots(first))
        add_bezier(data, cubic_knots(second))
        add_points(data, 'POLY', [(9, 0, 0), (9, 0, 4)])
        self.link("Course", data)
        self.assertFollows(dense(second), spline=1)
        car = self.follow(spline=-1, orientation='MINIMAL')
        total = 3.0 + length_of(dense(second)) + 4.0
        self.assertAlmostEqual(self.output(car, "length"), total, delta=1e-6 * total)
        car.motus.path.distance_factor = 1.5 / total
        self.assertPlace(car, np.array((1.5, 0.0, 0.0)), tolerance=1e-6)
        car.motus.path.distance_factor = (total - 1.0) / total
        self.assertPlace(car, np.array((9.0, 0.0, 3.0)), tolerance=1e-6)

    def test_dots_among_splines_are_passed_over(self):
        """Splines of one point have no length, of whatever kind and wherever they stand; a doubled point has none either."""
        data = curve_data()
        add_points(data, 'POLY', [(-3, 0, 0)])
        add_points(data, 'POLY', [(0, 0, 0), (10, 0, 0)])
        add_points(data, 'NURBS', [(10, 0, 0)])
        add_bezier(data, [((4, 4, 4), (5, 5, 5), (6, 6, 6))])
        add_points(data, 'POLY', [(10, 0, 0), (10, 0, 0)])
        add_points(data, 'POLY', [(10, 0, 0), (10, 10, 0)])
        add_points(data, 'POLY', [(0, 0, 3)])
        self.link("Course", data)
        car = self.follow(spline=-1, timing='MANUAL')
        self.assertIsNone(self.sentence(car))
        self.assertAlmostEqual(self.output(car, "length"), 20.0, places=5)
        for fraction, wanted in ((0.0, (0, 0, 0)), (0.25, (5, 0, 0)), (0.75, (10, 5, 0)), (1.0, (10, 10, 0))):
            car.motus.path.distance_factor = fraction
            self.assertPlace(car, np.array(wanted, float), tolerance=1e-6)

    def test_a_dot_beside_a_closed_curve(self):
        data = curve_data()
        add_points(data, 'POLY', [(0, 0, 0), (4, 0, 0), (4, 4, 0)], use_cyclic_u=True)
        add_points(data, 'POLY', [(9, 9, 9)])
        self.link("Course", data)
        self.assertEqual(self.follow(spline=-1).motus.path.extend, 'LOOP')

    def test_flat_curve(self):
        curve = self.cubic([(x, y, 0.0) for x, y, _ in CLIMB])
        curve.data.dimensions = '2D'
        self.assertFollows(dense([(x, y, 0.0) for x, y, _ in CLIMB]))


class Refusals(PathTestCase):
    """What cannot be followed is said in a sentence, and the object stands at its own transform."""

    def assertSentence(self, part, **keywords):
        car = self.link("Car")
        car.location = 7.0, 8.0, 9.0
        self.follow(**keywords)
        self.assertIn(part, self.sentence(car) or "")
        self.assertPlace(car, np.array((7.0, 8.0, 9.0)))
        return car

    def test_rational_nurbs(self):
        self.points('NURBS', CLIMB, weights=[1.0, 2.0, 1.0, 1.0])
        self.assertSentence("different weights")

    def test_equal_weights_are_not_rational(self):
        self.points('NURBS', CLIMB, weights=[2.0] * 4, use_endpoint_u=True)
        self.assertIsNone(self.sentence(self.follow()))

    def test_high_order(self):
        self.points('NURBS', [(i, 0, 0) for i in range(9)], order_u=7)
        self.assertSentence("order above 6")

    def test_no_splines(self):
        data = self.cubic().data
        car = self.follow()
        data.splines.clear()
        self.assertIn("no splines", self.sentence(car, 2))
        self.link("Other")
        self.assertRefused("no splines", bpy.ops.motus.path_follow_add, object="Other", curve="Course")
        self.assertFalse(bpy.data.objects["Other"].motus.path.is_active)

    def test_spline_of_one_point(self):
        curve = self.points('POLY', [(1, 2, 3)])
        car = self.assertSentence("two points")
        add_points(curve.data, 'POLY', [(3, 2, 1)])
        car.motus.path.spline = -1
        self.assertIn("two points", self.sentence(car) or "")

    def test_spline_index_beyond_the_last(self):
        self.cubic()
        car = self.follow()
        car.motus.path.spline = 1
        self.assertIn("no spline of this index", self.sentence(car))
        car.motus.path.spline = 0
        self.assertIsNone(self.sentence(car))
        add = bpy.ops.motus.path_follow_add
        self.assertRefused("no spline of this index", add, object="Car", curve="Course", spline=1, speed=2.0)
        self.assertEqual((car.motus.path.spline, car.motus.path.speed), (0, 5.0))

    def test_too_many_control_points(self):
        self.points('POLY', [(i, 0, 0) for i in range(66)]).data["motus_bezier"] = True
        self.assertSentence("more than 65")

    def test_curve_taken_out_of_the_scene(self):
        curve = self.cubic()
        car = self.follow()
        self.assertIsNone(self.sentence(car, 10))
        self.scene.collection.objects.unlink(curve)
        self.assertIn("in no collection", self.sentence(car, 11))
        self.scene.collection.objects.link(curve)
        self.assertIsNone(self.sentence(car, 12))

    def test_curve_that_came_along_with_an_appended_follower(self):
        self.line(10.0, "Brought Along")
        self.follow("Brought Car", "Brought Along", timing='MANUAL', distance_factor=0.5)
        library = str(self.folder / "library.blend")
        bpy.ops.wm.save_as_mainfile(filepath=library, copy=True)
        code = (
            "import bpy\n"
            "from path import path_cases\n"
            "case = path_cases.PathTestCase()\n"
            "case.setUp()\n"
            f"with bpy.data.libraries.load({library!r}) as (_, chosen):\n"
            "    chosen.objects = ['Brought Car']\n"
            "car, = chosen.objects\n"
            "case.scene.collection.objects.link(car)\n"
            "assert not car.motus.path.curve.users_collection\n"
            "assert case.sentence(car) is None, case.sentence(car)\n"
            "assert abs(case.place(car)[0] - 5.0) < 1e-5, case.place(car)\n"
            "curve = car.motus.path.curve\n"
            "case.scene.collection.objects.link(curve)\n"
            "case.at(car, 2)\n"
            "case.scene.collection.objects.unlink(curve)\n"
            "assert 'no collection' in case.sentence(car, 3)\n"
        )
        status, output = support.run_beside(code)
        self.assertEqual(status, 0, output)

    def test_deleted_and_undone(self):
        curve = self.line(10.0, "Undone Curve")
        car = self.follow("Car", "Undone Curve", timing='MANUAL', distance_factor=0.5)
        self.at(car)
        bpy.ops.ed.undo_push(message="before")
        with bpy.context.temp_override(selected_objects=[curve]):
            bpy.ops.object.delete()
        bpy.ops.ed.undo_push(message="deleted")
        car = bpy.data.objects["Car"]
        self.assertIn("in no collection", self.sentence(car, 11))
        bpy.ops.ed.undo()
        self.scene = bpy.context.scene
        car = bpy.data.objects["Car"]
        self.assertIsNone(self.sentence(car, 12))
        self.assertPlace(car, np.array((5.0, 0.0, 0.0)))

    def test_curve_removed_from_the_file(self):
        curve = self.cubic()
        car = self.follow()
        bpy.data.objects.remove(curve)
        self.assertIn("Choose a curve", self.sentence(car, 11))
        self.assertPlace(car, np.zeros(3))

    def test_curve_of_no_length_is_its_point(self):
        self.cubic([(1.0, 2.0, 3.0)] * 4)
        car = self.follow(orientation='BANKING')
        self.assertIsNone(self.sentence(car, 30))
        self.assertPlace(car, np.array((1.0, 2.0, 3.0)))
        self.assertEqual(self.output(car, "fraction"), 0.0)


class Moved(PathTestCase):
    """The curve as it stands in the world at the frame."""

    def assertFollowsMatrix(self, car, matrix, frame=None, points=CLIMB, fraction=0.4):
        world = [matrix @ p for p in map(_vector, points)]
        car.motus.path.distance_factor = fraction
        self.assertPlace(car, positions_at(dense(world), fraction)[0], frame, tolerance=4e-7)

    def test_length_is_measured_in_the_world(self):
        curve = self.cubic()
        car = self.follow(timing='MANUAL')
        curve.matrix_world = Matrix.LocRotScale((3.0, -2.0, 1.0), Matrix.Rotation(0.7, 3, 'X'), (4.0, 0.3, -1.5))
        self.assertFollowsMatrix(car, self.at(curve))
        self.assertAlmostEqual(self.output(car, "length"), length_of(dense([self.at(curve) @ p for p in map(_vector, CLIMB)])), delta=1e-4)

    def test_parented_curve(self):
        curve, carrier = self.cubic(), self.link("Carrier")
        curve.parent = carrier
        carrier.rotation_euler = 0.3, 0.2, 1.0
        carrier.keyframe_insert("location", frame=1)
        carrier.location = 10.0, 5.0, 2.0
        carrier.keyframe_insert("location", frame=41)
        car = self.follow(timing='MANUAL')
        for frame in (33, 7, 20.25):
            self.assertFollowsMatrix(car, self.at(curve, frame))

    def test_keyed_points(self):
        curve = self.line(9.0)
        point = curve.data.splines[0].bezier_points[1]
        for frame, end in ((1, 9.0), (21, 29.0)):
            point.handle_left, point.co = (2.0 * end / 3.0, 0.0, 0.0), (end, 0.0, 0.0)
            curve.data.keyframe_insert("splines[0].bezier_points[1].co", frame=frame)
            curve.data.keyframe_insert("splines[0].bezier_points[1].handle_left", frame=frame)
        car = self.follow(timing='MANUAL', distance_factor=1.0)
        for frame in (21, 1, 11):
            end = self.place(car, frame)[0]
            self.assertAlmostEqual(end, {1: 9.0, 11: 19.0, 21: 29.0}[frame], places=4)

    def test_hooked_point(self):
        curve, hook = self.line(9.0), self.link("Hook")
        hook.location = 9.0, 0.0, 0.0
        bpy.context.view_layer.update()
        modifier = curve.modifiers.new("Hook", 'HOOK')
        modifier.object = hook
        modifier.vertex_indices_set([3, 4, 5])
        modifier.matrix_inverse = hook.matrix_world.inverted()
        hook.keyframe_insert("location", frame=1)
        hook.location = 9.0, 0.0, 20.0
        hook.keyframe_insert("location", frame=21)
        car = self.follow(timing='MANUAL', distance_factor=1.0)
        for frame in (21, 1, 11, 15.5):
            self.assertPlace(car, self.place(hook, frame), frame)

    def test_shape_key(self):
        curve = self.line(9.0)
        curve.shape_key_add(name="Basis")
        key = curve.shape_key_add(name="Lift")
        key.data[1].co = 9.0, 0.0, 10.0
        key.driver_add("value").driver.expression = "(frame-1)/20"
        car = self.follow(timing='MANUAL', distance_factor=1.0)
        for frame, height in ((21, 10.0), (1, 0.0), (11, 5.0)):
            self.assertPlace(car, np.array((9.0, 0.0, height)), frame)

    def test_follows_while_points_are_edited(self):
        curve = self.line(9.0)
        car = self.follow(timing='MANUAL', distance_factor=1.0)
        self.assertPlace(car, np.array((9.0, 0.0, 0.0)))
        curve.data.splines[0].bezier_points[1].co = 9.0, 4.0, 0.0
        self.assertPlace(car, np.array((9.0, 4.0, 0.0)))


class NewBezier(PathTestCase):
    def test_degree(self):
        bpy.ops.motus.path_new_bezier(degree=7)
        curve = bpy.context.object
        points = [point.co[:3] for point in curve.data.splines[0].points]
        self.assertEqual(len(points), 8)
        car = self.follow(curve=curve.name, timing='MANUAL')
        car.motus.path.distance_factor = 0.3
        self.assertPlace(car, positions_at(dense(points), 0.3)[0])

    def test_stands_at_the_cursor(self):
        self.scene.cursor.location = 4.0, 5.0, 6.0
        bpy.ops.motus.path_new_bezier(degree=2)
        self.assertEqual(tuple(bpy.context.object.location), (4.0, 5.0, 6.0))

    def test_objects_are_the_control_points(self):
        names = []
        for index, place in enumerate(CLIMB + [(-3.0, 2.0, 5.0)]):
            handle = self.link(f"Handle {index}")
            handle.location = place
            handle.rotation_euler = index, 0.0, 0.0
            names.append(handle.name)
        bpy.ops.motus.path_new_bezier(objects=",".join(names))
        car = self.follow(curve=bpy.context.object.name, timing='MANUAL', distance_factor=0.35)
        for moved in (None, (9.0, 9.0, -4.0)):
            if moved:
                bpy.data.objects["Handle 2"].location = moved
            points = [tuple(bpy.data.objects[name].location) for name in names]
            self.assertPlace(car, positions_at(dense(points), 0.35)[0], tolerance=1e-6)

    def test_objects_of_a_collection(self):
        collection = bpy.data.collections.new("Handles")
        self.scene.collection.children.link(collection)
        for index in range(4):
            handle = bpy.data.objects.new(f"Handle {index}", None)
            handle.location = CLIMB[index]
            collection.objects.link(handle)
        bpy.ops.motus.path_new_bezier(objects="Handles")
        self.assertEqual(len(bpy.context.object.modifiers), 4)

    def test_refuses_what_is_no_curve(self):
        self.link("Alone")
        self.assertRefused("2 to 65", bpy.ops.motus.path_new_bezier, objects="Alone")
        self.assertRefused("no object Nobody", bpy.ops.motus.path_new_bezier, objects="Alone,Nobody")


class Truth(PathTestCase):
    """The truth that the other tests measure against."""

    def test_positions_at(self):
        line = bernstein([(0, 0, 0), (3, 4, 0)], np.linspace(0.0, 1.0, 11))
        self.assertLess(np.abs(positions_at(line, 0.25)[0] - (0.75, 1.0, 0.0)).max(), 1e-15)


def _vector(point):
    from mathutils import Vector

    return Vector(point)
