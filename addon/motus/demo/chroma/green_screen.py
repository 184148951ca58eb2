"""The footage of the chroma key's demo: the wooden pilot in front of a green screen, lit like the place where he will stand.

The footage is a separate scene, which the compositor renders instead of reading a film. One small picture of the scene is used to
measure the green screen.
"""

import math
from pathlib import Path

import bpy
from mathutils import Euler, Matrix

from ..character import mannequin, skeleton
from ..stage import keying, lighting, materials, shapes, staging

SCENE_NAME = "Motus Green Screen"
TEST_SHOT = "Green Screen Test Shot"
TEST_SIZE, TEST_SAMPLES = (192, 108), 4
SAMPLES = 8
FRAMES = 72
GREEN, DIMMEST, BRIGHTEST = (0.05, 0.40, 0.085), 0.85, 1.15
SCREEN_DISTANCE, SCREEN_SIDE = 6.0, 14.0  # m
PLACE, TURN = (-0.50, 2.25, 0.0), math.radians(-8.0)  # of the pilot; the camera is above the origin
LENS, EYE, TILT = 35.0, 1.42, math.radians(4.0)
# Light in addition to sun and sky: reflected from the sand below and from the screen behind.
BOUNCE, BOUNCE_COLOR = 0.9, (1.0, 0.66, 0.36)
SPILL = 0.25
# Keys (frame, position in the pilot's space) of the hand that points at the aeroplane, and of the target that the pilot looks at.
HAND_KEYS = (
    (1, (0.46, -0.26, 1.16)),
    (14, (0.55, -0.20, 1.36)),
    (34, (0.60, -0.14, 1.42)),
    (54, (0.60, -0.16, 1.40)),
    (FRAMES, (0.56, -0.22, 1.32)),
)
GAZE_KEYS = ((1, (0.4, -4.0, 1.5)), (12, (1.6, -2.0, 1.9)), (34, (3.0, -1.2, 2.1)), (FRAMES, (3.2, -1.6, 2.0)))
HAND, ELBOW = "hand.L", (0.62, 0.30, 0.85)
LID_SHUT = math.radians(-62.0)
FINGERS = (("index.L", 8.0), ("fingers.L", -14.0), ("index.R", -22.0), ("fingers.R", -28.0))  # degrees
SWAY = ((1, (-2.0, -3.0, -1.0)), (24, (0.5, 2.0, 1.0)), (FRAMES, (1.0, 5.0, 0.5)))  # degrees


def build(context, fps):
    """Build the set in a new scene and show the scene in the window. Returns the scene."""
    scene = bpy.data.scenes.new(SCENE_NAME)
    context.window.scene = scene
    scene.render.fps = fps
    scene.frame_start, scene.frame_end = 1, FRAMES
    scene.frame_set(1)
    studio, figure = (staging.new_collection(scene, name) for name in ("Studio", "Presenter"))
    scene.world = lighting.build_world(lighting.build_sky_group())
    lighting.add_sun(studio)
    _add_suns(studio)
    scene.camera = add_camera(studio, "Studio Camera")
    _add_screen(studio)
    _add_pilot(context, figure)
    scene.frame_set(1)
    return scene


def add_camera(collection, name):
    """Add a camera with the lens and place that the footage and the background scene have in common."""
    data = bpy.data.cameras.new(name)
    data.lens, data.clip_end = LENS, 5000.0
    camera = shapes.link_object(collection, name, data)
    camera.matrix_world = Matrix.Translation((0.0, 0.0, EYE)) @ Euler((0.5 * math.pi + TILT, 0.0, 0.0)).to_matrix().to_4x4()
    return camera


def _add_suns(collection):
    for name, energy, color, turn in (("Bounce", BOUNCE, BOUNCE_COLOR, 0.8 * math.pi), ("Spill", SPILL, GREEN, -0.5 * math.pi)):
        lamp = bpy.data.lights.new(name, "SUN")
        lamp.energy, lamp.color, lamp.use_shadow = energy, color, False
        shapes.link_object(collection, name, lamp).rotation_euler = (turn, 0.0, 0.0)


