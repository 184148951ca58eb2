"""The scene "Motus Stereo": an aeroplane between columns at several depths, filmed by two eyes that follow it with their gaze."""

import math

import bpy
from mathutils import Euler, Matrix

from . import aeroplane, colonnade_land, flight, lighting, shapes, staging

SCENE_NAME = "Motus Stereo"
FRAMES_PER_SECOND = 24
SPEED = 23.0  # m/s
BANK_SMOOTHING, BANK_LIMIT = 7.0, math.radians(60.0)
# Round the columns, and nearest to the camera where it crosses the middle of the picture.
COURSE = (
    (34.0, 84.0, 11.0), (8.0, 58.0, 8.0), (-13.0, 38.0, 6.5), (-4.0, 14.0, 5.2), (14.0, 24.0, 5.8), (9.0, 43.0, 7.5),
    (-14.0, 62.0, 9.5), (-22.0, 92.0, 11.0), (6.0, 108.0, 12.0),
)
STAND, LENS = (0.0, 0.0, 6.2), 30.0
HEAD, HEAD_LENGTH = "head", 0.4
GAZE = 0.8  # how much of the turn to the aeroplane the camera makes
# What lies nearer than the screen is the passing aeroplane alone, and stands before nothing that the window cuts off.
NEAR, FAR, NEAR_PARALLAX, FAR_PARALLAX = 12.0, 150.0, 0.4, 1.6


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND)
    land, air, views = (staging.new_collection(scene, name) for name in ("Temple", "Passing", "Stereo"))
    sky = lighting.build_sky_group()
    scene.world = lighting.build_world(sky)
    lighting.add_sun(land)
    lighting.set_color_management(scene)
    colonnade_land.build(land, lighting.build_haze_group(sky))
    plane = aeroplane.build(air)
    course = flight.add_course(air, COURSE, is_cyclic=True)
    flight.follow(
        plane, course, timing="SPEED", speed=SPEED, orientation="BANKING", bank_limit=BANK_LIMIT,
        bank_smoothing=BANK_SMOOTHING, forward_axis="POS_Y", up_axis="POS_Z")
    _add_camera(context, scene, views, plane)
    scene.frame_start, scene.frame_end = 1, round(flight.course_length(course) / SPEED * FRAMES_PER_SECOND)
    scene.frame_set(1)
    return scene


def _add_camera(context, scene, collection, plane):
    """A camera on a head that looks after the aeroplane, with a stereo rig: both by their public operators."""
    rig = _add_head(context, collection)
    data = bpy.data.cameras.new("Stereo Camera")
    data.lens, data.clip_end = LENS, 5000.0
    camera = shapes.link_object(collection, "Stereo Camera", data)
    scene.camera = camera
    camera.parent, camera.parent_type, camera.parent_bone = rig, "BONE", HEAD
    context.view_layer.update()
    camera.matrix_world = _upright(STAND)
    _check(bpy.ops.motus.look_at_add(
        object=rig.name, bone=HEAD, target=plane.name, body_length=0, eyes="", weight=GAZE, head_forward="NEG_Z"))
    _check(bpy.ops.motus.stereo_rig_add(
        object=camera.name, convergence="BUDGET", near=NEAR, far=FAR, near_parallax=NEAR_PARALLAX, far_parallax=FAR_PARALLAX,
        screen="TELEVISION"))
    _check(bpy.ops.motus.stereo_output(object=camera.name, format="ANAGLYPH"))


def _add_head(context, collection):
    """An armature of one upright bone, whose -Z axis points into the scene."""
    rig = shapes.link_object(collection, "Camera Head", bpy.data.armatures.new("Camera Head"))
    rig.location = STAND
    context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new(HEAD)
    bone.head, bone.tail = (0.0, 0.0, 0.0), (0.0, 0.0, HEAD_LENGTH)
    bone.align_roll((0.0, -1.0, 0.0))
    bpy.ops.object.mode_set(mode="OBJECT")
    return rig


def _upright(place):
    """The matrix of a camera that looks along Y."""
    return Matrix.Translation(place) @ Euler((math.radians(90.0), 0.0, 0.0)).to_matrix().to_4x4()


def _check(result):
    if result != {"FINISHED"}:
        raise RuntimeError("The stereo camera could not be added")
