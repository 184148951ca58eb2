"""What the tests of matching share: arms with keys, and their poses frame by frame."""

import math

import bpy
import numpy as np
from mathutils import Quaternion

import support
from ik.ik_cases import IkTestCase

FEW = (1, 0.0), (10, 0.6), (40, 0.4)
MANY = ((-30, 0.1), (-20, 0.4), (-9, -0.5), (1, 0.0), (6, 0.2), (10, 0.6), (15, 0.1), (40, 0.3), (47, -0.2), (60, 0.5), (70, 0.1))
"""Keys of a number: (frame, value)."""


class MatchTestCase(IkTestCase):
    def setUp(self):
        super().setUp()
        self.scene.frame_start, self.scene.frame_end = 1, 30

    def animate(self, rig, bones=("Bone 0", "Bone 1"), frames=(1, 12, 30)):
        """Keys that bend and turn the bones, each frame otherwise."""
        for step, frame in enumerate(frames):
            for index, name in enumerate(bones):
                bone = rig.pose.bones[name]
                rotation = Quaternion((0.3, 0.2 * index, 1.0), 0.35 * step - 0.2 * index) @ Quaternion((0.0, 1.0, 0.0), 0.2 * step)
                if bone.rotation_mode == 'QUATERNION':
                    bone.rotation_quaternion = rotation
                elif bone.rotation_mode == 'AXIS_ANGLE':
                    axis, angle = rotation.to_axis_angle()
                    bone.rotation_axis_angle = (angle, *axis)
                else:
                    bone.rotation_euler = rotation.to_euler(bone.rotation_mode)
                bone.keyframe_insert(
                    {'QUATERNION': "rotation_quaternion", 'AXIS_ANGLE': "rotation_axis_angle"}.get(bone.rotation_mode, "rotation_euler"),
                    frame=frame,
                )
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

    def assertFramesStay(self, operator, obj, path, keys, frames, **options):
        """Matching some frames leaves a curve before the last key in front of them and after the first one behind."""
        actions = support.addon("core.blender.actions")
        rewrite(actions.find(obj, path), keys, **options)
        first = max((frame for frame, _ in keys if frame < frames[0]), default=-math.inf)
        last = min((frame for frame, _ in keys if frame > frames[1]), default=math.inf)
        stay = [frame for frame in np.arange(keys[0][0], keys[-1][0] + 0.5, 0.5) if not first < frame < last]
        before = [actions.find(obj, path).evaluate(frame) for frame in stay]
        self.match(operator, frame_start=frames[0], frame_end=frames[1])
        curve = actions.find(obj, path)
        self.assertGreater(len(curve.keyframe_points), len(keys))
        for frame, value in zip(stay, before):
            self.assertAlmostEqual(curve.evaluate(frame), value, delta=1e-5, msg=f"frame {frame}")

    def error_of_job(self, rig, job="match_fk", switch=False):
        outcome = {}
        module = support.addon("ik.matching.job")
        for _ in getattr(module, job)(bpy.context, rig, "", list(range(1, 31)), switch, outcome):
            pass
        return outcome["error"]


def rewrite(curve, keys, handles='AUTO_CLAMPED', smoothing='CONT_ACCEL', is_cyclic=False):
    """Give an F-curve other keys; handles: the type of both sides, or of the left and the right one."""
    for point in reversed(curve.keyframe_points):
        curve.keyframe_points.remove(point)
    for frame, value in keys:
        curve.keyframe_points.insert(frame, value)
    curve.auto_smoothing = smoothing
    left, right = (handles, handles) if isinstance(handles, str) else handles
    for point in curve.keyframe_points:
        point.handle_left_type, point.handle_right_type = left, right
    if is_cyclic and not curve.modifiers:
        curve.modifiers.new('CYCLES')
    curve.update()


def all_of(curve):
    """Keys of an F-curve, exactly."""
    return [
        (tuple(key.co), tuple(key.handle_left), tuple(key.handle_right), key.handle_left_type, key.handle_right_type, key.interpolation)
        for key in curve.keyframe_points
    ]


def state_of(obj):
    """Keys and transforms of a control."""
    curves = support.addon("core.blender.actions").fcurves(obj)
    return (
        tuple(obj.location),
        tuple(obj.rotation_euler),
        [
            (
                curve.data_path,
                curve.array_index,
                [(tuple(point.co), point.interpolation, point.handle_left_type) for point in curve.keyframe_points],
            )
            for curve in curves
        ],
    )
