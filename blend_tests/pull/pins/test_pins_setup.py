"""Operators of pins: adding, removing, reordering, mirroring; what they leave behind and what they refuse."""

import bpy
import numpy as np

import support
from pull.pins import pin_cases as cases
from pull.pins.pin_cases import add, basis, centre, evaluated, vertex_at
from support import go_to

motus = bpy.ops.motus


def inventory(obj):
    """All that a set-up could leave behind."""
    lists = ("objects", "meshes", "node_groups", "actions")
    return (
        [modifier.name for modifier in obj.modifiers],
        sorted(obj.data.attributes.keys()),
        list(obj.data.keys()),
        obj.animation_data is None,
        obj.data.users,
        obj.data.attributes.active_index,
        [len(getattr(bpy.data, name)) for name in lists],
    )


class RemoveTest(cases.PinsTestCase):
    def test_the_last_one_removed_leaves_nothing(self):
        grid = cases.new_grid()
        grid.modifiers.new("Bevel", 'BEVEL')
        grid.modifiers.active = grid.modifiers[0] if hasattr(grid.modifiers, "active") else None
        before, shape = inventory(grid), basis(grid)
        cases.key_strength(add(grid, centre(grid)), {1: 0.0, 5: 1.0})
        add(grid, 3)
        motus.pin_remove(index=1)
        self.assertEqual(len(grid.motus.pull.pins), 1)
        motus.pin_remove()
        self.assertEqual(inventory(grid), before)
        self.assert_bits(basis(grid), shape)
        self.assertFalse(grid.motus.pull.is_active)

    def test_all_at_once(self):
        grid = cases.new_grid()
        before = inventory(grid)
        for vertex in (3, 60, 200):
            add(grid, vertex)
        motus.pin_remove(all=True)
        self.assertEqual(inventory(grid), before)

    def test_marks_go_with_their_pins(self):
        grid = cases.new_grid()
        for vertex in (3, 60, 60):
            add(grid, vertex)
        motus.pin_remove(index=1)
        marked = np.empty(len(basis(grid)), np.int32)
        grid.data.attributes["motus_pin"].data.foreach_get("value", marked)
        self.assertEqual(np.flatnonzero(marked).tolist(), [3, 60])
        motus.pin_remove(index=1)
        grid.data.attributes["motus_pin"].data.foreach_get("value", marked)
        self.assertEqual(np.flatnonzero(marked).tolist(), [3])

    def test_keys_stay_with_their_pins(self):
        grid = cases.new_grid()
        roots = [centre(grid), vertex_at(grid, 0.6, 0.6), vertex_at(grid, -0.6, 0.6)]
        for index, root in enumerate(roots):
            cases.key_strength(add(grid, root, radius=0.3), {1: 0.0, 11: 1.0 + index})
        motus.pin_move(index=0, direction='DOWN')
        motus.pin_remove(index=0)
        go_to(11)
        heights = evaluated(grid)[roots, 2]
        self.assertEqual([round(float(height), 5) for height in heights], [1.0, 0.0, 3.0])
        self.assertEqual(len(support.addon("core.blender.actions").fcurves(grid)), 2)

    def keyed_pins(self):
        """A grid whose three pins reach 1, 2 and 3 at frame 11, and their roots."""
        grid = cases.new_grid()
        roots = [centre(grid), vertex_at(grid, 0.6, 0.6), vertex_at(grid, -0.6, 0.6)]
        for index, root in enumerate(roots):
            cases.key_strength(add(grid, root, radius=0.3), {1: 0.0, 11: 1.0 + index})
        return grid, roots

    def assert_heights(self, obj, roots, *wanted):
        go_to(11)
        heights = evaluated(obj)[roots, 2]
        self.assertEqual([round(float(height), 5) for height in heights], list(wanted))

    def test_another_object_with_the_same_action_keeps_its_keys(self):
        grid, roots = self.keyed_pins()
        other = grid.copy()
        bpy.context.collection.objects.link(other)
        self.assertEqual(other.animation_data.action, grid.animation_data.action)
        motus.pin_remove(object=other.name, index=0)
        self.assert_heights(grid, roots, 1.0, 2.0, 3.0)
        self.assert_heights(other, roots, 0.0, 2.0, 3.0)
        motus.pin_move(object=other.name, index=0, direction='DOWN')
        self.assert_heights(grid, roots, 1.0, 2.0, 3.0)
        self.assert_heights(other, roots, 0.0, 2.0, 3.0)

    def test_keys_in_strips_stay_with_their_pins(self):
        grid, roots = self.keyed_pins()
        animation = grid.animation_data
        action = animation.action
        slot = getattr(animation, "action_slot", None)
        strip = animation.nla_tracks.new().strips.new("Pulls", 1, action)
        if slot:
            strip.action_slot = slot
        animation.action = None
        self.assert_heights(grid, roots, 1.0, 2.0, 3.0)
        motus.pin_move(index=0, direction='DOWN')
        self.assert_heights(grid, roots, 1.0, 2.0, 3.0)
        motus.pin_remove(index=0)
        self.assert_heights(grid, roots, 1.0, 0.0, 3.0)
        motus.pin_apply(to='KEYS')
        values = [key.value for key in grid.data.shape_keys.key_blocks[1:]]
        self.assertEqual(sorted(round(value, 5) for value in values), [1.0, 3.0])

    def test_drivers_that_read_a_pin_go_along(self):
        """Of other datablocks, of node trees and of the object itself; who reads a pin that is removed reads no other."""
        grid = cases.new_grid()
        for strength in (0.1, 0.2, 0.3):
            add(grid, centre(grid), strength=strength)
        other, material = bpy.data.objects.new("Other", None), bpy.data.materials.new("Paint")
        bpy.context.scene.collection.objects.link(other)
        material.use_nodes = True
        key = bpy.data.objects.new("Keyed", grid.data.copy()).shape_key_add(name="Basis").id_data
        holders = (
            (other, "location", 0),
            (grid, "rotation_euler", 1),
            (material.node_tree, "nodes[0].location", 0),
            (key, "eval_time", -1),
            (other, "location", 2),
        )
        targets = [self.reading(grid, number, *holder) for number, holder in zip((0, 1, 2, 0, 1), holders)]
        paths = lambda: [target.data_path for target in targets]  # noqa: E731
        wanted = lambda *numbers: [f"motus.pull.pins[{number}].strength" for number in numbers]  # noqa: E731
        self.assertEqual(paths(), wanted(0, 1, 2, 0, 1))
        motus.pin_move(index=0, place=2)
        self.assertEqual(paths(), wanted(2, 0, 1, 2, 0))
        go_to(2)
        self.assertAlmostEqual(other.location.x, 0.1)
        self.assertAlmostEqual(other.location.z, 0.2)
        motus.pin_remove(index=0)
        (gone,) = {paths()[1], paths()[4]}
        self.assertEqual([paths()[index] for index in (0, 2, 3)], wanted(1, 0, 1))
        with self.assertRaises((ValueError, KeyError)):
            grid.path_resolve(gone)
        go_to(3)
        self.assertAlmostEqual(other.location.x, 0.1)
        motus.pin_remove(all=True)
        self.assertEqual(set(paths()), {gone})

    def reading(self, obj, number, holder, path, index):
        """The target of a new driver that reads the strength of a pin."""
        curve = holder.driver_add(path, index)
        curve.driver.type = 'SUM'
        variable = curve.driver.variables.new()
        variable.targets[0].id = obj
        variable.targets[0].data_path = f"motus.pull.pins[{number}].strength"
        return variable.targets[0]

    def test_each_pin_operator_is_one_undo_step(self):
        grid = cases.new_grid()
        bpy.ops.ed.undo_push(message="start")
        add(grid, 60)
        bpy.ops.ed.undo_push(message="one")
        add(bpy.data.objects["Grid"], centre(bpy.data.objects["Grid"]))
        shape = evaluated(bpy.data.objects["Grid"]).copy()
        bpy.ops.ed.undo_push(message="two")
        bpy.ops.ed.undo()
        self.assertEqual(len(bpy.data.objects["Grid"].motus.pull.pins), 1)
        self.assertLess(evaluated(bpy.data.objects["Grid"])[centre(bpy.data.objects["Grid"]), 2], 0.5)
        bpy.ops.ed.redo()
        self.assert_bits(evaluated(bpy.data.objects["Grid"]), shape)
        bpy.ops.ed.undo()
        bpy.ops.ed.undo()
        grid = bpy.data.objects["Grid"]
        self.assertEqual(len(grid.modifiers), 0)
        self.assert_bits(evaluated(grid), basis(grid))


