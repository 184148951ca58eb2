"""The bones of the wooden pilot: 1.7 m tall, facing -Y, arms down, elbows and knees a little bent."""

from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix

from ..stage import shapes

NAME = "Wooden Pilot"
FRONT, BACK, UP, LEFT, RIGHT = (0, -1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 0), (-1, 0, 0)
EYE_CENTRE = (0.052, -0.094, 1.622)


@dataclass(frozen=True)
class Joint:
    """A bone in rest pose, in metres in the armature's space."""

    name: str
    parent: str
    head: tuple
    tail: tuple
    roll_to: tuple  # where the bone's Z axis points, as far as it can


MIDDLE = (
    Joint("pelvis", "", (0.0, 0.0, 0.930), (0.0, 0.0, 1.030), FRONT),
    Joint("spine.001", "pelvis", (0.0, 0.0, 1.030), (0.0, 0.0, 1.130), FRONT),
    Joint("spine.002", "spine.001", (0.0, 0.0, 1.130), (0.0, 0.0, 1.250), FRONT),
    Joint("spine.003", "spine.002", (0.0, 0.0, 1.250), (0.0, 0.005, 1.400), FRONT),
    Joint("neck", "spine.003", (0.0, 0.005, 1.400), (0.0, 0.0, 1.480), FRONT),
    Joint("head", "neck", (0.0, 0.0, 1.480), (0.0, 0.0, 1.760), FRONT),
)
# Bones of the left side, at +X; the bones of the right side are mirrored.
SIDE = (
    Joint("eye", "head", EYE_CENTRE, (0.052, -0.154, 1.622), UP),
    Joint("lid", "head", EYE_CENTRE, (0.052, -0.144, 1.622), UP),
    Joint("shoulder", "spine.003", (0.030, 0.005, 1.372), (0.185, 0.010, 1.365), UP),
    Joint("upper_arm", "shoulder", (0.185, 0.010, 1.365), (0.262, 0.030, 1.095), FRONT),
    Joint("forearm", "upper_arm", (0.262, 0.030, 1.095), (0.300, -0.035, 0.850), FRONT),
    Joint("hand", "forearm", (0.300, -0.035, 0.850), (0.306, -0.055, 0.767), LEFT),
    Joint("index", "hand", (0.304, -0.083, 0.772), (0.306, -0.100, 0.693), LEFT),
    Joint("fingers", "hand", (0.307, -0.046, 0.767), (0.310, -0.062, 0.686), LEFT),
    Joint("thigh", "pelvis", (0.098, 0.000, 0.900), (0.104, -0.025, 0.492), FRONT),
    Joint("shin", "thigh", (0.104, -0.025, 0.492), (0.104, 0.020, 0.090), FRONT),
    Joint("foot", "shin", (0.104, 0.020, 0.090), (0.108, -0.105, 0.030), UP),
    Joint("toe", "foot", (0.108, -0.105, 0.030), (0.110, -0.180, 0.030), UP),
)


def _mirror(point):
    return (-point[0], point[1], point[2])


def _sided(joint, side):
    left = side == "L"
    parent = joint.parent if joint.parent in {one.name for one in MIDDLE} else f"{joint.parent}.{side}"
    head, tail, roll_to = (point if left else _mirror(point) for point in (joint.head, joint.tail, joint.roll_to))
    return Joint(f"{joint.name}.{side}", parent, head, tail, roll_to)


JOINTS = {joint.name: joint for joint in (*MIDDLE, *(_sided(joint, side) for joint in SIDE for side in ("L", "R")))}


def frame(name):
    """Return a bone's rest matrix in the armature's space as a 4 x 4 array. name: of the bone."""
    joint = JOINTS[name]
    along = np.subtract(joint.tail, joint.head)
    along = along / np.linalg.norm(along)
    out = np.asarray(joint.roll_to) - along * np.dot(joint.roll_to, along)
    out = out / np.linalg.norm(out)
    matrix = np.identity(4)
    matrix[:3, 0], matrix[:3, 1], matrix[:3, 2], matrix[:3, 3] = np.cross(along, out), along, out, joint.head
    return matrix


def length(name):
    """Return a bone's length in metres. name: of the bone."""
    return float(np.linalg.norm(np.subtract(JOINTS[name].tail, JOINTS[name].head)))


def build(context, collection, parent):
    """Make the pilot's armature object as a child of `parent`. The context is in Object Mode afterwards."""
    rig = shapes.link_object(collection, NAME, bpy.data.armatures.new(NAME), parent)
    rig.data.display_type = "STICK"
    for other in context.selected_objects:
        other.select_set(False)
    context.view_layer.objects.active = rig
    rig.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    for joint in JOINTS.values():
        bone = rig.data.edit_bones.new(joint.name)
        bone.parent = rig.data.edit_bones.get(joint.parent)
        bone.head, bone.tail = joint.head, joint.tail
        bone.align_roll(joint.roll_to)
        bone.use_connect = bone.parent is not None and (bone.parent.tail - bone.head).length < 1e-6
    bpy.ops.object.mode_set(mode="OBJECT")
    for bone in rig.pose.bones:
        bone.rotation_mode = "XYZ"
    return rig


def rest_matrix(name):
    """Return a bone's rest matrix in the armature's space as a mathutils.Matrix. name: of the bone."""
    return Matrix(frame(name).tolist())
