"""motus.pick_pull moves vertices as its definition says: falloffs, directions, limits, mirror images."""

import math

import bpy
import numpy as np

from pull.pull_cases import FORMULAS, PullTestCase, forces


class Falloffs(PullTestCase):
    def test_each_against_its_formula(self):
        for falloff in FORMULAS:
            with self.subTest(falloff=falloff):
                obj = self.plane(name=falloff)
                root = self.middle(obj)
                distances = np.linalg.norm(self.places(obj), axis=1)
                moved = self.moved_by(obj, vertex=root, radius=0.73, strength=0.5, falloff=falloff)
                wanted = 0.5 * forces(falloff, distances, 0.73)
                self.assertGreater(np.count_nonzero(wanted), 100)
                self.assertNear(moved, np.outer(wanted, (0.0, 0.0, 1.0)))
                self.assertTrue(np.array_equal(moved[distances >= 0.73], np.zeros_like(moved[distances >= 0.73])))

    def test_classic_compares_the_squared_distance(self):
        for factor in (0.0, 1.5, -1.5):
            with self.subTest(factor=factor):
                obj = self.plane()
                squares = (self.places(obj) ** 2).sum(axis=1)
                moved = self.moved_by(obj, vertex=self.middle(obj), radius=0.515, strength=0.5, falloff='CLASSIC', scale_factor=factor)
                wanted = np.where(squares < 0.515, (1.0 - squares / 1.515) ** (1.0 + abs(factor)), 0.0)
                self.assertGreater(np.sqrt(squares[wanted > 0.0]).max(), 0.6)
                self.assertNear(moved[:, 2], 0.5 * wanted)

    def test_own_curve_of_the_scene(self):
        self.brush.falloff = 'CURVE'
        curve = self.brush.curve_nodes.nodes[0].mapping
        obj = self.plane()
        distances = np.linalg.norm(self.places(obj), axis=1)
        t = np.clip(1.0 - distances / 0.8, 0.0, 1.0)
        moved = self.moved_by(obj, vertex=self.middle(obj), radius=0.8, strength=1.0)
        # As it is made, the curve is close to the smooth falloff.
        self.assertNear(moved[:, 2], 3 * t**2 - 2 * t**3, 0.03)
        for point in curve.curves[0].points:
            point.location = point.location[0], 1.0 - point.location[0]
        curve.update()
        obj = self.plane()
        moved = self.moved_by(obj, vertex=self.middle(obj), radius=0.8, strength=1.0)
        self.assertNear(moved[:, 2], np.where(distances < 0.8, 1.0 - t, 0.0), 1e-3)

    def test_curve_as_a_keyword(self):
        obj = self.plane()
        t = np.clip(1.0 - np.linalg.norm(self.places(obj), axis=1) / 0.8, 0.0, 1.0)
        samples = np.linspace(0.0, 1.0, 32) ** 3
        moved = self.moved_by(obj, vertex=self.middle(obj), radius=0.8, strength=1.0, falloff='CURVE', curve=tuple(samples))
        self.assertNear(moved[:, 2], np.where(t > 0.0, np.interp(t, np.linspace(0.0, 1.0, 32), samples), 0.0))

    def test_without_a_curve_it_is_that_of_the_scene(self):
        """Whatever falloff the scene's brush has now; smooth, as a new curve is, where there is none. For pins too."""

        def moved(kind):
            obj = self.plane()
            if kind == 'PULL':
                return self.moved_by(obj, vertex=220, radius=0.8, displacement=(0.0, 0.0, 1.0), falloff='CURVE')[:, 2]
            bpy.ops.motus.pin_add(vertex=220, radius=0.8, displacement=(0.0, 0.0, 1.0), falloff='CURVE')
            return self.seen(obj)[:, 2]

        t = np.clip(1.0 - np.linalg.norm(self.places(self.plane()), axis=1) / 0.8, 0.0, 1.0)
        for kind in ('PULL', 'PIN'):
            self.assertNear(moved(kind), 3 * t**2 - 2 * t**3, 2e-3)
        self.brush.falloff = 'CURVE'
        curve = self.brush.curve_nodes.nodes[0].mapping
        for point in curve.curves[0].points:
            point.location = point.location[0], 1.0 - point.location[0]
        curve.update()
        self.brush.falloff = 'LINEAR'
        for kind in ('PULL', 'PIN'):
            self.assertNear(moved(kind), np.where(t > 0.0, 1.0 - t, 0.0), 1e-3)

    def test_defaults_are_those_of_the_scene(self):
        self.brush.falloff, self.brush.radius, self.brush.strength = 'LINEAR', 0.4, 0.3
        obj = self.plane()
        distances = np.linalg.norm(self.places(obj), axis=1)
        moved = self.moved_by(obj, vertex=self.middle(obj))
        self.assertNear(moved[:, 2], 0.3 * forces('LINEAR', distances, 0.4))


