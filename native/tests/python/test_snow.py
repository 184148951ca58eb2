"""Snow through the binding: names, defaults, shapes and errors. What flakes do is tested natively."""

import threading
import unittest

import numpy as np

import motus_native as native

SHAPES = {"position": (3,), "velocity": (3,), "size": (), "color": (4,), "age": (), "rotation": (4,), "id": ()}


class SnowTest(unittest.TestCase):
    def test_fields_and_defaults(self):
        flakes = native.Snow().evaluate(1.0)
        self.assertEqual(list(flakes), list(SHAPES))
        for name, shape in SHAPES.items():
            self.assertEqual(flakes[name].shape, (5, *shape), name)
            self.assertEqual(flakes[name].dtype, np.int64 if name == "id" else np.float32, name)
        np.testing.assert_array_equal(flakes["id"], range(5))
        np.testing.assert_allclose(flakes["age"], [0.8, 0.6, 0.4, 0.2, 0.0], atol=1e-7)
        np.testing.assert_allclose(flakes["position"][:, 2], 5.0 * flakes["age"], atol=1e-6)
        np.testing.assert_array_equal(flakes["color"], np.ones((5, 4)))
        self.assertEqual(native.Snow().evaluate(0.1)["position"].shape, (0, 3))
        self.assertEqual(native.Snow(rate=0).evaluate(9)["position"].shape, (0, 3))

    def test_a_keyed_rate_and_the_emitters_velocity(self):
        snow = native.Snow(rate_times=[0.0, 2.0], rate_values=[0.0, 40.0], lifetime=9.0)
        ages = snow.evaluate(2.0)["age"]
        np.testing.assert_allclose(ages, 2.0 - np.sqrt((np.arange(40) + 1.0) / 10.0), atol=1e-6)
        poses = np.tile(np.eye(4), (2, 1, 1))
        poses[1, 0, 3] = 6.0
        snow = native.Snow(emitter_times=[0.0, 2.0], emitter_matrices=poses, inherited=0.5, period=1.0)
        np.testing.assert_allclose(snow.evaluate(1.5)["velocity"][:, 0], 1.5, atol=1e-6)
        for wrong, name in (({"rate_times": [0.0]}, "rate_values"), ({"period": -1.0}, "period"), ({"inherited": np.nan}, "inherited")):
            with self.assertRaisesRegex(ValueError, name):
                native.Snow(**wrong)

    def test_only_fields_that_are_wanted(self):
        snow = native.Snow(rate=100, snow=True)
        self.assertEqual(list(snow.evaluate(3.0, ["age", "id"])), ["age", "id"])
        self.assertEqual(snow.evaluate(3.0, ()), {})
        np.testing.assert_array_equal(snow.evaluate(3.0, ["velocity"])["velocity"], snow.evaluate(3.0)["velocity"])

    def test_given_arrays_are_written_into(self):
        snow = native.Snow(
            rate=1000, random_lifetime=True, random_color=True, gravity=True, start_color=([0.0, 1.0], [[1, 0, 0, 1], [0, 0, 1, 1]])
        )
        wanted = snow.evaluate(7.0)
        count = len(wanted["id"])
        out = {"position": np.zeros((5000, 3), np.float32), "color": np.zeros((count, 4), np.float32), "id": np.zeros(5000, np.int64)}
        found = snow.evaluate(7.0, out=out)
        self.assertEqual(list(found), list(out))
        for name, array in out.items():
            self.assertTrue(np.shares_memory(found[name], array), name)
            np.testing.assert_array_equal(array[:count], wanted[name])
            self.assertFalse(array[count:].any(), name)
        self.assertEqual(set(snow.evaluate(7.0, ["age", "id"], out)), {"age", "id"})

    def test_a_function_gives_the_arrays(self):
        snow, counts = native.Snow(rate=1000, random_lifetime=True), []

        def room(count):
            counts.append(count)
            return {"position": np.zeros((count, 3), np.float32)}

        found = snow.evaluate(7.0, out=room)
        np.testing.assert_array_equal(found["position"], snow.evaluate(7.0)["position"])
        self.assertEqual(counts, [len(found["position"])])
        for wrong in (lambda count: 1, dict):
            with self.assertRaises(TypeError):
                snow.evaluate(7.0, out=wrong)

    def test_emitter_and_bursts(self):
        matrices = np.tile(np.eye(4), (2, 1, 1))
        matrices[1, :3, 3] = 10.0, 0.0, 5.0
        snow = native.Snow(
            rate=0,
            burst_times=[0.0, 0.5, 1.0],
            burst_counts=[1, 2, 1],
            start_speed=0,
            cone_radius=0,
            emitter_times=[0, 1],
            emitter_matrices=matrices,
        )
        np.testing.assert_allclose(snow.evaluate(1.5)["position"], [[0, 0, 0], [5, 0, 2.5], [5, 0, 2.5], [10, 0, 5]], atol=1e-6)

    def test_surface(self):
        corners = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]
        flakes = native.Snow(shape="surface", surface_positions=corners, surface_triangles=[[0, 1, 2]]).evaluate(1.0)
        np.testing.assert_allclose(flakes["position"][:, 2], 1.0 + 5.0 * flakes["age"], atol=1e-6)
        for triangles in ([[0, 1, 3]], [[0, 1, -1]], [[0, 1, 0.5]], [[0, 1, 1e12]], [[0, 1, 1]], [0, 1, 2]):
            with self.subTest(triangles=triangles), self.assertRaisesRegex(ValueError, "^surface_triangles"):
                native.Snow(shape="surface", surface_positions=corners, surface_triangles=triangles)

    def test_frustum_and_keyed_wind(self):
        places = native.Snow(
            rate=1000, shape="frustum", frustum_angles=(0.5, 0.3), frustum_near=2.0, frustum_far=9.0, start_speed=0
        ).evaluate(2.0)["position"]
        self.assertTrue(((-places[:, 2] >= 1.9999) & (-places[:, 2] <= 9.0001)).all())
        self.assertTrue((np.abs(places[:, 0] / places[:, 2]) <= np.tan(0.5) + 1e-4).all())
        self.assertTrue((np.abs(places[:, 1] / places[:, 2]) <= np.tan(0.3) + 1e-4).all())
        settings = {"rate": 100, "drag": 50, "start_speed": 0, "lifetime": 5}
        velocity = native.Snow(wind_times=[1.0, 3.0], wind_values=[[0, 0, 0], [4, 0, 2]], **settings).evaluate(2.0, ["velocity"])[
            "velocity"
        ]
        np.testing.assert_allclose(velocity[0], [1.96, 0, 0.98], atol=1e-4)  # 1 / 50 s behind the wind
        for keywords, name in (
            ({"frustum_angles": (1, 2)}, "frustum_angles"),
            ({"frustum_angles": (1,)}, "frustum_angles"),
            ({"frustum_near": 30}, "frustum_near"),
            ({"frustum_far": 0}, "frustum_far"),
            ({"wind_times": [1.0]}, "wind_values"),
            ({"wind_times": [[1.0]]}, "wind_times"),
            ({"wind_times": [1, 0], "wind_values": np.zeros((2, 3))}, "wind_times"),
            ({"wind_times": [1], "wind_values": np.zeros((1, 2))}, "wind_values"),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(ValueError, f"^{name}"):
                native.Snow(**keywords)

    def test_threads_may_share_one(self):
        snow = native.Snow(rate=50000, snow=True, random_lifetime=True, drag=1.0, wind=(1, 0, 0), gusts=0.5)
        wanted = snow.evaluate(4.0)["position"]
        found = [None] * 4

        def evaluate(which):
            found[which] = snow.evaluate(4.0)["position"]

        threads = [threading.Thread(target=evaluate, args=(which,)) for which in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for one in found:
            np.testing.assert_array_equal(one, wanted)

    def test_ground_and_collider(self):
        corners, triangles = [[-5, -5, 1], [5, -5, 1], [0, 5, 1]], [[0, 1, 2]]
        collider = native.SnowCollider(corners, triangles)
        self.assertEqual((collider.vertex_count, collider.triangle_count), (3, 1))
        matrix = np.diag([1.0, 1.0, 1.0, 1.0])[None]
        matrix[0, 2, 3] = 3.0
        settings = {"rate": 100, "start_speed": -2, "cone_radius": 0.5, "emitter_times": [0.0], "emitter_matrices": matrix, "lifetime": 4}
        for keywords, height, triangle in (
            ({"ground": 0.5}, 0.5, -1),
            ({"collider": collider}, 1.0, 0),
            ({"ground": 0.5, "collider": collider}, 1.0, 0),
        ):
            snow = native.Snow(**settings, **keywords)
            downs = snow.landings(3.0)
            self.assertEqual(
                {name: array.dtype.str for name, array in downs.items()}, {"time": "<f8", "id": "<i8", "position": "<f4", "triangle": "<i8"}
            )
            np.testing.assert_allclose(downs["time"], (downs["id"] + 1) / 100 + (3.0 - height) / 2.0, atol=1e-6)
            np.testing.assert_allclose(downs["position"][:, 2], height, atol=1e-6)
            self.assertTrue((downs["triangle"] == triangle).all())
            flakes = snow.evaluate(3.0)
            self.assertEqual(len(flakes["id"]), 300)
            np.testing.assert_array_equal(flakes["position"][downs["id"]], downs["position"])
            self.assertFalse(flakes["velocity"][downs["id"]].any())
        snow = native.Snow(**settings, ground=1.0, collision="melt", melt_time=0.5)
        self.assertEqual(len(snow.evaluate(3.0)["id"]), 150)
        self.assertEqual(len(native.Snow(**settings, ground=1.0, rest_time=1.0).evaluate(3.0)["id"]), 200)
        self.assertEqual(len(native.Snow(**settings).landings(3.0)["id"]), 0)
        self.assertEqual(len(native.Snow(**settings).evaluate(3.0, known=True)["id"]), 300)
        snow = native.Snow(**settings, ground=1.0)
        self.assertEqual(len(snow.evaluate(3.0, known=True)["id"]), 0)
        self.assertEqual(snow.find_landings(3.0, 1), 1)
        np.testing.assert_array_equal(snow.evaluate(3.0, known=True)["id"], np.arange(256))
        self.assertEqual(snow.find_landings(3.0, 9), 0)
        self.assertEqual(len(snow.evaluate(3.0, known=True)["id"]), 300)

    def test_cover(self):
        corners = [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]]
        matrix = np.eye(4)[None]
        matrix[0, 2, 3] = 2.0
        settings = {"rate": 1000, "start_speed": -2, "emitter_times": [0.0], "emitter_matrices": matrix, "lifetime": 4}
        snow = native.Snow(collider=native.SnowCollider(corners, [[0, 1, 2], [0, 2, 3]]), **settings)
        cover = native.SnowCover(snow, end=3.0, flake_volume=0.01)
        self.assertEqual(cover.vertex_count, 4)
        np.testing.assert_allclose(cover.areas, [108, 54, 108, 54])
        for time, landed in ((0.5, 0), (1.5, 500), (9.0, 2000)):
            heights = cover.heights(time)
            self.assertEqual((heights.shape, heights.dtype), ((4,), np.float32))
            self.assertAlmostEqual(cover.volume(time), 0.01 * landed, delta=0.011)
            self.assertAlmostEqual(float(heights @ cover.areas), cover.volume(time), delta=1e-4)
        out = np.zeros(4, np.float32)
        self.assertIs(cover.heights(9.0, out), out)
        np.testing.assert_array_equal(out, cover.heights(9.0))
        for call, name in (
            (lambda: native.SnowCover(native.Snow(), end=1), "snow"),
            (lambda: native.SnowCover(snow, end=np.inf), "end"),
            (lambda: native.SnowCover(snow, end=1, flake_volume=0), "flake_volume"),
            (lambda: native.SnowCover(snow, end=1, repose=2), "repose"),
            (lambda: native.SnowCover(snow, end=1, smoothing=-1), "smoothing"),
            (lambda: native.SnowCover(snow, end=1e9), "end"),
            (lambda: cover.heights(np.nan), "time"),
            (lambda: cover.volume(np.nan), "time"),
            (lambda: cover.heights(1, np.zeros(5, np.float32)), "out"),
            (lambda: cover.heights(1, np.zeros(8, np.float32)[::2]), "out"),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(ValueError, f"^{name}"):
                call()
        for call, name in (
            (lambda: native.SnowCover(1, end=1), "snow"),
            (lambda: cover.heights(1, np.zeros(4)), "out"),
            (lambda: native.SnowCover(snow, end=1, smoothing=0.5), "smoothing"),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(TypeError, f"^{name}"):
                call()

    def test_layer(self):
        corners, triangles, ends = native.refine([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]], 0.3)
        layer = native.SnowLayer(corners, triangles)
        self.assertEqual(layer.vertex_count, len(corners))
        depths = np.where(corners[:, 0] > 0.4, 0.1, 0.0).astype(np.float32)
        found = layer.mesh(depths, 0.01)
        self.assertEqual(
            {name: array.dtype for name, array in found.items()},
            {"position": np.float32, "depth": np.float32, "triangle": np.int32, "edge": np.int32, "side": np.int32},
        )
        self.assertAlmostEqual(float(found["position"][:, 2].max()), 0.1, places=6)
        self.assertEqual(found["position"].shape, (len(found["depth"]), 3))
        self.assertEqual(found["side"].shape, found["triangle"].shape)
        ends = np.sort(found["edge"], axis=1)[found["side"]]
        np.testing.assert_array_equal(ends, np.sort(np.stack((found["triangle"], np.roll(found["triangle"], -1, axis=1)), axis=2), axis=2))
        self.assertEqual(len(layer.mesh(np.zeros(len(corners)))["position"]), 0)
        nan = float("nan")
        for call, name in (
            (lambda: native.SnowLayer([[0, 0, nan]], []), "layer_positions"),
            (lambda: native.SnowLayer([[0, 0, 0]], [[0, 0, 1]]), "layer_triangles"),
            (lambda: native.SnowLayer(corners, triangles, (0, 0, 0)), "up"),
            (lambda: native.SnowLayer(corners, triangles, repose=-0.1), "repose"),
            (lambda: native.SnowLayer(corners, triangles, repose=1.6), "repose"),
            (lambda: layer.mesh([1.0]), "depths"),
            (lambda: layer.mesh(depths * nan), "depths"),
            (lambda: layer.mesh(depths, -1.0), "thinnest"),
            (lambda: layer.mesh(depths, 0.0, 0.0), "steepest"),
            (lambda: layer.mesh(depths, 0.0, 1.0, [1.0]), "left"),
            (lambda: layer.mesh(depths, 0.0, 1.0, -depths), "left"),
            (lambda: native.refine([[0, 0, nan]], [], 1), "positions"),
            (lambda: native.refine([[0, 0, 0]], [[0, 0, 1]], 1), "triangles"),
            (lambda: native.refine(corners, triangles, 0), "longest_edge"),
            (lambda: native.refine(corners, triangles, 1e-3, 1000), "longest_edge"),
            (lambda: native.refine(corners, triangles, 1, -1), "most_vertices"),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(ValueError, f"^{name}"):
                call()

    def test_marks(self):
        corners, triangles, _ = native.refine([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]], 0.1)
        layer, count = native.SnowLayer(corners, triangles), len(corners)
        sole = native.SnowCollider([[0, 0, 0], [0.5, 0, 0], [0, 0.5, 0]], [[0, 2, 1]])
        matrix = np.eye(4)
        matrix[:3, 3] = 0.25, 0.25, 0.03
        movers, times, heights = [(sole, [1.0], matrix[None])], [0.0, 2.0], np.full((2, count), 0.1)
        marks = native.SnowMarks(layer, movers, times, heights)
        self.assertEqual(marks.vertex_count, count)
        found = marks.pressed(1.0, heights[0])
        self.assertEqual((found.dtype, found.shape), (np.float32, (count,)))
        self.assertEqual(np.count_nonzero(found), marks.marked_count)
        np.testing.assert_allclose(found[found > 0.0], 0.07, atol=1e-6)
        left = layer.mesh(heights[0], 0.0, None, 1.0 - found / heights[0])["depth"]
        self.assertAlmostEqual(float(left[left > 0.0].min()), 0.03, places=6)
        packed = native.SnowMarks(layer, movers, times, heights, packed=0.05, step=0.2)
        self.assertAlmostEqual(float(packed.pressed(1.0, heights[0], np.ones(count)).max()), 0.05, places=6)
        nan = float("nan")
        for call, name in (
            (lambda: native.SnowMarks(layer, [(sole, [1.0, 0.0], [matrix, matrix])], times, heights), "movers"),
            (lambda: native.SnowMarks(layer, movers, [2.0, 0.0], heights), "times"),
            (lambda: native.SnowMarks(layer, movers, times, heights[0]), "heights"),
            (lambda: native.SnowMarks(layer, movers, times, heights[:1]), "heights"),
            (lambda: native.SnowMarks(layer, movers, times, heights, packed=-1.0), "packed"),
            (lambda: native.SnowMarks(layer, movers, times, heights, step=0.0), "step"),
            (lambda: marks.pressed(nan, heights[0]), "time"),
            (lambda: marks.pressed(1.0, [nan]), "depths"),
            (lambda: marks.pressed(1.0, heights[0], [1.0]), "shares"),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(ValueError, f"^{name}"):
                call()
        for call, name in (
            (lambda: native.SnowMarks(1, movers, times, heights), "layer"),
            (lambda: native.SnowMarks(layer, 1, times, heights), "movers"),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(TypeError, f"^{name}"):
                call()

    def test_errors_of_collisions_name_the_argument(self):
        nan = float("nan")
        for call, name in (
            (lambda: native.Snow(ground=nan), "ground"),
            (lambda: native.Snow(collision="bounce"), "collision"),
            (lambda: native.Snow(rest_time=-1), "rest_time"),
            (lambda: native.Snow(melt_time=-1), "melt_time"),
            (lambda: native.Snow(friction=-1), "friction"),
            (lambda: native.SnowCollider([[0, 0, nan]], []), "collider_positions"),
            (lambda: native.SnowCollider([0, 0, 0], []), "collider_positions"),
            (lambda: native.SnowCollider([[0, 0, 0]], [[0, 0, 1]]), "collider_triangles"),
            (lambda: native.Snow().landings(nan), "end"),
            (lambda: native.Snow().find_landings(nan, 1), "time"),
            (lambda: native.Snow().find_landings(1.0, -1), "most"),
            (lambda: native.Snow(rate=1e6, lifetime=1, ground=0).landings(100), "end"),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(ValueError, f"^{name}"):
                call()
        for call, name in (
            (lambda: native.Snow(collider=[1]), "collider"),
            (lambda: native.Snow(collision=1), "collision"),
            (lambda: native.SnowCollider([[0, 0, 0]], [[0.5, 0, 0]]), "collider_triangles"),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(TypeError, f"^{name}"):
                call()

    def test_errors_name_the_argument(self):
        nan = float("nan")
        snow = native.Snow(rate=100)
        rows = np.zeros((200, 3), np.float32)
        for call, name in (
            (lambda: native.Snow(rate=-1), "rate"),
            (lambda: native.Snow(rate=nan), "rate"),
            (lambda: native.Snow(lifetime=-1), "lifetime"),
            (lambda: native.Snow(seed=-1), "seed"),
            (lambda: native.Snow(seed=2**32), "seed"),
            (lambda: native.Snow(shape="cube"), "shape"),
            (lambda: native.Snow(wind=(1, 2)), "wind"),
            (lambda: native.Snow(drag=1e9), "drag"),
            (lambda: native.Snow(start_color=([0.0], [[1, 1, 1]])), "start_color"),
            (lambda: native.Snow(start_color=([], np.zeros((0, 4)))), "start_color"),
            (lambda: native.Snow(burst_times=[1.0]), "burst_counts"),
            (lambda: native.Snow(burst_times=[1.0], burst_counts=[0.5]), "burst_counts"),
            (lambda: native.Snow(emitter_times=[0.0]), "emitter_matrices"),
            (lambda: native.Snow(emitter_times=[0.0, 0.0], emitter_matrices=np.zeros((2, 4, 4))), "emitter_times"),
            (lambda: native.Snow(emitter_times=[0.0], emitter_matrices=np.eye(4)), "emitter_matrices"),
            (lambda: snow.evaluate(nan), "time"),
            (lambda: snow.evaluate(1.0, ["mass"]), "fields"),
            (lambda: snow.evaluate(2.0, out={"position": rows[:10]}), "out\\['position'\\]"),
            (lambda: snow.evaluate(2.0, out={"position": rows[:, :2]}), "out\\['position'\\]"),
            (lambda: snow.evaluate(2.0, out={"age": np.zeros((200, 2), np.float32)[:, 0]}), "out\\['age'\\]"),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(ValueError, f"^{name}"):
                call()
        rows.flags.writeable = False
        with self.assertRaisesRegex(ValueError, "writable"):
            snow.evaluate(2.0, out={"position": rows})
        for call, name in (
            (lambda: native.Snow(snow=1), "snow"),
            (lambda: native.Snow(rate="a"), "rate"),
            (lambda: native.Snow(start_color="white"), "start_color"),
            (lambda: snow.evaluate(1.0, "age"), "fields"),
            (lambda: snow.evaluate(1.0, 5), "fields"),
            (lambda: snow.evaluate(1.0, out=rows), "out"),
            (lambda: snow.evaluate(1.0, out={"age": np.zeros(200)}), "out\\['age'\\]"),
            (lambda: native.Snow(speed=1.0), ""),
        ):
            with self.subTest(name=name), self.assertRaisesRegex(TypeError, f"^{name}"):
                call()

    def test_too_many_flakes_are_a_sentence(self):
        with self.assertRaisesRegex(
            ValueError,
            r"^rate: must be lower: up to 2e\+12 flakes would live at once, which take "
            r"1.44e\+05 GB; at most 1e\+08 may",
        ):
            native.Snow(rate=1e12)
        with self.assertRaisesRegex(ValueError, "^rate: must be lower"):
            native.Snow(lifetime=1e12)
