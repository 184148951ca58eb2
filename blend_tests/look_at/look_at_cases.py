"""What the tests of Look At share: a figure that faces -Y, and where its head and eyes really look."""

import math

import bpy
from mathutils import Vector

import support

# Name: parent, head, tail. Metres. The spine is straight up, so that turns to the side simply add up.
BONES = {
    "Hips": ("", (0.0, 0.0, 1.0), (0.0, 0.0, 1.1)),
    "Thigh.L": ("Hips", (0.1, 0.0, 1.0), (0.1, 0.0, 0.5)),
    "Shin.L": ("Thigh.L", (0.1, 0.0, 0.5), (0.1, 0.0, 0.0)),
    "Spine": ("Hips", (0.0, 0.0, 1.1), (0.0, 0.0, 1.25)),
    "Chest": ("Spine", (0.0, 0.0, 1.25), (0.0, 0.0, 1.5)),
    "Neck": ("Chest", (0.0, 0.0, 1.5), (0.0, 0.0, 1.6)),
    "Head": ("Neck", (0.0, 0.0, 1.6), (0.0, 0.0, 1.85)),
    "Eye.L": ("Head", (0.04, -0.08, 1.7), (0.04, -0.12, 1.7)),
    "Eye.R": ("Head", (-0.04, -0.08, 1.7), (-0.04, -0.12, 1.7)),
    "Eyelid.L": ("Head", (0.04, -0.08, 1.72), (0.04, -0.12, 1.72)),
    "UpperArm.L": ("Chest", (0.2, 0.0, 1.45), (0.45, 0.02, 1.35)),
    "LowerArm.L": ("UpperArm.L", (0.45, 0.02, 1.35), (0.7, 0.0, 1.25)),
}
BODY = ("Spine", "Chest", "Neck")
EYES = ("Eye.L", "Eye.R")
FAR = 1e4  # m: there a target is in one direction from all bones, to 1e-5 rad


def build_rig(bones=BONES, name="Rig"):
    """An armature object of these bones, in Object Mode."""
    rig = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    for bone_name, (parent, head, tail) in bones.items():
        bone = rig.data.edit_bones.new(bone_name)
        bone.head, bone.tail = head, tail
        bone.parent = rig.data.edit_bones.get(parent)
    bpy.ops.object.mode_set(mode='OBJECT')
    for bone in rig.pose.bones:
        bone.rotation_mode = 'QUATERNION'
    bpy.context.view_layer.update()
    return rig


def direction(yaw, pitch=0.0):
    """Unit vector at degrees to the left of -Y, and up."""
    yaw, pitch = math.radians(yaw), math.radians(pitch)
    return Vector((math.sin(yaw) * math.cos(pitch), -math.cos(yaw) * math.cos(pitch), math.sin(pitch)))


class LookAtTestCase(support.SceneTestCase):
    """A scene with a figure "Rig" and an empty "Target"."""

    def setUp(self):
        super().setUp()
        self.scene = bpy.context.scene
        self.scene.render.fps = 24
        self.system = support.addon("look_at").SYSTEM
        self.wiring = support.addon("core.wiring")
        self.reasons = support.addon("look_at.reasons")
        self.rig = build_rig()
        self.target = self.link("Target")

    def aim(self, yaw, pitch=0.0, distance=FAR, rig=None):
        """Put the target in a direction from the head at rest, in degrees, in the rig's own space."""
        rig = rig or self.rig
        bpy.context.view_layer.update()
        self.target.location = rig.matrix_world @ (rig.data.bones["Head"].head_local + distance * direction(yaw, pitch))

    def look(self, rig="Rig", **keywords):
        """Let the head look; returns its entry."""
        keywords.setdefault("target", "Target")
        keywords.setdefault("bone", "Head")
        self.assertEqual(bpy.ops.motus.look_at_add(object=rig, **keywords), {'FINISHED'})
        return bpy.data.objects[rig].motus.look_at.entries[keywords["bone"]]

    def evaluated(self, rig=None):
        return (rig or self.rig).evaluated_get(bpy.context.evaluated_depsgraph_get())

    def pose(self, name, rig=None):
        """World matrix of an evaluated bone."""
        rig = self.evaluated(rig)
        return rig.matrix_world @ rig.pose.bones[name].matrix

    def poses(self, rig=None):
        return {bone.name: bone.matrix.copy() for bone in self.evaluated(rig).pose.bones}

    def gaze(self, name, forward=None, rig=None):
        """Unit vector along which a bone looks: where it looks at -Y at rest, or along the given local axis."""
        rest = (rig or self.rig).data.bones[name].matrix_local.to_3x3()
        local = Vector(forward) if forward else rest.inverted() @ Vector((0.0, -1.0, 0.0))
        return (self.pose(name, rig).to_3x3() @ local).normalized()

    def off(self, name, forward=None, rig=None):
        """Degrees between the gaze of a bone and the target."""
        way = self.target.matrix_world.translation - self.pose(name, rig).translation
        return math.degrees(self.gaze(name, forward, rig).angle(way))

    def yaw(self, name):
        """Degrees that a bone has turned to the left against its parent, about the vertical."""
        rig = self.evaluated()
        bone = rig.pose.bones[name]
        rest, pose = bone.bone.matrix_local, bone.matrix
        if bone.parent:
            rest = bone.parent.bone.matrix_local.inverted() @ rest
            pose = bone.parent.matrix.inverted() @ pose
            carried = bone.parent.bone.matrix_local.to_3x3()
        turn = carried @ (pose @ rest.inverted()).to_3x3() @ carried.inverted()
        return math.degrees(turn.to_euler('XYZ').z)

    def told(self, name, head="Head", rig=None, group=""):
        """An output of a head."""
        return self.wiring.output(self.system, rig or self.rig, f"{head}.{name}", bpy.context.evaluated_depsgraph_get(), group=group)

    def sentence(self, rig=None):
        problem = self.wiring.problem(self.system, rig or self.rig, bpy.context.evaluated_depsgraph_get())
        return problem and problem.sentence

    def assertSamePoses(self, found, wanted, tolerance=1e-6, leave_out=()):
        """Two results of poses() are the same."""
        for name, matrix in wanted.items():
            if name not in leave_out:
                worst = max(abs(a - b) for rows in zip(found[name], matrix) for a, b in zip(*rows))
                self.assertLessEqual(worst, tolerance, name)
