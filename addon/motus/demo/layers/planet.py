"""The small planet that turns beneath the walking pilot: meadows, a sandy path, trees and houses."""

import math
import random

import numpy as np
from mathutils import Matrix, Vector

from ..places import woods
from ..stage import lighting, materials, shapes

RADIUS = 6.0  # m
PATH_WIDTH, PATH_RISE = 0.52, 0.006  # m
TREES, HOUSES, STONES = 210, 9, 46
CLEAR = 0.80  # m on each side of the middle of the path without trees or houses
SEED = 5
# Sky colours: (half of the sine of the elevation plus 0.5, linear rgb), with a warm band above a horizon far below the planet.
SKY_STOPS = (
    (0.36, (0.97, 0.62, 0.40)),
    (0.49, (0.98, 0.80, 0.62)),
    (0.55, (0.66, 0.77, 0.86)),
    (0.66, (0.27, 0.50, 0.80)),
    (1.0, (0.06, 0.19, 0.50)),
)
SKY_STRENGTH = 0.9
# View transform, look, exposure: the first row that this Blender version supports is used.
VIEWS = (("AgX", "AgX - Punchy", 1.35), ("Filmic", "High Contrast", 0.1), ("Filmic", "Filmic - High Contrast", 0.1))
CLOUDS = ((-7.5, 9.0, 2.3, 1.0), (-2.6, 13.0, 4.6, 1.25), (3.4, 11.0, 1.5, 0.9), (7.4, 8.5, 3.7, 1.1), (12.5, 10.0, 0.6, 1.3))
"""Position (x, y, z) and size of each cloud, in m."""
PUFFS = (
    (0.0, 0.0, 0.0, 0.62),
    (0.70, 0.1, -0.10, 0.46),
    (-0.72, 0.0, -0.12, 0.44),
    (0.34, -0.1, 0.30, 0.42),
    (-0.30, 0.1, 0.24, 0.40),
    (1.16, 0.0, -0.22, 0.26),
    (-1.14, 0.0, -0.22, 0.27),
)


def build(collection, turn):
    """Build the planet, with its top at the origin. turn: radians per frame by which the planet turns, towards +Y at its top."""
    planet = shapes.link_object(collection, "Planet", _ground_mesh())
    planet.location.z = -RADIUS
    spin = planet.driver_add("rotation_euler", 0).driver
    spin.expression = f"-frame * {turn}"
    _plant(collection, planet)
    _hang_clouds(collection)
    return planet


def build_world():
    """Make the world: a sky in all directions, even below, because there is no land except the planet."""
    return lighting.build_gradient_world(
        "Motus Small Sky", SKY_STOPS, SKY_STRENGTH, lambda shader, height: shader.math("MULTIPLY", shader.math("ADD", height, 1.0), 0.5)
    )


def _ground_mesh():
    builder = shapes.MeshBuilder()
    vertices, faces = shapes.sphere(RADIUS, segments=256, rings=160)
    directions = vertices / RADIUS
    away = np.clip((np.abs(vertices[:, 0]) - PATH_WIDTH) / 2.0, 0.0, 1.0)
    swell = sum(
        np.sin(3.1 * f * directions[:, 0] + s) * np.sin(2.3 * f * directions[:, 1] + 2 * s) * np.sin(2.7 * f * directions[:, 2] + 3 * s) / f
        for f, s in ((1.0, 0.4), (2.3, 1.7), (4.9, 2.9))
    )
    builder.add((vertices * (1.0 + 0.035 * away * swell)[:, None], faces), 0)
    angle = np.linspace(0.0, 2.0 * np.pi, 240)
    across = np.linspace(-0.5 * PATH_WIDTH, 0.5 * PATH_WIDTH, 7)
    crown = PATH_RISE * (1.0 - (2.0 * across / PATH_WIDTH) ** 2) + 0.003
    ragged = 1.0 + 0.07 * np.sin(23.0 * angle) + 0.05 * np.sin(57.0 * angle + 1.0)
    rows = np.stack(
        [
            np.stack([ragged * x, (RADIUS + rise) * np.sin(angle), (RADIUS + rise) * np.cos(angle)], axis=-1)
            for x, rise in zip(across, crown)
        ]
    )
    builder.add(shapes.loft(rows, closed=True), 1)
    return builder.build("Planet", [_meadow(), materials.principled("Path", color=(0.48, 0.33, 0.19), roughness=0.95)])


def _meadow():
    material, shader, output = materials.new_material("Small Meadow")
    place = shader.add("ShaderNodeTexCoord").outputs["Object"]
    tint = shader.ramp(
        shader.noise(place, 0.9, detail=5.0), ((0.30, (0.055, 0.125, 0.022)), (0.55, (0.120, 0.195, 0.032)), (0.78, (0.260, 0.255, 0.055)))
    )
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=tint, roughness=0.9, specular=0.15)
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (0.12, 0.2, 0.04, 1.0)
    return material


