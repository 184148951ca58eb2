"""The mesh of the dog: a soft body with a coat in three colours, and eyes, nose, collar and ears."""

import numpy as np

from ..places import landscape
from ..stage import bones, materials, shapes
from ..stage.soft_shapes import Cone, SoftBody
from . import dog_bones

COAT, DARK, WHITE, COLLAR, BRASS, TONGUE, ROPE = range(7)
SHARPNESS, SKIN_SHARPNESS = 55.0, 42.0  # 1/m
STEP = 0.0115  # m
TAIL_RADII = (0.034, 0.017)  # m, at its root and at its tip
MOUTH = (
    (0.001, 0.565, 0.603),
    (0.004, 0.553, 0.583),
    (0.026, 0.535, 0.570),
    (0.052, 0.490, 0.571),
    (0.078, 0.432, 0.590),
    (0.086, 0.412, 0.606),
)
TAN, SADDLE, CREAM, EAR = (0.42, 0.17, 0.052), (0.035, 0.024, 0.020), (0.80, 0.72, 0.60), (0.26, 0.105, 0.032)


def _both(start, end, radii, owner, endings=("", "")):
    """Return a cone on the right, at +X, and one on the left. endings: what the owner's name ends with on the right and on the left."""
    found = []
    for side, ending in zip((1.0, -1.0), endings):
        (x, y, z), (ahead_x, ahead_y, ahead_z) = start, end
        found.append(Cone((side * x, y, z), (side * ahead_x, ahead_y, ahead_z), radii[0], radii[1], owner + ending))
    return found


def _cones():
    """List the cones of the dog: trunk, neck and head, legs, and tail."""
    body, neck, head = dog_bones.BODY, dog_bones.NECK, dog_bones.HEAD
    return [
        Cone((0.0, 0.135, 0.395), (0.0, 0.02, 0.395), 0.128, 0.118, body),
        Cone((0.0, 0.02, 0.395), (0.0, -0.19, 0.415), 0.112, 0.108, body),
        Cone((0.0, 0.185, 0.375), (0.0, 0.16, 0.41), 0.085, 0.10, body),
        Cone((0.0, 0.17, 0.45), (0.0, 0.295, 0.60), 0.088, 0.078, neck),
        Cone((0.0, 0.325, 0.665), (0.0, 0.345, 0.655), 0.108, 0.104, head),
        Cone((0.0, 0.385, 0.675), (0.0, 0.40, 0.66), 0.062, 0.060, head),
        Cone((0.0, 0.42, 0.612), (0.0, 0.515, 0.607), 0.062, 0.046, head),
        Cone((0.0, 0.40, 0.575), (0.0, 0.480, 0.566), 0.048, 0.032, head),
        *_both((0.048, 0.375, 0.610), (0.030, 0.480, 0.592), (0.062, 0.036), head),
        *_leg(" 1", dog_bones.FORELEG, (0.072, 0.145, 0.375), (0.075, 0.046), (0.044, 0.036)),
        *_leg(" 2", dog_bones.HIND_LEG, (0.066, -0.195, 0.375), (0.088, 0.054), (0.048, 0.032)),
        *_tail(),
    ]


def _leg(pair, places, top, upper, lower):
    """List the cones of a pair of legs. top: place inside the trunk. upper, lower: radii of the two parts."""
    sides = f"{pair}.R", f"{pair}.L"
    _, knee, ankle = places
    found = _both(top, knee, upper, dog_bones.UPPER, sides) + _both(knee, ankle, lower, dog_bones.LOWER, sides)
    x, y, _ = ankle
    for toe in (-0.020, 0.0, 0.020):
        ahead = x + 1.25 * toe, y + 0.062 - 0.5 * abs(toe), 0.026
        found += _both((x + toe, y + 0.010, 0.040), ahead, (0.034, 0.026), dog_bones.FOOT, sides)
    return found


def _tail():
    places = [tuple(place) for place in bones.along(dog_bones.TAIL_WAY, dog_bones.TAIL_BONES + 1)]
    radii = np.linspace(*TAIL_RADII, dog_bones.TAIL_BONES + 1)
    row = zip(places, places[1:], radii, radii[1:], bones.names(dog_bones.TAIL, dog_bones.TAIL_BONES))
    return [Cone(*dog_bones.WAG_BONE, 0.046, radii[0], dog_bones.WAG), *(Cone(*values) for values in row)]


