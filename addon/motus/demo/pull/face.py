"""Suzanne in clay: the mesh is pulled into a caricature, and pins (pulls with a strength that can be keyed) animate the face."""

import math

import bmesh
import bpy
import numpy as np

from ..stage import materials, shapes
from . import face_motion

PLACE, TURN = (-1.80, -0.30, 1.52), math.radians(27.0)  # of the head, which looks towards the tray
LEVELS = 3  # of subdivision

# Pulls that change the mesh permanently: place in Suzanne's space, radius, displacement, falloff, kind of distance, whether mirrored.
PULLS = (
    ((0.0, 0.15, 1.00), 1.25, (0.0, 0.08, 0.22), "SMOOTH", "STRAIGHT", False),  # a higher skull
    ((1.30, 0.28, 0.30), 0.75, (0.26, -0.06, 0.20), "SMOOTH", "SURFACE", True),  # ears like sails
    ((0.0, -0.84, -0.22), 0.34, (0.0, -0.34, 0.04), "SPHERE", "SURFACE", False),  # a nose
    ((0.14, -1.06, -0.20), 0.34, (0.13, 0.0, 0.03), "SMOOTH", "SURFACE", True),  # a broad one
    ((0.30, -0.66, -0.62), 0.50, (0.20, 0.0, 0.0), "SMOOTH", "STRAIGHT", True),  # a wide muzzle
    ((0.0, -0.70, -0.94), 0.42, (0.0, -0.12, -0.06), "SMOOTH", "STRAIGHT", False),  # a chin
    ((0.09, -0.76, -0.78), 0.26, (0.17, 0.05, 0.07), "SMOOTH", "SURFACE", True),  # a grin
)
# Of each pin: name, place, radius, displacement at strength 1, falloff, kind of distance, whether mirrored.
PINS = (
    ("Squash", (0.0, 0.20, 1.20), 2.50, (0.0, 0.0, -0.52), "GAUSSIAN", "STRAIGHT", False),
    ("Bulge", (1.00, 0.05, -0.05), 1.00, (0.22, 0.0, -0.04), "SMOOTH", "STRAIGHT", True),
    ("Brow", (0.36, -0.76, 0.66), 0.48, (0.02, -0.02, 0.27), "SMOOTH", "SURFACE", False),
    ("Frown", (0.13, -0.78, 0.50), 0.36, (-0.03, -0.06, -0.20), "SMOOTH", "SURFACE", True),
    ("Cheeks", (0.52, -0.42, -0.34), 0.52, (0.30, -0.24, -0.02), "SPHERE", "SURFACE", True),
    ("Nose", (0.0, -1.20, -0.16), 0.62, (0.0, -0.66, 0.22), "GAUSSIAN", "SURFACE", False),
    ("Pout", (0.0, -0.82, -0.76), 0.36, (0.0, -0.30, 0.03), "SMOOTH", "SURFACE", False),
    ("Smile", (0.30, -0.72, -0.72), 0.34, (0.12, 0.05, 0.19), "SMOOTH", "SURFACE", True),
    ("Ears", (1.50, 0.20, 0.55), 0.90, (-0.10, 0.06, -0.50), "SMOOTH", "SURFACE", True),
)

CLAY, FACE, LIPS = (0.235, 0.066, 0.026), (0.72, 0.335, 0.165), (0.46, 0.105, 0.080)
EYE_X, EYE_Z = 0.345, 0.255  # positions of the eyes in Suzanne's space
GAZE = (0.060, -0.015)  # offset of the pupils to the side and up, so that they look at the landscape
IRIS, PUPIL = 0.118, 0.062
POST = (  # profile: radius, height below the head's middle
    (0.004, -0.40),
    (0.34, -0.42),
    (0.37, -0.48),
    (0.30, -0.56),
    (0.21, -0.72),
    (0.17, -0.90),
    (0.19, -1.06),
    (0.30, -1.17),
    (0.52, -1.24),
    (0.66, -1.30),
    (0.72, -1.36),
    (0.72, -1.44),
    (0.66, -1.52),
    (0.004, -1.52),
)