def _plant(collection, planet):
    """Add trees, houses and stones, upright on the ground and everywhere except on the path."""
    random_of = random.Random(SEED)
    kinds = [woods.add_conifer(collection, None), woods.add_broadleaf(collection, None)]
    for kind in kinds:
        kind.hide_render = kind.hide_viewport = True
    house, stone = _house_mesh(), _stone_mesh()
    for index in range(TREES):
        kind = kinds[random_of.random() < 0.45]
        _stand(collection, planet, f"Tree {index}", kind.data, random_of, random_of.uniform(0.45, 1.05), CLEAR)
    for index in range(HOUSES):
        _stand(collection, planet, f"House {index}", house, random_of, random_of.uniform(0.55, 0.75), 1.3)
    for index in range(STONES):
        _stand(collection, planet, f"Stone {index}", stone, random_of, random_of.uniform(0.04, 0.13), 0.42)


def _stand(collection, planet, name, mesh, random_of, size, clear):
    """Add an object at a random place on the planet, at least `clear` metres from the middle of the path."""
    while True:
        direction = Vector((random_of.gauss(0.0, 0.75), random_of.gauss(0.0, 1.0), random_of.gauss(0.0, 1.0))).normalized()
        if abs(direction.x) * RADIUS > clear:
            break
    thing = shapes.link_object(collection, name, mesh, planet)
    upright = direction.to_track_quat('Z', 'Y').to_matrix().to_4x4()
    place = Matrix.Translation(direction * (RADIUS - 0.03))
    thing.matrix_basis = place @ upright @ Matrix.Rotation(random_of.uniform(0.0, math.tau), 4, 'Z') @ Matrix.Scale(size, 4)


def _hang_clouds(collection):
    """Add a few clouds that look like wadding."""
    builder = shapes.MeshBuilder()
    for x, y, z, radius in PUFFS:
        builder.add(shapes.sphere(radius, (x, y, z), (1.0, 0.8, 0.74), 32, 20))
    wadding = builder.build("Small Cloud", [materials.principled("Wadding", color=(0.92, 0.86, 0.80), roughness=1.0, specular=0.0)])
    for index, (*place, size) in enumerate(CLOUDS):
        cloud = shapes.link_object(collection, f"Cloud {index}", wadding)
        cloud.location, cloud.scale = place, 3 * [size]
        cloud.rotation_euler.z = 0.7 * index


def _house_mesh():
    builder = shapes.MeshBuilder()
    builder.add(shapes.box((0.9, 0.7, 0.6), (0.0, 0.0, 0.28)), 0, smooth=False)
    ridge = np.array(
        [(-0.54, -0.45, 0.55), (0.54, -0.45, 0.55), (0.54, 0.45, 0.55), (-0.54, 0.45, 0.55), (-0.54, 0.0, 1.0), (0.54, 0.0, 1.0)]
    )
    builder.add((ridge[:, :], np.array([(0, 1, 5, 4), (2, 3, 4, 5)])), 1, smooth=False)
    builder.add((ridge, np.array([(1, 2, 5, 5), (3, 0, 4, 4)])[:, :3]), 0, smooth=False)
    builder.add(shapes.box((0.14, 0.14, 0.4), (0.26, 0.16, 0.95)), 0, smooth=False)
    builder.add(shapes.box((0.17, 0.02, 0.34), (0.0, -0.355, 0.15)), 2, smooth=False)
    for x in (-0.27, 0.27):
        builder.add(shapes.box((0.16, 0.02, 0.16), (x, -0.355, 0.34)), 3, smooth=False)
    return builder.build(
        "Small House",
        [
            materials.principled("House Wall", color=(0.72, 0.62, 0.47), roughness=0.85),
            materials.principled("House Roof", color=(0.42, 0.085, 0.045), roughness=0.7),
            materials.principled("House Door", color=(0.10, 0.055, 0.03), roughness=0.6),
            materials.principled("House Window", color=(0.09, 0.14, 0.19), roughness=0.15),
        ],
    )


def _stone_mesh():
    vertices, faces = shapes.sphere(1.0, segments=12, rings=8)
    bumps = 1.0 + 0.16 * np.sin(5.0 * vertices[:, 0] + 1.0) * np.sin(4.0 * vertices[:, 1]) + 0.10 * np.sin(7.0 * vertices[:, 2])
    builder = shapes.MeshBuilder()
    builder.add((vertices * bumps[:, None] * (1.0, 0.8, 0.6), faces))
    return builder.build("Small Stone", [materials.principled("Small Stone", color=(0.30, 0.29, 0.27), roughness=0.9)])
