"""The scene "Motus Pull": a clay face and a landscape, both pulled into shape, and moved by pins that are keyed."""

import bpy

from ..places import clay_studio
from ..stage import keying, lighting, shapes, staging
from . import balls, face as clay_face, terrain

SCENE_NAME = "Motus Pull"
FRAMES_PER_SECOND = 24

CAMERA_LENS = 44.5
CAMERA_KEYS = ((1, (-0.70, -9.45, 3.45)), (109, (0.45, -9.25, 3.75)))  # there and back in a cycle
CAMERA_AIM = (-0.08, 0.0, 1.06)


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND, keying.CYCLE)
    studio, land, face = (staging.new_collection(scene, name) for name in ("Studio", "Landscape", "Face"))
    lighting.set_color_management(scene)
    scene.world = clay_studio.build_world()
    scan, ball = clay_studio.build(studio)
    balls.build(context, scan, ball)
    terrain.build(context, land)
    clay_face.build(context, face)
    _add_camera(scene, studio)
    scene.frame_set(1)
    return scene


def _add_camera(scene, collection):
    """Add a camera that swings to the side and back while it stays aimed at one point."""
    aim = shapes.link_object(collection, "Camera Aim", None)
    aim.location, aim.empty_display_size = CAMERA_AIM, 0.2
    data = bpy.data.cameras.new("Studio Camera")
    data.lens = CAMERA_LENS
    camera = shapes.link_object(collection, "Studio Camera", data)
    constraint = camera.constraints.new("TRACK_TO")
    constraint.target, constraint.track_axis, constraint.up_axis = aim, "TRACK_NEGATIVE_Z", "UP_Y"
    keying.key_cycle(camera, "location", CAMERA_KEYS)
    scene.camera = camera