def _add_screen(collection):
    """Add the green cloth behind the pilot, and light that is stronger on the left."""
    half = 0.5 * SCREEN_SIDE
    mesh = bpy.data.meshes.new("Screen")
    mesh.from_pydata(
        [(x, SCREEN_DISTANCE, z + EYE) for x, z in ((-half, -half), (half, -half), (half, half), (-half, half))], [], [(0, 1, 2, 3)]
    )
    material, shader, output = materials.new_material("Green Screen")
    across = shader.add("ShaderNodeSeparateXYZ", {0: shader.add("ShaderNodeTexCoord").outputs["Generated"]}).outputs[0]
    light = shader.math("ADD", shader.math("MULTIPLY", across, DIMMEST - BRIGHTEST), BRIGHTEST)
    cloth = shader.add("ShaderNodeEmission", {"Color": (*GREEN, 1.0), "Strength": light})
    materials.finish(material, shader, output, cloth.outputs[0])
    mesh.materials.append(material)
    shapes.link_object(collection, "Screen", mesh)


def _add_pilot(context, collection):
    """Add the pilot, who points at the aeroplane and follows it with his eyes; Motus's public operators do both."""
    stand = shapes.link_object(collection, "Stand", None)
    stand.location, stand.rotation_euler.z = PLACE, TURN
    rig = skeleton.build(context, collection, stand)
    mannequin.build(collection, rig)
    goal, pole, seen = (shapes.link_object(collection, name, None, stand) for name in ("Shown", "Elbow", "Seen"))
    pole.location = ELBOW
    for thing, keys in ((goal, HAND_KEYS), (seen, GAZE_KEYS)):
        keying.key(thing, "location", keys)
    keying.key(rig.pose.bones["spine.002"], "rotation_euler", [(frame, [math.radians(angle) for angle in turn]) for frame, turn in SWAY])
    for name, turn in FINGERS:
        rig.pose.bones[name].rotation_euler.x = math.radians(turn)
    context.view_layer.update()
    _check(
        bpy.ops.motus.ik_add(
            object=rig.name,
            bone=HAND,
            target=goal.name,
            pole=pole.name,
            chain_length=2,
            use_tail=False,
            rotation_weight=0.0,
            keep_rotation=False,
        )
    )
    _check(
        bpy.ops.motus.look_at_add(
            object=rig.name,
            bone="head",
            target=seen.name,
            body_length=3,
            eyes="eye.L,eye.R",
            body_weight=0.3,
            head_forward="POS_Z",
            eyes_forward="POS_Y",
            use_saccades=True,
            eyes_seed=4,
        )
    )
    _check(bpy.ops.motus.look_at_lid_add(object=rig.name, bone="head"))
    for lid in rig.motus.look_at.entries["head"].lids:
        lid.angle = LID_SHUT


def _check(result):
    if result != {"FINISHED"}:
        raise RuntimeError("The pilot could not be wired")


def test_shot(scene):
    """Render a small picture of the set and pack it into the file; returns the image. The set gets its final render settings."""
    render, view = scene.render, scene.view_settings
    view.view_transform, view.look, view.exposure = "Standard", "None", 0.0
    render.engine = "CYCLES"  # unlike EEVEE, Cycles has no shaders to compile
    scene.cycles.samples, scene.cycles.use_denoising = TEST_SAMPLES, False
    render.resolution_x, render.resolution_y = TEST_SIZE
    render.image_settings.file_format, render.image_settings.color_mode = "PNG", "RGB"
    kept = render.filepath
    render.filepath = str(Path(bpy.app.tempdir, "green_screen.png"))
    bpy.ops.render.render(write_still=True, scene=scene.name)
    image = bpy.data.images.load(render.filepath)
    image.name = TEST_SHOT
    image.pack()
    render.filepath = kept
    engines = render.bl_rna.properties["engine"].enum_items
    render.engine = next(item.identifier for item in engines if "EEVEE" in item.identifier)
    scene.eevee.taa_render_samples = SAMPLES
    render.resolution_x, render.resolution_y = 1280, 720
    return image