class Distances(PullTestCase):
    def test_surface_on_a_folded_sheet(self):
        """Two leaves 0.05 apart that hang together at x = 2 only: near in space, far on the surface."""
        count, spacing = 41, 0.05
        line = np.arange(count) * spacing
        upper = [(x, y, 0.0) for y in line for x in line]
        lower = [(x, y, -0.05) for y in line for x in line]
        faces = []
        for row in range(count - 1):
            for column in range(count - 1):
                corner = row * count + column
                quad = (corner, corner + 1, corner + count + 1, corner + count)
                faces += [quad, tuple(count * count + index for index in reversed(quad))]
            last = row * count + count - 1
            faces.append((last, last + count * count, last + count + count * count, last + count))
        obj = self.mesh(upper + lower, faces)
        places = self.places(obj)
        root = 20 * count + 20
        straight = np.linalg.norm(places - places[root], axis=1)
        moved = self.moved_by(obj, vertex=root, radius=0.5, strength=0.3, falloff='LINEAR', distance='SURFACE', direction='Z')
        is_upper = np.arange(len(places)) < count * count
        self.assertEqual(np.count_nonzero(moved[~is_upper]), 0)
        self.assertNear(moved[is_upper, 2], 0.3 * forces('LINEAR', straight, 0.5)[is_upper], 0.02 * 0.3)
        moved = self.moved_by(obj, vertex=root, radius=0.5, strength=0.3, direction='Z')
        self.assertGreater(np.count_nonzero(moved[~is_upper]), 50)

    def test_surface_on_a_sphere(self):
        obj = self.ball(5)
        places = self.places(obj)
        root = int(places[:, 2].argmax())
        angles = np.arccos(np.clip(places @ places[root], -1.0, 1.0))
        moved = self.moved_by(obj, vertex=root, radius=1.0, strength=1.0, falloff='LINEAR', distance='SURFACE', direction='X')
        found = 1.0 - moved[angles < 0.95, 0]
        self.assertNear(found, angles[angles < 0.95], 0.02)

    def test_edges_are_counted(self):
        count = 21
        obj = self.plane(count)
        row, column = np.divmod(np.arange(count * count), count)
        steps = np.abs(row - 10) + np.abs(column - 10)
        moved = self.moved_by(obj, vertex=self.middle(obj), radius=4.0, strength=0.5, falloff='LINEAR', distance='EDGES', direction='Z')
        self.assertNear(moved[:, 2], 0.5 * forces('LINEAR', steps.astype(float), 4.0))


