"""An overgrown garden: uneven ground with stones, an old dry-stone wall, grass and mushrooms."""

import math
import random

import numpy as np

from ..places import landscape, rocks
from ..stage import materials, shapes

EXTENT = (9.0, 7.0)  # half of the ground's extent along X and Y, m
SPACING = 0.09
WALL_FACE, WALL_HIGH, WALL_HALF = -0.15, 3.1, 4.6  # m: y of the face, height, half of the length
SEED = 11
# Height in m, wavelength in m and seed of the ground's swells.
SWELLS = ((0.075, 1.9, 1), (0.020, 0.55, 2), (0.006, 0.21, 3))
# x, y, radius, height in m of the stones on the way.
STONES = (
    (-0.42, -3.62, 0.34, 0.22),
    (0.52, -3.10, 0.42, 0.30),
    (-0.55, -2.35, 0.46, 0.26),
    (0.16, -2.70, 0.22, 0.15),
    (0.46, -1.75, 0.36, 0.24),
    (-0.30, -1.42, 0.26, 0.17),
    (-0.95, -3.05, 0.30, 0.24),
    (0.95, -2.30, 0.28, 0.2),
)
MORE_STONES, TUFTS, BLADES = 60, 420, 11
MUSHROOMS = ((-1.45, -2.20, 0.30), (-1.27, -2.36, 0.20), (1.55, -1.55, 0.26), (1.38, -3.95, 0.22), (-2.3, -0.75, 0.34), (-2.12, -0.9, 0.19))
MUSHROOM = ((0.0, 0.0), (0.15, 0.02), (0.12, 0.25), (0.10, 0.55), (0.12, 0.62))
CAP = ((0.10, 0.60), (0.44, 0.56), (0.47, 0.63), (0.40, 0.80), (0.24, 0.94), (0.0, 1.0))


def height(x, y):
    """Return the height of the ground in m without its stones, at arrays x and y, (n,)."""
    return sum(size * (2.0 * landscape.fractal_noise(x, y, wave, 2, SEED + seed) - 1.0) for size, wave, seed in SWELLS)


def _ground_at(x, y):
    return float(height(np.array([x]), np.array([y]))[0])


def build(walked, plants):
    """Add ground, stones and wall to the collection `walked`, and grass and mushrooms to the collection `plants`."""
    rock = rocks.mossy("Garden Stone", (0.075, 0.074, 0.066), (0.26, 0.245, 0.21))
    shapes.link_object(walked, "Garden Ground", _ground())
    shapes.link_object(walked, "Garden Stones", _stones(rock))
    shapes.link_object(walked, "Garden Wall", _wall(rocks.mossy("Wall Stone", (0.085, 0.080, 0.072), (0.33, 0.30, 0.25))))
    shapes.link_object(plants, "Grass", _grass())
    shapes.link_object(plants, "Mushrooms", _mushrooms())


def _ground():
    x, y = (np.arange(-half, half + SPACING, SPACING) for half in EXTENT)
    columns, rows = len(x), len(y)
    x, y = (part.ravel() for part in np.meshgrid(x, y - 3.0))
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    builder = shapes.MeshBuilder()
    builder.add((np.column_stack((x, y, height(x, y))), np.column_stack((corner, corner + 1, corner + columns + 1, corner + columns))))
    return builder.build("Garden Ground", [_earth()])


def _stones(rock):
    builder, chance = shapes.MeshBuilder(), random.Random(SEED)
    for index, (x, y, radius, high) in enumerate(STONES):
        builder.add(rocks.boulder((x, y, _ground_at(x, y)), radius, high, chance, index))
    for index in range(MORE_STONES):
        x, y = chance.uniform(-5.0, 5.0), chance.uniform(-6.5, WALL_FACE - 0.4)
        if abs(x) > 1.1:
            radius = chance.uniform(0.05, 0.34)
            builder.add(rocks.boulder((x, y, _ground_at(x, y)), radius, radius * chance.uniform(0.5, 0.9), chance, 50 + index))
    return builder.build("Garden Stones", [rock])


