"""Weathered stones and blades of grass, for scenes close to the ground."""

import math

import numpy as np

from ..stage import materials, shapes


def boulder(place, radius, high, chance, seed):
    """Return (vertices, faces) of a weathered stone that protrudes from the ground by the height `high`. place: on the ground, m."""
    vertices, faces = shapes.sphere(1.0, segments=40, rings=26)
    vertices = np.asarray(vertices)
    vertices = np.sign(vertices) * np.abs(vertices) ** 0.75
    uneven = lumps(2.1 * vertices, seed) * 0.22 + lumps(5.7 * vertices, seed + 7) * 0.07
    vertices = vertices * (1.0 + uneven)[:, None]
    flat = 0.75 * high
    turn, squeeze = chance.uniform(0.0, math.tau), chance.uniform(0.72, 0.95)
    x, y = radius * vertices[:, 0], squeeze * radius * vertices[:, 1]
    return np.column_stack(
        (
            place[0] + math.cos(turn) * x - math.sin(turn) * y,
            place[1] + math.sin(turn) * x + math.cos(turn) * y,
            place[2] + high - flat + flat * vertices[:, 2],
        )
    ), faces


def lumps(places, seed):
    """Return smooth repeatable noise around 0 at places (n, 3)."""
    x, y, z = places.T
    return (
        sum(
            np.sin(a * x + b * y + c * z + seed + p) for a, b, c, p in ((1.0, 0.7, -0.4, 0.3), (-0.6, 1.1, 0.8, 1.9), (0.5, -0.9, 1.3, 4.1))
        )
        / 3.0
    )


def blade(foot, chance):
    """Return (vertices, faces) of a bent blade of grass. foot: place of its root, m. chance: random.Random."""
    high, wide, turn = chance.uniform(0.07, 0.26), chance.uniform(0.004, 0.008), chance.uniform(0.0, math.tau)
    lean = chance.uniform(0.15, 0.75)
    ahead, across = np.array((math.cos(turn), math.sin(turn), 0.0)), np.array((-math.sin(turn), math.cos(turn), 0.0))
    steps = np.linspace(0.0, 1.0, 5)
    spine = np.asarray(foot) + high * (steps[:, None] * (0.0, 0.0, 1.0) + (lean * steps**2)[:, None] * ahead)
    half = wide * (1.0 - steps**1.5)[:, None] * across
    vertices = np.concatenate((spine - half, spine + half))
    return vertices, np.array([(row, row + 1, row + 6, row + 5) for row in range(4)])


def mossy(name, dark, light):
    """Make a material of grey stone with moss on surfaces that face upwards."""
    material, shader, output = materials.new_material(name)
    place = shader.add("ShaderNodeTexCoord").outputs["Object"]
    grain = shader.math(
        "ADD",
        shader.noise(place, 4.0, detail=7.0),
        shader.math("MULTIPLY", shader.math("SUBTRACT", shader.noise(place, 26.0, detail=3.0), 0.5), 0.5),
    )
    stone = shader.ramp(grain, ((0.30, dark), (0.72, light)))
    up = shader.add("ShaderNodeSeparateXYZ", {0: shader.add("ShaderNodeNewGeometry").outputs["Normal"]}).outputs[2]
    moss = shader.math(
        "MULTIPLY",
        shader.math(
            "ADD",
            shader.math("MULTIPLY", up, 0.75),
            shader.math("SUBTRACT", shader.math("MULTIPLY", shader.noise(place, 3.4, detail=8.0), 2.2), 1.72),
        ),
        3.0,
        clamp=True,
    )
    color = shader.mix(
        moss, stone, shader.ramp(shader.noise(place, 17.0, detail=6.0), ((0.35, (0.022, 0.040, 0.008)), (0.70, (0.095, 0.125, 0.028))))
    )
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=color, roughness=0.9, specular=0.2)
    bump = shader.add("ShaderNodeBump", {"Height": grain, "Strength": 0.35, "Distance": 0.05})
    materials.set_principled(shader, node, normal=bump.outputs[0])
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (*light, 1.0)
    return material


def grass(name):
    """Make a material of grass."""
    material, shader, output = materials.new_material(name)
    place = shader.add("ShaderNodeTexCoord").outputs["Object"]
    tint = shader.ramp(shader.noise(place, 1.6, detail=2.0), ((0.35, (0.055, 0.115, 0.014)), (0.65, (0.20, 0.235, 0.040))))
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=tint, roughness=0.7, specular=0.2)
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (0.12, 0.17, 0.03, 1.0)
    return material
