"""A stereo camera that follows a target: it is mounted on an armature with one bone, which Look At turns."""

import math

import bpy
from mathutils import Euler, Matrix

from . import shapes

HEAD, HEAD_LENGTH = "head", 0.4  # name of the bone, and its length in m


def add(context, scene, collection, name, stand, lens, target, gaze, **eyes):
    """Add a stereo camera that looks along +Y and turns towards a target, with the public operators. Returns (head, camera).

    stand: location. lens: focal length, mm. gaze: weight of the turn to the target, from 0 to 1. eyes: keywords of motus.stereo_rig_add.
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
    """Add an armature with one upright bone, whose -Z axis points into the scene."""
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
