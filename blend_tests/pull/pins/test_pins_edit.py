"""Pins keep their places while the mesh is edited, and say so where they cannot."""

import bmesh
import bpy
import numpy as np

import support
from pull.pins import pin_cases as cases
from pull.pins.pin_cases import add, basis, centre, evaluated, vertex_at

WAY = (0.0, 0.0, 1.0)


def edit(obj, change):
    """Let change(bm) edit the mesh, in object mode."""
    mesh = bmesh.new()
    mesh.from_mesh(obj.data)
    mesh.verts.ensure_lookup_table()
    change(mesh)
    mesh.to_mesh(obj.data)
    mesh.free()
    obj.data.update()
    bpy.context.view_layer.update()


def edit_mode(obj, *operators):
    """Select all, run (operator, keywords) in edit mode, and leave it."""
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.mesh.select_all(action='SELECT')
    for operator, keywords in operators:
        operator(**keywords)
    bpy.ops.object.mode_set(mode='OBJECT')


def state(obj, index=0):
    """What the solver says of a pin: 0 well, 1 lost, 2 ambiguous."""
    wiring, system = support.addon("core.wiring"), support.addon("pull").SYSTEM
    return wiring.output(system, obj, f"pin{index}", bpy.context.evaluated_depsgraph_get())


def problem(obj):
    """The sentence of the panel."""
    wiring, system = support.addon("core.wiring"), support.addon("pull").SYSTEM
    found = wiring.problem(system, obj, bpy.context.evaluated_depsgraph_get())
    return found and found.sentence


class ElsewhereTest(cases.PinsTestCase):
    def setUp(self):
        super().setUp()
        self.grid = cases.new_grid(61, 6.0)
        self.place = basis(self.grid)[vertex_at(self.grid, 0.5, 0.5)].copy()
        add(self.grid, vertex_at(self.grid, 0.5, 0.5))

    def assert_pulled_at_the_place(self):
        root = vertex_at(self.grid, *self.place[:2])
        self.assertLessEqual(np.abs(basis(self.grid)[root] - self.place).max(), 1e-6)
        self.assertEqual(state(self.grid), 0.0)
        self.assert_shape(self.grid, cases.pulled(basis(self.grid), root, WAY))

    def test_a_thousand_vertices_deleted(self):
        edit(
            self.grid,
            lambda mesh: bmesh.ops.delete(mesh, geom=[vertex for vertex in mesh.verts if vertex.co.y < -1.3][:1000], context='VERTS'),
        )
        self.assertEqual(len(self.grid.data.vertices), 61 * 61 - 1000)
        self.assert_pulled_at_the_place()

    def test_a_thousand_vertices_added(self):
        edit(self.grid, lambda mesh: [mesh.verts.new((index * 0.01, -2.0, 1.0)) for index in range(1000)])
        self.assert_pulled_at_the_place()

    def test_pin_on_a_subdivided_mesh(self):
        edit(self.grid, lambda mesh: bmesh.ops.subdivide_edges(mesh, edges=mesh.edges[:], cuts=1, use_grid_fill=True))
        self.assertEqual(len(self.grid.data.vertices), 121 * 121)
        self.assert_pulled_at_the_place()

    def test_subdivided_in_edit_mode(self):
        edit_mode(self.grid, (bpy.ops.mesh.subdivide, {"number_cuts": 2}))
        self.assertEqual(len(self.grid.data.vertices), 181 * 181)
        self.assert_pulled_at_the_place()

    def test_vertices_sorted_anew(self):
        edit_mode(self.grid, (bpy.ops.mesh.sort_elements, {"type": 'RANDOMIZE', "elements": {'VERT'}, "seed": 3}))
        self.assertNotEqual(vertex_at(self.grid, 0.5, 0.5), 61 * 35 + 35)
        self.assert_pulled_at_the_place()

    def test_pin_on_a_mesh_joined_with_its_copy(self):
        other = cases.new_grid(11, 1.0, "Other")
        other.location = (0.0, 0.0, 4.0)
        bpy.context.view_layer.update()
        self.grid.select_set(True)
        bpy.context.view_layer.objects.active = self.grid
        bpy.ops.object.join()
        self.assertEqual(len(self.grid.data.vertices), 61 * 61 + 121)
        self.assert_pulled_at_the_place()

    def test_everything_doubled_where_it_stands_apart(self):
        edit_mode(self.grid, (bpy.ops.mesh.duplicate, {}), (bpy.ops.transform.translate, {"value": (0.0, 0.0, 3.0)}))
        # The copies carry the number too; the root is the one that stands where it stood.
        self.assert_pulled_at_the_place()

    def test_undo_of_an_edit(self):
        bpy.ops.ed.undo_push(message="before")
        shape = evaluated(self.grid).copy()
        edit_mode(self.grid, (bpy.ops.mesh.subdivide, {}))
        bpy.ops.ed.undo_push(message="subdivided")
        bpy.ops.ed.undo()
        self.grid = bpy.data.objects["Grid"]
        bpy.context.view_layer.update()
        self.assert_bits(evaluated(self.grid), shape)
        bpy.ops.ed.redo()
        self.grid = bpy.data.objects["Grid"]
        self.assertEqual(len(self.grid.data.vertices), 121 * 121)
        self.assert_pulled_at_the_place()


