"""motus.refresh wires systems anew: one that is named, all of an owner's, from a member as well; and says when there is nothing to do."""

from unittest import mock

import bpy

import support


class Refresh(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.wiring = support.addon("core.wiring")
        self.refreshing = support.addon("core.interface.any_system.refreshing")

    def refreshed(self, **keywords):
        """The (system, owner) names that the operator wires anew."""
        found = []
        with mock.patch.object(self.refreshing.wiring, "refresh", lambda system, owner: found.append((system.name, owner.name))):
            bpy.ops.motus.refresh(**keywords)
        return found

    def follower(self):
        curve = bpy.data.objects.new("Curve", bpy.data.curves.new("Curve", 'CURVE'))
        curve.data.dimensions = '3D'
        curve.data.splines.new('POLY').points.add(1)
        curve.data.splines[0].points[1].co = 4.0, 0.0, 0.0, 1.0
        obj = bpy.data.objects.new("Car", None)
        for one in (curve, obj):
            bpy.context.scene.collection.objects.link(one)
        bpy.ops.motus.path_follow_add(object="Car", curve="Curve")
        return obj

    def test_all_systems_of_an_owner_or_the_one_that_is_named(self):
        bpy.ops.mesh.primitive_plane_add()
        name = bpy.context.object.name
        bpy.ops.motus.dynamics_add(object=name, style='BOUNCY')
        bpy.ops.motus.pin_add(object=name, vertex=0)
        self.assertCountEqual(self.refreshed(object=name), [("dynamics", name), ("pull", name)])
        self.assertEqual(self.refreshed(object=name, system="pull"), [("pull", name)])

    def test_a_member_stands_for_its_owner(self):
        bpy.ops.motus.pendulum_add(kind='SINGLE')
        pivot = bpy.context.object
        rod = next(one for one in bpy.data.objects if one.motus.pendulum.leader == pivot)
        with mock.patch.object(support.addon("pendulum.build").wiring, "refresh") as refresh:
            bpy.ops.motus.refresh(object=rod.name)
        self.assertEqual([call.args[1] for call in refresh.call_args_list], [pivot])

    def test_the_active_object_is_meant_without_a_name(self):
        bpy.context.view_layer.objects.active = self.follower()
        self.assertEqual(self.refreshed(), [("path", "Car")])

    def test_a_system_may_rebuild_in_its_own_way(self):
        bpy.ops.motus.pendulum_add(kind='SINGLE')
        pivot = bpy.context.object
        with mock.patch.object(support.addon("pendulum.build").parts, "fit") as fit:
            self.assertEqual(bpy.ops.motus.refresh(object=pivot.name), {'FINISHED'})
        fit.assert_called_once_with(pivot)

    def test_what_is_not_driven_is_refused(self):
        obj = bpy.data.objects.new("Cube", None)
        bpy.context.scene.collection.objects.link(obj)
        with self.assertRaisesRegex(RuntimeError, "Cube is not driven by Motus"):
            bpy.ops.motus.refresh(object="Cube")
        self.follower()
        with self.assertRaisesRegex(RuntimeError, "Car is not driven by Motus"):
            bpy.ops.motus.refresh(object="Car", system="ik")