def build(collection, rig, leash):
    """Make the dog's mesh object with its leash, moved by the rig. leash: places of the leash's bones in rest pose, (count + 1, 3)."""
    soft, skin = SoftBody(_cones(), SHARPNESS), bones.Skin()
    vertices, quads = soft.surface(STEP)
    skin.add((vertices, quads), COAT, soft.shares(vertices, SKIN_SHARPNESS))
    coat = np.concatenate([vertices, *(_add_ear(skin, ear) for ear in dog_bones.EARS)])
    _add_face(skin)
    _add_mouth(skin, soft)
    _add_collar(skin)
    part, at = bones.tube(leash, 0.0105, sides=10, across=(1.0, 0.0, 0.0))
    skin.add(part, ROPE, bones.shares_along(bones.names(dog_bones.LEASH, len(leash) - 1), at))
    thing = skin.finish(collection, "Dog Skin", _materials())
    bones.carry(thing, rig)
    _paint(thing.data, coat, len(vertices))
    return thing


def _add_ear(skin, name):
    """Add a floppy ear; returns its vertices."""
    places = bones.along(dog_bones.ear_way(name), dog_bones.EAR_BONES + 1)
    share = np.linspace(0.0, 1.0, 6 * dog_bones.EAR_BONES + 1)
    width = np.interp(share, (0.0, 0.25, 0.7, 0.92, 1.0), (0.030, 0.052, 0.062, 0.042, 0.012))
    outwards = (-1.0, 0.0, 0.3) if name == dog_bones.EARS[0] else (1.0, 0.0, 0.3)
    part, at = bones.tube(places, width, sides=20, flat=0.20, across=outwards, rings=6)
    row = bones.names(name, dog_bones.EAR_BONES)
    skin.add(part, COAT, bones.shares_along(row, at))
    return part[0]


def _add_face(skin):
    head = {dog_bones.HEAD: 1.0}
    for side in (-1.0, 1.0):
        skin.add(shapes.sphere(0.0295, (side * 0.053, 0.426, 0.675), (0.9, 0.75, 1.05), 24, 18), WHITE, head)
        skin.add(shapes.sphere(0.0255, (side * 0.0555, 0.4355, 0.675), (0.92, 0.72, 1.05), 24, 18), DARK, head)
        skin.add(shapes.sphere(0.0064, (side * 0.0555 - 0.009, 0.4525, 0.686), (1.0, 0.6, 1.0), 12, 8), WHITE, head)
    skin.add(shapes.sphere(0.030, (0.0, 0.552, 0.628), (1.10, 0.72, 0.82), 28, 20), DARK, head)
    skin.add(shapes.sphere(0.030, (0.0, 0.478, 0.548), (0.85, 1.35, 0.34), 24, 16), TONGUE, head)
    skin.add(shapes.sphere(0.024, (0.0, 0.512, 0.528), (0.95, 0.45, 1.15), 24, 16), TONGUE, head)


def _add_mouth(skin, soft):
    """Add a dark line below the nose and on to both cheeks."""
    for side in (-1.0, 1.0):
        line = bones.along([(side * x, y, z) for x, y, z in MOUTH], 20)
        (vertices, faces), _ = bones.tube(soft.onto(line), 0.0032 * np.linspace(1.0, 0.6, 20), sides=8, across=(0.3, 0.1, 1.0), rings=1)
        skin.add((vertices, faces), DARK, {dog_bones.HEAD: 1.0})


def _add_collar(skin):
    """Add a collar around the neck, with a tag below."""
    ring = shapes.torus(0.094, 0.0135, 48, 12)
    ahead = np.subtract(dog_bones.NECK_BONE[1], dog_bones.NECK_BONE[0])
    ahead /= np.linalg.norm(ahead)
    down = np.cross((1.0, 0.0, 0.0), ahead)
    axes = np.stack(((1.0, 0.0, 0.0), ahead, down))
    centre = np.array((0.0, 0.225, 0.505))
    skin.add((ring[0] * (1.0, 1.5, 1.0) @ axes + centre, ring[1]), COLLAR, {dog_bones.NECK: 1.0})
    tag = shapes.lathe(((0.001, 0.004), (0.020, 0.004), (0.020, -0.004), (0.001, -0.004)), 24)
    skin.add((tag[0] + (0.0, 0.318, 0.415), tag[1]), BRASS, {dog_bones.NECK: 1.0})


