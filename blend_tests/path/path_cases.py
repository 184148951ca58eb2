"""What the tests of Follow Path share: curves of every kind, their exact points, and where an object really is."""

import math

import bpy
import numpy as np

import support

CLIMB = [(0.0, 0.0, 0.0), (6.0, 0.0, 2.0), (6.0, 6.0, 4.0), (0.0, 6.0, 1.0)]
"""Control points of one cubic that bends and climbs."""

STATION_COUNT = 200001


class PathTestCase(support.SceneTestCase):
    """An empty scene at 24 frames a second."""

    def setUp(self):
        super().setUp()
        self.scene = bpy.context.scene
        self.scene.render.fps = 24
        self.system = support.addon("path").SYSTEM
        self.wiring = support.addon("core.wiring")

    def bezier(self, knots, name="Course", cyclic=False):
        """A curve through knots (left handle, point, right handle)."""
        data = curve_data(name)
        add_bezier(data, knots, cyclic)
        return self.link(name, data)

    def cubic(self, points=CLIMB, name="Course"):
        return self.bezier(cubic_knots(points), name)

    def line(self, length=10.0, name="Course"):
        """A straight cubic along X, its points spread evenly, so that t is the fraction of the length."""
        return self.cubic([(length * i / 3.0, 0.0, 0.0) for i in range(4)], name)

    def points(self, kind, points, name="Course", weights=None, **options):
        data = curve_data(name)
        add_points(data, kind, points, weights, **options)
        return self.link(name, data)

    def follow(self, name="Car", curve="Course", **keywords):
        """An object that follows the curve; made where there is none."""
        obj = bpy.data.objects.get(name) or self.link(name)
        self.assertEqual(bpy.ops.motus.path_follow_add(object=name, curve=curve, **keywords), {'FINISHED'})
        return obj

    def at(self, obj, frame=None):
        """Evaluated world matrix, at a frame."""
        if frame is not None:
            self.go_to(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        return obj.evaluated_get(depsgraph).matrix_world.copy()

    def place(self, obj, frame=None):
        return np.array(self.at(obj, frame).translation)

    def output(self, obj, name, frame=None):
        self.at(obj, frame)
        return self.wiring.output(self.system, obj, name, bpy.context.evaluated_depsgraph_get())

    def sentence(self, obj, frame=None):
        """What the solver says about the object; None where all is well."""
        self.at(obj, frame)
        problem = self.wiring.problem(self.system, obj, bpy.context.evaluated_depsgraph_get())
        return problem and problem.sentence

    def assertPlace(self, obj, wanted, frame=None, tolerance=2e-7):
        """Where the object is, to a share of the largest coordinate (single precision)."""
        found = self.place(obj, frame)
        largest = max(1.0, np.abs(wanted).max())
        self.assertLessEqual(np.abs(found - wanted).max(), tolerance * largest, f"{found} instead of {wanted}")


def curve_data(name="Course"):
    data = bpy.data.curves.new(name, 'CURVE')
    data.dimensions = '3D'
    return data


def add_bezier(data, knots, cyclic=False):
    spline = data.splines.new('BEZIER')
    spline.bezier_points.add(len(knots) - 1)
    for point, (left, middle, right) in zip(spline.bezier_points, knots):
        point.handle_left_type = point.handle_right_type = 'FREE'
        point.handle_left, point.co, point.handle_right = left, middle, right
    spline.use_cyclic_u = cyclic
    return spline


def add_points(data, kind, points, weights=None, **options):
    """A POLY or NURBS spline; options: properties of the spline."""
    spline = data.splines.new(kind)
    spline.points.add(len(points) - 1)
    for index, (point, position) in enumerate(zip(spline.points, points)):
        point.co = (*position, weights[index] if weights else 1.0)
    for name, value in options.items():
        setattr(spline, name, value)
    return spline


def cubic_knots(points):
    first, second, third, last = points
    return [(first, first, second), (third, last, last)]


def circle_knots(radius=5.0):
    """Four knots of a near circle in the XY plane, anticlockwise."""
    handle = radius * 4.0 / 3.0 * (math.sqrt(2.0) - 1.0)
    knots = []
    for quarter in range(4):
        angle = quarter * math.pi / 2.0
        out = np.array((math.cos(angle), math.sin(angle), 0.0))
        along = np.array((-math.sin(angle), math.cos(angle), 0.0))
        knots.append(tuple(tuple(radius * out + side * handle * along) for side in (-1.0, 0.0, 1.0)))
    return knots


def bernstein(points, t):
    """Points of a Bézier curve of any degree at t (m,), by de Casteljau."""
    rows = np.repeat(np.asarray(points, float)[:, None, :], len(t), axis=1)
    while len(rows) > 1:
        rows = (1.0 - t)[None, :, None] * rows[:-1] + t[None, :, None] * rows[1:]
    return rows[0]


def dense(*segments):
    """Many points of a chain of Bézier segments, for positions_at()."""
    t = np.linspace(0.0, 1.0, STATION_COUNT)
    return np.concatenate([bernstein(segment, t) for segment in segments])


def dense_knots(knots, cyclic=False):
    """The same of a Blender spline's knots."""
    pairs = list(zip(knots, knots[1:] + knots[:1] if cyclic else knots[1:]))
    return dense(*[(here[1], here[2], there[0], there[1]) for here, there in pairs])


def positions_at(points, fractions):
    """Positions at fractions of the length of a densely sampled curve: chords, an error of about 1e-9 of it."""
    stations = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    goal = np.atleast_1d(fractions) * stations[-1]
    return np.column_stack([np.interp(goal, stations, points[:, axis]) for axis in range(3)])


def length_of(points):
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def axis(matrix, letter):
    """Unit axis of a matrix, such as "Y" or "-Z"."""
    column = np.array(matrix.to_quaternion().to_matrix().col["XYZ".index(letter[-1])])
    return -column if letter[0] == "-" else column
