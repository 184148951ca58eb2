"""motus.lattice_pull: the point goes where it is pulled, by the smallest change of the lattice."""

import math
import time

import bpy
import numpy as np

import support
from lattice import lattice_cases as cases


class PullTest(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.ball = cases.ball()
        bpy.ops.motus.lattice_fit(objects="Ball")
        self.lattice = bpy.context.object
        self.modifier = self.ball.modifiers[0]

    def pull(self, displacement=(0.1, -0.2, 0.4), vertex=20, object="Ball", **keywords):
        """How the object's points have moved, (m, 3)."""
        obj = bpy.data.objects[object]
        before = cases.evaluated(obj).astype(np.float64)
        done = bpy.ops.motus.lattice_pull(object=object, vertex=vertex, displacement=displacement, **keywords)
        self.assertEqual(done, {'FINISHED'})
        return cases.evaluated(obj) - before

    def test_the_vertex_arrives(self):
        for orientation in ('LOCAL', 'GLOBAL'):
            self.ball.scale, self.ball.rotation_euler = (2.0, 0.5, -1.0), (0.3, 0.4, 0.5)
            for interpolation in ('LINEAR', 'CARDINAL', 'CATMULL_ROM', 'BSPLINE'):
                bpy.ops.motus.lattice_remove(objects="Ball")
                bpy.ops.motus.lattice_fit(objects="Ball", interpolation=interpolation, orientation=orientation)
                for vertex in (0, 150, 299):
                    with self.subTest(interpolation=interpolation, vertex=vertex):
                        moved = self.pull(vertex=vertex)
                        np.testing.assert_allclose(moved[vertex], (0.1, -0.2, 0.4), atol=2e-6)
                        self.assertLess(np.linalg.norm(moved, axis=1).max(), 4.0 * np.linalg.norm((0.1, -0.2, 0.4)))

    def test_pulls_add_up(self):
        first = self.pull((0.0, 0.0, 0.3))[20]
        np.testing.assert_allclose(first + self.pull((0.3, 0.0, 0.0))[20], (0.3, 0.0, 0.3), atol=2e-6)

    def test_nearest_to_a_location(self):
        place = cases.evaluated(self.ball)[77] + (0.001, 0.0, 0.0)
        before = cases.evaluated(self.ball)
        bpy.ops.motus.lattice_pull(object="Ball", location=place, displacement=(0.0, 0.0, 0.2))
        np.testing.assert_allclose(cases.evaluated(self.ball)[77] - before[77], (0.0, 0.0, 0.2), atol=2e-6)

    def test_held_vertices_stay(self):
        moved = self.pull(held="150, 250, 290")
        np.testing.assert_allclose(moved[20], (0.1, -0.2, 0.4), atol=2e-6)
        np.testing.assert_allclose(moved[[150, 250, 290]], 0.0, atol=2e-6)

    def test_pulls_are_mirrored(self):
        for axes in ({'X'}, {'X', 'Z'}):
            bpy.ops.motus.lattice_reset(object=self.lattice.name)
            moved = self.pull(mirror=axes)
            np.testing.assert_allclose(moved[20], (0.1, -0.2, 0.4), atol=1e-5)
            matrix = self.lattice.matrix_world.to_3x3()
            change = cases.points_of(self.lattice) - cases.shapes().lattice_points(self.lattice.data, "co")
            world = (change @ np.array(matrix).T).reshape(4, 4, 4, 3)  # w, v, u
            np.testing.assert_allclose(world[:, :, ::-1] * (-1, 1, 1), world, atol=1e-5)
            if 'Z' in axes:
                np.testing.assert_allclose(world[::-1] * (1, 1, -1), world, atol=1e-5)

    def test_a_vertex_on_the_mirror_stays_on_it(self):
        sheet = cases.grid(count=21)
        bpy.ops.motus.lattice_fit(objects=sheet.name)
        moved = self.pull((0.5, 0.0, 0.3), vertex=10 + 21 * 10, object=sheet.name, mirror={'X'})
        np.testing.assert_allclose(moved[10 + 21 * 10], (0.0, 0.0, 0.3), atol=1e-4)

    def test_strength_and_vertex_groups(self):
        group = self.ball.vertex_groups.new(name="Part")
        group.add(list(range(300)), 0.5, 'REPLACE')
        self.modifier.vertex_group, self.modifier.strength = "Part", 0.6
        np.testing.assert_allclose(self.pull()[20], (0.1, -0.2, 0.4), atol=5e-6)
        self.modifier.invert_vertex_group = True
        np.testing.assert_allclose(self.pull()[20], (0.1, -0.2, 0.4), atol=5e-6)
        inner = self.lattice.vertex_groups.new(name="Inner")
        inner.add(list(range(64)), 0.7, 'REPLACE')
        self.lattice.data.vertex_group = "Inner"
        np.testing.assert_allclose(self.pull()[20], (0.1, -0.2, 0.4), atol=5e-6)

    def test_little_influence_does_not_explode(self):
        group = self.ball.vertex_groups.new(name="Part")
        group.add(list(range(300)), 1e-4, 'REPLACE')
        self.modifier.vertex_group = "Part"
        before = cases.points_of(self.lattice)
        self.pull()
        change = np.abs(cases.points_of(self.lattice) - before).max() * max(self.lattice.matrix_world.to_scale())
        self.assertLess(change, 40.0)
        self.assertTrue(np.isfinite(cases.evaluated(self.ball)).all())
        group.remove([20])
        with self.assertRaisesRegex(RuntimeError, "has no influence there"):
            self.pull()

    def test_opposite_goals_do_not_explode(self):
        """A vertex that is pulled while its neighbour, nearly in the same place, is held."""
        self.ball.data.vertices[21].co = self.ball.data.vertices[20].co
        self.ball.data.vertices[21].co.x += 1e-4
        moved = self.pull((0.0, 0.0, 1.0), held="21")
        self.assertLess(np.linalg.norm(moved, axis=1).max(), 40.0)
        np.testing.assert_allclose(moved[20] + moved[21], (0.0, 0.0, 1.0), atol=0.02)  # they meet half-way

    def test_modifiers_before_and_after(self):
        for before in (True, False):
            with self.subTest(before=before):
                self.ball.modifiers.clear()
                if before:
                    self.ball.modifiers.new("Subdivision", 'SUBSURF')
                bpy.ops.motus.lattice_fit(objects="Ball")
                if not before:
                    self.ball.modifiers.new("Subdivision", 'SUBSURF')
                np.testing.assert_allclose(self.pull()[500], self.pull()[500], atol=1e-4)
                np.testing.assert_allclose(self.pull(vertex=500)[500], (0.1, -0.2, 0.4), atol=1e-4)

    def test_a_modifier_that_is_no_weighted_sum(self):
        cast = self.ball.modifiers.new("Cast", 'CAST')
        cast.factor = 0.5
        np.testing.assert_allclose(self.pull((0.05, 0.0, 0.2))[20], (0.05, 0.0, 0.2), atol=5e-3)
        self.assertTrue(self.modifier.show_viewport)

    def test_outside_only(self):
        self.lattice.data.use_outside = True
        np.testing.assert_allclose(self.pull()[20], (0.1, -0.2, 0.4), atol=2e-6)
        before = cases.points_of(self.lattice)
        self.lattice.data.use_outside = True  # Blender places the points inside anew
        np.testing.assert_allclose(cases.points_of(self.lattice), before, atol=1e-5)

    def test_curves_surfaces_and_texts(self):
        for make in (cases.curve, cases.surface, cases.text):
            obj = make()
            bpy.ops.motus.lattice_fit(objects=obj.name)
            with self.subTest(type=obj.type):
                moved = self.pull((0.0, 0.0, 0.3), vertex=40, object=obj.name)
                np.testing.assert_allclose(moved[40], (0.0, 0.0, 0.3), atol=0.01)

    def test_the_lattice_itself_names_its_only_object(self):
        before = cases.evaluated(self.ball)
        cases.only(self.lattice)
        bpy.ops.motus.lattice_pull(vertex=20, displacement=(0.0, 0.0, 0.2))
        np.testing.assert_allclose(cases.evaluated(self.ball)[20] - before[20], (0.0, 0.0, 0.2), atol=2e-6)

    def test_restore_is_exact(self):
        pulling = support.addon("lattice.pulling")
        cases.displace(self.lattice)
        before, seen = cases.points_of(self.lattice), cases.evaluated(self.ball)
        shape = pulling.Shape(bpy.context, self.ball, self.modifier)
        held = pulling.Held(bpy.context, shape, [(20, 0.5), (28, 0.25), (33, 0.25)])
        for step in ((1.0, 2.0, 3.0), (0.2, 0.0, 0.0), (-1.0, 0.5, 0.0)):
            held.pull(step)
        moved = cases.evaluated(self.ball)
        place = [0.5 * points[20] + 0.25 * points[28] + 0.25 * points[33] for points in (seen, moved)]
        np.testing.assert_allclose(place[1] - place[0], (-1.0, 0.5, 0.0), atol=5e-6)  # whatever way it came
        held.restore()
        np.testing.assert_array_equal(cases.points_of(self.lattice), before)
        np.testing.assert_array_equal(cases.evaluated(self.ball), seen)

    def test_refusals(self):
        def refused(sentence, **keywords):
            arguments = {"object": "Ball", "vertex": 20, "displacement": (0, 0, 1), **keywords}
            before = cases.points_of(self.lattice)
            with self.assertRaisesRegex(RuntimeError, sentence):
                bpy.ops.motus.lattice_pull(**arguments)
            np.testing.assert_array_equal(cases.points_of(self.lattice), before)

        refused("has no vertex 300", vertex=300)
        refused("held is not a list", held="one")
        refused("has no vertex -3", held="-3")
        most = support.addon("core.native").module.Lattice.MAX_PULLS
        self.lattice.data.points_u = self.lattice.data.points_v = self.lattice.data.points_w = 12
        refused(f"At most {most - 1} vertices", held=",".join(["7"] * most))
        refused(f"At most {most // 4 - 1} vertices", held=",".join(["7"] * (most // 4)), mirror={'X', 'Z'})
        refused("There is no object", object="Nobody")
        refused("has no lattice modifier Other", modifier="Other")
        refused("displacement is not a finite", displacement=(0, 0, math.nan))
        refused("Say where", vertex=-1)
        with self.assertRaisesRegex(RuntimeError, "Say how far"):
            bpy.ops.motus.lattice_pull(object="Ball", vertex=20)
        cases.ball("Free")
        refused("deformed by no lattice", object="Free")
        self.modifier.show_viewport = False
        refused("deformed by no lattice")
        self.modifier.show_viewport = True
        self.modifier.strength = 0.0
        refused("has no influence there")
        self.modifier.strength = 1.0
        decimate = self.ball.modifiers.new("Weld", 'WELD')
        cases.displace(self.lattice)
        decimate.merge_threshold = 0.3
        refused("another number of vertices")
        self.ball.modifiers.remove(decimate)
        self.lattice.shape_key_add(name="Basis")
        refused("has shape keys")

    def test_one_undo_step(self):
        """Blender pushes an undo step for each operator by itself only in a window; the flag says that it does."""
        for name in ("fit", "pull", "remove", "reset"):
            cls = getattr(bpy.types, f"MOTUS_OT_lattice_{name}")
            self.assertLessEqual({'REGISTER', 'UNDO'}, cls.bl_options)

    def test_a_dense_mesh_is_pulled_at_once(self):
        sheet = cases.grid(count=300)
        bpy.ops.motus.lattice_fit(objects=sheet.name)
        started = time.process_time()
        moved = self.pull((0.0, 0.0, 0.5), vertex=45_150, object=sheet.name)
        self.assertLess(time.process_time() - started, 3.0)  # of the processor, whatever else it does
        np.testing.assert_allclose(moved[45_150], (0.0, 0.0, 0.5), atol=5e-6)
