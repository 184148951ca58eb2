"""Picker through the binding."""

import threading
import unittest

import numpy as np

import motus_native as native
from meshes import folded_sheet, grid


class PickerTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.positions, cls.triangles, cls.edges = grid()
        cls.picker = native.Picker(cls.positions, cls.triangles, cls.edges)

    def test_weld(self):
        corners = self.positions[self.triangles].reshape(-1, 3)
        leaders = native.weld(corners, 1e-4)
        self.assertEqual((leaders.dtype, leaders.shape), (np.int32, (2400,)))
        np.testing.assert_array_equal(corners[leaders], corners)
        self.assertEqual(len(np.unique(leaders)), 441)
        self.assertTrue((leaders <= np.arange(2400)).all())
        row = np.arange(4.0)[:, None] * (1.0, 0.0, 0.0)
        np.testing.assert_array_equal(native.weld(row, 1.5), (0, 0, 2, 2))
        np.testing.assert_array_equal(native.weld(row, 1.5, np.diag((2.0, 1.0, 1.0))), (0, 1, 2, 3))
        # The triangles of the welded mesh are connected.
        picker = native.Picker(corners, leaders[np.arange(2400).reshape(-1, 3)])
        indices, distances = picker.reach(int(leaders[0]), 0.35, "surface")
        straight = np.linalg.norm(corners[indices] - corners[0], axis=1)
        np.testing.assert_allclose(distances, straight, rtol=1e-4, atol=1e-6)
        self.assertEqual(len(indices), 13)  # of a quarter of a disc
        for arguments, error, name in (
            ((row, -1.0), ValueError, "distance"),
            ((row, float("inf")), ValueError, "distance"),
            ((row, "far"), TypeError, "distance"),
            ((row[:, :2], 1.0), ValueError, "positions"),
            ((row, 1.0, np.eye(2)), ValueError, "metric"),
        ):
            with self.assertRaisesRegex(error, name):
                native.weld(*arguments)

    def test_counts(self):
        self.assertEqual((self.picker.vertex_count, self.picker.triangle_count), (441, 800))

    def test_ray(self):
        triangle, point, distance = self.picker.ray((0.02, 0.01, 5.0), (0.0, 0.0, -2.0))
        self.assertAlmostEqual(distance, 5.0)
        np.testing.assert_allclose(point, (0.02, 0.01, 0.0), atol=1e-9)
        corners = self.positions[self.triangles[triangle], :2]
        self.assertTrue((corners.min(0) <= point[:2]).all() and (corners.max(0) >= point[:2]).all())
        self.assertIsNone(self.picker.ray((0.0, 0.0, 5.0), (0.0, 0.0, 1.0)))
        self.assertIsNone(self.picker.ray((9.0, 0.0, 5.0), (0.0, 0.0, -1.0)))
        self.assertIsNone(self.picker.ray((0.0, 0.0, 5.0), (0.0, 0.0, 0.0)))

    def test_ray_at_another_shape(self):
        above = self.positions + np.float32([0.0, 0.0, 0.5])
        _, point, distance = self.picker.ray((0.02, 0.01, 5.0), (0.0, 0.0, -2.0), above, 0.5)
        self.assertAlmostEqual(distance, 4.5)
        np.testing.assert_allclose(point, (0.02, 0.01, 0.5), atol=1e-7)
        for arguments, error, name in (
            ((above[:-1], 0.5), ValueError, "positions"),
            ((above, -1.0), ValueError, "slack"),
            ((above, float("nan")), ValueError, "slack"),
            ((above,), TypeError, "slack"),
            ((above, "far"), TypeError, "slack"),
            ((None, 0.5), ValueError, "slack"),
        ):
            with self.assertRaisesRegex(error, name):
                self.picker.ray((0.0, 0.0, 5.0), (0.0, 0.0, -1.0), *arguments)

    def test_pick(self):
        triangle, point, vertex = self.picker.pick((0.02, 0.01, 5.0), (0.0, 0.0, -2.0))
        self.assertEqual((triangle, vertex), (self.picker.ray((0.02, 0.01, 5.0), (0.0, 0.0, -2.0))[0], 220))
        np.testing.assert_allclose(point, (0.02, 0.01, 0.0), atol=1e-9)
        hidden = np.arange(441) == 220
        self.assertEqual(self.picker.pick((0.02, 0.01, 5.0), (0.0, 0.0, -1.0), None, hidden)[2], 221)
        metric = np.diag((1.0, 9.0, 1.0))
        self.assertEqual(self.picker.pick((0.045, 0.06, 5.0), (0.0, 0.0, -1.0))[2], 241)
        self.assertEqual(self.picker.pick((0.055, 0.049, 5.0), (0.0, 0.0, -1.0), metric)[2], 221)
        moved = self.positions + np.float32([0.05, 0.0, 0.5])
        self.assertEqual(self.picker.pick((0.06, 0.01, 5.0), (0.0, 0.0, -1.0), None, None, moved, 0.6)[2], 220)
        self.assertIsNone(self.picker.pick((9.0, 0.0, 5.0), (0.0, 0.0, -1.0)))

    def test_nearest(self):
        self.assertEqual(self.picker.nearest((0.03, -0.02, 4.0)), 220)
        self.assertEqual(self.picker.nearest((-9, -9, 0)), 0)
        self.assertIsNone(native.Picker(np.zeros((0, 3), np.float32), None).nearest((0, 0, 0)))

    def test_within(self):
        distances = np.linalg.norm(self.positions, axis=1)
        found = self.picker.within((0, 0, 0), 0.35)
        self.assertEqual(found.dtype, np.int32)
        np.testing.assert_array_equal(found, np.flatnonzero(distances <= 0.35))
        metric = np.diag((2.0, 1.0, 1.0))
        found = self.picker.within((0, 0, 0), 0.35, metric)
        np.testing.assert_array_equal(found, np.flatnonzero(np.linalg.norm(self.positions @ metric.T, axis=1) <= 0.35))

    def test_reach_straight(self):
        for root in (220, (0.0, 0.0, 0.0), np.int64(220)):
            indices, distances = self.picker.reach(root, 0.35)
            np.testing.assert_array_equal(indices, self.picker.within((0, 0, 0), 0.35))
            self.assertEqual((indices.dtype, distances.dtype), (np.int32, np.float32))
            np.testing.assert_allclose(distances, np.linalg.norm(self.positions[indices], axis=1), atol=1e-6)

    def test_reach_by_edges(self):
        """The edges given have no diagonals."""
        indices, distances = self.picker.reach(220, 3, "edges")
        steps = np.abs(self.positions[indices, :2]).sum(1) / 0.1
        np.testing.assert_allclose(distances, steps, atol=1e-4)
        self.assertEqual(len(indices), 25)
        with_diagonals = native.Picker(self.positions, self.triangles).reach(220, 1, "edges")[0]
        self.assertEqual(len(with_diagonals), 7)

    def test_reach_along_the_surface_stays_on_its_sheet(self):
        positions, triangles = folded_sheet()
        picker = native.Picker(positions, triangles)
        root = picker.nearest((-0.5, 0.0, 0.0))
        straight = picker.reach(root, 0.2)[0]
        indices, distances = picker.reach(root, 0.2, "surface")
        self.assertTrue((positions[straight, 2] > 0.01).any())
        self.assertTrue((positions[indices, 2] < 0.01).all())
        np.testing.assert_allclose(distances, np.linalg.norm(positions[indices] - positions[root], axis=1), atol=5e-3)

    def test_reaches_mirrored(self):
        root = self.picker.nearest((0.5, 0.3, 0.0))
        for distance, radius in (("straight", 0.25), ("surface", 0.25), ("edges", 2)):
            pairs = self.picker.reaches(root, radius, distance, mirror="yx")
            self.assertEqual(len(pairs), 4)
            for (x, y), (indices, distances) in zip(((1, 1), (-1, 1), (1, -1), (-1, -1)), pairs):
                nearest = indices[np.argmin(distances)]
                np.testing.assert_allclose(self.positions[nearest], (0.5 * x, 0.3 * y, 0.0), atol=1e-6)

    def test_refit(self):
        picker = native.Picker(self.positions, self.triangles)
        moved = self.positions + np.float32(3.0)
        picker.refit(moved)
        self.assertAlmostEqual(picker.ray((3.01, 3.02, 9.0), (0, 0, -1))[2], 6.0, places=5)
        moved[220, 2] = 5.0
        picker.refit(moved, moved=np.array([220]))
        self.assertEqual(picker.nearest((3.0, 3.0, 5.1)), 220)
        self.assertAlmostEqual(picker.reach(220, 0.0)[1][0], 0.0)
        self.assertEqual(list(picker.within((3.0, 3.0, 5.0), 0.5)), [220])
        picker.refit(moved, [])

    def test_the_picker_keeps_a_copy(self):
        positions = self.positions.copy()
        picker = native.Picker(positions, self.triangles)
        positions[:] = 99.0
        self.assertEqual(picker.nearest((0, 0, 0)), 220)

    def test_other_types_are_converted(self):
        picker = native.Picker(self.positions.tolist(), self.triangles.tolist(), self.edges.astype(np.uint16))
        self.assertEqual(picker.nearest((0, 0, 0)), 220)
        picker = native.Picker(self.positions.astype(np.float64)[::1], self.triangles.astype(np.int64))
        self.assertEqual(picker.triangle_count, 800)

    def test_errors_name_the_argument(self):
        strange = self.positions.copy()
        strange[7, 1] = np.nan
        make = native.Picker
        cases = (
            (lambda: make(strange, self.triangles), ValueError, "positions"),
            (lambda: make(self.positions.ravel(), self.triangles), ValueError, "positions"),
            (lambda: make("mesh", self.triangles), TypeError, "positions"),
            (lambda: make(self.positions.astype(complex), self.triangles), TypeError, "positions"),
            (lambda: make(self.positions, self.triangles + 1), ValueError, "triangles"),
            (lambda: make(self.positions, -self.triangles), ValueError, "triangles"),
            (lambda: make(self.positions, self.triangles[:, :2]), ValueError, "triangles"),
            (lambda: make(self.positions, self.triangles.astype(float)), TypeError, "triangles"),
            (lambda: make(self.positions, self.triangles.astype(np.int64) + 2**40), ValueError, "triangles"),
            (lambda: make(self.positions, self.triangles, [[0, 441]]), ValueError, "edges"),
            (lambda: make(self.positions, self.triangles, [0, 1]), ValueError, "edges"),
            (lambda: self.picker.ray((0, 0, np.nan), (0, 0, 1)), ValueError, "origin"),
            (lambda: self.picker.ray((0, 0, 1), (0, 1)), ValueError, "direction"),
            (lambda: self.picker.pick((0, 0, 1), (0, 0, -1), np.eye(4)), ValueError, "metric"),
            (lambda: self.picker.pick((0, 0, 1), (0, 0, -1), None, np.zeros(440, bool)), ValueError, "hidden"),
            (lambda: self.picker.pick((0, 0, 1), (0, 0, -1), None, np.zeros(441)), TypeError, "hidden"),
            (lambda: self.picker.pick((0, 0, 1), (0, 0, -1), slack=0.5), ValueError, "slack"),
            (lambda: self.picker.nearest((0, 0)), ValueError, "point"),
            (lambda: self.picker.nearest((0, 0, 1e300)), ValueError, "point"),
            (lambda: self.picker.within((0, 0, 0), -1), ValueError, "radius"),
            (lambda: self.picker.within((0, 0, 0), 1, np.eye(4)), ValueError, "metric"),
            (lambda: self.picker.reach(441, 1), ValueError, "root"),
            (lambda: self.picker.reach(-1, 1), ValueError, "root"),
            (lambda: self.picker.reach((0, 0, 0), 1, "surface"), ValueError, "root"),
            (lambda: self.picker.reach(0, np.nan), ValueError, "radius"),
            (lambda: self.picker.reach(0, 1, "around"), ValueError, "distance"),
            (lambda: self.picker.reaches(0, 1, mirror="w"), ValueError, "mirror"),
            (lambda: self.picker.refit(strange), ValueError, "positions"),
            (lambda: self.picker.refit(strange, [7]), ValueError, "positions"),
            (lambda: self.picker.refit(self.positions[1:]), ValueError, "positions"),
            (lambda: self.picker.refit(self.positions, [441]), ValueError, "moved"),
            (lambda: self.picker.refit(self.positions, [0.5]), TypeError, "moved"),
        )
        for number, (call, error, name) in enumerate(cases):
            with self.subTest(number), self.assertRaisesRegex(error, f"^{name}:"):
                call()

    def test_threads_ask_while_it_is_refitted(self):
        positions, triangles, _ = grid(200)
        picker = native.Picker(positions, triangles)
        wrong = []

        def ask():
            for _ in range(40):
                indices, distances = picker.reach(0, 0.2, "surface")
                if len(indices) == 0 or distances.min() != 0.0 or picker.nearest(positions[77]) != 77:
                    wrong.append(len(indices))

        threads = [threading.Thread(target=ask) for _ in range(3)]
        for thread in threads:
            thread.start()
        for _ in range(40):
            picker.refit(positions)
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])
