"""The scene "Motus Main": eight systems of the add-on in one scene, on a winter evening.

A pilot walks through the snow with a toy aeroplane in his hand, throws it and steers it, and a spider goes to meet it; two
lanterns swing in the wind, and a stereo camera follows pilot and aeroplane.
"""

import math

import bpy

from ..stage import gaze_camera, shapes, staging
from ..stage.keying import key
from ..village import snowfall
from . import flight, lanterns as main_lanterns, pilot as main_pilot, spider as main_spider, terrain

SCENE_NAME = "Motus Main"
FRAMES_PER_SECOND, LAST_FRAME = 24, 264
# Of each snow cloud: name, place, half width, flakes per second, seed. One is over the village, one in front of the camera.
CLOUDS = (
    ("Snowfall", (0.0, 15.6, 10.0), 15.5, 400.0, 0),
    ("Near Snowfall", (0.2, 4.6, 6.0), 2.9, 36.0, 1),
)
AHEAD, LIFETIME = 45.0, 14.0  # seconds of snowfall before the scene, and seconds until a flake has come down
COVER = {"lump": 0.30, "resolution": 0.22, "smoothing": 0.55, "thinnest": 0.004, "repose": math.radians(62.0)}
STAND, LENS = (0.25, -4.4, 1.60), 34.0  # place and focal length of the camera while the aeroplane flies
DOLLY = (
    (1, (-1.2, 4.9, -0.45)),
    (60, (-0.95, 3.1, -0.40)),
    (112, (0.0, 0.0, 0.0)),
    (215, (0.1, 0.2, 0.0)),
    (LAST_FRAME, (-0.15, 2.1, -0.3)),
)
"""Keys of the camera: frame, and distance from STAND in m. It is near the pilot while he walks, then moves back."""

GAZE = 1.0  # weight with which the camera's head turns to its target
ATTENTION_HEIGHT = 1.45  # m
PLANE_SHARE = ((1, 0.0), (70, 0.0), (96, 0.42), (205, 0.42), (LAST_FRAME, 0.5))
PLANE_RISE = ((1, 0.0), (70, 0.0), (96, 0.26), (190, 0.26), (LAST_FRAME, 0.5))
"""Keys of the aeroplane's weight in the camera's target: PLANE_SHARE for x and y, PLANE_RISE for z. The pilot has the rest."""

NEAR, FAR, NEAR_PARALLAX, FAR_PARALLAX = 2.8, 60.0, 0.25, 1.6


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND, LAST_FRAME)
    names = ("Winter Village", "Snow Covered", "Pilot", "Marks", "Aeroplane", "Lanterns", "Spider", "Snowfall", "Stereo")
    land, covered, figure, marks, air, lanterns, spider, snow, views = (staging.new_collection(scene, name) for name in names)
    ground = terrain.build(scene, land, covered)
    main_lanterns.build(context, lanterns, covered)
    way = terrain.add_way(marks)
    pilot = main_pilot.build(context, figure, marks, way)
    carrier = flight.build(scene, context, air, pilot.rig, main_pilot.RELEASE)
    main_pilot.attend(pilot, carrier)
    main_spider.build(context, spider, ground)
    lying = snowfall.add(context, snow, covered, CLOUDS, AHEAD, LIFETIME, COVER)
    _add_camera(context, scene, views, pilot.stage, carrier)
    scene.frame_set(1)
    # There are too many flakes to compute them while Blender waits for a frame, so an operator computes them now.
    bpy.ops.motus.snow_cover_work_out(object=lying)
    return scene


def _add_camera(context, scene, collection, stage, carrier):
    """Add a stereo camera that moves a little and looks at a point between the pilot and his aeroplane."""
    attention = shapes.link_object(collection, "Attention", None)
    attention.empty_display_size = 0.2
    attention.location.z = ATTENTION_HEIGHT
    for thing, axes in ((stage, "xyz"), (carrier, "xy"), (carrier, "z")):
        constraint = attention.constraints.new("COPY_LOCATION")
        constraint.name, constraint.target, constraint.use_offset = thing.name, thing, thing == stage
        for axis in "xyz":
            setattr(constraint, f"use_{axis}", axis in axes)
    for constraint, shares in zip(attention.constraints[1:], (PLANE_SHARE, PLANE_RISE)):
        key(constraint, "influence", shares)
    head, _ = gaze_camera.add(
        context,
        scene,
        collection,
        "Main Camera",
        STAND,
        LENS,
        attention,
        GAZE,
        convergence="BUDGET",
        near=NEAR,
        far=FAR,
        near_parallax=NEAR_PARALLAX,
        far_parallax=FAR_PARALLAX,
    )
    key(head, "location", [(frame, [a + b for a, b in zip(STAND, move)]) for frame, move in DOLLY])
