"""Matching of controls that are scaled, sheared and mirrored, by themselves and by what they hang on."""

import bpy
from mathutils import Euler, Matrix

import support
from ik.matching.ik_match_cases import MatchTestCase

controls = support.addon("ik.goals.controls")
frame_of = support.addon("ik.goals.orientation").frame_of

PARENTS = {
    "scaled": (2.0, 1.0, 0.5),
    "scaled a little": (1.2, 1.0, 1.0),
    "mirrored": (-1.0, 1.0, 1.0),
    "mirrored and scaled": (1.5, -1.0, 0.7),
}
FRAMES = (1, 7, 12)
OWN = ((1.0, 1.0, 1.0), (0.5, 2.0, 1.5), (-1.0, 2.0, 1.0), (1.0, -1.0, -2.0))


class Scaled(MatchTestCase):
    def place_target(self, scale, own=(1.0, 1.0, 1.0), mode='XYZ'):
        """A turned target under a scaled parent."""
        parent = self.target((1.0, 1.0, 1.0), "Parent")
        parent.scale, parent.rotation_euler = scale, (0.3, 0.4, 0.5)
        target = self.target()
        target.parent, target.scale, target.rotation_mode = parent, own, mode
        target.rotation_euler, target.delta_rotation_euler = (0.5, 0.6, 0.7), (0.1, 0.2, 0.3)
        target.delta_scale = (1.0, 1.0, -1.0)
        return target

    def test_controls_to_the_animated_pose(self):
        for name, scale in PARENTS.items():
            for own in OWN:
                for mode, keeps in (('XYZ', False), ('QUATERNION', False), ('XYZ', True)):
                    with self.subTest(name, own=own, mode=mode, keeps=keeps):
                        support.empty_scene()
                        self.scene = bpy.context.scene
                        self.scene.frame_end = FRAMES[-1]
                        rig = self.animated_arm()
                        recorded = self.recorded(rig, FRAMES)
                        target = self.place_target(scale, own, mode)
                        self.reach(rotation_weight=1.0, keep_rotation=keeps)
                        self.match(frame_start=FRAMES[0], frame_end=FRAMES[-1])
                        self.assertRecorded(rig, recorded, 1e-5)
                        self.assertNear(target.scale, own, 0.0)

    def test_a_bone_is_the_control(self):
        for scale in PARENTS.values():
            with self.subTest(scale=scale):
                support.empty_scene()
                self.scene = bpy.context.scene
                self.scene.frame_end = FRAMES[-1]
                rig = self.animated_arm()
                recorded = self.recorded(rig, FRAMES)
                other = self.arm(name="Other")
                other.pose.bones["Shoulder"].scale = scale
                other.pose.bones["Bone 0"].scale = (0.5, 2.0, 1.5)
                self.reach(target="Other", target_bone="Bone 0", rotation_weight=1.0, keep_rotation=False)
                self.match(frame_start=FRAMES[0], frame_end=FRAMES[-1])
                self.assertRecorded(rig, recorded, 1e-5)

    def test_an_offset(self):
        """Applied to the axes of the control as they are, it gives the orientation that is wanted."""
        wanted = Matrix.LocRotScale((0.3, 0.2, 0.1), Euler((0.9, -0.4, 2.0)), None)
        offset = Euler((0.7, 0.3, -1.1)).to_matrix()
        for scale in PARENTS.values():
            for own in OWN:
                with self.subTest(scale=scale, own=own):
                    support.empty_scene()
                    self.scene = bpy.context.scene
                    target = self.place_target(scale, own, 'QUATERNION')
                    target.delta_rotation_euler = (0.0, 0.0, 0.0)
                    bpy.context.view_layer.update()
                    depsgraph = bpy.context.view_layer.depsgraph
                    found = controls.basis_for(controls.Control(target, ""), depsgraph, wanted, offset)
                    target.location, target.rotation_quaternion, _ = found.decompose()
                    stands = self.evaluated(target).matrix_world
                    self.assertNear(stands.translation, wanted.translation)
                    self.assertTurned(wanted, frame_of(stands.to_3x3() @ offset), 0.005)
