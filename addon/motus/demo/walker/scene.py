"""The scene "Motus Walker": a spider walks over the stones of a garden and up a wall, followed by her young; toys go on a turntable."""

import bpy
import numpy as np
from mathutils import Vector

from ..stage import lighting, shapes, staging
from . import garden, toys

SCENE_NAME = "Motus Walker"
FRAMES_PER_SECOND, LAST_FRAME = 24, 288
# x and y of the way on the ground, m; z is the height of the ground.
WAY = ((-0.75, -5.6), (-0.50, -4.5), (0.18, -3.45), (-0.18, -2.5), (0.14, -1.65), (0.02, -0.98))
# x, y and z of the way up the wall, m; y is relative to the wall's face, garden.WALL_FACE.
CLIMB = ((0.0, -0.22, 0.15), (0.0, -0.01, 0.58), (0.05, 0.0, 1.15), (0.22, 0.0, 1.95), (0.12, 0.0, 2.9))
SPEED, START = 0.60, 1.15  # m/s, and m along the way at which the spider starts
SPAN = 1.15
# Of each young spider: span, distance behind the mother, distance to the side, colour.
YOUNG = (
    (0.46, 0.95, -0.30, (0.80, 0.36, 0.03, 1.0)),
    (0.40, 1.25, 0.26, (0.75, 0.10, 0.02, 1.0)),
    (0.36, 1.62, -0.12, (0.85, 0.52, 0.08, 1.0)),
)
# The mother feels for the wall with a front leg, which leaves the ground and lands on frames of its own: (frame of the step, when).
FEELING, FEELER = ((155, {"lift": 160.0}), (166, {"touch": 174.0})), "foot 1.L"
SKY_STOPS = ((0.0, (0.80, 0.62, 0.44)), (0.10, (0.62, 0.66, 0.68)), (0.35, (0.28, 0.44, 0.66)), (1.0, (0.08, 0.20, 0.46)))
VIEWS = (("AgX", "AgX - Punchy", 0.75), ("Filmic", "High Contrast", 0.25), ("Filmic", "Filmic - High Contrast", 0.25))
LENS = 34.0
# Keys of the camera: (frame, place).
FILMING = ((1, (-1.10, -2.55, 0.78)), (90, (-1.95, -1.65, 0.66)), (180, (-2.45, -2.35, 0.80)), (288, (-2.1, -3.0, 1.45)))
AIM_AHEAD, AIM_UP = 0.10, 0.16  # m


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND, LAST_FRAME)
    land, plants, beasts, views = (staging.new_collection(scene, name) for name in ("Garden", "Plants", "Spiders", "Views"))
    scene.world = lighting.build_gradient_world(
        "Motus Garden Sky", SKY_STOPS, 0.75, lambda shader, height: shader.math("MAXIMUM", height, 0.0)
    )
    lighting.add_sun(views)
    lighting.set_color_management(scene, VIEWS)
    garden.build(land, plants)
    context.view_layer.active_layer_collection = context.view_layer.layer_collection.children[beasts.name]
    mother = _add_spider(beasts, land, "Spider", SPAN, START, 0.0, (0.72, 0.15, 0.015, 1.0))
    for frame, moment in FEELING:
        _check(bpy.ops.motus.walker_step_time(object=mother.name, foot=FEELER, frame=frame, **moment))
    for index, (span, behind, aside, color) in enumerate(YOUNG):
        _add_spider(beasts, land, f"Young {index + 1}", span, START - behind, aside, color)
    toys.build(beasts, views)
    _add_camera(scene, views, mother)
    scene.frame_set(1)
    return scene


def _add_spider(collection, land, name, span, offset, aside, color):
    """Add a spider on a separate course, with the public operators."""
    course = _add_course(collection, f"{name} Course", aside)
    _check(
        bpy.ops.motus.spider_add(
            size=span,
            color=color,
            location=(0.0, 0.0, 0.0),
            grounds=land.name,
            stride=0.21 * span,
            reach_down=span,
            frequency=2.2,
            damping=0.85,
            body_tilt=0.8,
            cadence=0.8 / span,
        )
    )
    spider = bpy.context.object
    spider.name = name
    _check(
        bpy.ops.motus.path_follow_add(
            object=spider.name, curve=course.name, timing="SPEED", speed=SPEED, offset=offset, orientation="MINIMAL"
        )
    )
    return spider


def _check(result):
    if result != {"FINISHED"}:
        raise RuntimeError("a spider could not be added")


def _add_course(collection, name, aside):
    """Add a curve over the ground and up the wall as a course. aside: m by which the course is moved to the side."""
    places = [Vector((x + aside, y, _height(x + aside, y))) for x, y in WAY]
    places += [Vector((x + aside, garden.WALL_FACE + y, z)) for x, y, z in CLIMB]
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions = "3D"
    spline = curve.splines.new("BEZIER")
    spline.bezier_points.add(len(places) - 1)
    for point, place in zip(spline.bezier_points, places):
        point.co = place
        point.handle_left_type = point.handle_right_type = "AUTO"
    course = shapes.link_object(collection, name, curve)
    course.hide_render = True
    return course


def _height(x, y):
    return float(garden.height(np.array([x]), np.array([y]))[0])


def _add_camera(scene, collection, mother):
    """Add a camera that moves beside the mother spider and looks at her."""
    aim = shapes.link_object(collection, "Spider Aim", None, mother)
    aim.location, aim.empty_display_size = (0.0, AIM_AHEAD, AIM_UP), 0.1
    data = bpy.data.cameras.new("Garden Camera")
    data.lens, data.clip_start = LENS, 0.05
    data.dof.use_dof, data.dof.focus_object, data.dof.aperture_fstop = True, aim, 2.8
    camera = shapes.link_object(collection, "Garden Camera", data)
    tracking = camera.constraints.new("TRACK_TO")
    tracking.target, tracking.track_axis, tracking.up_axis = aim, "TRACK_NEGATIVE_Z", "UP_Y"
    for frame, place in FILMING:
        camera.location = place
        camera.keyframe_insert("location", frame=frame)
    scene.camera = camera
