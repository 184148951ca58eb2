"""What the tests of checking chains share: an arm, targets that jump, and what is told of them."""

import bpy

import support
from ik.ik_cases import IkTestCase


class CheckTestCase(IkTestCase):
    def setUp(self):
        super().setUp()
        self.scene.frame_start, self.scene.frame_end = 1, 100
        self.rigged = self.arm()

    def moving(self, places, name="Target"):
        target = self.target(name=name)
        for frame, place in places:
            target.location = place
            target.keyframe_insert("location", frame=frame)
        for curve in support.addon("core.blender.actions").fcurves(target):
            for point in curve.keyframe_points:
                point.interpolation = 'CONSTANT'
        return target

    def check(self, **keywords):
        self.assertEqual(bpy.ops.motus.ik_check(object="Rig", **keywords), {'FINISHED'})

    def told(self, entry):
        status = support.addon("ik.status")
        return support.addon("ik.checking.results").sentence(entry, lambda value: status.length(bpy.context, value))