def build(context, collection):
    """Build the head on its post, with its pulls and pins. Returns the head."""
    head = shapes.link_object(collection, "Suzanne", _mesh(context, collection))
    head.location, head.rotation_euler.z = PLACE, TURN
    post = shapes.link_object(collection, "Post", _post_mesh())
    post.location, post.rotation_euler.z = PLACE, TURN
    context.view_layer.objects.active = head
    context.view_layer.update()
    for place, radius, way, falloff, distance, is_mirrored in PULLS:
        _check(
            bpy.ops.motus.pick_pull(
                object=head.name,
                location=place,
                radius=radius,
                displacement=way,
                falloff=falloff,
                distance=distance,
                unit="LOCAL",
                accumulate=True,
                mirror={"X"} if is_mirrored else set(),
            ),
            head,
        )
    for name, place, radius, way, falloff, distance, is_mirrored in PINS:
        _check(
            bpy.ops.motus.pin_add(
                object=head.name,
                name=name,
                location=place,
                radius=radius,
                displacement=way,
                falloff=falloff,
                distance=distance,
                unit="LOCAL",
                strength=0.0,
                mirror={"X"} if is_mirrored else set(),
            ),
            head,
        )
    _add_other_brow(head)
    face_motion.key(head.motus.pull.pins)
    return head


def _add_other_brow(head):
    """Mirror the pin of the brow, so that the second brow has a strength of its own."""
    pins = head.motus.pull.pins
    _check(bpy.ops.motus.pin_mirror(object=head.name, index=pins.find("Brow"), axis="X"), head)
    pins[-1].name = "Other Brow"


def _check(result, head):
    if result != {"FINISHED"}:
        raise RuntimeError(f"{head.name} could not be pulled")


# --- the head --------------------------------------------------------------------------------------------------------


def _mesh(context, collection):
    """Make the mesh of Suzanne, subdivided, with the attributes that its material needs."""
    rough = bpy.data.meshes.new("Suzanne")
    builder = bmesh.new()
    bmesh.ops.create_monkey(builder)
    builder.to_mesh(rough)
    builder.free()
    model = shapes.link_object(collection, "Rough Suzanne", rough)
    modifier = model.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = LEVELS
    depsgraph = context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(model.evaluated_get(depsgraph))
    bpy.data.objects.remove(model)
    bpy.data.meshes.remove(rough)
    mesh.name = "Suzanne"
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    _paint(mesh)
    return mesh


