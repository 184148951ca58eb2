"""motus.lattice_keep: a shape key takes the place of the lattice's points; motus.lattice_rest: the points as they stand deform nothing."""

import bpy
import numpy as np

import support
from lattice import lattice_cases as cases


class KeepTest(support.SceneTestCase):
    def pulled(self, *objects):
        """A lattice around objects, pulled."""
        before = set(bpy.data.objects)
        bpy.ops.motus.lattice_fit(objects=",".join(obj.name for obj in objects))
        (lattice,) = set(bpy.data.objects) - before
        bpy.ops.motus.lattice_pull(object=objects[0].name, location=(1.0, 0.0, 0.0), displacement=(0.3, 0.1, 0.4))
        bpy.context.view_layer.update()
        return lattice

    def test_the_key_takes_the_lattices_place(self):
        ball = cases.ball()
        rest = cases.evaluated(ball)
        lattice = self.pulled(ball)
        seen = cases.evaluated(ball)
        self.assertGreater(np.abs(seen - rest).max(), 0.3)
        self.assertEqual(bpy.ops.motus.lattice_keep(object=ball.name), {'FINISHED'})
        np.testing.assert_allclose(cases.evaluated(ball), seen, atol=1e-6)
        key = ball.data.shape_keys.key_blocks[lattice.name]
        self.assertEqual((key.value, len(ball.data.shape_keys.key_blocks), len(ball.modifiers)), (1.0, 2, 1))
        np.testing.assert_array_equal(cases.shapes().lattice_points(lattice.data), cases.shapes().lattice_points(lattice.data, "co"))
        # The value is a share of the deformation, and the lattice can be pulled on.
        key.value = 0.5
        bpy.context.view_layer.update()
        np.testing.assert_allclose(cases.evaluated(ball), 0.5 * (rest + seen), atol=1e-6)
        bpy.ops.motus.lattice_pull(object=ball.name, location=(0.0, 0.0, 1.0), displacement=(0.0, 0.0, 0.2))
        bpy.context.view_layer.update()
        self.assertGreater(np.abs(cases.evaluated(ball) - 0.5 * (rest + seen)).max(), 0.1)
        # Removed as any shape key is, it leaves nothing behind.
        bpy.ops.motus.lattice_remove(objects=ball.name)
        ball.shape_key_clear()
        bpy.context.view_layer.update()
        np.testing.assert_array_equal(cases.evaluated(ball), rest)

    def test_the_lattice_may_stay_as_it_is(self):
        ball = cases.ball()
        lattice = self.pulled(ball)
        seen, points = cases.evaluated(ball), cases.shapes().lattice_points(lattice.data)
        bpy.ops.motus.lattice_keep(object=lattice.name, name="Smile", use_reset=False)
        self.assertEqual(ball.data.shape_keys.key_blocks["Smile"].value, 0.0)
        np.testing.assert_allclose(cases.evaluated(ball), seen, atol=1e-6)
        np.testing.assert_array_equal(cases.shapes().lattice_points(lattice.data), points)

    def test_other_keys_stay_and_all_objects_get_one(self):
        ball, other = cases.ball(), cases.ball("Other", place=(1.0, 0.0, 0.0))
        ball.shape_key_add(name="Basis")
        own = ball.shape_key_add(name="Own", from_mix=False)
        own.data[0].co.z += 0.5
        own.value = 0.0
        ball.active_shape_key_index = 1
        places = [point.co[:] for point in own.data]
        self.pulled(ball, other)
        seen = [cases.evaluated(obj) for obj in (ball, other)]
        bpy.ops.motus.lattice_keep(object=ball.name, name="Kept")
        for obj, expected in zip((ball, other), seen):
            np.testing.assert_allclose(cases.evaluated(obj), expected, atol=1e-6)
            self.assertEqual(obj.data.shape_keys.key_blocks["Kept"].value, 1.0)
        self.assertEqual([point.co[:] for point in ball.data.shape_keys.key_blocks["Own"].data], places)
        self.assertEqual(ball.active_shape_key.name, "Own")

    def test_refusals(self):
        keep = bpy.ops.motus.lattice_keep
        ball = cases.ball()
        self.assertRefused("deformed by no lattice", keep, object=ball.name)
        self.assertRefused("no lattice modifier None", keep, object=ball.name, modifier="None")
        lattice = self.pulled(ball)
        twin = support.link("Twin", ball.data)
        self.assertRefused("shares its shape", keep, object=ball.name)
        bpy.data.objects.remove(twin)
        ball.modifiers[0].show_viewport = False
        self.assertRefused("switched off", keep, object=lattice.name)
        curve = cases.curve()
        bpy.ops.motus.lattice_fit(objects=curve.name)
        self.assertRefused("is not a mesh", keep, object=curve.name)
        self.assertIsNone(ball.data.shape_keys)

    def test_it_is_one_step_of_undo(self):
        ball = cases.ball()
        self.pulled(ball)
        seen = cases.evaluated(ball)
        bpy.ops.ed.undo_push()
        bpy.ops.motus.lattice_keep(object=ball.name)
        bpy.ops.ed.undo_push()
        bpy.ops.ed.undo()
        ball = bpy.data.objects["Ball"]
        bpy.context.view_layer.update()
        self.assertIsNone(ball.data.shape_keys)
        np.testing.assert_allclose(cases.evaluated(ball), seen, atol=1e-6)