class AtThePlaceTest(cases.PinsTestCase):
    def setUp(self):
        super().setUp()
        self.grid = cases.new_grid()
        self.root = centre(self.grid)
        self.pin = add(self.grid, self.root)

    def move_root(self, by):
        self.grid.data.vertices[self.root].co.x += by
        self.grid.data.update()
        bpy.context.view_layer.update()

    def test_the_pin_goes_along_with_its_vertex(self):
        self.move_root(0.04)
        self.assert_shape(self.grid, cases.pulled(basis(self.grid), self.root, WAY))
        self.assertAlmostEqual(self.pin.place[0], basis(self.grid)[self.root, 0], places=6)

    def test_a_moved_root_is_told_from_its_copies(self):
        self.move_root(0.04)
        edit_mode(self.grid, (bpy.ops.mesh.duplicate, {}), (bpy.ops.transform.translate, {"value": (0.0, 0.0, 3.0)}))
        self.assertEqual(state(self.grid), 0.0)
        self.assert_shape(self.grid, cases.pulled(basis(self.grid), self.root, WAY))

    def test_a_deleted_root_is_reported_and_nothing_guessed(self):
        edit(self.grid, lambda mesh: bmesh.ops.delete(mesh, geom=[mesh.verts[self.root]], context='VERTS'))
        self.assert_bits(evaluated(self.grid), basis(self.grid))
        self.assertEqual(state(self.grid), 1.0)
        self.assertIn("lost their place", problem(self.grid))

    def test_other_pins_go_on_without_a_broken_one(self):
        other = vertex_at(self.grid, 0.6, 0.6)
        add(self.grid, other, radius=0.3)
        edit(self.grid, lambda mesh: bmesh.ops.delete(mesh, geom=[mesh.verts[self.root]], context='VERTS'))
        self.assertEqual((state(self.grid, 0), state(self.grid, 1)), (1.0, 0.0))
        self.assert_shape(self.grid, cases.pulled(basis(self.grid), vertex_at(self.grid, 0.6, 0.6), WAY, 0.3))

    def test_copies_of_which_none_stands_there(self):
        mesh = self.grid.data
        places = basis(self.grid)
        anchors = np.zeros(len(places), np.int32)
        anchors[[self.root + 1, self.root + 2]] = self.pin.anchor
        mesh.attributes["motus_pin"].data.foreach_set("value", anchors)
        mesh.update()
        bpy.context.view_layer.update()
        self.assertEqual(state(self.grid), 2.0)
        self.assert_bits(evaluated(self.grid), places)

    def test_pin_is_bound_again(self):
        edit(self.grid, lambda mesh: bmesh.ops.delete(mesh, geom=[mesh.verts[self.root]], context='VERTS'))
        bpy.ops.motus.pin_rebind()
        self.assertEqual(state(self.grid), 0.0)
        found = self.grid.motus.pull.pins[0].vertex
        self.assertLess(np.linalg.norm(basis(self.grid)[found]), 0.11)
        self.assert_shape(self.grid, cases.pulled(basis(self.grid), found, WAY))

    def test_pin_is_bound_to_another_vertex(self):
        other = vertex_at(self.grid, -0.5, 0.4)
        bpy.ops.motus.pin_rebind(vertex=other)
        self.assert_shape(self.grid, cases.pulled(basis(self.grid), other, WAY))
        marked = np.empty(len(basis(self.grid)), np.int32)
        self.grid.data.attributes["motus_pin"].data.foreach_get("value", marked)
        self.assertEqual(np.flatnonzero(marked).tolist(), [other])

    def test_the_mark_is_lost_but_not_the_place(self):
        self.grid.data.attributes.remove(self.grid.data.attributes["motus_pin"])
        self.grid.data.update()
        bpy.context.view_layer.update()
        self.assertEqual(state(self.grid), 0.0)
        self.assert_shape(self.grid, cases.pulled(basis(self.grid), self.root, WAY))

    def test_pin_on_another_mesh(self):
        self.grid.data = cases.new_grid(41, 2.0, "Finer").data
        bpy.context.view_layer.update()
        root = centre(self.grid)
        self.assert_shape(self.grid, cases.pulled(basis(self.grid), root, WAY))

    def test_edges_turned_where_distances_run_along_them(self):
        self.pin.distance, self.pin.radius, self.pin.falloff = 'EDGES', 2.5, 'LINEAR'
        before = evaluated(self.grid).copy()
        edit(self.grid, lambda mesh: bmesh.ops.triangulate(mesh, faces=mesh.faces[:]))
        self.assertEqual(len(before), len(evaluated(self.grid)))
        self.assertGreater(np.abs(evaluated(self.grid) - before).max(), 0.1)

    def test_a_vertex_that_is_nowhere(self):
        self.grid.data.vertices[0].co.x = float("nan")
        self.grid.data.update()
        bpy.context.view_layer.update()
        self.assertIn("not a finite number", problem(self.grid))
        self.assertEqual(evaluated(self.grid)[:, 2].max(), 0.0)

    def test_in_edit_mode_the_mesh_stands_as_it_is(self):
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.context.view_layer.update()
        evaluated_mesh = self.grid.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
        self.assertLess(max(vertex.co.z for vertex in evaluated_mesh.vertices), 1e-6)
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assert_shape(self.grid, cases.pulled(basis(self.grid), self.root, WAY))
