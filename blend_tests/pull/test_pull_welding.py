"""Weld distance: pulls and pins on loose triangles act as on the joined mesh, and gaps stay closed."""

import bpy
import numpy as np

import support
from pull import pull_cases
from pull.pull_cases import PullTestCase

WELD = 1e-3


class WeldingTestCase(PullTestCase):
    def joined(self, count=13, spacing=0.1):
        """A bumpy sheet, count x count vertices."""
        obj = self.plane(count, spacing, name="Joined")
        for vertex in obj.data.vertices:
            vertex.co.z = 0.2 * np.sin(3.0 * vertex.co.x) * np.cos(2.0 * vertex.co.y)
        return obj

    def scan(self, joined, gap=0.0):
        """The triangles of a mesh, each with vertices of its own, moved apart by up to a gap; and which vertex each one comes of."""
        joined.data.calc_loop_triangles()
        corners = np.array([triangle.vertices[:] for triangle in joined.data.loop_triangles])
        origin = corners.ravel()
        random = np.random.default_rng(1)
        places = self.places(joined)[origin] + random.uniform(-gap, gap, (len(origin), 3)) / 2.0 / np.sqrt(3.0)
        return self.mesh(places, np.arange(len(origin)).reshape(-1, 3), name="Scan"), origin

    def pull(self, obj, **keywords):
        values = {"location": (0.3, 0.1, 0.0), "displacement": (0.1, 0.0, 0.4), "radius": 0.45, **keywords}
        self.assertEqual(bpy.ops.motus.pick_pull(object=obj.name, **values), {'FINISHED'})


class Pulls(WeldingTestCase):
    def test_a_scan_is_pulled_as_the_joined_mesh(self):
        for keywords in (
            {"distance": 'SURFACE'},
            {"distance": 'STRAIGHT'},
            {"distance": 'EDGES', "radius": 3.0},
            {"distance": 'SURFACE', "mirror": {'X'}},
            {"distance": 'SURFACE', "mirror": {'X', 'Y'}, "use_maximum": True, "maximum": 0.3},
        ):
            with self.subTest(**keywords):
                joined = self.joined()
                scan, origin = self.scan(joined)
                root = int(np.linalg.norm(self.places(joined) - (0.3, 0.1, 0.0), axis=1).argmin())
                self.pull(joined, vertex=root, **keywords)
                self.pull(scan, vertex=int(np.flatnonzero(origin == root)[-1]), weld=WELD, **keywords)
                if keywords["distance"] == 'EDGES':  # the scan's triangles have diagonals, which the joined mesh's squares have not
                    self.assert_closed(scan, origin)
                    continue
                np.testing.assert_allclose(self.places(scan), self.places(joined)[origin], atol=1e-6)

    def test_gaps_stay_as_they_are(self):
        scan, origin = self.scan(self.joined(), gap=WELD)
        before = self.places(scan)
        self.pull(scan, distance='SURFACE', weld=WELD)
        moved = self.places(scan) - before
        self.assertGreater((np.linalg.norm(moved, axis=1) > 1e-3).sum(), 100)
        self.assert_together(moved, origin)

    def assert_together(self, moved, origin):
        for vertex in np.unique(origin):
            self.assertLess(np.ptp(moved[origin == vertex], axis=0).max(), 1e-6)

    def assert_closed(self, scan, origin):
        places = self.places(scan)
        for vertex in np.unique(origin):
            self.assertEqual(len(np.unique(places[origin == vertex], axis=0)), 1)

    def test_without_a_weld_one_triangle_follows(self):
        scan, _ = self.scan(self.joined())
        before = self.places(scan)
        self.pull(scan, distance='SURFACE')
        self.assertLessEqual((self.places(scan) != before).any(axis=1).sum(), 3)

    def test_the_panel_is_told_how_many_are_welded(self):
        joined = self.joined()
        scan, origin = self.scan(joined)
        self.pull(scan, distance='SURFACE', weld=WELD)
        self.assertEqual(self.brush.last.welded, len(origin) - len(joined.data.vertices))
        self.assertAlmostEqual(self.brush.last.weld, WELD)

    def test_a_group_follows_by_its_least_weight(self):
        joined = self.joined()
        scan, origin = self.scan(joined)
        weights = np.random.default_rng(2).uniform(0.0, 1.0, len(origin))
        group = scan.vertex_groups.new(name="Follows")
        for vertex, weight in enumerate(weights.tolist()):
            group.add([vertex], weight, 'REPLACE')
        before = self.places(scan)
        self.pull(scan, location=(0.3, 0.1, 0.0), distance='SURFACE', weld=WELD, falloff='CONSTANT', vertex_group="Follows")
        moved = np.linalg.norm(self.places(scan) - before, axis=1) / np.linalg.norm((0.1, 0.0, 0.4))
        least = np.array([weights[origin == vertex].min() for vertex in range(len(joined.data.vertices))])[origin]
        reached = moved > 0.0
        self.assertGreater(reached.sum(), 100)
        np.testing.assert_allclose(moved[reached], least[reached], atol=1e-5)

    def test_lengths_are_the_worlds_or_the_objects(self):
        scan, origin = self.scan(self.joined(), gap=0.02)
        scan.scale = (0.01, 0.01, 0.01)
        bpy.context.view_layer.update()
        for unit, welded in (('WORLD', True), ('LOCAL', False)):
            self.brush.last.welded = 0
            self.pull(scan, vertex=0, location=(0.0, 0.0, 0.0), distance='SURFACE', weld=0.0003, unit=unit)
            self.assertEqual(self.brush.last.welded > len(origin) / 2, welded)

    def test_a_distance_that_is_no_number_is_refused(self):
        scan, _ = self.scan(self.joined(5))
        with self.assertRaisesRegex(RuntimeError, "weld is not a finite number"):
            bpy.ops.motus.pick_pull(object=scan.name, vertex=0, weld=float("inf"))


