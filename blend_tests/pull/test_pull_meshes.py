"""motus.pick_pull on meshes as they are: spaces, masks, shape keys, modifiers, modes, and all kinds of defects."""

import math
import time

import bmesh
import bpy
import numpy as np

import support
from pull.pull_cases import PullTestCase, forces


class Spaces(PullTestCase):
    """World units on objects that are scaled, sheared and mirrored; local units beside them."""

    def transformed(self):
        parent = bpy.data.objects.new("Parent", None)
        self.scene.collection.objects.link(parent)
        parent.scale = 1.0, 2.5, 0.5
        parent.location = 3.0, -2.0, 1.0
        obj = self.ball(4)
        obj.parent = parent
        obj.rotation_euler = 0.4, 0.3, math.radians(35.0)
        obj.scale = -1.0, 1.3, 0.7
        return obj

    def test_world_units_are_round_in_the_world(self):
        obj = self.transformed()
        before = self.in_world(obj, self.places(obj))
        root = 400
        self.pull(vertex=root, radius=0.8, strength=0.3, direction='Z', falloff='LINEAR')
        after = self.in_world(obj, self.places(obj))
        distances = np.linalg.norm(before - before[root], axis=1)
        self.assertNear(after - before, 0.3 * np.outer(forces('LINEAR', distances, 0.8), (0.0, 0.0, 1.0)), 5e-6)
        self.assertGreater(np.count_nonzero((after != before).any(axis=1)), 20)

    def test_world_normal(self):
        obj = self.transformed()
        root = 400
        before = self.in_world(obj, self.places(obj))
        matrix = np.array(obj.matrix_world)[:3, :3]
        normal = np.linalg.inv(matrix).T @ np.array(obj.data.vertices[root].normal)
        normal /= np.linalg.norm(normal)
        self.pull(vertex=root, radius=0.8, strength=0.3)
        self.assertNear(self.in_world(obj, self.places(obj))[root] - before[root], 0.3 * normal, 5e-6)

    def test_local_units(self):
        obj = self.transformed()
        places = self.places(obj)
        root = 400
        distances = np.linalg.norm(places - places[root], axis=1)
        moved = self.moved_by(obj, vertex=root, radius=0.4, strength=0.2, direction='X', unit='LOCAL')
        self.assertNear(moved, 0.2 * np.outer(forces('SMOOTH', distances, 0.4), (1.0, 0.0, 0.0)))
        obj = self.transformed()
        moved = self.moved_by(obj, location=places[root] * 1.01, radius=0.4, strength=0.2, unit='LOCAL')
        self.assertNear(moved[root], 0.2 * np.array(obj.data.vertices[root].undeformed_co.normalized()), 2e-3)

    def test_location_in_the_world(self):
        obj = self.transformed()
        root = 123
        place = self.in_world(obj, self.places(obj))[root]
        moved = self.moved_by(obj, location=place, radius=0.05, strength=0.1)
        self.assertEqual(np.flatnonzero(moved.any(axis=1)).tolist(), [root])

    def test_nearest_in_the_world_rather_than_in_the_object(self):
        obj = self.mesh([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.4, 0.0)], [(0, 1, 2)])
        obj.scale = 0.1, 10.0, 1.0
        # Half way along X it is 0.05 from two vertices, in the object 0.5; the third is at 0.64 there, and at 4 here.
        moved = self.moved_by(obj, location=(0.06, 0.0, 0.0), radius=0.05, strength=0.1)
        self.assertEqual(np.flatnonzero(moved.any(axis=1)).tolist(), [1])


class Masks(PullTestCase):
    def test_vertex_group(self):
        obj = self.plane()
        group = obj.vertex_groups.new(name="Soft")
        rest = obj.vertex_groups.new(name="Rest")
        rest.add(list(range(441)), 1.0, 'REPLACE')
        weights = np.zeros(441)
        for index in range(0, 441, 2):
            weights[index] = (index % 10) / 10.0
            group.add([index], weights[index], 'REPLACE')
        distances = np.linalg.norm(self.places(obj), axis=1)
        moved = self.moved_by(obj, vertex=self.middle(obj), radius=0.9, strength=0.4, vertex_group="Soft")
        self.assertNear(moved[:, 2], 0.4 * weights * forces('SMOOTH', distances, 0.9))

    def test_hidden_vertices_stay(self):
        obj = self.plane()
        hidden = np.arange(441) % 3 == 0
        obj.data.vertices.foreach_set("hide", hidden)
        root = int(np.flatnonzero(~hidden)[np.linalg.norm(self.places(obj)[~hidden], axis=1).argmin()])
        moved = self.moved_by(obj, location=(0.0, 0.0, 0.0), radius=0.9, strength=0.4, direction='Z')
        self.assertEqual(np.count_nonzero(moved[hidden]), 0)
        self.assertGreater(np.count_nonzero(moved[~hidden, 2]), 100)
        self.assertNear(moved[root, 2], 0.4)

    def test_sculpt_mask(self):
        obj = self.plane()
        if hasattr(obj.data, "vertex_paint_masks"):
            self.skipTest("only an operator makes a mask here, and that crashes in the background")
        mask = obj.data.attributes.new(".sculpt_mask", 'FLOAT', 'POINT')
        mask.data.foreach_set("value", np.full(441, 0.25, np.float32))
        bpy.ops.object.mode_set(mode='SCULPT')
        moved = self.moved_by(obj, vertex=220, radius=0.5, strength=0.4)
        self.assertAlmostEqual(moved[220, 2], 0.3, places=6)


