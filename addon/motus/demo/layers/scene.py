"""The scene "Motus Layers": a wooden pilot walks on a small planet, and throws and jumps while he goes on walking."""

import math

import bpy
from mathutils import Matrix, Vector

from ..character import clips as character_clips, mannequin, skeleton
from ..flying import aeroplane
from ..stage import lighting, shapes, staging
from . import planet

SCENE_NAME = "Motus Layers"
FRAMES_PER_SECOND, LAST_FRAME = 24, 216
THROW_START, JUMP_START = 44.0, 128.0
WAVE = {
    "upper_arm.R": ((90, 0.0, 0.0), (99, 150.0, 14.0), (117, 150.0, 14.0), (127, 0.0, 0.0)),
    "forearm.R": (
        (90, 0.0, 0.0),
        (99, 30.0, -34.0),
        (104, 30.0, 30.0),
        (109, 30.0, -34.0),
        (114, 30.0, 30.0),
        (118, 30.0, -20.0),
        (127, 0.0, 0.0),
    ),
    "hand.R": ((90, 0.0, 0.0), (100, 0.0, -16.0), (105, 0.0, 16.0), (110, 0.0, -16.0), (115, 0.0, 16.0), (127, 0.0, 0.0)),
}
"""Keys of a wave to the camera: frame, and degrees about the bone's X and Z axes."""
TOY_SIZE = 0.075  # scale of the toy relative to the aeroplane in which pilots fly
TOY_IN_HAND = Matrix.Translation((0.0, 0.085, 0.0)) @ Matrix.Rotation(1.2, 4, 'X')
FLIGHT = (
    (10, (0.60, -1.65, 1.95)),
    (28, (2.40, -1.00, 2.25)),
    (60, (5.80, 4.00, 3.40)),
    (110, (6.00, 20.00, 6.50)),
    (150, (3.00, 44.00, 12.00)),
)
"""Keys of the toy aeroplane's flight: frame after the release, and place; it flies ahead, in a circle, and away."""

CAMERA_PLACE, CAMERA_AIM, CAMERA_LENS = (-3.10, -4.95, 1.30), (0.02, -0.20, 1.16), 38.0
CAMERA_DRIFT = (1.45, -0.35, 0.20)  # m by which the camera moves during the scene


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND, LAST_FRAME)
    land, figure, views = (staging.new_collection(scene, name) for name in ("Planet", "Walker", "Views"))
    scene.world = planet.build_world()
    lighting.add_sun(land)
    lighting.set_color_management(scene, planet.VIEWS)
    ahead = 2.0 * character_clips.STEP[0][1] / (character_clips.STRIDE / 2)  # m per frame
    planet.build(land, ahead / planet.RADIUS)
    stage = shapes.link_object(figure, "Walker Stage", None)
    rig = skeleton.build(context, figure, stage)
    mannequin.build(figure, rig)
    _animate(rig)
    _wave(scene, rig)
    _add_toy(scene, figure, rig)
    _add_camera(scene, views)
    scene.frame_set(1)
    return scene


def _animate(rig):
    """Add three animation layers of actions with the public operators: the repeated walk, and a throw and a jump on top of the walk."""
    clips = {"Throw": character_clips.throw(rig), "Jump": character_clips.jump(rig), "Walk": character_clips.walk(rig)}
    character_clips.lay(rig, clips["Walk"], mask='ALL', start=1.0, after='REPEAT')
    character_clips.lay(
        rig, clips["Throw"], bones="spine.002", start=THROW_START, blend_in=7.0, blend_out=10.0, feather=1, in_armature=True
    )
    character_clips.lay(rig, clips["Jump"], mask='ALL', start=JUMP_START, blend_in=5.0, blend_out=6.0)


def _wave(scene, rig):
    """Key a wave into a new layer while it is edited, as it is done by hand: the keys go into the layer's action, on top of the walk."""
    layer = {"object": rig.name, "layer": "Wave"}
    _check(bpy.ops.motus.layer_new(bones="upper_arm.R", mode="ADDITIVE", **layer))
    _check(bpy.ops.motus.layer_edit(**layer))
    for name, keys in WAVE.items():
        bone = rig.pose.bones[name]
        for frame, ahead, aside in keys:
            scene.frame_set(frame)
            bone.rotation_euler = (math.radians(ahead), 0.0, math.radians(aside))
            bone.keyframe_insert("rotation_euler", frame=frame)
    _check(bpy.ops.motus.layer_edit(**layer))


def _check(result):
    if result != {"FINISHED"}:
        raise RuntimeError("The wave could not be laid over the walk")


def _add_toy(scene, collection, rig):
    """Add the toy aeroplane, which is in the hand until the throw releases it, and then flies by keys."""
    toy = shapes.link_object(collection, "Toy", None)
    aeroplane.build(collection).parent = toy
    toy.scale = 3 * [TOY_SIZE]
    release = int(THROW_START) + character_clips.RELEASE - 1
    scene.frame_set(release)
    hand = rig.matrix_world @ rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones["hand.R"].matrix
    held = toy.constraints.new("CHILD_OF")
    held.target, held.subtarget, held.inverse_matrix = rig, "hand.R", Matrix()
    held.use_scale_x = held.use_scale_y = held.use_scale_z = False
    for frame, influence in ((1, 1.0), (release, 0.0)):
        held.influence = influence
        held.keyframe_insert("influence", frame=frame)
    _set_steps(toy)
    _key_place(toy, TOY_IN_HAND, 1)
    _key_place(toy, TOY_IN_HAND, release - 1)
    _key_place(toy, hand @ TOY_IN_HAND, release)
    place = (hand @ TOY_IN_HAND).translation
    for after, goal in FLIGHT:
        way = Vector(goal) - place
        place = Vector(goal)
        _key_place(toy, Matrix.Translation(goal) @ way.to_track_quat('Y', 'Z').to_matrix().to_4x4(), release + after)


def _key_place(toy, matrix, frame):
    toy.location, toy.rotation_mode = matrix.translation, "QUATERNION"
    toy.rotation_quaternion = matrix.to_quaternion()
    toy.keyframe_insert("location", frame=frame)
    toy.keyframe_insert("rotation_quaternion", frame=frame)


def _set_steps(thing):
    """Set constant interpolation for all keys that an object has so far."""
    from ...core.blender import actions

    for curve in actions.fcurves(thing):
        for point in curve.keyframe_points:
            point.interpolation = "CONSTANT"


def _add_camera(scene, collection):
    """Add a camera that moves slowly beside the walking pilot."""
    aim = shapes.link_object(collection, "Walker Aim", None)
    aim.location = CAMERA_AIM
    aim.empty_display_size = 0.1
    data = bpy.data.cameras.new("Planet Camera")
    data.lens = CAMERA_LENS
    camera = shapes.link_object(collection, "Planet Camera", data)
    constraint = camera.constraints.new("TRACK_TO")
    constraint.target, constraint.track_axis, constraint.up_axis = aim, "TRACK_NEGATIVE_Z", "UP_Y"
    for frame, part in ((1, 0.0), (LAST_FRAME, 1.0)):
        camera.location = Vector(CAMERA_PLACE) + part * Vector(CAMERA_DRIFT)
        camera.keyframe_insert("location", frame=frame)
    scene.camera = camera