def _wall(rock):
    """Make the wall: courses of rounded blocks, some a little in front of others. rock: material."""
    builder, chance = shapes.MeshBuilder(), random.Random(SEED + 1)
    base, course = -0.15, 0
    while base < WALL_HIGH:
        high = chance.uniform(0.20, 0.30)
        x = -WALL_HALF - chance.uniform(0.0, 0.3)
        while x < WALL_HALF:
            wide = chance.uniform(0.26, 0.62)
            front = WALL_FACE + chance.uniform(-0.035, 0.035)
            builder.add(_block((x + 0.5 * wide, front + 0.3, base + 0.5 * high), (wide, 0.6, high), chance, course))
            x += wide - 0.005
            course += 1
        base += high - 0.006
    return builder.build("Garden Wall", [rock])


def _block(middle, size, chance, seed):
    vertices, faces = shapes.sphere(1.0, segments=28, rings=18)
    # The poles of the spheres face along the wall, and the next blocks hide them.
    vertices, faces = np.asarray(vertices)[:, (1, 0, 2)], np.asarray(faces)[:, ::-1]
    rounded = np.sign(vertices) * np.abs(vertices) ** 0.42
    rounded /= np.maximum(np.abs(rounded).max(axis=0), 1e-9)
    rounded = rounded * (1.0 + 0.06 * rocks.lumps(3.1 * vertices, seed))[:, None]
    tilt = chance.uniform(-0.03, 0.03)
    x, y, z = (0.5 * rounded * size).T
    return np.column_stack((x * math.cos(tilt) - z * math.sin(tilt), y, x * math.sin(tilt) + z * math.cos(tilt))) + middle, faces


def _grass():
    """Make tufts of bent blades of grass, sparse on the way and dense at its sides and along the wall."""
    builder, chance = shapes.MeshBuilder(), random.Random(SEED + 2)
    for _ in range(TUFTS):
        x = chance.gauss(0.0, 2.3)
        y = WALL_FACE - 0.12 - abs(chance.gauss(0.0, 0.10)) if chance.random() < 0.22 else chance.uniform(-6.6, -0.3)
        if abs(x) < 0.85 and y < -0.35 and chance.random() < 0.9:
            continue
        ground = _ground_at(x, y)
        for _ in range(BLADES):
            builder.add(rocks.blade((x + chance.gauss(0.0, 0.05), y + chance.gauss(0.0, 0.04), ground - 0.01), chance))
    return builder.build("Grass", [rocks.grass("Garden Grass")])


def _mushrooms():
    builder = shapes.MeshBuilder()
    for index, (x, y, high) in enumerate(MUSHROOMS):
        ground = _ground_at(x, y)
        for profile, slot in ((MUSHROOM, 0), (CAP, 1)):
            vertices, faces = shapes.lathe(shapes.smooth_profile_points(profile, 14), 28)
            upright = np.asarray(vertices)[:, (0, 2, 1)] * (high, -high, high)
            bent = upright + np.column_stack((0.12 * upright[:, 2] ** 2 / high * math.cos(index), 0.0 * upright[:, 0], 0.0 * upright[:, 0]))
            builder.add((bent + (x, y, ground - 0.01), faces), slot)
    return builder.build(
        "Mushrooms",
        [
            materials.principled("Mushroom Stalk", color=(0.62, 0.52, 0.38), roughness=0.75),
            materials.principled("Mushroom Cap", color=(0.36, 0.045, 0.022), roughness=0.32),
        ],
    )


def _earth():
    material, shader, output = materials.new_material("Garden Earth")
    place = shader.add("ShaderNodeTexCoord").outputs["Object"]
    grain = shader.noise(place, 11.0, detail=8.0)
    patches = shader.noise(place, 0.8, detail=5.0)
    tint = shader.ramp(
        shader.math("ADD", shader.math("MULTIPLY", grain, 0.5), shader.math("MULTIPLY", patches, 0.5)),
        ((0.36, (0.030, 0.022, 0.013)), (0.50, (0.105, 0.072, 0.040)), (0.58, (0.060, 0.078, 0.018)), (0.68, (0.085, 0.135, 0.026))),
    )
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=tint, roughness=0.95, specular=0.15)
    bump = shader.add("ShaderNodeBump", {"Height": grain, "Strength": 0.6, "Distance": 0.03})
    materials.set_principled(shader, node, normal=bump.outputs[0])
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (0.10, 0.08, 0.04, 1.0)
    return material
