"""What the tests of matching share: arms with keys, and their poses frame by frame."""

import bpy
import support
from ik_cases import IkTestCase
from mathutils import Quaternion


class MatchTestCase(IkTestCase):
    def setUp(self):
        super().setUp()
        self.scene.frame_start, self.scene.frame_end = 1, 30

    def animate(self, rig, bones=("Bone 0", "Bone 1"), frames=(1, 12, 30)):
        """Keys that bend and turn the bones, each frame otherwise."""
        for step, frame in enumerate(frames):
            for index, name in enumerate(bones):
                bone = rig.pose.bones[name]
                rotation = Quaternion((0.3, 0.2 * index, 1.0), 0.35 * step - 0.2 * index) @ Quaternion(
                    (0.0, 1.0, 0.0), 0.2 * step)
                if bone.rotation_mode == 'QUATERNION':
                    bone.rotation_quaternion = rotation
                elif bone.rotation_mode == 'AXIS_ANGLE':
                    axis, angle = rotation.to_axis_angle()
                    bone.rotation_axis_angle = (angle, *axis)
                else:
                    bone.rotation_euler = rotation.to_euler(bone.rotation_mode)
                bone.keyframe_insert({'QUATERNION': "rotation_quaternion", 'AXIS_ANGLE': "rotation_axis_angle"}.get(
                    bone.rotation_mode, "rotation_euler"), frame=frame)
        return rig

    def animated_arm(self, frames=(1, 12, 30), **options):
        return self.animate(self.arm(**options), frames=frames)

    def recorded(self, rig, frames=range(1, 31)):
        return {frame: self.poses(rig, frame) for frame in frames}

    def assertRecorded(self, rig, recorded, tolerance=5e-6):
        for frame, wanted in recorded.items():
            self.assertSamePose(rig, wanted, tolerance, frame)

    def match(self, operator="ik_match_fk", **keywords):
        self.assertEqual(getattr(bpy.ops.motus, operator)(object="Rig", **keywords), {'FINISHED'})

    def error_of_job(self, rig, job="match_fk", switch=False):
        outcome = {}
        module = support.addon("ik.match_job")
        for _ in getattr(module, job)(bpy.context, rig, "", list(range(1, 31)), switch, outcome):
            pass
        return outcome["error"]


def state_of(obj):
    """Keys and transforms of a control."""
    curves = support.addon("core.actions").fcurves(obj)
    return tuple(obj.location), tuple(obj.rotation_euler), [
        (curve.data_path, curve.array_index, [(tuple(point.co), point.interpolation, point.handle_left_type)
                                              for point in curve.keyframe_points]) for curve in curves]