class Directions(PullTestCase):
    def test_normal_of_the_root(self):
        obj = self.ball(4)
        root = 37
        normal = np.array(obj.data.vertices[root].normal)
        moved = self.moved_by(obj, vertex=root, radius=0.5, strength=0.2)
        self.assertNear(moved[root], 0.2 * normal)
        away = moved[np.linalg.norm(moved, axis=1) > 1e-4]
        self.assertGreater(len(away), 20)
        self.assertNear(away / np.linalg.norm(away, axis=1)[:, None], np.tile(normal, (len(away), 1)), 1e-3)

    def test_axes_and_negative_strength(self):
        for axis, name in enumerate('XYZ'):
            obj = self.ball(2)
            moved = self.moved_by(obj, vertex=5, radius=0.4, strength=-0.2, direction=name)
            self.assertNear(moved[5], -0.2 * np.eye(3)[axis])

    def test_displacement_instead(self):
        obj = self.plane()
        distances = np.linalg.norm(self.places(obj), axis=1)
        moved = self.moved_by(obj, vertex=self.middle(obj), radius=0.5, displacement=(0.1, -0.2, 0.3), strength=9.0)
        self.assertNear(moved, np.outer(forces('SMOOTH', distances, 0.5), (0.1, -0.2, 0.3)))

    def test_location_takes_the_nearest_vertex(self):
        obj = self.plane()
        root = 7 * 21 + 4
        place = self.places(obj)[root]
        moved = self.moved_by(obj, location=place + (0.03, -0.04, 0.02), radius=0.08, strength=0.1)
        self.assertEqual(np.flatnonzero(moved.any(axis=1)).tolist(), [root])

    def test_a_loose_vertex_has_no_normal(self):
        self.mesh([(0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (1.0, 0.0, 0.0)])
        self.assertRefused("no normal", vertex=0)
        self.assertNear(
            self.moved_by(bpy.context.object, vertex=0, radius=0.5, strength=0.2, direction='Z', falloff='CONSTANT')[:, 2], (0.2, 0.2, 0.0)
        )


class Limits(PullTestCase):
    def test_heights_are_clamped_where_it_moves(self):
        obj = self.plane()
        distances = np.linalg.norm(self.places(obj), axis=1)
        moved = self.moved_by(obj, vertex=self.middle(obj), radius=0.7, strength=0.5, use_maximum=True, maximum=0.2)
        self.assertNear(moved[:, 2], np.minimum(0.5 * forces('SMOOTH', distances, 0.7), 0.2))
        moved = self.moved_by(obj, vertex=220, radius=0.7, strength=-0.9, direction='Z', use_minimum=True, minimum=-0.1)
        self.assertAlmostEqual(self.places(obj)[:, 2].min(), -0.1, places=6)

    def test_along_another_axis(self):
        obj = self.plane()
        before = self.places(obj)
        self.pull(vertex=220, radius=0.75, displacement=(0.5, 0.0, 0.0), use_maximum=True, maximum=0.3, clamp_axis='X', falloff='CONSTANT')
        is_near = np.linalg.norm(before, axis=1) < 0.75
        self.assertNear(self.places(obj)[:, 0], np.where(is_near, np.minimum(before[:, 0] + 0.5, 0.3), before[:, 0]))

    def test_in_the_world_of_a_turned_object(self):
        """The world's height is none of the object's axes there."""
        obj = self.plane(41)
        obj.rotation_euler = 0.6, -0.4, 0.2
        obj.scale = 1.0, 2.0, 0.5
        obj.location = 0.0, 0.0, 5.0
        before = self.in_world(obj, self.places(obj))
        root = self.middle(obj)
        self.pull(vertex=root, radius=1.5, strength=2.0, direction='Z', use_maximum=True, maximum=5.8, falloff='LINEAR')
        after = self.in_world(obj, self.places(obj))
        distances = np.linalg.norm(before - before[root], axis=1)
        heights = before[:, 2] + 2.0 * forces('LINEAR', distances, 1.5)
        self.assertGreater(np.count_nonzero(heights > 5.8), 20)
        wanted = np.where(distances < 1.5, np.minimum(heights, 5.8), before[:, 2])
        self.assertNear(after[:, 2], wanted, 1e-5)
        self.assertNear(after[:, :2], before[:, :2], 1e-5)


class Mirrors(PullTestCase):
    def test_both_sides_alike(self):
        obj = self.plane()
        places = self.places(obj)
        moved = self.moved_by(obj, vertex=10 * 21 + 15, radius=0.8, displacement=(0.1, 0.05, 0.2), mirror={'X'})
        image = [int(np.linalg.norm(places - place * (-1.0, 1.0, 1.0), axis=1).argmin()) for place in places]
        self.assertNear(moved[image], moved * (-1.0, 1.0, 1.0))
        self.assertNear(moved[10 * 21 + 10, 0], 0.0)
        self.assertNear(moved[10 * 21 + 5], (-0.1, 0.05, 0.2), 0.2)

    def test_at_the_plane_of_symmetry_it_acts_once(self):
        obj = self.plane()
        moved = self.moved_by(obj, vertex=220, radius=0.5, strength=0.3, mirror={'X', 'Y'})
        self.assertNear(moved[220], (0.0, 0.0, 0.3))

    def test_over_two_axes(self):
        obj = self.plane()
        moved = self.moved_by(obj, vertex=15 * 21 + 15, radius=0.15, strength=0.3, mirror={'X', 'Y'})
        for row, column in ((15, 15), (15, 5), (5, 15), (5, 5)):
            self.assertNear(moved[row * 21 + column, 2], 0.3)
        self.assertEqual(np.count_nonzero(moved[:, 2] > 0.29), 4)

    def test_along_the_surface_and_by_edges(self):
        for distance, radius in (('SURFACE', 0.3), ('EDGES', 3.0)):
            with self.subTest(distance=distance):
                obj = self.plane()
                moved = self.moved_by(obj, vertex=10 * 21 + 16, radius=radius, strength=0.3, mirror={'X'}, distance=distance)
                rows = moved.reshape(21, 21, 3)
                self.assertNear(rows[:, ::-1, 2], rows[:, :, 2], 1e-5)
                self.assertNear(rows[10, 4, 2], 0.3)

    def test_on_a_sheared_object(self):
        """A scaled parent of a turned child: the object's axes are not square, and its images still alike in it."""
        parent = bpy.data.objects.new("Parent", None)
        self.scene.collection.objects.link(parent)
        parent.scale = 1.0, 3.0, 1.0
        obj = self.plane()
        obj.parent, obj.rotation_euler = parent, (0.0, 0.0, math.radians(30.0))
        moved = self.moved_by(obj, vertex=10 * 21 + 16, radius=0.6, strength=0.3, mirror={'X'}, direction='Z')
        rows = moved.reshape(21, 21, 3)
        self.assertGreater(np.count_nonzero(rows[:, :, 2]), 10)
        self.assertNear(rows[:, ::-1, 2], rows[:, :, 2], 1e-5)