class ShapeKeys(PullTestCase):
    def keyed(self):
        """A plane with a basis, a key "Hill" on it, a key "Peak" on that one, and an unrelated one."""
        obj = self.plane()
        obj.shape_key_add(name="Basis")
        hill, peak = obj.shape_key_add(name="Hill"), obj.shape_key_add(name="Peak")
        obj.shape_key_add(name="Other").relative_key = hill
        bpy.data.objects["Mesh"].data.shape_keys.key_blocks["Other"].relative_key = peak
        peak.relative_key = hill
        hill.data[0].co.z, peak.data[0].co.z = 1.0, 2.0
        return obj

    def keys(self, obj):
        return {key.name: np.array([point.co[:] for point in key.data]) for key in obj.data.shape_keys.key_blocks}

    def test_the_active_key_is_written_and_those_relative_to_it_go_along(self):
        for active, moving in (("Basis", {"Basis", "Hill", "Peak", "Other"}), ("Hill", {"Hill", "Peak", "Other"}), ("Other", {"Other"})):
            for mode in ('OBJECT', 'EDIT'):
                with self.subTest(active=active, mode=mode):
                    obj = self.keyed()
                    obj.active_shape_key_index = obj.data.shape_keys.key_blocks.find(active)
                    obj.active_shape_key.value = 1.0
                    before, mesh_before = self.keys(obj), self.places(obj)
                    bpy.ops.object.mode_set(mode=mode)
                    self.pull(vertex=220, radius=0.5, strength=0.3, direction='Z')
                    bpy.ops.object.mode_set(mode='OBJECT')
                    after = self.keys(obj)
                    wanted = 0.3 * forces('SMOOTH', np.linalg.norm(before["Basis"], axis=1), 0.5)
                    for key in obj.data.shape_keys.key_blocks:
                        is_indirect = key.name in moving - {active} and key.relative_key.name != active
                        if mode == 'EDIT' and is_indirect:
                            continue  # it is Blender that moves those then; 3.4 leaves them
                        expected = wanted if key.name in moving else np.zeros(441)
                        self.assertNear(after[key.name][:, 2] - before[key.name][:, 2], expected)
                    expected = wanted if active == "Basis" else np.zeros(441)
                    self.assertNear(self.places(obj)[:, 2] - mesh_before[:, 2], expected)

    def test_scripts_remove_the_key_meanwhile(self):
        open_mesh = support.addon("pull.mesh.open_mesh").open_mesh
        for name in ("Hill", "Peak"):  # the one that is written, and one that goes along
            self.setUp()
            obj = self.keyed()
            obj.active_shape_key_index = 1
            mesh = open_mesh(obj)
            positions = mesh.positions()
            mesh.write(positions)
            obj.shape_key_remove(obj.data.shape_keys.key_blocks[name])
            self.assertRaises(ReferenceError, mesh.write, positions)

    def test_a_key_without_effect_is_said(self):
        obj = self.keyed()
        obj.active_shape_key_index = 1
        obj.active_shape_key.value = 0.0
        bpy.ops.motus.pick_pull(vertex=220, radius=0.5, strength=0.3, direction='Z')
        self.assertNear(self.keys(obj)["Hill"][220, 2], 0.3)


