"""Shared by the tests of pendulums: adding them, where their bobs are, and where the library says they should be."""

import math

import bpy
import numpy as np

import support

OFF_THE_FRAMES = (1, 17, 60, 3.25, 24.5, 5, 100, 60)


def native():
    return support.addon("core.native").module


def world(obj):
    """(4, 4) of the object as evaluated."""
    return np.array(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world)


def place(obj):
    return world(obj)[:3, 3]


def seconds(frame, start=1.0, fps=24.0):
    return (frame - start) / fps


def reach(*rods):
    """(x, 0, z) of the end of rods (length, angle)."""
    return np.array(
        (sum(length * math.sin(angle) for length, angle in rods), 0.0, -sum(length * math.cos(angle) for length, angle in rods))
    )


class PendulumTestCase(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        bpy.context.scene.frame_set(1)

    def add(self, **keywords):
        """The pivot of a new pendulum."""
        self.assertEqual(bpy.ops.motus.pendulum_add(**keywords), {'FINISHED'})
        return bpy.context.object

    def copy_alone(self, obj):
        """A duplicate of the object, by Blender's operator, without what hangs on it."""
        for one in bpy.context.selected_objects:
            one.select_set(False)
        obj.select_set(True)
        bpy.context.view_layer.objects.active = obj
        bpy.ops.object.duplicate()
        return bpy.context.object

    def link(self, name, location=(0.0, 0.0, 0.0), data=None):
        obj = support.link(name, data, location)
        bpy.context.view_layer.update()
        return obj

    def bobs(self, pivot):
        return [entry.bob for entry in pivot.motus.pendulum.rods]

    def rods(self, pivot):
        return [entry.object for entry in pivot.motus.pendulum.rods]

    def sentence(self, pivot):
        bpy.context.view_layer.update()
        depsgraph = bpy.context.evaluated_depsgraph_get()
        problem = support.addon("core.wiring").problem(support.addon("pendulum").SYSTEM, pivot, depsgraph)
        return problem.sentence if problem else ""

    def assertPlace(self, obj, expected, tolerance=2e-6):
        np.testing.assert_allclose(place(obj), expected, atol=tolerance)