def _paint(mesh):
    """Store the unpulled positions as the attribute "rest", and give the eyes' faces the second material."""
    count = len(mesh.vertices)
    places = np.empty(3 * count, np.float32)
    mesh.vertices.foreach_get("co", places)
    mesh.attributes.new("rest", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", places)
    normals = np.empty(3 * count, np.float32)
    mesh.vertices.foreach_get("normal", normals)
    mesh.attributes.new("rest_normal", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", normals)
    mesh.materials.clear()
    mesh.materials.append(_clay())
    mesh.materials.append(_eye())
    part = _parts(mesh)
    sizes = np.bincount(part)
    is_eye = sizes[part] < 0.25 * count
    first = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("loop_start", first)
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    mesh.polygons.foreach_set("material_index", is_eye[corners[first]].astype(np.int32))
    mesh.update()


def _parts(mesh):
    """Return an array with the number of the connected piece of the mesh to which each vertex belongs."""
    edges = np.empty(2 * len(mesh.edges), np.int32)
    mesh.edges.foreach_get("vertices", edges)
    one, other = edges.reshape(-1, 2).T
    part = np.arange(len(mesh.vertices))
    while True:
        least = np.minimum(part[one], part[other])
        before = part.copy()
        np.minimum.at(part, one, least)
        np.minimum.at(part, other, least)
        part = part[part]
        if np.array_equal(part, before):
            return part


def _clay():
    """Make the material of two clays and lips, whose finger marks move with the surface."""
    material, shader, output = materials.new_material("Clay")
    rest = shader.add("ShaderNodeAttribute", attribute_name="rest").outputs["Vector"]
    normal = shader.add("ShaderNodeAttribute", attribute_name="rest_normal").outputs["Vector"]
    apart = shader.add("ShaderNodeVectorMath", {0: rest}, operation="ABSOLUTE").outputs[0]
    ahead = shader.math("MULTIPLY", shader.add("ShaderNodeSeparateXYZ", {0: normal}).outputs[1], -1.0)
    is_ahead = shader.math("MULTIPLY", shader.math("ADD", ahead, 0.05), 9.0, clamp=True)
    eyes, muzzle, ears = (
        _ellipse(shader, apart, rest, *patch)
        for patch in (((0.33, 0.27), (0.44, 0.44)), ((0.0, -0.54), (0.52, 0.60)), ((1.13, 0.24), (0.24, 0.24)))
    )
    # The upper side of the nose belongs to the muzzle; the brows are left to the darker clay.
    is_muzzle = shader.math(
        "MULTIPLY",
        _inside(shader, muzzle, rest),
        shader.math(
            "MULTIPLY", shader.math("SUBTRACT", -0.36, shader.add("ShaderNodeSeparateXYZ", {0: rest}).outputs[1]), 30.0, clamp=True
        ),
    )
    is_patch = shader.math("MULTIPLY", _inside(shader, shader.math("MINIMUM", eyes, ears), rest), is_ahead)
    color = shader.mix(shader.math("MAXIMUM", is_patch, is_muzzle), (*CLAY, 1.0), (*FACE, 1.0))
    mouth = shader.ramp(_ellipse(shader, apart, rest, (0.0, -0.80), (0.19, 0.105)), ((0.80, (1.0,) * 3), (1.0, (0.0,) * 3)))
    color = shader.mix(shader.math("MULTIPLY", mouth, is_ahead), color, (*LIPS, 1.0))
    grain = shader.ramp(shader.noise(rest, 4.0, detail=6.0), ((0.30, (0.82,) * 3), (0.70, (1.10,) * 3)))
    marks = shader.math("ADD", shader.noise(rest, 6.0, detail=2.0), shader.math("MULTIPLY", shader.noise(rest, 34.0, detail=4.0), 0.22))
    bump = shader.add("ShaderNodeBump", {"Height": marks, "Strength": 0.22, "Distance": 0.08})
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(
        shader, node, color=shader.mix(1.0, color, grain, blend="MULTIPLY"), roughness=0.48, specular=0.38, normal=bump.outputs[0]
    )
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (*CLAY, 1.0)
    return material


def _inside(shader, distance, rest):
    """Return a socket that is 1 at distances below 1 and 0 beyond, with an irregular edge as if drawn by hand."""
    wavy = shader.math("ADD", distance, shader.math("MULTIPLY", shader.math("SUBTRACT", shader.noise(rest, 7.0), 0.5), 0.12))
    return shader.ramp(wavy, ((0.96, (1.0,) * 3), (1.0, (0.0,) * 3)))


def _ellipse(shader, apart, rest, middle, radii):
    """Return a socket with the distance from the middle of an ellipse in the face's XZ plane, 1 at its edge; symmetric in X."""
    x = shader.add("ShaderNodeSeparateXYZ", {0: apart}).outputs[0]
    z = shader.add("ShaderNodeSeparateXYZ", {0: rest}).outputs[2]
    parts = [
        shader.math("POWER", shader.math("ABSOLUTE", shader.math("DIVIDE", shader.math("SUBTRACT", value, centre), radius)), 2.0)
        for value, centre, radius in zip((x, z), middle, radii)
    ]
    return shader.math("SQRT", shader.math("ADD", *parts))


def _eye():
    """Make the material of the eyes: white, with iris and pupil at the offset GAZE."""
    material, shader, output = materials.new_material("Eye")
    rest = shader.add("ShaderNodeAttribute", attribute_name="rest").outputs["Vector"]
    parts = shader.add("ShaderNodeSeparateXYZ", {0: rest}).outputs
    side = shader.math("SIGN", parts[0])
    aside = shader.math("SUBTRACT", shader.math("SUBTRACT", parts[0], shader.math("MULTIPLY", side, EYE_X)), GAZE[0])
    upward = shader.math("SUBTRACT", parts[2], EYE_Z + GAZE[1])
    away = shader.math("SQRT", shader.math("ADD", shader.math("MULTIPLY", aside, aside), shader.math("MULTIPLY", upward, upward)))
    color = shader.ramp(
        shader.math("DIVIDE", away, 0.25),
        (
            (PUPIL / 0.25 - 0.02, (0.006, 0.005, 0.005)),
            (PUPIL / 0.25 + 0.02, (0.16, 0.075, 0.020)),
            (IRIS / 0.25 - 0.03, (0.36, 0.19, 0.050)),
            (IRIS / 0.25 + 0.02, (0.82, 0.80, 0.75)),
        ),
        interpolation="LINEAR",
    )
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=color, roughness=0.12, specular=0.6, coat=0.6, coat_roughness=0.05)
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (0.82, 0.80, 0.75, 1.0)
    return material


def _post_mesh():
    builder = shapes.MeshBuilder()
    part = shapes.lathe(shapes.smooth_profile_points(POST, 90), 64)
    builder.add(shapes.upright(part, (0.0, 0.22, 0.0)))
    return builder.build(
        "Post", [materials.wood("Post Walnut", (0.155, 0.062, 0.030), (0.085, 0.031, 0.015), (7.0, 7.0, 0.9), roughness=0.30)]
    )
