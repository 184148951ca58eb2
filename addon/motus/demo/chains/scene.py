"""The scene "Motus Chains": a dog on a leash waits in the wind while a spider comes over a rope bridge."""

import bpy
from mathutils import Vector

from ..stage import lighting, shapes, staging
from . import bridge, dog_body, dog_bones, dog_motion, flags, gorge, pinning

SCENE_NAME = "Motus Chains"
FRAMES_PER_SECOND, LAST_FRAME = 24, 192
WIND = {"wind": (4.0, -2.2, 0.0), "gusts": 0.7}  # velocity in m/s, and its rise and fall
SPAN, COLOR = 0.82, (0.78, 0.30, 0.02, 1.0)  # of the spider
# x, y and z of the spider's way on both sides of the bridge, m.
BEFORE, BEHIND = ((-7.9, 0.05, 0.0), (-7.2, 0.0, 0.0)), ((0.7, 0.0, 0.0), (1.6, -0.1, 0.0))
SECONDS = 11.5  # duration of the spider's way, of which the scene shows the most part
VIEWS = (("AgX", "AgX - Punchy", 1.1), ("Filmic", "High Contrast", 0.15), ("Filmic", "Filmic - High Contrast", 0.15))
CAMERA_PLACE, CAMERA_AIM, CAMERA_LENS = (1.05, -6.0, 0.9), (-1.03, 0.0, 0.52), 27.0
CAMERA_DRIFT = (0.10, 0.25, -0.03)  # m by which the camera moves during the scene


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND, LAST_FRAME)
    cliffs, plants, hanging, beasts, views = (
        staging.new_collection(scene, name) for name in ("Cliffs", "Plants", "Bridge", "Beasts", "Views")
    )
    lighting.add_sun(views)
    lighting.set_color_management(scene, VIEWS)
    gorge.build(scene, cliffs, plants)
    ropes = bridge.build(context, hanging, hanging, WIND)
    flags.build(context, hanging, hanging, WIND)
    context.view_layer.active_layer_collection = context.view_layer.layer_collection.children[beasts.name]
    leash = dog_motion.leash()
    dog = dog_bones.build(context, beasts, leash)
    body = dog_body.build(beasts, dog, leash)
    dog_body.add_knot(beasts, body, dog_motion.KNOT)
    dog_motion.animate(beasts, dog, cliffs, WIND)
    spider = _add_spider(scene, beasts, cliffs)
    bridge.press(spider, ropes, [_child(beasts, f"Load {index + 1}") for index in range(len(ropes))])
    _add_camera(scene, views)
    scene.frame_set(1)
    return scene


def _child(collection, name):
    child = bpy.data.collections.new(f"Motus {name}")
    collection.children.link(child)
    return child


def _add_spider(scene, collection, cliffs):
    """Add the spider on its way over the bridge, with the public operators. It walks on a strip that shows in no picture."""
    grounds = _child(collection, "Spider Ground")
    middle = [(x, 0.0, z) for x, z in bridge.way(40)]
    _add_strip(grounds, [(-gorge.SPAN - 0.4, 0.0, 0.0), *middle, (0.4, 0.0, 0.0)])
    for cliff in cliffs.objects:
        grounds.objects.link(cliff)
    pinning.check(
        bpy.ops.motus.spider_add(
            size=SPAN,
            color=COLOR,
            location=(0.0, 0.0, 0.0),
            grounds=grounds.name,
            stride=0.26,
            reach_down=0.3,
            reach_up=0.25,
            clearance=0.07,
        )
    )
    spider = bpy.context.object
    places = [*BEFORE, *middle[::3], *BEHIND]
    curve = bpy.data.curves.new("Spider Course", "CURVE")
    curve.dimensions = "3D"
    spline = curve.splines.new("BEZIER")
    spline.bezier_points.add(len(places) - 1)
    for point, place in zip(spline.bezier_points, places):
        point.co = place
        point.handle_left_type = point.handle_right_type = "AUTO"
    course = shapes.link_object(collection, "Spider Course", curve)
    course.hide_render = True
    pinning.check(
        bpy.ops.motus.path_follow_add(
            object=spider.name,
            curve=course.name,
            timing="DURATION",
            duration=SECONDS,
            orientation="WORLD_UP",
            forward_axis="POS_Y",
            up_axis="POS_Z",
        )
    )
    return spider


def _add_strip(collection, middle):
    """Add a mesh along the bridge on which the spider's feet stand."""
    builder = shapes.MeshBuilder()
    builder.add(shapes.loft([[(x, y + side, z) for side in (0.6, -0.6)] for x, y, z in middle], closed=False))
    strip = shapes.link_object(collection, "Spider Strip", builder.build("Spider Strip", []))
    strip.hide_render, strip.display_type = True, "WIRE"


def _add_camera(scene, collection):
    """Add a camera that moves slowly towards the dog."""
    aim = shapes.link_object(collection, "Gorge Aim", None)
    aim.location, aim.empty_display_size = CAMERA_AIM, 0.1
    data = bpy.data.cameras.new("Gorge Camera")
    data.lens, data.clip_start, data.clip_end = CAMERA_LENS, 0.05, 8000.0
    camera = shapes.link_object(collection, "Gorge Camera", data)
    tracking = camera.constraints.new("TRACK_TO")
    tracking.target, tracking.track_axis, tracking.up_axis = aim, "TRACK_NEGATIVE_Z", "UP_Y"
    for frame, part in ((1, 0.0), (LAST_FRAME, 1.0)):
        camera.location = Vector(CAMERA_PLACE) + part * Vector(CAMERA_DRIFT)
        camera.keyframe_insert("location", frame=frame)
    scene.camera = camera
