"""The scene "Motus Snow": a village at the edge of a wood at dusk turns white in falling snow, through which a snowball rolls."""

import math

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ..stage import lighting, shapes, staging
from ..village import houses, props, snowfall, terrain, trees

SCENE_NAME = "Motus Snow"
FRAMES_PER_SECOND = 24
SECONDS = 10

# Sky colours from the horizon to the zenith: (sine of the elevation, linear rgb).
SKY_STOPS = (
    (0.0, (0.50, 0.33, 0.34)),
    (0.10, (0.24, 0.25, 0.40)),
    (0.35, (0.055, 0.095, 0.23)),
    (1.0, (0.012, 0.028, 0.095)),
)
SKY_STRENGTH = 0.55
MOON_COLOR, MOON_STRENGTH, MOON_ROTATION = (0.55, 0.68, 1.0), 1.1, (1.32, 0.0, 1.15)
VIEWS = (("AgX", "AgX - Medium High Contrast", 0.9), ("Filmic", "Medium High Contrast", 0.6))
# Of each snow cloud: name, place, half width, flakes per second, seed. One is over the whole village, one in front of the camera, which
# becomes heavier as the scene goes on.
CLOUDS = (
    ("Snowfall", (0.0, 11.5, 10.0), 17.0, 2600.0, 0),
    ("Near Snowfall", (0.0, -2.5, 6.0), 4.5, {0.0: 60.0, 8.0: 420.0}, 1),
)
AHEAD = 12.0  # seconds of snowfall before the scene: at its start there is only a little snow, on roofs
LIFETIME = 14.0  # seconds until a flake has come down
COVER = {"lump": 0.19, "resolution": 0.15, "smoothing": 0.35, "thinnest": 0.003, "repose": math.radians(62.0), "packed": 0.015}
ROLL = (4.6, -2.6), (3.0, 0.4), (2.1, 2.6), (0.6, 4.4), (-0.2, 6.8)
"""Points, x and y, between which the snowball rolls in a smooth curve."""
ROLLS = 5.5, 9.6  # seconds of the scene
BALL = 0.34, 0.66  # m, radius of the snowball before and after
SUNK = 0.1  # m, by which the ball, soft as it is, is lower than the ground
CAMERA_PLACE, CAMERA_AIM, CAMERA_LENS = Vector((1.4, -8.8, 3.1)), Vector((-0.5, 14.0, 2.5)), 34.0
CAMERA_TRAVEL = 1.1  # m by which the camera moves to the left during the scene


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND, SECONDS * FRAMES_PER_SECOND)
    land, covered, snow = (staging.new_collection(scene, name) for name in ("Evening", "Covered", "Snowfall"))
    scene.world = _world()
    lighting.set_color_management(scene, VIEWS)
    _add_moon(land)
    white = terrain.whitening(scene)
    terrain.build(land, covered, white)
    houses.build(land, covered)
    props.build(land, covered)
    trees.build(land, covered, terrain.mottled("Wood Needles", (0.012, 0.034, 0.024), (0.022, 0.052, 0.038), 3.0, white))
    _add_camera(scene, land)
    ball = _add_snowball(scene, land)
    snowfall.add(context, snow, covered, CLOUDS, AHEAD, LIFETIME, {**COVER, "movers": ball.name})
    scene.frame_set(1)
    return scene


def _world():
    """Make the world: the last light of the day, as a gradient over the elevation."""
    return lighting.build_gradient_world("Motus Dusk", SKY_STOPS, SKY_STRENGTH, lambda shader, height: shader.math("MAXIMUM", height, 0.0))


def _add_moon(collection):
    lamp = bpy.data.lights.new("Moon", "SUN")
    lamp.energy, lamp.color, lamp.angle = MOON_STRENGTH, MOON_COLOR, math.radians(4.0)
    shapes.link_object(collection, "Moon", lamp).rotation_euler = MOON_ROTATION


def _add_snowball(scene, collection):
    """Add a snowball that rolls over the meadow and grows. Returns the object."""
    points, faces = shapes.sphere(1.0, segments=48, rings=25)
    points = points * (1.0 + 0.03 * np.sin(7.0 * points @ (1.0, 0.3, 0.0)) * np.cos(6.0 * points @ (0.0, 1.0, 0.7)))[:, None]
    mesh = shapes.MeshBuilder()
    mesh.add((points, faces))
    ball = shapes.link_object(
        collection, "Snowball", mesh.build("Snowball", [terrain.mottled("Snowball", (0.78, 0.82, 0.90), terrain.WHITE, 5.0)])
    )
    first, last = (round(scene.frame_start + at * scene.render.fps) for at in ROLLS)
    turned, before = Matrix.Identity(3), None
    # The points of the curve are closer to each other toward its ends, where the ball is slow.
    for number, (x, y) in enumerate(shapes.smooth_profile_points(ROLL, last - first + 1).tolist()):
        radius = BALL[0] + (BALL[1] - BALL[0]) * math.sqrt(number / (last - first))
        place = Vector((x, y, terrain.ground_at(x, y) + radius - SUNK))
        if before is not None:
            step = place - before
            turned = Matrix.Rotation(step.length / radius, 3, Vector((-step.y, step.x, 0.0))) @ turned
        before = place
        ball.location, ball.scale, ball.rotation_mode = place, 3 * (radius,), "QUATERNION"
        ball.rotation_quaternion = turned.to_quaternion()
        for name in ("location", "scale", "rotation_quaternion"):
            ball.keyframe_insert(name, frame=first + number)
    return ball


def _add_camera(scene, collection):
    """Add a camera that moves slowly to the side."""
    data = bpy.data.cameras.new("Evening Camera")
    data.lens = CAMERA_LENS
    camera = shapes.link_object(collection, "Evening Camera", data)
    for frame, side in ((scene.frame_start, 0.5), (scene.frame_end, -0.5)):
        camera.location = CAMERA_PLACE + Vector((side * CAMERA_TRAVEL, 0.0, 0.0))
        camera.rotation_euler = (CAMERA_AIM - camera.location).to_track_quat("-Z", "Y").to_euler()
        camera.keyframe_insert("location", frame=frame)
        camera.keyframe_insert("rotation_euler", frame=frame)
    scene.camera = camera
