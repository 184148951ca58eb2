"""Lattice and box_around as Python sees them."""

import math
import unittest

import numpy as np

import motus_native as native

UNIT = np.eye(3)
BASES = ("bernstein", "linear", "cardinal", "catmull_rom", "bspline")


def wavy(resolution=(3, 4, 2), basis="bspline", seed=1):
    """A lattice in the unit cube, and displacements of its points."""
    lattice = native.Lattice((0.0, 0.0, 0.0), UNIT, resolution, basis)
    return lattice, np.random.default_rng(seed).normal(size=(lattice.point_count, 3)).astype(np.float32)


class Deform(unittest.TestCase):
    def test_the_points_are_counted_with_u_fastest(self):
        lattice = native.Lattice((1.0, 2.0, 3.0), np.diag((2.0, 3.0, 4.0)), (3, 2, 1))
        self.assertEqual(lattice.resolution, (3, 2, 1))
        np.testing.assert_allclose(lattice.rest_points(), [(1, 2, 3), (2, 2, 3), (3, 2, 3), (1, 5, 3), (2, 5, 3), (3, 5, 3)])

    def test_it_is_the_weighted_sum(self):
        places = np.random.default_rng(2).uniform(-0.5, 1.5, (40, 3)).astype(np.float32)
        for basis in (*BASES, ("linear", "bernstein", "cardinal")):
            lattice, displacements = wavy(basis=basis)
            weights = lattice.weights(places)
            np.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-14)
            moved = lattice.deform(places, displacements)
            self.assertEqual(moved.dtype, np.float32)
            np.testing.assert_allclose(moved, places + weights @ displacements, atol=3e-6)

    def test_influence_and_point_weights(self):
        lattice, displacements = wavy()
        random = np.random.default_rng(3)
        places, influence = random.uniform(0, 1, (20, 3)), random.uniform(0, 1, 20)
        point_weights = random.uniform(0, 1, lattice.point_count)
        weights = lattice.weights(places)
        change = influence[:, None] * (weights @ displacements)
        np.testing.assert_allclose(lattice.deform(places, displacements, influence), places + change, atol=3e-6)
        faded = (influence * (weights @ point_weights))[:, None] * change
        np.testing.assert_allclose(lattice.deform(places, displacements, influence, point_weights), places + faded, atol=3e-6)

    def test_in_place(self):
        lattice, displacements = wavy()
        places = np.random.default_rng(4).uniform(0, 1, (50, 3)).astype(np.float32)
        wanted = lattice.deform(places, displacements)
        out = np.zeros_like(places)
        self.assertIs(lattice.deform(places, displacements, out=out), out)
        np.testing.assert_array_equal(out, wanted)
        lattice.deform(places, displacements, out=places)
        np.testing.assert_array_equal(places, wanted)
        with self.assertRaisesRegex(ValueError, "out: must not share memory with positions"):
            lattice.deform(places[:-1], displacements, out=places[1:])
        self.assertEqual(lattice.deform(np.empty((0, 3)), displacements).shape, (0, 3))


class Pull(unittest.TestCase):
    def test_pulled_and_held(self):
        lattice, _ = wavy((4, 4, 4))
        places = [(0.2, 0.3, 0.9), (0.8, 0.3, 0.9), (0.5, 0.9, 0.1)]
        wanted = np.array([(0.0, 0.0, 0.5), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)])
        moves, left = lattice.pull(places, wanted)
        np.testing.assert_allclose(left, 0.0, atol=1e-12)
        np.testing.assert_allclose(lattice.weights(places) @ moves, wanted, atol=1e-12)

    def test_parts_of_one_pull(self):
        lattice, _ = wavy((3, 3, 3))
        places = np.random.default_rng(5).uniform(0, 1, (3, 3))
        shares, influence = np.array((0.2, 0.5, 0.3)), np.array((1.0, 0.5, 0.8))
        wanted = np.array([(0.1, -0.3, 0.2)])
        moves, _left = lattice.pull(places, wanted, pulls=[0, 0, 0], shares=shares, influence=influence)
        np.testing.assert_allclose((shares * influence) @ (lattice.weights(places) @ moves), wanted[0], atol=1e-6)

    def test_it_stays_bounded(self):
        lattice, _ = wavy((4, 4, 4))
        for influence in (1e-3, 1e-6, 0.0):
            moves, left = lattice.pull([(0.5, 0.5, 0.5)], [(0.0, 0.0, 1.0)], influence=[influence])
            self.assertLess(np.abs(moves).max(), 40.0)
            self.assertGreater(left[0, 2], 0.5)
        moves, left = lattice.pull([(0.5, 0.5, 0.5)] * 2, [(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)])
        np.testing.assert_allclose(moves, 0.0, atol=1e-9)
        np.testing.assert_allclose(left, [(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)], atol=1e-9)

    def test_the_inside_follows(self):
        lattice, _ = wavy((3, 3, 3), "linear")
        moves, left = lattice.pull([(0.5, 0.5, 0.5)], [(0.0, 0.0, 0.3)], outside_only=True)
        np.testing.assert_allclose(left, 0.0, atol=1e-12)
        np.testing.assert_allclose(moves[13], moves[[4, 10, 12, 14, 16, 22]].mean(axis=0), atol=1e-12)


