"""A wooden figure with spine, neck, head and eyes, on a stand: what the pictures of Look At turn."""

import math

import bpy
from mathutils import Matrix, Vector

import stage

# Name: parent, head, tail. Metres; the figure faces -Y.
BONES = {
    "Hips": ("", (0.0, 0.0, 0.56), (0.0, 0.0, 0.68)),
    "Spine": ("Hips", (0.0, 0.0, 0.68), (0.0, 0.0, 0.81)),
    "Waist": ("Spine", (0.0, 0.0, 0.81), (0.0, 0.0, 0.95)),
    "Chest": ("Waist", (0.0, 0.0, 0.95), (0.0, 0.0, 1.17)),
    "Neck": ("Chest", (0.0, 0.0, 1.17), (0.0, 0.0, 1.435)),
    "Head": ("Neck", (0.0, 0.0, 1.435), (0.0, 0.0, 1.56)),
    "Eye.L": ("Head", (0.052, -0.092, 1.435), (0.052, -0.15, 1.435)),
    "Eye.R": ("Head", (-0.052, -0.092, 1.435), (-0.052, -0.15, 1.435)),
}
WOOD = (0.62, 0.40, 0.20, 1.0)
DARK_WOOD = (0.26, 0.13, 0.06, 1.0)
BODY, HEAD, EYES = (0.05, 0.25, 0.62, 1.0), (0.85, 0.26, 0.03, 1.0), (0.02, 0.42, 0.20, 1.0)
"""Colours of buttons, nose and irises, and of what the pictures say about body, head and eyes."""
SEGMENTS, RINGS = 40, 24


def build(place=(0.0, 0.0, 0.0), name="Figure"):
    """The armature object, with everything that hangs on its bones."""
    rig = _build_rig(name)
    rig.location = place
    wood = _material("Wood", WOOD, 0.45)
    dark = _material("Dark Wood", DARK_WOOD, 0.4)
    button = _material("Button", BODY, 0.3)
    _add_stand(rig, dark)
    _add(rig, "Hips", wood, (0.0, 0.0, 0.6), (0.150, 0.105, 0.085))
    for bone, z, size in (
        ("Spine", 0.725, (0.118, 0.086, 0.082)),
        ("Waist", 0.855, (0.128, 0.092, 0.088)),
        ("Chest", 1.045, (0.182, 0.118, 0.150)),
    ):
        _add(rig, bone, wood, (0.0, 0.0, z), size)
        _add(rig, bone, button, (0.0, -size[1] - 0.002, z), (0.019, 0.010, 0.019))
    _add(rig, "Chest", button, (0.0, -0.104, 1.125), (0.019, 0.012, 0.019))
    for side in (-1.0, 1.0):
        _add_arm(rig, side, wood, dark)
    _add(rig, "Neck", dark, (0.0, 0.0, 1.22), (0.048, 0.048, 0.075))
    _add_head(rig, wood, dark)
    return rig


def _build_rig(name):
    rig = stage.link(bpy.data.objects.new(name, bpy.data.armatures.new(name)))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    for bone_name, (parent, head, tail) in BONES.items():
        bone = rig.data.edit_bones.new(bone_name)
        bone.head, bone.tail = head, tail
        bone.parent = rig.data.edit_bones.get(parent)
    bpy.ops.object.mode_set(mode='OBJECT')
    rig.hide_render = True
    return rig