class Sessions(WeldingTestCase):
    def session(self, obj, **values):
        brush = support.addon("pull.brush").Brush(**{"radius": 0.45, "strength": 0.2, **values})
        return support.addon("pull.session.dab").Session(bpy.context, obj, brush)

    def test_smoothing_goes_over_the_gaps(self):
        joined = self.joined()
        scan, origin = self.scan(joined)
        triangles = self.mesh(self.places(joined), [triangle.vertices[:] for triangle in joined.data.loop_triangles], name="Triangles")
        root = int(np.linalg.norm(self.places(joined) - (0.3, 0.1, 0.0), axis=1).argmin())
        for obj, vertex, weld in ((triangles, root, 0.0), (scan, int(np.flatnonzero(origin == root)[1]), WELD)):
            session = self.session(obj, weld=weld, distance='SURFACE')
            session.begin_stroke()
            session.smooth(vertex)
            session.finish()
        self.assertGreater(np.abs(self.places(triangles) - self.places(joined)).max(), 1e-3)
        np.testing.assert_allclose(self.places(scan), self.places(triangles)[origin], atol=1e-6)

    def test_the_normal_is_that_of_the_joined_surface(self):
        joined = self.joined()
        scan, origin = self.scan(joined)
        root = int(np.linalg.norm(self.places(joined) - (0.3, 0.1, 0.0), axis=1).argmin())
        vertex = int(np.flatnonzero(origin == root)[0])
        seen = self.session(scan, weld=WELD).normal(vertex)
        triangles = self.mesh(self.places(joined), [triangle.vertices[:] for triangle in joined.data.loop_triangles], name="Triangles")
        self.assertLess((seen - self.session(triangles).normal(root)).length, 1e-5)

    def test_a_session_that_welds_differently_is_a_new_one(self):
        scan, _ = self.scan(self.joined())
        session = self.session(scan, weld=WELD)
        for weld, is_same in ((WELD, True), (2.0 * WELD, False), (0.0, False)):
            brush = type(session.brush)(weld=weld)
            self.assertEqual(session.begin_again(bpy.context, scan, brush), is_same)


class Pins(WeldingTestCase):
    def test_a_pin_welds_as_a_pull_does(self):
        for keywords in ({}, {"mirror": {'X'}}, {"distance": 'STRAIGHT'}, {"use_minimum": True, "minimum": 0.1, "unit": 'LOCAL'}):
            with self.subTest(**keywords):
                scan, _ = self.scan(self.joined(), gap=WELD / 2.0)
                keywords = {"vertex": 30, "displacement": (0.1, 0.0, 0.4), "radius": 0.45, "distance": 'SURFACE', "weld": WELD, **keywords}
                bpy.ops.motus.pin_add(object=scan.name, **keywords)
                seen = self.seen(scan)
                bpy.ops.motus.pin_remove(object=scan.name, all=True)
                bpy.ops.motus.pick_pull(object=scan.name, **keywords)
                np.testing.assert_allclose(seen, self.places(scan), atol=1e-6)
                self.assertGreater(np.abs(seen - self.places(scan)).max(initial=0.0) + np.ptp(seen[:, 2]), 0.3)

    def test_the_last_pull_becomes_a_pin_that_welds(self):
        scan, _ = self.scan(self.joined())
        before = self.places(scan)
        self.pull(scan, vertex=30, distance='SURFACE', weld=WELD)
        pulled = self.places(scan)
        bpy.ops.motus.pin_add(object=scan.name, from_last=True)
        np.testing.assert_array_equal(self.places(scan), before)
        np.testing.assert_allclose(self.seen(scan), pulled, atol=1e-6)
        self.assertAlmostEqual(scan.motus.pull.pins[0].weld, WELD)

    def test_weights_and_frames_in_any_order(self):
        scan, origin = self.scan(self.joined())
        group = scan.vertex_groups.new(name="Follows")
        for vertex in range(len(origin)):
            group.add([vertex], 0.5 + 0.5 * (vertex % 2), 'REPLACE')
        bpy.ops.motus.pin_add(
            object=scan.name, vertex=30, displacement=(0.0, 0.0, 0.4), radius=0.45, distance='SURFACE', weld=WELD, vertex_group="Follows"
        )
        pin = scan.motus.pull.pins[0]
        for frame, strength in ((1, 0.0), (25, 1.0)):
            pin.strength = strength
            scan.keyframe_insert('motus.pull.pins[0].strength', frame=frame)
        shapes = {}
        for frame in (25, 7, 13, 7, 25, 13):
            self.scene.frame_set(frame)
            seen = self.seen(scan)
            self.assertEqual(shapes.setdefault(frame, seen.tobytes()), seen.tobytes())
            for vertex in np.unique(origin):
                self.assertEqual(len(np.unique(seen[origin == vertex], axis=0)), 1)


class Drawn(WeldingTestCase):
    def test_formula(self):
        """Straight distances are those of the leaders."""
        scan, _ = self.scan(self.joined())
        before = self.places(scan)
        self.pull(scan, vertex=30, displacement=(0.0, 0.0, 0.25), weld=WELD)
        force = pull_cases.forces('SMOOTH', np.linalg.norm(before - before[30], axis=1), 0.45)
        np.testing.assert_allclose(self.places(scan)[:, 2] - before[:, 2], 0.25 * force, atol=1e-6)