class ListTest(cases.PinsTestCase):
    def test_names_are_unique(self):
        grid = cases.new_grid()
        add(grid, 3, name="Nose")
        add(grid, 4, name="Nose")
        self.assertEqual([pin.name for pin in grid.motus.pull.pins], ["Nose", "Nose.001"])

    def test_mirrored_pin_has_a_strength_of_its_own(self):
        grid = cases.new_grid()
        root, other = vertex_at(grid, 0.6, 0.2), vertex_at(grid, -0.6, 0.2)
        add(grid, root, (0.2, 0.0, 1.0), radius=0.4)
        motus.pin_mirror(axis='X')
        grid.motus.pull.pins[1].strength = 0.5
        wanted = cases.pulled(basis(grid), root, (0.2, 0.0, 1.0), 0.4)
        wanted = cases.pulled(wanted, other, (-0.1, 0.0, 0.5), 0.4, source=basis(grid))
        self.assert_shape(grid, wanted)

    def test_mirrored_limits(self):
        grid = cases.new_grid()
        root, other = vertex_at(grid, 0.4, 0.2), vertex_at(grid, -0.4, 0.2)
        add(grid, root, (0.5, 0.0, 0.0), radius=0.3, use_maximum=True, maximum=0.6, clamp_axis='X')
        motus.pin_mirror(axis='X')
        shape = evaluated(grid)
        self.assertAlmostEqual(shape[root, 0], 0.6, places=6)
        self.assertAlmostEqual(shape[other, 0], -0.6, places=6)

    def test_two_objects_with_one_mesh(self):
        grid = cases.new_grid()
        twin = bpy.data.objects.new("Twin", grid.data)
        bpy.context.scene.collection.objects.link(twin)
        first, second = centre(grid), vertex_at(grid, 0.5, 0.5)
        add(grid, first)
        add(twin, second, (0.0, 1.0, 0.0))
        add(twin, first, radius=0.3)
        self.assert_shape(grid, cases.pulled(basis(grid), first, (0.0, 0.0, 1.0)))
        wanted = cases.pulled(basis(grid), second, (0.0, 1.0, 0.0))
        self.assert_shape(twin, cases.pulled(wanted, first, (0.0, 0.0, 1.0), 0.3, source=basis(grid)))
        motus.pin_remove(object="Grid", all=True)
        self.assert_shape(twin, cases.pulled(wanted, first, (0.0, 0.0, 1.0), 0.3, source=basis(grid)))
        motus.pin_remove(object="Twin", all=True)
        self.assertNotIn("motus_pin", grid.data.attributes)

    def test_a_removed_modifier_can_be_restored(self):
        grid = cases.new_grid()
        root = centre(grid)
        add(grid, root)
        grid.modifiers.clear()
        self.assert_bits(evaluated(grid), basis(grid))
        motus.pin_restore()
        self.assert_shape(grid, cases.pulled(basis(grid), root, (0.0, 0.0, 1.0)))


