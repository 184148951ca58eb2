"""The picture of the page of animation layers, made through the add-on's own operators."""

import math

import bpy
from mathutils import Euler

import stage

# Name: parent, head, tail. Metres; the figure faces -Y.
BONES = {
    "Hips": ("", (0.0, 0.0, 0.92), (0.0, 0.0, 1.04)),
    "Waist": ("Hips", (0.0, 0.0, 1.04), (0.0, 0.0, 1.22)),
    "Chest": ("Waist", (0.0, 0.0, 1.22), (0.0, 0.0, 1.48)),
    "Head": ("Chest", (0.0, 0.0, 1.54), (0.0, 0.0, 1.78)),
    "Arm.L": ("Chest", (0.21, 0.0, 1.43), (0.24, 0.01, 1.15)),
    "Hand.L": ("Arm.L", (0.24, 0.01, 1.15), (0.25, -0.03, 0.88)),
    "Arm.R": ("Chest", (-0.21, 0.0, 1.43), (-0.24, 0.01, 1.15)),
    "Hand.R": ("Arm.R", (-0.24, 0.01, 1.15), (-0.25, -0.03, 0.88)),
    "Thigh.L": ("Hips", (0.10, 0.0, 0.88), (0.10, -0.01, 0.47)),
    "Shin.L": ("Thigh.L", (0.10, -0.01, 0.47), (0.10, 0.02, 0.06)),
    "Thigh.R": ("Hips", (-0.10, 0.0, 0.88), (-0.10, -0.01, 0.47)),
    "Shin.R": ("Thigh.R", (-0.10, -0.01, 0.47), (-0.10, 0.02, 0.06)),
}
THICK = {"Hips": 0.13, "Waist": 0.10, "Chest": 0.15, "Head": 0.115, "Thigh.L": 0.068, "Thigh.R": 0.068}
THIN = 0.052
# Degrees in the armature: about X (ahead is negative for what hangs down), Y, and the vertical.
WALK = {
    "Hips": (14, 0, 26),
    "Waist": (4, 0, -12),
    "Chest": (4, 0, -26),
    "Thigh.L": (-34, 0, 0),
    "Shin.L": (8, 0, 0),
    "Thigh.R": (20, 0, 0),
    "Shin.R": (28, 0, 0),
    "Arm.L": (26, 0, 0),
    "Hand.L": (-14, 0, 0),
    "Arm.R": (-30, 0, 0),
    "Hand.R": (-22, 0, 0),
}
THROW = {
    "Waist": (-4, 0, -10),
    "Chest": (-8, 0, -14),
    "Arm.R": (-172, 0, 0),
    "Hand.R": (-52, 0, 0),
    "Arm.L": (-62, 0, 0),
    "Hand.L": (-12, 0, 0),
}
# Title, a line below it, and the keywords of the layer; none of the first figure.
LAYERS = (
    ("Walk", "the rig's own action", None),
    ("Mask", "Waist and all below", {"bones": "Waist"}),
    ("Weight 0.5", "half of the way", {"bones": "Waist", "weight": 0.5}),
    ("Feather 2", "a third, two thirds, all", {"bones": "Waist", "feather": 2}),
    ("Steady in Armature", "the hips swing alone", {"bones": "Waist", "in_armature": True}),
    ("Additive", "on top of the walk", {"bones": "Waist", "mode": 'ADDITIVE', "reference": 'REST'}),
)
SPACING = 0.95
WOOD, TAKEN = (0.62, 0.40, 0.20, 1.0), (0.90, 0.30, 0.05, 1.0)
TEXT_Y = -0.55


def render_all(folder):
    """Render the picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    scene = stage.new_scene((0.52, 0.60, 0.68), 0.80)
    stage.add_floor(stage.glossy_material("Floor", (0.44, 0.52, 0.58, 1.0), 0.95))
    stage.add_sun((math.radians(42), math.radians(-8), math.radians(-30)), 2.0, softness=10.0)
    throw = throw_action()
    for index, (title, below, keywords) in enumerate(LAYERS):
        x = (index - (len(LAYERS) - 1) / 2) * SPACING
        rig = figure(x, title)
        if keywords:
            bpy.ops.motus.layer_add(object=rig.name, action=throw.name, start=1.0, after='HOLD', **keywords)
        dress(rig)
        stage.add_text(title, (x, TEXT_Y, 0.0), 0.105, upright=False)
        stage.add_text(below, (x, TEXT_Y - 0.16, 0.0), 0.08, upright=False)
    stage.add_camera(scene, (0.0, -9.0, 5.0), (0.0, 0.0, 0.84), width=SPACING * len(LAYERS) + 0.1)
    return [stage.render(scene, folder / "layers_modes.png", (1280, 520), samples=64)]


def figure(x, name):
    """A rig at x, in the pose of the walk."""
    rig = stage.link(bpy.data.objects.new(name, bpy.data.armatures.new(name)))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    for bone_name, (parent, head, tail) in BONES.items():
        bone = rig.data.edit_bones.new(bone_name)
        bone.head, bone.tail, bone.parent = head, tail, rig.data.edit_bones.get(parent)
    bpy.ops.object.mode_set(mode='OBJECT')
    rig.location.x = x
    rig.hide_render = True
    pose(rig, WALK)
    return rig


def pose(rig, turns):
    """Turn bones by angles in the armature, each against its parent."""
    for name, angles in turns.items():
        bone = rig.pose.bones[name]
        bone.rotation_mode = 'QUATERNION'
        rest, about = bone.bone.matrix_local.to_quaternion(), Euler(map(math.radians, angles)).to_quaternion()
        bone.rotation_quaternion = rest.inverted() @ about @ rest


def throw_action(keys=((1, 1.0),)):
    """The throw as an action, keyed on a figure that is gone afterwards. keys: frames, and how much of the throw there is."""
    rig = figure(0.0, "Keyed")
    for bone in rig.pose.bones:
        bone.rotation_mode = 'QUATERNION'
        bone.rotation_quaternion = (1.0, 0.0, 0.0, 0.0)
    for frame, share in keys:
        key_pose(rig, {name: [share * angle for angle in angles] for name, angles in THROW.items()}, frame)
    action = rig.animation_data.action
    action.name, action.use_fake_user = "Throw", True
    bpy.data.objects.remove(rig)
    return action


def key_pose(rig, turns, frame):
    """Pose the bones, and key them."""
    pose(rig, turns)
    for name in turns:
        rig.pose.bones[name].keyframe_insert("rotation_quaternion", frame=frame)


def dress(rig):
    """A piece of wood for each bone; what the layer takes is orange."""
    driven = {bone.name for bone in rig.pose.bones if any(one.name.startswith("Motus") for one in bone.constraints)}
    materials = {is_taken: stage.glossy_material(f"{rig.name} {is_taken}", TAKEN if is_taken else WOOD, 0.4) for is_taken in (False, True)}
    for bone in rig.data.bones:
        bpy.ops.mesh.primitive_uv_sphere_add(segments=40, ring_count=24)
        part = bpy.context.object
        thick = THICK.get(bone.name, THIN)
        part.scale = (thick, 0.52 * bone.length + 0.02, 0.8 * thick if bone.name in {"Chest", "Hips", "Waist"} else thick)
        part.parent, part.parent_type, part.parent_bone = rig, 'BONE', bone.name
        part.location = (0.0, -0.5 * bone.length, 0.0)
        part.data.materials.append(materials[bone.name in driven])
        for face in part.data.polygons:
            face.use_smooth = True
