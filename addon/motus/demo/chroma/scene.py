"""The scene "Motus Chroma Key": a pilot who was filmed before a green screen stands among columns while his aeroplane passes."""

import math

import bpy

from ...chroma import compositor, group
from ...core.blender import node_groups
from ..flying import aeroplane, flight
from ..places import colonnade
from ..stage import lighting, staging
from . import green_screen

SCENE_NAME = "Motus Chroma Key"
FRAMES_PER_SECOND = 24
COURSE = ((-34.0, 92.0, 11.0), (-4.0, 62.0, 8.5), (7.0, 36.0, 5.6), (16.0, 14.0, 5.4), (30.0, -10.0, 9.0))
SPEED, START = 23.0, 12.0  # m/s, and m into the course
BANK_SMOOTHING, BANK_LIMIT = 7.0, math.radians(50.0)
F_STOP = 2.8
SMOOTH, GROW, FEATHER, WRAP, LIMIT = 1, 0, 1, 0.25, "AVERAGE"


def build(context):
    """Build the scene, show it in the window and return it."""
    studio = green_screen.build(context, FRAMES_PER_SECOND)
    test_shot = green_screen.test_shot(studio)
    scene = bpy.data.scenes.new(SCENE_NAME)
    context.window.scene = scene
    scene.render.fps = FRAMES_PER_SECOND
    scene.render.resolution_x, scene.render.resolution_y = 1280, 720
    scene.frame_start, scene.frame_end = 1, green_screen.FRAMES
    scene.frame_set(1)
    land, air = (staging.new_collection(scene, name) for name in ("Ruin", "Aeroplane"))
    sky = lighting.build_sky_group()
    scene.world = lighting.build_world(sky)
    lighting.add_sun(land)
    lighting.set_color_management(scene)
    colonnade.build(land, lighting.build_haze_group(sky))
    flight.follow(
        aeroplane.build(air),
        flight.add_course(air, COURSE),
        timing="SPEED",
        speed=SPEED,
        offset=START,
        orientation="BANKING",
        bank_limit=BANK_LIMIT,
        bank_smoothing=BANK_SMOOTHING,
        forward_axis="POS_Y",
        up_axis="POS_Z",
    )
    scene.camera = green_screen.add_camera(land, "Place Camera")
    _blur_the_distance(scene.camera.data)
    _key(scene, studio, test_shot)
    scene.frame_set(1)
    return scene


def _key(scene, studio, test_shot):
    """Set up the chroma key with the public operator, which measures the test shot, and then connect the rendered set in its place."""
    # The scene's view transform is kept, because the key acts before it and the set is lit like the background.
    result = bpy.ops.motus.chroma_key_setup(
        clip=test_shot.name, use_scene=False, smooth=SMOOTH, grow=GROW, feather=FEATHER, despill_limit=LIMIT, light_wrap=WRAP
    )
    if result != {"FINISHED"}:
        raise RuntimeError("The footage could not be keyed")
    tree = compositor.tree_of(scene)
    shot = compositor.node_of(scene, compositor.FOREGROUND)
    live = tree.nodes.new("CompositorNodeRLayers")
    live[group.KEY] = live.name = live.label = studio.name
    live.scene, live.parent = studio, shot.parent
    live.location = shot.location.x, shot.location.y + 340.0
    # Rendered pictures have premultiplied alpha, so they are connected directly to the node that scales the footage.
    target = compositor.node_of(scene, f"{compositor.FOREGROUND} Size").inputs["Image"]
    node_groups.link(tree, live.outputs["Image"], target)


def _blur_the_distance(camera):
    """Set depth of field, so that everything behind the pilot is out of focus."""
    camera.dof.use_dof = True
    camera.dof.focus_distance, camera.dof.aperture_fstop = math.hypot(*green_screen.PLACE), F_STOP
