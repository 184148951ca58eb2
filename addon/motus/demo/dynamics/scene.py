"""The scene "Motus Dynamics": a creature hops round a table by a few keys; dynamics move its tail and antennae."""

import math

import bpy

from ...core.blender import actions
from ..places import clay_studio
from ..stage import lighting, shapes, staging
from . import body as hopper_body, skeleton

SCENE_NAME = "Motus Dynamics"
FRAMES_PER_SECOND = 24
HOPS, HOP = 5, 22  # number of hops in a cycle, and frames of each hop
CYCLE = HOPS * HOP
RADIUS, HEIGHT = 1.25, 0.85  # radius of the circle around the table and height of a hop, m
CENTRE = (0.15, 0.35)
CROUCH, AIR = 6, 10  # frames of crouching before the take-off, and frames in the air
START = math.radians(200.0)  # angle on the circle at which the creature starts
ANTENNAE = 0.4  # weight of the antennae's dynamics: with all of it they are folded up at each landing

CAMERA_PLACE, CAMERA_AIM, CAMERA_LENS = (-0.9, -7.9, 2.0), (0.0, 0.2, 0.95), 44.0


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND, CYCLE)
    studio, creature = (staging.new_collection(scene, name) for name in ("Studio", "Hopper"))
    lighting.set_color_management(scene)
    scene.world = clay_studio.build_world()
    clay_studio.build_room(studio)
    rig = skeleton.build(context, creature)
    hopper_body.build(creature, rig)
    _key_hops(rig)
    _add_dynamics(rig)
    _add_camera(scene, studio)
    scene.frame_set(1)
    return scene


def _add_dynamics(rig):
    """Add dynamics for the motion that has no keys, as a loop: the scene's last frame leads into its first frame without a seam."""
    tail, left, right = (",".join(skeleton.names(chain)) for chain in (skeleton.TAIL, *skeleton.ANTENNAE))
    bpy.ops.motus.dynamics_add(object=rig.name, bones=tail, style='FLOPPY', chain_delay=0.035, use_loop=True)
    for antenna in (left, right):
        bpy.ops.motus.dynamics_add(object=rig.name, bones=antenna, style='BOUNCY', chain_delay=0.015, weight=ANTENNAE, use_loop=True)
    bpy.ops.motus.dynamics_add(object=rig.name, bones=skeleton.BODY, style='BOUNCY', follow='OWN', channels={'SCALE'}, use_loop=True)


def _key_hops(rig):
    """Key the creature's place and direction, and how it crouches before each hop."""
    for hop in range(HOPS + 1):
        frame = 1 + hop * HOP
        here, there = _place(hop), _place(hop + 1)
        middle = [0.5 * (one + other) for one, other in zip(here, there)]
        _key(rig, "location", 0, frame + CROUCH, here[0], 'LINEAR')
        _key(rig, "location", 1, frame + CROUCH, here[1], 'LINEAR')
        _key(rig, "location", 2, frame + CROUCH, 0.0, 'QUAD', 'EASE_OUT')
        _key(rig, "location", 2, frame + CROUCH + AIR // 2, HEIGHT, 'QUAD', 'EASE_IN')
        for axis in (0, 1):
            _key(rig, "location", axis, frame + CROUCH + AIR // 2, middle[axis], 'LINEAR')
            _key(rig, "location", axis, frame + CROUCH + AIR, there[axis], 'CONSTANT')
        _key(rig, "location", 2, frame + CROUCH + AIR, 0.0, 'CONSTANT')
        turn = START + 2.0 * math.pi * hop / HOPS
        _key(rig, "rotation_euler", 2, frame + CROUCH, turn + math.pi, 'SINE', 'EASE_IN_OUT')
        _key(rig, "rotation_euler", 2, frame + CROUCH + AIR, turn + math.pi + 2.0 * math.pi / HOPS, 'CONSTANT')
        # The keys have constant interpolation: dynamics turn the steps between the shapes into swinging.
        body = rig.pose.bones[skeleton.BODY]
        for later, tall in (
            (0, 0.78),
            (CROUCH - 1, 1.22),
            (CROUCH + 4, 1.0),
            (CROUCH + AIR - 2, 1.12),
            (CROUCH + AIR, 0.70),
            (CROUCH + AIR + 3, 1.0),
        ):
            wide = 1.0 / math.sqrt(tall)
            for axis, value in enumerate((wide, tall, wide)):
                _key(body, "scale", axis, frame + later, value, 'CONSTANT')
    for axis, value in enumerate(_place(0)):
        _key(rig, "location", axis, 1, value, 'CONSTANT')
    _key(rig, "rotation_euler", 2, 1, START + math.pi, 'CONSTANT')


def _place(hop):
    angle = START + 2.0 * math.pi * hop / HOPS
    return CENTRE[0] + RADIUS * math.cos(angle), CENTRE[1] + RADIUS * math.sin(angle)


def _key(thing, name, axis, frame, value, interpolation, easing='AUTO'):
    getattr(thing, name)[axis] = value
    thing.keyframe_insert(name, index=axis, frame=frame)
    path = name if thing == thing.id_data else f"{thing.path_from_id()}.{name}"
    points = actions.find(thing.id_data, path, axis).keyframe_points
    point = next(point for point in points if round(point.co[0]) == frame)
    point.interpolation, point.easing = interpolation, easing


def _add_camera(scene, collection):
    aim = shapes.link_object(collection, "Camera Aim", None)
    aim.location, aim.empty_display_size = CAMERA_AIM, 0.2
    data = bpy.data.cameras.new("Table Camera")
    data.lens = CAMERA_LENS
    camera = shapes.link_object(collection, "Table Camera", data)
    camera.location = CAMERA_PLACE
    constraint = camera.constraints.new("TRACK_TO")
    constraint.target, constraint.track_axis, constraint.up_axis = aim, "TRACK_NEGATIVE_Z", "UP_Y"
    scene.camera = camera