class RestTest(support.SceneTestCase):
    def shaped(self, ball, amount=0.08):
        """A fitted lattice whose points were moved about by hand."""
        before = set(bpy.data.objects)
        bpy.ops.motus.lattice_fit(objects=ball.name, margin=0.2)
        (lattice,) = set(bpy.data.objects) - before
        cases.displace(lattice, amount)
        return lattice

    def test_the_points_as_they_stand_deform_nothing(self):
        ball = cases.ball()
        rest = cases.evaluated(ball)
        lattice = self.shaped(ball)
        points = cases.points_of(lattice)
        self.assertGreater(np.abs(cases.evaluated(ball) - rest).max(), 0.02)
        self.assertEqual(bpy.ops.motus.lattice_rest(object=ball.name), {'FINISHED'})
        np.testing.assert_allclose(cases.evaluated(ball), rest, atol=5e-6)
        np.testing.assert_array_equal(cases.points_of(lattice), points)
        # From there it is pulled, and reset to there.
        bpy.ops.motus.lattice_pull(object=ball.name, location=(0.0, 0.0, 1.0), displacement=(0.0, 0.0, 0.3))
        self.assertGreater(np.abs(cases.evaluated(ball) - rest).max(), 0.2)
        bpy.ops.motus.lattice_reset(object=lattice.name)
        np.testing.assert_allclose(cases.points_of(lattice), points, atol=1e-7)
        np.testing.assert_allclose(cases.evaluated(ball), rest, atol=5e-6)

    def test_it_may_be_made_anew_and_taken_back(self):
        ball = cases.ball()
        rest = cases.evaluated(ball)
        lattice = self.shaped(ball)
        for seed in (2, 3):
            cases.displace(lattice, 0.03, seed)
            bpy.ops.motus.lattice_rest(object=lattice.name)
            np.testing.assert_allclose(cases.evaluated(ball), rest, atol=5e-6)
            self.assertEqual(len(ball.data.shape_keys.key_blocks), 2)
        self.assertRefused("rest made by hand", bpy.ops.motus.lattice_keep, object=ball.name)
        bpy.ops.motus.lattice_rest(object=lattice.name, use_regular=True)
        self.assertIsNone(ball.data.shape_keys)
        np.testing.assert_allclose(cases.evaluated(ball), rest, atol=1e-7)
        self.assertEqual((list(lattice.data.keys()), list(ball.data.keys())), ([], []))

    def test_its_shape_key_may_be_renamed(self):
        ball = cases.ball()
        rest = cases.evaluated(ball)
        lattice = self.shaped(ball)
        bpy.ops.motus.lattice_rest(object=lattice.name)
        key = ball.data.shape_keys.key_blocks[1]
        key.name = "Renamed"
        cases.displace(lattice, 0.03, 2)
        bpy.ops.motus.lattice_rest(object=lattice.name)
        self.assertEqual(ball.data.shape_keys.key_blocks.keys(), ["Basis", "Renamed"])
        np.testing.assert_allclose(cases.evaluated(ball), rest, atol=5e-6)
        ball.data.shape_keys.key_blocks[1].name = "Renamed Again"
        bpy.ops.motus.lattice_rest(object=lattice.name, use_regular=True)
        self.assertIsNone(ball.data.shape_keys)
        np.testing.assert_allclose(cases.evaluated(ball), rest, atol=1e-7)
        self.assertEqual((list(lattice.data.keys()), list(ball.data.keys())), ([], []))

    def test_strength_groups_and_turned_objects(self):
        ball = cases.ball(place=(1.0, 2.0, 3.0))
        ball.rotation_euler, ball.scale = (0.4, 0.2, 1.0), (1.0, 2.0, 0.5)
        group = ball.vertex_groups.new(name="Part")
        for vertex in range(len(ball.data.vertices)):
            group.add([vertex], (vertex % 10) / 10.0, 'REPLACE')
        rest = cases.evaluated(ball)
        self.shaped(ball, 0.05)
        modifier = ball.modifiers[0]
        modifier.vertex_group, modifier.strength = "Part", 0.7
        bpy.ops.motus.lattice_rest(object=ball.name)
        np.testing.assert_allclose(cases.evaluated(ball), rest, atol=1e-5)
        modelled, made = (np.array(key.data[9].co) for key in ball.data.shape_keys.key_blocks)
        self.assertGreater(np.abs(made - modelled).max(), 1e-3)

    def test_removing_the_lattice_leaves_nothing(self):
        ball = cases.ball()
        rest = cases.evaluated(ball)
        self.shaped(ball)
        bpy.ops.motus.lattice_rest(object=ball.name)
        bpy.ops.motus.lattice_remove(objects=ball.name)
        self.assertIsNone(ball.data.shape_keys)
        np.testing.assert_array_equal(cases.evaluated(ball), rest)
        self.assertEqual((len(ball.modifiers), list(ball.data.keys())), (0, []))

    def test_refusals_change_nothing(self):
        ball = cases.ball()
        lattice = self.shaped(ball, 1.5)
        points = cases.points_of(lattice)
        self.assertRefused("folds over itself", bpy.ops.motus.lattice_rest, object=ball.name)
        self.assertIsNone(ball.data.shape_keys)
        np.testing.assert_array_equal(cases.points_of(lattice), points)
        wave = ball.modifiers.new("Wave", 'WAVE')
        support.addon("lattice.fitting").move_first(ball, wave)
        for operator in (bpy.ops.motus.lattice_rest, bpy.ops.motus.lattice_keep):
            self.assertRefused("Wave of Ball acts before", operator, object=ball.name)