class Box(unittest.TestCase):
    def test_plain_and_turned(self):
        turn = np.linalg.qr(np.random.default_rng(6).normal(size=(3, 3)))[0]
        half = np.array((1.0, 2.0, 3.0))
        corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half
        points = corners @ turn.T + (4.0, 5.0, 6.0)
        center, axes, size = native.box_around(points)
        np.testing.assert_array_equal(axes, UNIT)
        np.testing.assert_allclose(size, np.ptp(points, axis=0), atol=1e-5)
        center, axes, size = native.box_around(points, turn=True)
        np.testing.assert_allclose(np.sort(size), 2.0 * half, atol=1e-4)
        np.testing.assert_allclose(center, (4.0, 5.0, 6.0), atol=1e-5)
        np.testing.assert_allclose(axes @ axes.T, UNIT, atol=1e-12)
        self.assertAlmostEqual(np.linalg.det(axes), 1.0)
        np.testing.assert_array_equal(native.box_around(np.empty((0, 3)))[2], 0.0)


class Errors(unittest.TestCase):
    def test_they_name_the_argument(self):
        plain = {"origin": (0, 0, 0), "axes": UNIT, "resolution": (2, 2, 2), "basis": "linear"}
        for name, value, error in (
            ("origin", (0, 0), ValueError),
            ("origin", (0, 0, math.nan), ValueError),
            ("axes", (1, 2, 3), ValueError),
            ("axes", [(1, 0, 0), (0, 1, 0), (1, 1, 0)], ValueError),
            ("resolution", (2, 2), ValueError),
            ("resolution", (2, 2, 0), ValueError),
            ("resolution", (2, 2, 65), ValueError),
            ("resolution", (2, 2, 2.0), TypeError),
            ("resolution", 3, TypeError),
            ("basis", "cubic", ValueError),
            ("basis", ("linear", "linear"), ValueError),
            ("basis", 1, TypeError),
        ):
            with self.subTest(name=name, value=value), self.assertRaises(error) as caught:
                native.Lattice(**{**plain, name: value})
            self.assertIn(name, str(caught.exception))

        lattice = native.Lattice(**plain)
        deform = {"positions": [(0, 0, 0)], "displacements": np.zeros((8, 3))}
        for name, value, error in (
            ("positions", [(0, 0)], ValueError),
            ("positions", [(0, 0, math.inf)], ValueError),
            ("positions", "x", TypeError),
            ("displacements", np.zeros((7, 3)), ValueError),
            ("influence", [1.0, 1.0], ValueError),
            ("influence", [math.nan], ValueError),
            ("point_weights", np.zeros(7), ValueError),
            ("out", np.zeros((1, 3)), TypeError),
            ("out", np.zeros((2, 3), np.float32), ValueError),
        ):
            with self.subTest(name=name, value=value), self.assertRaises(error) as caught:
                lattice.deform(**{**deform, name: value})
            self.assertIn(name, str(caught.exception))

        pull = {"places": [(0, 0, 0)], "displacements": [(0, 0, 1)]}
        for name, value, error in (
            ("places", [(0, 0, math.nan)], ValueError),
            ("displacements", np.zeros((2, 3)), ValueError),
            ("pulls", [1], ValueError),
            ("pulls", [0.5], ValueError),
            ("shares", [1, 2], ValueError),
            ("influence", 1.0, ValueError),
            ("point_weights", [1.0], ValueError),
            ("outside_only", 1, TypeError),
            ("max_gain", 0.0, ValueError),
            ("max_gain", math.inf, ValueError),
        ):
            with self.subTest(name=name, value=value), self.assertRaises(error) as caught:
                lattice.pull(**{**pull, name: value})
            self.assertIn(name, str(caught.exception))

        for name, value, error in (
            ("points", [(0, 0)], ValueError),
            ("axes", 2 * UNIT, ValueError),
            ("axes", (1, 0, 0), ValueError),
            ("turn", "yes", TypeError),
        ):
            with self.subTest(name=name, value=value), self.assertRaises(error) as caught:
                native.box_around(**{"points": [(0, 0, 0)], name: value})
            self.assertIn(name, str(caught.exception))
