"""The land of the village: meadows that rise to a wood, hills behind the wood, and materials that turn white."""

import itertools
import math

import numpy as np

from ..places import landscape
from ..stage import materials, shapes

SEED = 77
HALF = 90.0  # m, half the side of the land
GRID = 260
VILLAGE = (-17.0, 17.0), (-9.0, 32.0)  # range of x and y in m in which the snow cover is computed; beyond it the material turns white
STEP = 0.5  # distance between vertices of the village's ground, m
PLACES = ((4.6, 12.2), (-6.4, 13.6), (-0.9, 24.5), (10.6, 21.0), (-11.8, 22.5))  # x and y of places at which the ground is level
PATH = ((0.8, -12.0), (0.4, 0.0), (0.6, 8.0), (-0.9, 15.0), (-0.9, 20.0))  # points of the trodden path through the village
WHITE = (0.86, 0.90, 0.97)
GRASS = (0.060, 0.050, 0.030), (0.125, 0.105, 0.062)
BARE, SNOWY = 1.6, 0.35  # least upward slope of white surfaces, at the start and the end of the scene


def height(x, y):
    """Return the height of the ground in metres at arrays of x and y."""
    rolling = 1.7 * (landscape.fractal_noise(x, y, 16.0, 4, SEED) - 0.5)
    rise = 7.0 * landscape.smoothstep(np.asarray(y, float), 20.0, 70.0) + 0.10 * np.maximum(np.abs(x) - 12.0, 0.0)
    hills = 16.0 * landscape.smoothstep(np.hypot(x, y), 60.0, 90.0) * landscape.fractal_noise(x, y, 45.0, 3, SEED + 9)
    far = np.min([np.hypot(np.asarray(x, float) - at, np.asarray(y, float) - up) for at, up in PLACES], axis=0)
    level = landscape.smoothstep(far, 3.2, 8.0)
    return level * rolling + rise + hills - 0.16 * trodden(x, y)


def trodden(x, y, path=PATH):
    """Return the share of the trodden path at places, from 0 to 1."""
    nearest = np.full(np.broadcast(x, y).shape, np.inf)
    for (ax, ay), (bx, by) in itertools.pairwise(path):
        along = np.clip(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2), 0.0, 1.0)
        nearest = np.minimum(nearest, np.hypot(x - ax - along * (bx - ax), y - ay - along * (by - ay)))
    return 1.0 - landscape.smoothstep(nearest, 0.25, 0.75)


def build(collection, covered, white):
    """Add the far land, and the village's ground to the collection `covered`, on which snow lies. white: result of whitening()."""
    add_far_land(collection, mottled("Far Meadow", *GRASS, 0.8, white))
    add_ground(covered, mottled("Meadow", *GRASS, 0.8))


def add_far_land(collection, material):
    """Add the land around the village. It lies a little below the village's ground, which is finer."""
    axis = np.linspace(-1.0, 1.0, GRID)
    warped = HALF * (0.25 * axis + 0.75 * axis**3)
    x, y = np.meshgrid(warped, warped + 8.0)
    (left, right), (front, back) = VILLAGE
    inside = np.minimum(np.minimum(x - left, right - x), np.minimum(y - front, back - y))
    z = height(x, y) - 0.6 * landscape.smoothstep(inside, 0.0, 2.0)
    land = shapes.MeshBuilder()
    land.add(shapes.loft(np.stack((x, y, z), axis=-1), closed=False))
    shapes.link_object(collection, "Land", land.build("Land", [material]))


def add_ground(collection, material, height_at=height, step=STEP):
    """Add the ground of the village. height_at(x, y): function that returns the height of the ground in m. step: between vertices, m."""
    (left, right), (front, back) = VILLAGE
    x, y = np.meshgrid(np.arange(left, right + 0.5 * step, step), np.arange(front, back + 0.5 * step, step))
    ground = shapes.MeshBuilder()
    ground.add(shapes.loft(np.stack((x, y, height_at(x, y)), axis=-1), closed=False))
    return shapes.link_object(collection, "Village Ground", ground.build("Village Ground", [material]))


def whitening(scene, bare=BARE, snowy=SNOWY):
    """Make a node group with the least upward slope of white surfaces of the far land, which decreases during the scene."""
    shader, _, result = materials.new_group("Evening Whitening", [], [("Least", "NodeSocketFloat")])
    value = shader.add("ShaderNodeValue").outputs[0]
    for frame, least in ((scene.frame_start, bare), (scene.frame_end, snowy)):
        value.default_value = least
        value.keyframe_insert("default_value", frame=frame)
    shader.feed(result.inputs[0], value)
    return shader.tree


def mottled(name, dark, light, scale, white=None):
    """Make a matt material of two colours in patches of about 1 / scale m. white: result of whitening(); None if it never turns white."""
    material, shader, output = materials.new_material(name)
    position = shader.add("ShaderNodeTexCoord").outputs["Object"]
    color = shader.ramp(shader.noise(position, scale, detail=6.0), ((0.35, dark), (0.68, light)))
    if white is not None:
        geometry = shader.add("ShaderNodeNewGeometry")
        up = shader.add("ShaderNodeSeparateXYZ", {0: geometry.outputs["Normal"]}).outputs[2]
        grain = shader.math("MULTIPLY", shader.math("SUBTRACT", shader.noise(geometry.outputs["Position"], 1.5), 0.5), 1.2)
        more = shader.math("SUBTRACT", shader.math("ADD", up, grain), shader.group(white, {}).outputs[0])
        color = shader.mix(shader.math("MULTIPLY", more, 5.0, clamp=True), color, (*WHITE, 1.0))
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=color, roughness=0.85, specular=0.15)
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (*light, 1.0)
    return material


def ground_at(x, y):
    """Return the height of the ground in metres at one place."""
    return float(height(np.array([x], float), np.array([y], float))[0])


def turned(vertices, angle):
    """Rotate vertices, (n, 3), about Z by an angle in radians."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.asarray(vertices) @ np.array(((cosine, sine, 0.0), (-sine, cosine, 0.0), (0.0, 0.0, 1.0)))
