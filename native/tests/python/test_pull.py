"""pull() through the binding."""

import threading
import unittest

import numpy as np

import motus_native as native
from meshes import folded_sheet, grid

CURVE = np.array([0.0, 0.8, 0.2, 1.0], np.float32)


def gaussian(t):
    return (np.exp(-4.5 * (1 - t) ** 2) - np.exp(-4.5)) / (1 - np.exp(-4.5))


SHAPES = {
    "smooth": lambda t: 3 * t**2 - 2 * t**3,
    "sphere": lambda t: np.sqrt(2 * t - t**2),
    "root": np.sqrt,
    "linear": lambda t: t,
    "sharp": lambda t: t**2,
    "constant": np.ones_like,
    "gaussian": gaussian,
    "curve": lambda t: np.interp(t, np.linspace(0, 1, len(CURVE)), CURVE),
}


def by_definition(distances, radius, falloff, k=0.0):
    d = np.asarray(distances, np.float64)
    if falloff == "classic":
        return np.where(d**2 < radius, np.maximum(1 - d**2 / (radius + 1), 0.0) ** (1 + abs(k)), 0.0)
    return np.where(d < radius, SHAPES[falloff](np.clip(1 - d / radius, 0.0, 1.0)), 0.0)


class PullTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.positions, cls.triangles, cls.edges = grid()
        cls.picker = native.Picker(cls.positions, cls.triangles, cls.edges)
        cls.cloud = np.random.default_rng(3).uniform(-1, 1, (30011, 3)).astype(np.float32)

    def test_falloffs(self):
        """Radii at which no vertex lies."""
        move = np.array((0.1, -0.2, 0.5))
        for falloff in (*SHAPES, "classic"):
            for k in (0.0, 1.5):
                curve = CURVE if falloff == "curve" else None
                found = native.pull(self.cloud, 5, move, 0.613, falloff, scale_factor=k, curve=curve)
                self.assertEqual((found.dtype, found.shape), (np.float32, self.cloud.shape))
                distances = np.linalg.norm(self.cloud.astype(float) - self.cloud[5], axis=1)
                wanted = self.cloud + by_definition(distances, 0.613, falloff, k)[:, None] * move
                clear = np.abs(distances - 0.613) > 1e-5
                np.testing.assert_allclose(found[clear], wanted[clear], atol=2e-6, err_msg=falloff)

    def test_a_point_as_the_root(self):
        np.testing.assert_array_equal(
            native.pull(self.positions, tuple(self.positions[7]), (0, 0, 1), 0.5), native.pull(self.positions, 7, (0, 0, 1), 0.5)
        )

    def test_forces(self):
        distances = np.linspace(0.0, 1.3, 500)
        for falloff in (*SHAPES, "classic"):
            curve = CURVE if falloff == "curve" else None
            found = native.pull_forces(distances, 0.7, falloff, 1.5, curve)
            wanted = by_definition(distances.astype(np.float32), 0.7, falloff, 1.5)
            np.testing.assert_allclose(found, wanted, atol=2e-6)
        self.assertEqual(native.pull_forces(0.5, 1.0), 0.5)
        self.assertEqual(native.pull_forces(0.5, 1.0).shape, ())

    def test_along_the_surface(self):
        positions, triangles = folded_sheet()
        root = int(np.argmin(np.linalg.norm(positions - (-0.5, 0, 0), axis=1)))
        above = positions[:, 2] > 0.01
        straight = native.pull(positions, root, (0, 0, 1), 0.3)
        along = native.pull(positions, root, (0, 0, 1), 0.3, distance="surface", triangles=triangles)
        self.assertTrue((straight[above] != positions[above]).any())
        np.testing.assert_array_equal(along[above], positions[above])
        np.testing.assert_allclose(along[~above], straight[~above], atol=0.02)

    def test_by_edges(self):
        pulled = native.pull(self.positions, 220, (0, 0, 1), 3, "linear", "edges", self.triangles, edges=self.edges)
        steps = np.abs(self.positions[:, :2]).sum(1) / 0.1
        np.testing.assert_allclose(pulled[:, 2], np.clip(1 - np.round(steps) / 3, 0, 1), atol=1e-6)

    def test_a_picker_gives_the_same(self):
        positions, triangles, _ = grid(181)
        picker = native.Picker(positions, triangles)
        weights = np.random.default_rng(1).uniform(0, 1, len(positions)).astype(np.float32)
        metric = ((1.0, 0.3, 0.0), (0.0, 0.8, 0.0), (0.0, 0.0, 2.0))
        for radius in (0.01, 0.1, 0.5, 3.0):
            for mirror in ("", "xy"):
                for falloff in ("smooth", "classic", "constant"):
                    arguments = (positions, 3000, (0.1, 0.1, 1.0), radius, falloff)
                    options = {"weights": weights, "mirror": mirror, "metric": metric}
                    np.testing.assert_array_equal(native.pull(*arguments, picker=picker, **options), native.pull(*arguments, **options))
        for distance, radius in (("surface", 0.2), ("edges", 4)):
            arguments = (positions, 3000, (0.1, 0.1, 1.0), radius, "sphere", distance)
            np.testing.assert_array_equal(
                native.pull(*arguments, picker=picker, mirror="x"), native.pull(*arguments, triangles=triangles, mirror="x")
            )

    def test_distances_measured_earlier(self):
        for distance, radius in (("straight", 0.5), ("surface", 0.5), ("edges", 4)):
            wanted = native.pull(self.positions, 130, (0, 0, 1), radius, distance=distance, picker=self.picker, mirror="x")
            reach = self.picker.reaches(130, radius, distance, mirror="x")
            pulled = native.pull(self.positions, 130, (0, 0, 1), radius, mirror="x", reach=reach)
            np.testing.assert_allclose(pulled, wanted, atol=1e-6)
            one = native.pull(self.positions, 130, (0, 0, 1), radius, reach=self.picker.reach(130, radius, distance))
            alone = native.pull(self.positions, 130, (0, 0, 1), radius, distance=distance, picker=self.picker)
            np.testing.assert_allclose(one, alone, atol=1e-6)

    def test_mirror_weights_and_clamp(self):
        pulled = native.pull(self.positions, 225, (0, 0, 1), 0.7, mirror="x").reshape(21, 21, 3)
        np.testing.assert_allclose(pulled[:, ::-1, 2], pulled[:, :, 2], atol=1e-6)
        np.testing.assert_allclose(
            native.pull(self.positions, 220, (0, 0, 1), 0.7, mirror="xy"), native.pull(self.positions, 220, (0, 0, 1), 0.7), atol=1e-6
        )
        weights = (self.positions[:, 0] > 0.0).astype(np.float32)
        pulled = native.pull(self.positions, 220, (0, 0, 1), 0.7, weights=weights)
        np.testing.assert_array_equal(pulled[weights == 0.0], self.positions[weights == 0.0])
        self.assertTrue((pulled[:, 2] > 0.1).any())
        pulled = native.pull(self.positions, 220, (0, 0, 5), 0.7, minimum=0.5, maximum=2)
        moved = (pulled != self.positions).any(1)
        self.assertEqual((pulled[moved, 2].min(), pulled[:, 2].max()), (0.5, 2.0))
        self.assertEqual(pulled[~moved, 2].max(), 0.0)
        pulled = native.pull(self.positions, 220, (5, 0, 0), 0.7, maximum=1.5, clamp_axis=0)
        self.assertEqual(pulled[:, 0].max(), 1.5)

    def test_out(self):
        wanted = native.pull(self.positions, 220, (0, 0, 1), 0.7)
        here = self.positions.copy()
        self.assertIs(native.pull(here, 220, (0, 0, 1), 0.7, out=here), here)
        np.testing.assert_array_equal(here, wanted)
        other = np.full_like(here, np.nan)
        native.pull(self.positions, 220, (0, 0, 1), 0.7, out=other)
        np.testing.assert_array_equal(other, wanted)
        np.testing.assert_array_equal(native.pull(self.positions.astype(np.float64), 220, (0, 0, 1), 0.7), wanted)
        np.testing.assert_array_equal(native.pull(self.positions[::-1][::-1], 220, (0, 0, 1), 0.7), wanted)

    def test_distances_on_another_shape(self):
        above = self.positions + np.float32([0, 0, 5])
        shape = self.positions.copy()
        for picker in (None, native.Picker(self.positions, self.triangles, self.edges)):
            for distance in ("straight", "surface", "edges"):
                with self.subTest(distance=distance, picker=picker is not None):
                    connected = {"picker": picker} if picker else {"triangles": self.triangles, "edges": self.edges}
                    radius = 3.0 if distance == "edges" else 0.4
                    wanted = native.pull(self.positions, 220, (0, 0, 1), radius, distance=distance, **connected)
                    found = native.pull(above, 220, (0, 0, 1), radius, distance=distance, shape=shape, **connected)
                    np.testing.assert_allclose(found - above, wanted - self.positions, atol=1e-6)
                    self.assertGreater(np.abs(found - above).max(), 0.9)
        with self.assertRaisesRegex(ValueError, "^shape: "):
            native.pull(above, 220, (0, 0, 1), 0.4, shape=shape[:-1])
        with self.assertRaisesRegex(ValueError, "shape"):
            native.pull(above, 220, (0, 0, 1), 0.4, shape=shape, out=shape)

    def test_copy(self):
        picker = native.Picker(self.positions, self.triangles, self.edges)
        for keywords in ({}, {"picker": picker}, {"picker": picker, "distance": "surface"}, {"reach": picker.reach(220, 0.4)}):
            copy = np.full_like(self.positions, np.nan)
            found = native.pull(self.positions, 220, (0, 0, 1), 0.4, copy=copy, **keywords)
            np.testing.assert_array_equal(copy, found)
            self.assertGreater(found[:, 2].max(), 0.9)
        here = self.positions.copy()
        for problem in (here, copy[:-1], copy.astype(float), copy[:, :2]):
            with self.assertRaisesRegex((ValueError, TypeError), "copy"):
                native.pull(here, 220, (0, 0, 1), 0.4, out=here, copy=problem)

    def test_no_vertices(self):
        self.assertEqual(native.pull(np.zeros((0, 3), np.float32), (0, 0, 0), (0, 0, 1), 1).shape, (0, 3))

    def test_errors_name_the_argument(self):
        strange = self.positions.copy()
        strange[400, 2] = np.nan
        both = np.zeros((442, 3), np.float32)
        read_only = self.positions.copy()
        read_only.flags.writeable = False
        nan, infinity = float("nan"), float("inf")
        good = {"positions": self.positions, "root": 220, "displacement": (0, 0, 1), "radius": 0.5}
        cases = (
            ({"positions": strange}, ValueError, "positions"),
            ({"positions": strange, "root": 400}, ValueError, "positions"),
            ({"positions": self.positions[:, :2]}, ValueError, "positions"),
            ({"positions": "mesh"}, TypeError, "positions"),
            ({"positions": self.positions.astype(complex)}, TypeError, "positions"),
            ({"root": 441}, ValueError, "root"),
            ({"root": -1}, ValueError, "root"),
            ({"root": (0, nan, 0)}, ValueError, "root"),
            ({"root": 1.5}, ValueError, "root"),
            ({"root": "x"}, TypeError, "root"),
            ({"displacement": (0, 0, infinity)}, ValueError, "displacement"),
            ({"displacement": (0, 0, 1e300)}, ValueError, "displacement"),
            ({"displacement": 1.0}, ValueError, "displacement"),
            ({"radius": 0.0}, ValueError, "radius"),
            ({"radius": -1.0}, ValueError, "radius"),
            ({"radius": nan}, ValueError, "radius"),
            ({"radius": "far"}, TypeError, "radius"),
            ({"falloff": "steep"}, ValueError, "falloff"),
            ({"falloff": 3}, TypeError, "falloff"),
            ({"falloff": "curve"}, ValueError, "curve"),
            ({"falloff": "curve", "curve": [1.0]}, ValueError, "curve"),
            ({"falloff": "curve", "curve": [1.0, nan]}, ValueError, "curve"),
            ({"falloff": "classic", "scale_factor": nan}, ValueError, "scale_factor"),
            ({"distance": "around"}, ValueError, "distance"),
            ({"distance": "surface"}, ValueError, "triangles"),
            ({"distance": "surface", "triangles": self.triangles + 1}, ValueError, "triangles"),
            ({"distance": "edges", "triangles": self.triangles, "root": (0, 0, 0)}, ValueError, "root"),
            ({"distance": "surface", "triangles": self.triangles, "positions": strange}, ValueError, "positions"),
            ({"weights": np.ones(440)}, ValueError, "weights"),
            ({"weights": np.full(441, 1.5)}, ValueError, "weights"),
            ({"weights": np.full(441, nan)}, ValueError, "weights"),
            ({"minimum": 1.0, "maximum": 0.5}, ValueError, "minimum"),
            ({"minimum": nan}, ValueError, "minimum"),
            ({"maximum": "high"}, TypeError, "maximum"),
            ({"clamp_axis": 3}, ValueError, "clamp_axis"),
            ({"clamp_axis": "Z"}, TypeError, "clamp_axis"),
            ({"mirror": "xw"}, ValueError, "mirror"),
            ({"mirror": 1}, TypeError, "mirror"),
            ({"metric": np.eye(4)}, ValueError, "metric"),
            ({"metric": np.full((3, 3), nan)}, ValueError, "metric"),
            ({"picker": self.triangles}, TypeError, "picker"),
            ({"picker": native.Picker(both, None)}, ValueError, "picker"),
            ({"out": both}, ValueError, "out"),
            ({"out": np.zeros((441, 3))}, TypeError, "out"),
            ({"out": read_only}, TypeError, "out"),
            ({"positions": both[1:], "out": both[:-1], "root": 0}, ValueError, "out"),
            ({"reach": ([0, 1],)}, ValueError, "reach"),
            ({"reach": ([0, 1], [0.0])}, ValueError, "reach"),
            ({"reach": ([1, 0], [0.0, 1.0])}, ValueError, "reach"),
            ({"reach": ([0, 441], [0.0, 1.0])}, ValueError, "reach"),
            ({"reach": ([-1, 0], [0.0, 1.0])}, ValueError, "reach"),
            ({"reach": ([0, 1], [0.0, nan])}, ValueError, "reach"),
            ({"reach": 7}, TypeError, "reach"),
            ({"reach": [([0], [0.0])], "mirror": "x"}, ValueError, "reach"),
        )
        for number, (change, error, name) in enumerate(cases):
            with self.subTest(number), self.assertRaisesRegex(error, f"^{name}:"):
                native.pull(**{**good, **change})
        for arguments, name in ((([-1.0], 1.0), "distances"), (([nan], 1.0), "distances"), ((1.0, 0.0), "radius")):
            with self.assertRaisesRegex(ValueError, f"^{name}:"):
                native.pull_forces(*arguments)

    def test_threads(self):
        wanted = native.pull(self.cloud, 0, (1, 0, 0), 1.0)
        wrong = []

        def work():
            for _ in range(30):
                if not np.array_equal(native.pull(self.cloud, 0, (1, 0, 0), 1.0), wanted):
                    wrong.append(True)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])
