"""The scene "Motus Stereo": an aeroplane flies between columns at several depths; a stereo camera turns to follow it."""

import math

import bpy

from ..flying import aeroplane, flight
from ..places import colonnade
from ..stage import gaze_camera, lighting, staging

SCENE_NAME = "Motus Stereo"
FRAMES_PER_SECOND = 24
SPEED = 23.0  # m/s
BANK_SMOOTHING, BANK_LIMIT = 7.0, math.radians(60.0)
# The course goes around the columns; it is nearest to the camera in the middle of the picture.
COURSE = (
    (34.0, 84.0, 11.0),
    (8.0, 58.0, 8.0),
    (-13.0, 38.0, 6.5),
    (-4.0, 14.0, 5.2),
    (14.0, 24.0, 5.8),
    (9.0, 43.0, 7.5),
    (-14.0, 62.0, 9.5),
    (-22.0, 92.0, 11.0),
    (6.0, 108.0, 12.0),
)
STAND, LENS = (0.0, 0.0, 6.2), 30.0
GAZE = 0.8  # share of the turn towards the aeroplane that the camera makes
# Only the passing aeroplane appears in front of the screen, and the picture's edge does not cut it off.
NEAR, FAR, NEAR_PARALLAX, FAR_PARALLAX = 12.0, 150.0, 0.4, 1.6


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND)
    land, air, views = (staging.new_collection(scene, name) for name in ("Temple", "Passing", "Stereo"))
    sky = lighting.build_sky_group()
    scene.world = lighting.build_world(sky)
    lighting.add_sun(land)
    lighting.set_color_management(scene)
    colonnade.build(land, lighting.build_haze_group(sky))
    plane = aeroplane.build(air)
    course = flight.add_course(air, COURSE, is_cyclic=True)
    flight.follow(
        plane,
        course,
        timing="SPEED",
        speed=SPEED,
        orientation="BANKING",
        bank_limit=BANK_LIMIT,
        bank_smoothing=BANK_SMOOTHING,
        forward_axis="POS_Y",
        up_axis="POS_Z",
    )
    _, camera = gaze_camera.add(
        context,
        scene,
        views,
        "Stereo Camera",
        STAND,
        LENS,
        plane,
        GAZE,
        convergence="BUDGET",
        near=NEAR,
        far=FAR,
        near_parallax=NEAR_PARALLAX,
        far_parallax=FAR_PARALLAX,
    )
    if bpy.ops.motus.stereo_output(object=camera.name, format="ANAGLYPH") != {"FINISHED"}:
        raise RuntimeError("The output of the stereo camera could not be set")
    scene.frame_start, scene.frame_end = 1, round(flight.course_length(course) / SPEED * FRAMES_PER_SECOND)
    scene.frame_set(1)
    return scene
