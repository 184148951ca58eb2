"""Trails: where the end bobs have been, in their colours, without anything kept of it."""

import bpy
import numpy as np

from pendulum.pendulum_cases import OFF_THE_FRAMES, PendulumTestCase, native, place, reach
from support import go_to


class Trail(PendulumTestCase):
    def tubes(self, pivot):
        """(positions in the world (n, 3), colours (n, 4), ages (n,)) of the evaluated trail."""
        obj = pivot.motus.pendulum.trail
        evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
        mesh = evaluated.data
        count = len(mesh.vertices)
        places, colors, ages = np.empty(3 * count, np.float32), np.empty(4 * count, np.float32), np.empty(count, np.float32)
        mesh.vertices.foreach_get("co", places)
        if count:
            mesh.attributes["tint"].data.foreach_get("color", colors)
            mesh.attributes["age"].data.foreach_get("value", ages)
        matrix = np.array(evaluated.matrix_world)
        return places.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3], colors.reshape(-1, 4), ages

    def test_it_ends_at_the_bob_and_goes_back(self):
        pivot = self.add(kind='DOUBLE', use_trails=True, location=(1.0, 0.0, 2.0))
        bpy.ops.motus.pendulum_trail_add(object=pivot.name, seconds=1.5, thickness=0.01)
        settings = pivot.motus.pendulum
        self.assertEqual([obj for obj in bpy.data.objects if obj.motus.pendulum_trail.is_active], [settings.trail])
        go_to(61)
        places, colors, ages = self.tubes(pivot)
        bob = self.bobs(pivot)[1]
        head = places[ages < 1e-6]
        np.testing.assert_allclose(head.mean(axis=0), place(bob), atol=1e-4)
        self.assertAlmostEqual(float(ages.max()), 1.0, 5)
        first, second, *_ = native().double_pendulum(1.0, settings.angle1, settings.angle2, gravity=bpy.context.scene.gravity.length)
        tail = places[ages > 1.0 - 1e-6]
        np.testing.assert_allclose(tail.mean(axis=0), reach((1.0, first), (1.0, second)) + (1.0, 0.0, 2.0), atol=1e-4)
        np.testing.assert_allclose(colors[0, :3], bob.material_slots[0].material.diffuse_color[:3], atol=1e-6)

    def test_a_fan_in_any_order(self):
        pivot = self.add(kind='FAN', count=3, use_trails=True)

        def states():
            found = {}
            for frame in OFF_THE_FRAMES:
                go_to(frame)
                state = b"".join(part.tobytes() for part in self.tubes(pivot))
                self.assertEqual(found.setdefault(frame, state), state, frame)
            return found

        first = states()
        self.assertEqual(states(), first)
        self.assertEqual(len(first[1]), 0)
        go_to(100)
        self.assertEqual(len(np.unique(self.tubes(pivot)[1][:, :3], axis=0)), 3)

    def test_edits_reach_it(self):
        pivot = self.add(kind='SINGLE', use_trails=True, location=(0.0, 0.0, 0.0))
        go_to(30)
        pivot.motus.pendulum.length1 = 2.0
        places, _, ages = self.tubes(pivot)
        np.testing.assert_allclose(places[ages < 1e-6].mean(axis=0), place(self.bobs(pivot)[0]), atol=1e-4)
        pivot.location.z = 3.0
        places, _, ages = self.tubes(pivot)
        np.testing.assert_allclose(places[ages < 1e-6].mean(axis=0), place(self.bobs(pivot)[0]), atol=1e-4)

    def test_removed(self):
        before = {name: len(getattr(bpy.data, name)) for name in ("objects", "meshes", "materials", "node_groups")}
        pivot = self.add(kind='SINGLE', use_trails=True)
        self.assertEqual(bpy.ops.motus.pendulum_trail_remove(object=pivot.name), {'FINISHED'})
        self.assertRefused("has no trails", bpy.ops.motus.pendulum_trail_remove, object=pivot.name)
        bpy.ops.motus.pendulum_trail_add(object=pivot.name)
        bpy.ops.motus.pendulum_remove(object=pivot.name)
        self.assertEqual({name: len(getattr(bpy.data, name)) for name in before}, before)

    def test_a_copy_of_the_pivot_leaves_the_trail(self):
        pivot = self.add(kind='DOUBLE', use_trails=True)
        first = pivot.motus.pendulum.trail
        for keywords in ({}, {"keep_objects": True}):
            copy = self.copy_alone(pivot)
            self.assertRefused("has no trails", bpy.ops.motus.pendulum_trail_remove, object=copy.name)
            bpy.ops.motus.pendulum_remove(object=copy.name, **keywords)
            self.assertEqual(pivot.motus.pendulum.trail, first)
        copy = self.copy_alone(pivot)
        bpy.ops.motus.pendulum_trail_add(object=copy.name)
        self.assertNotEqual(copy.motus.pendulum.trail, first)
        self.assertEqual(first.motus.pendulum_trail.pivot, pivot)
        bpy.ops.motus.pendulum_trail_remove(object=copy.name)
        go_to(30)
        self.assertGreater(len(self.tubes(pivot)[0]), 0)
        bpy.ops.motus.pendulum_trail_remove(object=first.name)
        self.assertIsNone(pivot.motus.pendulum.trail)

    def test_bad_input(self):
        pivot = self.add(kind='SINGLE', use_trails=True)
        self.assertRefused("seconds must be greater", bpy.ops.motus.pendulum_trail_add, object=pivot.name, seconds=0.0)
        go_to(20)
        found = pivot.motus.pendulum.trail.motus.pendulum_trail
        for name in ("seconds", "thickness"):
            setattr(found, name, 0.0)
            self.assertEqual(len(self.tubes(pivot)[0]), 0)
            setattr(found, name, float("nan"))
            self.assertEqual(len(self.tubes(pivot)[0]), 0)
            setattr(found, name, 0.5)
        pivot.motus.pendulum.speed, pivot.motus.pendulum.damping = 1e9, 0.1
        self.assertEqual(len(self.tubes(pivot)[0]), 0)
        self.assertRefused("nothing to bake", bpy.ops.motus.bake, object=pivot.motus.pendulum.trail.name)
