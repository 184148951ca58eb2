"""A stereo camera on a head that looks after something: an armature of one bone, Look At, and the stereo rig."""

import math

import bpy
from mathutils import Euler, Matrix

from . import shapes

HEAD, HEAD_LENGTH = "head", 0.4  # the bone, and its length, m


def add(context, scene, collection, name, stand, lens, target, gaze, **eyes):
    """A camera that looks along Y from its stand, and by a share `gaze` at the target; (head, camera).

    eyes: keywords of motus.stereo_rig_add. All of it is done by the public operators.
    """
    head = _add_head(context, collection, stand)
    data = bpy.data.cameras.new(name)
    data.lens, data.clip_end = lens, 5000.0
    camera = shapes.link_object(collection, name, data)
    scene.camera = camera
    camera.parent, camera.parent_type, camera.parent_bone = head, "BONE", HEAD
    context.view_layer.update()
    camera.matrix_world = Matrix.Translation(stand) @ Euler((math.radians(90.0), 0.0, 0.0)).to_matrix().to_4x4()
    _check(
        bpy.ops.motus.look_at_add(
            object=head.name, bone=HEAD, target=target.name, body_length=0, eyes="", weight=gaze, head_forward="NEG_Z"
        )
    )
    _check(bpy.ops.motus.stereo_rig_add(object=camera.name, screen="TELEVISION", **eyes))
    return head, camera


def _add_head(context, collection, stand):
    """An armature of one upright bone, whose -Z axis points into the scene."""
    head = shapes.link_object(collection, "Camera Head", bpy.data.armatures.new("Camera Head"))
    head.location = stand
    context.view_layer.objects.active = head
    bpy.ops.object.mode_set(mode="EDIT")
    bone = head.data.edit_bones.new(HEAD)
    bone.head, bone.tail = (0.0, 0.0, 0.0), (0.0, 0.0, HEAD_LENGTH)
    bone.align_roll((0.0, -1.0, 0.0))
    bpy.ops.object.mode_set(mode="OBJECT")
    return head


def _check(result):
    if result != {"FINISHED"}:
        raise RuntimeError("The stereo camera could not be added")