def _add_stand(rig, dark):
    mesh = bpy.data.meshes.new("Stand")
    profile = [(0.0, 0.0), (0.26, 0.0), (0.27, 0.012), (0.26, 0.035), (0.06, 0.05), (0.022, 0.09), (0.022, 0.56)]
    vertices, faces = [], []
    for radius, z in profile:
        for step in range(SEGMENTS):
            angle = math.tau * step / SEGMENTS
            vertices.append((radius * math.cos(angle), radius * math.sin(angle), z))
    for ring in range(len(profile) - 1):
        for step in range(SEGMENTS):
            after = (step + 1) % SEGMENTS
            low, high = ring * SEGMENTS, (ring + 1) * SEGMENTS
            faces.append((low + step, low + after, high + after, high + step))
    mesh.from_pydata(vertices, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    mesh.materials.append(dark)
    _attach(rig, "", mesh, Matrix())


def _add_arm(rig, side, wood, dark):
    shoulder = Vector((side * 0.205, 0.0, 1.125))
    elbow = Vector((side * 0.262, 0.012, 0.875))
    wrist = Vector((side * 0.285, -0.035, 0.665))
    _add(rig, "Chest", dark, shoulder, (0.050, 0.050, 0.050))
    _add(rig, "Chest", wood, 0.5 * (shoulder + elbow), (0.043, 0.043, 0.140), elbow - shoulder)
    _add(rig, "Chest", dark, elbow, (0.034, 0.034, 0.034))
    _add(rig, "Chest", wood, 0.5 * (elbow + wrist), (0.035, 0.035, 0.120), wrist - elbow)
    _add(rig, "Chest", dark, wrist, (0.022, 0.022, 0.022))
    _add(rig, "Chest", wood, wrist + Vector((side * 0.004, -0.012, -0.062)), (0.024, 0.034, 0.060))


def _add_head(rig, wood, dark):
    _add(rig, "Head", wood, (0.0, 0.0, 1.415), (0.118, 0.128, 0.150))
    _add(rig, "Head", _material("Nose", HEAD, 0.35), (0.0, -0.140, 1.382), (0.021, 0.036, 0.021))
    for side, bone in ((1.0, "Eye.L"), (-1.0, "Eye.R")):
        _add(rig, "Head", dark, (side * 0.119, 0.006, 1.405), (0.014, 0.028, 0.036))
        centre = Vector(BONES[bone][1])
        _add(rig, bone, _material("White", (0.92, 0.92, 0.90, 1.0), 0.2), centre, (0.043, 0.043, 0.043))
        _add(rig, bone, _material("Iris", EYES, 0.15), centre + Vector((0.0, -0.0335, 0.0)), (0.0245, 0.0125, 0.0245))
        pupil = centre + Vector((0.0, -0.0400, 0.0))
        _add(rig, bone, _material("Pupil", stage.INK, 0.1), pupil, (0.0125, 0.0085, 0.0125))
        brow = centre + Vector((side * 0.004, -0.026, 0.056))
        _add(rig, "Head", dark, brow, (0.032, 0.009, 0.008), tilt=side * 0.12)


def _material(name, color, roughness):
    return bpy.data.materials.get(name) or stage.glossy_material(name, color, roughness)


def _add(rig, bone, material, centre, radii, along=None, tilt=0.0):
    """An ellipsoid that moves with a bone. along: where its Z axis points; tilt: turn about Y, radians."""
    mesh = bpy.data.meshes.get("Ball " + material.name)
    if mesh is None:
        mesh = ball("Ball " + material.name)
        mesh.materials.append(material)
    turn = Vector(along).to_track_quat('Z', 'Y').to_matrix().to_4x4() if along else Matrix.Rotation(tilt, 4, 'Y')
    _attach(rig, bone, mesh, Matrix.Translation(centre) @ turn @ Matrix.Diagonal((*radii, 1.0)))


def ball(name):
    """A new mesh of a ball of radius 1."""
    vertices, faces = [], []
    for ring in range(RINGS + 1):
        polar = math.pi * ring / RINGS
        for step in range(SEGMENTS):
            angle = math.tau * step / SEGMENTS
            vertices.append((math.sin(polar) * math.cos(angle), math.sin(polar) * math.sin(angle), math.cos(polar)))
    for ring in range(RINGS):
        for step in range(SEGMENTS):
            after = (step + 1) % SEGMENTS
            low, high = ring * SEGMENTS, (ring + 1) * SEGMENTS
            faces.append((low + step, high + step, high + after, low + after))
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    return mesh


def _attach(rig, bone, mesh, matrix):
    """Hang a mesh, placed in the rig's space, on a bone, or on the rig itself."""
    obj = stage.link(bpy.data.objects.new(mesh.name, mesh))
    obj.parent = rig
    if bone:
        obj.parent_type = 'BONE'
        obj.parent_bone = bone
        # A bone's children hang on its tail.
        rest = rig.data.bones[bone].matrix_local
        matrix = (rest @ Matrix.Translation((0.0, rig.data.bones[bone].length, 0.0))).inverted() @ matrix
    obj.matrix_parent_inverse = matrix
