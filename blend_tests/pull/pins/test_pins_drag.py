"""motus.pin_drag from scripts: the root comes to a place in the world, whatever acts behind the pin."""

import bpy
import numpy as np
from mathutils import Vector

import support
from pull.pins import pin_cases as cases
from pull.pins.pin_cases import add, basis, evaluated, vertex_at


class DragTest(cases.PinsTestCase):
    def setUp(self):
        super().setUp()
        self.grid = cases.new_grid(41, 4.0)
        self.vertex = vertex_at(self.grid, 0.5, 0.5)
        add(self.grid, vertex_at(self.grid, -1.5, -1.5), name="Other")
        self.pin = add(self.grid, self.vertex, name="Dragged")

    def root(self):
        bpy.context.view_layer.update()
        return self.grid.matrix_world @ Vector(evaluated(self.grid)[self.vertex])

    def assert_goes_to(self, place, tolerance=1e-5):
        bpy.ops.motus.pin_drag(object=self.grid.name, index=1, location=place)
        self.assertLess((self.root() - Vector(place)).length, tolerance)

    def test_root_comes_to_the_place(self):
        before = evaluated(self.grid)[vertex_at(self.grid, -1.5, -1.5)].copy()
        self.grid.motus.pull.active_pin = 0
        self.assert_goes_to((0.7, 0.2, 1.5))
        self.assertEqual(self.grid.motus.pull.active_pin, 1)
        self.assert_bits(evaluated(self.grid)[vertex_at(self.grid, -1.5, -1.5)], before)

    def test_strength_influence_and_the_object(self):
        self.grid.location, self.grid.rotation_euler, self.grid.scale = (1, 2, 3), (0.3, 0.5, 0.7), (1.0, 2.0, 0.5)
        self.pin.strength, self.grid.motus.pull.influence = -0.5, 0.7
        bpy.context.view_layer.update()
        self.assert_goes_to(tuple(self.root() + Vector((0.2, -0.4, 0.3))), 2e-5)
        self.assertAlmostEqual(self.pin.strength, -0.5)

    def test_keyed_strength_of_the_frame(self):
        cases.key_strength(self.pin, {1: 0.0, 11: 1.0})
        support.go_to(6)
        self.assert_goes_to((0.5, 0.5, 2.0))

    def test_weights_of_a_vertex_group(self):
        group = self.grid.vertex_groups.new(name="Half")
        group.add(range(len(self.grid.data.vertices)), 0.5, 'REPLACE')
        self.pin.vertex_group = "Half"
        bpy.context.view_layer.update()
        self.assert_goes_to((0.5, 0.5, 2.0))

    def test_where_modifiers_make_other_vertices(self):
        """There the handle is where the pin pulls the root to."""
        self.grid.modifiers.new("Subdivision", 'SUBSURF').levels = 1
        bpy.context.view_layer.update()
        bpy.ops.motus.pin_drag(object=self.grid.name, index=1, location=(0.5, 0.5, 2.0))
        self.assertLess((Vector(self.pin.displacement) - Vector((0.0, 0.0, 2.0))).length, 1e-5)

    def test_scripts_remove_it_meanwhile(self):
        held = support.addon("pull.pins.dragging").Held
        pins = support.addon("pull.pins.setup")
        for remove in (lambda: pins.remove(self.grid, {1}), lambda: bpy.data.objects.remove(self.grid)):
            self.setUp()
            dragged = held(bpy.context, self.grid, 1)
            dragged.pull((0.5, 0.5, 1.0))
            remove()
            self.assertRaises(ReferenceError, dragged.pull, (0.5, 0.5, 2.0))
            self.assertRaises(ReferenceError, dragged.restore)

    def test_handles(self):
        handles = support.addon("pull.pins.handles")
        found = handles.read(self.grid, bpy.context.evaluated_depsgraph_get())
        self.assertEqual(found.indices.tolist(), [0, 1])
        self.assertTrue(np.allclose(found.places[1], evaluated(self.grid)[self.vertex], atol=1e-6))
        self.assertTrue(np.allclose(found.starts[1], basis(self.grid)[self.vertex], atol=1e-6))
        self.assertTrue(found.acts.all() and not found.is_broken.any())
        self.pin.is_muted = True
        self.grid.data.attributes.remove(self.grid.data.attributes["motus_pin"])
        self.grid.data.vertices[vertex_at(self.grid, -1.5, -1.5)].co.z += 0.1
        self.grid.data.update()
        bpy.context.view_layer.update()
        found = handles.read(self.grid, bpy.context.evaluated_depsgraph_get())
        self.assertEqual((found.acts.tolist(), found.is_broken.tolist()), ([False, False], [True, False]))

    def test_refusals(self):
        drag, name = bpy.ops.motus.pin_drag, self.grid.name
        self.assert_refused("location is missing", drag, object=name, index=1)
        self.assert_refused("no such pull pin", drag, object=name, index=7, location=(0, 0, 0))
        self.assert_refused("not a finite number", drag, object=name, index=1, location=(0, 0, float("inf")))
        self.pin.is_muted = True
        self.assert_refused("does not pull now", drag, object=name, index=1, location=(0, 0, 1))
        self.pin.is_muted = False
        self.grid.data.attributes.remove(self.grid.data.attributes["motus_pin"])
        self.grid.data.vertices[self.vertex].co.z += 0.1
        self.grid.data.update()
        bpy.context.view_layer.update()
        self.assert_refused("lost their place", drag, object=name, index=1, location=(0, 0, 1))
