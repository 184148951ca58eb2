"""A wooden arm with a hand, hung on a wall: what the pictures of Inverse Kinematics move."""

import bpy
from mathutils import Matrix, Vector

import look_at_figure as figure
import stage

# Name: parent, head, tail. Metres, from the shoulder; the arm lies in the plane of the wall, which faces -Y.
BONES = {
    "Upper": ("", (0.0, 0.0, 0.0), (0.10, 0.0, -0.32)),
    "Fore": ("Upper", (0.10, 0.0, -0.32), (0.355, 0.0, -0.475)),
    "Hand": ("Fore", (0.355, 0.0, -0.475), (0.58, 0.0, -0.53)),
}
# The fingers end before the bone's tail, where the ball's centre goes.
# Place along and across the hand (m), turn from its direction (rad), half length, half width.
FINGERS = (
    (0.110, -0.030, -0.18, 0.048, 0.0115),
    (0.138, -0.0110, -0.05, 0.058, 0.0125),
    (0.139, 0.0110, 0.03, 0.057, 0.0125),
    (0.125, 0.031, 0.14, 0.051, 0.0120),
)
THUMB = (0.064, 0.048, 0.62, 0.042, 0.0135)


def build(place, name, is_ghost=False):
    """The armature object, with everything that hangs on its bones; a ghost is pale and casts no shadow."""
    rig = _build_rig(name)
    rig.location = place
    wood, dark = ("Ghost", "Dark Ghost") if is_ghost else ("Wood", "Dark Wood")
    if not is_ghost:
        _add(rig, "", dark, Vector((0.0, 0.075, 0.0)), (0.105, 0.035, 0.105))
    _add(rig, "Upper", dark, (0.0, 0.0, 0.0), (0.066, 0.060, 0.066))
    _add_limb(rig, "Upper", wood, 0.052)
    _add(rig, "Fore", dark, (0.0, 0.0, 0.0), (0.043, 0.043, 0.043))
    _add_limb(rig, "Fore", wood, 0.043)
    _add(rig, "Hand", dark, (0.0, 0.0, 0.0), (0.028, 0.028, 0.028))
    _add(rig, "Hand", wood, (0.0, 0.066, 0.0), (0.023, 0.055, 0.044))
    for along, across, turn, length, width in (*FINGERS, THUMB):
        _add(rig, "Hand", wood, (0.0, along, across), (0.012, length, width), turn)
    if is_ghost:
        for part in rig.children:
            part.visible_shadow = False
    return rig


def _build_rig(name):
    rig = stage.link(bpy.data.objects.new(name, bpy.data.armatures.new(name)))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    for bone_name, (parent, head, tail) in BONES.items():
        bone = rig.data.edit_bones.new(bone_name)
        bone.head, bone.tail = head, tail
        bone.align_roll((1.0, 0.0, 1.0))  # X comes out of the wall
        bone.parent = rig.data.edit_bones.get(parent)
        bone.use_connect = bone.parent is not None
    bpy.ops.object.mode_set(mode='OBJECT')
    return rig


def _add_limb(rig, bone, material, width):
    length = rig.data.bones[bone].length
    _add(rig, bone, material, (0.0, 0.5 * length, 0.0), (width, 0.46 * length, width))


COLORS = {
    "Wood": (figure.WOOD, 0.45),
    "Dark Wood": (figure.DARK_WOOD, 0.4),
    "Ghost": ((0.78, 0.82, 0.86, 1.0), 0.9),
    "Dark Ghost": ((0.52, 0.58, 0.64, 1.0), 0.9),
}


def _add(rig, bone, material, centre, radii, turn=0.0):
    """An ellipsoid in a bone's space, or the rig's; turn: about the bone's X axis, radians."""
    mesh = bpy.data.meshes.get("Ball " + material)
    if mesh is None:
        mesh = figure.ball("Ball " + material)
        mesh.materials.append(stage.glossy_material(material, *COLORS[material]))
    part = stage.link(bpy.data.objects.new(mesh.name, mesh))
    part.parent = rig
    matrix = Matrix.Translation(centre) @ Matrix.Rotation(turn, 4, 'X') @ Matrix.Diagonal((*radii, 1.0))
    if bone:
        part.parent_type = 'BONE'
        part.parent_bone = bone
        # A bone's children hang on its tail.
        matrix = Matrix.Translation((0.0, -rig.data.bones[bone].length, 0.0)) @ matrix
    part.matrix_parent_inverse = matrix