class LastPullTest(cases.PinsTestCase):
    def test_the_last_pull_becomes_a_pin(self):
        monkey = cases.new_monkey()
        before = basis(monkey)
        root = int(before[:, 1].argmin())
        motus.pick_pull(vertex=root, radius=0.5, strength=0.3, falloff='SPHERE')
        pulled = basis(monkey)
        self.assertGreater(np.abs(pulled - before).max(), 0.2)
        motus.pin_add(from_last=True)
        self.assert_bits(basis(monkey), before)
        self.assert_shape(monkey, pulled)
        monkey.motus.pull.pins[0].strength = 0.0
        self.assert_bits(evaluated(monkey), before)

    def test_not_after_the_mesh_has_changed(self):
        monkey = cases.new_monkey()
        motus.pick_pull(vertex=10, radius=0.5, strength=0.3)
        monkey.data.vertices[7].co.x += 0.1
        monkey.data.update()
        self.assert_refused("changed since the last pull", motus.pin_add, from_last=True)

    def test_without_a_pull_no_pin_is_made(self):
        cases.new_grid()
        self.assert_refused("Nothing was pulled", motus.pin_add, from_last=True)


class RefusalTest(cases.PinsTestCase):
    def test_impossible_pins_are_refused(self):
        grid = cases.new_grid()
        self.assert_refused("no vertex 99999", motus.pin_add, vertex=99999)
        self.assert_refused("not a finite number", motus.pin_add, vertex=0, displacement=(float("nan"), 0.0, 0.0))
        self.assert_refused("no vertex group", motus.pin_add, vertex=0, vertex_group="None")
        self.assert_refused("no such pull pin", motus.pin_remove)
        self.assert_refused("has no pins", motus.pin_apply)
        self.assert_refused("no object", motus.pin_add, object="Nobody", vertex=0)
        add(grid, 5)
        self.assert_refused("no such pull pin", motus.pin_move, index=7)
        self.assert_refused("end of the list", motus.pin_move, direction='UP')

    def test_multiresolution(self):
        grid = cases.new_grid(5)
        grid.modifiers.new("Multires", 'MULTIRES')
        self.assert_refused("Multiresolution", motus.pin_add, vertex=0)

    def test_bake_says_what_to_do_instead(self):
        grid = cases.new_grid()
        add(grid, 5)
        self.assert_refused("apply them to shape keys", motus.bake)

    def test_something_else_of_the_object_can_be_baked(self):
        grid = cases.new_grid()
        add(grid, 5)
        curve = bpy.data.curves.new("Path", 'CURVE')
        spline = curve.splines.new('BEZIER')
        spline.bezier_points.add(1)
        spline.bezier_points[1].co = (10.0, 0.0, 0.0)
        path = bpy.data.objects.new("Path", curve)
        bpy.context.scene.collection.objects.link(path)
        motus.path_follow_add(object="Grid", curve="Path")
        motus.bake(object="Grid", frame_start=1, frame_end=5)
        self.assertTrue(grid.motus.path.is_baked)
        self.assertFalse(grid.motus.pull.is_baked)
        self.assertGreater(evaluated(grid)[:, 2].max(), 0.9)
