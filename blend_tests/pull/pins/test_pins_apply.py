"""Burning pins in, to the mesh and to shape keys."""

import bpy
import numpy as np

from pull.pins import pin_cases as cases
from pull.pins.pin_cases import add, basis, centre, evaluated, vertex_at
from support import go_to

motus = bpy.ops.motus
FRAMES = (1, 3, 7.5, 11, 30)


class ApplyTest(cases.PinsTestCase):
    def pinned(self):
        grid = cases.new_grid()
        cases.key_strength(add(grid, centre(grid), (0.2, 0.0, 1.0), name="Hill"), {1: 0.0, 11: 1.5})
        add(grid, vertex_at(grid, 0.5, 0.4), (0.0, 0.3, -0.5), radius=0.5, name="Dent", strength=-0.5)
        return grid

    def assert_no_pins(self, obj):
        self.assertEqual(len(obj.motus.pull.pins), 0)
        self.assertEqual([modifier.type for modifier in obj.modifiers if modifier.type == 'NODES'], [])
        self.assertNotIn("motus_pin", obj.data.attributes)

    def test_pins_are_applied_to_the_mesh(self):
        grid = self.pinned()
        go_to(6)
        shape = evaluated(grid).copy()
        motus.pin_apply(to='MESH')
        self.assert_no_pins(grid)
        self.assert_bits(basis(grid), shape)
        go_to(1)
        self.assert_bits(evaluated(grid), shape)

    def test_pins_are_applied_to_a_mesh_with_shape_keys(self):
        grid = self.pinned()
        grid.shape_key_add(name="Basis")
        key = grid.shape_key_add(name="Lift")
        points = key.points if hasattr(key, "points") else key.data
        points.foreach_set("co", (basis(grid) + np.array((0.0, 0.4, 0.1), np.float32)).ravel())
        key.value = 0.7
        go_to(6)
        shape = evaluated(grid).copy()
        motus.pin_apply(to='MESH')
        self.assert_no_pins(grid)
        self.assert_shape(grid, shape)
        key.value = 0.0
        self.assert_shape(grid, shape - 0.7 * np.array((0.0, 0.4, 0.1), np.float32))

    def test_one_of_several_pins_is_applied(self):
        grid = self.pinned()
        go_to(11)
        shape = evaluated(grid).copy()
        motus.pin_apply(to='MESH', index=1)
        self.assertEqual([pin.name for pin in grid.motus.pull.pins], ["Hill"])
        self.assertLess(np.abs(evaluated(grid) - shape).max(), 0.2)

    def test_pins_are_applied_to_one_shape_key(self):
        grid = self.pinned()
        go_to(6)
        before, shape = basis(grid), evaluated(grid).copy()
        motus.pin_apply(to='KEY')
        self.assert_no_pins(grid)
        self.assert_shape(grid, shape)
        grid.data.shape_keys.key_blocks[1].value = 0.0
        self.assert_bits(evaluated(grid), before)

    def test_pins_are_applied_to_shape_keys_with_their_animation(self):
        grid = self.pinned()
        grid.motus.pull.influence = 0.8
        shapes = {}
        for frame in FRAMES:
            go_to(frame)
            shapes[frame] = evaluated(grid).copy()
        motus.pin_apply(to='KEYS')
        self.assert_no_pins(grid)
        blocks = grid.data.shape_keys.key_blocks
        self.assertEqual([key.name for key in blocks], ["Basis", "Hill", "Dent"])
        for frame in FRAMES:
            go_to(frame)
            self.assert_shape(grid, shapes[frame])
        self.assertEqual(blocks["Dent"].value, -0.5)

    def test_drivers_and_mutes_go_along(self):
        grid = self.pinned()
        pins = grid.motus.pull.pins
        pins[1].driver_add("strength").driver.expression = "0.05 * frame"
        pins[0].driver_add("is_muted").driver.expression = "frame > 8"
        shapes = {}
        for frame in FRAMES:
            go_to(frame)
            shapes[frame] = evaluated(grid).copy()
        motus.pin_apply(to='KEYS')
        self.assertIsNone(grid.animation_data)
        for frame in FRAMES:
            go_to(frame)
            self.assert_shape(grid, shapes[frame])

    def test_refusals(self):
        grid = self.pinned()
        twin = bpy.data.objects.new("Twin", grid.data)
        self.assert_refused("used by others", motus.pin_apply, to='MESH')
        bpy.data.objects.remove(twin)
        grid.shape_key_add(name="Basis")
        grid.data.shape_keys.use_relative = False
        self.assert_refused("absolute", motus.pin_apply, to='KEYS')

    def test_a_broken_pin_is_not_lost_silently(self):
        grid = self.pinned()
        grid.data.attributes.remove(grid.data.attributes["motus_pin"])
        grid.data.vertices[centre(grid)].co.x += 0.05
        grid.data.update()
        self.assert_refused("lost their place", motus.pin_apply, to='MESH')
        self.assertEqual(len(grid.motus.pull.pins), 2)