class Modifiers(PullTestCase):
    def test_the_base_mesh_is_pulled(self):
        obj = self.plane()
        obj.modifiers.new("Subdivision", 'SUBSURF')
        distances = np.linalg.norm(self.places(obj), axis=1)
        moved = self.moved_by(obj, vertex=self.middle(obj), radius=0.5, strength=0.3)
        self.assertNear(moved[:, 2], 0.3 * forces('SMOOTH', distances, 0.5))
        self.assertGreater(self.seen(obj)[:, 2].max(), 0.2)

    def test_what_is_evaluated_follows(self):
        obj = self.plane()
        bpy.context.view_layer.update()
        self.pull(vertex=self.middle(obj), radius=0.5, strength=0.3)
        self.assertNear(self.seen(obj), self.places(obj), 0.0)
        evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
        hit, place, _, _ = evaluated.ray_cast((0.0, 0.0, 5.0), (0.0, 0.0, -1.0))
        self.assertTrue(hit)
        self.assertAlmostEqual(place[2], 0.3, places=5)
        self.assertGreater(evaluated.data.vertices[10 * 21 + 12].normal[0], 0.3)


class Modes(PullTestCase):
    def test_edit_mode(self):
        obj = self.plane()
        bpy.ops.object.mode_set(mode='EDIT')
        edit = bmesh.from_edit_mesh(obj.data)
        edit.verts.ensure_lookup_table()
        edit.verts[0].co.z = 0.5  # which only the edit mesh knows
        distances = np.linalg.norm(self.places(obj), axis=1)
        moved = self.moved_by(obj, vertex=220, radius=0.6, strength=0.3)
        self.assertNear(moved[:, 2], 0.3 * forces('SMOOTH', distances, 0.6))
        edit = bmesh.from_edit_mesh(obj.data)
        edit.verts.ensure_lookup_table()
        self.assertGreater(edit.verts[10 * 21 + 13].normal.x, 0.3)
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertAlmostEqual(self.places(obj)[220, 2], 0.3, places=6)
        self.assertAlmostEqual(self.places(obj)[0, 2], 0.5, places=6)

    def test_hidden_in_edit_mode(self):
        obj = self.plane()
        bpy.ops.object.mode_set(mode='EDIT')
        edit = bmesh.from_edit_mesh(obj.data)
        edit.verts.ensure_lookup_table()
        for index in range(0, 441, 3):
            edit.verts[index].hide_set(True)
        bmesh.update_edit_mesh(obj.data)
        moved = self.moved_by(obj, vertex=220, radius=0.6, strength=0.3, direction='Z')
        hidden = np.arange(441) % 3 == 0
        self.assertEqual(np.count_nonzero(moved[hidden]), 0)
        self.assertGreater(np.count_nonzero(moved[~hidden, 2]), 50)

    def test_sculpt_mode(self):
        obj = self.plane()
        bpy.ops.object.mode_set(mode='SCULPT')
        distances = np.linalg.norm(self.places(obj), axis=1)
        moved = self.moved_by(obj, vertex=220, radius=0.6, strength=0.3)
        self.assertNear(moved[:, 2], 0.3 * forces('SMOOTH', distances, 0.6))
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertAlmostEqual(self.places(obj)[220, 2], 0.3, places=6)

    def test_one_undo_step(self):
        obj = self.plane()
        name = obj.name
        for mode in ('OBJECT', 'EDIT', 'SCULPT'):
            with self.subTest(mode=mode):
                bpy.ops.object.mode_set(mode=mode)
                bpy.ops.ed.undo_push(message="Before")
                bpy.ops.motus.pick_pull('EXEC_DEFAULT', True, vertex=220, radius=0.5, strength=0.3, direction='Z')
                obj = bpy.data.objects[name]
                self.assertAlmostEqual(self.places(obj)[220, 2], 0.3, places=6)
                bpy.ops.ed.undo()
                obj = bpy.data.objects[name]
                self.assertEqual(obj.mode, mode)
                self.assertEqual(self.places(obj)[220, 2], 0.0)
                bpy.ops.ed.redo()
                obj = bpy.data.objects[name]
                self.assertAlmostEqual(self.places(obj)[220, 2], 0.3, places=6)
                bpy.ops.ed.undo()
                bpy.ops.object.mode_set(mode='OBJECT')