def add_knot(collection, thing, place):
    """Add the windings of the leash around the bridge's post. thing: the dog's object. place: their middle, on the post's axis."""
    builder, leather = shapes.MeshBuilder(), thing.data.materials[ROPE]
    for turn in (-1, 0, 1):
        builder.add(shapes.upright(shapes.torus(0.080, 0.0115, 40, 10), np.add(place, (0.0, 0.0, 0.019 * turn))))
    shapes.link_object(collection, "Leash Windings", builder.build("Leash Windings", [leather]))


def _paint(mesh, places, smooth_skin):
    """Set the colours of the coat as a vertex attribute: a dark saddle on tan, with a cream muzzle, chest, belly, feet and tip of the tail.

    places: (n, 3) of the first vertices; the rest have no coat. smooth_skin: how many of these are not of the ears, which are darker.
    """
    x, y, z = places.T
    step = landscape.smoothstep
    wave = 0.028 * (landscape.fractal_noise(9.0 * (y + 3.0), 9.0 * (z + 0.6 * np.abs(x)) + 5.0, 1.0, 3, 5) - 0.5)
    narrow, across = np.abs(x), step(0.16 + wave - y, -0.012, 0.012)
    back = np.where(
        ((y < 0.25) & (z < 0.62)) | (y < -0.2), step(z + wave - 0.385 - 0.9 * np.maximum(y - 0.02, 0.0), -0.012, 0.012) * across, 0.0
    )
    saddle = np.where(y < -0.26, 1.0, back)
    cream = np.maximum.reduce(
        [
            step(y + wave - 0.44 - 0.5 * (z - 0.60), -0.008, 0.008),
            step(0.016 + 0.3 * wave - narrow + 0.05 * (y - 0.40), -0.006, 0.006) * step(y, 0.36, 0.38) * step(z, 0.60, 0.62),
            step(y - 0.17 + 0.45 * (0.42 - z) + wave, -0.012, 0.012) * step(0.56 - z, -0.02, 0.02) * step(0.075 - narrow, -0.02, 0.02),
            step(0.315 + wave - z, -0.01, 0.01) * step(0.08 - narrow, -0.01, 0.01),
            step(0.125 + wave - z, -0.008, 0.008),
            step(z - 0.735 + wave, -0.01, 0.01) * (y < -0.2),
        ]
    )
    color = np.ones((len(mesh.vertices), 4), np.float32)
    coat = np.asarray(TAN) + (np.asarray(SADDLE) - TAN) * saddle[:, None]
    color[: len(places), :3] = coat + (np.asarray(CREAM) - coat) * cream[:, None]
    color[smooth_skin : len(places), :3] = EAR
    layer = mesh.attributes.new("coat", "FLOAT_COLOR", "POINT")
    layer.data.foreach_set("color", color.ravel())


def _materials():
    return [
        _coat(),
        materials.principled("Dog Pupils", color=(0.016, 0.009, 0.006), roughness=0.08),
        materials.principled("Dog Eyes", color=(0.86, 0.83, 0.78), roughness=0.15),
        materials.principled("Dog Collar", color=(0.62, 0.025, 0.02), roughness=0.4),
        materials.principled("Dog Tag", color=(0.85, 0.58, 0.16), metallic=1.0, roughness=0.25),
        materials.principled("Dog Tongue", color=(0.72, 0.16, 0.17), roughness=0.35),
        materials.principled("Leash", color=(0.62, 0.025, 0.02), roughness=0.6),
    ]


def _coat():
    """Make the material of the coat, whose colour is that of the vertices."""
    material, shader, output = materials.new_material("Dog Coat")
    coat = shader.add("ShaderNodeAttribute", attribute_name="coat")
    place = shader.add("ShaderNodeTexCoord").outputs["Generated"]
    grain = shader.noise(place, 60.0, detail=4.0)
    color = shader.mix(1.0, coat.outputs["Color"], shader.ramp(grain, ((0.3, (0.80,) * 3), (0.7, (1.12,) * 3))), blend="MULTIPLY")
    bump = shader.add("ShaderNodeBump", {"Height": shader.noise(place, 90.0, detail=3.0), "Strength": 0.12, "Distance": 0.004})
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=color, roughness=0.62, specular=0.25, normal=bump.outputs[0])
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (*TAN, 1.0)
    return material
