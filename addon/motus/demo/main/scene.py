"""The scene "Motus Main": eight systems at once, on a winter evening.

A pilot walks through the snow with an aeroplane in his hand, throws it and steers it, and a spider goes to meet it; two
lanterns swing in the wind, and a stereo camera looks after it all.
"""

import math

import bpy

from ..stage import gaze_camera, shapes, staging
from ..stage.keying import key
from ..village import snowfall
from . import flight, lanterns as main_lanterns, pilot as main_pilot, spider as main_spider, terrain

SCENE_NAME = "Motus Main"
FRAMES_PER_SECOND, LAST_FRAME = 24, 264
# Name, place, half width, flakes a second, seed: over the village, and a few before the camera, none at it.
CLOUDS = (
    ("Snowfall", (0.0, 15.6, 10.0), 15.5, 400.0, 0),
    ("Near Snowfall", (0.2, 4.6, 6.0), 2.9, 36.0, 1),
)
AHEAD, LIFETIME = 45.0, 14.0  # s before the scene in which it has snowed, and until flakes have come down
COVER = {"lump": 0.30, "resolution": 0.22, "smoothing": 0.55, "thinnest": 0.004, "repose": math.radians(62.0)}
STAND, LENS = (0.25, -4.4, 1.60), 34.0  # of the camera while the aeroplane flies
DOLLY = (
    (1, (-1.2, 4.9, -0.45)),
    (60, (-0.95, 3.1, -0.40)),
    (112, (0.0, 0.0, 0.0)),
    (215, (0.1, 0.2, 0.0)),
    (LAST_FRAME, (-0.15, 2.1, -0.3)),
)
"""Frames, and m from there: near him as he walks, then back."""

GAZE = 1.0  # of the camera's head, to what it attends to
ATTENTION_HEIGHT = 1.45  # m
PLANE_SHARE = ((1, 0.0), (70, 0.0), (96, 0.42), (205, 0.42), (LAST_FRAME, 0.5))
PLANE_RISE = ((1, 0.0), (70, 0.0), (96, 0.26), (190, 0.26), (LAST_FRAME, 0.5))
"""Of the aeroplane's place, and of its height, in what the camera attends to; the rest is the pilot's."""

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
    # So many flakes are not worked out while a frame waits for them.
    bpy.ops.motus.snow_cover_work_out(object=lying)
    return scene


def _add_camera(context, scene, collection, stage, carrier):
    """A stereo camera that moves a little, and looks between the pilot and his aeroplane."""
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