class Defects(PullTestCase):
    """Meshes that are no clean surface."""

    def assertPulls(self, obj, root, **keywords):
        """By every distance the root goes all the way, nothing is lost, and what is out of reach stays."""
        for distance, radius in (('STRAIGHT', 0.5), ('SURFACE', 0.5), ('EDGES', 3.0)):
            with self.subTest(mesh=obj.name, distance=distance):
                before = self.places(obj)
                moved = self.moved_by(
                    obj, object=obj.name, vertex=root, radius=radius, displacement=(0.0, 0.0, 0.25), distance=distance, **keywords
                )
                self.assertNear(moved[root], (0.0, 0.0, 0.25))
                self.assertTrue(np.isfinite(self.places(obj)).all())
                away = np.linalg.norm(before - before[root], axis=1)
                if distance != 'EDGES':
                    self.assertEqual(np.count_nonzero(moved[away >= 0.5 + 1e-6]), 0)

    def test_three_leaves_at_an_edge(self):
        spine = [(0.0, 0.0, 0.0), (0.0, 0.3, 0.0)]
        places = spine + [(x, y, z) for x, z in ((0.3, 0.0), (-0.3, 0.0), (0.0, 0.3)) for y in (0.0, 0.3)]
        obj = self.mesh(places, [(0, 1, 3, 2), (0, 1, 5, 4), (0, 1, 7, 6)])
        self.assertPulls(obj, 0)

    def test_loose_vertices_and_wires(self):
        places = [(0, 0, 0), (0.1, 0, 0), (0.2, 0, 0), (0, 0.2, 0), (5, 5, 5)]
        obj = self.mesh(places, edges=[(0, 1), (1, 2)])
        self.assertPulls(obj, 0)
        before = self.places(obj)
        self.pull(vertex=0, radius=0.5, displacement=(0, 0, 1), distance='SURFACE', falloff='CONSTANT')
        self.assertNear((self.places(obj) - before)[:, 2], (1, 1, 1, 0, 0))

    def test_faces_without_area(self):
        places = [(0, 0, 0), (0.2, 0, 0), (0.1, 0, 0), (0.1, 0.2, 0), (0.1, 0.2, 0), (0.1, 0.2, 0)]
        obj = self.mesh(places, [(0, 1, 2), (0, 1, 3), (3, 4, 5), (2, 3, 4)])
        self.assertPulls(obj, 0)

    def test_a_vertex_that_is_nowhere(self):
        obj = self.plane()
        obj.data.vertices[7].co = math.nan, 0.0, 0.0
        self.assertRefused("not finite", vertex=7)
        before = self.places(obj)
        for keywords in ({}, {"distance": 'SURFACE'}, {"radius": 0.05}):
            for accumulate in (True, False):
                self.assertRefused("Vertex 7 is at no place: its coordinates are not finite", vertex=220, accumulate=accumulate, **keywords)
                np.testing.assert_array_equal(self.places(obj), before)

    def test_points_only(self):
        obj = self.mesh([(0.0, 0.0, 0.0)])
        self.assertPulls(obj, 0)


class Large(PullTestCase):
    def surface(self, obj):
        found = np.empty(3 * len(obj.data.vertices), np.float32)
        obj.data.vertices.foreach_get("co", found)
        return found.reshape(-1, 3).astype(float)

    def test_suzanne_of_half_a_million(self):
        bpy.ops.mesh.primitive_monkey_add()
        obj = bpy.context.object
        modifier = obj.modifiers.new("Subdivision", 'SUBSURF')
        modifier.levels = 5
        bpy.ops.object.modifier_apply(modifier=modifier.name)
        before = self.surface(obj)
        self.assertGreater(len(before), 490_000)
        root = int(before[:, 1].argmin())
        for distance in ('STRAIGHT', 'SURFACE'):
            places = self.surface(obj)
            away = np.linalg.norm(places - places[root], axis=1)
            self.pull(vertex=root, radius=0.3, strength=0.1, direction='Y', distance=distance)
            moved = self.surface(obj) - places
            self.assertNear(moved[root], (0.0, 0.1, 0.0))
            self.assertEqual(np.count_nonzero(moved[away >= 0.3 + 1e-6]), 0)
            if distance == 'STRAIGHT':
                self.assertNear(moved[:, 1], 0.1 * forces('SMOOTH', away, 0.3))
            else:
                self.assertTrue((moved[:, 1] <= 0.1 * forces('SMOOTH', away, 0.3) + 1e-5).all())
                self.assertGreater(np.count_nonzero(moved), 1000)

    def test_a_grid_of_a_million(self):
        """It takes a second or two."""
        bpy.ops.motus.grid_add(width=4, height=4)
        start = time.process_time()
        self.assertEqual(bpy.ops.motus.grid_add(width=1000, height=1000, spacing=0.01), {'FINISHED'})
        self.assertLess(time.process_time() - start, 5.0)
        obj = bpy.context.object
        self.assertEqual(len(obj.data.vertices), 1_000_000)
        self.assertFalse(obj.data.validate(verbose=False))
        before = self.surface(obj)
        away = np.linalg.norm(before - before[500_500], axis=1)
        self.pull(vertex=500_500, radius=2.0, strength=1.0)
        moved = self.surface(obj) - before
        self.assertNear(moved[:, 2], forces('SMOOTH', away, 2.0), 4e-6)
